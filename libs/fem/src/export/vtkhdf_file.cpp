// VTKHDF File Format 2.0 (docs.vtk.org): a group VTKHDF with the grid, flat arrays of fields over time, and a group
// Steps with the offsets at which each time begins in them.
#include "hersey/fem/vtkhdf_file.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <array>
#include <map>
#include <stdexcept>
#include <system_error>

#include "element/element_kind.h"
#include "hersey/core/contract.h"
#include "hersey/core/hdf5_handle.h"
#include "hersey/fem/skin.h"

namespace hersey::fem {
namespace {

using Path = std::filesystem::path;

std::uint8_t vtk_type_of_face(std::size_t nodes) {
  switch (nodes) {
    case 3:
      return 5;
    case 4:
      return 9;
    case 6:
      return 22;
    default:
      return 23;
  }
}

}  // namespace

VtkCells vtk_cells(const Mesh& mesh) {
  VtkCells cells;
  cells.points.resize(3, static_cast<Eigen::Index>(mesh.nodes.size()));
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) cells.points.col(static_cast<Eigen::Index>(n)) = mesh.nodes[n];
  for (const Element& element : mesh.elements) {
    for (int a = 0; a < node_count(element.type); ++a) cells.connectivity.push_back(mesh.nodes_of(element)[a]);
    cells.offsets.push_back(static_cast<long long>(cells.connectivity.size()));
    cells.types.push_back(kind_of(element.type).files.vtk);
  }
  return cells;
}

VtkCells vtk_cells(const Mesh& mesh, const std::vector<ElementFace>& faces) {
  VtkCells cells;
  std::map<int, long long> point_of;
  for (const ElementFace& face : faces) {
    const std::vector<int> nodes = nodes_of(mesh, face);
    for (const int node : nodes)
      cells.connectivity.push_back(point_of.try_emplace(node, static_cast<long long>(point_of.size())).first->second);
    cells.offsets.push_back(static_cast<long long>(cells.connectivity.size()));
    cells.types.push_back(vtk_type_of_face(nodes.size()));
  }
  cells.points.resize(3, static_cast<Eigen::Index>(point_of.size()));
  for (const auto& [node, point] : point_of)
    cells.points.col(static_cast<Eigen::Index>(point)) = mesh.nodes[static_cast<std::size_t>(node)];
  return cells;
}

struct VtkHdfFile::Impl {
  Hdf5Session session;  // ends after the file is closed
  Path path, unfinished;
  std::vector<VtkHdfField> fields;
  hsize_t points = 0, cells = 0;
  bool moves = false;
  Hdf5Handle file;

  [[noreturn]] void fail() const { throw std::runtime_error(fmt::format("{}: cannot be written", path.string())); }

  [[nodiscard]] hsize_t columns(const VtkHdfField& field) const { return field.on_cells ? cells : points; }
  [[nodiscard]] static std::string path_of(const VtkHdfField& field) {
    return fmt::format("VTKHDF/{}/{}", field.on_cells ? "CellData" : "PointData", field.name);
  }

  [[nodiscard]] Hdf5Handle create(const std::string& name, hid_t type, const std::vector<hsize_t>& shape) const {
    const Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE));
    H5Pset_create_intermediate_group(links.get(), 1);
    const Hdf5Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr));
    Hdf5Handle data(H5Dcreate2(file.get(), name.c_str(), type, space.get(), links.get(), H5P_DEFAULT, H5P_DEFAULT));
    if (!data.valid()) fail();
    return data;
  }

  void put(const std::string& name, hid_t stored, hid_t type, const std::vector<hsize_t>& shape,
           const void* values) const {
    const Hdf5Handle data = create(name, stored, shape);
    if (shape[0] > 0 && H5Dwrite(data.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) fail();
  }

  void put(const std::string& name, const std::vector<long long>& values, bool as_column = false) const {
    const hsize_t count = values.size();
    put(name, H5T_STD_I64LE, H5T_NATIVE_LLONG, as_column ? std::vector<hsize_t>{count, 1} : std::vector<hsize_t>{count},
        values.data());
  }

  void attribute(const char* group, const char* name, const std::vector<long long>& values) const {
    const Hdf5Handle at(H5Gopen2(file.get(), group, H5P_DEFAULT));
    const hsize_t count = values.size();
    const Hdf5Handle space(count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr));
    const Hdf5Handle made(H5Acreate2(at.get(), name, H5T_STD_I64LE, space.get(), H5P_DEFAULT, H5P_DEFAULT));
    if (!made.valid() || H5Awrite(made.get(), H5T_NATIVE_LLONG, values.data()) < 0) fail();
  }

  /// The kind of grid, text of its own length in ASCII as the reader expects it.
  void type_attribute() const {
    constexpr std::array<char, 16> grid{'U', 'n', 's', 't', 'r', 'u', 'c', 't', 'u', 'r', 'e', 'd', 'G', 'r', 'i', 'd'};
    const Hdf5Handle at(H5Gopen2(file.get(), "VTKHDF", H5P_DEFAULT)), space(H5Screate(H5S_SCALAR)),
        text(H5Tcopy(H5T_C_S1));
    H5Tset_size(text.get(), grid.size());
    H5Tset_strpad(text.get(), H5T_STR_NULLPAD);
    const Hdf5Handle made(H5Acreate2(at.get(), "Type", text.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT));
    if (!made.valid() || H5Awrite(made.get(), text.get(), grid.data()) < 0) fail();
  }

  void write_grid(const VtkCells& grid, std::size_t steps) const {
    const Hdf5Handle made = create("VTKHDF/Points", H5T_IEEE_F64LE, {points * (moves ? steps : 1), 3});
    if (!moves) write_rows("VTKHDF/Points", {0, 0}, {points, 3}, grid.points.data());
    put("VTKHDF/NumberOfPoints", std::vector<long long>{static_cast<long long>(points)});
    put("VTKHDF/NumberOfCells", std::vector<long long>{static_cast<long long>(cells)});
    put("VTKHDF/NumberOfConnectivityIds", std::vector<long long>{static_cast<long long>(grid.connectivity.size())});
    put("VTKHDF/Connectivity", grid.connectivity);
    put("VTKHDF/Offsets", grid.offsets);
    put("VTKHDF/Types", H5T_STD_U8LE, H5T_NATIVE_UCHAR, {cells}, grid.types.data());
    attribute("VTKHDF", "Version", {2, 0});
    type_attribute();
  }

  /// Rows of numbers, the numbers of a row one after the other.
  void write_rows(const std::string& name, const std::array<hsize_t, 2>& start, const std::array<hsize_t, 2>& count,
                  const double* values) const {
    const Hdf5Handle data(H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT));
    const Hdf5Handle space(H5Dget_space(data.get()));
    const Hdf5Handle rows(H5Screate_simple(H5Sget_simple_extent_ndims(space.get()), count.data(), nullptr));
    const bool is_written =
        H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) >= 0 &&
        H5Dwrite(data.get(), H5T_NATIVE_DOUBLE, rows.get(), space.get(), H5P_DEFAULT, values) >= 0;
    if (!is_written) fail();
  }

  // The cells are the same at all times: each time begins at their start, and at points of its own where these move.
  void write_steps(const std::vector<double>& times) const {
    const std::vector<long long> from_start(times.size(), 0), one(times.size(), 1);
    put("VTKHDF/Steps/Values", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {times.size()}, times.data());
    attribute("VTKHDF/Steps", "NSteps", {static_cast<long long>(times.size())});
    put("VTKHDF/Steps/PartOffsets", from_start);
    put("VTKHDF/Steps/NumberOfParts", one);
    std::vector<long long> of_points(times.size(), 0);
    for (std::size_t k = 0; k < times.size() && moves; ++k) of_points[k] = static_cast<long long>(k * points);
    put("VTKHDF/Steps/PointOffsets", of_points);
    put("VTKHDF/Steps/CellOffsets", from_start, true);
    put("VTKHDF/Steps/ConnectivityIdOffsets", from_start, true);
    for (const VtkHdfField& field : fields) {
      std::vector<long long> offsets(times.size(), 0);
      for (std::size_t k = 0; k < times.size() && !field.is_constant; ++k)
        offsets[k] = static_cast<long long>(k * columns(field));
      put(fmt::format("VTKHDF/Steps/{}Offsets/{}", field.on_cells ? "CellData" : "PointData", field.name), offsets);
      std::vector<hsize_t> shape{columns(field) * (field.is_constant ? 1 : times.size())};
      if (field.components > 1) shape.push_back(static_cast<hsize_t>(field.components));
      const Hdf5Handle made = create(path_of(field), H5T_IEEE_F64LE, shape);
    }
  }
};

VtkHdfFile::VtkHdfFile(Path path, const VtkCells& cells, std::vector<VtkHdfField> fields,
                       const std::vector<double>& times, bool moves)
    : impl_(std::make_unique<Impl>()) {
  Impl& file = *impl_;
  file.path = std::move(path);
  file.unfinished = file.path;
  file.unfinished += ".new";
  file.fields = std::move(fields);
  file.points = static_cast<hsize_t>(cells.points.cols());
  file.cells = cells.types.size();
  file.moves = moves;
  file.file = Hdf5Handle(H5Fcreate(file.unfinished.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  if (!file.file.valid()) file.fail();
  file.write_grid(cells, times.size());
  file.write_steps(times);
}

VtkHdfFile::~VtkHdfFile() {
  if (!impl_->file.valid()) return;
  impl_->file.reset();
  std::error_code ignored;
  std::filesystem::remove(impl_->unfinished, ignored);
}

void VtkHdfFile::write(std::size_t step, std::size_t field, const Eigen::MatrixXd& values) {
  const VtkHdfField& at = impl_->fields.at(field);
  HERSEY_REQUIRE(values.rows() == at.components && static_cast<hsize_t>(values.cols()) == impl_->columns(at),
                 "a column for each point or cell");
  impl_->write_rows(Impl::path_of(at), {at.is_constant ? 0 : step * impl_->columns(at), 0},
                    {impl_->columns(at), static_cast<hsize_t>(at.components)}, values.data());
}

void VtkHdfFile::write_points(std::size_t step, const Eigen::Matrix3Xd& points) {
  HERSEY_REQUIRE(impl_->moves && static_cast<hsize_t>(points.cols()) == impl_->points, "a column for each point");
  impl_->write_rows("VTKHDF/Points", {step * impl_->points, 0}, {impl_->points, 3}, points.data());
}

void VtkHdfFile::write_names(const std::string& name, const std::vector<std::string>& texts) {
  const Hdf5Handle type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type.get(), H5T_VARIABLE);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  impl_->put(name, type.get(), type.get(), {texts.size()}, pointers.data());
}

void VtkHdfFile::close() {
  if (!impl_->file.reset()) impl_->fail();
  std::error_code error;
  std::filesystem::rename(impl_->unfinished, impl_->path, error);
  if (error) impl_->fail();
}

}  // namespace hersey::fem
