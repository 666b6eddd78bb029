#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "hersey/bearing/clearance.h"
#include "hersey/core/contract.h"
#include "hersey/core/input_error.h"
#include "hersey/model/plausibility.h"
#include "hersey/run/steady_motion.h"
#include "hersey/solver/reduced_coefficients.h"
#include "pad_bearing.h"
#include "pad_motion.h"

// A floating ring by itself: journal, ring and the ring's speed in one steady motion.
namespace hersey::study {
namespace {

using RingIndex = solver::Equations::Index;

RingIndex row_called(const run::SteadyMotion& motion, const std::string& name) {
  const auto at = std::find(motion.coordinates.begin(), motion.coordinates.end(), name);
  HERSEY_REQUIRE(at != motion.coordinates.end(), "a ring moves in a plane");
  return at - motion.coordinates.begin();
}

/// Small motions of a ring that rotates freely: films know its speed, not its angle (rings.3). Slow motions have that
/// speed as an unknown in the place of the angle (rings.4).
solver::Linearisation with_free_rotation(const run::SteadyMotion& motion, RingIndex rotation, bool is_slow) {
  solver::Linearisation linear = motion.small_motions;
  Eigen::MatrixXd K = over_coordinates(linear, linear.K), C = over_coordinates(linear, linear.C),
                  M = over_coordinates(linear, linear.M);
  K.col(rotation).setZero();
  if (is_slow) {
    K.col(rotation) = C.col(rotation);
    C.col(rotation) = M.col(rotation);
    M.col(rotation).setZero();
  }
  const Eigen::MatrixXd& Z = linear.Z;
  linear.K = Z.transpose() * K * Z;
  linear.C = Z.transpose() * C * Z;
  linear.M = Z.transpose() * M * Z;
  return linear;
}

RingState ring_state(const model::Composite& composite, const run::SteadyMotion& motion) {
  const model::Model& alone = *composite.alone;
  const mbd::JointObservation *ring = find_joint(alone, motion, composite.bearing.name + "_ring"),
                              *journal = find_joint(alone, motion, journal_joint);
  HERSEY_REQUIRE(ring != nullptr && journal != nullptr, "ring and journal move by joints");
  RingState state{.speed = ring->rate[2], .journal = journal->position.head<2>(), .centre = ring->position.head<2>()};
  const std::vector<std::pair<std::string, Eigen::Vector2d>> films{{"inner", state.journal - state.centre},
                                                                   {"outer", state.centre}};
  for (std::size_t k = 0; k < films.size(); ++k)
    state.films.push_back({.name = films[k].first,
                           .e = films[k].second,
                           .clearance = bearing::clearance(alone.bearings[k].film),
                           .film = motion.bearings[k].film,
                           .model = alone.bearings[k].film,
                           .fields = motion.fields[k]});
  return state;
}

}  // namespace

void solve_floating_ring(const model::Composite& composite, BearingSolution& solution) {
  if (!composite.alone) throw InputError(composite.alone_faults);
  const auto began = std::chrono::steady_clock::now();
  const auto& point = std::get<model::JournalPoint>(*composite.bearing.operating_point);
  const model::Model& alone = *composite.alone;
  const std::vector<std::string> axes{fmt::format("joint {}, x", journal_joint),
                                      fmt::format("joint {}, y", journal_joint)};
  const run::SteadyMotion motion =
      run::find_steady_motion(alone, point.load ? std::vector<std::string>{} : axes, most_iterations);
  solution.summary.iterations = motion.iterations;
  solution.model = alone.bearings.front().film;
  if (!motion.solved()) return solution.fail(fmt::format("bearing {}: {}", composite.bearing.name, motion.message));

  auto parts = std::make_shared<PadBearingSolution>();
  parts->kind = composite.kind;
  parts->ring = ring_state(composite, motion);
  parts->fields = motion.fields.front();
  parts->whirl_ratio = composite.whirl_ratio;
  bearing::SteadyState& state = solution.state;
  state.kind = composite.bearing.kind;
  state.film = motion.bearings.front().film;
  state.point.journal_speed = point.journal_speed;
  state.e = parts->ring->films.front().e;  // of the inner film, whose map and clearance circle are shown
  // The outer film is at rest in the shell's axes: its force on the shell is the journal's load.
  state.load = Eigen::Vector2d(motion.bearings[1].wrench_on_shell.segment<2>(3));
  if (point.load)
    state.point.load = state.load =
        *point.load * Eigen::Vector2d(std::cos(point.load_angle), std::sin(point.load_angle));

  const RingIndex rotation = row_called(motion, fmt::format("joint {}_ring, rotation", composite.bearing.name));
  const bool is_free = parts->ring->speed != 0;
  const solver::Linearisation whole = is_free ? with_free_rotation(motion, rotation, false) : motion.small_motions;
  const bool is_slow = composite.whirl_ratio == 0;
  const solver::Linearisation seen = is_free && is_slow ? with_free_rotation(motion, rotation, true) : whole;
  const double omega = composite.whirl_ratio * std::abs(point.journal_speed);
  const solver::ReducedCoefficients reduced = reduce(seen, journal_coordinates(motion), omega);
  state.coefficients = {reduced.K, reduced.C};
  parts->coordinates = motion.coordinates;
  parts->stiffness = over_coordinates(whole, whole.K);
  parts->damping = over_coordinates(whole, whole.C);
  parts->mass = over_coordinates(whole, whole.M);
  for (std::size_t k = 0; k < alone.bearings.size(); ++k)
    for (const std::string& warning :
         model::surface_warnings(alone.bearings[k], motion.bearings[k].film.p_max, motion.bearings[k].film.h_min))
      solution.warnings.push_back("bearing " + alone.bearings[k].name + ", " + warning);
  solution.pads = std::move(parts);
  solution.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  solution.set_solved(true);
}

}  // namespace hersey::study
