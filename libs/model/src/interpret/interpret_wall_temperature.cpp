#include <fmt/format.h>

#include <cmath>

#include "hersey/core/spelling.h"
#include "hersey/core/two_pi.h"
#include "hersey/core/units.h"
#include "interpret/table_file.h"

// Temperatures of a shell over its angle.
namespace hersey::model {
namespace {

/// Rows of the table.
struct Around {
  std::vector<double> phi, T;  ///< [rad], [K]
};

std::optional<std::vector<double>> column(Context& context, const Value& file, const CsvTable& table,
                                          const std::string& name, const std::string& si_unit) {
  const Column* found = table.find(name);
  if (found == nullptr) {
    context.fault(file, "no column '" + name + "' in " + table.file, "columns angle and temperature",
                  did_you_mean(name, table.names()));
    return std::nullopt;
  }
  std::vector<double> values;
  try {
    for (const double value : found->values) values.push_back(convert_to_si({value, found->unit}, si_unit));
  } catch (const QuantityError& error) {
    context.fault(file, "column '" + name + "' in " + error.found, error.expected, error.suggestion);
    return std::nullopt;
  }
  return values;
}

std::optional<Around> from_file(Context& context, const Value& file) {
  if (file.broken) return std::nullopt;
  const std::optional<CsvTable> table = read_table_file(context, file);
  if (!table) return std::nullopt;
  auto phi = column(context, file, *table, "angle", "rad"), T = column(context, file, *table, "temperature", "K");
  if (!phi || !T) return std::nullopt;
  return Around{std::move(*phi), std::move(*T)};
}

std::optional<Around> in_place(const Value& table) {
  const Value *angles = table.find("angles"), *temperatures = table.find("temperatures");
  if (angles == nullptr || temperatures == nullptr || angles->broken || temperatures->broken) return std::nullopt;
  Around around;
  for (const Member& angle : angles->members) around.phi.push_back(angle.value.number);
  for (const Member& T : temperatures->members) around.T.push_back(T.value.number);
  return around;
}

bool is_usable(Context& context, const Value& at, const Around& table) {
  const std::size_t n = table.phi.size();
  if (n != table.T.size() || n < 2) {
    context.fault_at_key(at, fmt::format("{} temperatures at {} angles", table.T.size(), n),
                         "as many of both, two at least");
    return false;
  }
  for (std::size_t k = 1; k < n; ++k) {
    if (table.phi[k] > table.phi[k - 1]) continue;
    context.fault_at_key(at,
                         fmt::format("an angle of {:.4g} deg after one of {:.4g} deg", table.phi[k] / two_pi * 360,
                                     table.phi[k - 1] / two_pi * 360),
                         "angles that ascend");
    return false;
  }
  if (table.phi.back() - table.phi.front() >= two_pi - 1e-9) {
    context.fault_at_key(at, "angles of a whole turn or more", "angles within one turn: the last leads to the first");
    return false;
  }
  return true;
}

/// Straight lines from row to row, and from the last to the first (theory manual, thermal.41).
double value_at(const Around& table, double phi) {
  const double first = table.phi.front();
  phi -= two_pi * std::floor((phi - first) / two_pi);
  std::size_t k = table.phi.size() - 1;
  while (k > 0 && table.phi[k] > phi) --k;
  const bool closes = k + 1 == table.phi.size();
  const double to = closes ? first + two_pi : table.phi[k + 1], T = closes ? table.T.front() : table.T[k + 1];
  return table.T[k] + (T - table.T[k]) * (phi - table.phi[k]) / (to - table.phi[k]);
}

}  // namespace

film::WallAtTemperature wall_at_temperature(Context& context, const Value& temperature, const film::Grid& grid) {
  film::WallAtTemperature wall;
  if (temperature.broken || temperature.members.empty()) return wall;
  const Value& content = temperature.members.front().value;
  if (content.type->kind == Type::Kind::quantity) {
    wall.T = content.number;
    return wall;
  }
  const std::optional<Around> table =
      content.has("file") ? from_file(context, *content.find("file")) : in_place(content);
  if (!table || !is_usable(context, temperature, *table)) return wall;
  wall.around.resize(grid.n_phi);
  for (int i = 0; i < grid.n_phi; ++i) wall.around[i] = value_at(*table, grid.phi(i));
  wall.T = wall.around.mean();
  return wall;
}

}  // namespace hersey::model
