#include "run_data.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base64.h"
#include "quantised.h"

namespace hersey::report {
namespace {

using nlohmann::json;
using results::DatasetInfo;
using results::Reader;

bool is_field(const DatasetInfo& info) { return info.grows && info.shape.size() == 3; }
bool in_fields(const std::string& path) { return path.find("/fields/") != std::string::npos; }

/// Maps over angle and time: many numbers a row, of which a picture shows some hundred rows.
bool is_around(const std::string& path) { return path.ends_with("_around"); }

json attributes_of(const Reader& reader, const std::string& object) {
  json attributes = json::object();
  for (const std::string& name : reader.attributes(object)) {
    if (const auto text = reader.text_attribute(object, name))
      attributes[name] = *text;
    else if (const auto number = reader.number_attribute(object, name))
      attributes[name] = *number;
    else
      attributes[name] = reader.list_attribute(object, name);
  }
  return attributes;
}

std::size_t stride_for(std::size_t rows, std::size_t most) { return rows <= most ? 1 : (rows + most - 1) / most; }

/// Those of a film at its stored instants; not those of modes, and of cycles, of which there are few.
bool is_of_film(const std::string& path) {
  return path.starts_with("/bearings/") && in_fields(path) && path.find("/cycles/") == std::string::npos;
}

/// Instants of fields to skip so that all fields, of films or the others, fit into the budget.
std::size_t field_stride(const Reader& reader, std::size_t budget, bool of_films) {
  std::size_t bytes = 0, longest = 1;
  for (const std::string& path : reader.datasets()) {
    const DatasetInfo info = reader.info(path);
    if (!is_field(info) || is_of_film(path) != of_films) continue;
    bytes += info.shape[0] * info.shape[1] * info.shape[2] * sizeof(std::uint16_t);
    longest = std::max(longest, info.shape[0]);
  }
  return std::min(longest, stride_for(bytes, std::max<std::size_t>(budget, 1)));
}

/// Rows of the time series to show so that all of them fit into the budget.
std::size_t shown_rows(const Reader& reader, const Budget& budget) {
  constexpr std::size_t fewest = 100;
  std::size_t width = 0;
  for (const std::string& path : reader.datasets()) {
    const DatasetInfo info = reader.info(path);
    if (!info.grows || in_fields(path) || is_around(path)) continue;
    width += info.shape.size() > 1 ? info.shape[1] : 1;
  }
  const std::size_t fit = budget.series_bytes / (sizeof(float) * std::max<std::size_t>(width, 1));
  return std::min(budget.series_rows, std::max(fewest, fit));
}

/// Time and angle grow large and are subtracted from each other: they keep double precision.
bool needs_double(const std::string& path) { return path.ends_with("/time") || path.ends_with("/crank_angle"); }

json dataset(const Reader& reader, const std::string& path, const DatasetInfo& info, std::size_t stride) {
  const std::size_t rows = info.shape.empty() ? 0 : info.shape[0];
  const std::size_t first = rows > 0 ? (rows - 1) % stride : 0;
  const results::Array array = reader.read_rows(path, first, rows, stride);
  const bool wide = needs_double(path);
  json entry;
  entry["unit"] = info.unit;
  entry["description"] = info.description;
  entry["shape"] = array.info.shape;
  if (is_field(info) && in_fields(path)) {
    const Quantised quantised = quantise(array.values, info.shape[1] * info.shape[2]);
    entry["type"] = "u2";
    entry["data"] = base64_uint16(quantised.codes);
    entry["low"] = base64_float32(quantised.low);
    entry["step"] = base64_float32(quantised.step);
  } else {
    entry["type"] = wide ? "f8" : "f4";
    entry["data"] = wide ? base64_float64(array.values) : base64_float32(array.values);
  }
  if (const auto names = reader.list_attribute(path, "coordinate_names"); !names.empty()) entry["columns"] = names;
  return entry;
}

}  // namespace

json run_data(const Reader& reader, const Budget& budget) {
  const std::size_t series_stride = stride_for(reader.rows(), shown_rows(reader, budget));
  const std::size_t instants_stride = field_stride(reader, budget.field_bytes, true);
  const std::size_t other_stride = field_stride(reader, budget.field_bytes, false);
  const std::size_t shown = (reader.rows() + series_stride - 1) / series_stride;
  const std::size_t most_around = std::clamp<std::size_t>(budget.series_rows / 10, 90, 360);
  const std::size_t around_stride = stride_for(shown, most_around);
  json run;
  run["file"] = reader.path().filename().string();
  run["rows"] = reader.rows();
  run["series_stride"] = series_stride;
  run["field_stride"] = instants_stride;
  run["around_stride"] = around_stride;
  run["attributes"] = json::object();
  for (const std::string& group : reader.groups()) run["attributes"][group] = attributes_of(reader, group);
  run["datasets"] = json::object();
  run["assumptions"] = json::array();
  for (const std::string& path : reader.datasets()) {
    if (path == "/model") {
      run["model"] = reader.text(path);
    } else if (path == "/assumptions") {
      run["assumptions"] = reader.text_table(path);
    } else {
      const DatasetInfo info = reader.info(path);
      if (info.is_text) continue;
      const std::size_t of_series = is_around(path) ? around_stride * series_stride : series_stride;
      const std::size_t of_field = is_of_film(path) ? instants_stride : other_stride;
      const std::size_t stride = !info.grows ? 1 : in_fields(path) ? of_field : of_series;
      run["datasets"][path] = dataset(reader, path, info, stride);
    }
  }
  return run;
}

json film_fields(const Reader& reader, const std::string& bearing, std::size_t budget) {
  const std::size_t stride = field_stride(reader, budget, true);
  json datasets = json::object();
  for (const std::string& path : reader.datasets()) {
    if (!path.starts_with("/bearings/" + bearing + "/") || !is_of_film(path)) continue;
    const DatasetInfo info = reader.info(path);
    if (info.grows && !info.is_text) datasets[path] = dataset(reader, path, info, stride);
  }
  return datasets;
}

}  // namespace hersey::report
