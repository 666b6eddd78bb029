#include "hersey/fem/mesh_quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include "element/element_kind.h"
#include "hersey/fem/quadrature.h"
#include "hersey/fem/shape_functions.h"
#include "hersey/fem/skin.h"
#include "hersey/fem/solid_element.h"

namespace hersey::fem {
namespace {

constexpr double kTouching = 1e-6;             // of the box's diagonal
constexpr double kFlat = 0.02;                 // shape below which a solver loses figures
constexpr double kLargeBody = 10;              // [m]
constexpr double kSmallBody = 1e-4;            // [m]
constexpr double kHeavyBody = 1000;            // [kg]
constexpr std::size_t kMostLabelsListed = 10;  // listed in one message

NodeColumns positions_of(const Mesh& mesh, const Element& element) {
  const int count = node_count(element.type);
  NodeColumns x(3, count);
  for (int k = 0; k < count; ++k) x.col(k) = mesh.nodes[static_cast<std::size_t>(mesh.nodes_of(element)[k])];
  return x;
}

double volume_of(ElementType type, const NodeColumns& x) {
  double volume = 0;
  for (const QuadraturePoint& point : mass_points(type))
    volume += point.weight * element_point(shape_functions(type, point.xi), x).jacobian;
  return volume;
}

void add_shape(const Element& element, const NodeColumns& x, ElementQuality& quality) {
  double worst = 1, longest = 0, shortest = 1e300;
  for (const std::array<int, 4>& corner : kind_of(element.type).checked_corners) {
    Matrix3 edges;
    for (int k = 0; k < 3; ++k) {
      edges.col(k) = x.col(corner[static_cast<std::size_t>(k) + 1]) - x.col(corner[0]);
      longest = std::max(longest, edges.col(k).norm());
      shortest = std::min(shortest, edges.col(k).norm());
    }
    worst = std::min(worst, corner_shape(element.type, edges));
  }
  if (worst < quality.smallest_shape || quality.count == 0) {
    quality.smallest_shape = worst;
    quality.label_of_smallest = element.label;
  }
  if (longest > 0) quality.largest_aspect = std::max(quality.largest_aspect, longest / shortest);
  quality.mean_shape += (worst - quality.mean_shape) / (quality.count + 1);
}

void add_elements(const Mesh& mesh, MeshQuality& quality) {
  double mass = 0;
  bool has_mass = true;
  for (const Element& element : mesh.elements) {
    ElementQuality& of_type = quality.types[element.type];
    if (element.type != ElementType::beam2) {
      const NodeColumns x = positions_of(mesh, element);
      if (!(smallest_jacobian(element.type, x) > 0)) quality.folded.push_back(element.label);
      add_shape(element, x, of_type);
      const double volume = volume_of(element.type, x);
      quality.volume += volume;
      const MeshMaterial* const material =
          element.material < 0 ? nullptr : &mesh.materials[static_cast<std::size_t>(element.material)];
      has_mass = has_mass && material != nullptr && material->density.has_value();
      if (has_mass) mass += volume * *material->density;
    }
    ++of_type.count;
  }
  if (has_mass && quality.volume > 0) quality.mass = mass;
}

void find_repeated(const Mesh& mesh, MeshQuality& quality) {
  std::vector<std::pair<std::array<int, 8>, long>> corners;
  corners.reserve(mesh.elements.size());
  for (const Element& element : mesh.elements) {
    const int count = kind_of(element.type).corners;
    if (element.type == ElementType::beam2) continue;  // two beams side by side are stiffer, and meant
    std::array<int, 8> key{};
    key.fill(-1);
    std::copy_n(mesh.nodes_of(element), count, key.begin());
    std::sort(key.begin(), key.begin() + count);
    corners.emplace_back(key, element.label);
  }
  std::sort(corners.begin(), corners.end());
  for (std::size_t k = 1; k < corners.size(); ++k)
    if (corners[k].first == corners[k - 1].first)
      quality.repeated.emplace_back(corners[k - 1].second, corners[k].second);
}

/// Nodes that stay in the middle of two others: of an edge that elements of first order share.
std::set<int> straight_nodes(const Mesh& mesh) {
  std::set<int> straight;
  for (const MeshTie& tie : mesh.ties)
    if (tie.size() == 3 && tie[1].coefficient == -0.5 && tie[2].coefficient == -0.5) straight.insert(tie[0].node);
  return straight;
}

/// A face's midside nodes, ascending; -1 where it has none, or one that stays straight.
std::array<int, 4> midside_nodes(const Mesh& mesh, ElementFace face, const std::set<int>& straight) {
  std::vector<int> nodes = nodes_of(mesh, face);
  for (int& node : nodes)
    if (straight.contains(node)) node = -1;
  std::array<int, 4> midside{-1, -1, -1, -1};
  if (has_midside_nodes(mesh.elements[static_cast<std::size_t>(face.element)].type))
    std::copy(nodes.begin() + static_cast<std::ptrdiff_t>(nodes.size() / 2), nodes.end(), midside.begin());
  std::sort(midside.begin(), midside.end());
  return midside;
}

// Elements that share a face's corners but not its midside nodes separate or overlap between the corners.
void find_mismatched(const Mesh& mesh, MeshQuality& quality) {
  const auto curves = [](const Element& element) { return has_midside_nodes(element.type); };
  if (std::none_of(mesh.elements.begin(), mesh.elements.end(), curves)) return;
  const std::set<int> straight = straight_nodes(mesh);
  struct Side {
    FaceKey corners;
    std::array<int, 4> midside;
    long label;
  };
  std::vector<Side> sides;
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e) {
    const Element& element = mesh.elements[static_cast<std::size_t>(e)];
    for (int f = 0; f < face_count(element.type); ++f)
      sides.push_back({face_key(mesh, {e, f}), midside_nodes(mesh, {e, f}, straight), element.label});
  }
  std::stable_sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.corners < b.corners; });
  for (std::size_t k = 1; k < sides.size(); ++k)
    if (sides[k].corners == sides[k - 1].corners && sides[k].midside != sides[k - 1].midside)
      quality.mismatched.emplace_back(sides[k - 1].label, sides[k].label);
}

/// Nodes of one tie, in ascending order.
std::set<std::pair<int, int>> tied_pairs(const Mesh& mesh) {
  std::set<std::pair<int, int>> tied;
  for (const MeshTie& tie : mesh.ties)
    for (const TieTerm& term : tie)
      if (term.node != tie.front().node) tied.insert(std::minmax(tie.front().node, term.node));
  return tied;
}

// Nodes in the same cell of a fine grid; two that a cell's boundary parts are missed, which only costs a warning.
void find_touching(const Mesh& mesh, MeshQuality& quality) {
  const double cell = kTouching * quality.size();
  if (!(cell > 0)) return;
  using Voxel = std::array<long long, 3>;
  std::vector<std::pair<Voxel, int>> cells;
  cells.reserve(mesh.nodes.size());
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    Voxel voxel{};
    for (std::size_t i = 0; i < 3; ++i)
      voxel[i] = std::llround((mesh.nodes[n] - quality.lower)[static_cast<Eigen::Index>(i)] / cell);
    cells.emplace_back(voxel, static_cast<int>(n));
  }
  std::sort(cells.begin(), cells.end());
  const std::set<std::pair<int, int>> tied = tied_pairs(mesh);
  const auto label = [&](int node) { return mesh.node_labels[static_cast<std::size_t>(node)]; };
  for (std::size_t k = 1; k < cells.size(); ++k) {
    const int a = cells[k - 1].second, b = cells[k].second;
    if (cells[k].first == cells[k - 1].first && !tied.contains(std::minmax(a, b)))
      quality.touching.emplace_back(label(a), label(b));
  }
}

int root_of(std::vector<int>& parents, int node) {
  while (parents[static_cast<std::size_t>(node)] != node) {
    int& parent = parents[static_cast<std::size_t>(node)];
    parent = parents[static_cast<std::size_t>(parent)];
    node = parent;
  }
  return node;
}

void find_parts(const Mesh& mesh, MeshQuality& quality) {
  std::vector<int> parents(mesh.nodes.size());
  std::iota(parents.begin(), parents.end(), 0);
  const auto join = [&](int a, int b) { parents[static_cast<std::size_t>(root_of(parents, b))] = root_of(parents, a); };
  for (const Element& element : mesh.elements)
    for (int k = 1; k < node_count(element.type); ++k) join(*mesh.nodes_of(element), mesh.nodes_of(element)[k]);
  for (const MeshTie& tie : mesh.ties)
    for (const TieTerm& term : tie) join(tie.front().node, term.node);
  std::map<int, std::pair<long, int>> parts;
  for (const Element& element : mesh.elements) {
    std::pair<long, int>& part = parts[root_of(parents, *mesh.nodes_of(element))];
    if (part.second++ == 0) part.first = element.label;
  }
  std::map<int, std::size_t> part_of_root;
  for (const auto& [root, part] : parts) {
    part_of_root[root] = quality.parts.size();
    quality.parts.push_back(part);
  }
  if (parts.size() < 2) return;
  quality.part_sets.resize(parts.size());
  for (const auto& [name, nodes] : mesh.node_sets) {
    std::set<std::size_t> of_parts;
    for (const int node : nodes) of_parts.insert(part_of_root.at(root_of(parents, node)));
    if (of_parts.size() == 1) quality.part_sets[*of_parts.begin()].push_back(name);
    if (of_parts.size() > 1 && nodes.size() < mesh.nodes.size()) quality.joining_sets.push_back(name);
  }
}

std::string listed(const std::vector<long>& labels) {
  const std::size_t shown = std::min(labels.size(), kMostLabelsListed);
  return fmt::format("{}{}", fmt::join(labels.begin(), labels.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                     shown < labels.size() ? fmt::format(", ... ({} in all)", labels.size()) : "");
}

std::string listed(const std::vector<std::pair<long, long>>& pairs) {
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < std::min(pairs.size(), kMostLabelsListed); ++k)
    texts.push_back(fmt::format("{} and {}", pairs[k].first, pairs[k].second));
  return fmt::format("{}{}", fmt::join(texts, ", "),
                     texts.size() < pairs.size() ? fmt::format(", ... ({} in all)", pairs.size()) : "");
}

std::string parts_text(const MeshQuality& quality) {
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < std::min(quality.parts.size(), kMostLabelsListed); ++k)
    parts.push_back(fmt::format("{} {} (one is {})", quality.parts[k].second,
                                quality.parts[k].second == 1 ? "element" : "elements", quality.parts[k].first));
  return fmt::format("{} parts that share no node: {}", quality.parts.size(), fmt::join(parts, ", "));
}

std::string first_of(const std::vector<std::string>& names, std::size_t most) {
  const std::size_t shown = std::min(names.size(), most);
  return fmt::format("{}{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                     shown < names.size() ? ", ..." : "");
}

/// Describes the sets that would join parts as a rigid frame, or by a tie.
std::string sets_text(const MeshQuality& quality) {
  constexpr std::size_t most_of_part = 3;
  if (!quality.joining_sets.empty())
    return fmt::format("a rigid frame joins the parts of its nodes; sets with nodes of several parts: {}",
                       first_of(quality.joining_sets, kMostLabelsListed));
  std::vector<std::string> of_parts;
  for (std::size_t k = 0; k < std::min(quality.part_sets.size(), kMostLabelsListed); ++k)
    of_parts.push_back(fmt::format("{} in that of element {}",
                                   quality.part_sets[k].empty() ? "none" : first_of(quality.part_sets[k], most_of_part),
                                   quality.parts[k].first));
  return fmt::format("no set has nodes of several parts; sets are {}", fmt::join(of_parts, "; "));
}

Fault fault(const std::string& file, std::string found, std::string expected, std::string suggestion) {
  return {{file, 0, 0}, "", std::move(found), std::move(expected), std::move(suggestion)};
}

}  // namespace

double corner_shape(ElementType type, const Matrix3& edges) {
  const Matrix3 A = edges * kind_of(type).ideal_edges.inverse();
  const double det = A.determinant();
  return det > 0 ? 3 * std::cbrt(det * det) / A.squaredNorm() : 0;
}

double element_shape(const Mesh& mesh, const Element& element) {
  ElementQuality quality;
  if (element.type != ElementType::beam2) add_shape(element, positions_of(mesh, element), quality);
  return quality.smallest_shape;
}

MeshQuality quality_of(const Mesh& mesh) {
  MeshQuality quality;
  if (mesh.nodes.empty()) return quality;
  quality.lower = quality.upper = mesh.nodes.front();
  for (const Vector3& r : mesh.nodes) {
    quality.lower = quality.lower.cwiseMin(r);
    quality.upper = quality.upper.cwiseMax(r);
  }
  add_elements(mesh, quality);
  find_repeated(mesh, quality);
  find_mismatched(mesh, quality);
  find_touching(mesh, quality);
  find_parts(mesh, quality);
  return quality;
}

std::vector<Fault> faults_of(const MeshQuality& quality, const std::string& file, Parts parts_are) {
  std::vector<Fault> faults;
  if (!quality.folded.empty())
    faults.push_back(fault(file,
                           fmt::format("{} with a Jacobian that is not positive: {}",
                                       quality.folded.size() == 1 ? "an element" : "elements", listed(quality.folded)),
                           "elements that are not folded, their nodes numbered as their format has it",
                           "mesh anew there, or straighten the midside nodes"));
  if (!quality.repeated.empty())
    faults.push_back(fault(file, fmt::format("elements on the same corners: {}", listed(quality.repeated)),
                           "each element once", "delete the repeated ones: they count twice in stiffness and mass"));
  if (quality.parts.size() > 1 && parts_are == Parts::one)
    faults.push_back(fault(
        file, parts_text(quality), "one connected body",
        fmt::format("{}tie them in the mesh file (RBE2, *TIE and the like), write one file for each body, or say "
                    "`parts: apart` (--parts apart) where frames hold them; {}",
                    quality.touching.empty() ? "" : "merge the nodes that lie on each other, ", sets_text(quality))));
  return faults;
}

std::optional<Fault> size_warning(const Vector3& box, const std::string& file, const std::string& more, bool is_heavy) {
  const double largest = box.maxCoeff();
  const std::string sizes = fmt::format("a body of {:.4g} x {:.4g} x {:.4g} m", box.x(), box.y(), box.z());
  if (largest > kLargeBody || is_heavy)
    return fault(file, sizes + more, "a machine's part", "is the mesh in millimetres? then give its length unit, mm");
  if (largest < kSmallBody)
    return fault(file, sizes, "a machine's part", "is the mesh in metres? then give its length unit, m");
  return std::nullopt;
}

std::vector<Fault> warnings_of(const MeshQuality& quality, const std::string& file, Parts parts_are) {
  std::vector<Fault> warnings;
  if (quality.parts.size() > 1 && parts_are == Parts::apart)
    warnings.push_back(fault(file, parts_text(quality), "frames that hold each of them", sets_text(quality)));
  const std::string more =
      fmt::format(", {:.4g} m^3{}", quality.volume, quality.mass ? fmt::format(", {:.4g} kg", *quality.mass) : "");
  const bool is_heavy = quality.mass.value_or(0) > kHeavyBody;
  if (std::optional<Fault> size = size_warning(quality.upper - quality.lower, file, more, is_heavy))
    warnings.push_back(std::move(*size));
  if (!quality.touching.empty())
    warnings.push_back(fault(file, fmt::format("nodes on each other: {}", listed(quality.touching)),
                             "one node where elements are connected", "merge them unless the gap is meant"));
  if (!quality.mismatched.empty())
    warnings.push_back(fault(
        file, fmt::format("elements whose common face has not the same midside nodes: {}", listed(quality.mismatched)),
        "elements of one order, and one midside node on an edge that elements share",
        "they are connected by the corners alone: mesh them anew in one order, or merge the nodes"));
  for (const auto& [type, of_type] : quality.types)
    if (of_type.smallest_shape < kFlat && type != ElementType::beam2)
      warnings.push_back(fault(
          file,
          fmt::format("a {} of shape {:.2g}: {}", name_of(type), of_type.smallest_shape, of_type.label_of_smallest),
          fmt::format("a shape above {}", kFlat), "mesh anew there for a better accuracy"));
  return warnings;
}

}  // namespace hersey::fem
