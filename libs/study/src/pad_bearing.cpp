#include "pad_bearing.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <utility>

#include "hersey/core/input_error.h"
#include "hersey/core/two_pi.h"
#include "hersey/model/plausibility.h"
#include "hersey/solver/reduced_coefficients.h"
#include "pad_film.h"
#include "pad_motion.h"

namespace hersey::study {
namespace {

PadState pad_state(const model::Composite& composite, std::size_t k, const PadMotion& found) {
  const model::Model& alone = *composite.alone;
  const run::SteadyMotion& motion = found.motion;
  PadState pad{.name = fmt::format("{}", k + 1), .pivot_angle = composite.pivot_angles[k]};
  pad.is_aside = !std::isnan(found.fixed_tilts[k]);
  pad.tilt = tilt_of_pad(composite, k, found);
  if (const mbd::JointObservation* travel = find_joint(alone, motion, composite.pads[k] + "_travel"))
    pad.pivot_travel = travel->position[0];
  pad.force = force_on_pad(composite, k, found);
  if (const auto& heat = motion.bearings[k].heat) pad.T_max = heat->T_max, pad.T_face_max = heat->T_shell_max;
  if (const Eigen::VectorXd& d = motion.fields[k].d_shell; d.size() > 0) pad.bending = d.maxCoeff() - d.minCoeff();
  // The gap is smooth over a pad: the film at the pivot lies between two lines.
  const film::Grid& grid = alone.bearings[k].film.grid;
  const Eigen::VectorXd& h = motion.fields[k].h;
  const auto middle = [&](int line) {
    return 0.5 * (h[grid.index(line, (grid.n_z - 1) / 2)] + h[grid.index(line, grid.n_z / 2)]);
  };
  double angle = pad.pivot_angle - grid.phi(0);
  angle -= two_pi * std::floor(angle / two_pi);
  int i = 0;
  while (i + 2 < grid.n_phi && grid.phi(i + 1) - grid.phi(0) < angle) ++i;
  const double step = grid.phi(i + 1) - grid.phi(i), part = (angle - (grid.phi(i) - grid.phi(0))) / step;
  pad.h_pivot = (1 - part) * middle(i) + part * middle(i + 1);
  return pad;
}

void fill_state(const model::Composite& composite, const run::SteadyMotion& motion, const PadFilm& whole,
                const PadBearingSolution& pads, bearing::SteadyState& state) {
  const auto& point = std::get<model::JournalPoint>(*composite.bearing.operating_point);
  state.kind = composite.bearing.kind;
  state.point.journal_speed = point.journal_speed;
  state.e = Eigen::Vector2d(find_joint(*composite.alone, motion, journal_joint)->position.head<2>());
  state.film = whole.film;
  if (whole.heat) {
    state.heat.emplace();
    state.heat->observed = *whole.heat;
    if (motion.network) state.heat->network = *motion.network;
  }
  Eigen::Vector2d carried = Eigen::Vector2d::Zero();
  for (const PadState& pad : pads.pads) carried += pad.force;
  state.load = carried;
  if (point.load) {
    state.load = *point.load * Eigen::Vector2d(std::cos(point.load_angle), std::sin(point.load_angle));
    state.point.load = state.load;
  } else {
    state.point.e = state.e;
  }
}

}  // namespace

void solve_pads(const model::Composite& composite, BearingSolution& solution) {
  if (!composite.alone) throw InputError(composite.alone_faults);
  const auto began = std::chrono::steady_clock::now();
  const auto& point = std::get<model::JournalPoint>(*composite.bearing.operating_point);
  const PadMotion found = find_motion(composite, point);
  const run::SteadyMotion& motion = found.motion;
  solution.summary.iterations = motion.iterations;
  PadFilm whole(composite.alone->bearings);
  solution.model = whole.model;
  if (!motion.solved()) return solution.fail(fmt::format("bearing {}: {}", composite.bearing.name, motion.message));
  whole.observe(motion, found.fixed_tilts);
  if (motion.network)
    for (const film::ThermalNode& node : composite.alone->thermal.network.nodes)
      solution.node_names.push_back(node.name);
  auto pads = std::make_shared<PadBearingSolution>();
  for (const std::size_t k : whole.order()) pads->pads.push_back(pad_state(composite, k, found));
  pads->fields = std::move(whole.fields);
  pads->whirl_ratio = composite.whirl_ratio;
  fill_state(composite, motion, whole, *pads, solution.state);
  const double omega = composite.whirl_ratio * std::abs(point.journal_speed);
  const solver::Linearisation small_motions = mean_small_motions(found);
  const solver::ReducedCoefficients reduced = reduce(small_motions, journal_coordinates(motion), omega);
  solution.state.coefficients = {reduced.K, reduced.C};
  pads->coordinates = motion.coordinates;
  pads->stiffness = over_coordinates(small_motions, small_motions.K);
  pads->damping = over_coordinates(small_motions, small_motions.C);
  pads->mass = over_coordinates(small_motions, small_motions.M);
  solution.numbers = bearing::bearing_numbers(solution.model, solution.state);
  solution.coefficients = bearing::in_load_axes(solution.model, solution.state);
  for (const PadState& pad : pads->pads)
    if (pad.is_aside)
      solution.warnings.push_back(
          fmt::format("bearing {}: nothing balances pad {}, which would rub or flutter (spragging): it stands aside, "
                      "tilted so that it carries {:.3g} N; preload, an offset pivot or a spring keeps it in place",
                      composite.bearing.name, pad.name, pad.force.norm()));
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
