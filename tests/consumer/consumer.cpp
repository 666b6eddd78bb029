#include <cmath>
#include <cstdio>
#include <hersey/film/film_solver.h>
#include <hersey/film/observables.h>

int main() {  // the film of a journal bearing at eccentricity ratio 0.6, 3570 rpm
  const hersey::film::FilmModel model{.R = 22.5e-3, .L = 15.6e-3, .c = 34e-6};
  hersey::film::Reynolds reynolds(model);
  hersey::film::SurfaceMotion motion{.u_journal = 373.85 * model.R};
  motion.g.resize(model.grid.size());
  motion.g_rate.setZero(model.grid.size());
  for (int k = 0; k < model.grid.size(); ++k)
    motion.g[k] = model.c * (1 + 0.6 * std::cos(2 * M_PI * (k / model.grid.n_z) / model.grid.n_phi));
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model.grid.size());
  const auto summary = solve_film(reynolds, motion, {}, {}, u);
  const auto seen = observe_film(model, motion, {}, {0.6 * model.c, 0}, u);
  std::printf("peak pressure %.2f MPa, smallest film %.2f um\n", seen.p_max * 1e-6, seen.h_min * 1e6);
  return summary.converged ? 0 : 1;
}
