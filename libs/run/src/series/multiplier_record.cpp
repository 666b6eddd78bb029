#include "series/multiplier_record.h"

#include <cmath>
#include <numbers>

namespace hersey::run {

// A group called fields counts its own rows, because multipliers are not instants.
const QuantityTable<MultiplierRecord::Row, model::Model>& MultiplierRecord::table() {
  static const QuantityTable<Row, model::Model> table{
      {"fields/magnitude",
       "1",
       "factor by which a small deviation from the periodic motion changes in a cycle",
       [](const Row& row) { return std::abs(row.multiplier); },
       {.note = "the largest first; above 1: the motion is unstable"}},
      {"fields/real", "1", "real part of the multiplier", [](const Row& row) { return row.multiplier.real(); }},
      {"fields/imaginary", "1", "imaginary part of the multiplier",
       [](const Row& row) { return row.multiplier.imag(); }},
      {"fields/growth",
       "1/s",
       "rate at which the deviation grows",
       [](const Row& row) { return std::log(std::abs(row.multiplier)) / row.period; },
       {.note = "ln of the magnitude over the period"}},
      {"fields/frequency",
       "Hz",
       "lowest frequency of the deviation",
       [](const Row& row) { return std::abs(std::arg(row.multiplier)) / (2 * std::numbers::pi * row.period); },
       {.note = "its frequency less a multiple of the cycles', or the reverse"}},
  };
  return table;
}

void MultiplierRecord::write(const std::vector<std::complex<double>>& multipliers, double period) const {
  for (const std::complex<double>& multiplier : multipliers) rows_.append({multiplier, period});
}

QuantityGroup MultiplierRecord::describe() {
  QuantityGroup group{.path = kPath, .heading = "of a run by cycles with `multipliers`", .quantities = {}};
  run::describe(table(), "multipliers", group);
  return group;
}

}  // namespace hersey::run
