// Initial state of a mechanism, and its constraints that are redundant in all configurations.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "hersey/mbd/mechanism.h"
#include "mechanism/mechanism_parts.h"
#include "mechanism/redundancy.h"
#include "tree/start_of.h"

namespace hersey::mbd {

using solver::State;

solver::State MechanismParts::initial_state() const {
  solver::State state = start_of(spec, tree);
  const auto extend = [](Eigen::VectorXd& x, Index n) { x.conservativeResizeLike(Eigen::VectorXd::Zero(n)); };
  extend(state.q, nq), extend(state.v, nv), extend(state.vdot, nv);
  state.lambda.setZero(nlambda());
  return state;
}

void Mechanism::count_revolutions(State& state) const {
  const State start = state;
  constexpr double revolution = 2 * std::numbers::pi;
  for (const auto& drive : parts_->drives) {
    if (parts_->tree.links[parts_->tree.columns[drive.column].link].motion != Motion::revolute) continue;
    state.q[drive.q] += revolution * std::round((drive.motion.position(state.t) - state.q[drive.q]) / revolution);
  }
  // A coupling may follow another one.
  for (std::size_t pass = 0; pass < parts_->couplings.size(); ++pass)
    for (const Coupling& coupling : parts_->couplings)
      state.q[coupling.output_q()] += coupling.value(start) - coupling.value(state);
}

std::vector<Mechanism::Index> MechanismParts::given_coordinates() const {
  return columns_where([](const JointSpec& joint, int value) { return joint.is_given(value); });
}

std::vector<Mechanism::Index> MechanismParts::given_rates() const {
  return columns_where([](const JointSpec& joint, int value) { return joint.is_rate_given(value); });
}

/// Columns of the joints' values for which is_chosen(joint, value), those of deformations left out.
template <class Choose>
std::vector<Mechanism::Index> MechanismParts::columns_where(Choose is_chosen) const {
  std::vector<Index> chosen;
  for (const Link& link : tree.links) {
    if (link.joint < 0 || is_deformation(link.joint) || !is_chosen(spec.joints[link.joint], link.value)) continue;
    for (int c = 0; c < link.columns; ++c) chosen.push_back(link.first_v + c);
  }
  return chosen;
}

namespace {

/// Returns the difference between two values of a coordinate; for an orientation the angle between them.
double distance(const Coordinate& coordinate, bool is_rate, const std::vector<double>& a,
                const std::vector<double>& b) {
  if (coordinate.orientation && !is_rate)
    return rotation_exp(Vector3::Map(a.data())).angularDistance(rotation_exp(Vector3::Map(b.data())));
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

}  // namespace

std::vector<ChangedStart> Mechanism::changed_values(const State& start) {
  constexpr double round_off = 1e-10;
  MechanismParts& m = *parts_;
  m.motion.update(start);
  Observation observation;
  observation.joints.resize(m.spec.joints.size());
  m.observe_joint_coordinates(start, observation);
  const double fastest = m.largest_rate(start);
  std::vector<ChangedStart> changes;
  for (std::size_t j = 0; j < m.spec.joints.size(); ++j) {
    const JointSpec& joint = m.spec.joints[j];
    if (m.is_deformation(static_cast<int>(j))) continue;
    for (const Coordinate& coordinate : coordinates_of(joint.type))
      for (const bool is_rate : {false, true}) {
        if (!(is_rate ? joint.is_rate_given(coordinate.offset) : joint.is_given(coordinate.offset))) continue;
        const auto part = [&](const auto& all) {
          const double* first = all.data() + coordinate.offset;
          return std::vector<double>(first, first + coordinate.size);
        };
        ChangedStart change{{static_cast<int>(j)}, coordinate, is_rate, {}, {}, 0};
        change.given = part(is_rate ? joint.initial_rate : joint.initial);
        change.found = part(is_rate ? observation.joints[j].rate : observation.joints[j].position);
        const double size = (coordinate.rotational ? 1.0 : m.tree.length) * (is_rate ? fastest : 1.0);
        change.share = size > 0 ? distance(coordinate, is_rate, change.given, change.found) / size : 0;
        if (change.share > round_off) changes.push_back(std::move(change));
      }
  }
  return changes;
}

/// Returns the largest rate of those given and those at `start`, lengths divided by the mechanism's size [1/s].
double MechanismParts::largest_rate(const State& start) const {
  const State given = initial_state();
  double largest = 0;
  for (int k = 0; k < tree.nv; ++k) {
    const double size = tree.links[tree.columns[k].link].motion == Motion::prismatic ? tree.length : 1.0;
    largest = std::max({largest, std::abs(given.v[k]) / size, std::abs(start.v[k]) / size});
  }
  return largest;
}

bool MechanismParts::is_deformation(int joint) const {
  return std::find(spec.deforming.begin(), spec.deforming.end(), JointId{joint}) != spec.deforming.end();
}

std::vector<Mechanism::Index> MechanismParts::elastic_coordinates() const {
  std::vector<Index> stiff;
  for (const Link& link : tree.links)
    if (link.joint >= 0 && is_deformation(link.joint))
      for (int c = 0; c < link.columns; ++c) stiff.push_back(link.first_v + c);
  const std::vector<Index> internal = internal_coordinates();
  stiff.insert(stiff.end(), internal.begin(), internal.end());
  return stiff;
}

std::vector<Mechanism::Index> MechanismParts::internal_coordinates() const {
  std::vector<Index> internal(static_cast<std::size_t>(nv - tree.nv));
  std::iota(internal.begin(), internal.end(), tree.nv);
  return internal;
}

void MechanismParts::release_redundant_rows() {
  const solver::State start = initial_state();
  const std::vector<int> rows = redundant_rows(tree, motion, start, given_coordinates());
  if (rows.empty()) return;
  drop_rows(tree, rows);
  for (const Closure& closure : tree.closures) {
    if (closure.dropped.empty()) continue;
    Redundancy redundancy{{closure.joint}, {}, 0, 0};
    for (const ConstraintRow& row : closure.dropped)
      ++(row.kind == ConstraintRow::Kind::position ? redundancy.positions : redundancy.orientations);
    for (const SignedColumn& column : closure.pair.columns) {
      const JointId id{tree.links[tree.columns[column.column].link].joint};
      if (id.index < 0 || id.index == closure.joint) continue;
      if (std::find(redundancy.loop.begin(), redundancy.loop.end(), id) == redundancy.loop.end())
        redundancy.loop.push_back(id);
    }
    redundancy.loop.push_back({closure.joint});
    redundancies.push_back(std::move(redundancy));
  }
  std::vector<int> redundant;
  for (const Redundancy& redundancy : redundancies) redundant.push_back(redundancy.joint.index);
  shared_reactions.emplace(spec, tree, redundant);
}

double MechanismParts::opening_of(const Closure& closure) const {
  const Pose X_AB = motion.pose(closure.pair.a).inverse() * motion.pose(closure.pair.b);
  double worst = 0;
  for (const std::vector<ConstraintRow>* rows : {&closure.rows, &closure.dropped})
    for (const ConstraintRow& row : *rows) {
      const double scale = row.kind == ConstraintRow::Kind::position ? tree.length : 1.0;
      worst = std::max(worst, std::abs(row.value(X_AB)) / scale);
    }
  return worst;
}

/// Checks the omitted rows: a redundant row is satisfied by the others; a violation means that it is not redundant.
void MechanismParts::watch_dropped_rows() {
  constexpr double tolerance = 1e-5;
  for (const Redundancy& redundancy : redundancies) {
    const Closure& closure = tree.closures[tree.joints[redundancy.joint.index].closure];
    const double opening = opening_of(closure);
    if (opening <= tolerance) continue;
    constraint_violation = fmt::format(
        "joint {}: constraints that followed from others at the start have opened by {:.2g} of the mechanism's size; "
        "free a motion in its loop instead, for example with a spherical or cylindrical joint",
        spec.joints[redundancy.joint.index].name, opening);
  }
}

const std::vector<Redundancy>& Mechanism::redundancies() const { return parts_->redundancies; }

}  // namespace hersey::mbd
