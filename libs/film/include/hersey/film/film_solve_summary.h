#pragma once

#include "hersey/core/outcome.h"
#include "hersey/film/film_domain.h"
#include "hersey/film/film_model.h"

namespace hersey::film {

struct FilmSolveOptions {
  FilmSolver solver = FilmSolver::newton;
  double rtol = 1e-10;      ///< on Reynolds::relative_residual, > 0
  int max_iterations = 50;  ///< Newton iterations, or thousands of SOR sweeps
  bool allows_fallback =
      true;  ///< where Newton's method cycles, SOR sweeps go on; a step in time may rather be shortened
  /// Sweeps go on to the answer where Newton's method cycles from near it, too; thousands of them.
  bool sweeps_to_the_end = true;
};

/// Result of a film's solution. `message` states why a film is unsolved, or that a solved one has no oil.
struct [[nodiscard]] FilmSolveSummary : Outcome {
  int iterations = 0;         ///< Newton iterations, or SOR sweeps, on the film's own grid
  int coarse_iterations = 0;  ///< iterations on coarser grids, from which the start was taken
  double relative_residual = 0;
  int worst_node = 0;
  FilmDomain domain;  ///< of the last trial; outside: no shorter increment lay inside
};

}  // namespace hersey::film
