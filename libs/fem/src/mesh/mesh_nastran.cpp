// Entries as in the quick reference guide of MSC Nastran (2012): GRID, CTETRA, CHEXA, CPENTA, CBAR, CBEAM, MAT1,
// PSOLID, PBAR, PBARL, PBEAM, PBEAML, CPYRAM, CORD1R, CORD2R and the like, GRDSET, PARAM, SET1, SET3, and SET and MPC
// of the case control section.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "element/element_kind.h"
#include "mesh/left_handed.h"
#include "mesh/mesh_readers.h"
#include "mesh/mesh_text.h"
#include "mesh/nastran_cards.h"
#include "mesh/nastran_entries.h"
#include "mesh/nastran_fields.h"
#include "mesh/nastran_sets.h"
#include "mesh/nastran_systems.h"
#include "mesh/nastran_ties.h"

namespace hersey::fem {
namespace {

constexpr double kSameModulus = 0.01;  // of G and E / (2 (1 + nu)), from which on Nastran warns too

/// Types of solids of each entry, by their number of nodes.
using NastranSolids = std::map<int, const ElementKind*>;

const std::map<std::string_view, NastranSolids>& solids() {
  static const std::map<std::string_view, NastranSolids> all = [] {
    std::map<std::string_view, NastranSolids> found;
    for (const ElementKind& kind : element_kinds())
      if (*kind.files.nastran) found[kind.files.nastran][kind.nodes] = &kind;
    return found;
  }();
  return all;
}

std::string expected_nodes(const NastranSolids& shapes) {
  return fmt::format("{} corners, then up to {} mid-side nodes, of which any may be left out", shapes.begin()->first,
                     shapes.rbegin()->first - shapes.begin()->first);
}

/// Kind of a coordinate system CORD1R, CORD2C and the like, and whether grid points define it.
std::optional<std::pair<bool, NastranSystems::Kind>> system_of(const std::string& entry) {
  if (entry.size() != 6 || !entry.starts_with("CORD") || (entry[4] != '1' && entry[4] != '2')) return std::nullopt;
  const bool is_by_grids = entry[4] == '1';
  if (entry[5] == 'R') return std::pair(is_by_grids, NastranSystems::Kind::rectangular);
  if (entry[5] == 'C') return std::pair(is_by_grids, NastranSystems::Kind::cylindrical);
  if (entry[5] == 'S') return std::pair(is_by_grids, NastranSystems::Kind::spherical);
  return std::nullopt;
}

int face_corners(const std::string& name) {
  if (name == "CTRIA3" || name == "CTRIA6" || name == "CTRIAR") return 3;
  if (name == "CQUAD4" || name == "CQUAD8" || name == "CQUADR") return 4;
  return 0;
}

class NastranReader {
 public:
  explicit NastranReader(const IncludeLoader& include) : include_(include) {}

  RawMesh read(std::string_view text, const std::string& name) {
    read_file(text, name, 0, begins_with_case_control(text));
    read_default_beams();
    systems_.resolve(raw_);
    mirror_left_handed(raw_);
    ties_.build(raw_, systems_);
    scale_densities();
    for (const auto& [kind, left] : left_out_)
      raw_.warn(left.location, fmt::format("{} {}", left.count, kind.substr(0, 8)), "grid points, solids and beams",
                "left out of the mesh; write masses, springs and couplings in the model file");
    return std::move(raw_);
  }

 private:
  [[noreturn]] void fail(const NastranCard& card, std::string found, std::string expected,
                         std::string suggestion = {}) const {
    raw_.fail({file_, card.line}, std::move(found), std::move(expected), std::move(suggestion));
  }

  void read_file(std::string_view text, const std::string& name, int depth, bool begins_with_case_control) {
    const int outer = std::exchange(file_, static_cast<int>(raw_.files.size()));
    raw_.files.push_back(name);
    LineScanner lines(text);
    if (begins_with_case_control) read_case_control(lines);
    NastranCards cards(lines);
    NastranCard card;
    while (!has_ended_ && cards.next(card)) {
      if (card.name.starts_with("INCLUDE"))
        read_include(card, text, depth);
      else
        read_card(card);
    }
    if (depth == 0 && !has_ended_)
      raw_.warn({file_, lines.number()}, "no ENDDATA at the end", "ENDDATA behind the last entry",
                "the file may be cut short: compare it with its source");
    file_ = outer;
  }

  static bool begins_with_case_control(std::string_view text) {
    LineScanner lines(text);
    std::string_view line;
    while (lines.next(line))
      if (is_begin_bulk(line)) return true;
    return false;
  }

  // Up to BEGIN BULK: "SET 4 = 1 THRU 10, 15", continued after a comma.
  void read_case_control(LineScanner& lines) {
    ties_.set_selecting();
    std::string_view line;
    while (lines.next(line)) {
      line = trimmed(line.substr(0, line.find('$')));
      const std::string word = upper(line.substr(0, 10));
      if (is_begin_bulk(line)) return;
      select_equations(line, lines.number());
      if (word.starts_with("INCLUDE"))
        raw_.warn({file_, lines.number()}, "INCLUDE before BEGIN BULK", "INCLUDE in the bulk data",
                  "ignored: the sets of the case control section in it are not in the mesh");
      if (!word.starts_with("SET ") || line.find('=') == std::string_view::npos) continue;
      NastranCard card;
      card.line = lines.number();
      std::string whole(line);
      while (whole.ends_with(',') && lines.next(line)) whole += trimmed(line.substr(0, line.find('$')));
      add_case_set(card, whole);
    }
  }

  // "MPC = 4", "MPC(STRUCTURE) = 4".
  void select_equations(std::string_view line, int number_of_line) {
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos || !upper(line.substr(0, 3)).starts_with("MPC")) return;
    const std::string_view name = trimmed(line.substr(0, std::min(equals, line.find('('))));
    long set = 0;
    if (name.size() == 3 && parse_integer(trimmed(line.substr(equals + 1)), set))
      ties_.select(set, {file_, number_of_line});
  }

  void add_case_set(const NastranCard& card, const std::string& line) {
    const std::size_t equals = line.find('=');
    long number_of_set = 0;
    if (!parse_integer(trimmed(std::string_view(line).substr(4, equals - 4)), number_of_set)) return;
    add_set(card, number_of_set, words_of(std::string_view(line).substr(equals + 1)));
  }

  // INCLUDE 'file': the name is longer than a field, so it is taken from the line itself.
  void read_include(const NastranCard& card, std::string_view text, int depth) {
    LineScanner again(text);
    std::string_view line;
    while (again.number() < card.line && again.next(line)) continue;
    std::string name(trimmed(line).substr(7));
    name = std::string(trimmed(name));
    std::erase_if(name, [](char c) { return c == '\'' || c == '"'; });
    std::string content;
    try {
      content = included_text(include_, name, depth);
    } catch (const std::runtime_error& error) {
      fail(card, fmt::format("INCLUDE of '{}': {}", name, error.what()), kIncludeExpected);
    }
    read_file(content, name, depth + 1, false);
  }

  void read_card(const NastranCard& card) {
    const bool is_system = system_of(card.name).has_value();
    if (is_system || !concerns_no_bulk(card.name)) require_sound(card);
    if (card.name == "GRID") return read_grid(card);
    if (is_system) return read_system(card);
    if (NastranTies::takes(card.name)) return ties_.add(raw_, file_, card);
    if (solids().contains(card.name)) return read_solid(card);
    if (card.name == "CBAR" || card.name == "CBEAM") return read_beam(card);
    if (const int corners = face_corners(card.name); corners > 0) return read_face(card, corners);
    if (card.name == "MAT1") return read_material(card);
    if (card.name == "PSOLID" || card.name == "PBAR" || card.name == "PBARL" || card.name == "PBEAM" ||
        card.name == "PBEAML")
      return read_property(card);
    if (card.name == "SET1") return add_set(card, integer(card, card.field(0)), members(card, 1));
    if (card.name == "SET3") return add_set(card, integer(card, card.field(0)), members(card, 2));
    check_other(card);
  }

  void require_sound(const NastranCard& card) const {
    if (card.mistake.empty()) return;
    raw_.fail({file_, card.line_of_mistake}, fmt::format("{} ({})", card.mistake, card.name.substr(0, 8)),
              "an entry's lines one after the other, eight fields of data in each (four where they are large)",
              "let the program that made the file write it anew");
  }

  void check_other(const NastranCard& card) {
    if (is_end(card.name)) {
      has_ended_ = true;
      return;
    }
    if (card.name == "GRDSET") return read_default_system(card);
    if (card.name == "PARAM" && equal_ignoring_case(card.field(0), "WTMASS")) read_mass_factor(card);
    if (card.name.starts_with("BEGIN")) require_no_superelement(card);
    if (card.name == "BAROR" || card.name == "BEAMOR") return read_default_property(card);
    if (is_axisymmetric(card.name))
      fail(card, fmt::format("{}, an axisymmetric element", card.name), "solids", "mesh the whole body with solids");
    if (changes_the_bulk(card.name))
      fail(card, card.name.substr(0, 20), "GRID, CTETRA, CPENTA, CPYRAM, CHEXA, CBAR or CBEAM, each written out",
           "mesh the body with these");
    if (is_other_material(card.name)) return read_other_material(card);
    if (concerns_no_bulk(card.name)) return;
    LeftOut& left = left_out_[card.name];
    if (left.count++ == 0) left.location = {file_, card.line};
  }

  // ENDDATA, also shortened.
  static bool is_end(std::string_view name) {
    return name.size() >= 4 && std::string_view("ENDDATA").starts_with(name);
  }

  // It may stand behind the grid points it concerns.
  void read_default_system(const NastranCard& card) {
    const NastranFields fields(raw_, file_, card);
    systems_.set_defaults(fields.integer_or(1, 0), fields.integer_or(5, 0));
  }

  void read_system(const NastranCard& card) {
    const NastranFields fields(raw_, file_, card);
    const auto [is_by_grids, kind] = *system_of(card.name);
    if (!is_by_grids) {
      std::array<Vector3, 3> points;
      for (std::size_t k = 0; k < 9; ++k) points[k / 3][static_cast<Eigen::Index>(k % 3)] = fields.number(2 + k);
      return systems_.add_by_points(fields.integer(0), kind, fields.integer_or(1, 0), points, fields.location());
    }
    for (const std::size_t first : {std::size_t{0}, std::size_t{4}})  // an entry may define two
      if (first == 0 || !card.field(first).empty())
        systems_.add_by_grids(fields.integer(first), kind,
                              {fields.integer(first + 1), fields.integer(first + 2), fields.integer(first + 3)},
                              fields.location());
  }

  // The property of beams that name none; it stands before or behind them.
  void read_default_property(const NastranCard& card) {
    if (card.field(1).empty()) return;
    const std::string property = fmt::format("pid_{}", integer(card, card.field(1)));
    (card.name == "BAROR" ? default_bar_ : default_beam_) = property;
  }

  void read_default_beams() {
    for (const auto& [property, beams] : {std::pair(default_bar_, &bars_), std::pair(default_beam_, &beams_)})
      for (const auto& [label, location] : *beams) {
        RawSet& set = raw_.element_sets[property.empty() ? fmt::format("pid_{}", label) : property];
        if (set.labels.empty()) set.location = location;
        set.labels.push_back({label, label, 1});
      }
  }

  // "BEGIN BULK SUPER=1" begins another body.
  void require_no_superelement(const NastranCard& card) const {
    std::string line = card.name;
    for (const std::string_view field : card.fields) line += upper(field);
    if (line.find("SUPER") != std::string::npos || line.find("AUXM") != std::string::npos)
      fail(card, "BEGIN of a superelement", "one body in one file", "write its bulk data to a file of its own");
  }

  // PARAM,WTMASS converts densities of weight into densities of mass.
  void read_mass_factor(const NastranCard& card) {
    mass_factor_ = number(card, 1);
    if (!(mass_factor_ > 0)) fail(card, fmt::format("WTMASS = {}", mass_factor_), "a factor > 0");
  }

  void scale_densities() {
    for (MeshMaterial& material : raw_.materials)
      if (material.density) *material.density *= mass_factor_;
  }

  long integer(const NastranCard& card, std::string_view text) const {
    return NastranFields(raw_, file_, card).integer_in(text);
  }

  double number(const NastranCard& card, std::size_t field) const {
    return NastranFields(raw_, file_, card).number(field);
  }

  void read_grid(const NastranCard& card) {
    const NastranFields fields(raw_, file_, card);
    const auto system = [&](std::size_t field) {
      return card.field(field).empty() ? std::optional<long>() : fields.integer(field);
    };
    const long label = fields.integer(0);
    const Vector3 r(fields.number(2), fields.number(3), fields.number(4));
    raw_.add_node(label, r, fields.location());
    const auto motion = system(5);
    systems_.add_grid(label, r, system(1), motion && *motion < 0 ? 0 : motion, fields.location());  // -1: of a fluid
  }

  // A field counts up to the last that is not empty.
  static std::size_t used_fields(const NastranCard& card, std::size_t from) {
    std::size_t end = card.fields.size();
    while (end > from && card.fields[end - 1].empty()) --end;
    return end - from;
  }

  void read_solid(const NastranCard& card) {
    const NastranSolids& shapes = solids().at(card.name);
    const int given = static_cast<int>(used_fields(card, 2));
    const auto found = shapes.lower_bound(given);  // behind the corners, any mid-side node may be left out
    if (found == shapes.end() || given < shapes.begin()->first)
      fail(card, fmt::format("{} {} with {} nodes", card.name, card.field(0), given), expected_nodes(shapes));
    const ElementKind& kind = *found->second;
    const std::vector<std::size_t>& order = kind.files.nastran_order;
    std::array<long, most_nodes> nodes{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(kind.nodes); ++k) {
      const std::string_view field = card.field(2 + (order.empty() ? k : order[k]));
      if (field.empty() && k < static_cast<std::size_t>(kind.corners))
        fail(card, fmt::format("{} {} without its corner {}", card.name, card.field(0), k + 1), expected_nodes(shapes));
      nodes[k] = field.empty() ? kLeftOut : integer(card, field);
    }
    add_element(card, kind.type, std::span<const long>(nodes.data(), static_cast<std::size_t>(kind.nodes)));
  }

  void read_beam(const NastranCard& card) {
    const std::array ends{integer(card, card.field(2)), integer(card, card.field(3))};
    if (!card.field(1).empty()) return add_element(card, ElementType::beam2, ends);
    const long label = integer(card, card.field(0));
    raw_.add_element(ElementType::beam2, label, ends, {file_, card.line});
    (card.name == "CBAR" ? bars_ : beams_).emplace_back(label, FileLocation{file_, card.line});
  }

  void add_element(const NastranCard& card, ElementType type, std::span<const long> nodes) {
    const long label = integer(card, card.field(0));
    raw_.add_element(type, label, nodes, {file_, card.line});
    add_to_property(card, label);
  }

  void add_to_property(const NastranCard& card, long label) {
    RawSet& set = raw_.element_sets[property_name(card)];
    if (set.labels.empty()) set.location = {file_, card.line};
    set.labels.push_back({label, label, 1});
  }

  // The property's number is the element's own where the field is empty.
  std::string property_name(const NastranCard& card) const {
    return fmt::format("pid_{}", integer(card, card.field(1).empty() ? card.field(0) : card.field(1)));
  }

  void read_face(const NastranCard& card, int corners) {
    std::array<long, 4> nodes{};
    for (std::size_t c = 0; c < static_cast<std::size_t>(corners); ++c) nodes[c] = integer(card, card.field(2 + c));
    const long label = integer(card, card.field(0));
    raw_.add_mark(label, std::span<const long>(nodes.data(), static_cast<std::size_t>(corners)), corners,
                  {file_, card.line});
    add_to_property(card, label);
  }

  // MID, E, G, nu, rho; of E, G and nu one may be empty.
  void read_material(const NastranCard& card) {
    const double E = number(card, 1), G = number(card, 2), rho = number(card, 4);
    const bool has_nu = !card.field(3).empty();
    const double nu = has_nu ? number(card, 3) : G > 0 && E > 0 ? E / (2 * G) - 1 : 0;
    const double modulus = E > 0 ? E : 2 * G * (1 + nu);
    const FileLocation location{file_, card.line};
    MeshMaterial& material = raw_.add_material(material_name(card, 0), location);
    const auto is_unsound = [&](std::string found, const char* expected) {
      raw_.unsound_materials.emplace(static_cast<int>(raw_.materials.size()) - 1,
                                     raw_.fault(location, std::move(found), expected));
    };
    if (!(modulus > 0) || !(nu > -1 && nu < 0.5))
      return is_unsound(fmt::format("MAT1 with E = {}, nu = {}", modulus, nu), "E > 0 and nu between -1 and 0.5");
    if (!(rho >= 0)) return is_unsound(fmt::format("MAT1 with the density {}", rho), "a density >= 0");
    material.youngs_modulus = modulus;
    material.poisson_ratio = nu;
    if (rho > 0) material.density = rho;
    const double G_isotropic = modulus / (2 * (1 + nu));
    if (G > 0 && std::abs(G - G_isotropic) > kSameModulus * G_isotropic)
      raw_.warn(location, fmt::format("MAT1 with E = {}, G = {}, nu = {}", modulus, G, nu), "G = E / (2 (1 + nu))",
                "G is left out");
    if (!has_nu && !(E > 0 && G > 0))
      raw_.warn(location, "MAT1 with one elastic constant", "two of E, G and nu", "nu is taken as 0");
    if (number(card, 7) != 0)
      raw_.warn(location, "MAT1 with structural damping GE", "E, G, nu and the density",
                "it is left out; give the body's damping in the model file");
  }

  // Elements of this material have no elastic constants; this is reported where they are needed.
  void read_other_material(const NastranCard& card) {
    const FileLocation location{file_, card.line};
    raw_.add_material(material_name(card, 0), location);
    raw_.warn(location, card.name, "MAT1, an isotropic material", "give the body's material in the model file");
  }

  std::string material_name(const NastranCard& card, std::size_t field) const {
    return fmt::format("mid_{}", integer(card, card.field(field)));
  }

  void read_property(const NastranCard& card) {
    if (card.name == "PSOLID" && equal_ignoring_case(card.field(6), "PFLUID"))
      fail(card, "PSOLID of a fluid", "solids alone");
    RawSection section{{file_, card.line},
                       fmt::format("pid_{}", integer(card, card.field(0))),
                       card.field(1).empty() ? "" : material_name(card, 1),
                       true};
    const auto [first, is_new] = properties_.try_emplace(section.element_set, card.line);
    if (!is_new)
      fail(card, fmt::format("property {} is already defined in line {}", card.field(0), first->second),
           "each property once");
    raw_.sections.push_back(std::move(section));
  }

  static std::vector<std::string_view> members(const NastranCard& card, std::size_t from) {
    std::vector<std::string_view> words;
    for (std::size_t k = from; k < card.fields.size(); ++k)
      if (!card.fields[k].empty()) words.push_back(card.fields[k]);
    return words;
  }

  // A set does not say whether its numbers are of grid points or of elements: both readings are kept.
  void add_set(const NastranCard& card, long number_of_set, const std::vector<std::string_view>& words) {
    if (!words.empty() && equal_ignoring_case(words[0], "ALL")) return;
    NastranSetWords read = read_set_words(words);
    if (!read.fault.empty()) fail(card, read.fault, "first <= last");
    if (read.other)
      return raw_.warn({file_, card.line}, fmt::format("'{}' in SET {}", *read.other, number_of_set),
                       "numbers of grid points or elements, also 1 THRU 10 EXCEPT 4", "the set is left out");
    RawSet set;
    set.location = {file_, card.line};
    set.is_of_either_kind = true;
    set.labels = std::move(read.labels);
    const std::string name = fmt::format("set_{}", number_of_set);
    raw_.node_sets[name] = set;
    raw_.element_sets[name] = std::move(set);
  }

  const IncludeLoader& include_;
  int file_ = 0;
  bool has_ended_ = false;                                   ///< true: ENDDATA was read
  double mass_factor_ = 1;                                   ///< PARAM,WTMASS
  std::string default_bar_, default_beam_;                   ///< properties of BAROR and BEAMOR
  std::vector<std::pair<long, FileLocation>> bars_, beams_;  ///< beams that name no property
  NastranSystems systems_;
  NastranTies ties_;
  std::map<std::string, int> properties_;  ///< line of each by its name
  struct LeftOut {
    FileLocation location;  ///< location of the first
    int count = 0;
  };
  std::map<std::string, LeftOut> left_out_;
  RawMesh raw_;
};

}  // namespace

RawMesh read_nastran(std::string_view text, const std::string& name, const IncludeLoader& include) {
  return NastranReader(include).read(text, name);
}

}  // namespace hersey::fem
