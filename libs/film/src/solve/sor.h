#pragma once

#include <Eigen/Dense>

#include "hersey/film/film_solve_summary.h"
#include "hersey/film/reynolds.h"

namespace hersey::film {

/// Projected successive over-relaxation (theory manual, film: SOR): sweeps over the nodes, each solved for its pressure
/// or fill fraction with its neighbours' latest values. One iteration is a thousand sweeps.
[[nodiscard]] FilmSolveSummary solve_by_sor(Reynolds& reynolds, const SurfaceMotion& motion, const FilmHistory& history,
                                            const FilmSolveOptions& options, Eigen::VectorXd& u);

}  // namespace hersey::film
