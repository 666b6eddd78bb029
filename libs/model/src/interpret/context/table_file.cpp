#include "interpret/context/table_file.h"

#include <filesystem>

#include "hersey/core/input_file.h"
#include "hersey/core/units.h"

namespace hersey::model {

std::optional<CsvTable> read_table_file(Context& context, const Value& file) {
  if (file.broken) return std::nullopt;
  const std::filesystem::path path = referenced_file(context, file.text);
  const InputFile table = read_input_file(path);
  if (!table.fault.empty()) {
    context.fault(file, table.fault + " " + path.string(), "a table beside the model file");
    return std::nullopt;
  }
  return parse_csv(table.content, path.string(), context.faults);
}

std::optional<double> unit_factor(Context& context, const Value& at, const std::string& unit,
                                  const std::string& si_unit) {
  try {
    return convert_to_si({1, unit}, si_unit);
  } catch (const QuantityError& error) {
    const Dimension& dimension = dimension_of(si_unit);
    context.fault(at, error.found,
                  "a unit of " + dimension.name.substr(dimension.name.find(' ') + 1) +
                      (si_unit == "1" ? "" : ", such as " + dimension.spelled.front()),
                  error.suggestion);
    return std::nullopt;
  }
}

}  // namespace hersey::model
