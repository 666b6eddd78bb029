#pragma once

#include <Eigen/Dense>
#include <string>

#include "hersey/film/film_model.h"
#include "hersey/film/reynolds.h"

namespace hersey::film {

struct FilmSolveOptions {
  FilmSolver solver = FilmSolver::newton;
  double rtol = 1e-10;      ///< on Reynolds::relative_residual, > 0
  int max_iterations = 50;  ///< Newton iterations, or thousands of SOR sweeps
};

struct FilmSolveSummary {
  bool converged = false;
  int iterations = 0;  ///< Newton iterations, or SOR sweeps
  double relative_residual = 0;
  int worst_node = 0;
  std::string message;  ///< why it ended, where it did not converge; also where it converged to a film without oil
};

/// Solves the film for u at given surfaces, starting from `u` (all zeros is a cold start). Where Newton does not arrive
/// soon, it starts over from the solution on a coarser grid. On failure `u` is the last
/// iterate.
[[nodiscard]] FilmSolveSummary solve_film(Reynolds& reynolds, const SurfaceMotion& motion, const FilmHistory& history,
                                          const FilmSolveOptions& options, Eigen::VectorXd& u);

}  // namespace hersey::film
