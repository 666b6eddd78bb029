#pragma once

#include <Eigen/Dense>
#include <string>

#include "hersey/film/film_domain.h"
#include "hersey/film/film_model.h"
#include "hersey/film/reynolds.h"

namespace hersey::film {

struct FilmSolveOptions {
  FilmSolver solver = FilmSolver::newton;
  double rtol = 1e-10;      ///< on Reynolds::relative_residual, > 0
  int max_iterations = 50;  ///< Newton iterations, or thousands of SOR sweeps
  bool insists = true;      ///< where Newton's method cycles, SOR sweeps go on; a step in time may rather be shortened
};

/// The linear solver a film wants from its Reynolds object.
[[nodiscard]] constexpr LinearSolver linear_solver_of(FilmSolver solver) {
  return solver == FilmSolver::multigrid ? LinearSolver::multigrid : LinearSolver::direct;
}

struct FilmSolveSummary {
  bool converged = false;
  int iterations = 0;         ///< Newton iterations, or SOR sweeps, on the film's own grid
  int coarse_iterations = 0;  ///< likewise on coarser grids, where the start was sought
  double relative_residual = 0;
  int worst_node = 0;
  FilmDomain domain;    ///< of the last trial; outside: the iteration had nowhere to go
  std::string message;  ///< why it ended, where it did not converge; also where it converged to a film without oil
};

/// Solves the film for u at given surfaces, starting from `u`, from zeros where that is no film there. From all zeros
/// (a cold start), and where a start does not lead to an answer soon, it starts from the solution on a grid of half the
/// nodes, and that from the next. On failure `u` is the last iterate. `newton` and `multigrid` iterate alike; their
/// linear systems are solved as `reynolds` was made to (linear_solver_of).
[[nodiscard]] FilmSolveSummary solve_film(Reynolds& reynolds, const SurfaceMotion& motion, const FilmHistory& history,
                                          const FilmSolveOptions& options, Eigen::VectorXd& u);

}  // namespace hersey::film
