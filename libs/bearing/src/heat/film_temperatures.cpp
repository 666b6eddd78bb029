#include "heat/film_temperatures.h"

#include <algorithm>
#include <cstddef>

#include "gap/oil_temperatures.h"
#include "hersey/core/contract.h"

namespace hersey::bearing {
namespace {

// Of a change of the logarithm of viscosity by shear, the rise of temperature that changes it as much [K].
constexpr double kHeatOfShear = 30;

}  // namespace

Eigen::Index layer_temperatures(const film::FilmHeat& heat) { return heat.state().film.size(); }

Eigen::Index shear_temperatures(const film::FilmHeat& heat) { return heat.state().thinning.size(); }

Eigen::VectorXd film_temperatures(const film::FilmHeat& heat) {
  const film::HeatState& now = heat.state();
  const double T_supply = heat.thermal().T_supply;
  const auto ends = static_cast<Eigen::Index>(now.ends.size());
  Eigen::VectorXd x(now.film.size() + now.thinning.size() + ends);
  x.head(now.film.size()) = now.film.array() - T_supply;
  x.segment(now.film.size(), now.thinning.size()) = kHeatOfShear * now.thinning.array().log();
  for (Eigen::Index k = 0; k < ends; ++k) x[x.size() - ends + k] = now.ends[static_cast<std::size_t>(k)].rise;
  return x;
}

void set_film_temperatures(const Eigen::VectorXd& x, film::FilmHeat& heat) {
  film::HeatState next = heat.state();
  const Eigen::Index film = next.film.size(), thinning = next.thinning.size();
  const auto ends = static_cast<Eigen::Index>(next.ends.size());
  HERSEY_REQUIRE(x.size() == film + thinning + ends, "temperatures of this film");
  const double T_supply = heat.thermal().T_supply;
  const auto within_trials = [T_supply](double rise) {
    return std::clamp(T_supply + rise, coldest_trial, hottest_trial);
  };
  next.film = x.head(film).unaryExpr(within_trials);
  next.thinning = (x.segment(film, thinning) / kHeatOfShear).array().exp();
  for (Eigen::Index k = 0; k < ends; ++k)
    next.ends[static_cast<std::size_t>(k)].rise = within_trials(x[film + thinning + k]) - T_supply;
  heat.set_state(next);
}

}  // namespace hersey::bearing
