#include "coefficient_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "hersey/core/input_error.h"
#include "hersey/core/version.h"

namespace hersey::cli {
namespace {

constexpr double kRpm = std::numbers::pi / 30;  // [rad/s]
constexpr std::array<const char*, 4> kPlaces{"xx", "xy", "yx", "yy"};

struct CoefficientRow {
  double speed = 0;                 ///< [rad/s]
  std::array<double, 4> K{}, C{};   ///< [N/m], [N s/m]
  Eigen::Vector2d position, force;  ///< of the shaft at equilibrium [m], and on it [N]
};

InputError no_table(const std::string& found, const std::string& expected) {
  return InputError(Fault{{"--coefficients", 0, 0}, "", found, expected, ""});
}

CoefficientRow row_of(const study::BearingSolution& solution) {
  std::map<std::string, double> si;
  for (const study::BearingFigure& figure : study::figures_of(solution)) si[figure.key] = figure.value * figure.si;
  const auto number = [&](const std::string& key) {
    const auto found = si.find(key);
    if (found == si.end())
      throw no_table("a bearing without the figure " + key, "a journal bearing with stiffness and damping");
    return found->second;
  };
  CoefficientRow row;
  row.speed = number("journal_speed");
  if (row.speed <= 0)
    throw no_table(fmt::format("a journal speed of {:.6g} rpm", row.speed / kRpm),
                   "positive speeds, about the z-axis of the bearing: rotors of other programs rotate from x to y");
  if (si.contains("shell_speed") && si.at("shell_speed") != 0)
    throw no_table("a shell that rotates", "a shell at rest: a table's speed is that of the shaft alone");
  for (std::size_t p = 0; p < kPlaces.size(); ++p) {
    row.K[p] = number(std::string("stiffness_") + kPlaces[p]);
    row.C[p] = number(std::string("damping_") + kPlaces[p]);
  }
  // Of a floating ring the position of a solution is that of the journal in the ring.
  const bool has_ring = solution.pads && solution.pads->ring;
  row.position = has_ring ? solution.pads->ring->journal : Eigen::Vector2d(solution.state.e.head<2>());
  row.force = -solution.state.load.head<2>();
  return row;
}

std::vector<CoefficientRow> rows_of(const std::vector<study::BearingSolution>& solutions) {
  std::vector<CoefficientRow> rows;
  for (const study::BearingSolution& solution : solutions) rows.push_back(row_of(solution));
  std::sort(rows.begin(), rows.end(),
            [](const CoefficientRow& a, const CoefficientRow& b) { return a.speed < b.speed; });
  constexpr double kWritten = 0.01;  // [rpm], the last digit of Ansys's columns
  for (std::size_t k = 1; k < rows.size(); ++k)
    if (rows[k].speed - rows[k - 1].speed < kWritten * kRpm)
      throw no_table(fmt::format("two solutions at {:.6g} rpm", rows[k].speed / kRpm),
                     "one for each speed: --sweep speed=1000rpm:9000rpm:9");
  return rows;
}

std::string for_hersey(const std::vector<CoefficientRow>& rows, const std::string& title) {
  std::string text = fmt::format("# {}\n", title);
  text += "# x, y: axes of the bearing's frame; k_xy = -dF_x/dy, F the force on the shaft, which rotates from x to y\n";
  text += "speed [rpm]";
  for (const char* place : kPlaces) text += fmt::format(", k_{} [N/m]", place);
  for (const char* place : kPlaces) text += fmt::format(", c_{} [N.s/m]", place);
  text += ", x [m], y [m], force_x [N], force_y [N]\n";
  for (const CoefficientRow& row : rows)
    text += fmt::format("{:.12g}, {:.12g}, {:.12g}, {:.12g}, {:.12g}, {:.12g}, {:.12g}\n", row.speed / kRpm,
                        fmt::join(row.K, ", "), fmt::join(row.C, ", "), row.position.x(), row.position.y(),
                        row.force.x(), row.force.y());
  return text;
}

// A table named as BearingElement.save names it, whose keys are the arguments of BearingElement.
std::string for_ross(const std::vector<CoefficientRow>& rows, const std::string& title, const std::string& bearing) {
  std::string text = fmt::format("# {}\n[\"BearingElement_{}\"]\nn = 0\ntag = \"{}\"\n", title, bearing, bearing);
  const auto add = [&](const std::string& name, auto value_of) {
    std::vector<std::string> values;
    for (const CoefficientRow& row : rows) values.push_back(fmt::format("{:.12e}", value_of(row)));
    text += fmt::format("{} = [{}]\n", name, fmt::join(values, ", "));
  };
  for (std::size_t p = 0; p < kPlaces.size(); ++p) {
    add(std::string("k") + kPlaces[p], [p](const CoefficientRow& row) { return row.K[p]; });
    add(std::string("c") + kPlaces[p], [p](const CoefficientRow& row) { return row.C[p]; });
  }
  // One speed is no function of it: BearingElement wants as many speeds as values, or single values alone.
  if (rows.size() > 1) add("frequency", [](const CoefficientRow& row) { return row.speed; });
  return text;
}

// Fixed columns: three titles (A80), the number of speeds and keys of units (3I10: SI coefficients, speeds in rpm),
// then for each speed its number and value (I10, F10.2), K11, K12, K21, K22 and C11 to C22 (4E15.7).
std::string for_ansys(const std::vector<CoefficientRow>& rows, const std::string& title) {
  std::string text =
      fmt::format("{:.80}\nSI units, speeds in rpm\nK12 = -dF1/dx2, rotation from axis 1 to axis 2\n{:10}{:10}{:10}\n",
                  title, rows.size(), 0, 1);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    text += fmt::format("{:10}{:10.2f}\n", k + 1, rows[k].speed / kRpm);
    for (const auto& matrix : {rows[k].K, rows[k].C}) {
      for (const double value : matrix) text += fmt::format("{:15.7E}", value);
      text += '\n';
    }
  }
  return text;
}

}  // namespace

std::string coefficient_table(const std::vector<study::BearingSolution>& solutions, const std::string& bearing,
                              const std::string& model, TableReader reader) {
  const std::vector<CoefficientRow> rows = rows_of(solutions);
  const std::string title = fmt::format("bearing {} of {} by hersey {}", bearing, model, version());
  switch (reader) {
    case TableReader::ross:
      return for_ross(rows, title, bearing);
    case TableReader::ansys:
      return for_ansys(rows, title);
    default:
      return for_hersey(rows, title);
  }
}

}  // namespace hersey::cli
