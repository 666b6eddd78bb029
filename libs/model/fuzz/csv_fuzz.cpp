// libFuzzer target: whatever the bytes, the reader of tables returns columns of finite numbers, all as long, or faults.
// seeds: examples/slider_crank/gas_pressure.csv examples/engine/gas_pressure.csv
// longest: 4096
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "../src/interpret/files/csv_table.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<hersey::Fault> faults;
  const std::optional<hersey::model::CsvTable> table =
      hersey::model::parse_csv({data, data + size}, "fuzz.csv", faults);
  if (table.has_value() == !faults.empty()) std::abort();
  if (!table) return 0;
  if (table->lines.empty() || table->columns.empty()) std::abort();
  for (const hersey::model::Column& column : table->columns) {
    if (column.values.size() != table->lines.size()) std::abort();
    for (const double value : column.values)
      if (!std::isfinite(value)) std::abort();
  }
  return 0;
}
