#include "kinds/journal/short_bearing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hersey/core/contract.h"
#include "hersey/core/two_pi.h"

namespace hersey::bearing {
namespace {

// No first guess thins the oil by more than this.
constexpr double kThinnestGuess = 0.2;

// Iterations in which the guess finds its own viscosity, each half of the way.
constexpr int kTurnsOfGuess = 12;

}  // namespace

Eigen::Vector2d ocvirk_position(const film::FilmModel& model, const OperatingPoint& point) {
  HERSEY_REQUIRE(point.load && point.load->norm() > 0, "a load that is not zero");
  constexpr double pi = std::numbers::pi;
  const double c = clearance(model, point), R_c = model.R / c, slenderness = model.L / (2 * model.R);
  // Where nothing is entrained, feeds lift the journal: half-way down it is near them, and clear of the wall.
  if (point.entraining_speed() == 0) return 0.5 * c * Eigen::Vector2d(point.load->head<2>().normalized());
  const double revolutions = std::abs(point.entraining_speed()) / (2 * pi);
  const double wanted = model.lubricant.mu0 * revolutions * R_c * R_c * 2 * model.R * model.L / point.load->norm() *
                        slenderness * slenderness;
  // S (L/D)^2 falls from infinity to zero as epsilon goes from 0 to 1.
  double low = 0, high = 1;
  for (int k = 0; k < 60; ++k) {
    const double x = (low + high) / 2, y = 1 - x * x;
    (y * y / (pi * x * std::sqrt(pi * pi * y + 16 * x * x)) > wanted ? low : high) = x;
  }
  // A bearing of finite width stands nearer to its centre or, with contact, is kept off the wall: keep away from both.
  const film::Asperities& rough = model.asperities;
  const double reach = rough.model == film::AsperityModel::none ? 0 : rough.mean_summit_height + 3 * rough.sigma;
  const double contact = reach / c;
  const double epsilon = std::clamp(low, 1e-4, std::clamp(1 - contact, 0.5, 0.99));
  const double attitude = std::atan2(pi * std::sqrt(1 - epsilon * epsilon), 4 * epsilon);
  const double angle = std::atan2(point.load->y(), point.load->x()) + std::copysign(attitude, point.entraining_speed());
  // A tilted journal needs room at both edges.
  const double room = std::max(0.1, 1 - 0.5 * model.L * point.tilt.norm() / c);
  return epsilon * room * c * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

// Beside the middle some oil always leaves.
double likely_temperature(const film::FilmModel& model, double T_supply, const OperatingPoint& point) {
  const film::Lubricant& oil = model.lubricant;
  if (!film::depends_on_temperature(oil.temperature_law)) return T_supply;
  const double U = model.R * std::abs(point.journal_speed - point.shell_speed);
  const double carried = model.R * std::abs(point.entraining_speed()) * clearance(model) * model.L;
  const double mu_supply = film::viscosity_at(oil.temperature_law, T_supply);
  film::FilmModel at = model;
  double T = T_supply;
  for (int k = 0; k < kTurnsOfGuess && carried > 0; ++k) {
    at.lubricant.mu0 = film::viscosity_at(oil.temperature_law, T);
    if (at.lubricant.mu0 < kThinnestGuess * mu_supply) break;
    const double e = point.load ? ocvirk_position(at, point).norm() : point.e.norm();
    const double epsilon = std::clamp(e / clearance(model, point), 0.1, 0.95);
    const double power =
        at.lubricant.mu0 * U * U * two_pi * model.R * model.L / (clearance(model) * std::sqrt(1 - epsilon * epsilon));
    const double rise = power / (2 * oil.density * oil.specific_heat * epsilon * carried);
    T += 0.5 * (T_supply + rise - T);
  }
  return T;
}

}  // namespace hersey::bearing
