// A journal bearing under a constant load: where its journal runs, and how stiff its film is there.
#include <hersey/bearing/steady_bearing.h>

#include <cstdio>

int main() {
  using namespace hersey;
  const film::FilmModel film{
      .R = 22.5e-3, .L = 15.6e-3, .c = 34e-6, .supply = {.kind = film::SupplyKind::widest_gap, .pressure = 1e5}};
  bearing::OperatingPoint point;
  point.journal_speed = 373.85;            // 3570 rpm [rad/s]
  point.load = Eigen::Vector2d(0, -2500);  // on the journal [N]
  bearing::SteadyState state;
  const bearing::SteadySummary summary = bearing::solve_steady(film, point, {}, state);
  if (!summary.solved()) {
    std::fprintf(stderr, "no answer: %s\n", summary.message.c_str());
    return 1;
  }
  std::printf("eccentricity ratio  %.3f\n", state.e.norm() / film.c);
  std::printf("thinnest film       %.2f um\n", 1e6 * state.film.h_min);
  std::printf("peak pressure       %.2f MPa\n", 1e-6 * state.film.p_max);
  std::printf("stiffness k_yy      %.3g N/m\n", state.coefficients.stiffness(1, 1));
}
