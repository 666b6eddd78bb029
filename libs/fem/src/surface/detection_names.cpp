#include "surface/detection_names.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <set>
#include <tuple>

namespace hersey::fem {
namespace {

constexpr double kOnBox = 1e-5;      // of the box's diagonal: as planes are found
constexpr double kAlongAxis = 1e-4;  // components of a normal beside one of the mesh's axes

/// In steps of 0.01, halves upwards though they are a little less: another mesh of the same part gives the same name.
std::string rounded(double value) {
  const double hundredths = std::floor(value * 100 + 0.5 + 1e-3);
  return fmt::format("{}", hundredths == 0 ? 0.0 : hundredths / 100);
}

std::string position_text(const Vector3& x) {
  return fmt::format("{}_{}_{}", rounded(1e3 * x.x()), rounded(1e3 * x.y()), rounded(1e3 * x.z()));
}

std::string name_of_plane(const FoundSurface& plane, const Vector3& lower, const Vector3& upper) {
  const double offset = plane.axis.dot(plane.centre), within = kOnBox * (upper - lower).norm();
  for (int i = 0; i < 3; ++i) {
    if ((plane.axis.cwiseAbs() - Vector3::Unit(i)).lpNorm<Eigen::Infinity>() > kAlongAxis) continue;
    const char letter = "xyz"[i];
    const double at = plane.axis[i] * offset;
    if (plane.axis[i] < 0 && std::abs(at - lower[i]) <= within) return fmt::format("plane_{}_min", letter);
    if (plane.axis[i] > 0 && std::abs(at - upper[i]) <= within) return fmt::format("plane_{}_max", letter);
    return fmt::format("plane_{}_at_{}", letter, rounded(1e3 * at));
  }
  return fmt::format("plane_towards_{}_{}_{}_at_{}", rounded(plane.axis.x()), rounded(plane.axis.y()),
                     rounded(plane.axis.z()), rounded(1e3 * offset));
}

const char* word_for(const FoundSurface& cylinder) {
  if (cylinder.use() == FoundSurface::Use::bore) return "bore";
  if (cylinder.use() == FoundSurface::Use::journal) return "journal";
  if (cylinder.runs_into_neighbours) return "rounding";
  return cylinder.is_internal ? "hole" : "cylinder";
}

using FaceSet = std::set<std::pair<int, int>>;

FaceSet set_of(const std::vector<ElementFace>& faces) {
  FaceSet set;
  for (const ElementFace face : faces) set.emplace(face.element, face.face);
  return set;
}

}  // namespace

void name_surfaces(const Mesh& mesh, const Vector3& lower, const Vector3& upper, std::vector<FoundSurface>& found) {
  std::set<std::string> names;
  for (const auto& [name, nodes] : mesh.node_sets) names.insert(name);
  for (const auto& [name, faces] : mesh.surfaces) names.insert(name);
  std::vector<std::pair<std::string, FaceSet>> known;
  for (const auto& [name, faces] : mesh.surfaces) known.emplace_back(name, set_of(faces));
  for (FoundSurface& surface : found) {
    const FaceSet faces = set_of(surface.faces);
    for (const auto& [name, other] : known)
      if (surface.name.empty() && other == faces) surface.name = name;
    if (!surface.name.empty()) continue;
    const std::string base = surface.kind == FoundSurface::Kind::plane
                                 ? name_of_plane(surface, lower, upper)
                                 : fmt::format("{}_d{}_at_{}", word_for(surface), rounded(2e3 * surface.radius),
                                               position_text(surface.centre));
    surface.name = base;
    for (int k = 2; !names.insert(surface.name).second; ++k) surface.name = fmt::format("{}_{}", base, k);
  }
}

}  // namespace hersey::fem
