#include "hersey/bearing/restricted_feeds.h"

#include <algorithm>
#include <limits>

namespace hersey::bearing {
namespace {

/// Indices of the features that `counts` is true of.
template <class Counts>
std::vector<std::size_t> features_where(const film::FilmModel& model, const Counts& counts) {
  std::vector<std::size_t> found;
  for (std::size_t f = 0; f < model.features.size(); ++f)
    if (model.features[f].restrictor && counts(*model.features[f].restrictor)) found.push_back(f);
  return found;
}

bool is_any(const film::Restrictor& /*restrictor*/) { return true; }
bool has_supply(const film::Restrictor& restrictor) { return restrictor.has_supply_pressure(); }

std::vector<std::string> names_of(const film::FilmModel& model, const std::vector<std::size_t>& features) {
  std::vector<std::string> names;
  names.reserve(features.size());
  for (const std::size_t f : features) names.push_back(model.features[f].name);
  return names;
}

}  // namespace

std::vector<std::string> RestrictedFeeds::names(const film::FilmModel& model) {
  return names_of(model, features_where(model, is_any));
}

std::vector<std::string> RestrictedFeeds::names_with_supply(const film::FilmModel& model) {
  return names_of(model, features_where(model, has_supply));
}

double RestrictedFeeds::pressure(std::size_t k) const {
  return film_.pressure_features[static_cast<Eigen::Index>(features_where(model_, is_any)[k])];
}

double RestrictedFeeds::pressure_ratio(std::size_t k) const {
  const auto f = static_cast<Eigen::Index>(features_where(model_, has_supply)[k]);
  const double outlet = outlet_pressure();
  return (film_.pressure_features[f] - outlet) / (film_.pressure_supplies[f] - outlet);
}

double RestrictedFeeds::pumping_power() const {
  double power = 0;
  for (const std::size_t feature : features_where(model_, is_any)) {
    const auto f = static_cast<Eigen::Index>(feature);
    const bool throttles = model_.features[feature].restrictor->throttles();
    power += film_.flow_features[f] *
             ((throttles ? film_.pressure_supplies : film_.pressure_features)[f] - outlet_pressure());
  }
  return power;
}

double RestrictedFeeds::outlet_pressure() const {
  double lowest = std::numeric_limits<double>::infinity();
  const auto drains = [&](const film::Edge& edge) {
    if (edge.kind != film::EdgeKind::closed) lowest = std::min(lowest, edge.pressure);
  };
  drains(model_.edge_left), drains(model_.edge_right);
  for (const film::PatchEnds& ends : model_.ends) drains(ends.first), drains(ends.last);
  return lowest < std::numeric_limits<double>::infinity() ? lowest : model_.p_cav;
}

}  // namespace hersey::bearing
