#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "commands.h"
#include "exit_code.h"
#include "hersey/core/input_error.h"
#include "hersey/core/spelling.h"
#include "hersey/core/units.h"
#include "hersey/core/version.h"
#include "hersey/model/oil_grades.h"
#include "hersey/model/read.h"
#include "hersey/report/curve_page.h"
#include "hersey/run/assumptions.h"
#include "hersey/session/output_file.h"
#include "hersey/session/session.h"
#include "standard_streams.h"
#include "table.h"

namespace hersey::cli {
namespace {

using film::zero_celsius;

/// An oil and where its numbers are from.
struct NamedOil {
  std::string name, source;
  film::Lubricant oil;
  model::OilValidity validity;
  std::string points = {};  ///< pour and flash point in words; empty: not known
  std::vector<std::filesystem::path> files = {};
};

std::string oil_points(const model::OilGrade& grade) {
  return fmt::format("pour point {:.0f} degC, flash point {:.0f} degC, typical of the grade",
                     grade.pour_point - zero_celsius, grade.flash_point - zero_celsius);
}

NamedOil of_grade(const model::OilGrade& grade) {
  film::Lubricant oil{.density = grade.rho15, .rho15 = grade.rho15, .expansion = film::mineral_oil_expansion};
  oil.temperature_law = film::WaltherViscosity::through(grade.nu40, grade.nu100, grade.rho15);
  oil.shear_thinning = grade.shear_thinning();
  return {std::string(grade.name), std::string(grade.source), oil, model::validity_of(oil, &grade), oil_points(grade)};
}

NamedOil of_model(const OilArguments& arguments, const std::string& file, const std::string& wanted) {
  const session::Session session(file, arguments.overrides);
  const model::Model& model = session.model();
  std::vector<std::string> names;
  for (const model::Lubricant& lubricant : model.lubricants) names.push_back(lubricant.name);
  const auto fault = [&](const std::string& found) {
    throw InputError(Fault{{file, 0, 0},
                           "lubricants",
                           found,
                           names.empty() ? "a model with a lubricant" : "--lubricant " + one_of(names),
                           did_you_mean(wanted, names)});
  };
  if (names.empty() || (wanted.empty() && names.size() > 1))
    fault(names.empty() ? "no lubricant" : "several lubricants");
  for (const model::Lubricant& lubricant : model.lubricants) {
    if (!wanted.empty() && lubricant.name != wanted) continue;
    const model::OilGrade* grade = lubricant.grade.empty() ? nullptr : model::oil_grade(lubricant.grade);
    return {lubricant.name,
            grade != nullptr ? lubricant.grade + "; " + std::string(grade->source) : file,
            lubricant.data,
            lubricant.validity,
            grade != nullptr ? oil_points(*grade) : "",
            session.files()};
  }
  fault("unknown lubricant '" + wanted + "'");
  return {};
}

/// MODEL:OIL is an oil of a model, unless a file has that name.
std::pair<std::string, std::string> parts_of(const OilArguments& arguments) {
  const std::size_t colon = arguments.oil.rfind(':');
  if (!arguments.lubricant.empty() || colon == std::string::npos || std::filesystem::exists(arguments.oil))
    return {arguments.oil, arguments.lubricant};
  return {arguments.oil.substr(0, colon), arguments.oil.substr(colon + 1)};
}

NamedOil oil_of(const OilArguments& arguments) {
  if (const model::OilGrade* grade = model::oil_grade(arguments.oil)) return of_grade(*grade);
  const bool is_file = arguments.oil.find('.') != std::string::npos || arguments.oil.find('/') != std::string::npos;
  if (is_file) {
    const auto [file, name] = parts_of(arguments);
    return of_model(arguments, file, name);
  }
  const std::vector<std::string> names = model::oil_grade_names();
  throw InputError(Fault{{"oil", 0, 0},
                         "",
                         "unknown grade '" + arguments.oil + "'",
                         one_of(names) + ", or a model file",
                         did_you_mean(arguments.oil, names)});
}

std::vector<double> quantities(const char* option, const std::vector<std::string>& texts, const char* unit,
                               double low) {
  std::vector<double> values;
  for (const std::string& text : texts) {
    try {
      values.push_back(parse_quantity(text, unit));
    } catch (const QuantityError& error) {
      throw InputError(Fault{{option, 0, 0}, "", error.found, error.expected, error.suggestion});
    }
    if (values.back() < low)
      throw InputError(Fault{{option, 0, 0}, "", "'" + text + "'", fmt::format("at least {:.4g} {}", low, unit), ""});
  }
  return values;
}

bool depends_on_pressure(const film::Lubricant& oil) {
  return !std::holds_alternative<film::ConstantViscosity>(oil.viscosity_law);
}

/// Conditions at which the oil is evaluated.
struct Conditions {
  std::vector<double> temperatures, pressures, shear_rates;  // [K, Pa, 1/s]
};

Conditions conditions_of(const OilArguments& arguments, const NamedOil& named) {
  constexpr double coldest = 100;  // no oil flows [K]
  Conditions at{quantities("--at", arguments.at, "K", coldest), quantities("--pressure", arguments.pressures, "Pa", 0),
                quantities("--shear-rate", arguments.shear_rates, "1/s", 0)};
  if (at.temperatures.empty())
    for (double celsius = 0; celsius <= 160; celsius += 20) at.temperatures.push_back(celsius + zero_celsius);
  if (at.pressures.empty()) {
    at.pressures = {0};
    if (depends_on_pressure(named.oil)) at.pressures.push_back(100e6);
  }
  if (at.shear_rates.empty()) {
    at.shear_rates = {0};
    const bool is_wide = at.pressures.size() > 1;
    if (!named.oil.shear_thinning.is_newtonian())
      at.shear_rates = is_wide ? std::vector<double>{0, 1e6} : std::vector<double>{0, 1e5, 1e6, 1e7};
  }
  return at;
}

/// Properties of the oil at one condition.
struct OilAt {
  double T = 0, p = 0, rate = 0, mu = 0, density = 0;
  [[nodiscard]] double kinematic() const { return mu / density; }
};

OilAt oil_at(const film::Lubricant& any, double T, double p, double rate) {
  const film::Lubricant oil = film::at_temperature(any, T);
  const double mu_n = oil.mu0 * std::exp(film::log_viscosity_ratio(oil, p, oil.mu0).value);
  const double left = oil.shear_thinning.is_newtonian() ? 1 : oil.shear_thinning.ratio(rate, mu_n).value;
  return {T, p, rate, mu_n * left, oil.density * film::density_ratio(oil, p).value};
}

std::string celsius_text(double T) { return fmt::format("{:.4g}", T - zero_celsius); }
std::string pressure_text(double p) { return fmt::format("{:.4g} MPa", 1e-6 * p); }
std::string rate_text(double rate) {
  if (rate == 0) return "at rest";
  const double power = std::floor(std::log10(rate) + 1e-9), digits = rate / std::pow(10, power);
  return power < 4 ? fmt::format("{:.4g} 1/s", rate) : fmt::format("{:.3g}e{:.0f} 1/s", digits, power);
}

/// Temperatures downwards; a column for each pressure and shear rate.
std::vector<std::vector<std::string>> oil_table(const NamedOil& named, const Conditions& at) {
  std::vector<std::vector<std::string>> lines{{"temperature", "density", "kinematic"}, {"degC", "kg/m^3", "mm^2/s"}};
  for (const double p : at.pressures)
    for (const double rate : at.shear_rates) {
      std::string name = at.pressures.size() > 1 || p > 0 ? pressure_text(p) : "viscosity";
      if (at.shear_rates.size() > 1 || rate > 0) name += ", " + rate_text(rate);
      lines[0].push_back(name);
      lines[1].emplace_back("mPa.s");
    }
  for (const double T : at.temperatures) {
    const OilAt resting = oil_at(named.oil, T, at.pressures.front(), 0);
    lines.push_back(
        {celsius_text(T), fmt::format("{:.5g}", resting.density), fmt::format("{:.4g}", 1e6 * resting.kinematic())});
    for (const double p : at.pressures)
      for (const double rate : at.shear_rates)
        lines.back().push_back(fmt::format("{:.4g}", 1e3 * oil_at(named.oil, T, p, rate).mu));
  }
  return lines;
}

nlohmann::json oil_json(const NamedOil& named, const Conditions& at, const std::vector<std::string>& warnings) {
  nlohmann::json document{{"name", named.name},
                          {"source", named.source},
                          {"laws", nlohmann::json::object()},
                          {"rows", nlohmann::json::array()}};
  for (const auto& [name, text] : run::oil_assumptions(named.oil)) document["laws"][name] = text;
  if (!named.points.empty()) document["points"] = named.points;
  if (!warnings.empty()) document["warnings"] = warnings;
  for (const double T : at.temperatures)
    for (const double p : at.pressures)
      for (const double rate : at.shear_rates) {
        const OilAt row = oil_at(named.oil, T, p, rate);
        document["rows"].push_back({{"temperature", T},
                                    {"pressure", p},
                                    {"shear_rate", rate},
                                    {"viscosity", row.mu},
                                    {"density", row.density},
                                    {"kinematic_viscosity", row.kinematic()}});
      }
  return document;
}

constexpr int points_of_a_line = 121;

/// Viscosity in mPa s over one variable; `at` maps 0 to 1 to its range.
template <class StateAt>
report::CurveLine line(const NamedOil& named, std::string label, StateAt&& at) {
  report::CurveLine curve{std::move(label), {}, {}};
  for (int k = 0; k < points_of_a_line; ++k) {
    const auto [x, state] = at(static_cast<double>(k) / (points_of_a_line - 1));
    curve.x.push_back(x);
    curve.y.push_back(1e3 * oil_at(named.oil, state.T, state.p, state.rate).mu);
  }
  return curve;
}

/// Up to six of the temperatures, evenly: as many curves as can be distinguished.
std::vector<double> some_of(const std::vector<double>& all) {
  constexpr std::size_t most = 5;
  if (all.size() <= most) return all;
  std::vector<double> some;
  for (std::size_t k = 0; k < most; ++k) some.push_back(all[k * (all.size() - 1) / (most - 1)]);
  return some;
}

report::CurveChart over_temperature(const NamedOil& named, const Conditions& at) {
  const auto [cold, hot] = std::minmax_element(at.temperatures.begin(), at.temperatures.end());
  const double from = *cold, to = *hot > *cold ? *hot : *cold + 10;
  report::CurveChart chart{"Viscosity over temperature", "", "temperature", "°C", "viscosity", "mPa·s", false, {}};
  for (const double p : some_of(at.pressures))
    for (const double rate : some_of(at.shear_rates)) {
      if (p != at.pressures.front() && rate != at.shear_rates.front()) continue;
      std::string label = p > 0 ? pressure_text(p) : rate_text(rate);
      if (p > 0 && rate > 0) label += ", " + rate_text(rate);
      chart.lines.push_back(line(named, label, [&](double share) {
        const double T = from + share * (to - from);
        return std::pair(T - zero_celsius, OilAt{.T = T, .p = p, .rate = rate});
      }));
    }
  return chart;
}

report::CurveChart over_pressure(const NamedOil& named, const Conditions& at) {
  const double most = std::max(100e6, *std::max_element(at.pressures.begin(), at.pressures.end()));
  report::CurveChart chart{
      "Viscosity over pressure", "at rest", "pressure above cavitation", "MPa", "viscosity", "mPa·s", false, {}};
  for (const double T : some_of(at.temperatures))
    chart.lines.push_back(line(named, celsius_text(T) + " °C", [&](double share) {
      return std::pair(1e-6 * share * most, OilAt{.T = T, .p = share * most});
    }));
  return chart;
}

report::CurveChart over_shear_rate(const NamedOil& named, const Conditions& at) {
  const double most = std::max(1e8, *std::max_element(at.shear_rates.begin(), at.shear_rates.end()));
  report::CurveChart chart{"Viscosity over shear rate",
                           "at " + pressure_text(at.pressures.front()),
                           "shear rate",
                           "1/s",
                           "viscosity",
                           "mPa·s",
                           true,
                           {}};
  for (const double T : some_of(at.temperatures))
    chart.lines.push_back(line(named, celsius_text(T) + " °C", [&](double share) {
      const double rate = 1e3 * std::pow(most / 1e3, share);
      return std::pair(rate, OilAt{.T = T, .p = at.pressures.front(), .rate = rate});
    }));
  return chart;
}

report::CurvePage oil_page(const NamedOil& named, const Conditions& at) {
  report::CurvePage page{.title = named.name,
                         .lead = "What this oil is at temperatures, pressures and shear rates.",
                         .facts = {named.source, fmt::format("hersey {}", version())},
                         .conditions = run::oil_assumptions(named.oil),
                         .charts = {over_temperature(named, at)},
                         .table = oil_table(named, at)};
  if (!named.points.empty()) page.conditions.emplace_back("points", named.points);
  if (depends_on_pressure(named.oil)) page.charts.push_back(over_pressure(named, at));
  if (!named.oil.shear_thinning.is_newtonian()) page.charts.push_back(over_shear_rate(named, at));
  return page;
}

std::vector<std::string> oil_warnings(const NamedOil& named, const Conditions& at) {
  std::vector<std::string> warnings;
  for (const double T : at.temperatures)
    if (std::string warning = model::temperature_warning(named.validity, T); !warning.empty())
      warnings.push_back(std::move(warning));
  for (const double p : at.pressures)
    if (p > named.validity.p_high)
      warnings.push_back(fmt::format("{} is above {}, the end of its table: viscosities are extrapolated",
                                     pressure_text(p), pressure_text(named.validity.p_high)));
  return warnings;
}

std::string oil_text(const NamedOil& named, const Conditions& at) {
  std::string text = fmt::format("{} ({})\n", named.name, named.source);
  for (const auto& [name, words] : run::oil_assumptions(named.oil)) text += fmt::format("  {}: {}\n", name, words);
  if (!named.points.empty()) text += fmt::format("  {}\n", named.points);
  const auto lines = oil_table(named, at);
  return text + aligned(lines, lines.front().size());
}

}  // namespace

int oil_command(const OilArguments& arguments) {
  const NamedOil named = oil_of(arguments);
  session::require_separate({{"--report", arguments.report}}, named.files);
  const Conditions at = conditions_of(arguments, named);
  const std::vector<std::string> warnings = oil_warnings(named, at);
  if (arguments.json) {
    fmt::print("{}\n", oil_json(named, at, warnings).dump(2));
  } else {
    fmt::print("{}", oil_text(named, at));
  }
  for (const std::string& warning : warnings) say("warning: {}: {}\n", named.name, warning);
  if (arguments.report.empty()) return kOk;
  report::write_html(oil_page(named, at), arguments.report);
  if (!arguments.json) fmt::print("report: {}\n", arguments.report.string());
  return kOk;
}

}  // namespace hersey::cli
