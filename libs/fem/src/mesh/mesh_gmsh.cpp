// Gmsh reference manual 4.8, section "File formats": MSH 2.2 (legacy) and 4.1.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <unordered_map>

#include "element/element_kind.h"
#include "mesh/mesh_readers.h"
#include "mesh/mesh_text.h"

namespace hersey::fem {
namespace {

constexpr std::array<const char*, 4> kGroupKinds = {"point", "curve", "surface", "volume"};
constexpr long kMostTags = 1000;  // on one entity or element; more is no mesh

/// One of Gmsh's element types.
struct GmshType {
  int dimension = 0;
  int nodes = 0;
  int corners = 0;                   ///< number of corners of a surface
  std::optional<ElementType> solid;  ///< none: serves to mark a surface, curve or point
  std::vector<std::size_t> order;    ///< index in Gmsh's numbering of each node in Abaqus' order; empty: the same
};

const std::map<long, GmshType>& gmsh_types() {
  static const std::map<long, GmshType> types = [] {
    std::map<long, GmshType> all = {
        {1, {1, 2, 2, {}, {}}}, {2, {2, 3, 3, {}, {}}},  {3, {2, 4, 4, {}, {}}},  {8, {1, 3, 2, {}, {}}},
        {9, {2, 6, 3, {}, {}}}, {10, {2, 9, 4, {}, {}}}, {15, {0, 1, 1, {}, {}}}, {16, {2, 8, 4, {}, {}}},
    };
    for (const ElementKind& kind : element_kinds())
      if (kind.files.gmsh) all[kind.files.gmsh] = {3, kind.nodes, 0, kind.type, kind.files.gmsh_order};
    return all;
  }();
  return types;
}

class GmshReader {
 public:
  GmshReader(std::string_view text, const std::string& name) : lines_(text) { raw_.files = {name}; }

  RawMesh read() {
    read_format();
    std::string_view line;
    while (lines_.next(line)) {
      line = trimmed(line);
      if (line.empty()) continue;
      if (line == "$PhysicalNames")
        read_names();
      else if (line == "$Entities")
        read_entities();
      else if (line == "$Nodes")
        is_old_ ? read_nodes_2() : read_nodes_4();
      else if (line == "$Elements")
        is_old_ ? read_elements_2() : read_elements_4();
      else if (line.front() == '$')
        pass_over(line);
      else
        fail(fmt::format("'{}'", line.substr(0, 40)), "a section, such as $Nodes");
    }
    make_beams_without_solids();
    return std::move(raw_);
  }

 private:
  [[nodiscard]] FileLocation here() const { return {0, lines_.number()}; }

  [[noreturn]] void fail(std::string found, std::string expected, std::string suggestion = {}) const {
    raw_.fail(here(), std::move(found), std::move(expected), std::move(suggestion));
  }

  // The next word, on this line or the next that has one; a line that begins with $ ends the section.
  std::string_view word() {
    while (true) {
      const std::size_t first = rest_.find_first_not_of(" \t\r");
      if (first != std::string_view::npos) {
        rest_.remove_prefix(first);
        const std::size_t end = std::min(rest_.find_first_of(" \t\r"), rest_.size());
        const std::string_view result = rest_.substr(0, end);
        rest_.remove_prefix(end);
        return result;
      }
      if (!lines_.next(rest_)) fail("the end of the file", "more numbers: the file is cut short");
    }
  }

  long integer() {
    const std::string_view text = word();
    long value = 0;
    if (!parse_integer(text, value)) fail(fmt::format("'{}'", text.substr(0, 40)), "a whole number");
    return value;
  }

  double number() {
    const std::string_view text = word();
    double value = 0;
    if (!parse_number(text, value)) fail(fmt::format("'{}'", text.substr(0, 40)), "a number");
    return value;
  }

  // A count of things each at least two bytes long, so that a wrong count does not ask for all memory.
  std::size_t count() {
    const long value = integer();
    if (value < 0 || static_cast<std::size_t>(value) > lines_.bytes_left() + rest_.size() + 1)
      fail(fmt::format("a count of {}", value), "no more than the file has room for: it is cut short or not a mesh");
    return static_cast<std::size_t>(value);
  }

  void end_section(std::string_view name) {
    rest_ = {};
    std::string_view line;
    while (lines_.next(line)) {
      line = trimmed(line);
      if (line.empty()) continue;
      if (line == name) return;
      break;
    }
    fail(fmt::format("'{}'", line.substr(0, 40)), std::string(name));
  }

  // Fields, comments and periodicity do not describe the mesh; other sections are unknown.
  void pass_over(std::string_view begin) {
    static constexpr std::array<std::string_view, 6> harmless = {
        "$Comments", "$Periodic", "$NodeData", "$ElementData", "$ElementNodeData", "$InterpolationScheme"};
    if (begin == "$PartitionedEntities")
      fail(std::string(begin), "a mesh that is not partitioned",
           "save it with Mesh.PartitionSplitMeshFiles = 0 and one partition");
    if (std::find(harmless.begin(), harmless.end(), begin) == harmless.end())
      raw_.warn(here(), fmt::format("a section {}", begin.substr(0, 40)), "nodes, elements and physical groups",
                "it is ignored");
    skip_section(begin);
  }

  void skip_section(std::string_view begin) {
    const std::string end = "$End" + std::string(begin.substr(1));
    std::string_view line;
    while (lines_.next(line))
      if (trimmed(line) == end) return;
    fail("the end of the file", end);
  }

  void read_format() {
    std::string_view line;
    while (lines_.next(line) && trimmed(line) != "$MeshFormat") {
      if (trimmed(line) == "$Comments")
        skip_section("$Comments");
      else if (!trimmed(line).empty())
        break;
    }
    if (trimmed(line) != "$MeshFormat") fail("no $MeshFormat at its beginning", "a Gmsh mesh, format 2.2 or 4.1");
    const std::string_view version = word();
    is_old_ = version == "2.2" || version == "2.1" || version == "2";
    const std::string save = "save it so: gmsh FILE -save -format msh41 -o OUT.msh";
    if (!is_old_ && version != "4.1") fail(fmt::format("format {}", version.substr(0, 20)), "format 2.2 or 4.1", save);
    if (integer() != 0) fail("a binary file", "an ASCII file", "save it with Mesh.Binary = 0");
    (void)integer();
    end_section("$EndMeshFormat");
  }

  void read_names() {
    const std::size_t names = count();
    for (std::size_t k = 0; k < names; ++k) {
      const long dimension = integer();
      const long tag = integer();
      const std::size_t first = rest_.find('"'), last = rest_.rfind('"');
      if (first == std::string_view::npos || last == first) fail("a physical group without a name", "\"name\"");
      names_[{dimension, tag}] = std::string(rest_.substr(first + 1, last - first - 1));
      rest_ = {};
    }
    end_section("$EndPhysicalNames");
  }

  // Only the physical groups of each entity matter here.
  void read_entities() {
    std::array<std::size_t, 4> entities{};
    for (std::size_t& number_of : entities) number_of = count();
    for (long dimension = 0; dimension < 4; ++dimension)
      for (std::size_t k = 0; k < entities[static_cast<std::size_t>(dimension)]; ++k) read_entity(dimension);
    end_section("$EndEntities");
  }

  void read_entity(long dimension) {
    const long tag = integer();
    const int corners = dimension == 0 ? 3 : 6;
    for (int k = 0; k < corners; ++k) (void)number();
    const std::size_t groups = count();
    for (std::size_t g = 0; g < groups; ++g) entity_groups_[{dimension, tag}].push_back(integer());
    if (dimension == 0) return;
    const std::size_t boundaries = count();
    for (std::size_t b = 0; b < boundaries; ++b) (void)integer();
  }

  void read_nodes_2() {
    const std::size_t nodes = count();
    for (std::size_t n = 0; n < nodes; ++n) {
      const long label = integer();
      read_node(label);
    }
    end_section("$EndNodes");
  }

  void read_node(long label) {
    const double x = number(), y = number(), z = number();
    raw_.add_node(label, {x, y, z}, here());
  }

  void read_nodes_4() {
    const std::size_t blocks = count();
    for (int k = 0; k < 3; ++k) (void)integer();
    std::vector<long> labels;
    for (std::size_t b = 0; b < blocks; ++b) {
      const long dimension = integer();
      (void)integer();
      const long parameters = integer() == 0 ? 0 : dimension;
      labels.resize(count());
      for (long& label : labels) label = integer();
      for (const long label : labels) {
        read_node(label);
        for (long k = 0; k < parameters; ++k) (void)number();
      }
    }
    end_section("$EndNodes");
  }

  const GmshType& type_of(long number_of_type) const {
    const auto type = gmsh_types().find(number_of_type);
    if (type != gmsh_types().end()) return type->second;
    const bool is_complete = number_of_type == 12 || number_of_type == 13;
    fail(fmt::format("elements of Gmsh's type {}", number_of_type),
         "tetrahedra, wedges and hexahedra of first order, or of second order without nodes on faces",
         is_complete ? "mesh with Mesh.SecondOrderIncomplete = 1" : "");
  }

  void read_elements_2() {
    const std::size_t elements = count();
    std::vector<long> groups;
    for (std::size_t e = 0; e < elements; ++e) {
      const long label = integer();
      const GmshType& type = type_of(integer());
      const long tags = integer();
      if (tags < 0 || tags > kMostTags) fail(fmt::format("{} tags", tags), "a few tags of an element");
      groups.clear();
      for (long t = 0; t < tags; ++t) {
        const long tag = integer();
        if (t == 0 && tag != 0) groups.push_back(tag);
      }
      read_element(label, type, groups);
    }
    end_section("$EndElements");
  }

  void read_elements_4() {
    const std::size_t blocks = count();
    for (int k = 0; k < 3; ++k) (void)integer();
    for (std::size_t b = 0; b < blocks; ++b) {
      const long dimension = integer();
      const std::vector<long>& groups = entity_groups_[{dimension, integer()}];
      const GmshType& type = type_of(integer());
      const std::size_t elements = count();
      for (std::size_t e = 0; e < elements; ++e) read_element(integer(), type, groups);
    }
    end_section("$EndElements");
  }

  void read_element(long label, const GmshType& type, const std::vector<long>& groups) {
    std::array<long, 20> nodes{}, ordered{};
    for (int k = 0; k < type.nodes; ++k) nodes[static_cast<std::size_t>(k)] = integer();
    for (std::size_t k = 0; k < static_cast<std::size_t>(type.nodes); ++k)
      ordered[k] = nodes[type.order.empty() ? k : type.order[k]];
    const std::span<const long> used(ordered.data(), static_cast<std::size_t>(type.nodes));
    if (type.solid)
      label = add_solid(*type.solid, label, used, groups);
    else
      raw_.add_mark(label, used, type.dimension == 2 ? type.corners : 0, here());
    if (type.dimension == 1) curve_locations_.push_back(here());
    for (const long group : groups)
      raw_.element_sets[group_name(type.dimension, std::abs(group))].labels.push_back({label, label, 1});
  }

  // Format 2.2 repeats an element for each of its physical groups: the second time it is the same one.
  long add_solid(ElementType type, long label, std::span<const long> nodes, const std::vector<long>& groups) {
    if (is_old_ && !groups.empty()) {
      std::size_t hash = nodes.size();
      for (const long node : nodes) hash = (hash ^ static_cast<std::size_t>(node)) * 0x9E3779B97F4A7C15ULL;
      const auto [first, is_new] = grouped_.try_emplace(hash, Grouped{raw_.elements.size(), groups.front()});
      if (!is_new && first->second.group != groups.front() && has_nodes(first->second.element, nodes))
        return raw_.elements[first->second.element].label;
    }
    raw_.add_element(type, label, nodes, here());
    return label;
  }

  [[nodiscard]] bool has_nodes(std::size_t element, std::span<const long> nodes) const {
    const RawElement& raw = raw_.elements[element];
    return node_count(raw.type) == static_cast<int>(nodes.size()) &&
           std::equal(nodes.begin(), nodes.end(), raw_.connectivity.begin() + static_cast<std::ptrdiff_t>(raw.first));
  }

  const std::string& group_name(int dimension, long tag) {
    std::string& name = names_[{dimension, tag}];
    if (name.empty()) name = fmt::format("{}_{}", kGroupKinds[static_cast<std::size_t>(dimension)], tag);
    return name;
  }

  // Lines mark curves of a solid; a mesh that has nothing else is one of beams.
  void make_beams_without_solids() {
    if (!raw_.elements.empty()) return;
    std::size_t curve = 0;
    for (const RawMark& mark : raw_.marks) {
      if (mark.corner_count > 0 || mark.node_count == 1) continue;
      const FileLocation location = curve_locations_[curve++];
      const long first = mark.nodes[0], last = mark.nodes[1], middle = mark.nodes[2];
      const bool has_middle = mark.node_count == 3;
      raw_.add_element(ElementType::beam2, mark.label, std::array{first, has_middle ? middle : last}, location);
      if (!has_middle) continue;
      raw_.add_element(ElementType::beam2, mark.label, std::array{middle, last}, location);
      raw_.elements.back().continues_another = true;
    }
    std::erase_if(raw_.marks, [](const RawMark& m) { return m.corner_count == 0 && m.node_count > 1; });
  }

  using Key = std::pair<long, long>;  // dimension, tag

  LineScanner lines_;
  std::string_view rest_;
  RawMesh raw_;
  bool is_old_ = false;
  std::map<Key, std::string> names_;
  std::map<Key, std::vector<long>> entity_groups_;
  struct Grouped {
    std::size_t element = 0;  ///< index in RawMesh::elements
    long group = 0;
  };
  std::unordered_map<std::size_t, Grouped> grouped_;  ///< by a hash of the nodes
  std::vector<FileLocation> curve_locations_;         ///< locations of the marks of one dimension
};

}  // namespace

RawMesh read_gmsh(std::string_view text, const std::string& name) { return GmshReader(text, name).read(); }

}  // namespace hersey::fem
