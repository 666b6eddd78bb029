#include <hersey/film/film_solver.h>
#include <hersey/film/observables.h>

#include <cstdio>

using namespace hersey::film;

int main() {  // a journal bearing at eccentricity ratio 0.6 and 3570 rpm, fed along its widest gap
  const FilmModel model{.R = 22.5e-3, .L = 15.6e-3, .c = 34e-6, .supply = {.kind = SupplyKind::widest_gap}};
  SurfaceMotion motion{.g_rate = Eigen::VectorXd::Zero(model.grid.size()), .u_journal = 373.85 * model.R};
  motion.g.resize(model.grid.size());
  for (int k = 0; k < motion.g.size(); ++k)
    motion.g[k] = model.c * (1 + 0.6 * std::cos(2 * EIGEN_PI * (k / model.grid.n_z) / model.grid.n_phi));
  Reynolds reynolds(model);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model.grid.size());
  const FilmSolveSummary summary = solve_film(reynolds, motion, {}, {}, u);
  std::printf("peak pressure %.2f MPa\n", 1e-6 * observe_film(model, motion, {}, {-0.6 * model.c, 0}, u).p_max);
  return summary.solved() ? 0 : 1;
}
