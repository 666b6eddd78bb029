// Gmsh reference manual 4.8, section "MSH file format version 2 (Legacy)": an element in two groups stands twice.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "element/element_kind.h"
#include "hersey/core/contract.h"
#include "hersey/core/write_file.h"
#include "hersey/fem/gmsh_file.h"
#include "hersey/fem/skin.h"

namespace hersey::fem {
namespace {

long gmsh_number_of_face(std::size_t nodes) {
  switch (nodes) {
    case 3:
      return 2;
    case 4:
      return 3;
    case 6:
      return 9;
    default:
      return 16;
  }
}

class GmshWriter {
 public:
  explicit GmshWriter(const Mesh& mesh) : mesh_(mesh), groups_of_(mesh.elements.size()) {}

  std::string text() {
    add_groups();
    std::string text = fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n");
    if (!groups_.empty()) {
      fmt::format_to(std::back_inserter(text), "$PhysicalNames\n{}\n", groups_.size());
      for (const auto& [dimension, group, name] : groups_)
        fmt::format_to(std::back_inserter(text), "{} {} \"{}\"\n", dimension, group, name);
      text += "$EndPhysicalNames\n";
    }
    fmt::format_to(std::back_inserter(text), "$Nodes\n{}\n", mesh_.nodes.size());
    for (std::size_t n = 0; n < mesh_.nodes.size(); ++n)
      fmt::format_to(std::back_inserter(text), "{} {} {} {}\n", mesh_.node_labels[n], mesh_.nodes[n].x(),
                     mesh_.nodes[n].y(), mesh_.nodes[n].z());
    add_solids();
    add_surface_marks();
    add_points();
    fmt::format_to(std::back_inserter(text), "$EndNodes\n$Elements\n{}\n{}$EndElements\n", count_, elements_);
    return text;
  }

 private:
  struct Group {
    int dimension, number;
    std::string name;
  };

  int add_group(int dimension, const std::string& name) {
    groups_.push_back({dimension, static_cast<int>(groups_.size()) + 1, name});
    return groups_.back().number;
  }

  // Node sets that follow from a set of elements or a surface of their name are not written: reading makes them.
  void add_groups() {
    for (const auto& [name, set] : mesh_.element_sets) {
      if (set.empty()) continue;
      const int group = add_group(3, name);
      for (const int e : set) groups_of_[static_cast<std::size_t>(e)].push_back(group);
    }
    for (const auto& [name, faces] : mesh_.surfaces)
      if (!faces.empty()) surfaces_.emplace_back(add_group(2, name), &faces);
    for (const auto& [name, nodes] : mesh_.node_sets)
      if (!nodes.empty() && !mesh_.element_sets.contains(name) && !mesh_.surfaces.contains(name))
        points_.emplace_back(add_group(0, name), &nodes);
  }

  template <typename Nodes>
  void add_element(long label, long type, int group, const Nodes& nodes) {
    // Gmsh wants an entity too; one per group.
    fmt::format_to(std::back_inserter(elements_), "{} {} 2 {} {}", label, type, group, group + 1);
    for (const int node : nodes)
      fmt::format_to(std::back_inserter(elements_), " {}", mesh_.node_labels[static_cast<std::size_t>(node)]);
    elements_ += '\n';
    ++count_;
  }

  void add_solids() {
    for (const Element& element : mesh_.elements) next_ = std::max(next_, element.label + 1);
    for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
      const Element& element = mesh_.elements[e];
      const ElementInFiles& solid = kind_of(element.type).files;
      HERSEY_REQUIRE(solid.gmsh, "a solid");
      std::vector<int> nodes(mesh_.nodes_of(element), mesh_.nodes_of(element) + node_count(element.type));
      for (std::size_t k = 0; k < solid.gmsh_order.size(); ++k) nodes[solid.gmsh_order[k]] = mesh_.nodes_of(element)[k];
      add_element(element.label, solid.gmsh, groups_of_[e].empty() ? 0 : groups_of_[e].front(), nodes);
      for (std::size_t g = 1; g < groups_of_[e].size(); ++g) add_element(next_++, solid.gmsh, groups_of_[e][g], nodes);
    }
  }

  void add_surface_marks() {
    for (const auto& [group, faces] : surfaces_)
      for (const ElementFace face : *faces) {
        const std::vector<int> nodes = nodes_of(mesh_, face);
        add_element(next_++, gmsh_number_of_face(nodes.size()), group, nodes);
      }
  }

  void add_points() {
    for (const auto& [group, nodes] : points_)
      for (const int node : *nodes) add_element(next_++, 15, group, std::array{node});
  }

  const Mesh& mesh_;
  std::vector<Group> groups_;
  std::vector<std::vector<int>> groups_of_;  // of each element
  std::vector<std::pair<int, const std::vector<ElementFace>*>> surfaces_;
  std::vector<std::pair<int, const std::vector<int>*>> points_;
  std::string elements_;
  std::size_t count_ = 0;
  long next_ = 1;
};

}  // namespace

void write_gmsh(const std::filesystem::path& path, const Mesh& mesh) {
  try {
    write_file(path, {GmshWriter(mesh).text()});
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: cannot be written: {}", path.string(), error.what()));
  }
}

}  // namespace hersey::fem
