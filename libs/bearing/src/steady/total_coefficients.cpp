#include "hersey/bearing/total_coefficients.h"

#include <algorithm>

#include "hersey/bearing/clearance.h"

namespace hersey::bearing {
namespace {

// Steps over the smallest gap: the difference of two is off by about the square of this, and by what films and
// temperatures, found to 1e-8, leave over it.
constexpr double kStep = 1e-3;

// Of the force on the shell, in the order of the coefficients' rows.
Eigen::Vector4d generalised(const Vector6& wrench) { return {wrench[3], wrench[4], wrench[1], -wrench[0]}; }

/// e and tilt of a point in the order of the coefficients' columns.
double& coordinate(OperatingPoint& point, int k) { return k < 2 ? point.e[k] : point.tilt[k - 2]; }
double& rate(OperatingPoint& point, int k) { return k < 2 ? point.e_rate[k] : point.tilt_rate[k - 2]; }

}  // namespace

SteadySummary find_total_coefficients(const film::FilmModel& model, const SteadyState& state, const SolveBeside& solve,
                                      DynamicCoefficients& total) {
  OperatingPoint here = state.point;
  here.load.reset();
  here.e = state.e;
  const double step = kStep * std::max(state.film.h_min, 0.01 * clearance(model));
  const double frequency = here.film_speed(clearance(model));
  DynamicCoefficients found;
  SteadySummary summary;
  const auto slope = [&](double& varied, OperatingPoint& point, double by) -> Eigen::Vector4d {
    const double middle = varied;
    Eigen::Vector4d difference = Eigen::Vector4d::Zero();
    for (const double side : {1.0, -1.0}) {
      varied = middle + side * by;
      SteadyState beside;
      summary = solve(point, beside);
      if (!summary.solved()) break;
      difference += side * generalised(beside.film.wrench_on_shell);
    }
    varied = middle;
    return difference / (2 * by);
  };
  for (int k = 0; k < 4; ++k) {
    const double by = k < 2 ? step : 2 * step / model.L;
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
