#pragma once

#include <Eigen/Dense>

#include "hersey/film/film_model.h"
#include "hersey/film/film_solve_summary.h"
#include "hersey/film/reynolds.h"

namespace hersey::film {

/// Returns the linear solver with which a film's Reynolds object is made.
[[nodiscard]] constexpr LinearSolver linear_solver_of(FilmSolver solver) {
  return solver == FilmSolver::multigrid ? LinearSolver::multigrid : LinearSolver::direct;
}

/// Returns the solver of a film for which none is chosen: Newton's method, from 15,000 nodes on with multigrid. There
/// multigrid is the faster of the two (a factor's cost grows with the nodes' power of 1.5 to 2, that of multigrid in
/// proportion to them) and gives the same film. Half or twice that size costs a film some tenths of its time.
[[nodiscard]] FilmSolver usual_solver(const Grid& grid);

/// Returns the node whose fill fraction is furthest below zero; -1: none is. A negative fill fraction is no film: more
/// oil leaves the node than comes in, though the equations are satisfied.
[[nodiscard]] int lowest_fill_node(const FilmModel& model, const Eigen::VectorXd& u);

/// Solves the film for u at given surfaces, starting from `u`, from zeros where that is no film there. From all zeros
/// (a cold start), and where a start does not lead to an answer soon, it starts from the solution on a grid of half the
/// nodes, and that from the next. On failure `u` is the last iterate. `newton` and `multigrid` iterate alike; their
/// linear systems are solved as `reynolds` was made to (linear_solver_of).
[[nodiscard]] FilmSolveSummary solve_film(Reynolds& reynolds, const SurfaceMotion& motion, const FilmHistory& history,
                                          const FilmSolveOptions& options, Eigen::VectorXd& u);

}  // namespace hersey::film
