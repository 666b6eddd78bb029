#include <algorithm>
#include <cmath>
#include <vector>

#include "hersey/bearing/bearing_kind.h"
#include "hersey/bearing/bearing_numbers.h"
#include "hersey/bearing/phase_averaged_coefficients.h"
#include "hersey/bearing/skirt.h"
#include "hersey/film/grid_transfer.h"

namespace hersey::bearing {
namespace {

// Below this a film has no shape left to compare with.
constexpr int kFewestNodesAround = 8, kFewestNodesAcross = 3;

struct Figures {
  double h_min, p_max, eccentricity_ratio, attitude, load, friction_journal, side_flow;
  double torque_journal, torque_shell, power_film;
  double T_max = 0, T_shell_max = 0, T_shell_mean = 0, T_journal = 0, T_film = 0, T_side = 0;  // of films with heat
  Eigen::Matrix2d stiffness, damping, K, C;
};

void add_temperatures(const SteadyState& state, Figures& f) {
  if (!state.heat) return;
  const film::HeatObservables& observed = state.heat->observed;
  f.T_max = observed.T_max, f.T_shell_max = observed.T_shell_max, f.T_shell_mean = observed.T_shell_mean;
  f.T_journal = observed.T_journal, f.T_film = observed.T_film_mean, f.T_side = observed.T_side;
}

/// Friction of a runner over its load: by its drag, on an annulus by its torque over the mean radius, of a skirt by its
/// side force.
double runner_friction(const film::FilmModel& model, const SteadyState& state) {
  if (std::holds_alternative<film::Annulus>(model.surface))
    return std::abs(state.film.torque_journal) / (model.R * state.load.norm());
  if (std::holds_alternative<film::Skirt>(model.surface))
    return std::abs(skirt_friction(state.film.wrench_on_shell, state.tilt)) / state.load.norm();
  return std::abs(state.film.wrench_on_shell[4] + state.tilt.x() * state.load[0]) / state.load.norm();
}

/// Figures of a kind without an axis: no attitude, no coefficients along the load.
Figures plain_figures_of(const film::FilmModel& model, const SteadyState& state) {
  Figures f{.h_min = state.film.h_min,
            .p_max = state.film.p_max,
            .eccentricity_ratio = 0,
            .attitude = 0,
            .load = state.load.norm(),
            .friction_journal = runner_friction(model, state),
            .side_flow = state.film.flow_sides(),
            .torque_journal = state.film.torque_journal,
            .torque_shell = state.film.torque_shell,
            .power_film = state.film.power_film,
            .stiffness = state.coefficients.stiffness.topLeftCorner<2, 2>(),
            .damping = state.coefficients.damping.topLeftCorner<2, 2>(),
            .K = Eigen::Matrix2d::Zero(),
            .C = Eigen::Matrix2d::Zero()};
  add_temperatures(state, f);
  return f;
}

Figures figures_of(const film::FilmModel& model, const SteadyState& state) {
  if (!state.kind->has_axis()) return plain_figures_of(model, state);
  const BearingNumbers n = bearing_numbers(model, state);
  const LoadAxesCoefficients along_load = in_load_axes(model, state);
  Figures f{.h_min = state.film.h_min,
            .p_max = state.film.p_max,
            .eccentricity_ratio = n.eccentricity_ratio,
            .attitude = n.attitude,
            .load = n.load,
            .friction_journal = n.friction_journal,
            .side_flow = state.film.flow_sides(),
            .torque_journal = state.film.torque_journal,
            .torque_shell = state.film.torque_shell,
            .power_film = state.film.power_film,
            .stiffness = state.coefficients.stiffness.topLeftCorner<2, 2>(),
            .damping = state.coefficients.damping.topLeftCorner<2, 2>(),
            .K = along_load.K,
            .C = along_load.C};
  add_temperatures(state, f);
  return f;
}

film::FilmModel with_half_grid(film::FilmModel model) {
  model.grid = film::halved(model.grid);
  return model;
}

/// Walls as a coarser grid sees them: a body, and temperatures given at angles, straight lines between them.
void take_to(const film::Grid& coarse, const film::Grid& fine, film::ThermalModel& thermal) {
  if (auto* body = std::get_if<film::BodyWall>(&thermal.shell))
    body->conduction = std::make_shared<const film::WallConduction>(film::on_grid(*body->conduction, fine, coarse));
  if (auto* body = std::get_if<film::BodyJournal>(&thermal.journal))
    body->conduction = std::make_shared<const film::JournalConduction>(film::on_grid(*body->conduction, fine, coarse));
  auto* wall = std::get_if<film::WallAtTemperature>(&thermal.shell);
  if (wall == nullptr || wall->around.size() == 0) return;
  wall->around = film::GridTransfer::by_position(fine, coarse).around(wall->around);
}

bool is_fine_enough(const film::Grid& grid) {
  return grid.n_phi >= kFewestNodesAround && grid.n_z >= kFewestNodesAcross;
}

// Error of a figure that has none: oil that does not leave has no temperature.
constexpr double kNone = -1;

// Richardson's error of `fine`. Steps of opposite sign or growing ones are no order at all: then, and without a third
// grid, the first order is taken, which overestimates.
double error_of(double fine, double half, const double* quarter) {
  if (!std::isfinite(fine - half)) return kNone;
  double order = 1;
  if (quarter != nullptr) {
    const double ratio = (half - *quarter) / (fine - half);
    if (std::isfinite(ratio) && ratio > 0) order = std::clamp(std::log2(ratio), 1.0, 2.0);
  }
  return std::abs(fine - half) / (std::exp2(order) - 1);
}

// Coefficients jump as fronts pass from node to node, by one place of the grid more than by another, and temperatures
// as a cell before or after a groove does: the larger step of both, as if of first order.
double steps_of(const std::vector<Figures>& figures, double Figures::*member) {
  double largest = std::abs(figures[0].*member - figures[1].*member);
  if (figures.size() > 2) largest = std::max(largest, 0.5 * std::abs(figures[1].*member - figures[2].*member));
  return std::isfinite(largest) ? largest : kNone;
}

// Of the whole matrix, since one entry may happen not to move.
Eigen::Matrix2d steps_of(const std::vector<Figures>& figures, Eigen::Matrix2d Figures::*member) {
  double largest = (figures[0].*member - figures[1].*member).cwiseAbs().maxCoeff();
  if (figures.size() > 2) {
    const Eigen::Matrix2d before = figures[1].*member - figures[2].*member;
    largest = std::max(largest, 0.5 * before.cwiseAbs().maxCoeff());
  }
  return Eigen::Matrix2d::Constant(largest);
}

}  // namespace

GridError estimate_grid_error(const film::FilmModel& model, const SteadyState& state, const SteadyOptions& options) {
  SteadyOptions from_here = options;
  if (state.point.load) from_here.start = state.e;
  std::vector<Figures> figures{figures_of(model, state)};
  film::FilmModel coarse = model;
  while (figures.size() < 3) {
    const film::Grid fine = coarse.grid;
    coarse = with_half_grid(coarse);
    if (from_here.thermal) take_to(coarse.grid, fine, *from_here.thermal);
    SteadyState coarse_state;
    if (!is_fine_enough(coarse.grid) || !solve_steady(coarse, state.point, from_here, coarse_state).solved()) break;
    coarse_state.coefficients = phase_averaged_coefficients(coarse, coarse_state, from_here);
    figures.push_back(figures_of(coarse, coarse_state));
  }
  GridError error;
  if (figures.size() < 2) return error;
  error.known = true;
  const auto of = [&](double Figures::*member) {
    const double* quarter = figures.size() > 2 ? &(figures[2].*member) : nullptr;
    return error_of(figures[0].*member, figures[1].*member, quarter);
  };
  error.h_min = of(&Figures::h_min);
  error.p_max = of(&Figures::p_max);
  error.eccentricity_ratio = of(&Figures::eccentricity_ratio);
  error.attitude = of(&Figures::attitude);
  error.load = of(&Figures::load);
  error.friction_journal = of(&Figures::friction_journal);
  error.side_flow = of(&Figures::side_flow);
  error.torque_journal = steps_of(figures, &Figures::torque_journal);
  error.torque_shell = steps_of(figures, &Figures::torque_shell);
  error.power_film = steps_of(figures, &Figures::power_film);
  error.T_max = steps_of(figures, &Figures::T_max);
  error.T_shell_max = steps_of(figures, &Figures::T_shell_max);
  error.T_shell_mean = steps_of(figures, &Figures::T_shell_mean);
  error.T_journal = steps_of(figures, &Figures::T_journal);
  error.T_film = steps_of(figures, &Figures::T_film);
  error.T_side = steps_of(figures, &Figures::T_side);
  error.stiffness = steps_of(figures, &Figures::stiffness);
  error.damping = steps_of(figures, &Figures::damping);
  error.in_load_axes = {steps_of(figures, &Figures::K), steps_of(figures, &Figures::C)};
  return error;
}

}  // namespace hersey::bearing
