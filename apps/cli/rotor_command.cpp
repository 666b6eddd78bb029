#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "exit_code.h"
#include "hersey/core/input_error.h"
#include "hersey/core/units.h"
#include "hersey/session/output_file.h"
#include "hersey/session/session.h"
#include "hersey/study/rotor_study.h"
#include "page_text.h"
#include "rotor_page.h"
#include "rotor_results.h"
#include "standard_streams.h"

namespace hersey::cli {
namespace {

constexpr int kMapPoints = 41;

double quantity_of(const std::string& option, const std::string& text, const std::string& unit) {
  try {
    const double value = convert_to_si(split_quantity(text), unit);
    if (value > 0) return value;
    throw InputError(Fault{{option, 0, 0}, "", "'" + text + "'", "a quantity above zero", ""});
  } catch (const QuantityError& error) {
    throw InputError(Fault{{option, 0, 0}, "", error.found, error.expected, error.suggestion});
  }
}

/// `low:high`, or one value for both.
std::pair<double, double> range_of(const std::string& option, const std::string& text, const std::string& unit) {
  const std::size_t colon = text.find(':');
  const double low = quantity_of(option, text.substr(0, colon), unit);
  const double high = colon == std::string::npos ? low : quantity_of(option, text.substr(colon + 1), unit);
  if (low <= high) return {low, high};
  throw InputError(Fault{{option, 0, 0}, "", "'" + text + "', which ends below its start", "low:high", ""});
}

std::vector<model::StudyRun> speeds_of(const RotorArguments& arguments, const session::Session& session) {
  std::vector<model::StudyParameter> sweeps;
  for (const std::string& text : arguments.sweeps) sweeps.push_back(study::parse_sweep(text));
  std::vector<model::StudyRun> runs = session.runs(arguments.overrides, sweeps);
  if (runs.empty()) runs.push_back({arguments.overrides, "", "", {}});
  return runs;
}

/// Stations on the command line: those wanted, and that of the cross-coupled stiffness.
std::vector<std::string> stations_of(const RotorArguments& arguments, const std::string& screened) {
  std::vector<std::string> stations = arguments.stations;
  if (!screened.empty() && std::find(stations.begin(), stations.end(), screened) == stations.end())
    stations.push_back(screened);
  return stations;
}

/// The rotor at the speed in service, or at the highest one.
const study::RotorAtSpeed& in_service(const RotorFindings& found,
                                      const std::vector<const study::RotorAtSpeed*>& solved) {
  if (!found.operating) return *solved.back();
  return **std::min_element(solved.begin(), solved.end(), [&](const auto* a, const auto* b) {
    return std::abs(a->state.speed - found.operating->high) < std::abs(b->state.speed - found.operating->high);
  });
}

void screen(const study::RotorAtSpeed& at, double Q, RotorFindings& found) {
  found.screened_speed = at.state.speed;
  found.screening = study::screen_stability(at.state, {at.state.places.at(found.screened_at), Q});
}

bool is_hdf5_name(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending == ".h5" || ending == ".hdf5";
}

RotorFindings find(const RotorArguments& arguments, const session::Session& session) {
  RotorFindings found;
  std::optional<double> cross_coupling;
  if (!arguments.operating.empty()) {
    const auto [low, high] = range_of("--operating", arguments.operating, "rad/s");
    found.operating = study::OperatingRange{low, high};
  }
  if (!arguments.cross_coupling.empty()) {
    const std::size_t equals = arguments.cross_coupling.find('=');
    if (equals == std::string::npos)
      throw InputError(Fault{{"--cross-coupling", 0, 0},
                             "",
                             "'" + arguments.cross_coupling + "'",
                             "a station and a stiffness: shaft.middle=2MN/m",
                             ""});
    found.screened_at = arguments.cross_coupling.substr(0, equals);
    cross_coupling = quantity_of("--cross-coupling", arguments.cross_coupling.substr(equals + 1), "N/m");
  }
  std::optional<std::pair<double, double>> mapped;
  if (!arguments.stiffness_map.empty()) mapped = range_of("--stiffness-map", arguments.stiffness_map, "N/m");
  const auto read = [&](const std::vector<std::string>& overrides) { return session.with(overrides).model(); };
  found.rotor =
      study::rotor_over_speeds(read, speeds_of(arguments, session), stations_of(arguments, found.screened_at));
  found.criticals = study::damped_critical_speeds(found.rotor);
  found.peaks = study::response_peaks(found.rotor);
  std::vector<const study::RotorAtSpeed*> solved;
  for (const study::RotorAtSpeed& at : found.rotor)
    if (at.state.solved()) solved.push_back(&at);
  if (solved.empty()) return found;
  if (cross_coupling) screen(in_service(found, solved), *cross_coupling, found);
  if (mapped)
    found.map = study::critical_speed_map(solved[solved.size() / 2]->state, mapped->first, mapped->second, kMapPoints);
  return found;
}

}  // namespace

int rotor_command(const RotorArguments& arguments) {
  const session::Session session(arguments.model, arguments.overrides);
  const std::vector<session::OutputFile> outputs{{"--results", arguments.results}, {"--report", arguments.report}};
  session::require_separate(outputs, session.files());
  session::require_writable(outputs);
  warn(session.model().warnings);
  const RotorFindings found = find(arguments, session);
  bool all_solved = true;
  for (const study::RotorAtSpeed& at : found.rotor) {
    if (!at.state.warning.empty()) say("warning: {}{}{}\n", at.label, at.label.empty() ? "" : ": ", at.state.warning);
    if (at.state.solved()) continue;
    all_solved = false;
    say("hersey: {}{}{}\n", at.label, at.label.empty() ? "" : ": ", at.state.message);
  }
  for (const std::string& remark : remarks_on_peaks(found)) say("warning: {}\n", remark);
  const bool as_hdf5 = is_hdf5_name(arguments.results);
  const std::string json = arguments.json || (!arguments.results.empty() && !as_hdf5)
                               ? rotor_json(found, arguments.model).dump(2) + "\n"
                               : std::string();
  if (arguments.json)
    fmt::print("{}", json);
  else
    fmt::print("{}", rotor_text(found));
  if (as_hdf5)
    write_rotor_results(found, arguments.model, arguments.results);
  else if (!arguments.results.empty())
    write_text(arguments.results, json);
  if (!arguments.report.empty()) {
    report::write_html(rotor_page(found, session.model(), arguments.model), arguments.report);
    if (!arguments.json) fmt::print("report: {}\n", arguments.report.string());
  }
  return all_solved ? kOk : kFailed;
}

}  // namespace hersey::cli
