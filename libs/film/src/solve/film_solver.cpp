#include "hersey/film/film_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "balance/node.h"
#include "hersey/film/grid_transfer.h"
#include "hersey/film/observables.h"
#include "solve/coarse_film.h"
#include "solve/sor.h"

namespace hersey::film {

FilmSolver usual_solver(const Grid& grid) {
  constexpr int kManyNodes = 15'000;
  return grid.size() > kManyNodes ? FilmSolver::multigrid : FilmSolver::newton;
}

int lowest_fill_node(const FilmModel& model, const Eigen::VectorXd& u) {
  if (!cavitation_law(model).has_fill()) return -1;
  int emptiest = -1;
  double least = -fill_scale(model) * (1 + 1e-9);
  for (int node = 0; node < model.grid.size(); ++node) {
    // An edge that lets oil in has no fill fraction below that of its surroundings.
    if (u[node] < least && ambient_fill(model, node) == 0) emptiest = node, least = u[node];
  }
  return emptiest;
}

namespace {

// What one Newton step may change where the law is strongly curved: the logarithm of the viscosity and the film
// thickness of a compliant surface, relative to itself.
constexpr double largest_change = 1.0;

// One step may thin the film of a compliant surface to this fraction of itself.
constexpr double thinnest = 0.3;

// 2^-10 of a step that closes the film is none.
constexpr int most_halvings = 10;

// Iterations after which a front is taken to be far away.
constexpr int patience = 12;

// Where Newton's method has failed, SOR sweeps up to so many thousand times, to this residual, before it tries again.
constexpr int rescue_sweeps = 5;
constexpr double rescue_rtol = 1e-6;

// Coarser grids are solved to this residual: what is left is far below their own error.
constexpr double coarse_rtol = 1e-4;

// Coarser grids with fewer nodes are factorised.
constexpr int largest_direct = 4000;

/// The length of the step du that keeps viscosity and film thickness within `largest_change` at every node, and the
/// film open. Only pressures count: switching a node between full and cavitated bends no law and is never limited.
double step_length(const FilmModel& model, const SurfaceMotion& motion, const Eigen::VectorXd& u,
                   const Eigen::VectorXd& du) {
  const double C = model.compliance;
  const Lubricant& oil = model.lubricant;
  if (C == 0 && std::holds_alternative<ConstantViscosity>(oil.viscosity_law)) return 1;
  const NodeLaw law(model);
  double step_length = 1;
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    const int node = static_cast<int>(i);
    const double roughness = motion.roughness_at(i);
    const Node before = law.state(motion.g[i], u[i], node, roughness),
               after = law.state(motion.g[i], u[i] + du[i], node, roughness);
    const double exponent = log_viscosity_ratio(oil, after.p).value - log_viscosity_ratio(oil, before.p).value;
    const double relative = std::max(std::abs(exponent), C * std::abs(after.p - before.p) / before.h);
    if (relative > largest_change) step_length = std::min(step_length, largest_change / relative);
    const double thinning = 1 - after.h / before.h;
    if (thinning > 1 - thinnest) step_length = std::min(step_length, (1 - thinnest) / thinning);
  }
  return step_length;
}

std::string where(const Grid& grid, int node) {
  return fmt::format("film cell ({}, {})", node / grid.n_z, node % grid.n_z);
}

bool starved(const FilmModel& model, const Eigen::VectorXd& u) {
  if (!cavitation_law(model).has_fill()) return false;
  for (int node = 0; node < model.grid.size(); ++node) {
    // On an edge at p_cav, u > 0 is oil that leaves, not pressure.
    if (u[node] > 1e-9 * fill_scale(model) && !open_edge(model, node)) return false;
  }
  return true;
}

// A steady film that lacks oil somewhere lacks a supply; one in a step has been asked for more than its gap holds.
std::string why_empty(const FilmModel& model, const Eigen::VectorXd& u, int node, bool is_steady) {
  const std::string lack = fmt::format(
      "the film is starved at {}: more oil leaves there than can come (the fill fraction would be {:.2g}); ",
      position_of_node(model, node), 1 + u[node] / fill_scale(model));
  if (!is_steady) return lack + "take a shorter step";
  const bool is_fed = model.supply.kind != SupplyKind::none || !model.features.empty();
  if (is_fed) return lack + "supply it there, at a higher pressure, or by `ambient_fill` at its edges";
  return lack +
         "nothing supplies it: add a supply line, a hole or groove, an edge pressure above that of cavitation, or "
         "`ambient_fill` for edges that lie in oil";
}

void explain(const FilmModel& model, const Eigen::VectorXd& u, double rtol, bool is_steady, FilmSolveSummary& summary) {
  if (!summary.domain.is_inside()) {
    summary.message = text(model, summary.domain);
    return;
  }
  const int empty = lowest_fill_node(model, u);
  if (summary.solved() && empty >= 0) {
    summary.set_solved(false);
    summary.worst_node = empty;
    summary.message = why_empty(model, u, empty, is_steady);
  } else if (summary.solved() && starved(model, u)) {
    summary.message =
        "the film carries no pressure: nothing supplies it above the cavitation pressure; add a supply line, "
        "a hole or an edge pressure above it";
  } else if (!summary.solved()) {
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

// Linearises at the end of a step: half of it, as often as it takes, where the film closes; where a pressure runs away
// the Jacobian is all but singular, or a law of viscosity is, and one careful step from where it began may do.
FilmDomain enter_domain(Reynolds& reynolds, const SurfaceMotion& motion, const FilmHistory& history,
                        const Eigen::VectorXd& before, Eigen::VectorXd& u) {
  FilmDomain domain = reynolds.linearise(motion, history, u);
  if (u == before) return domain;
  for (int k = 0; domain.violation == FilmDomain::Violation::closed && k < most_halvings; ++k) {
    u = 0.5 * (before + u);
    domain = reynolds.linearise(motion, history, u);
  }
  if (domain.violation != FilmDomain::Violation::pressure) return domain;
  Eigen::VectorXd du;
  (void)reynolds.linearise(motion, history, before);
  reynolds.newton_increment(du, {.is_regularised = true});
  u = before + step_length(reynolds.model(), motion, before, du) * du;
  return reynolds.linearise(motion, history, u);
}

// Newton's method (film.31). `least` is the smallest unknown an iterate may have [Pa].
FilmSolveSummary solve_by_newton(Reynolds& reynolds, const SurfaceMotion& motion, const FilmHistory& history,
                                 const FilmSolveOptions& options, Eigen::VectorXd& u,
                                 double least = -std::numeric_limits<double>::infinity()) {
  FilmSolveSummary summary;
  const Eigen::VectorXd start = u;
  Eigen::VectorXd du(u.size()), before = u;
  double last = std::numeric_limits<double>::infinity();
  for (;; ++summary.iterations) {
    summary.domain = enter_domain(reynolds, motion, history, before, u);
    if (!summary.domain.is_inside()) {
      u = start;
      return summary;
    }
    const FilmResidual residual = reynolds.residual();
    summary.relative_residual = residual.relative;
    summary.worst_node = residual.worst_node;
    summary.set_solved(summary.relative_residual <= options.rtol);
    if (summary.solved() || summary.iterations == options.max_iterations) return summary;
    reynolds.newton_increment(du, {.rtol = linear_tolerance(options.rtol, summary.relative_residual, last)});
    last = summary.relative_residual;
    before = u;
    reynolds.active_set().press_filled_nodes(u, du);
    u += step_length(reynolds.model(), motion, u, du) * du;
    reynolds.active_set().advance_rupture_front(u);
    u = u.cwiseMax(least);
  }
}

// Sweeps from node to node do not find a pressure that a whole feature has.
bool can_be_swept(const FilmModel& model) { return !has_restrictors(model); }

FilmSolveSummary solve_here(Reynolds& reynolds, const SurfaceMotion& motion, const FilmHistory& history,
                            const FilmSolveOptions& options, Eigen::VectorXd& u) {
  return options.solver == FilmSolver::sor && can_be_swept(reynolds.model())
             ? solve_by_sor(reynolds, motion, history, options, u)
             : solve_by_newton(reynolds, motion, history, options, u);
}

// A film front that no flow carries moves by one node per Newton step, and an error that spans the film takes SOR as
// many sweeps as there are nodes. On coarser grids the way is shorter: each grid starts from the solution on the one
// with half the nodes, so that the iterations stay few on every grid (film.34).
bool start_on_coarser_grid(const Reynolds& reynolds, const SurfaceMotion& motion, const FilmHistory& history,
                           const FilmSolveOptions& options, int& iterations, Eigen::VectorXd& u) {
  const FilmModel& model = reynolds.model();
  if (!can_be_coarsened(model.grid)) return false;
  CoarseFilm coarse = coarsened(model, motion, history, u);
  Reynolds coarse_reynolds(
      coarse.model, coarse.model.grid.size() < largest_direct ? LinearSolver::direct : reynolds.linear_solver().kind);
  FilmSolveOptions roughly = options;
  roughly.rtol = std::max(options.rtol, coarse_rtol);
  start_on_coarser_grid(coarse_reynolds, coarse.motion, coarse.history, roughly, iterations, coarse.u);
  const FilmSolveSummary summary = solve_here(coarse_reynolds, coarse.motion, coarse.history, roughly, coarse.u);
  iterations += summary.iterations;
  if (!summary.solved()) return false;
  u = refined(coarse, model);
  return true;
}

// Sweeps to the end, which arrive where Newton's method cycles around the answer: slower, but an answer.
FilmSolveSummary sweep_on(Reynolds& reynolds, const SurfaceMotion& motion, const FilmHistory& history,
                          const FilmSolveOptions& options, Eigen::VectorXd& u) {
  FilmSolveOptions sweeps = options;
  sweeps.solver = FilmSolver::sor;
  FilmSolveSummary summary = solve_by_sor(reynolds, motion, history, sweeps, u);
  if (summary.domain.is_inside()) summary.domain = reynolds.linearise(motion, history, u);
  summary.iterations = 0;  // of Newton's method
  return summary;
}

// Where steps of Newton's method cycle (a viscosity that rises by decades under a gap that jumps), sweeps with
// relaxed viscosity and thickness do not: they lead near the answer, Newton the rest of the way. Where it
// cycles around the answer itself, sweeps go there, too.
FilmSolveSummary rescue_by_sor(Reynolds& reynolds, const SurfaceMotion& motion, const FilmHistory& history,
                               const FilmSolveOptions& options, const Eigen::VectorXd& start, Eigen::VectorXd& u) {
  FilmSolveOptions sweeps = options;
  sweeps.solver = FilmSolver::sor;
  sweeps.rtol = std::max(options.rtol, rescue_rtol);
  sweeps.max_iterations = rescue_sweeps;
  Eigen::VectorXd near = start;
  int swept = 0;  // sweeps are no iterations of Newton's method
  start_on_coarser_grid(reynolds, motion, history, sweeps, swept, near);
  (void)solve_by_sor(reynolds, motion, history, sweeps, near);
  FilmSolveOptions without_fallback = options;
  without_fallback.max_iterations = std::min(options.max_iterations, patience);
  u = near;
  FilmSolveSummary summary = solve_by_newton(reynolds, motion, history, without_fallback, u);
  if (summary.solved() || !options.sweeps_to_the_end) return summary;
  u = near;
  summary = sweep_on(reynolds, motion, history, options, u);
  summary.iterations = without_fallback.max_iterations;
  return summary;
}

/// Pressures before the features less those behind their restrictors [Pa].
Eigen::VectorXd drops_over_restrictors(const FilmModel& model, const SurfaceMotion& motion, const FilmHistory& history,
                                       const Eigen::VectorXd& u) {
  const FilmObservables film = observe_film(model, motion, history, {}, u);
  return film.pressure_supplies - film.pressure_features;
}

// Where the root in an orifice's law makes Newton's method jump from side to side of no drop, resistances in its place
// that pass the same flow at the last drop do not: each film halves the logarithm of their error at least.
FilmSolveSummary rescue_by_resistances(Reynolds& reynolds, const SurfaceMotion& motion, const FilmHistory& history,
                                       const FilmSolveOptions& options, const Eigen::VectorXd& start,
                                       Eigen::VectorXd& u) {
  constexpr int most_films = 12;
  constexpr double near = 0.05;  // of the drop: from there Newton's method arrives
  const FilmModel& model = reynolds.model();
  FilmModel eased = model;
  const auto count = static_cast<Eigen::Index>(model.features.size());
  Eigen::VectorXd drop(count);
  for (Eigen::Index f = 0; f < count; ++f) {
    const double given = motion.feature_pressure.size() == 0 ? model.features[static_cast<std::size_t>(f)].pressure
                                                             : motion.feature_pressure[f];
    drop[f] = 0.5 * (given - model.p_cav);
  }
  Eigen::VectorXd found = start;
  for (int k = 0; k < most_films; ++k) {
    for (std::size_t f = 0; f < model.features.size(); ++f) {
      const std::optional<Restrictor>& restrictor = model.features[f].restrictor;
      const double d = std::abs(drop[static_cast<Eigen::Index>(f)]);
      if (restrictor && restrictor->throttles() && d > 0)
        eased.features[f].restrictor->law = FlowResistance{d / restrictor->flow(d).value};
    }
    Reynolds film(eased, reynolds.linear_solver().kind);
    const FilmSolveSummary summary = solve_by_newton(film, motion, history, options, found);
    if (!summary.solved()) break;
    const Eigen::VectorXd now = drops_over_restrictors(eased, motion, history, found);
    double change = 0;
    for (std::size_t f = 0; f < model.features.size(); ++f) {
      const auto i = static_cast<Eigen::Index>(f);
      if (model.features[f].restrictor && model.features[f].restrictor->throttles())
        change = std::max(change, std::abs(now[i] - drop[i]) / std::max(std::abs(drop[i]), 1.0));
    }
    drop = now;
    if (change < near) break;
  }
  u = found;
  return solve_by_newton(reynolds, motion, history, options, u);
}

// Streaks of oil that nothing feeds or drains may hold any amount, less than none included: once more from none there
// and never below, with a factorisation, which stays near where it begins.
FilmSolveSummary fill_from_none(Reynolds& reynolds, const SurfaceMotion& motion, const FilmHistory& history,
                                const FilmSolveOptions& options, Eigen::VectorXd& u) {
  const double none = -fill_scale(reynolds.model());
  u = u.cwiseMax(none);
  Reynolds direct(reynolds.model());
  const Eigen::VectorXd start = u;
  FilmSolveSummary summary = solve_by_newton(direct, motion, history, options, u, none);
  if (!summary.solved() && options.allows_fallback && can_be_swept(reynolds.model())) {
    const int before = summary.iterations;
    u = start;
    summary = sweep_on(reynolds, motion, history, options, u);
    summary.iterations = before;
  }
  if (summary.domain.is_inside()) summary.domain = reynolds.linearise(motion, history, u);
  return summary;
}

}  // namespace

FilmSolveSummary solve_film(Reynolds& reynolds, const SurfaceMotion& motion, const FilmHistory& history,
                            const FilmSolveOptions& options, Eigen::VectorXd& u) {
  Eigen::VectorXd start = u;
  FilmSolveSummary summary;
  int coarse_iterations = 0;
  const bool cold = u.isZero(0);
  if (!cold) {
    FilmSolveOptions without_fallback = options;
    if (options.solver != FilmSolver::sor) without_fallback.max_iterations = std::min(options.max_iterations, patience);
    summary = solve_here(reynolds, motion, history, without_fallback, u);
    const bool is_no_film = summary.iterations == 0 && !summary.domain.is_inside();
    if (is_no_film) start.setZero();
  }
  if (!summary.solved()) {
    u = start;
    start_on_coarser_grid(reynolds, motion, history, options, coarse_iterations, u);
    const int before = summary.iterations;
    summary = solve_here(reynolds, motion, history, options, u);
    summary.iterations += before;
  }
  if (!summary.solved() && options.allows_fallback && options.solver != FilmSolver::sor &&
      can_be_swept(reynolds.model()) && options.max_iterations > patience) {
    const int before = summary.iterations;
    summary = rescue_by_sor(reynolds, motion, history, options, start, u);
    summary.iterations += before;
  }
  if (!summary.solved() && options.allows_fallback && has_restrictors(reynolds.model())) {
    const int before = summary.iterations;
    summary = rescue_by_resistances(reynolds, motion, history, options, start, u);
    summary.iterations += before;
  }
  summary.coarse_iterations = coarse_iterations;
  if (summary.solved() && lowest_fill_node(reynolds.model(), u) >= 0) {
    const int before = summary.iterations;
    summary = fill_from_none(reynolds, motion, history, options, u);
    summary.iterations += before;
    summary.coarse_iterations = coarse_iterations;
  }
  explain(reynolds.model(), u, options.rtol, history.dt == 0, summary);
  return summary;
}

}  // namespace hersey::film
