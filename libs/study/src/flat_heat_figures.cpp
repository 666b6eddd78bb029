#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "figure_table.h"
#include "hersey/film/temperature_law.h"

// Temperatures and heat of films between pads and a runner.
namespace hersey::study {
namespace {

using FilmHeat = film::HeatObservables;

/// Supplies that are fed: a pocket that nothing feeds holds the film's oil.
std::vector<std::size_t> fed_features(const Solution& s) {
  std::vector<std::size_t> fed;
  for (std::size_t k = 0; k < s.model.features.size(); ++k)
    if (s.model.features[k].is_fed) fed.push_back(k);
  return fed;
}

std::vector<std::string> fed_names(const Solution& s) {
  std::vector<std::string> names;
  if (!has_film_heat(s)) return names;
  for (const std::size_t k : fed_features(s)) names.push_back(s.model.features[k].name);
  return names;
}

// Pads alike give a runner no heat each. What the search leaves of it, over the heat made, has no balance of its own.
constexpr double kNoExchange = 1e-7;

double network_error(const Solution& s) {
  const film::NetworkObservables& network = s.state.heat->network;
  const double largest = std::max({network.exchanged, std::abs(network.to_fixed), std::abs(network.stored)});
  return largest > kNoExchange * s.state.heat->observed.balance.power ? network.error() : 0;
}

Line temperature_line(std::string_view key, double FilmHeat::*T, double bearing::GridError::*error) {
  return {key, kCelsius, celsius_of(T), {.grid_error = error_of(error), .only = has_film_heat}};
}

Line heat_line(std::string_view key, std::string_view label, double film::HeatBalance::*term) {
  return {key, label, kWatt, heat_term(term), {.only = has_film_heat}};
}

}  // namespace

bool has_film_heat(const Solution& s) { return s.state.heat.has_value(); }

std::function<double(const Solution&)> celsius_of(double film::HeatObservables::*T) {
  return [T](const Solution& s) { return s.state.heat->observed.*T - film::zero_celsius; };
}

std::function<double(const Solution&)> heat_term(double film::HeatBalance::*term) {
  return [term](const Solution& s) {
    const film::HeatBalance& b = s.state.heat->observed.balance;
    return without_round_off(b.*term, b.power);
  };
}

Group flat_heat(const std::vector<Line>& oil, const std::vector<Line>& face) {
  using Balance = film::HeatBalance;
  using Error = bearing::GridError;
  Group group{"heat", {temperature_line("T_max", &FilmHeat::T_max, &Error::T_max)}};
  group = with(std::move(group), oil);
  group.lines.push_back(temperature_line("T_face_max", &FilmHeat::T_shell_max, &Error::T_shell_max));
  group = with(std::move(group), face);
  return with(std::move(group),
              {temperature_line("T_face_mean", &FilmHeat::T_shell_mean, &Error::T_shell_mean),
               temperature_line("T_runner", &FilmHeat::T_journal, &Error::T_journal),
               temperature_line("T_film", &FilmHeat::T_film_mean, &Error::T_film),
               temperature_line("T_side", &FilmHeat::T_side, &Error::T_side),
               {"T_supply_<name>",
                kCelsius,
                [](const Solution& s, std::size_t k) {
                  return s.state.heat->observed.T_supplies[static_cast<Eigen::Index>(fed_features(s)[k])] -
                         film::zero_celsius;
                },
                {.only = has_film_heat, .each = fed_names}},
               {"heat_dissipated", kWatt, heat_term(&Balance::power), {.only = has_film_heat}},
               heat_line("heat_to_oil", "  carried away by the oil", &Balance::to_oil),
               heat_line("heat_to_pads", "  into the pads", &Balance::to_shell),
               heat_line("heat_to_runner", "  into the runner", &Balance::to_journal),
               {"heat_balance_error",
                "  error of the balance of heat",
                kNone,
                [](const Solution& s) { return s.state.heat->observed.balance.error(); },
                {.only = has_film_heat}},
               {"T_node_<name>",
                kCelsius,
                [](const Solution& s, std::size_t k) {
                  return s.state.heat->network.T[static_cast<Eigen::Index>(k)] - film::zero_celsius;
                },
                {.each = [](const Solution& s) { return s.node_names; }}},
               {"network_balance_error",
                "  error of the balance of heat of these bodies",
                kNone,
                network_error,
                {.only = [](const Solution& s) { return !s.node_names.empty(); }}}});
}

}  // namespace hersey::study
