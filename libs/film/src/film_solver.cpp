#include "hersey/film/film_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "node.h"
#include "sor.h"

namespace hersey::film {
namespace {

// What one Newton step may change where the law is strongly curved: the logarithm of the viscosity and the film
// thickness of a compliant surface, relative to itself.
constexpr double largest_change = 1.0;

// exp(20) = 5e8 times the viscosity: no oil, and far from overflow.
constexpr double largest_exponent = 20;

// Iterations after which a front is taken to be far away.
constexpr int patience = 12;

/// The share of the step du that keeps viscosity and film thickness within `largest_change` at every node. Only
/// pressures count: switching a node between full and cavitated bends no law and is never held back.
double step_share(const FilmModel& model, const SurfaceMotion& motion, const Eigen::VectorXd& u,
                  const Eigen::VectorXd& du) {
  const double C = model.compliance;
  const Lubricant& oil = model.lubricant;
  if (C == 0 && std::holds_alternative<ConstantViscosity>(oil.viscosity_law)) return 1;
  const NodeLaw law(model);
  double share = 1;
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    const int j = static_cast<int>(i % model.grid.n_z);
    const Node before = law.state(motion.g[i], u[i], j), after = law.state(motion.g[i], u[i] + du[i], j);
    const double exponent = log_viscosity_ratio(oil, after.p).value - log_viscosity_ratio(oil, before.p).value;
    const double relative = std::max(std::abs(exponent), C * std::abs(after.p - before.p) / before.h);
    if (relative > largest_change) share = std::min(share, largest_change / relative);
  }
  return share;
}

bool sensible_pressure(const FilmModel& model, const Eigen::VectorXd& u) {
  const double largest = u.maxCoeff();
  return std::isfinite(largest) && log_viscosity_ratio(model.lubricant, largest).value <= largest_exponent;
}

/// The film seen on every second node around the bearing.
struct CoarseFilm {
  FilmModel model;
  SurfaceMotion motion;
  FilmHistory history;
  Eigen::VectorXd u;
};

Eigen::VectorXd every_second(const Grid& grid, const Eigen::VectorXd& fine) {
  const int n_z = grid.n_z;
  Eigen::VectorXd coarse(fine.size() / 2);
  for (int i = 0; 2 * i < grid.n_phi; ++i) coarse.segment(i * n_z, n_z) = fine.segment(2 * i * n_z, n_z);
  return coarse;
}

CoarseFilm coarsen(const FilmModel& model, const SurfaceMotion& motion, const FilmHistory& history,
                   const Eigen::VectorXd& u) {
  const Grid& grid = model.grid;
  CoarseFilm coarse{model, motion, history, every_second(grid, u)};
  coarse.model.grid = resampled(grid, grid.n_phi / 2, grid.n_z);
  coarse.motion.g = every_second(grid, motion.g);
  coarse.motion.g_rate = every_second(grid, motion.g_rate);
  if (history.dt == 0) return coarse;
  coarse.history.theta = every_second(grid, history.theta);
  coarse.history.w = every_second(grid, history.w);
  if (history.density.size() != 0) coarse.history.density = every_second(grid, history.density);
  return coarse;
}

FilmSolveSummary solve_by_newton(Reynolds& reynolds, const SurfaceMotion& motion, const FilmHistory& history,
                                 const FilmSolveOptions& options, Eigen::VectorXd& u);

// A film front that no flow carries moves by one node per Newton step. It is then sought on coarser grids first, where
// the way is shorter, so that the iterations stay few on every grid.
void start_on_coarser_grid(const FilmModel& model, const SurfaceMotion& motion, const FilmHistory& history,
                           Eigen::VectorXd& u) {
  const Grid& grid = model.grid;
  if (grid.n_phi % 2 != 0 || grid.n_phi < 48) return;
  CoarseFilm coarse = coarsen(model, motion, history, u);
  Reynolds reynolds(coarse.model);
  if (!solve_by_newton(reynolds, coarse.motion, coarse.history, {.rtol = 1e-8}, coarse.u).converged) return;
  const int n = coarse.model.grid.n_phi, n_z = grid.n_z;
  const double to_fine = fill_scale(model) / fill_scale(coarse.model);  // keeps fill fractions
  for (int i = 0; i < n; ++i) {
    const auto scaled = [&](double value) { return value < 0 ? to_fine * value : value; };
    const Eigen::VectorXd here = coarse.u.segment(i * n_z, n_z).unaryExpr(scaled);
    const Eigen::VectorXd next = coarse.u.segment((i + 1) % n * n_z, n_z).unaryExpr(scaled);
    u.segment(2 * i * n_z, n_z) = here;
    u.segment((2 * i + 1) * n_z, n_z) = 0.5 * (here + next);
  }
}

std::string where(const Grid& grid, int node) {
  return fmt::format("film cell ({}, {})", node / grid.n_z, node % grid.n_z);
}

bool starved(const FilmModel& model, const Eigen::VectorXd& u) {
  if (model.cavitation != Cavitation::mass_conserving) return false;
  for (int node = 0; node < model.grid.size(); ++node) {
    // On an edge at p_cav, u > 0 is oil that leaves, not pressure.
    if (u[node] > 1e-9 * fill_scale(model) && !open_edge(model, node % model.grid.n_z)) return false;
  }
  return true;
}

// A fill fraction below zero is no film: it says that more oil leaves a node than comes in.
int emptiest_node(const FilmModel& model, const Eigen::VectorXd& u) {
  if (model.cavitation != Cavitation::mass_conserving) return -1;
  int emptiest = -1;
  double least = -fill_scale(model) * (1 + 1e-9);
  for (int node = 0; node < model.grid.size(); ++node) {
    // An edge that lets oil in has no fill fraction below that of its surroundings.
    if (u[node] < least && ambient_fill(model, node % model.grid.n_z) == 0) emptiest = node, least = u[node];
  }
  return emptiest;
}

void explain(const FilmModel& model, const Eigen::VectorXd& u, double rtol, FilmSolveSummary& summary) {
  const int empty = emptiest_node(model, u);
  if (summary.converged && empty >= 0) {
    summary.converged = false;
    summary.worst_node = empty;
    summary.message =
        fmt::format("the fill fraction is negative in {}: more oil leaves than can come; take a shorter step",
                    where(model.grid, empty));
  } else if (summary.converged && starved(model, u)) {
    summary.message =
        "the film carries no pressure: nothing supplies it above the cavitation pressure; add a supply line, "
        "a hole or an edge pressure above it";
  } else if (!summary.converged) {
    summary.message =
        fmt::format("relative residual {:.2e} after {} iterations, {:.0e} was asked; worst in {}",
                    summary.relative_residual, summary.iterations, rtol, where(model.grid, summary.worst_node));
  }
}

FilmSolveSummary solve_by_newton(Reynolds& reynolds, const SurfaceMotion& motion, const FilmHistory& history,
                                 const FilmSolveOptions& options, Eigen::VectorXd& u) {
  FilmSolveSummary summary;
  const Eigen::VectorXd start = u;
  Eigen::VectorXd du(u.size());
  const bool cold = u.isZero(0);
  for (;; ++summary.iterations) {
    const bool lost = summary.iterations == patience;
    if (lost) u = start;
    if (lost || (summary.iterations == 0 && cold && reynolds.model().cavitation == Cavitation::reynolds)) {
      start_on_coarser_grid(reynolds.model(), motion, history, u);
    }
    reynolds.linearise(motion, history, u);
    summary.relative_residual = reynolds.relative_residual();
    summary.worst_node = reynolds.worst_node();
    summary.converged = summary.relative_residual <= options.rtol;
    if (summary.converged || summary.iterations == options.max_iterations) return summary;
    reynolds.newton_increment(du);
    u += step_share(reynolds.model(), motion, u, du) * du;
    if (!sensible_pressure(reynolds.model(), u)) {
      u = start;
      return summary;
    }
  }
}

}  // namespace

FilmSolveSummary solve_film(Reynolds& reynolds, const SurfaceMotion& motion, const FilmHistory& history,
                            const FilmSolveOptions& options, Eigen::VectorXd& u) {
  FilmSolveSummary summary = options.solver == FilmSolver::newton
                                 ? solve_by_newton(reynolds, motion, history, options, u)
                                 : solve_by_sor(reynolds, motion, history, options, u);
  explain(reynolds.model(), u, options.rtol, summary);
  return summary;
}

}  // namespace hersey::film
