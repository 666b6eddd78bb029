#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "exit_code.h"
#include "hersey/core/input_error.h"
#include "hersey/core/spelling.h"
#include "hersey/core/units.h"
#include "hersey/model/oil_grades.h"
#include "hersey/model/read.h"
#include "table.h"

namespace hersey::cli {
namespace {

/// An oil and where its numbers are from.
struct NamedOil {
  std::string name, source;
  film::Lubricant oil;
};

NamedOil of_grade(const model::OilGrade& grade) {
  film::Lubricant oil{.density = grade.rho15};
  oil.temperature_law = film::WaltherViscosity::through(grade.nu40, grade.nu100, grade.rho15);
  return {std::string(grade.name), std::string(grade.source), oil};
}

NamedOil of_model(const OilArguments& arguments) {
  const model::Model model = model::read(arguments.oil, arguments.overrides);
  std::vector<std::string> names;
  for (const model::Lubricant& lubricant : model.lubricants) names.push_back(lubricant.name);
  const auto fault = [&](const std::string& found) {
    throw InputError(Fault{{arguments.oil, 0, 0},
                           "lubricants",
                           found,
                           names.empty() ? "a model with a lubricant" : "--lubricant " + one_of(names),
                           did_you_mean(arguments.lubricant, names)});
  };
  if (names.empty() || (arguments.lubricant.empty() && names.size() > 1))
    fault(names.empty() ? "no lubricant" : "several lubricants");
  for (const model::Lubricant& lubricant : model.lubricants) {
    if (!arguments.lubricant.empty() && lubricant.name != arguments.lubricant) continue;
    const model::OilGrade* grade = lubricant.grade.empty() ? nullptr : model::oil_grade(lubricant.grade);
    return {lubricant.name, grade != nullptr ? lubricant.grade + "; " + std::string(grade->source) : arguments.oil,
            lubricant.data};
  }
  fault("unknown lubricant '" + arguments.lubricant + "'");
  return {};
}

NamedOil oil_of(const OilArguments& arguments) {
  if (const model::OilGrade* grade = model::oil_grade(arguments.oil)) return of_grade(*grade);
  const bool is_file = arguments.oil.find('.') != std::string::npos || arguments.oil.find('/') != std::string::npos;
  if (is_file) return of_model(arguments);
  const std::vector<std::string> names = model::oil_grade_names();
  throw InputError(Fault{{"oil", 0, 0},
                         "",
                         "unknown grade '" + arguments.oil + "'",
                         one_of(names) + ", or a model file",
                         did_you_mean(arguments.oil, names)});
}

std::vector<double> temperatures(const OilArguments& arguments) {
  std::vector<double> T;
  for (const std::string& text : arguments.at) {
    try {
      T.push_back(parse_quantity(text, "K"));
    } catch (const QuantityError& error) {
      throw InputError(Fault{{"--at", 0, 0}, "", error.found, error.expected, error.suggestion});
    }
  }
  for (double celsius = 0; T.size() < 9 && arguments.at.empty(); celsius += 20)
    T.push_back(celsius + film::zero_celsius);
  return T;
}

double pressure(const OilArguments& arguments) {
  if (arguments.pressure.empty()) return 0;
  try {
    return parse_quantity(arguments.pressure, "Pa");
  } catch (const QuantityError& error) {
    throw InputError(Fault{{"--pressure", 0, 0}, "", error.found, error.expected, error.suggestion});
  }
}

/// What the oil is at one temperature.
struct Row {
  double T = 0, mu = 0, density = 0;
};

Row row_of(const NamedOil& named, double T, double p) {
  const film::Lubricant oil = film::at_temperature(named.oil, T);
  const double mu = oil.mu0 * std::exp(film::log_viscosity_ratio(oil, p, oil.mu0).value);
  return {T, mu, oil.density * film::density_ratio(oil, p).value};
}

}  // namespace

int oil_command(const OilArguments& arguments) {
  const NamedOil named = oil_of(arguments);
  const double p = pressure(arguments);
  std::vector<Row> rows;
  for (const double T : temperatures(arguments)) rows.push_back(row_of(named, T, p));
  if (arguments.json) {
    nlohmann::json document{
        {"name", named.name}, {"source", named.source}, {"pressure", p}, {"rows", nlohmann::json::array()}};
    for (const Row& row : rows)
      document["rows"].push_back({{"temperature", row.T},
                                  {"viscosity", row.mu},
                                  {"density", row.density},
                                  {"kinematic_viscosity", row.mu / row.density}});
    fmt::print("{}\n", document.dump(2));
    return kOk;
  }
  std::vector<std::vector<std::string>> lines{{"temperature", "viscosity", "kinematic", "density"},
                                              {"degC", "mPa.s", "mm^2/s", "kg/m^3"}};
  for (const Row& row : rows) {
    lines.push_back({fmt::format("{:.5g}", row.T - film::zero_celsius), fmt::format("{:.4g}", 1e3 * row.mu),
                     fmt::format("{:.4g}", 1e6 * row.mu / row.density), fmt::format("{:.5g}", row.density)});
  }
  fmt::print("{} ({})\n{}{}", named.name, named.source,
             p > 0 ? fmt::format("at {:.4g} MPa above the cavitation pressure\n", 1e-6 * p) : "", aligned(lines, 4));
  return kOk;
}

}  // namespace hersey::cli
