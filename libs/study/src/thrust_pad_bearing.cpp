#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "hersey/bearing/thrust_bearing.h"
#include "hersey/core/contract.h"
#include "hersey/core/input_error.h"
#include "hersey/core/two_pi.h"
#include "hersey/model/plausibility.h"
#include "hersey/solver/reduced_coefficients.h"
#include "pad_bearing.h"
#include "pad_film.h"
#include "pad_motion.h"
#include "thrust_pad_motion.h"

// A thrust bearing of tilting pads by itself.
namespace hersey::study {
namespace {

/// Value at x of the parabola through three points.
double parabola(const std::array<double, 3>& at, const std::array<double, 3>& value, double x) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    sum += value[i] * (x - at[j]) * (x - at[k]) / ((at[i] - at[j]) * (at[i] - at[k]));
  }
  return sum;
}

/// A smooth field of a pad at an angle and a radius, by parabolas through the nodes around.
double interpolated(const film::FilmModel& film, const Eigen::VectorXd& field, double phi, double r) {
  const film::Grid& grid = film.grid;
  const auto angle = [&](int line) { return grid.phi(line) - grid.phi(0); };
  const auto radius = [&](int row) { return film.R + film.L * grid.z_over_L(row); };
  double at = phi - grid.phi(0);
  at -= two_pi * std::floor(at / two_pi);
  int i = 0, j = 0;
  while (i + 3 < grid.n_phi && angle(i + 1) < at) ++i;
  while (j + 3 < grid.n_z && radius(j + 1) < r) ++j;
  std::array<double, 3> angles{}, radii{}, along{}, across{};
  for (int b = 0; b < 3; ++b) {
    for (int a = 0; a < 3; ++a) angles[a] = angle(i + a), along[a] = field[grid.index(i + a, j + b)];
    radii[b] = radius(j + b), across[b] = parabola(angles, along, at);
  }
  return parabola(radii, across, r);
}

PadState thrust_pad_state(const model::Composite& composite, std::size_t k, const ThrustPadMotion& found,
                          bool is_forward) {
  PadState pad{.name = fmt::format("{}", k + 1), .pivot_angle = composite.pivot_angles[k]};
  const Eigen::Vector2d tilts = tilts_of_pad(composite, k, found);
  pad.tilt = is_forward ? tilts[0] : -tilts[0];
  pad.tilt_across = tilts[1];
  if (const mbd::JointObservation* travel = find_joint(found.alone, found.motion, composite.pads[k] + "_travel"))
    pad.pivot_travel = travel->position[0];
  if (const auto& heat = found.motion.bearings[k].heat) pad.T_max = heat->T_max, pad.T_face_max = heat->T_shell_max;
  pad.h_pivot =
      interpolated(found.alone.bearings[k].film, found.motion.fields[k].h, pad.pivot_angle, composite.pivot_radius);
  return pad;
}

/// Coefficients over film thickness and slopes of the collar's axis from those over its joints: rotation about x is a
/// slope towards -y (thrust.11).
bearing::DynamicCoefficients over_slopes(const solver::ReducedCoefficients& reduced) {
  Eigen::Matrix3d T = Eigen::Matrix3d::Zero();
  T(0, 0) = 1, T(1, 2) = -1, T(2, 1) = 1;  // joints from film thickness and slopes
  return {T.transpose() * reduced.K * T, T.transpose() * reduced.C * T};
}

/// Why pads may have no film: empty if their shape and pivots are no reason.
std::string reason(const model::Composite& composite, const model::ThrustPoint& point) {
  const model::Bearing& pad = composite.alone->bearings.front();
  const film::Grid& grid = pad.film.grid;
  const auto& thrust = dynamic_cast<const bearing::ThrustBearing&>(*pad.kind);
  if (!thrust.opening(pad.film).isZero(0)) return "";
  const double middle = 0.5 * (grid.phi(0) + grid.phi(grid.n_phi - 1));
  const double behind = std::copysign(1, point.speed) * std::remainder(composite.pivot_angles.front() - middle, two_pi);
  if (behind > 0) return "";
  return "; flat pads have no wedge where their pivots do not lie behind the middle in the sense of rotation: expected "
         "another `offset`, `sense` or speed, or a `crown`";
}

std::vector<solver::Equations::Index> rows_of_collar(const run::SteadyMotion& motion) {
  std::vector<solver::Equations::Index> rows;
  for (const std::string& name : collar_coordinates()) {
    const auto at = std::find(motion.coordinates.begin(), motion.coordinates.end(), name);
    HERSEY_REQUIRE(at != motion.coordinates.end(), "a collar moves along its axis and leans");
    rows.push_back(at - motion.coordinates.begin());
  }
  return rows;
}

}  // namespace

void solve_thrust_pads(const model::Composite& composite, BearingSolution& solution) {
  if (!composite.alone) throw InputError(composite.alone_faults);
  const auto began = std::chrono::steady_clock::now();
  const auto& point = std::get<model::ThrustPoint>(*composite.bearing.operating_point);
  const ThrustPadMotion found = find_thrust_motion(composite, point);
  const run::SteadyMotion& motion = found.motion;
  solution.summary.iterations = motion.iterations;
  PadFilm whole(composite.alone->bearings);
  solution.model = whole.model;
  if (!motion.solved())
    return solution.fail(
        fmt::format("bearing {}: {}{}", composite.bearing.name, motion.message, reason(composite, point)));
  whole.observe(motion, std::vector<double>(composite.pads.size(), std::numeric_limits<double>::quiet_NaN()));
  whole.film.wrench_on_shell = wrench_of_pads(composite, found);

  bearing::SteadyState& state = solution.state;
  state.kind = whole.kind;
  state.film = whole.film;
  state.point.journal_speed = point.speed;
  state.point.tilt = state.tilt = {point.tilt_x, point.tilt_y};
  state.point.e_rate = bearing::Coordinates::Zero(1);
  state.e = bearing::Coordinates::Constant(1, find_joint(found.alone, motion, "distance")->position[0]);
  state.load = bearing::Coordinates::Constant(1, point.load ? -*point.load : whole.film.wrench_on_shell[5]);
  if (point.load) state.point.load = state.load;
  if (whole.heat) {
    state.heat.emplace();
    state.heat->observed = *whole.heat;
    if (motion.network) state.heat->network = *motion.network;
  }
  if (motion.network)
    for (const film::ThermalNode& node : composite.alone->thermal.network.nodes)
      solution.node_names.push_back(node.name);

  auto pads = std::make_shared<PadBearingSolution>();
  pads->kind = composite.kind;
  for (const std::size_t k : whole.order())
    pads->pads.push_back(thrust_pad_state(composite, k, found, whole.kind->is_forward()));
  pads->fields = std::move(whole.fields);
  pads->whirl_ratio = composite.whirl_ratio;
  const solver::Linearisation small_motions = small_motions_of(found);
  state.coefficients =
      over_slopes(reduce(small_motions, rows_of_collar(motion), composite.whirl_ratio * std::abs(point.speed)));
  pads->coordinates = motion.coordinates;
  pads->stiffness = over_coordinates(small_motions, small_motions.K);
  pads->damping = over_coordinates(small_motions, small_motions.C);
  pads->mass = over_coordinates(small_motions, small_motions.M);
  for (std::size_t k = 0; k < composite.alone->bearings.size(); ++k) {
    const model::Bearing& pad = composite.alone->bearings[k];
    for (const std::string& warning :
         model::surface_warnings(pad, motion.bearings[k].film.p_max, motion.bearings[k].film.h_min))
      solution.warnings.push_back("bearing " + pad.name + ", " + warning);
  }
  solution.pads = std::move(pads);
  solution.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  solution.set_solved(true);
}

}  // namespace hersey::study
