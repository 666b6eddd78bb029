#include "stl_file.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <sstream>
#include <tuple>

namespace hersey::model {
namespace {

constexpr std::size_t header_size = 84, facet_size = 50;

/// Gathers corners, each once.
class MeshBuilder {
 public:
  void add(const std::array<Vector3, 3>& corners) {
    std::array<int, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = index_of(corners[k]);
    const bool is_flat = triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
    if (!is_flat) mesh_.triangles.push_back(triangle);
  }

  [[nodiscard]] mbd::TriangleMesh take() { return std::move(mesh_); }

 private:
  int index_of(const Vector3& corner) {
    const auto [place, is_new] = indices_.try_emplace({corner.x(), corner.y(), corner.z()}, mesh_.corners.size());
    if (is_new) mesh_.corners.push_back(corner);
    return static_cast<int>(place->second);
  }

  mbd::TriangleMesh mesh_;
  std::map<std::tuple<double, double, double>, std::size_t> indices_;
};

std::uint32_t count_in_header(const std::string& content) {
  std::uint32_t count = 0;
  std::memcpy(&count, content.data() + header_size - sizeof count, sizeof count);
  return count;
}

// The format has no mark: a binary file is one whose length fits the number of facets it names.
bool is_binary(const std::string& content) {
  return content.size() >= header_size && content.size() == header_size + facet_size * count_in_header(content);
}

StlResult parse_binary(const std::string& content) {
  MeshBuilder builder;
  const std::uint32_t count = count_in_header(content);
  for (std::uint32_t f = 0; f < count; ++f) {
    std::array<float, 12> numbers{};  // normal, then three corners
    std::memcpy(numbers.data(), content.data() + header_size + facet_size * f, sizeof numbers);
    std::array<Vector3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = {numbers[3 + 3 * k], numbers[4 + 3 * k], numbers[5 + 3 * k]};
    for (const Vector3& corner : corners) {
      if (!corner.allFinite()) return {{}, fmt::format("facet {} has a corner that is no number", f + 1)};
    }
    builder.add(corners);
  }
  return {builder.take(), ""};
}

StlResult parse_text(const std::string& content) {
  MeshBuilder builder;
  std::istringstream stream(content);
  std::string line;
  std::array<Vector3, 3> corners;
  int number = 0;
  std::size_t corner = 0;
  while (std::getline(stream, line)) {
    ++number;
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "outer") corner = 0;
    if (word != "vertex") continue;
    double x = 0, y = 0, z = 0;
    const bool is_read = static_cast<bool>(words >> x >> y >> z);
    if (!is_read || corner > 2 || !std::isfinite(x + y + z)) {
      return {{}, fmt::format("line {}: '{}' is no corner of a triangle", number, line)};
    }
    corners[corner++] = {x, y, z};
    if (corner == 3) builder.add(corners);
  }
  return {builder.take(), ""};
}

}  // namespace

StlResult parse_stl(const std::string& content) {
  StlResult result = is_binary(content) ? parse_binary(content) : parse_text(content);
  if (result.fault.empty() && result.mesh.triangles.empty()) result.fault = "no triangles";
  return result;
}

}  // namespace hersey::model
