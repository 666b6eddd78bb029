#include <filesystem>
#include <fstream>
#include <iterator>

#include "interpret.h"
#include "stl_file.h"

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
      if (from == to) context_.fault_at_key(value, "both ends at the same place", "two ends apart");
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
    const std::filesystem::path path = std::filesystem::path(context_.model.file).parent_path() / file->text;
    std::ifstream stream(path, std::ios::binary);
    std::error_code ignored;
    if (!stream || !std::filesystem::is_regular_file(path, ignored)) {
      context_.fault(*file, "no readable file " + path.string(), "an STL file beside the model file");
      return std::nullopt;
    }
    StlResult stl = parse_stl({std::istreambuf_iterator<char>(stream), {}});
    if (!stl.fault.empty()) {
      context_.fault(*file, path.string() + ": " + stl.fault, "a surface as STL, text or binary");
      return std::nullopt;
    }
    const double unit = number_of(value, "unit");
    const Vector3 origin = vector_of(value, "origin");
    for (Vector3& corner : stl.mesh.corners) corner = origin + unit * corner;
    return std::make_shared<const mbd::TriangleMesh>(std::move(stl.mesh));
  }

  Context& context_;
};

}  // namespace

std::vector<mbd::Shape> shapes_of(Context& context, const Value& body) {
  std::vector<mbd::Shape> shapes;
  for (const auto& [name, value] : section(body, "shapes")) {
    if (value.broken) continue;
    if (auto geometry = ShapeReader(context).geometry_of(value)) shapes.push_back({name, std::move(*geometry)});
  }
  return shapes;
}

}  // namespace hersey::model
