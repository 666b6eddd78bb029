// Keywords as in the CalculiX 2.20 manual, chapter 7; what Abaqus writes besides is said where it is read.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <stdexcept>
#include <utility>

#include "element/element_kind.h"
#include "mesh/abaqus_block.h"
#include "mesh/abaqus_keywords.h"
#include "mesh/abaqus_parts.h"
#include "mesh/mesh_readers.h"
#include "mesh/mesh_text.h"

namespace hersey::fem {
namespace {

enum class Role { solid, beam, mark };

struct AbaqusType {
  Role role = Role::solid;
  int nodes = 0;
  int corners = 0;
  ElementType type = ElementType::tet4;
};

// Element types without their variants: C3D8R, C3D8I and C3D8H have the shape of C3D8.
std::map<std::string_view, AbaqusType> beams_and_marks() {
  return {
      {"B31", {Role::beam, 2, 2, ElementType::beam2}},   {"B33", {Role::beam, 2, 2, ElementType::beam2}},
      {"B32", {Role::beam, 3, 2, ElementType::beam2}},   {"T3D2", {Role::mark, 2, 2, ElementType::beam2}},
      {"T3D3", {Role::mark, 3, 2, ElementType::beam2}},  {"CPS3", {Role::mark, 3, 3, ElementType::tet4}},
      {"CPS4", {Role::mark, 4, 4, ElementType::tet4}},   {"CPS6", {Role::mark, 6, 3, ElementType::tet4}},
      {"CPS8", {Role::mark, 8, 4, ElementType::tet4}},   {"CPE3", {Role::mark, 3, 3, ElementType::tet4}},
      {"CPE4", {Role::mark, 4, 4, ElementType::tet4}},   {"CPE6", {Role::mark, 6, 3, ElementType::tet4}},
      {"CPE8", {Role::mark, 8, 4, ElementType::tet4}},   {"S3", {Role::mark, 3, 3, ElementType::tet4}},
      {"S4", {Role::mark, 4, 4, ElementType::tet4}},     {"S6", {Role::mark, 6, 3, ElementType::tet4}},
      {"S8", {Role::mark, 8, 4, ElementType::tet4}},     {"STRI65", {Role::mark, 6, 3, ElementType::tet4}},
      {"M3D3", {Role::mark, 3, 3, ElementType::tet4}},   {"M3D4", {Role::mark, 4, 4, ElementType::tet4}},
      {"M3D6", {Role::mark, 6, 3, ElementType::tet4}},   {"M3D8", {Role::mark, 8, 4, ElementType::tet4}},
      {"SFM3D3", {Role::mark, 3, 3, ElementType::tet4}}, {"SFM3D4", {Role::mark, 4, 4, ElementType::tet4}},
      {"SFM3D6", {Role::mark, 6, 3, ElementType::tet4}}, {"SFM3D8", {Role::mark, 8, 4, ElementType::tet4}},
  };
}

const std::map<std::string_view, AbaqusType>& abaqus_types() {
  static const std::map<std::string_view, AbaqusType> types = [] {
    std::map<std::string_view, AbaqusType> all = beams_and_marks();
    for (const ElementKind& kind : element_kinds())
      if (*kind.files.abaqus) all[kind.files.abaqus] = {Role::solid, kind.nodes, kind.corners, kind.type};
    return all;
  }();
  return types;
}

class AbaqusReader {
 public:
  AbaqusReader(const IncludeLoader& include, const std::string& part) : include_(include), parts_of_file_(part) {}

  RawMesh read(std::string_view text, const std::string& name) {
    read_file(text, name, 0);
    parts_of_file_.require_found(raw_);
    warn_of_ignored_keywords();
    return std::move(raw_);
  }

 private:
  struct Keyword {
    std::string name;                               ///< upper case, without blanks: "SOLIDSECTION"
    std::map<std::string, std::string> parameters;  ///< by name in upper case; values as written
    FileLocation location;

    [[nodiscard]] bool has(const std::string& parameter) const { return parameters.contains(parameter); }
    [[nodiscard]] std::string value(const std::string& parameter) const {
      const auto found = parameters.find(parameter);
      return found == parameters.end() ? "" : found->second;
    }
  };

  [[nodiscard]] FileLocation here() const { return {file_, lines_->number()}; }

  [[noreturn]] void fail(std::string found, std::string expected, std::string suggestion = {}) const {
    raw_.fail(here(), std::move(found), std::move(expected), std::move(suggestion));
  }

  void read_file(std::string_view text, const std::string& name, int depth) {
    LineScanner lines(text);
    LineScanner* const outer_lines = std::exchange(lines_, &lines);
    const int outer_file = std::exchange(file_, static_cast<int>(raw_.files.size()));
    const std::string_view outer_last = std::exchange(last_line_, {});
    raw_.files.push_back(name);
    std::string_view line;
    while (next_line(line)) {
      if (is_blank(line)) continue;
      if (!is_keyword(line))
        fail(fmt::format("'{}'", trimmed(line).substr(0, 40)), "a keyword, such as *NODE",
             trimmed(line).starts_with('$') ? "bulk data of Nastran: give the file the ending .bdf" : "");
      current_ = keyword(line);
      read_block(depth);
    }
    if (!lines.ends_with_line()) warn_of_last_line();
    lines_ = outer_lines;
    file_ = outer_file;
    last_line_ = outer_last;
  }

  void warn_of_last_line() {
    if (is_blank(last_line_) || upper(trimmed(last_line_)).starts_with("*END")) return;
    raw_.warn(here(), fmt::format("a last line that does not end: '{}'", trimmed(last_line_).substr(0, 40)),
              "an end of line behind the last number", "the file may be cut short: compare it with its source");
  }

  bool next_line(std::string_view& line) {
    const bool is_there = lines_->next(line);
    if (is_there) last_line_ = line;
    return is_there;
  }

  static bool is_blank(std::string_view line) {
    line = trimmed(line);
    return line.empty() || line.starts_with("**");
  }
  static bool is_keyword(std::string_view line) { return trimmed(line).starts_with("*"); }

  // "*ELEMENT, TYPE=C3D10, ELSET=EALL"; a comma at the end continues on the next line.
  Keyword keyword(std::string_view line) {
    std::string whole(trimmed(line));
    Keyword result;
    result.location = here();
    result.name = upper(std::string_view(whole).substr(1, whole.find(',') - 1));
    std::erase_if(result.name, [](char c) { return c == ' ' || c == '\t'; });
    while (whole.ends_with(',') && next_line(line)) {
      if (parameters_of(result.name) != nullptr) require_parameters(line);
      whole += trimmed(line);
    }
    split_at_commas(whole, parts_);
    for (std::size_t k = 1; k < parts_.size(); ++k) {
      const std::size_t equals = parts_[k].find('=');
      std::string_view value = equals == std::string_view::npos ? "" : trimmed(parts_[k].substr(equals + 1));
      if (value.size() > 1 && value.front() == '"' && value.back() == '"') value = value.substr(1, value.size() - 2);
      result.parameters[upper(trimmed(parts_[k].substr(0, equals)))] = std::string(value);
    }
    return result;
  }

  // Data behind a keyword's line that ends in a comma would be taken for its parameters.
  void require_parameters(std::string_view line) {
    split_at_commas(line, parts_);
    static const std::set<std::string_view> without_value = {"GENERATE", "UNSORTED", "INTERNAL"};
    for (const std::string_view part : parts_)
      if (part.find('=') == std::string_view::npos && !without_value.contains(upper(part)))
        fail(fmt::format("'{}' after a keyword's line that ends in a comma", part.substr(0, 40)),
             "a parameter, NAME=value", "remove the comma at the end of the keyword's line");
  }

  // The next line of data of this keyword, split at commas into parts_; false when there is none.
  bool data() {
    std::string_view line;
    while (next_line(line)) {
      if (is_blank(line)) continue;
      if (is_keyword(line)) {
        lines_->back();
        return false;
      }
      split_at_commas(line, parts_);
      if (!parts_.empty()) return true;
    }
    return false;
  }

  void read_block(int depth) {
    const std::string& name = current_.name;
    if ((name == "NODE" || name == "ELEMENT") && current_.has("INPUT"))
      fail(fmt::format("*{} with INPUT", name), "its lines in this file, or *INCLUDE");
    if (parts_of_file_.passes_over(raw_, name, current_.location,
                                   [this](const char* p) { return current_.value(p); })) {
      if (parts_of_file_.is_reported(name)) count_passed_over(name);
      return skip_data();
    }
    check_parameters();
    if (name == "NODE")
      read_nodes();
    else if (name == "ELEMENT")
      read_elements();
    else if (name == "NSET")
      read_set(raw_.node_sets, current_.value("NSET"));
    else if (name == "ELSET")
      read_set(raw_.element_sets, current_.value("ELSET"));
    else if (name == "SURFACE")
      read_surface();
    else if (name == "MATERIAL")
      add_material();
    else if (name == "ELASTIC")
      read_elastic();
    else if (name == "DENSITY")
      read_density();
    else if (name == "SOLIDSECTION" || name == "BEAMSECTION")
      read_section();
    else if (ties_nodes(name) && !is_in_step_)
      add_abaqus_ties(raw_, block(), [this](const std::string& written) { return spelled(written); });
    else if (name == "SYSTEM")
      system_.set(raw_, block());
    else if (name == "INCLUDE")
      read_include(depth);
    else
      check_other(name);
    skip_data();
  }

  // The keyword read last with all of its data.
  AbaqusBlock block() {
    AbaqusBlock all{current_.name, current_.location, {}, {}};
    for (const auto& [name, value] : current_.parameters) {
      std::string without_blanks = name;
      std::erase_if(without_blanks, [](char c) { return c == ' ' || c == '\t'; });
      all.parameters[std::move(without_blanks)] = value;
    }
    while (data()) all.lines.push_back({here(), {parts_.begin(), parts_.end()}});
    return all;
  }

  // The rest of a block: data this reader has no use for.
  void skip_data() {
    std::string_view line;
    while (next_line(line)) {
      if (is_blank(line) || !is_keyword(line)) continue;
      lines_->back();
      return;
    }
  }

  void check_parameters() {
    const std::set<std::string_view>* const known = parameters_of(current_.name);
    if (known == nullptr) return;
    for (const auto& [name, value] : current_.parameters) {
      if (known->contains(name)) continue;
      // A range read as a list, or a set made of another one's nodes, is another set.
      if (current_.name == "NSET" || current_.name == "ELSET" || current_.name == "NODE" ||
          current_.name == "ELEMENT" || current_.name == "TIE")
        raw_.fail(current_.location, fmt::format("*{} with {}", current_.name, name.substr(0, 40)),
                  fmt::format("the parameters {}", fmt::join(*known, ", ")));
      raw_.warn(current_.location, fmt::format("*{} with {}", current_.name, name.substr(0, 40)),
                fmt::format("the parameters {}", fmt::join(*known, ", ")), "it is ignored");
    }
  }

  void check_other(const std::string& name) {
    if (changes_the_mesh(name))
      raw_.fail(current_.location, fmt::format("*{}", name), "nodes and elements written out, each on its line",
                "let the program that made the file write its mesh out");
    if (name == "STEP") is_in_step_ = true;
    if (name == "TRANSFORM" && current_.has("NSET")) raw_.transformed_sets.push_back(spelled(current_.value("NSET")));
    if (name == "INSTANCE") return read_instance();
    if (is_in_step_ || concerns_no_mesh(name)) return;
    count_passed_over(name);
  }

  void count_passed_over(const std::string& name) {
    PassedOver& passed = passed_over_[name];
    if (passed.count++ == 0) passed.location = current_.location;
  }

  void read_instance() {
    if (instance_count_++ > 0 && !parts_of_file_.is_chosen())
      raw_.fail(current_.location, "a second *INSTANCE", "one body in one file",
                "write each instance to a file of its own, or all without parts and assemblies");
    if (data())
      raw_.warn(current_.location, "an *INSTANCE with a position", "the part in its own axes",
                "the position is left out; place the body in the model file");
  }

  void warn_of_ignored_keywords() {
    for (const auto& [name, passed] : passed_over_)
      raw_.warn(passed.location, fmt::format("{} *{}", passed.count, name.substr(0, 40)),
                "nodes, elements, sets, surfaces, sections, elastic constants and densities",
                "ignored: what it says of the body is not in the mesh");
  }

  long integer(std::string_view text) const {
    long value = 0;
    if (!parse_integer(text, value)) fail(fmt::format("'{}'", text.substr(0, 40)), "a whole number");
    return value;
  }

  double number(std::string_view text) const {
    double value = 0;
    if (text.empty()) return 0;  // an empty field is zero
    if (!parse_number(text, value)) fail(fmt::format("'{}'", text.substr(0, 40)), "a number");
    return value;
  }

  // The name as it was first written: names differ by more than the case of their letters.
  const std::string& spelled(const std::string& name) {
    return spellings_.try_emplace(upper(name), name).first->second;
  }

  void read_nodes() {
    const std::string written = upper(current_.value("SYSTEM"));
    if (written.size() > 1 || std::string_view("RCS").find(written) == std::string_view::npos)
      fail(fmt::format("*NODE with SYSTEM={}", written.substr(0, 20)), "R, C or S");
    RawSet* const set = set_named(raw_.node_sets, current_.value("NSET"));
    while (data()) {
      const long label = integer(parts_[0]);
      Vector3 r = Vector3::Zero();
      for (std::size_t k = 1; k < std::min<std::size_t>(parts_.size(), 4); ++k)
        r[static_cast<Eigen::Index>(k) - 1] = number(parts_[k]);
      raw_.add_node(label, system_.in_basic(written.empty() ? 'R' : written[0], r), here());
      if (set != nullptr) set->labels.push_back({label, label, 1});
    }
  }

  RawSet* set_named(std::map<std::string, RawSet>& sets, const std::string& name) {
    if (name.empty()) return nullptr;
    const auto [set, is_new] = sets.try_emplace(spelled(name));
    if (is_new) set->second.location = current_.location;
    return &set->second;
  }

  AbaqusType element_type() const {
    const std::string written = upper(current_.value("TYPE"));
    std::string name = written;
    while (!name.empty() && std::isalpha(static_cast<unsigned char>(name.back())) != 0) name.pop_back();
    const auto type = abaqus_types().find(name);
    if (type != abaqus_types().end()) return type->second;
    raw_.fail(current_.location,
              written.empty() ? "*ELEMENT without TYPE" : fmt::format("elements of type {}", written),
              "C3D4, C3D10, C3D5, C3D6, C3D15, C3D8, C3D20 (also R, I, H), B31 or B32; shells only to mark faces");
  }

  // Elements that join two points without a volume, or give a point a mass, belong into the model file.
  static bool is_of_no_volume(const std::string& type) {
    constexpr std::array beginnings = {"SPRING", "DASHPOT", "MASS",   "ROTARYI", "CONN3D",
                                       "GAP",    "ITS",     "JOINTC", "DCOUP"};
    return std::any_of(beginnings.begin(), beginnings.end(), [&](const char* b) { return type.starts_with(b); });
  }

  void read_elements() {
    if (const std::string written = upper(current_.value("TYPE")); is_of_no_volume(written)) {
      return count_passed_over("ELEMENT of type " + written.substr(0, 20));
    }
    const AbaqusType type = element_type();
    RawSet* const set = set_named(raw_.element_sets, current_.value("ELSET"));
    std::vector<long> nodes;
    while (data()) {
      const FileLocation location = here();
      const long label = integer(parts_[0]);
      nodes.clear();
      for (std::size_t k = 1; k < parts_.size(); ++k) nodes.push_back(integer(parts_[k]));
      while (static_cast<int>(nodes.size()) < type.nodes && data())
        for (const std::string_view part : parts_) nodes.push_back(integer(part));
      // An Abaqus beam may name a further node that orients its section.
      const bool is_oriented = type.role == Role::beam && static_cast<int>(nodes.size()) == type.nodes + 1;
      if (static_cast<int>(nodes.size()) != type.nodes && !is_oriented)
        raw_.fail(location, fmt::format("element {} with {} nodes", label, nodes.size()),
                  fmt::format("{} nodes for {}", type.nodes, current_.value("TYPE")));
      add_element(type, label, nodes, location);
      if (set != nullptr) set->labels.push_back({label, label, 1});
    }
  }

  void add_element(const AbaqusType& type, long label, const std::vector<long>& nodes, FileLocation location) {
    if (type.role == Role::solid) raw_.add_element(type.type, label, nodes, location);
    if (type.role == Role::mark) raw_.add_mark(label, nodes, type.corners, location);
    if (type.role != Role::beam) return;
    raw_.add_element(type.type, label, std::span(nodes).first(2), location);
    if (type.nodes < 3) return;
    raw_.add_element(type.type, label, std::span(nodes).subspan(1, 2), location);
    raw_.elements.back().continues_another = true;
  }

  void read_set(std::map<std::string, RawSet>& sets, const std::string& name) {
    RawSet* const set = set_named(sets, name);
    if (set == nullptr) raw_.fail(current_.location, fmt::format("*{0} without {0}=name", current_.name), "a name");
    const bool generates = current_.has("GENERATE");
    while (data()) {
      if (generates)
        add_range(*set);
      else
        for (const std::string_view part : parts_) add_member(*set, part);
    }
  }

  void add_range(RawSet& set) {
    if (parts_.size() < 2) fail("a range of one number", "first, last, step");
    const LabelRange range{integer(parts_[0]), integer(parts_[1]), parts_.size() > 2 ? integer(parts_[2]) : 1};
    if (range.step < 1 || range.last < range.first || range.first < 0)
      fail(fmt::format("the range {}, {}, {}", range.first, range.last, range.step),
           "first <= last and a step of at least 1");
    set.labels.push_back(range);
  }

  // A number, or the name of another set; Abaqus may put the instance's name before it: Part-1-1.12.
  void add_member(RawSet& set, std::string_view part) {
    if (part.empty()) return;
    long label = 0;
    if (parse_label(part, label)) return set.labels.push_back({label, label, 1});
    set.sets.push_back(spelled(std::string(part)));
  }

  void read_surface() {
    const std::string name = current_.value("NAME");
    if (name.empty()) raw_.fail(current_.location, "*SURFACE without NAME", "NAME=name");
    if (equal_ignoring_case(current_.value("TYPE"), "NODE")) return read_set(raw_.node_sets, name);
    std::vector<RawSurfacePart>& surface = raw_.surfaces[spelled(name)];
    while (data()) {
      RawSurfacePart part;
      part.location = here();
      if (!parse_integer(parts_[0], part.element)) part.element_set = spelled(std::string(parts_[0]));
      if (parts_of_file_.is_of_another(part.element_set)) continue;
      if (parts_.size() > 1 && !parts_[1].empty()) part.face = face(parts_[1]);
      surface.push_back(std::move(part));
    }
    if (surface.empty() && parts_of_file_.is_chosen()) raw_.surfaces.erase(spelled(name));
  }

  int face(std::string_view text) const {
    const bool is_face = text.size() == 2 && (text[0] == 'S' || text[0] == 's') && text[1] >= '1' && text[1] <= '6';
    if (!is_face) fail(fmt::format("face '{}'", text.substr(0, 20)), "S1 to S6");
    return text[1] - '1';
  }

  void add_material() {
    const std::string name = current_.value("NAME");
    if (name.empty()) raw_.fail(current_.location, "*MATERIAL without NAME", "NAME=name");
    raw_.add_material(spelled(name), current_.location);
  }

  MeshMaterial& material() {
    if (raw_.materials.empty())
      raw_.fail(current_.location, fmt::format("*{} before any *MATERIAL", current_.name), "*MATERIAL first");
    return raw_.materials.back();
  }

  void read_elastic() {
    MeshMaterial& target = material();
    if (target.youngs_modulus) refuse_second();
    const std::string type = current_.value("TYPE");
    if (!type.empty() && !equal_ignoring_case(type, "ISO") && !equal_ignoring_case(type, "ISOTROPIC"))
      return raw_.warn(current_.location, fmt::format("*ELASTIC of type {}", type), "an isotropic material",
                       "give the body's material in the model file");
    if (!data() || parts_.size() < 2) fail("*ELASTIC without two numbers", "Young's modulus, Poisson's ratio");
    target.youngs_modulus = number(parts_[0]);
    target.poisson_ratio = number(parts_[1]);
    if (!(*target.youngs_modulus > 0) || !(*target.poisson_ratio > -1 && *target.poisson_ratio < 0.5))
      fail(fmt::format("Young's modulus {}, Poisson's ratio {}", *target.youngs_modulus, *target.poisson_ratio),
           "a modulus > 0 and a ratio between -1 and 0.5");
    warn_of_further_lines();
  }

  void read_density() {
    MeshMaterial& target = material();
    if (target.density) refuse_second();
    if (!data()) fail("*DENSITY without a number", "a density");
    target.density = number(parts_[0]);
    if (!(*target.density > 0)) fail(fmt::format("density {}", *target.density), "a density > 0");
    warn_of_further_lines();
  }

  [[noreturn]] void refuse_second() {
    raw_.fail(current_.location, fmt::format("a second *{} of material '{}'", current_.name, material().name),
              "each constant once");
  }

  void warn_of_further_lines() {
    if (data())
      raw_.warn(here(), fmt::format("a second line of *{} of material '{}'", current_.name, material().name),
                "constants that do not depend on temperature", "the first line is taken");
  }

  // A section without a material is reported where its elements need one.
  void read_section() {
    const std::string set = current_.value("ELSET"), name = current_.value("MATERIAL");
    if (set.empty()) raw_.fail(current_.location, fmt::format("*{} without ELSET", current_.name), "ELSET=name");
    raw_.sections.push_back({current_.location, spelled(set), name.empty() ? name : spelled(name)});
  }

  void read_include(int depth) {
    const std::string file = current_.value("INPUT");
    const FileLocation location = current_.location;
    std::string text;
    try {
      text = included_text(include_, file, depth);
    } catch (const std::runtime_error& error) {
      raw_.fail(location, fmt::format("*INCLUDE of '{}': {}", file, error.what()),
                fmt::format("INPUT={}", kIncludeExpected));
    }
    read_file(text, file, depth + 1);
  }

  const IncludeLoader& include_;
  LineScanner* lines_ = nullptr;
  int file_ = 0;
  AbaqusParts parts_of_file_;
  int instance_count_ = 0;
  bool is_in_step_ = false;
  AbaqusSystem system_;
  std::string_view last_line_;
  struct PassedOver {
    FileLocation location;  ///< location of the first
    int count = 0;
  };
  std::map<std::string, PassedOver> passed_over_;
  Keyword current_;
  std::vector<std::string_view> parts_;
  std::map<std::string, std::string> spellings_;
  RawMesh raw_;
};

}  // namespace

RawMesh read_abaqus(std::string_view text, const std::string& name, const IncludeLoader& include,
                    const std::string& part) {
  return AbaqusReader(include, part).read(text, name);
}

}  // namespace hersey::fem
