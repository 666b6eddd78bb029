#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include "hersey/core/spelling.h"
#include "hersey/core/units.h"
#include "interpret/context/interpret.h"
#include "interpret/context/table_file.h"
#include "schema/format.h"

// Bearings, seals and magnetic bearings by a table of their coefficients, in a file or in the model.
namespace hersey::model {
namespace {

using Coefficients = mbd::BearingCoefficients;

constexpr double kSymmetric = 1e-6;  // of numbers that somebody wrote down
constexpr std::array<const char*, 4> kPlaces{"xx", "xy", "yx", "yy"};

double& at_place(Eigen::Matrix2d& matrix, std::size_t place) {
  return matrix(static_cast<Eigen::Index>(place / 2), static_cast<Eigen::Index>(place % 2));
}

/// A column of a table of coefficients, and the number that it gives.
struct KnownColumn {
  std::string name, unit;
  double& (*number)(Coefficients&, std::size_t place);
  std::size_t place;
};

const std::vector<KnownColumn>& known_columns() {
  static const std::vector<KnownColumn> known = [] {
    std::vector<KnownColumn> columns;
    for (std::size_t p = 0; p < kPlaces.size(); ++p) {
      const std::string place = kPlaces[p];
      columns.push_back(
          {"k_" + place, "N/m", [](Coefficients& c, std::size_t q) -> double& { return at_place(c.stiffness, q); }, p});
      columns.push_back(
          {"c_" + place, "N.s/m", [](Coefficients& c, std::size_t q) -> double& { return at_place(c.damping, q); }, p});
      columns.push_back(
          {"m_" + place, "kg", [](Coefficients& c, std::size_t q) -> double& { return at_place(c.inertia, q); }, p});
    }
    const auto position = [](Coefficients& c, std::size_t q) -> double& {
      return c.position(static_cast<Eigen::Index>(q));
    };
    const auto force = [](Coefficients& c, std::size_t q) -> double& { return c.force(static_cast<Eigen::Index>(q)); };
    columns.push_back({"x", "m", position, 0});
    columns.push_back({"y", "m", position, 1});
    columns.push_back({"force_x", "N", force, 0});
    columns.push_back({"force_y", "N", force, 1});
    return columns;
  }();
  return known;
}

/// The column of this name, `kxx` for `k_xx` as well.
const Column* found_column(const CsvTable& table, const std::string& name) {
  std::string joined = name;
  std::erase(joined, '_');
  const Column* column = table.find(name);
  return column != nullptr ? column : table.find(joined);
}

std::optional<std::vector<double>> in_si(Context& context, const Value& file, const Column& column,
                                         const std::string& si_unit) {
  std::vector<double> values;
  try {
    for (const double value : column.values) values.push_back(convert_to_si({value, column.unit}, si_unit));
  } catch (const QuantityError& error) {
    if (column.unit.empty())
      context.fault(file, "column '" + column.name + "' in no unit",
                    "a unit in brackets, such as " + column.name + " [" + si_unit + "]");
    else
      context.fault(file, "column '" + column.name + "' in " + error.found, error.expected, error.suggestion);
    return std::nullopt;
  }
  return values;
}

/// Reports columns that are none of a bearing's, of which a misspelt one would be lost without a word, and second ones.
void require_known(Context& context, const Value& file, const CsvTable& table) {
  std::vector<std::string> names{"speed"};
  for (const KnownColumn& known : known_columns()) names.push_back(known.name);
  for (const Column& column : table.columns) {
    const bool is_known = std::any_of(names.begin(), names.end(),
                                      [&](const std::string& name) { return found_column(table, name) == &column; });
    const std::string where = "column '" + column.name + "' in " + table.file;
    if (table.find(column.name) != &column)
      context.fault(file, where + " a second time", "each column once");
    else if (!is_known)
      context.fault(file, where, one_of(names), did_you_mean(column.name, names));
  }
}

bool ascend(Context& context, const Value& file, const CsvTable& table, const std::vector<double>& speeds) {
  for (std::size_t k = 1; k < speeds.size(); ++k) {
    if (speeds[k] > speeds[k - 1]) continue;
    context.fault(file,
                  fmt::format("line {} of {}: a speed that is not above the one before", table.lines[k], table.file),
                  "one row for each speed, speeds that ascend");
    return false;
  }
  return true;
}

struct Table {
  std::vector<double> speeds;
  std::vector<Coefficients> coefficients;
};

std::optional<Table> from_file(Context& context, const Value& file) {
  const std::optional<CsvTable> table = read_table_file(context, file);
  if (!table) return std::nullopt;
  const std::size_t before = context.faults.size();
  require_known(context, file, *table);
  for (const char* name : {"speed", "k_xx", "k_yy"})
    if (found_column(*table, name) == nullptr)
      context.fault(file, std::string("no column '") + name + "' in " + table->file,
                    "columns speed, k_xx and k_yy at least", did_you_mean(name, table->names()));
  if (context.faults.size() > before) return std::nullopt;
  const auto speeds = in_si(context, file, *table->find("speed"), "rad/s");
  Table read{speeds.value_or(std::vector<double>()), std::vector<Coefficients>(table->lines.size())};
  for (const KnownColumn& known : known_columns()) {
    const Column* column = found_column(*table, known.name);
    const auto values = column == nullptr ? std::nullopt : in_si(context, file, *column, known.unit);
    if (!values) continue;
    for (std::size_t row = 0; row < values->size(); ++row)
      known.number(read.coefficients[row], known.place) = (*values)[row];
  }
  if (context.faults.size() > before || !ascend(context, file, *table, read.speeds)) return std::nullopt;
  return read;
}

Eigen::Matrix2d coefficients_of(const Value& value, const std::string& key) {
  Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
  const Value* given = value.find(key);
  if (given == nullptr || given->broken) return matrix;
  for (std::size_t p = 0; p < kPlaces.size(); ++p) at_place(matrix, p) = number_of(*given, kPlaces[p]);
  return matrix;
}

Eigen::Vector2d across_of(const Value& value, const std::string& key) {
  const Value* given = value.find(key);
  if (given == nullptr || given->broken) return Eigen::Vector2d::Zero();
  return {number_of(*given, "x"), number_of(*given, "y")};
}

Table from_keys(const Value& value) {
  return {{0},
          {{.stiffness = coefficients_of(value, "stiffness"),
            .damping = coefficients_of(value, "damping"),
            .inertia = coefficients_of(value, "inertia"),
            .position = across_of(value, "position"),
            .force = across_of(value, "force")}}};
}

bool is_symmetric(const Coefficients& c) {
  return std::abs(c.inertia(0, 1) - c.inertia(1, 0)) <= kSymmetric * c.inertia.cwiseAbs().maxCoeff();
}

TypePtr matrix_format(const std::string& what, const std::string& unit, const std::string& example) {
  const TypePtr number = quantity(unit, example);
  std::vector<Key> keys;
  for (const char* place : kPlaces) {
    const bool is_direct = place[0] == place[1];
    keys.push_back(
        is_direct ? required(place, number, fmt::format("Along {0} by the motion along {0}.", place[0]))
                  : defaulted(place, number, "0", fmt::format("Along {} by the motion along {}.", place[0], place[1])));
  }
  return object(what, std::move(keys));
}

TypePtr across_format(const std::string& what, const std::string& unit, const std::string& example) {
  const TypePtr number = quantity(unit, example);
  return object(what, {defaulted("x", number, "0", "Along x of the first frame."),
                       defaulted("y", number, "0", "Along y of the first frame.")});
}

}  // namespace

std::vector<Key> bearing_table_keys() {
  return {
      required("between", list("two frames", reference(Refers::frame, "rotor.drive_end"), 2),
               "Housing, whose z-axis is that of the shaft, and shaft."),
      optional("file", text("a file", "drive_end.csv"),
               "CSV file beside the model, as `hersey bearing --coefficients` writes it: a row for each speed; columns "
               "`speed`, `k_xx`, "
               "`k_xy`, `k_yx`, `k_yy`, `c_xx`.., `m_xx`.., the position `x`, `y` of equilibrium and `force_x`, "
               "`force_y` on the shaft "
               "there, units in brackets. Smooth between its speeds, constant down to rest."),
      optional("stiffness", matrix_format("four coefficients of stiffness", "N/m", "1e8 N/m"),
               "Instead of a file: the same at every speed. `xy` is minus the force along x by the motion along y."),
      optional("damping", matrix_format("four coefficients of damping", "N.s/m", "2e5 N.s/m"),
               "Likewise, by the velocity.", "none"),
      optional("inertia", matrix_format("four coefficients of inertia", "kg", "3 kg"),
               "Likewise, by the acceleration; symmetric.", "none"),
      optional("position", across_format("a position across the axis", "m", "12 um"),
               "Where the shaft is at equilibrium.", "the origin"),
      optional("force", across_format("a force across the axis", "N", "500 N"), "On the shaft at equilibrium.", "none"),
  };
}

BearingTable bearing_table_of(Context& context, const Value& value) {
  BearingTable bearing;
  std::tie(bearing.from, bearing.to) = pair_of(context, value);
  const Value *file = value.find("file"), *stiffness = value.find("stiffness");
  if ((file != nullptr && file->broken) || (stiffness != nullptr && stiffness->broken)) return bearing;
  if (file == nullptr && stiffness == nullptr) {
    context.fault_at_key(value, "neither 'file' nor 'stiffness'", "one of them");
    return bearing;
  }
  for (const char* key : {"stiffness", "damping", "inertia", "position", "force"})
    if (const Value* given = value.find(key); given != nullptr && file != nullptr)
      context.fault_at_key(*given, std::string("'") + key + "' beside a file", "the columns of the file alone");
  const std::optional<Table> table = file != nullptr ? from_file(context, *file) : from_keys(value);
  if (!table) return bearing;
  if (!std::all_of(table->coefficients.begin(), table->coefficients.end(), is_symmetric)) {
    context.fault_at_key(value, "an inertia whose xy and yx differ", "a symmetric one");
    return bearing;
  }
  std::vector<Coefficients> coefficients = table->coefficients;
  for (Coefficients& c : coefficients) c.inertia = (c.inertia + c.inertia.transpose()).eval() / 2;
  bearing.table = std::make_shared<const mbd::BearingCoefficientTable>(table->speeds, coefficients);
  return bearing;
}

}  // namespace hersey::model
