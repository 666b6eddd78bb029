// Accuracy per cost: error of the film's force against a closed form, a published table's case and the extrapolated
// fine grid, and the time each solver takes for it on each grid.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "film_cases.h"

namespace {

using namespace hersey;
using namespace hersey::film;

struct Solver {
  FilmSolver kind;
  const char* name;
  double rtol;
  int largest;  ///< nodes around the bearing, beyond which it takes too long
};

constexpr std::array<Solver, 3> solvers{{{FilmSolver::newton, "newton", 1e-10, 480},
                                         {FilmSolver::multigrid, "multigrid", 1e-10, 1920},
                                         {FilmSolver::sor, "sor", 1e-6, 240}}};

/// Force of the pressure alone is what tables give: the shear's is O(c/R) of it and left out.
void only_pressure(FilmModel& model) { model.shear_force = ShearForce::torque_only; }

// Load per width of a long journal, full film: 12 pi e/((2 + e^2) sqrt(1 - e^2)) mu omega R/psi^2 (Sommerfeld 1904).
// With pressure everywhere above p_cav, closed edges and one fixed pressure in the widest gap.
BenchBearing long_bearing(const Grid& grid, double e) {
  BenchBearing b = bench_bearing(grid, 1, e);
  only_pressure(b.model);
  b.model.cavitation = Cavitation::guembel;
  b.model.edge_left.kind = b.model.edge_right.kind = EdgeKind::closed;
  b.model.supply.pressure = 1e9;
  return b;
}

double sommerfeld_load(const FilmModel& m, double e) {
  const double psi = m.c / m.R;
  return 12 * std::numbers::pi * e / ((2 + e * e) * std::sqrt(1 - e * e)) * m.lubricant.mu0 * 100 * m.R * m.L /
         (psi * psi);
}

BenchBearing table_bearing(const Grid& grid, double e) {
  BenchBearing b = bench_bearing(grid, 1, e);
  only_pressure(b.model);
  return b;
}

// S = mu N (R/c)^2 L D/W.
double sommerfeld_number(const FilmModel& m, double load) {
  const double psi = m.c / m.R;
  return m.lubricant.mu0 * 100 / (2 * std::numbers::pi) / (psi * psi) * m.L * 2 * m.R / load;
}

double force(const TimedFilm& film) { return film.wrench.segment<2>(3).norm(); }

const std::vector<Grid>& grids() {
  static const std::vector<Grid> all{{60, 13}, {120, 26}, {240, 52}, {480, 104}, {960, 208}};
  return all;
}

template <class Make, class Error>
bool print_case(const char* title, Make&& make, Error&& error) {
  fmt::print("\n{}\n{:>11}", title, "grid");
  for (const Solver& solver : solvers) fmt::print(" | {:>9} s {:>10}", solver.name, "error");
  fmt::print("\n");
  bool converged = true;
  for (const Grid& grid : grids()) {
    const BenchBearing b = make(grid);
    fmt::print("{:>11}", fmt::format("{} x {}", grid.n_phi, grid.n_z));
    for (const Solver& solver : solvers) {
      if (grid.n_phi > solver.largest) {
        fmt::print(" | {:>11} {:>10}", "-", "-");
        continue;
      }
      const int runs = solver.kind == FilmSolver::sor || grid.size() > 20000 ? 1 : 5;
      const TimedFilm film = timed_film(b, {.solver = solver.kind, .rtol = solver.rtol, .max_iterations = 200}, runs);
      converged = converged && film.summary.solved();
      fmt::print(" | {:11.4f} {:>10}", film.seconds,
                 film.summary.solved() ? fmt::format("{:.1e}", error(b.model, film)) : "no answer");
    }
    fmt::print("\n");
  }
  return converged;
}

// Second order: the finest grid and the one before give the value without a grid.
double extrapolated(double epsilon) {
  std::array<double, 2> load{};
  for (int k : {0, 1}) {
    const BenchBearing b = table_bearing({.n_phi = 720 << k, .n_z = (78 << k) + 1}, epsilon);
    load[k] = force(timed_film(b, {.solver = FilmSolver::multigrid}, 1));
  }
  return load[1] + (load[1] - load[0]) / 3;
}

}  // namespace

int main() {
  fmt::print(
      "Relative error of the load and processor time from nothing; newton and multigrid to a residual of 1e-10,\n");
  fmt::print("sor to 1e-6.\n");
  const double e = 0.8;
  const bool closed_form = print_case(
      "Long journal, full film, epsilon 0.8 (closed form of Sommerfeld)",
      [&](const Grid& grid) { return long_bearing(grid, e); },
      [&](const FilmModel& m, const TimedFilm& film) { return std::abs(force(film) / sommerfeld_load(m, e) - 1); });
  const bool table = print_case(
      "L/D = 1, epsilon 0.8, film from the widest gap on (S = 0.044558, finite_360.csv)",
      [&](const Grid& grid) { return table_bearing(grid, e); },
      [&](const FilmModel& m, const TimedFilm& film) {
        return std::abs(sommerfeld_number(m, force(film)) / 0.044558 - 1);
      });
  const double fine = extrapolated(e);
  const bool richardson = print_case(
      "The same against its own value without a grid (Richardson from 720 x 79 and 1440 x 157)",
      [&](const Grid& grid) { return table_bearing(grid, e); },
      [&](const FilmModel&, const TimedFilm& film) { return std::abs(force(film) / fine - 1); });
  return closed_form && table && richardson ? 0 : 1;
}
