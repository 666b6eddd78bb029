#pragma once

#include <optional>
#include <string>

#include "interpret/context/interpret.h"
#include "interpret/files/csv_table.h"

namespace hersey::model {

/// The table in the file that `file` names, beside the model file; reports what is wrong with it.
[[nodiscard]] std::optional<CsvTable> read_table_file(Context& context, const Value& file);

/// Factor from `unit` to `si_unit`; reports a fault at `at` where they do not fit.
[[nodiscard]] std::optional<double> unit_factor(Context& context, const Value& at, const std::string& unit,
                                                const std::string& si_unit);

}  // namespace hersey::model
