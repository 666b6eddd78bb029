#include "hersey/bearing/total_coefficients.h"

#include <algorithm>
#include <memory>
#include <variant>

#include "hersey/bearing/bearing_kind.h"
#include "hersey/bearing/clearance.h"

namespace hersey::bearing {
namespace {

// Steps over the smallest gap: the difference of two is off by about the square of this, and by what films and
// temperatures, found to 1e-8, leave over it.
constexpr double kStep = 1e-3;

/// Coordinate k of a point, positions before slopes, in the order of the coefficients' columns.
double& coordinate(OperatingPoint& point, Eigen::Index k) {
  return k < point.e.size() ? point.e[k] : point.tilt[k - point.e.size()];
}
double& rate(OperatingPoint& point, Eigen::Index k) {
  return k < point.e_rate.size() ? point.e_rate[k] : point.tilt_rate[k - point.e_rate.size()];
}

/// Distance from the film's middle at which slopes change its thickness most [m].
double lever(const film::FilmModel& model) {
  const film::Grid& grid = model.grid;
  if (std::holds_alternative<film::Annulus>(model.surface)) return model.R + 0.5 * model.L;
  if (std::holds_alternative<film::Plane>(model.surface))
    return std::max(0.5 * model.L, 0.5 * model.R * (grid.phi(grid.n_phi - 1) - grid.phi(0)));
  return 0.5 * model.L;
}

}  // namespace

SteadySummary find_total_coefficients(const film::FilmModel& model, const SteadyState& state, const SolveBeside& solve,
                                      DynamicCoefficients& total) {
  OperatingPoint here = state.point;
  here.load.reset();
  here.e = state.e;
  const double step = kStep * std::max(state.film.h_min, 0.01 * clearance(model));
  const double frequency = here.film_speed(clearance(model), model.L);
  const std::unique_ptr<SteadyCoordinates> coordinates = state.kind->steady_coordinates(model);
  const SteadyCoordinates::ForceRows& rows = coordinates->force_rows();
  here.e_rate.conservativeResizeLike(Coordinates::Zero(here.e.size()));
  DynamicCoefficients found;
  found.stiffness = found.damping = DynamicCoefficients::Matrix::Zero(rows.rows(), rows.rows());
  SteadySummary summary;
  const auto slope = [&](double& varied, OperatingPoint& point, double by) -> Eigen::VectorXd {
    const double middle = varied;
    Eigen::VectorXd difference = Eigen::VectorXd::Zero(rows.rows());
    for (const double side : {1.0, -1.0}) {
      varied = middle + side * by;
      SteadyState beside;
      summary = solve(point, beside);
      if (!summary.solved()) break;
      difference += side * rows * beside.film.wrench_on_shell;
    }
    varied = middle;
    return difference / (2 * by);
  };
  for (Eigen::Index k = 0; k < rows.rows(); ++k) {
    const double by = k < coordinates->count() ? step : step / lever(model);
    OperatingPoint point = here;
    found.stiffness.col(k) = slope(coordinate(point, k), point, by);
    if (!summary.solved()) return summary;
    if (frequency > 0) found.damping.col(k) = slope(rate(point, k), point, frequency * by);
    if (!summary.solved()) return summary;
  }
  total = found;
  return summary;
}

}  // namespace hersey::bearing
