#include "gap/hot_clearance.h"

#include <fmt/format.h>

#include <limits>

#include "hersey/bearing/clearance.h"
#include "hersey/core/two_pi.h"

namespace hersey::bearing {
namespace {

/// Of the angles of a grid, their fraction of a turn.
Eigen::VectorXd fractions(const film::Grid& grid) {
  Eigen::VectorXd fraction(grid.n_phi);
  for (int i = 0; i < grid.n_phi; ++i) {
    const double before = i > 0 ? grid.phi(i - 1) : grid.phi(grid.n_phi - 1) - two_pi;
    const double after = i + 1 < grid.n_phi ? grid.phi(i + 1) : grid.phi(0) + two_pi;
    fraction[i] = (after - before) / (2 * two_pi);
  }
  return fraction;
}

}  // namespace

HotClearance hot_clearance(const film::FilmModel& model, double growth, const Eigen::VectorXd& shell,
                           const Eigen::VectorXd& journal) {
  const double even = clearance(model, growth);
  if (shell.size() == 0 && journal.size() == 0) return {even, 0, false};
  const film::Grid& grid = model.grid;
  const Eigen::VectorXd fraction = fractions(grid);
  HotClearance hot{std::numeric_limits<double>::infinity(), 0, true};
  for (int j = 0; j < grid.n_z; ++j) {
    double at = even;
    for (int i = 0; i < grid.n_phi; ++i) {
      if (shell.size() > 0) at += fraction[i] * shell[grid.index(i, j)];
      if (journal.size() > 0) at -= fraction[i] * journal[grid.index(i, j)];
    }
    if (at < hot.smallest) hot.smallest = at, hot.z = model.L * grid.z_over_L(j);
  }
  return hot;
}

std::string seizure_text(const film::FilmModel& model, const HotClearance& hot, const film::HeatObservables& observed,
                         const std::string& place) {
  const auto celsius = [](double T) { return T - film::zero_celsius; };
  return fmt::format(
      "a seizure: the clearance of {:.4g} um closes to {:.4g} um{} with the shell at {:.0f} degC and the journal at "
      "{:.0f} degC{}",
      1e6 * clearance(model), 1e6 * hot.smallest, hot.has_shape ? fmt::format(" at z = {:.3g} mm", 1e3 * hot.z) : "",
      celsius(observed.T_shell_wall), celsius(observed.T_journal_wall), place.empty() ? "" : " (" + place + ")");
}

}  // namespace hersey::bearing
