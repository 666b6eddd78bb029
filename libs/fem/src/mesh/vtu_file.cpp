#include "hersey/fem/vtu_file.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <stdexcept>

#include "element/element_kind.h"
#include "hersey/core/contract.h"
#include "hersey/core/write_file.h"

namespace hersey::fem {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say LittleEndian");

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

/// Names the components of symmetric tensors; ParaView names those of vectors itself.
std::string component_names(int components) {
  constexpr std::array<const char*, 6> tensor{"xx", "yy", "zz", "xy", "yz", "xz"};
  std::string text;
  if (components != static_cast<int>(tensor.size())) return text;
  for (std::size_t k = 0; k < tensor.size(); ++k) text += fmt::format(R"( ComponentName{}="{}")", k, tensor[k]);
  return text;
}

/// The two parts of the file: XML that names arrays by their offset, and the arrays, each after its length.
class VtuText {
 public:
  void line(const std::string& text) { header_ += text + "\n"; }

  template <typename T>
  void array(const std::string& name, const char* type, int components, const std::vector<T>& values) {
    append(name, type, components, values.data(), values.size() * sizeof(T));
  }

  void array(const std::string& name, const Eigen::MatrixXd& values) {
    append(name, "Float64", static_cast<int>(values.rows()), values.data(),
           static_cast<std::size_t>(values.size()) * sizeof(double));
  }

  void write(const std::filesystem::path& path) const {
    try {
      write_file(path, {header_, "<AppendedData encoding=\"raw\">\n_", data_, "\n</AppendedData>\n</VTKFile>\n"});
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("{}: cannot be written: {}", path.string(), error.what()));
    }
  }

 private:
  void append(const std::string& name, const char* type, int components, const void* values, std::uint64_t bytes) {
    line(fmt::format(R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}"{} format="appended" offset="{}"/>)",
                     type, escaped(name), components, component_names(components), data_.size()));
    data_.append(std::bit_cast<std::array<char, sizeof bytes>>(bytes).data(), sizeof bytes);
    if (bytes > 0) data_.append(static_cast<const char*>(values), bytes);
  }

  std::string header_, data_;
};

void add_fields(const std::vector<VtuField>& fields, Eigen::Index columns, VtuText& text) {
  for (const VtuField& field : fields) {
    HERSEY_REQUIRE(field.values.cols() == columns, "a value for each");
    text.array(field.name, field.values);
  }
}

void add_cells(const Mesh& mesh, VtuText& text) {
  std::vector<std::int64_t> connectivity, offsets;
  std::vector<std::uint8_t> types;
  connectivity.reserve(mesh.connectivity.size());
  offsets.reserve(mesh.elements.size());
  types.reserve(mesh.elements.size());
  for (const Element& element : mesh.elements) {
    connectivity.insert(connectivity.end(), mesh.nodes_of(element), mesh.nodes_of(element) + node_count(element.type));
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    types.push_back(kind_of(element.type).files.vtk);
  }
  text.line("<Cells>");
  text.array("connectivity", "Int64", 1, connectivity);
  text.array("offsets", "Int64", 1, offsets);
  text.array("types", "UInt8", 1, types);
  text.line("</Cells>");
}

Eigen::Matrix3Xd positions_of(const Mesh& mesh) {
  Eigen::Matrix3Xd positions(3, static_cast<Eigen::Index>(mesh.nodes.size()));
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) positions.col(static_cast<Eigen::Index>(n)) = mesh.nodes[n];
  return positions;
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const Mesh& mesh, const VtuFrame& frame) {
  const auto nodes = static_cast<Eigen::Index>(mesh.nodes.size());
  HERSEY_REQUIRE(frame.positions.cols() == 0 || frame.positions.cols() == nodes, "a position for each node");
  std::vector<std::int64_t> element_labels;
  element_labels.reserve(mesh.elements.size());
  for (const Element& element : mesh.elements) element_labels.push_back(element.label);
  const std::vector<std::int64_t> node_labels(mesh.node_labels.begin(), mesh.node_labels.end());
  VtuText text;
  text.line("<?xml version=\"1.0\"?>");
  text.line(R"(<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">)");
  text.line(fmt::format("<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">", nodes,
                        mesh.elements.size()));
  text.line("<PointData>");
  text.array("node", "Int64", 1, node_labels);
  add_fields(frame.node_fields, nodes, text);
  text.line("</PointData>\n<CellData>");
  text.array("element", "Int64", 1, element_labels);
  add_fields(frame.element_fields, static_cast<Eigen::Index>(mesh.elements.size()), text);
  text.line("</CellData>\n<Points>");
  text.array("Points",
             frame.positions.cols() == 0 ? Eigen::MatrixXd(positions_of(mesh)) : Eigen::MatrixXd(frame.positions));
  text.line("</Points>");
  add_cells(mesh, text);
  text.line("</Piece>\n</UnstructuredGrid>");
  text.write(path);
}

VtuSeries::VtuSeries(std::filesystem::path pvd) : pvd_(std::move(pvd)) {
  std::filesystem::path folder = pvd_;
  folder.replace_extension();
  std::filesystem::create_directories(folder);
}

void VtuSeries::add(double time, const Mesh& mesh, const VtuFrame& frame) {
  const std::string name = name_of(files_.size());
  write_vtu(pvd_.parent_path() / name, mesh, frame);
  files_.emplace_back(time, name);
  write_index();
}

std::string VtuSeries::name_of(std::size_t file) const {
  return fmt::format("{}/{:05}.vtu", pvd_.stem().string(), file);
}

void VtuSeries::persist(Archive& archive) {
  std::vector<double> times;
  times.reserve(files_.size());
  for (const auto& [time, name] : files_) times.push_back(time);
  archive.io("times", times);
  if (!archive.restores()) return;
  files_.clear();
  for (const double time : times) files_.emplace_back(time, name_of(files_.size()));
  write_index();
}

// Written anew and renamed, so that a reader never finds half of it.
void VtuSeries::write_index() const {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const auto& [time, name] : files_)
    text += fmt::format("<DataSet timestep=\"{}\" file=\"{}\"/>\n", time, escaped(name));
  text += "</Collection>\n</VTKFile>\n";
  try {
    write_file(pvd_, {text});
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: cannot be written: {}", pvd_.string(), error.what()));
  }
}

}  // namespace hersey::fem
