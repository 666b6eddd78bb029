#include "thrust_pad_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "hersey/bearing/steady_coordinates.h"
#include "hersey/bearing/thrust_bearing.h"
#include "hersey/core/contract.h"
#include "hersey/core/error_text.h"
#include "hersey/core/input_error.h"
#include "hersey/core/scalar_function.h"
#include "hersey/core/two_pi.h"
#include "hersey/solver/reduced_coefficients.h"
#include "pad_motion.h"

namespace hersey::study {
namespace {

// Joints of a collar by itself.
constexpr const char *distance_joint = "distance", *tilts_joint = "tilts", *rotation_joint = "rotation";

const model::Joint& joint_called(const model::Model& alone, const std::string& name) {
  const auto found =
      std::find_if(alone.joints.begin(), alone.joints.end(), [&](const model::Joint& j) { return j.name == name; });
  HERSEY_REQUIRE(found != alone.joints.end(), "a bearing by itself has the joint");
  return *found;
}

/// Lets a coordinate begin at a value.
void begin_at(model::Model& alone, const std::string& name, const std::string& coordinate, double value) {
  for (model::Joint& joint : alone.joints) {
    if (joint.name != name) continue;
    std::erase_if(joint.initial, [&](const model::InitialValue& initial) { return initial.coordinate == coordinate; });
    joint.initial.push_back({coordinate, {value}, {}});
  }
}

/// Pad k has a line to roll about, not a point.
bool stands_on_a_line(const model::Model& alone, const std::string& pad) {
  return joint_called(alone, pad + "_pivot").type == model::JointType::revolute;
}

/// Lets collar and pads begin with the film thickness `film` at the pivot where it is least: pads follow the collar and
/// open their leading edges by half of their films (thrust.12).
/// @returns the film thickness on the axis
double begin_with_film(const model::Composite& composite, const model::ThrustPoint& point, double film,
                       model::Model& alone) {
  const double r = composite.pivot_radius;
  double on_axis = film;
  for (const double angle : composite.pivot_angles)
    on_axis = std::max(on_axis, film + r * (point.tilt_x * std::cos(angle) + point.tilt_y * std::sin(angle)));
  begin_at(alone, distance_joint, "translation", on_axis);
  for (std::size_t k = 0; k < composite.pads.size(); ++k) {
    const double c = std::cos(composite.pivot_angles[k]), s = std::sin(composite.pivot_angles[k]);
    const double outwards = point.tilt_x * c + point.tilt_y * s, onwards = -point.tilt_x * s + point.tilt_y * c;
    const film::Grid& grid = alone.bearings[k].film.grid;
    const double before = std::abs(std::remainder(composite.pivot_angles[k] - grid.phi(0), two_pi)),
                 behind = std::abs(std::remainder(grid.phi(grid.n_phi - 1) - composite.pivot_angles[k], two_pi));
    const double lever = r * std::sin(std::min(std::max(before, behind), 0.25 * two_pi));
    const double along = -onwards + std::copysign(0.5 * (on_axis - r * outwards) / lever, point.speed);
    const std::string pivot = composite.pads[k] + "_pivot";
    if (stands_on_a_line(alone, composite.pads[k])) {
      begin_at(alone, pivot, "rotation", along);
    } else {
      begin_at(alone, pivot, "rotation_1", along);
      begin_at(alone, pivot, "rotation_2", outwards);
    }
  }
  return on_axis;
}

/// The bearing with its collar held at a film thickness on the axis [m].
model::Model with_collar_at(model::Model alone, double film) {
  std::erase_if(alone.forces, [](const model::Force& force) { return force.name == "load"; });
  std::erase_if(alone.drives, [](const model::Drive& drive) { return drive.name == distance_joint; });
  alone.drives.push_back({.name = distance_joint,
                          .joint = distance_joint,
                          .coordinate = "translation",
                          .motion = {.value = std::make_shared<ConstantFunction>(film)}});
  return alone;
}

/// The bearing with collar and pads beginning where a motion has them.
model::Model beginning_at(model::Model alone, const run::SteadyMotion& motion) {
  for (std::size_t k = 0; k < alone.joints.size(); ++k) {
    const std::string name = alone.joints[k].name;
    const mbd::JointValues& position = motion.joints[k].position;
    const bool is_pivot = name.ends_with("_pivot");
    if (name == distance_joint || name.ends_with("_travel")) begin_at(alone, name, "translation", position[0]);
    if (is_pivot && position.size() == 1) begin_at(alone, name, "rotation", position[0]);
    if (is_pivot && position.size() == 2) {
      begin_at(alone, name, "rotation_1", position[0]);
      begin_at(alone, name, "rotation_2", position[1]);
    }
  }
  return alone;
}

run::SteadyMotion attempted(const model::Model& alone) {
  run::SteadyMotion motion;
  try {
    motion = run::find_steady_motion(alone, collar_coordinates(), most_iterations);
    if (motion.solved() && !pads_return(motion, {distance_joint, tilts_joint, rotation_joint}))
      motion.fail("pads that would tilt away from where they stand");
  } catch (const InputError& error) {  // pads that stand as they began touch the collar there
    motion.fail(error_text(error));
  }
  return motion;
}

/// The motion with the collar held at a film thickness on the axis, `least` at the nearest pivot: at once, or else
/// followed from thicker films down in steps that pads can follow.
run::SteadyMotion motion_held_at(const model::Composite& composite, const model::ThrustPoint& point, double on_axis,
                                 double least, model::Model& alone) {
  constexpr int widest = 6;
  constexpr double shortest = 1.0 / 64;
  run::SteadyMotion motion;
  double at = on_axis;
  for (int k = 0; k <= widest && !motion.solved(); ++k) {
    at = begin_with_film(composite, point, std::exp2(k) * least, alone);
    if (k == 0) begin_at(alone, distance_joint, "translation", at = on_axis);
    motion = attempted(with_collar_at(alone, at));
  }
  const double from = at;
  double reached = from == on_axis ? 1 : 0, step = 1;
  while (motion.solved() && reached < 1) {
    alone = beginning_at(std::move(alone), motion);
    const double next = std::min(1.0, reached + step);
    run::SteadyMotion there = attempted(with_collar_at(alone, (1 - next) * from + next * on_axis));
    if (there.solved()) {
      motion = std::move(there), reached = next;
    } else if (step /= 2; step < shortest) {
      return there;
    }
  }
  return motion;
}

/// Film thickness at which so many pads carry the load, by (thrust.8).
double estimated_film(const model::Composite& composite, const model::ThrustPoint& point) {
  const model::Bearing& pad = composite.alone->bearings.front();
  bearing::OperatingPoint one{.journal_speed = point.speed};
  one.e = one.e_rate = bearing::Coordinates::Zero(1);
  one.load = bearing::Coordinates::Constant(1, -*point.load / static_cast<double>(composite.pads.size()));
  return pad.kind->steady_coordinates(pad.film)->start(one)[0];
}

/// The motion under the load by Newton's method over the film thickness, from `film` on; empty if that finds none.
std::optional<run::SteadyMotion> motion_by_thickness(const model::Composite& composite, const model::ThrustPoint& point,
                                                     double film, const model::Model& alone) {
  constexpr int most = 40, widest = 6;
  constexpr double near = 1e-3;  // of the load, from where collar and pads are found at once
  model::Model from = alone;
  double on_axis = begin_with_film(composite, point, film, from);
  run::SteadyMotion held = motion_held_at(composite, point, on_axis, film, from);
  for (int i = 0; i < most && held.solved(); ++i) {
    from = beginning_at(std::move(from), held);
    const double carried = -wrench_of_pads(composite, {.alone = from, .motion = held})[5];
    if (std::abs(carried - *point.load) < near * *point.load) return attempted(from);
    std::vector<solver::Equations::Index> distance;
    for (std::size_t row = 0; row < held.coordinates.size(); ++row)
      if (held.coordinates[row] == collar_coordinates().front())
        distance.push_back(static_cast<solver::Equations::Index>(row));
    const double k = solver::reduce(held.small_motions, distance, 0).K(0, 0);
    const double step = k > 0 ? (carried - *point.load) / k : -0.5 * on_axis;
    double next = on_axis + std::clamp(step, -0.5 * on_axis, on_axis);
    run::SteadyMotion there = attempted(with_collar_at(from, next));
    for (int halved = 0; halved < widest && !there.solved(); ++halved) {
      next = 0.5 * (next + on_axis);
      there = attempted(with_collar_at(from, next));
    }
    on_axis = next;
    held = std::move(there);
  }
  return std::nullopt;
}

}  // namespace

const std::vector<std::string>& collar_coordinates() {
  static const std::vector<std::string> names{fmt::format("joint {}, translation", distance_joint),
                                              fmt::format("joint {}, rotation_1", tilts_joint),
                                              fmt::format("joint {}, rotation_2", tilts_joint)};
  return names;
}

Eigen::Vector2d tilts_of_pad(const model::Composite& composite, std::size_t k, const ThrustPadMotion& found) {
  const mbd::JointObservation* pivot = find_joint(found.alone, found.motion, composite.pads[k] + "_pivot");
  HERSEY_REQUIRE(pivot != nullptr, "a pad has a pivot");
  return {pivot->position[0], pivot->position.size() > 1 ? pivot->position[1] : 0};
}

Pose pose_of_pad(const model::Composite& composite, std::size_t k, const ThrustPadMotion& found) {
  const auto body = std::find_if(found.alone.bodies.begin(), found.alone.bodies.end(),
                                 [&](const model::Body& b) { return b.name == composite.pads[k]; });
  HERSEY_REQUIRE(body != found.alone.bodies.end(), "a pad is a body");
  const auto frame =
      std::find_if(body->frames.begin(), body->frames.end(), [](const model::Frame& f) { return f.name == "pivot"; });
  HERSEY_REQUIRE(frame != body->frames.end(), "a pad has a pivot");
  const Eigen::Vector2d tilts = tilts_of_pad(composite, k, found);
  Pose moved;
  moved.R = (Eigen::AngleAxisd(tilts[0], Vector3::UnitX()) * Eigen::AngleAxisd(tilts[1], Vector3::UnitY()))
                .toRotationMatrix();
  if (const mbd::JointObservation* travel = find_joint(found.alone, found.motion, composite.pads[k] + "_travel"))
    moved.r.z() = -travel->position[0];
  return frame->X_BF * moved * frame->X_BF.inverse();
}

Vector6 wrench_of_pads(const model::Composite& composite, const ThrustPadMotion& found) {
  Vector6 sum = Vector6::Zero();
  for (std::size_t k = 0; k < composite.pads.size(); ++k)
    sum += moved_force(pose_of_pad(composite, k, found), found.motion.bearings[k].film.wrench_on_shell);
  return sum;
}

ThrustPadMotion find_thrust_motion(const model::Composite& composite, const model::ThrustPoint& point) {
  ThrustPadMotion found{.alone = *composite.alone};
  if (!point.load) {
    double least = *point.film_thickness;
    for (const double angle : composite.pivot_angles)
      least = std::min(least, *point.film_thickness - composite.pivot_radius * (point.tilt_x * std::cos(angle) +
                                                                                point.tilt_y * std::sin(angle)));
    if (least <= 0) {
      found.motion.fail(
          fmt::format("a collar that leans by so much touches the pads: {:.4g} um at a pivot", 1e6 * least));
      return found;
    }
    found.motion = motion_held_at(composite, point, *point.film_thickness, least, found.alone);
    return found;
  }
  const double film = estimated_film(composite, point);
  (void)begin_with_film(composite, point, film, found.alone);
  found.motion = attempted(found.alone);
  if (found.motion.solved()) return found;
  std::optional<run::SteadyMotion> slowly = motion_by_thickness(composite, point, film, found.alone);
  if (slowly && slowly->solved()) found.motion = std::move(*slowly);
  return found;
}

solver::Linearisation small_motions_of(const ThrustPadMotion& found) {
  const auto& films = found.motion.bearings;
  const bool is_full =
      std::all_of(films.begin(), films.end(), [](const auto& film) { return film.film.cavitated_share == 0; });
  if (is_full) return found.motion.small_motions;
  const double film = find_joint(found.alone, found.motion, distance_joint)->position[0];
  return mean_over_grids(with_collar_at(beginning_at(found.alone, found.motion), film), found.motion,
                         collar_coordinates());
}

}  // namespace hersey::study
