#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "hersey/core/spelling.h"
#include "hersey/core/two_pi.h"
#include "interpret/context/table_file.h"

namespace hersey::model {
namespace {

/// A table of three columns as openings [m] by height [m] and angle [rad].
class ShapeTable {
 public:
  ShapeTable(Context& context, const Value& file, const CsvTable& table)
      : context_(context), file_(file), table_(table) {}

  /// @param L  width that the heights have to cover; 0: any heights
  /// @param sides  grid of patches that the angles have to cover; null: the whole circle
  [[nodiscard]] std::optional<film::MeasuredShape> shape(double L, const film::Grid* sides) {
    const std::optional<std::vector<double>> angle = column("angle", "rad"), z = column("z", "m"),
                                             opening = column("opening", "m");
    if (!angle || !z || !opening) return std::nullopt;
    for (std::size_t k = 0; k < angle->size(); ++k) {
      if (!rows_[(*z)[k]].emplace((*angle)[k], (*opening)[k]).second) {
        return fault(k, "a second opening at this angle and z", "one for each");
      }
    }
    if (!is_complete(*angle, *z) || !is_within(*angle, *z, L)) return std::nullopt;
    if (sides != nullptr && (!is_on_skirt(*z, L) || !covers_sides(*angle, *sides))) return std::nullopt;
    return as_shape();
  }

 private:
  std::optional<std::vector<double>> column(const std::string& name, const std::string& si_unit) {
    const Column* found = table_.find(name);
    if (found == nullptr) {
      context_.fault(file_, "no column '" + name + "' in " + table_.file, "columns angle, z and opening",
                     did_you_mean(name, table_.names()));
      return std::nullopt;
    }
    const std::optional<double> factor = unit_factor(context_, file_, found->unit, si_unit);
    if (!factor) return std::nullopt;
    std::vector<double> values = found->values;
    for (double& value : values) value *= *factor;
    return values;
  }

  std::nullopt_t fault(std::size_t row, std::string found, std::string expected) {
    context_.faults.push_back(
        {{table_.file, table_.lines[row], 1}, file_.path, std::move(found), std::move(expected), ""});
    return std::nullopt;
  }

  /// Every height has every angle.
  bool is_complete(const std::vector<double>& angle, const std::vector<double>& z) {
    const std::set<double> angles(angle.begin(), angle.end());
    if (angles.size() < 3) {
      context_.fault(file_, fmt::format("{} angles", angles.size()), "3 or more of them");
      return false;
    }
    for (std::size_t k = 0; k < z.size(); ++k) {
      if (rows_[z[k]].size() == angles.size()) continue;
      (void)fault(k, fmt::format("{} of {} angles at this z", rows_[z[k]].size(), angles.size()),
                  "an opening for every angle at every z");
      return false;
    }
    return true;
  }

  /// The angles lie within 360 deg; the heights reach both edges, or there is only one, which holds for the whole
  /// width.
  bool is_within(const std::vector<double>& angle, const std::vector<double>& z, double L) {
    const auto [first, last] = std::minmax_element(angle.begin(), angle.end());
    if (*last - *first >= two_pi * (1 - 1e-9)) {
      (void)fault(static_cast<std::size_t>(last - angle.begin()), "angles over 360 deg or more",
                  "angles within 360 deg; the first follows the last");
      return false;
    }
    const auto [low, high] = std::minmax_element(z.begin(), z.end());
    const bool covers = *low <= -0.5 * L * (1 - 1e-6) && *high >= 0.5 * L * (1 - 1e-6);
    if (covers || rows_.size() == 1 || L == 0) return true;
    context_.fault(file_, fmt::format("heights z from {:.4g} to {:.4g} mm", 1e3 * *low, 1e3 * *high),
                   fmt::format("the whole width, {:.4g} to {:.4g} mm, or a single z", -0.5e3 * L, 0.5e3 * L));
    return false;
  }

  /// A skirt's profile ends where the skirt does.
  bool is_on_skirt(const std::vector<double>& z, double L) {
    for (std::size_t k = 0; k < z.size(); ++k) {
      if (std::abs(z[k]) <= 0.5 * L * (1 + 1e-6)) continue;
      (void)fault(k, fmt::format("z = {:.4g} mm, beyond the skirt's end", 1e3 * z[k]),
                  fmt::format("z from {:.4g} to {:.4g} mm, from the middle of the skirt", -0.5e3 * L, 0.5e3 * L));
      return false;
    }
    return true;
  }

  /// Between two sides lies an angle of the table, an end of a side at least: no side reaches into a gap of it.
  bool covers_sides(const std::vector<double>& angle, const film::Grid& grid) {
    constexpr double to_degrees = 180 / std::numbers::pi, same = 1e-6;
    const auto is_between = [&](double from, double to) {
      return std::any_of(angle.begin(), angle.end(), [&](double a) {
        const double behind = std::fmod(std::fmod(a - from, two_pi) + two_pi, two_pi);
        return behind <= to - from + same || behind >= two_pi - same;
      });
    };
    const double first = grid.phi(0), first_ends = grid.phi(grid.patches[1] - 1), second = grid.phi(grid.patches[1]),
                 second_ends = grid.phi(grid.n_phi - 1);
    for (const auto& [from, to] : {std::pair(first_ends, second), std::pair(second_ends, first + two_pi)}) {
      if (is_between(from, to)) continue;
      context_.fault(file_,
                     fmt::format("no angle from {:.4g} to {:.4g} deg, where both sides of the skirt end",
                                 to_degrees * from, to_degrees * to),
                     "angles that reach over both sides, their ends included",
                     "angles count from the middle of the thrust side; the antithrust side is about 180 deg");
      return false;
    }
    return true;
  }

  [[nodiscard]] film::MeasuredShape as_shape() const {
    film::MeasuredShape shape;
    for (const auto& [z, curve] : rows_) {
      std::vector<double> angles, openings;
      for (const auto& [angle, opening] : curve) {
        angles.push_back(angle);
        openings.push_back(opening);
      }
      shape.z.push_back(z);
      shape.openings.push_back(std::make_shared<TableFunction>(
          std::move(angles), std::move(openings),
          TableFunction::Options{.interpolation = Interpolation::smooth, .period = two_pi}));
    }
    return shape;
  }

  Context& context_;
  const Value& file_;
  const CsvTable& table_;
  std::map<double, std::map<double, double>> rows_;  ///< opening by z and angle
};

}  // namespace

std::optional<film::MeasuredShape> measured_shape_of(Context& context, const Value& file, double L,
                                                     const film::Grid* sides) {
  const std::optional<CsvTable> table = read_table_file(context, file);
  return table ? ShapeTable(context, file, *table).shape(L, sides) : std::nullopt;
}

}  // namespace hersey::model
