#include "pad_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hersey/bearing/clearance.h"
#include "hersey/core/contract.h"
#include "hersey/core/error_text.h"
#include "hersey/core/input_error.h"
#include "hersey/core/scalar_function.h"
#include "hersey/core/two_pi.h"
#include "hersey/solver/reduced_coefficients.h"

namespace hersey::study {

const mbd::JointObservation* find_joint(const model::Model& model, const run::SteadyMotion& motion,
                                        const std::string& name) {
  const auto found =
      std::find_if(model.joints.begin(), model.joints.end(), [&](const model::Joint& j) { return j.name == name; });
  return found == model.joints.end() ? nullptr : &motion.joints[static_cast<std::size_t>(found - model.joints.begin())];
}

double tilt_of_pad(const model::Composite& composite, std::size_t k, const PadMotion& found) {
  if (!std::isnan(found.fixed_tilts[k])) return found.fixed_tilts[k];
  const mbd::JointObservation* pivot = find_joint(found.alone, found.motion, composite.pads[k] + "_pivot");
  HERSEY_REQUIRE(pivot != nullptr, "a pad has a pivot");
  return pivot->position[pivot->position.size() - 1];
}

Eigen::Vector2d force_on_pad(const model::Composite& composite, std::size_t k, const PadMotion& found) {
  return Eigen::Rotation2Dd(tilt_of_pad(composite, k, found)) *
         Eigen::Vector2d(found.motion.bearings[k].wrench_on_shell.segment<2>(3));
}

namespace {

/// Names of the coordinates of the journal's centre.
std::vector<std::string> journal_axes() {
  return {fmt::format("joint {}, x", journal_joint), fmt::format("joint {}, y", journal_joint)};
}

}  // namespace

std::vector<solver::Equations::Index> journal_coordinates(const run::SteadyMotion& motion) {
  std::vector<solver::Equations::Index> found;
  for (const std::string& name : journal_axes()) {
    const auto at = std::find(motion.coordinates.begin(), motion.coordinates.end(), name);
    HERSEY_REQUIRE(at != motion.coordinates.end(), "the journal moves in a plane");
    found.push_back(at - motion.coordinates.begin());
  }
  return found;
}

Eigen::MatrixXd over_coordinates(const solver::Linearisation& linear, const Eigen::MatrixXd& A) {
  const Eigen::MatrixXd along = linear.Z.completeOrthogonalDecomposition().pseudoInverse();
  return along.transpose() * A * along;
}

model::Model starting_at(model::Model alone, const run::SteadyMotion& motion) {
  for (std::size_t k = 0; k < alone.joints.size(); ++k) {
    const mbd::JointValues& position = motion.joints[k].position;
    for (model::InitialValue& initial : alone.joints[k].initial)
      if (static_cast<Eigen::Index>(initial.value.size()) == position.size())
        initial.value.assign(position.begin(), position.end());
  }
  return alone;
}

bool pads_return(const run::SteadyMotion& motion, const std::vector<std::string>& of_shaft) {
  const auto is_of_shaft = [&](const std::string& coordinate) {
    return std::any_of(of_shaft.begin(), of_shaft.end(), [&](const std::string& joint) {
      return coordinate.starts_with(fmt::format("joint {},", joint));
    });
  };
  // With the shaft at rest, pads as they bend while they move on their pivots.
  std::vector<Eigen::Index> of_pads, on_pivots;
  for (std::size_t row = 0; row < motion.coordinates.size(); ++row) {
    if (is_of_shaft(motion.coordinates[row])) continue;
    if (motion.coordinates[row].starts_with("joint ")) on_pivots.push_back(static_cast<Eigen::Index>(of_pads.size()));
    of_pads.push_back(static_cast<Eigen::Index>(row));
  }
  if (on_pivots.empty()) return true;
  const solver::Linearisation& linear = motion.small_motions;
  solver::Linearisation pads;
  pads.K = over_coordinates(linear, linear.K)(of_pads, of_pads);
  pads.C = over_coordinates(linear, linear.C)(of_pads, of_pads);
  pads.M = Eigen::MatrixXd::Zero(pads.K.rows(), pads.K.cols());
  pads.Z = Eigen::MatrixXd::Identity(pads.K.rows(), pads.K.cols());
  const solver::ReducedCoefficients reduced = solver::reduce(pads, on_pivots, 0);
  const Eigen::VectorXcd rates = reduced.C.fullPivLu().solve(reduced.K).eigenvalues();
  return rates.real().minCoeff() > 0;
}

solver::Linearisation mean_over_grids(const model::Model& held, const run::SteadyMotion& motion,
                                      const std::vector<std::string>& released) {
  constexpr int positions = 4;
  solver::Linearisation mean = motion.small_motions;
  int count = 1;
  for (int m = 1; m < positions; ++m) {
    model::Model turned = held;
    for (model::Bearing& pad : turned.bearings)
      pad.film.grid = film::turned(pad.film.grid, static_cast<double>(m) / positions);
    const run::SteadyMotion there = run::find_steady_motion(turned, released, most_iterations);
    if (!there.solved()) continue;
    const solver::Linearisation& other = there.small_motions;
    mean.K += mean.Z.transpose() * over_coordinates(other, other.K) * mean.Z;
    mean.C += mean.Z.transpose() * over_coordinates(other, other.C) * mean.Z;
    ++count;
  }
  mean.K /= count, mean.C /= count;
  return mean;
}

namespace {

/// Fixes a pad at a tilt: its pivot carries what the film does, and nothing of it moves.
void fix_pad(model::Model& alone, const std::string& pad, double tilt) {
  const std::string pivot = pad + "_pivot";
  std::erase_if(alone.forces, [&](const model::Force& force) { return force.name == pad + "_friction"; });
  for (model::Joint& joint : alone.joints) {
    if (joint.name != pivot) continue;
    joint.type = model::JointType::fixed;
    joint.initial.clear();
  }
  for (model::Body& body : alone.bodies) {
    if (body.name != pad && body.name != pad + "_foot") continue;
    for (model::Frame& frame : body.frames)
      if (frame.name == "pivot") frame.X_BF.R = Eigen::AngleAxisd(-tilt, Vector3::UnitZ()).toRotationMatrix();
  }
}

/// Tilt at which the film of a pad only widens along the sliding direction and carries nothing [rad].
double unloaded_tilt(const model::Composite& composite, std::size_t k, double speed) {
  const model::Bearing& pad = composite.alone->bearings[k];
  const film::Arc& arc = film::arcs_of(pad.film)->arcs.front();
  const double pivot = composite.pivot_angles[k];
  const double to_leading_end = std::abs(std::remainder(speed > 0 ? pivot - arc.from : arc.to - pivot, two_pi));
  return -std::copysign(0.5, speed) * bearing::clearance(pad.film) /
         (pad.film.R * std::sin(std::min(to_leading_end, 0.25 * two_pi)));
}

/// The pads that are least loaded, of those that are free: the ones farthest from the direction of the load; none if
/// only pads are left that the journal needs.
std::vector<std::size_t> least_loaded(const model::Composite& composite, const std::vector<double>& fixed_tilts,
                                      double load_angle) {
  constexpr double same = 1e-9;  // of cosines: pads on both sides of the load's line differ by round-off
  std::vector<std::size_t> least;
  double smallest = -same;
  for (std::size_t k = 0; k < fixed_tilts.size(); ++k) {
    const double part = std::cos(composite.pivot_angles[k] - load_angle);
    if (!std::isnan(fixed_tilts[k]) || part > smallest + same) continue;
    if (part < smallest - same) least.clear();
    smallest = std::min(smallest, part);
    least.push_back(k);
  }
  return least;
}

/// The bearing with its journal held at `e` [m].
model::Model with_journal_at(model::Model alone, const Eigen::Vector2d& e) {
  std::erase_if(alone.forces, [](const model::Force& force) { return force.name == "load"; });
  std::erase_if(alone.drives, [](const model::Drive& drive) { return drive.coordinate != "rotation"; });
  for (const auto& [axis, at] : {std::pair{"x", e.x()}, std::pair{"y", e.y()}})
    alone.drives.push_back({.name = axis,
                            .joint = journal_joint,
                            .coordinate = axis,
                            .motion = {.value = std::make_shared<ConstantFunction>(at)}});
  return alone;
}

/// The motion with the journal held at `e`, reached from the middle of the bearing in steps that pads can follow; a
/// last one unsolved tells why there is none.
run::SteadyMotion motion_held_at(const model::Model& alone, const Eigen::Vector2d& e) {
  constexpr double shortest = 1.0 / 64;
  model::Model from = alone;
  run::SteadyMotion motion;
  double reached = 0, step = 1;
  while (reached < 1) {
    try {
      motion = run::find_steady_motion(with_journal_at(from, (reached + step) * e), journal_axes(), most_iterations);
      if (motion.solved() && !pads_return(motion, {journal_joint}))
        motion.fail("pads that would tilt away from where they stand");
    } catch (const InputError& error) {  // pads that stand as they began touch the journal there
      motion.fail(error_text(error));
    }
    if (motion.solved()) {
      from = starting_at(std::move(from), motion);
      reached += step;
    } else if (step /= 2; step < shortest) {
      return motion;
    }
  }
  return motion;
}

/// Force of the films on the pads [N].
Eigen::Vector2d carried_by(const model::Composite& composite, const PadMotion& found) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < composite.pads.size(); ++k) sum += force_on_pad(composite, k, found);
  return sum;
}

/// The motion under the load, sought with journal and pads at once, and if that fails by Newton's method over the
/// journal's place alone, the pads in balance at each.
run::SteadyMotion motion_under_load(const model::Composite& composite, const model::Model& alone,
                                    const std::vector<double>& fixed_tilts, const model::JournalPoint& point) {
  const run::SteadyMotion direct = run::find_steady_motion(alone, {}, most_iterations);
  if (direct.solved() && pads_return(direct, {journal_joint})) return direct;
  const Eigen::Vector2d load = *point.load * Eigen::Vector2d(std::cos(point.load_angle), std::sin(point.load_angle));
  const double longest = 0.15 * bearing::clearance(alone.bearings.front().film);
  constexpr int most = 25;
  constexpr double near = 1e-3;  // of the load, from where journal and pads are found at once
  model::Model from = alone;
  Eigen::Vector2d e = Eigen::Vector2d::Zero();
  for (int i = 0; i < most; ++i) {
    const run::SteadyMotion held = motion_held_at(from, e);
    if (!held.solved()) break;
    from = starting_at(std::move(from), held);
    const Eigen::Vector2d missing =
        load - carried_by(composite, {.alone = from, .fixed_tilts = fixed_tilts, .motion = held});
    if (missing.norm() < near * load.norm()) {
      for (model::Joint& joint : from.joints)
        if (joint.name == journal_joint) joint.initial = {{"x", {e.x()}, {}}, {"y", {e.y()}, {}}};
      run::SteadyMotion motion = run::find_steady_motion(from, {}, most_iterations);
      if (motion.solved()) return motion;
      break;
    }
    const Eigen::Vector2d step = reduce(held.small_motions, journal_coordinates(held), 0).K.fullPivLu().solve(missing);
    e += std::min(1.0, longest / step.norm()) * step;
  }
  return direct;
}

}  // namespace

PadMotion find_motion(const model::Composite& composite, const model::JournalPoint& point) {
  const double direction = point.load ? point.load_angle : point.eccentricity_angle;
  const Eigen::Vector2d e =
      point.load ? Eigen::Vector2d::Zero()
                 : Eigen::Vector2d(*point.eccentricity_ratio * bearing::clearance(composite.bearing.film) *
                                   Eigen::Vector2d(std::cos(direction), std::sin(direction)));
  PadMotion found{.alone = *composite.alone};
  const auto sought = [&](const model::Model& alone) {
    return point.load ? motion_under_load(composite, alone, found.fixed_tilts, point) : motion_held_at(alone, e);
  };
  found.fixed_tilts.assign(composite.pads.size(), std::numeric_limits<double>::quiet_NaN());
  found.motion = sought(found.alone);
  const std::string why = found.motion.message;
  while (!found.motion.solved()) {
    const std::vector<std::size_t> unloaded = least_loaded(composite, found.fixed_tilts, direction);
    for (const std::size_t k : unloaded) {
      found.fixed_tilts[k] = unloaded_tilt(composite, k, point.journal_speed);
      fix_pad(found.alone, composite.pads[k], found.fixed_tilts[k]);
    }
    if (unloaded.empty()) {
      found.motion.message = why;
      break;
    }
    found.motion = sought(found.alone);
  }
  return found;
}

solver::Linearisation mean_small_motions(const PadMotion& found) {
  const Eigen::Vector2d e = find_joint(found.alone, found.motion, journal_joint)->position.head<2>();
  return mean_over_grids(with_journal_at(starting_at(found.alone, found.motion), e), found.motion, journal_axes());
}

}  // namespace hersey::study
