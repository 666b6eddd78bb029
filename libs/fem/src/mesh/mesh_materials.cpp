#include "mesh/mesh_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "hersey/core/spelling.h"

namespace hersey::fem {
namespace {

constexpr std::size_t kMostLabels = 5;  // listed in one message

constexpr int kNone = -1, kUnknown = -2;

class Assignment {
 public:
  Assignment(RawMesh& raw, const std::map<std::string, std::vector<int>>& marks, Mesh& mesh)
      : raw_(raw), marks_(marks), mesh_(mesh), material_(mesh.elements.size(), kNone) {
    for (const MeshMaterial& material : raw_.materials) names_.push_back(material.name);
  }

  void run() {
    if (raw_.sections.empty() && names_.size() == 1) return take_the_only_one();
    for (const RawSection& section : raw_.sections) apply(section);
    for (std::size_t e = 0; e < material_.size(); ++e) mesh_.elements[e].material = std::max(material_[e], kNone);
    if (!names_.empty() || !raw_.sections.empty()) report_missing();
    report_unsound();
  }

 private:
  // Faults of a material that no element has are ignored.
  void report_unsound() {
    for (const auto& [material, fault] : raw_.unsound_materials)
      if (std::find(material_.begin(), material_.end(), material) != material_.end())
        raw_.material_faults.push_back(fault);
  }

  void take_the_only_one() {
    for (Element& element : mesh_.elements) element.material = 0;
    if (!raw_.unsound_materials.empty()) raw_.material_faults.push_back(raw_.unsound_materials.begin()->second);
    raw_.warn(raw_.material_locations[0], fmt::format("material '{}', which no section gives to elements", names_[0]),
              "a section for the elements", "all elements are taken to be of it: the file has no other");
  }

  void apply(const RawSection& section) {
    const int material = index_of(section);
    const auto elements = mesh_.element_sets.find(section.element_set);
    if (elements == mesh_.element_sets.end()) {
      if (!section.may_be_unused && !marks_.contains(section.element_set)) report_set(section);
      return;
    }
    if (material == kUnknown && !elements->second.empty()) report_material(section);
    bool is_reported = false;
    for (const int e : elements->second) {
      int& given = material_[static_cast<std::size_t>(e)];
      const bool has_another = given >= 0 && material >= 0 && given != material;
      if (has_another && !is_reported) report_second(section, e);
      is_reported = is_reported || has_another;
      given = material;
    }
  }

  [[nodiscard]] int index_of(const RawSection& section) const {
    const auto found = std::find(names_.begin(), names_.end(), section.material);
    return found == names_.end() ? kUnknown : static_cast<int>(found - names_.begin());
  }

  void report_material(const RawSection& section) {
    add(section.location,
        section.material.empty()
            ? fmt::format("the section of '{}' names no material", section.element_set)
            : fmt::format("the section of '{}' names the material '{}', which the file does not define",
                          section.element_set, section.material),
        names_.empty() ? "a material that the file defines; it has none" : "a material of the file: " + one_of(names_),
        did_you_mean(section.material, names_));
  }

  void report_set(const RawSection& section) {
    std::vector<std::string> sets;
    for (const auto& [name, elements] : mesh_.element_sets) sets.push_back(name);
    add(section.location,
        fmt::format("a section of the element set '{}', which the file does not define", section.element_set),
        sets.empty() ? "a set of elements; the file has none" : "a set of elements: " + one_of(sets),
        did_you_mean(section.element_set, sets));
  }

  void report_second(const RawSection& section, int element) {
    const auto e = static_cast<std::size_t>(element);
    add(section.location,
        fmt::format("element {} gets the material '{}', but has '{}' by another section", mesh_.elements[e].label,
                    section.material, names_[static_cast<std::size_t>(material_[e])]),
        "one material for each element");
  }

  void report_missing() {
    std::vector<long> labels;
    FileLocation first;
    for (std::size_t e = 0; e < material_.size(); ++e) {
      const bool is_solid = mesh_.elements[e].type != ElementType::beam2;
      if (material_[e] != kNone || !is_solid) continue;
      if (labels.empty()) first = raw_.elements[e].location;
      labels.push_back(mesh_.elements[e].label);
    }
    if (labels.empty()) return;
    const std::size_t listed = std::min(labels.size(), kMostLabels);
    add(first,
        fmt::format("{} {} no material by any section: {}{}", labels.size(),
                    labels.size() == 1 ? "element has" : "elements have",
                    fmt::join(labels.begin(), labels.begin() + static_cast<std::ptrdiff_t>(listed), ", "),
                    listed < labels.size() ? ", ..." : ""),
        "a section with a material for each element");
  }

  void add(FileLocation location, std::string found, std::string expected, std::string suggestion = {}) {
    raw_.material_faults.push_back(raw_.fault(location, std::move(found), std::move(expected), std::move(suggestion)));
  }

  RawMesh& raw_;
  const std::map<std::string, std::vector<int>>& marks_;
  Mesh& mesh_;
  std::vector<std::string> names_;
  std::vector<int> material_;  ///< by element: index in the file's materials, or the reason why there is none
};

}  // namespace

void drop_unused_materials(Mesh& mesh) {
  std::vector<int> kept_index(mesh.materials.size(), -1);
  for (const Element& element : mesh.elements)
    if (element.material >= 0) kept_index[static_cast<std::size_t>(element.material)] = 0;
  std::vector<MeshMaterial> kept;
  for (std::size_t m = 0; m < kept_index.size(); ++m) {
    const MeshMaterial& material = mesh.materials[m];
    if (kept_index[m] < 0 && !(material.youngs_modulus && material.poisson_ratio && material.density)) continue;
    kept_index[m] = static_cast<int>(kept.size());
    kept.push_back(material);
  }
  for (Element& element : mesh.elements)
    if (element.material >= 0) element.material = kept_index[static_cast<std::size_t>(element.material)];
  mesh.materials = std::move(kept);
}

void assign_materials(RawMesh& raw, const std::map<std::string, std::vector<int>>& marks, Mesh& mesh) {
  mesh.materials = raw.materials;
  Assignment(raw, marks, mesh).run();
}

}  // namespace hersey::fem
