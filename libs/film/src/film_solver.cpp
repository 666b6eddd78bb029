#include "hersey/film/film_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "coarse_film.h"
#include "node.h"
#include "sor.h"

namespace hersey::film {
namespace {

// Share of a control volume that may be left to the next one at the end of a step; more of it is worth a film of its
// own.
constexpr double most_passed_on = 0.02;

// What one Newton step may change where the law is strongly curved: the logarithm of the viscosity and the film
// thickness of a compliant surface, relative to itself.
constexpr double largest_change = 1.0;

// exp(20) = 5e8 times the viscosity: no oil, and far from overflow.
constexpr double largest_exponent = 20;

// Iterations after which a front is taken to be far away.
constexpr int patience = 12;

// Coarser grids are solved to this residual: what is left is far below their own error.
constexpr double coarse_rtol = 1e-4;

// Coarser grids with fewer nodes are factorised.
constexpr int largest_direct = 4000;

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

// What multigrid leaves of a system's residual: further where the last step came that much nearer, and never beyond
// what was asked. An answer much rougher would leave nodes about to switch on the wrong side: then Newton does not
// settle.
double linear_tolerance(double rtol, double residual, double last_residual) {
  constexpr double roughest = 1e-5;
  const double nearer = residual / last_residual;
  return std::clamp(0.1 * nearer * nearer, std::min(roughest, 0.1 * rtol / residual), roughest);
}

FilmSolveSummary solve_by_newton(Reynolds& reynolds, const SurfaceMotion& motion, const FilmHistory& history,
                                 const FilmSolveOptions& options, Eigen::VectorXd& u) {
  FilmSolveSummary summary;
  const Eigen::VectorXd start = u;
  Eigen::VectorXd du(u.size());
  double last = std::numeric_limits<double>::infinity();
  for (;; ++summary.iterations) {
    reynolds.linearise(motion, history, u);
    summary.relative_residual = reynolds.relative_residual();
    summary.worst_node = reynolds.worst_node();
    summary.converged = summary.relative_residual <= options.rtol;
    if (summary.converged || summary.iterations == options.max_iterations) return summary;
    reynolds.newton_increment(du, linear_tolerance(options.rtol, summary.relative_residual, last));
    last = summary.relative_residual;
    u += step_share(reynolds.model(), motion, u, du) * du;
    reynolds.let_fronts_follow(u);
    if (!sensible_pressure(reynolds.model(), u)) {
      u = start;
      return summary;
    }
  }
}

FilmSolveSummary solve_here(Reynolds& reynolds, const SurfaceMotion& motion, const FilmHistory& history,
                            const FilmSolveOptions& options, Eigen::VectorXd& u) {
  return options.solver == FilmSolver::sor ? solve_by_sor(reynolds, motion, history, options, u)
                                           : solve_by_newton(reynolds, motion, history, options, u);
}

// A film front that no flow carries moves by one node per Newton step, and an error that spans the film takes SOR as
// many sweeps as there are nodes. On coarser grids the way is shorter: each grid starts from the solution on the one
// with half the nodes, so that the iterations stay few on every grid.
bool start_on_coarser_grid(const Reynolds& reynolds, const SurfaceMotion& motion, const FilmHistory& history,
                           const FilmSolveOptions& options, int& iterations, Eigen::VectorXd& u) {
  const FilmModel& model = reynolds.model();
  if (!can_be_coarsened(model.grid)) return false;
  CoarseFilm coarse = coarsened(model, motion, history, u);
  Reynolds coarse_reynolds(coarse.model,
                           coarse.model.grid.size() < largest_direct ? LinearSolver::direct : reynolds.linear_solver());
  FilmSolveOptions roughly = options;
  roughly.rtol = std::max(options.rtol, coarse_rtol);
  start_on_coarser_grid(coarse_reynolds, coarse.motion, coarse.history, roughly, iterations, coarse.u);
  const FilmSolveSummary summary = solve_here(coarse_reynolds, coarse.motion, coarse.history, roughly, coarse.u);
  iterations += summary.iterations;
  if (!summary.converged) return false;
  u = refined(coarse, model);
  return true;
}

}  // namespace

FilmSolveSummary solve_film(Reynolds& reynolds, const SurfaceMotion& motion, const FilmHistory& history,
                            const FilmSolveOptions& options, Eigen::VectorXd& u) {
  const Eigen::VectorXd start = u;
  FilmSolveSummary summary;
  int coarse_iterations = 0;
  const bool cold = u.isZero(0);
  if (!cold) {
    FilmSolveOptions briefly = options;
    if (options.solver != FilmSolver::sor) briefly.max_iterations = std::min(options.max_iterations, patience);
    summary = solve_here(reynolds, motion, history, briefly, u);
  }
  if (!summary.converged) {
    u = start;
    start_on_coarser_grid(reynolds, motion, history, options, coarse_iterations, u);
    const int before = summary.iterations;
    summary = solve_here(reynolds, motion, history, options, u);
    summary.iterations += before;
  }
  summary.coarse_iterations = coarse_iterations;
  explain(reynolds.model(), u, options.rtol, summary);
  return summary;
}

void close_step(Reynolds& reynolds, const SurfaceMotion& motion, const FilmHistory& history,
                const FilmSolveOptions& options, const Eigen::VectorXd& u, OilOfStep& oil) {
  reynolds.settle(motion, history, u, oil);
  if (oil.passed_on <= most_passed_on) return;
  FilmHistory by_gap = history;
  by_gap.by_gap = true;
  Eigen::VectorXd film = u;
  if (!solve_film(reynolds, motion, by_gap, options, film).converged) return;
  reynolds.settle(motion, by_gap, film, oil);
}

}  // namespace hersey::film
