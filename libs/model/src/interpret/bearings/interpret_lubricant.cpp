#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "hersey/model/oil_grades.h"
#include "interpret/context/interpret.h"
#include "schema/oil_laws.h"

namespace hersey::model {
namespace {

/// The law of a table over temperature and pressure; null where the viscosity is none.
const Value* table_over_pressure(const Value& lubricant) {
  const Value* viscosity = lubricant.find("viscosity");
  if (viscosity == nullptr || viscosity->broken || viscosity->members.empty()) return nullptr;
  const Value& law = viscosity->members.front().value;
  return !law.broken && law.text == "table" && law.find("pressures") != nullptr ? &law : nullptr;
}

film::TabledPressure tabled_pressure(const Value& law) {
  film::TabledPressure table;
  for (const Member& item : law.find("pressures")->members) table.p.push_back(item.value.number);
  const std::size_t rows = law.find("temperatures")->members.size();
  table.log_mu.resize(rows * table.p.size());
  for (std::size_t c = 0; c < table.p.size(); ++c) {
    const std::vector<double> column = column_of(law, c);
    for (std::size_t k = 0; k < rows; ++k) table.log_mu[k * table.p.size() + c] = std::log(column[k]);
  }
  return table;
}

film::ViscosityLaw viscosity_law_of(Context& context, const Value& lubricant, double mu0) {
  const Value* given = lubricant.find("pressure_viscosity");
  if (const Value* table = table_over_pressure(lubricant); table != nullptr && !context.has_fault_in(table->path)) {
    if (given != nullptr && given->given)
      context.fault(*given, "a second law of pressure: the table of 'viscosity' has 'pressures'", "one of both");
    return tabled_pressure(*table);
  }
  if (given == nullptr || given->broken || given->members.empty()) return {};
  const Value& law = given->members.front().value;
  if (law.type->kind == Type::Kind::quantity) {
    if (law.number == 0) return film::ConstantViscosity{};
    return film::Barus{law.number};
  }
  if (law.broken) return {};
  film::ViscosityLaw read = read_alternative(law, viscosity_laws());
  const Value* viscosity = lubricant.find("viscosity");
  if (std::holds_alternative<film::Roelands>(read) && viscosity != nullptr && !viscosity->broken &&
      mu0 <= film::Roelands::smallest_viscosity) {
    context.fault(*viscosity, "a viscosity at or below Roelands' 0.0632 mPa.s",
                  "a larger one, or another law in pressure_viscosity");
  }
  return read;
}

/// A value that no oil has is most often one in the wrong unit.
void warn_outside(Context& context, const Value& parent, const std::string& key, double low, double high,
                  const char* expected) {
  const Value* value = parent.find(key);
  if (value == nullptr || value->broken || !value->given) return;
  const Value& number = value->members.empty() ? *value : value->members.front().value;
  const Value* inner = key == "pressure_viscosity" ? number.find("alpha") : nullptr;
  const Value& tested = inner != nullptr ? *inner : number;
  if (tested.broken || tested.type->kind != Type::Kind::quantity || (tested.number >= low && tested.number <= high))
    return;
  context.model.warnings.push_back(
      {tested.position, tested.path, "a value that no lubricant has", expected, "is it in the right unit?"});
}

void warn_of_unphysical(Context& context, const Value& lubricant) {
  warn_outside(context, lubricant, "density", 0.1, 5000, "about 800 to 1000 kg/m^3 for oils");
  warn_outside(context, lubricant, "pressure_viscosity", 0, 1e-7, "at most about 4e-8 1/Pa (40 1/GPa) for oils");
  const Value* law = lubricant.find("compressibility");
  if (law == nullptr || law->broken || law->text != "dowson_higginson") return;
  const double rise = number_of(*law, "rise"), saturation = number_of(*law, "saturation");
  if (rise <= 5e-9 && rise <= saturation) return;
  context.model.warnings.push_back({law->key_position, law->path,
                                    "an oil that more than doubles its density under pressure",
                                    "a rise below saturation, such as 0.6 and 1.7 1/GPa", ""});
}

/// mu [Pa.s] as it is given or follows from the law at the oil's temperature.
void warn_of_viscosity(Context& context, const Value& lubricant, double mu) {
  constexpr double kThinnest = 0.2e-3, kThickest = 10;  // below hot water; above heavy gear oil at a cold start
  const Value* given = lubricant.find("viscosity");
  if (given == nullptr || context.has_fault_in(lubricant.path) || (kThinnest <= mu && mu <= kThickest)) return;
  context.model.warnings.push_back(
      {given->position, given->path, fmt::format("a viscosity of {:.3g} mPa.s, far from what is usual", 1e3 * mu),
       "about 1 mPa.s to 1 Pa.s for oils at work, 0.3 mPa.s for hot water", "is it in the right unit?"});
}

film::DensityLaw density_law_of(const Context& context, const Value& lubricant) {
  const Value* law = lubricant.find("compressibility");
  if (law == nullptr || law->broken || context.has_fault_in(law->path)) return {};
  return read_alternative(*law, density_laws());
}

/// Density of oils of which nothing else is known [kg/m^3].
constexpr double usual_density = 850;

const OilGrade* grade_of(const Value& lubricant) {
  const Value* grade = lubricant.find("grade");
  return grade == nullptr || grade->broken ? nullptr : oil_grade(grade->text);
}

double density_of(const Value& lubricant) {
  if (const Value* density = lubricant.find("density"); density != nullptr) return density->number;
  const OilGrade* grade = grade_of(lubricant);
  return grade != nullptr ? grade->rho15 : usual_density;
}

double expansion_of(const Value& lubricant) {
  if (const Value* given = lubricant.find("thermal_expansion")) return given->number;
  const Value* viscosity = lubricant.find("viscosity");
  const bool has_law = viscosity != nullptr && !viscosity->broken && !viscosity->members.empty();
  const bool is_kinematic = has_law && viscosity->members.front().value.text == "walther";
  return is_kinematic || grade_of(lubricant) != nullptr ? film::mineral_oil_expansion : 0;
}

/// Requires as many viscosities as temperatures, and in each row as many as pressures.
bool is_rectangular(Context& context, const Value& law) {
  const Value &T = *law.find("temperatures"), &mu = *law.find("viscosities"), *p = law.find("pressures");
  const std::size_t columns = p == nullptr ? 0 : p->members.size();
  if (T.members.size() != mu.members.size() || T.members.size() < 2) {
    context.fault(mu, fmt::format("{} viscosities at {} temperatures", mu.members.size(), T.members.size()),
                  "as many of both, two at least");
    return false;
  }
  if (p != nullptr && columns < 2) {
    context.fault(*p, "one pressure", "two at least");
    return false;
  }
  for (const Member& row : mu.members) {
    const Value& value = row.value.members.front().value;
    if (value.members.size() == columns) continue;
    context.fault(row.value,
                  columns == 0            ? std::string("viscosities over pressures")
                  : value.members.empty() ? std::string("one viscosity")
                                          : fmt::format("{} viscosities", value.members.size()),
                  columns == 0 ? std::string("'pressures' of the table, or one viscosity for each temperature")
                               : fmt::format("a list of {}, one for each pressure", columns));
    return false;
  }
  return true;
}

/// Axes of a table ascend; no oil thickens as it is heated, or thins as it is pressed.
void check_table(Context& context, const Value& law) {
  if (!is_rectangular(context, law)) return;
  const Value &T = *law.find("temperatures"), &mu = *law.find("viscosities"), *p = law.find("pressures");
  const std::size_t columns = p == nullptr ? 1 : p->members.size();
  for (std::size_t k = 1; k < T.members.size(); ++k)
    if (T.members[k].value.number <= T.members[k - 1].value.number)
      return context.fault(T.members[k].value, "a temperature that is no higher than the one before",
                           "temperatures that ascend");
  for (std::size_t c = 0; p != nullptr && c < columns; ++c)
    if (c == 0 ? p->members[c].value.number != 0 : p->members[c].value.number <= p->members[c - 1].value.number)
      return context.fault(p->members[c].value,
                           c == 0 ? "a first pressure that is not 0" : "a pressure that is no higher than the last",
                           "pressures that ascend from 0");
  for (std::size_t c = 0; c < columns; ++c) {
    const std::vector<double> at = column_of(law, c), last = c == 0 ? at : column_of(law, c - 1);
    for (std::size_t k = 0; k < at.size(); ++k) {
      // A row is identified by its viscosity: over pressures two may not be the same.
      if (k > 0 && (at[k] > at[k - 1] || (columns > 1 && c == 0 && at[k] == at[k - 1])))
        return context.fault(mu.members[k].value, "an oil that thickens as it is heated", "viscosities that fall");
      if (at[k] < last[k])
        return context.fault(mu.members[k].value, "an oil that thins under pressure", "viscosities that rise with it");
    }
  }
}

/// Reports laws that no oil has.
void check_temperature_law(Context& context, const Value& law) {
  if (law.text == "table") check_table(context, law);
  if (law.text == "walther" && number_of(law, "nu40") <= number_of(law, "nu100"))
    context.fault(*law.find("nu100"), "an oil that is no thinner at 100 degC than at 40 degC", "nu100 below nu40",
                  "are both in the wrong order?");
}

film::TemperatureLaw temperature_law_of(Context& context, const Value& lubricant) {
  const Value* given = lubricant.find("viscosity");
  if (given == nullptr) {
    if (lubricant.find("grade") == nullptr && !lubricant.broken)
      context.fault_at_key(lubricant, "a lubricant without a viscosity", "a 'viscosity' or a 'grade'");
    const OilGrade* grade = grade_of(lubricant);
    if (grade == nullptr) return film::FixedViscosity{};
    auto walther = film::WaltherViscosity::through(grade->nu40, grade->nu100, density_of(lubricant));
    walther.expansion = expansion_of(lubricant);
    return walther;
  }
  if (given->broken || given->members.empty()) return film::FixedViscosity{};
  const Value& law = given->members.front().value;
  if (law.type->kind == Type::Kind::quantity) return film::FixedViscosity{law.number};
  if (law.broken || context.has_fault_in(law.path)) return film::FixedViscosity{};
  check_temperature_law(context, law);
  if (context.has_fault_in(law.path)) return film::FixedViscosity{};
  return read_alternative(law, temperature_laws(density_of(lubricant), expansion_of(lubricant)));
}

/// mu_inf over the viscosity at rest; reports what makes no sense.
double shear_limit_of(Context& context, const Value& law, const film::Lubricant& oil, bool has_viscosity) {
  const Value *ratio = law.find("limit_ratio"), *viscosity = law.find("limit_viscosity");
  if (ratio != nullptr && viscosity != nullptr)
    context.fault(*viscosity, "two limits of the same oil", "a 'limit_ratio' or a 'limit_viscosity'");
  if (ratio != nullptr) return ratio->number;
  if (viscosity == nullptr) return 0;
  if (!has_viscosity)
    context.fault(*viscosity, "a limit as a viscosity of an oil whose own viscosity depends on a temperature not given",
                  "a `temperature` of the lubricant, or a 'limit_ratio'");
  else if (viscosity->number > oil.mu0)
    context.fault(*viscosity, fmt::format("a limit above the viscosity at rest, {:.4g} mPa.s", 1e3 * oil.mu0),
                  "a smaller one");
  return std::min(1.0, viscosity->number / oil.mu0);
}

film::ShearThinning shear_thinning_of(Context& context, const Value& lubricant, const film::Lubricant& oil,
                                      bool has_viscosity) {
  const Value* given = lubricant.find("shear_thinning");
  if (given == nullptr) {
    const OilGrade* grade = grade_of(lubricant);
    return grade != nullptr ? grade->shear_thinning() : film::ShearThinning{};
  }
  const Value& law = *given;
  if (law.broken || law.text == "none" || context.has_fault_in(law.path)) return {};
  film::ShearThinning thinning;
  thinning.law = read_alternative(law, shear_laws(shear_limit_of(context, law, oil, has_viscosity)));
  if (const Value* rate = law.find("critical_shear_rate")) thinning.critical_rate = rate->number;
  if (const Value* stress = law.find("critical_stress")) thinning.critical_stress = stress->number;
  if (!std::visit([](const auto& one) { return one.is_monotone(); }, thinning.law)) {
    const auto& cross = std::get<film::Cross>(thinning.law);
    const double m = cross.exponent, least = (m - 1) * (m - 1) / (4 * m);
    context.fault(
        *law.find("exponent"), "an oil whose shear stress falls as it is sheared faster: no film has one answer",
        fmt::format("an exponent of at most 1, or with this one a limit_ratio above {:.3g}", least / (1 + least)));
  }
  return thinning;
}

}  // namespace

void warn_of_temperature(Context& context, const Value& T, const OilValidity& validity, const std::string& oil) {
  const std::string warning = temperature_warning(validity, T.number);
  if (warning.empty()) return;
  context.model.warnings.push_back({T.position, T.path,
                                    "oil '" + oil + "' where its viscosity is not known: " + warning,
                                    "a temperature between these ends, or an oil known there", ""});
}

void interpret_lubricants(Context& context) {
  for (const auto& [name, value] : section(context.root, "lubricants")) {
    Lubricant lubricant{.name = name, .data = {}, .position = value.key_position};
    film::Lubricant& oil = lubricant.data;
    oil.temperature_law = temperature_law_of(context, value);
    oil.density = oil.rho15 = density_of(value);
    oil.expansion = expansion_of(value);
    oil.specific_heat = number_of(value, "specific_heat");
    oil.conductivity = number_of(value, "conductivity");
    if (const auto* fixed = std::get_if<film::FixedViscosity>(&oil.temperature_law)) oil.mu0 = fixed->mu;
    if (const Value* T = value.find("temperature"); T != nullptr && !T->broken) {
      lubricant.temperature = T->number;
      oil = film::at_temperature(oil, T->number);
    }
    if (const OilGrade* grade = grade_of(value)) lubricant.grade = grade->name;
    oil.viscosity_law = viscosity_law_of(context, value, oil.mu0);
    oil.density_law = density_law_of(context, value);
    const bool has_viscosity = lubricant.temperature || !film::depends_on_temperature(oil.temperature_law);
    oil.shear_thinning = shear_thinning_of(context, value, oil, has_viscosity);
    warn_of_unphysical(context, value);
    if (has_viscosity) warn_of_viscosity(context, value, oil.mu0);
    lubricant.validity = validity_of(oil, grade_of(value));
    if (const Value* T = value.find("temperature"); T != nullptr && !T->broken)
      warn_of_temperature(context, *T, lubricant.validity, name);
    context.model.lubricants.push_back(std::move(lubricant));
  }
}

}  // namespace hersey::model
