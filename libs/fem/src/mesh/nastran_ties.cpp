// Entries as in the quick reference guide of MSC Nastran (2012): RBE1, RBE2, RBE3, RBAR, RBAR1, RROD, MPC, MPCADD.
#include "mesh/nastran_ties.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>
#include <algorithm>

#include "mesh/mesh_text.h"
#include "mesh/nastran_fields.h"

namespace hersey::fem {
namespace {

constexpr const char* kAll = "123456";
constexpr double kSingular = 1e-10;     // share of the largest eigenvalue
constexpr double kUndetermined = 1e-6;  // share of a motion that the members do not determine

const Vector3& position_of(const RawMesh& raw, const NastranSystems& systems, long grid, FileLocation user) {
  const Vector3* const r = systems.position(grid);
  if (r == nullptr)
    raw.fail(user, fmt::format("the grid point {}, which the file does not define", grid), "a grid point of the file");
  return *r;
}

/// Direction of component '1' to '6' of a grid point, and whether it is a rotation.
std::pair<Vector3, bool> direction_of(const RawMesh& raw, NastranSystems& systems, long grid, char component) {
  const int k = component - '1';
  return {systems.directions(raw, grid).col(k % 3), k >= 3};
}

/// Fields from `from` on that are not empty; a blank line within an entry means nothing.
std::vector<std::size_t> used(const NastranCard& card, std::size_t from) {
  std::vector<std::size_t> fields;
  for (std::size_t k = from; k < card.fields.size(); ++k)
    if (!card.fields[k].empty()) fields.push_back(k);
  return fields;
}

bool is_integer(std::string_view text) {
  long value = 0;
  return parse_integer(text, value);
}

bool is_word(std::string_view text, const char* word) { return equal_ignoring_case(text, word); }

}  // namespace

bool NastranTies::takes(const std::string& entry) {
  static const std::set<std::string> all = {"RBE1", "RBE2", "RBE3", "RBAR", "RBAR1", "RROD", "MPC", "MPCADD"};
  return all.contains(entry);
}

void NastranTies::add(const RawMesh& raw, int file, const NastranCard& card) {
  const NastranFields fields(raw, file, card);
  if (card.name == "RBE1") return add_rbe1(raw, file, card);
  if (card.name == "RBE2") return add_rbe2(raw, file, card);
  if (card.name == "RBE3") return add_rbe3(raw, file, card);
  if (card.name == "MPC") return add_mpc(raw, file, card);
  if (card.name == "RROD") return rods_.push_back({fields.location(), fields.integer(1), fields.integer(2)});
  if (card.name == "MPCADD") {
    for (const std::size_t k : used(card, 1)) unions_[fields.integer(0)].push_back(fields.integer(k));
    return;
  }
  add_bar(raw, file, card);
}

void NastranTies::select(long set, FileLocation location) {
  if (selected_ && *selected_ != set)
    also_selected_ = {set, location};
  else
    selected_ = set;
}

// EID, GN1, CN1, GN2, CN2, ..., "UM", GM1, CM1, ...
void NastranTies::add_rbe1(const RawMesh& raw, int file, const NastranCard& card) {
  const NastranFields fields(raw, file, card);
  Rigid rigid{fields.location(), {}, {}};
  auto* target = &rigid.independent;
  const std::vector<std::size_t> given = used(card, 1);
  for (std::size_t k = 0; k < given.size(); ++k) {
    if (is_word(card.fields[given[k]], "UM")) {
      target = &rigid.dependent;
      continue;
    }
    if (k + 1 == given.size()) {  // ALPHA, of thermal expansion
      if (!is_integer(card.fields[given[k]])) break;
      fields.fail(fmt::format("grid point {} without components in RBE1", card.fields[given[k]]),
                  "pairs of a grid point and its components");
    }
    target->emplace_back(fields.integer(given[k]), fields.components(given[k + 1]));
    ++k;
  }
  rigid_.push_back(std::move(rigid));
}

// EID, GN, CM, GM1, GM2, ..., ALPHA.
void NastranTies::add_rbe2(const RawMesh& raw, int file, const NastranCard& card) {
  const NastranFields fields(raw, file, card);
  Rigid rigid{fields.location(), {{fields.integer(1), kAll}}, {}};
  const std::string components = fields.components(2);
  const std::vector<std::size_t> given = used(card, 3);
  for (std::size_t k = 0; k < given.size(); ++k) {
    const bool is_expansion = k + 1 == given.size() && !is_integer(card.fields[given[k]]);
    if (is_expansion) {
      (void)fields.number(given[k]);
      break;
    }
    rigid.dependent.emplace_back(fields.integer(given[k]), components);
  }
  rigid_.push_back(std::move(rigid));
}

// EID, -, REFGRID, REFC, WT1, C1, G1, G2, ..., WT2, C2, ..., "UM", ..., "ALPHA", ...
void NastranTies::add_rbe3(const RawMesh& raw, int file, const NastranCard& card) {
  const NastranFields fields(raw, file, card);
  Average average{fields.location(), fields.integer(2), fields.components(3), {}};
  Weighted member;
  const std::vector<std::size_t> given = used(card, 4);
  for (std::size_t k = 0; k < given.size(); ++k) {
    const std::string_view text = card.fields[given[k]];
    if (is_word(text, "UM") || is_word(text, "ALPHA")) break;
    if (!is_integer(text) || k == 0) {
      if (k + 1 == given.size()) fields.fail("a weight without components in RBE3", "WT, C, G1, G2, ...");
      member.weight = fields.number(given[k]);
      member.components = fields.components(given[++k]);
      continue;
    }
    member.grid = fields.integer(given[k]);
    average.members.push_back(member);
  }
  averages_.push_back(std::move(average));
}

// EID, GA, GB, CNA, CNB, CMA, CMB; RBAR1 has CB alone, of what hangs on GA.
void NastranTies::add_bar(const RawMesh& raw, int file, const NastranCard& card) {
  const NastranFields fields(raw, file, card);
  const long a = fields.integer(1), b = fields.integer(2);
  Rigid rigid{fields.location(), {}, {}};
  if (card.name == "RBAR1") {
    rigid.independent = {{a, kAll}};
    rigid.dependent = {{b, fields.components(3)}};
  } else {
    std::string of_a = fields.components(5), of_b = fields.components(6);
    rigid.independent = {{a, fields.components(3)}, {b, fields.components(4)}};
    if (of_a.empty() && of_b.empty()) of_a = of_b = kAll;  // all that are not independent
    rigid.dependent = {{a, of_a}, {b, of_b}};
  }
  rigid_.push_back(std::move(rigid));
}

// SID, G1, C1, A1, G2, C2, A2, -, -, G3, C3, A3, ...
void NastranTies::add_mpc(const RawMesh& raw, int file, const NastranCard& card) {
  const NastranFields fields(raw, file, card);
  Equation equation{fields.location(), {}};
  for (std::size_t line = 0; line < card.fields.size(); line += 8)
    for (const std::size_t first : {line + 1, line + 4}) {
      if (card.field(first).empty()) continue;
      const long component = fields.integer_or(first + 1, 0);
      if (component < 0 || component > 6)
        fields.fail(fmt::format("component {} in MPC", component), "1 to 6, or 0 of a scalar point");
      equation.terms.push_back({fields.integer(first), component, fields.number(first + 2)});
    }
  equations_[fields.integer(0)].push_back(std::move(equation));
}

void NastranTies::build(RawMesh& raw, NastranSystems& systems) {
  for (const Rigid& rigid : rigid_) build_rigid(raw, systems, rigid);
  for (const Average& average : averages_) build_average(raw, systems, average);
  for (const Rod& rod : rods_) build_rod(raw, systems, rod);
  build_equations(raw, systems);
}

// All grid points of the element move as one body with six coordinates; the independent components determine them, the
// dependent ones follow.
void NastranTies::build_rigid(RawMesh& raw, NastranSystems& systems, const Rigid& rigid) const {
  if (rigid.independent.empty() || rigid.dependent.empty()) return;
  std::size_t coordinates = 0;
  for (const auto& [grid, components] : rigid.independent) coordinates += components.size();
  if (coordinates < 6)
    raw.fail(rigid.location, fmt::format("a rigid element with {} independent components", coordinates),
             "six of them, which determine a rigid motion");
  const bool is_one = rigid.independent.size() == 1;
  const long body = is_one ? rigid.independent.front().first : raw.new_reference();
  const Vector3 origin = position_of(raw, systems, rigid.independent.front().first, rigid.location);
  const auto tie = [&](const std::vector<std::pair<long, Components>>& members) {
    for (const auto& [grid, components] : members) {
      const Vector3 r = position_of(raw, systems, grid, rigid.location);
      for (const char component : components) {
        const auto [direction, is_rotation] = direction_of(raw, systems, grid, component);
        raw.add_rigid_tie(grid, r, body, origin, direction, is_rotation, rigid.location);
      }
    }
  };
  if (!is_one) tie(rigid.independent);
  tie(rigid.dependent);
}

// The reference moves as the rigid motion q nearest to its members, A q = sum w (P T)^T P u.
void NastranTies::build_average(RawMesh& raw, NastranSystems& systems, const Average& average) const {
  const Vector3 origin = position_of(raw, systems, average.grid, average.location);
  double size = 0;
  for (const Weighted& member : average.members)
    size = std::max(size, (position_of(raw, systems, member.grid, average.location) - origin).norm());
  if (!(size > 0)) size = 1;
  struct Row {
    long grid;
    bool is_rotation;
    Vector3 direction;
    Vector6 of_motion;  ///< component along it of each rigid motion (d, size theta)
    double weight;
  };
  std::vector<Row> rows;
  Matrix6 A = Matrix6::Zero();
  for (const Weighted& member : average.members)
    for (const char component : member.components) {
      const auto [direction, is_rotation] = direction_of(raw, systems, member.grid, component);
      const Vector3 arm = position_of(raw, systems, member.grid, average.location) - origin;
      Vector6 row = Vector6::Zero();
      row.head<3>() = is_rotation ? Vector3(Vector3::Zero()) : direction;
      row.tail<3>() = is_rotation ? direction : Vector3(arm.cross(direction) / size);
      A += member.weight * row * row.transpose();
      rows.push_back(
          {member.grid, is_rotation, is_rotation ? Vector3(size * direction) : direction, row, member.weight});
    }
  const Eigen::SelfAdjointEigenSolver<Matrix6> of_A(A);
  const Vector6& lambda = of_A.eigenvalues();
  const Eigen::Array<bool, 6, 1> is_determined = lambda.array() > kSingular * lambda[5];
  const Vector6 inverse_lambda = is_determined.select(lambda.cwiseInverse(), Vector6(Vector6::Zero()));
  const Matrix6 inverse = of_A.eigenvectors() * inverse_lambda.asDiagonal() * of_A.eigenvectors().transpose();
  for (const char component : average.components) {
    const auto [direction, is_rotation] = direction_of(raw, systems, average.grid, component);
    RawTie tie{average.location, {{average.grid, is_rotation, direction}}};
    Vector6 wanted = Vector6::Zero();
    wanted.segment<3>(is_rotation ? 3 : 0) = is_rotation ? Vector3(direction / size) : direction;
    const Vector6 share = inverse * wanted;
    if (!((A * share - wanted).norm() < kUndetermined * wanted.norm()))
      raw.fail(average.location,
               "an RBE3 whose grid points and components do not determine the motion of its reference",
               "at least three grid points that are not on one line, with components 123");
    for (const Row& row : rows)
      tie.terms.push_back({row.grid, row.is_rotation, -row.weight * share.dot(row.of_motion) * row.direction});
    raw.ties.push_back(std::move(tie));
  }
}

void NastranTies::build_rod(RawMesh& raw, const NastranSystems& systems, const Rod& rod) const {
  const Vector3 along = position_of(raw, systems, rod.b, rod.location) - position_of(raw, systems, rod.a, rod.location);
  if (!(along.norm() > 0)) raw.fail(rod.location, "an RROD without length", "two grid points at different positions");
  const Vector3 direction = along.normalized();
  raw.ties.push_back({rod.location, {{rod.a, false, direction}, {rod.b, false, -direction}}});
}

std::set<long> NastranTies::chosen_sets(RawMesh& raw) const {
  if (equations_.empty()) return {};
  const FileLocation first = equations_.begin()->second.front().location;
  if (also_selected_)
    raw.warn(also_selected_->second, fmt::format("MPC = {} beside MPC = {}", also_selected_->first, *selected_),
             "the same equations in all subcases", fmt::format("the body has those of {}", *selected_));
  if (!selected_ && !selects_ && equations_.size() == 1) {
    raw.warn(first, fmt::format("MPC {}, which no case control section selects", equations_.begin()->first),
             "`MPC = number` before BEGIN BULK", "it is taken to hold: the file has no other");
    return {equations_.begin()->first};
  }
  if (!selected_) {
    raw.warn(first, fmt::format("{} sets of MPC, none of them selected", equations_.size()),
             "`MPC = number` before BEGIN BULK", "none of them holds");
    return {};
  }
  std::set<long> chosen;
  std::vector<long> open{*selected_};
  while (!open.empty()) {
    const long set = open.back();
    open.pop_back();
    if (!chosen.insert(set).second) continue;
    if (const auto found = unions_.find(set); found != unions_.end())
      open.insert(open.end(), found->second.begin(), found->second.end());
  }
  return chosen;
}

void NastranTies::build_equations(RawMesh& raw, NastranSystems& systems) {
  const std::set<long> chosen = chosen_sets(raw);
  for (const auto& [set, equations] : equations_) {
    if (!chosen.contains(set)) continue;
    for (const Equation& equation : equations) {
      RawTie tie{equation.location, {}};
      for (const auto& [grid, component, factor] : equation.terms) {
        if (component == 0) {
          tie.terms.push_back({grid, false, factor * Vector3::UnitX()});
          continue;
        }
        (void)position_of(raw, systems, grid, equation.location);
        const auto [direction, is_rotation] = direction_of(raw, systems, grid, static_cast<char>('0' + component));
        tie.terms.push_back({grid, is_rotation, factor * direction});
      }
      raw.ties.push_back(std::move(tie));
    }
  }
}

}  // namespace hersey::fem
