#include <filesystem>

#include "hersey/core/input_file.h"
#include "hersey/fem/mesh_file.h"
#include "hersey/fem/mesh_quality.h"
#include "hersey/fem/skin.h"
#include "interpret/context/interpret.h"
#include "interpret/files/stl_file.h"

namespace hersey::model {
namespace {

class ShapeReader {
 public:
  explicit ShapeReader(Context& context) : context_(context) {}

  [[nodiscard]] std::optional<mbd::ShapeGeometry> geometry_of(const Value& value) {
    const double radius = 0.5 * number_of(value, "diameter");
    if (value.text == "sphere") return mbd::Sphere{vector_of(value, "centre"), radius};
    if (value.text == "cylinder" || value.text == "capsule") {
      const Vector3 from = vector_of(value, "from"), to = vector_of(value, "to");
      if (from == to) context_.fault_at_key(value, "both ends at the same position", "two ends apart");
      if (value.text == "cylinder") return mbd::Cylinder{from, to, radius};
      return mbd::Capsule{from, to, radius};
    }
    if (value.text == "box") return box_of(value);
    if (value.text == "half_space") {
      return mbd::HalfSpace{vector_of(value, "point"), direction_of(context_, value, "normal")};
    }
    return mesh_of(value);
  }

 private:
  mbd::Box box_of(const Value& value) {
    mbd::Box box{{}, vector_of(value, "size")};
    box.X_BS.r = vector_of(value, "centre");
    if (const Value* size = value.find("size"); size != nullptr && !size->broken && box.size.minCoeff() <= 0) {
      context_.fault(*size, "an edge that is not > 0", "three lengths > 0, such as 20 40 10 mm");
    }
    if (const Value* rotation = value.find("rotation"); rotation != nullptr && !rotation->broken) {
      const Vector3 axis = direction_of(context_, *rotation, "axis");
      box.X_BS.R = Eigen::AngleAxisd(number_of(*rotation, "angle"), axis).toRotationMatrix();
    }
    return box;
  }

  std::optional<mbd::ShapeGeometry> mesh_of(const Value& value) {
    const Value* file = value.find("file");
    if (file == nullptr || file->broken) return std::nullopt;
    const std::filesystem::path path = referenced_file(context_, file->text);
    const double unit = number_of(value, "unit");
    std::optional<mbd::TriangleMesh> mesh =
        fem::mesh_format_of(path) ? skin_of(*file, path, unit) : stl_of(*file, path, unit);
    if (!mesh) return std::nullopt;
    warn_of_size(*file, path, *mesh);
    const Vector3 origin = vector_of(value, "origin");
    for (Vector3& corner : mesh->corners) corner += origin;
    return std::make_shared<const mbd::TriangleMesh>(std::move(*mesh));
  }

  void warn_of_size(const Value& file, const std::filesystem::path& path, const mbd::TriangleMesh& mesh) {
    if (mesh.corners.empty()) return;
    Vector3 lower = mesh.corners.front(), upper = lower;
    for (const Vector3& corner : mesh.corners) lower = lower.cwiseMin(corner), upper = upper.cwiseMax(corner);
    if (const std::optional<Fault> warning = fem::size_warning(upper - lower, path.string()))
      context_.warnings_in_file(file, {*warning});
  }

  std::optional<mbd::TriangleMesh> stl_of(const Value& file, const std::filesystem::path& path, double unit) {
    const InputFile surface = read_input_file(path);
    if (!surface.fault.empty()) {
      context_.fault(file, surface.fault + " " + path.string(), "an STL file or a mesh beside the model file");
      return std::nullopt;
    }
    StlResult stl = parse_stl(surface.content);
    if (!stl.fault.empty()) {
      context_.fault(file, path.string() + ": " + stl.fault, "a surface as STL, text or binary");
      return std::nullopt;
    }
    if (stl.flat > 0)
      context_.warnings_in_file(
          file, {{{path.string(), 0, 0},
                  "",
                  std::to_string(stl.flat) + " of " + std::to_string(stl.facets) + " triangles without area",
                  "triangles of some area",
                  "they are left out"}});
    for (Vector3& corner : stl.mesh.corners) corner *= unit;
    return std::move(stl.mesh);
  }

  // The outer surface of a mesh of solids.
  std::optional<mbd::TriangleMesh> skin_of(const Value& file, const std::filesystem::path& path, double unit) {
    try {
      std::vector<Fault> warnings;
      const fem::Mesh mesh = fem::read_mesh(path, unit, &warnings);
      context_.warnings_in_file(file, warnings);
      const fem::Skin skin = fem::skin(mesh);
      if (skin.triangles.empty()) {
        context_.fault(file, path.string() + ": a mesh of beams", "a mesh of solids");
        return std::nullopt;
      }
      mbd::TriangleMesh surface;
      surface.triangles = skin.triangles;
      surface.corners.reserve(skin.nodes.size());
      for (const int node : skin.nodes) surface.corners.push_back(mesh.nodes[static_cast<std::size_t>(node)]);
      return surface;
    } catch (const InputError& error) {
      context_.fault(file, error.faults().front().text(), "a mesh of solids that can be read");
      return std::nullopt;
    }
  }

  Context& context_;
};

}  // namespace

std::vector<mbd::Shape> shapes_of(Context& context, const Value& body) {
  std::vector<mbd::Shape> shapes;
  for (const auto& [name, value] : section(body, "shapes")) {
    if (value.broken || value.text == "faces") continue;  // see faces_of_body
    if (auto geometry = ShapeReader(context).geometry_of(value)) shapes.push_back({name, std::move(*geometry)});
  }
  return shapes;
}

}  // namespace hersey::model
