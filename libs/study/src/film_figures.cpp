#include <cmath>
#include <limits>

#include "figure_table.h"
#include "hersey/bearing/restricted_feeds.h"

// Lines that the tables of all kinds of bearing have in common.
namespace hersey::study {
namespace {

/// Names of the film's features, for families of figures.
std::vector<std::string> feature_names(const Solution& s) {
  std::vector<std::string> names;
  for (Eigen::Index f = 0; f < s.state.film.flow_features.size(); ++f)
    names.push_back(s.model.features[static_cast<std::size_t>(f)].name);
  return names;
}

}  // namespace

bool conserves_oil(const Solution& s) { return !film::cavitation_law(s.model).loses_oil(); }

bool shears_differ(const Solution& s) { return s.state.film.power_film_other_shear != s.state.film.power_film; }

bool ruptures(const Solution& s) { return std::isfinite(s.state.film.rupture_angle); }

double load_error(const Solution& s) { return is_load_given(s) ? -1 : s.grid_error.load; }

Line minimum_thickness_over_features() {
  return {"h_min_features", kMicrometre, film(&film::FilmObservables::h_min_features), {.only = [](const Solution& s) {
            return std::isfinite(s.state.film.h_min_features);
          }}};
}

Line power_not_explained(double (*put_in)(const Solution&)) {
  return {"power_error_share",
          "  of it not explained by the film's integrals",
          kNone,
          [put_in](const Solution& s) { return put_in(s) / s.state.film.power_taken() - 1; },
          {.only = [](const Solution& s) { return s.state.film.power_taken() > 0; }}};
}

Line flow_through_features() {
  return {"flow_feature_<name>",
          "  through <name>",
          kFlow,
          [](const Solution& s, std::size_t k) { return s.state.film.flow_features[static_cast<Eigen::Index>(k)]; },
          {.each = feature_names}};
}

std::vector<Line> restricted_feeds() {
  using Feeds = bearing::RestrictedFeeds;
  const auto feeds = [](const Solution& s) { return Feeds(s.model, s.state.film); };
  return {{"pressure_feature_<name>",
           kMegapascal,
           [feeds](const Solution& s, std::size_t k) { return feeds(s).pressure(k); },
           {.each = [](const Solution& s) { return Feeds::names(s.model); }}},
          {"pressure_ratio_<name>",
           kNone,
           [feeds](const Solution& s, std::size_t k) { return feeds(s).pressure_ratio(k); },
           {.each = [](const Solution& s) { return Feeds::names_with_supply(s.model); }}},
          {"pumping_power",
           kWatt,
           [feeds](const Solution& s) { return feeds(s).pumping_power(); },
           {.only = [](const Solution& s) { return film::has_restrictors(s.model); }}}};
}

Group with(Group group, const std::vector<Line>& more) {
  for (const Line& line : more) group.lines.push_back(line);
  return group;
}

std::vector<Line> regime_of_flow() {
  using Film = film::FilmObservables;
  const auto is_mixed = [](const Solution& s) { return s.state.film.laminar_share < 1; };
  const auto has_taylor = [](const Solution& s) { return std::isfinite(s.state.film.taylor_max); };
  return {{"reynolds_max", kNone, film(&Film::reynolds_max)},
          {"taylor_max", kNone, film(&Film::taylor_max), {.only = has_taylor}},
          {"laminar_share", kNone, film(&Film::laminar_share)},
          {"transition_share", kNone, film(&Film::transition_share), {.only = is_mixed}},
          {"turbulent_share", kNone, film(&Film::turbulent_share), {.only = is_mixed}}};
}

Line mass_balance_error() {
  return {"mass_balance_error",
          kNone,
          [](const Solution& s) {
            return conserves_oil(s) ? s.state.film.mass_balance_error : std::numeric_limits<double>::quiet_NaN();
          },
          {.words = [](const Solution& s) { return conserves_oil(s) ? "" : "oil is not conserved by reynolds"; }}};
}

}  // namespace hersey::study
