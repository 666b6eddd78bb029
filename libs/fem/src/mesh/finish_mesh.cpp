#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>

#include "hersey/fem/skin.h"
#include "mesh/label_index.h"
#include "mesh/mesh_materials.h"
#include "mesh/mesh_ties.h"
#include "mesh/midside_nodes.h"
#include "mesh/raw_mesh.h"

namespace hersey::fem {
namespace {

constexpr double kFarthest = 1e9;        // [m]: squares and cubes of lengths stay far from overflow
constexpr std::size_t kMostFaults = 10;  // of one sort; the rest is the same mistake

struct FaceKeyHash {
  std::size_t operator()(const FaceKey& key) const {
    std::size_t hash = 0;
    for (const int node : key) hash = (hash ^ static_cast<std::size_t>(node)) * 0x9E3779B97F4A7C15ULL;
    return hash ^ (hash >> 32);
  }
};

void sort_and_unite(std::vector<int>& indices) {
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
}

std::vector<long> labels_of(const std::vector<RawMark>& marks) {
  std::vector<long> labels;
  labels.reserve(marks.size());
  for (const RawMark& mark : marks) labels.push_back(mark.label);
  return labels;
}

class Finisher {
 public:
  Finisher(RawMesh& raw, double length_unit, const std::vector<StraightNode>& straight)
      : raw_(raw),
        length_unit_(length_unit),
        straight_(straight),
        node_index_(raw.node_labels),
        mark_index_(labels_of(raw.marks)) {}

  Mesh mesh() {
    require_elements();
    check_nodes();
    add_elements();
    drop_unused_nodes();
    check_elements();
    add_node_sets();
    add_element_sets();
    assign_materials(raw_, marks_of_, mesh_);
    add_surfaces();
    add_marked();
    name_nodes();
    tie();
    scale();
    drop_unused_materials(mesh_);
    return std::move(mesh_);
  }

 private:
  void require_elements() const {
    if (!raw_.elements.empty()) return;
    raw_.fail({0, 0},
              raw_.nodes.empty() ? "an empty mesh: no nodes and no elements"
                                 : fmt::format("no elements of a solid or beam among {} nodes", raw_.nodes.size()),
              "tetrahedra, wedges, hexahedra or beams",
              "write volume elements too (in Gmsh: a Physical Volume, or Mesh.SaveAll = 1)");
  }

  // A node given twice at the same position is the same node: programs write it so where parts share it.
  void check_nodes() const {
    for (std::size_t n = 0; n < raw_.nodes.size(); ++n) {
      const auto first = static_cast<std::size_t>(node_index_.find(raw_.node_labels[n]));
      if (first == n || raw_.nodes[first] == raw_.nodes[n]) continue;
      raw_.fail(raw_.node_locations[n],
                fmt::format("node {} is already defined in line {}, at another position", raw_.node_labels[n],
                            raw_.node_locations[first].line),
                "each node once");
    }
  }

  void add_elements() {
    std::size_t missing = 0;
    mesh_.connectivity.resize(raw_.connectivity.size());
    mesh_.elements.reserve(raw_.elements.size());
    for (const RawElement& raw : raw_.elements) {
      const std::size_t count = static_cast<std::size_t>(node_count(raw.type));
      for (std::size_t k = raw.first; k < raw.first + count; ++k) {
        mesh_.connectivity[k] = node_index_.find(raw_.connectivity[k]);
        if (mesh_.connectivity[k] < 0 && missing++ < kMostFaults)
          add_fault(raw.location, fmt::format("element {} has node {}, which the file does not contain", raw.label,
                                              raw_.connectivity[k]));
      }
      require_distinct_nodes(raw, count);
      Element element;
      element.type = raw.type;
      element.label = raw.label;
      element.first = static_cast<int>(raw.first);
      mesh_.elements.push_back(element);
    }
    if (!faults_.empty()) throw InputError(faults_);
  }

  void require_distinct_nodes(const RawElement& raw, std::size_t count) {
    std::array<long, 20> nodes{};
    std::copy_n(raw_.connectivity.begin() + static_cast<std::ptrdiff_t>(raw.first), count, nodes.begin());
    const auto end = nodes.begin() + static_cast<std::ptrdiff_t>(count);
    std::sort(nodes.begin(), end);
    const auto repeated = std::adjacent_find(nodes.begin(), end);
    if (repeated == end || faults_.size() >= 2 * kMostFaults) return;
    add_fault(raw.location, fmt::format("element {} has node {} twice", raw.label, *repeated));
    faults_.back().suggestion = "write the collapsed element in its own shape, such as a wedge";
  }

  void add_fault(FileLocation location, std::string found) {
    faults_.push_back(raw_.fault(location, std::move(found), "elements of distinct nodes of the file"));
  }

  void drop_unused_nodes() {
    node_index_of_.assign(raw_.nodes.size(), -1);
    for (const int node : mesh_.connectivity) node_index_of_[static_cast<std::size_t>(node)] = 0;
    std::vector<long> dropped;
    const std::set<long> tied = tied_labels();
    for (std::size_t n = 0; n < raw_.nodes.size(); ++n) {
      if (node_index_of_[n] < 0) {
        const bool is_repeated = static_cast<std::size_t>(node_index_.find(raw_.node_labels[n])) != n;
        if (!is_repeated && !tied.contains(raw_.node_labels[n])) dropped.push_back(raw_.node_labels[n]);
        continue;
      }
      node_index_of_[n] = static_cast<int>(mesh_.nodes.size());
      mesh_.nodes.push_back(raw_.nodes[n]);
      mesh_.node_labels.push_back(raw_.node_labels[n]);
    }
    for (int& node : mesh_.connectivity) node = node_index_of_[static_cast<std::size_t>(node)];
    if (dropped.empty()) return;
    const std::size_t listed = std::min<std::size_t>(dropped.size(), 5);
    raw_.warn(
        raw_.node_locations[static_cast<std::size_t>(node_index_.find(dropped.front()))],
        fmt::format("{} {} part of no element: {}{}", dropped.size(), dropped.size() == 1 ? "node is" : "nodes are",
                    fmt::join(dropped.begin(), dropped.begin() + static_cast<std::ptrdiff_t>(listed), ", "),
                    listed < dropped.size() ? ", ..." : ""),
        "nodes of elements", "left out of the mesh and its sets");
  }

  // Nodes of no element that occur in a tie: references of rigid bodies.
  [[nodiscard]] std::set<long> tied_labels() const {
    std::set<long> labels;
    for (const RawTie& tie : raw_.ties)
      for (const RawTieTerm& term : tie.terms) labels.insert(term.node);
    for (const RawEquation& equation : raw_.equations)
      for (const RawEquation::Term& term : equation.terms) labels.insert(term.node);
    for (const RawRigidBody& body : raw_.rigid_bodies)
      if (body.reference) labels.insert(*body.reference);
    return labels;
  }

  void tie() {
    const TiedNodes nodes{[this](long label) { return index_of_label(label); },
                          [this](long label) -> const Vector3* {
                            const int n = node_index_.find(label);
                            return n < 0 ? nullptr : &raw_.nodes[static_cast<std::size_t>(n)];
                          }};
    add_ties(raw_, mesh_, nodes, straight_);
  }

  [[nodiscard]] int index_of_label(long label) const {
    const int raw = node_index_.find(label);
    return raw < 0 ? -1 : node_index_of_[static_cast<std::size_t>(raw)];
  }

  void check_elements() {
    std::vector<long> labels;
    labels.reserve(raw_.elements.size());
    for (const RawElement& element : raw_.elements) labels.push_back(element.label);
    element_index_ = std::make_unique<LabelIndex>(labels);
    for (std::size_t e = 0; e < labels.size(); ++e) {
      const auto first = static_cast<std::size_t>(element_index_->find(labels[e]));
      if (first == e || raw_.elements[e].continues_another) continue;
      raw_.fail(raw_.elements[e].location,
                fmt::format("element {} is already defined in line {}", labels[e], raw_.elements[first].location.line),
                "each element once");
    }
    check_marks();
  }

  // A mark whose label occurs elsewhere would never be found by it.
  void check_marks() const {
    for (const RawMark& mark : raw_.marks) {
      const RawMark& first = mark_at(mark_index_.find(mark.label));
      const int element = element_index_->find(mark.label);
      if (element < 0 && (&first == &mark || first.nodes == mark.nodes)) continue;
      const FileLocation other =
          element < 0 ? first.location : raw_.elements[static_cast<std::size_t>(element)].location;
      raw_.fail(mark.location, fmt::format("element {} is already defined in line {}", mark.label, other.line),
                "each element once");
    }
  }

  // Adds all indices of an element's label: one, or the pieces of a beam of three nodes.
  void add_element_indices(long label, std::vector<int>& indices) const {
    int index = element_index_->find(label);
    if (index < 0) return;
    do {
      indices.push_back(index++);
    } while (static_cast<std::size_t>(index) < raw_.elements.size() &&
             raw_.elements[static_cast<std::size_t>(index)].continues_another);
  }

  using Members = std::map<std::string, RawSet>;

  // Returns the set and those it names, directly or through others.
  std::vector<const RawSet*> closure(const Members& sets, const std::string& name) const {
    std::set<std::string> visited{name};
    std::vector<std::string> open{name};
    std::vector<const RawSet*> members;
    while (!open.empty()) {
      const auto set = sets.find(open.back());
      open.pop_back();
      if (set == sets.end()) continue;
      members.push_back(&set->second);
      for (const std::string& other : set->second.sets) {
        if (!sets.contains(other))
          raw_.fail(set->second.location,
                    fmt::format("set '{}' has the set '{}', which the file does not define", name, other),
                    "numbers or names of sets");
        if (visited.insert(other).second) open.push_back(other);
      }
    }
    return members;
  }

  // Visits the labels of a range; of a range much longer than the file's labels, only the labels that exist.
  template <typename Visit>
  static void for_each_label(const LabelRange& range, const std::vector<long>& existing, const Visit& visit) {
    const auto length = static_cast<unsigned long>(range.last) - static_cast<unsigned long>(range.first);
    if (range.last < range.first) return;
    if (length / static_cast<unsigned long>(range.step) <= 4 * existing.size() + 16) {
      for (unsigned long k = 0; k <= length; k += static_cast<unsigned long>(range.step))
        visit(static_cast<long>(static_cast<unsigned long>(range.first) + k));
      return;
    }
    for (const long label : existing)
      if (label >= range.first && label <= range.last && (label - range.first) % range.step == 0) visit(label);
  }

  void add_node_sets() {
    for (const auto& [name, set] : raw_.node_sets) {
      std::vector<int> indices;
      std::size_t unknown = 0;
      for (const RawSet* member : closure(raw_.node_sets, name))
        for (const LabelRange& range : member->labels)
          for_each_label(range, raw_.node_labels, [&](long label) {
            if (node_index_.find(label) < 0) ++unknown;
            if (const int index = index_of_label(label); index >= 0) indices.push_back(index);
          });
      if (set.is_of_either_kind && indices.empty()) continue;
      if (!set.is_of_either_kind) warn_of_unknown(set.location, name, "node", unknown, indices.empty());
      sort_and_unite(indices);
      mesh_.node_sets[name] = std::move(indices);
    }
  }

  // An element set's marks make a surface or a node set of its name, its elements an element set.
  void add_element_sets() {
    std::vector<long> labels;
    for (const Element& element : mesh_.elements) labels.push_back(element.label);
    for (const RawMark& mark : raw_.marks) labels.push_back(mark.label);
    for (const auto& [name, set] : raw_.element_sets) {
      std::vector<int> indices, marks;
      std::size_t unknown = 0;
      for (const RawSet* member : closure(raw_.element_sets, name))
        for (const LabelRange& range : member->labels)
          for_each_label(range, labels, [&](long label) {
            const int mark = mark_index_.find(label);
            if (mark >= 0)
              marks.push_back(mark);
            else if (element_index_->find(label) < 0)
              ++unknown;
            add_element_indices(label, indices);
          });
      if (set.is_of_either_kind && indices.empty() && marks.empty()) continue;
      if (!set.is_of_either_kind)
        warn_of_unknown(set.location, name, "element", unknown, indices.empty() && marks.empty());
      sort_and_unite(indices);
      sort_and_unite(marks);
      if (!marks.empty()) marks_of_[name] = std::move(marks);
      if (!indices.empty() || !marks_of_.contains(name)) mesh_.element_sets[name] = std::move(indices);
    }
  }

  void warn_of_unknown(FileLocation location, const std::string& name, const char* what, std::size_t unknown,
                       bool is_empty) {
    if (unknown > 0)
      raw_.warn(location, fmt::format("set '{}' names {} {}s that the mesh does not contain", name, unknown, what),
                fmt::format("{}s of the mesh", what), "they are left out");
    else if (is_empty)
      raw_.warn(location, fmt::format("set '{}' has no {} of the mesh", name, what),
                fmt::format("{}s of the mesh", what), "nothing can be fixed to it");
  }

  void add_surfaces() {
    for (const auto& [name, parts] : raw_.surfaces) {
      std::vector<ElementFace>& surface = mesh_.surfaces[name];
      for (const RawSurfacePart& part : parts) add_surface_part(name, part, surface);
    }
  }

  void add_surface_part(const std::string& name, const RawSurfacePart& part, std::vector<ElementFace>& surface) {
    std::vector<int> elements;
    if (part.element_set.empty())
      add_element_indices(part.element, elements);
    else if (const auto set = mesh_.element_sets.find(part.element_set); set != mesh_.element_sets.end())
      elements = set->second;
    if (elements.empty()) {
      const std::string what = part.element_set.empty() ? fmt::format("element {}", part.element)
                                                        : fmt::format("element set '{}'", part.element_set);
      raw_.fail(part.location, fmt::format("surface '{}' lies on {}, which the mesh does not contain", name, what),
                "elements or element sets of the mesh");
    }
    if (part.face < 0) return add_outer_faces(elements, surface);
    for (const int e : elements) {
      const ElementType type = mesh_.elements[static_cast<std::size_t>(e)].type;
      if (part.face >= face_count(type))
        raw_.fail(part.location, fmt::format("surface '{}' has face {} of a {}", name, part.face + 1, name_of(type)),
                  fmt::format("a face from 1 to {}", face_count(type)));
      surface.push_back({e, part.face});
    }
  }

  void add_outer_faces(const std::vector<int>& elements, std::vector<ElementFace>& surface) {
    if (outer_.empty()) outer_ = outer_faces(mesh_);
    for (const ElementFace& face : outer_)
      if (std::binary_search(elements.begin(), elements.end(), face.element)) surface.push_back(face);
  }

  // Elements of surface shape become faces of the solids below them: of the first solid that has the same corners.
  void add_marked() {
    std::unordered_map<FaceKey, ElementFace, FaceKeyHash> faces;
    for (const auto& [name, marks] : marks_of_)
      for (const int mark : marks)
        if (mark_at(mark).corner_count > 0) faces[key_of(mark_at(mark))] = {-1, -1};
    for (int e = 0; !faces.empty() && e < static_cast<int>(mesh_.elements.size()); ++e)
      for (int f = 0; f < face_count(mesh_.elements[static_cast<std::size_t>(e)].type); ++f) {
        const auto face = faces.find(face_key(mesh_, {e, f}));
        if (face != faces.end() && face->second.element < 0) face->second = {e, f};
      }
    for (const auto& [name, marks] : marks_of_) add_marks(name, marks, faces);
  }

  void add_marks(const std::string& name, const std::vector<int>& marks,
                 const std::unordered_map<FaceKey, ElementFace, FaceKeyHash>& faces) {
    std::vector<ElementFace> surface;
    std::vector<int> nodes;
    std::size_t unmatched = 0;
    for (const int m : marks) {
      const RawMark& mark = mark_at(m);
      for (std::size_t k = 0; k < static_cast<std::size_t>(mark.node_count); ++k)
        if (const int node = index_of_label(mark.nodes[k]); node >= 0) nodes.push_back(node);
      if (mark.corner_count == 0) continue;
      const ElementFace face = faces.at(key_of(mark));
      if (face.element < 0) {
        ++unmatched;
        continue;
      }
      surface.push_back(face);
      for (const int node : nodes_of(mesh_, face)) nodes.push_back(node);  // Nastran's marks are read by their corners
    }
    if (unmatched > 0)
      raw_.warn({0, 0}, fmt::format("set '{}': {} shells are faces of no solid element", name, unmatched),
                "shells that mark faces of solids", "they are left out; shells are not computed");
    sort_and_unite(nodes);
    std::vector<int>& named = mesh_.node_sets.try_emplace(name).first->second;
    named.insert(named.end(), nodes.begin(), nodes.end());
    sort_and_unite(named);
    std::vector<ElementFace>& target = mesh_.surfaces[name];
    target.insert(target.end(), surface.begin(), surface.end());
    if (target.empty()) mesh_.surfaces.erase(name);
  }

  [[nodiscard]] const RawMark& mark_at(int index) const { return raw_.marks[static_cast<std::size_t>(index)]; }

  [[nodiscard]] FaceKey key_of(const RawMark& face) const {
    FaceKey key{-1, -1, -1, -1};
    for (std::size_t c = 0; c < static_cast<std::size_t>(face.corner_count); ++c)
      key[c] = index_of_label(face.nodes[c]);
    std::sort(key.begin(), key.begin() + face.corner_count);
    return key;
  }

  // Every named set and surface gets a node set.
  void name_nodes() {
    for (auto& [name, surface] : mesh_.surfaces) {
      std::sort(surface.begin(), surface.end(), [](ElementFace a, ElementFace b) {
        return std::pair(a.element, a.face) < std::pair(b.element, b.face);
      });
      const auto same = [](ElementFace a, ElementFace b) { return a.element == b.element && a.face == b.face; };
      surface.erase(std::unique(surface.begin(), surface.end(), same), surface.end());
      std::vector<int> nodes;
      for (const ElementFace& face : surface)
        for (const int node : nodes_of(mesh_, face)) nodes.push_back(node);
      sort_and_unite(nodes);
      mesh_.node_sets.try_emplace(name, std::move(nodes));
    }
    for (const auto& [name, set] : mesh_.element_sets) {
      std::vector<int> nodes;
      for (const int e : set) {
        const Element& element = mesh_.elements[static_cast<std::size_t>(e)];
        nodes.insert(nodes.end(), mesh_.nodes_of(element), mesh_.nodes_of(element) + node_count(element.type));
      }
      sort_and_unite(nodes);
      mesh_.node_sets.try_emplace(name, std::move(nodes));
    }
  }

  // Newton, second and the file's length make the file's stress N/L^2 and its density N s^2/L^4.
  void scale() {
    for (std::size_t n = 0; n < mesh_.nodes.size(); ++n) {
      mesh_.nodes[n] *= length_unit_;
      if (mesh_.nodes[n].lpNorm<Eigen::Infinity>() < kFarthest) continue;
      const int raw = node_index_.find(mesh_.node_labels[n]);
      raw_.fail(raw_.node_locations[static_cast<std::size_t>(raw)],
                fmt::format("node {} at {:.3g} m", mesh_.node_labels[n], mesh_.nodes[n].lpNorm<Eigen::Infinity>()),
                fmt::format("coordinates below {:.0g} m", kFarthest));
    }
    const double area = length_unit_ * length_unit_;
    for (std::size_t m = 0; m < mesh_.materials.size(); ++m) {
      MeshMaterial& material = mesh_.materials[m];
      if (material.youngs_modulus) *material.youngs_modulus /= area;
      if (material.density) *material.density /= area * area;
      const bool is_finite =
          std::isfinite(material.youngs_modulus.value_or(0)) && std::isfinite(material.density.value_or(0));
      if (!is_finite)
        raw_.fail(raw_.material_locations[m], fmt::format("material '{}' with constants that overflow", material.name),
                  "constants in the consistent system of the length unit, newton and second");
    }
  }

  RawMesh& raw_;
  double length_unit_;
  const std::vector<StraightNode>& straight_;
  LabelIndex node_index_;
  std::unique_ptr<LabelIndex> element_index_;
  LabelIndex mark_index_;
  std::map<std::string, std::vector<int>> marks_of_;  // by set
  std::vector<int> node_index_of_;                    // index in mesh_.nodes, by index in raw_.nodes; -1: dropped
  std::vector<ElementFace> outer_;
  std::vector<Fault> faults_;
  Mesh mesh_;
};

}  // namespace

Mesh finished(RawMesh& raw, double length_unit) {
  const std::vector<StraightNode> straight = add_midside_nodes(raw);
  return Finisher(raw, length_unit, straight).mesh();
}

}  // namespace hersey::fem
