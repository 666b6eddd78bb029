#include "rotor_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "hersey/core/version.h"
#include "page_text.h"

namespace hersey::cli {
namespace {

using nlohmann::json;
using report::CurveChart;
using report::CurveLine;
using report::CurvePage;
using run::Orbit;
using run::Whirl;
using study::RotorAtSpeed;

constexpr double kRpm = std::numbers::pi / 30;
constexpr double kDegree = std::numbers::pi / 180;
constexpr int kModesShown = 6;  // lines that one can tell apart
constexpr int kStationsShown = 6;

const char* whirl_word(Whirl whirl) {
  constexpr std::array<const char*, 6> words{"forward", "backward", "mixed", "planar", "none", "diverges"};
  return words.at(static_cast<std::size_t>(whirl));
}

/// Lag of a motion behind the unbalance's direction, 0 to 360 deg.
double lag_of(const std::complex<double>& amplitude) {
  const double lag = -std::arg(amplitude) / kDegree;
  return lag < 0 ? lag + 360 : lag;
}

/// Of motions that do not oscillate there is none.
std::string decrement_text(double log_decrement) {
  return std::isfinite(log_decrement) ? fmt::format("{:.4f}", log_decrement)
         : log_decrement < 0          ? "diverges"
                                      : "no whirl";
}

json number_or_null(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

json orbit_json(const Orbit& orbit, int sense) {
  return {{"x", std::abs(orbit.x)},       {"x_lag_deg", lag_of(orbit.x)}, {"y", std::abs(orbit.y)},
          {"y_lag_deg", lag_of(orbit.y)}, {"major_axis", orbit.major()},  {"minor_axis", orbit.minor(sense)}};
}

json matrix_json(const Eigen::Matrix2d& A) {
  return {{"xx", A(0, 0)}, {"xy", A(0, 1)}, {"yx", A(1, 0)}, {"yy", A(1, 1)}};
}

json bearing_json_of(const run::RotorBearing& bearing) {
  return {{"stiffness", matrix_json(bearing.stiffness)},
          {"damping", matrix_json(bearing.damping)},
          {"inertia", matrix_json(bearing.inertia)},
          {"static_force", {{"x", bearing.force.x()}, {"y", bearing.force.y()}}}};
}

json mode_json(const run::WhirlMode& mode, int track) {
  return {{"track", track},
          {"damped_frequency", mode.mode.damped_frequency},
          {"frequency", mode.mode.frequency},
          {"damping_ratio", mode.mode.damping_ratio},
          {"log_decrement", number_or_null(mode.log_decrement)},
          {"growth_rate", mode.mode.s.real()},
          {"whirl", whirl_word(mode.whirl)}};
}

json speed_json(const RotorAtSpeed& at) {
  json one{{"label", at.label}, {"solved", at.state.solved()}};
  if (!at.state.solved()) {
    one["message"] = at.state.message;
    return one;
  }
  one["speed"] = at.state.speed / kRpm;
  one["sense"] = at.state.sense;
  if (!at.state.warning.empty()) one["warning"] = at.state.warning;
  for (const run::RotorBearing& bearing : at.state.bearings) one["bearings"][bearing.name] = bearing_json_of(bearing);
  one["modes"] = json::array();
  for (std::size_t k = 0; k < at.modes.size(); ++k) one["modes"].push_back(mode_json(at.modes[k], at.tracks[k]));
  if (!at.response) return one;
  for (std::size_t s = 0; s < at.state.stations.size(); ++s)
    one["unbalance"]["stations"][at.state.stations[s].name] =
        orbit_json(at.response->stations[s], at.state.stations[s].sense);
  for (std::size_t b = 0; b < at.state.bearings.size(); ++b)
    one["unbalance"]["bearing_forces"][at.state.bearings[b].name] =
        orbit_json(at.response->bearings[b], at.state.stations[at.state.bearings[b].station].sense);
  return one;
}

const RotorAtSpeed* first_solved(const RotorFindings& found) {
  const auto solved =
      std::find_if(found.rotor.begin(), found.rotor.end(), [](const RotorAtSpeed& at) { return at.state.solved(); });
  return solved == found.rotor.end() ? nullptr : &*solved;
}

json peak_json(const RotorFindings& found, const study::ResponsePeak& peak) {
  json one{{"station", first_solved(found)->state.stations[peak.station].name},
           {"speed", peak.speed / kRpm},
           {"amplitude", peak.amplitude},
           {"amplification_factor", number_or_null(peak.amplification)},
           {"is_resolved", peak.is_resolved}};
  if (!found.operating) return one;
  const study::SeparationMargin margin = study::separation_margin(peak.speed, peak.amplification, *found.operating);
  one["separation_margin"] = peak.is_resolved ? json(margin.actual) : json(nullptr);
  one["required_margin"] = margin.required;
  one["is_enough"] = peak.is_resolved && margin.is_enough();
  return one;
}

/// Modes that move the axis, or the torsion of geared shafts, and stay in the reach of the diagram, over speed.
std::map<int, std::vector<std::pair<const RotorAtSpeed*, const run::WhirlMode*>>> tracks_of(
    const RotorFindings& found) {
  std::map<int, std::vector<std::pair<const RotorAtSpeed*, const run::WhirlMode*>>> tracks;
  double fastest = 0;
  for (const RotorAtSpeed& at : found.rotor) fastest = std::max(fastest, at.state.speed);
  for (const RotorAtSpeed& at : found.rotor)
    for (std::size_t k = 0; k < at.modes.size(); ++k)
      if ((at.modes[k].whirl != Whirl::none || at.state.is_geared) && at.modes[k].mode.s.imag() < 2 * fastest)
        tracks[at.tracks[k]].emplace_back(&at, &at.modes[k]);
  return tracks;
}

std::string track_name(const std::pair<const RotorAtSpeed*, const run::WhirlMode*>& at, std::size_t number) {
  return fmt::format("{}, {}", number, whirl_word(at.second->whirl));
}

CurveChart chart(std::string title, std::string note, std::string y_name, std::string y_unit, bool is_logarithmic) {
  CurveChart made;
  made.title = std::move(title), made.note = std::move(note);
  made.x_name = "speed", made.x_unit = "rpm";
  made.y_name = std::move(y_name), made.y_unit = std::move(y_unit);
  made.y_is_logarithmic = is_logarithmic;
  return made;
}

void add_modes(const RotorFindings& found, CurvePage& page) {
  CurveChart campbell =
      chart("Campbell diagram", "Damped frequencies over the speed; 1x is the speed itself.", "frequency", "Hz", false);
  CurveChart decrement = chart("Stability", "Logarithmic decrement of the same modes; below zero a motion grows.",
                               "log decrement", "1", false);
  CurveLine once{"1x", {}, {}};
  for (const RotorAtSpeed& at : found.rotor)
    if (at.state.solved()) {
      once.x.push_back(at.state.speed / kRpm);
      once.y.push_back(at.state.speed / (2 * std::numbers::pi));
    }
  std::size_t number = 0;
  for (const auto& [track, along] : tracks_of(found)) {
    if (along.back().second->whirl == Whirl::diverging) continue;
    if (++number > kModesShown) break;
    CurveLine frequency{track_name(along.back(), static_cast<std::size_t>(track) + 1), {}, {}}, damping = frequency;
    for (const auto& [at, mode] : along) {
      frequency.x.push_back(at->state.speed / kRpm);
      frequency.y.push_back(mode->mode.damped_frequency);
      damping.y.push_back(mode->log_decrement);
    }
    damping.x = frequency.x;
    campbell.lines.push_back(frequency);
    decrement.lines.push_back(damping);
  }
  if (campbell.lines.empty()) return;
  campbell.lines.push_back(once);
  page.charts.push_back(std::move(campbell));
  page.charts.push_back(std::move(decrement));
}

/// Motion at a station, or force in a bearing, by its name; unset where that speed has none.
std::optional<Orbit> station_orbit(const RotorAtSpeed& at, const std::string& name) {
  const auto place = at.state.places.find(name);
  if (place == at.state.places.end()) return std::nullopt;
  return at.response->stations[place->second];
}

std::optional<Orbit> bearing_orbit(const RotorAtSpeed& at, const std::string& name) {
  const run::RotorBearing* bearing = bearing_called(at, name);
  if (bearing == nullptr) return std::nullopt;
  return at.response->bearings[static_cast<std::size_t>(bearing - at.state.bearings.data())];
}

template <class Value>
std::optional<double> of_orbit(const std::optional<Orbit>& orbit, Value value) {
  return orbit ? std::optional<double>(value(*orbit)) : std::nullopt;
}

template <class Value>
CurveChart over_speed(const RotorFindings& found, CurveChart made, const std::vector<std::string>& names, Value value) {
  for (std::size_t k = 0; k < std::min<std::size_t>(names.size(), kStationsShown); ++k) {
    CurveLine line{names[k], {}, {}};
    for (const RotorAtSpeed& at : found.rotor) {
      if (!at.response) continue;
      const std::optional<double> of_name = value(at, names[k]);
      if (!of_name) continue;
      line.x.push_back(at.state.speed / kRpm);
      line.y.push_back(*of_name);
    }
    made.lines.push_back(std::move(line));
  }
  return made;
}

void add_response(const RotorFindings& found, CurvePage& page) {
  const RotorAtSpeed* first = first_solved(found);
  if (first == nullptr || !first->response) return;
  std::vector<std::string> stations, bearings;
  for (const run::RotorStation& station : first->state.stations) stations.push_back(station.name);
  for (const run::RotorBearing& bearing : first->state.bearings) bearings.push_back(bearing.name);
  page.charts.push_back(over_speed(
      found, chart("Unbalance response", "Half of the longest diameter of the orbit.", "amplitude", "um", false),
      stations, [](const RotorAtSpeed& at, const std::string& name) {
        return of_orbit(station_orbit(at, name), [](const Orbit& orbit) { return 1e6 * orbit.major(); });
      }));
  page.charts.push_back(over_speed(
      found,
      chart("Phase", "Angle by which the motion along " + first->state.x_name + " lags behind a mark at phase zero.",
            "lag", "deg", false),
      stations, [](const RotorAtSpeed& at, const std::string& name) {
        return of_orbit(station_orbit(at, name), [](const Orbit& orbit) { return lag_of(orbit.x); });
      }));
  if (bearings.empty()) return;
  page.charts.push_back(over_speed(found,
                                   chart("Forces of unbalance on the shaft",
                                         "Half of the longest diameter of their hodograph.", "force", "N", false),
                                   bearings, [](const RotorAtSpeed& at, const std::string& name) {
                                     return of_orbit(bearing_orbit(at, name),
                                                     [](const Orbit& orbit) { return orbit.major(); });
                                   }));
}

void add_map(const RotorFindings& found, CurvePage& page) {
  if (!found.map) return;
  CurveChart map =
      chart("Undamped critical speeds",
            "Forward ones, over a stiffness that all bearings have; and the stiffness that bearings have at "
            "each speed.",
            "speed", "rpm", true);
  map.x_name = "stiffness", map.x_unit = "N/m", map.x_is_logarithmic = true;
  double fastest = 0;
  for (const RotorAtSpeed& at : found.rotor) fastest = std::max(fastest, at.state.speed);
  constexpr std::size_t most = 4;
  for (std::size_t k = 0; k < most; ++k) {
    CurveLine line{fmt::format("critical {}", k + 1), {}, {}};
    for (std::size_t i = 0; i < found.map->stiffness.size(); ++i) {
      std::size_t forward = 0;
      for (const run::CriticalSpeed& critical : found.map->criticals[i])
        if (critical.whirl == Whirl::forward && forward++ == k && critical.speed < 5 * fastest) {
          line.x.push_back(found.map->stiffness[i]);
          line.y.push_back(critical.speed / kRpm);
        }
    }
    if (!line.x.empty()) map.lines.push_back(std::move(line));
  }
  const RotorAtSpeed* first = first_solved(found);
  for (const auto& [name, row] : {std::pair{"xx", 0}, std::pair{"yy", 1}})
    for (std::size_t b = 0; first != nullptr && b < std::min<std::size_t>(first->state.bearings.size(), 1); ++b) {
      CurveLine line{first->state.bearings[b].name + ", " + name, {}, {}};
      for (const RotorAtSpeed& at : found.rotor) {
        if (!at.state.solved()) continue;
        const run::RotorBearing* bearing = bearing_called(at, first->state.bearings[b].name);
        if (bearing == nullptr) continue;
        const double k = bearing->stiffness(row, row);
        if (k < found.map->stiffness.front() || k > found.map->stiffness.back()) continue;
        line.x.push_back(k);
        line.y.push_back(at.state.speed / kRpm);
      }
      if (!line.x.empty()) map.lines.push_back(std::move(line));
    }
  if (!map.lines.empty()) page.charts.push_back(std::move(map));
}

CurvePage::Table criticals_table(const RotorFindings& found) {
  CurvePage::Table table{"Critical speeds", "Where the damped frequency of a mode equals the speed.", {}};
  table.lines = {{"mode", "speed", "whirl", "log decrement"}, {"", "rpm", "", "1"}};
  for (const study::DampedCriticalSpeed& critical : found.criticals)
    table.lines.push_back({fmt::format("{}", critical.track + 1), fmt::format("{:.0f}", critical.speed / kRpm),
                           whirl_word(critical.whirl), fmt::format("{:.3f}", critical.log_decrement)});
  return table;
}

CurvePage::Table peaks_table(const RotorFindings& found) {
  CurvePage::Table table{"Peaks of the unbalance response",
                         "Amplification factors and separation margins as in API 617 and API 684; below 2.5 a peak is "
                         "critically damped and needs no margin.",
                         {}};
  for (const std::string& remark : remarks_on_peaks(found)) table.note += " " + remark;
  table.lines = {{"station", "speed", "amplitude", "AF"}, {"", "rpm", "um", "1"}};
  if (found.operating)
    for (const auto& [name, unit] : {std::pair{"margin", "%"}, std::pair{"required", "%"}, std::pair{"enough", ""}})
      table.lines[0].emplace_back(name), table.lines[1].emplace_back(unit);
  for (const study::ResponsePeak& peak : found.peaks) {
    std::vector<std::string> row{first_solved(found)->state.stations[peak.station].name,
                                 fmt::format("{:.0f}", peak.speed / kRpm), fmt::format("{:.3g}", 1e6 * peak.amplitude),
                                 std::isfinite(peak.amplification) ? fmt::format("{:.2f}", peak.amplification) : "-"};
    if (found.operating) {
      const study::SeparationMargin margin = study::separation_margin(peak.speed, peak.amplification, *found.operating);
      row.push_back(peak.is_resolved ? fmt::format("{:.1f}", 100 * margin.actual) : "-");
      row.push_back(fmt::format("{:.1f}", 100 * margin.required));
      row.emplace_back(!peak.is_resolved ? "-" : margin.is_enough() ? "yes" : "no");
    }
    table.lines.push_back(std::move(row));
  }
  return table;
}

CurvePage::Table stability_table(const RotorFindings& found) {
  CurvePage::Table table{
      "Modes", "Those up to twice the highest speed, each at the highest speed to which it could be followed.", {}};
  table.lines = {{"mode", "speed", "frequency", "over speed", "log decrement", "whirl"},
                 {"", "rpm", "Hz", "1", "1", ""}};
  std::vector<std::tuple<double, int, const RotorAtSpeed*, const run::WhirlMode*>> last;
  for (const auto& [track, along] : tracks_of(found))
    last.emplace_back(along.back().second->mode.damped_frequency, track, along.back().first, along.back().second);
  std::sort(last.begin(), last.end());
  for (const auto& [frequency, track, at, mode] : last) {
    table.lines.push_back({fmt::format("{}", track + 1), fmt::format("{:.0f}", at->state.speed / kRpm),
                           fmt::format("{:.3f}", mode->mode.damped_frequency),
                           fmt::format("{:.3f}", mode->mode.s.imag() / at->state.speed),
                           decrement_text(mode->log_decrement), whirl_word(mode->whirl)});
  }
  if (last.empty()) {
    table.title = "Modes: none up to twice the highest speed moves the axis and oscillates";
    table.note.clear();
    table.lines.clear();
  }
  return table;
}

CurvePage::Table screening_table(const RotorFindings& found) {
  const study::StabilityScreening& screening = *found.screening;
  CurvePage::Table table{fmt::format("Stability with a cross-coupled stiffness at {}, {:.0f} rpm", found.screened_at,
                                     found.screened_speed / kRpm),
                         "Level 1 of API 617: a log decrement of 0.1 at the anticipated Q_A, and a threshold Q_0 of "
                         "twice Q_A at least; else level 2 is asked for. What the standard asks of machines with dense "
                         "gas beside these two is not looked into.",
                         {}};
  table.lines = {{"Q_A", "log decrement there", "Q_0", "Q_0/Q_A", "enough"}, {"N/m", "1", "N/m", "1", ""}};
  const bool is_finite = std::isfinite(screening.threshold);
  table.lines.push_back({fmt::format("{:.4g}", screening.anticipated), decrement_text(screening.at_anticipated),
                         is_finite ? fmt::format("{:.4g}", screening.threshold) : "-",
                         is_finite ? fmt::format("{:.3g}", screening.threshold / screening.anticipated) : "above 10",
                         screening.is_enough() ? "yes" : "no"});
  return table;
}

std::vector<CurvePage::Table> tables_of(const RotorFindings& found) {
  std::vector<CurvePage::Table> tables{stability_table(found)};
  if (!found.criticals.empty()) tables.push_back(criticals_table(found));
  if (!found.peaks.empty()) tables.push_back(peaks_table(found));
  if (found.screening) tables.push_back(screening_table(found));
  return tables;
}

}  // namespace

const run::RotorBearing* bearing_called(const RotorAtSpeed& at, const std::string& name) {
  const auto& all = at.state.bearings;
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& bearing) { return bearing.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::vector<std::string> remarks_on_peaks(const RotorFindings& found) {
  std::vector<std::string> remarks;
  for (const study::ResponsePeak& peak : found.peaks)
    if (!peak.is_resolved)
      remarks.push_back(fmt::format(
          "The speeds of the sweep are too far apart for the peak of {} at {:.0f} rpm, which may be higher and "
          "sharper: "
          "no amplification factor and no margin are given. Sweep {:.0f} rpm to {:.0f} rpm in smaller steps.",
          first_solved(found)->state.stations[peak.station].name, peak.speed / kRpm, peak.before / kRpm,
          peak.after / kRpm));
  return remarks;
}

json rotor_json(const RotorFindings& found, const std::string& file) {
  json all{{"model", file}, {"speeds", json::array()}, {"critical_speeds", json::array()}};
  for (const RotorAtSpeed& at : found.rotor) all["speeds"].push_back(speed_json(at));
  for (const study::DampedCriticalSpeed& critical : found.criticals)
    all["critical_speeds"].push_back({{"track", critical.track},
                                      {"speed", critical.speed / kRpm},
                                      {"log_decrement", critical.log_decrement},
                                      {"whirl", whirl_word(critical.whirl)}});
  for (const study::ResponsePeak& peak : found.peaks) all["response_peaks"].push_back(peak_json(found, peak));
  if (const RotorAtSpeed* first = first_solved(found))
    for (const run::RotorStation& station : first->state.stations)
      all["stations"].push_back({{"name", station.name}, {"along", station.along}});
  if (found.operating)
    all["operating_range"] = {{"low", found.operating->low / kRpm}, {"high", found.operating->high / kRpm}};
  if (found.screening) {
    const study::StabilityScreening& screening = *found.screening;
    all["stability_screening"] = {{"station", found.screened_at},
                                  {"speed", found.screened_speed / kRpm},
                                  {"Q", screening.Q},
                                  {"log_decrement", screening.log_decrement},
                                  {"anticipated_Q", screening.anticipated},
                                  {"log_decrement_at_anticipated", number_or_null(screening.at_anticipated)},
                                  {"threshold_Q", number_or_null(screening.threshold)},
                                  {"is_enough", screening.is_enough()}};
  }
  if (found.map)
    for (std::size_t i = 0; i < found.map->stiffness.size(); ++i) {
      json criticals = json::array();
      for (const run::CriticalSpeed& critical : found.map->criticals[i])
        criticals.push_back({{"speed", critical.speed / kRpm}, {"whirl", whirl_word(critical.whirl)}});
      all["critical_speed_map"].push_back({{"stiffness", found.map->stiffness[i]}, {"critical_speeds", criticals}});
    }
  return all;
}

std::string rotor_text(const RotorFindings& found) { return text_of(tables_of(found)); }

CurvePage rotor_page(const RotorFindings& found, const model::Model& model, const std::string& file) {
  CurvePage page;
  page.title = model.title.empty() ? file : model.title;
  page.lead = model.description;
  page.facts = {"rotor over its speeds", file, fmt::format("hersey {}", version())};
  if (const RotorAtSpeed* first = first_solved(found))
    page.conditions.emplace_back(
        "directions",
        fmt::format("x of this page is {}, y is {} of the ground; the shaft rotates from {} to {}", first->state.x_name,
                    first->state.y_name, first->state.sense > 0 ? first->state.x_name : first->state.y_name,
                    first->state.sense > 0 ? first->state.y_name : first->state.x_name));
  add_modes(found, page);
  add_response(found, page);
  add_map(found, page);
  if (found.screening) {
    CurveChart stability =
        chart("Stability over cross-coupled stiffness", "Least log decrement of the whirls up to 1.25 times the speed.",
              "log decrement", "1", false);
    stability.x_name = "Q", stability.x_unit = "N/m";
    stability.lines.push_back({found.screened_at, found.screening->Q, found.screening->log_decrement});
    page.charts.push_back(std::move(stability));
  }
  page.tables = tables_of(found);
  return page;
}

}  // namespace hersey::cli
