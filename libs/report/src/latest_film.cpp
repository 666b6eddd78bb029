#include "hersey/report/latest_film.h"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "base64.h"

namespace hersey::report {
namespace {

using FilmJson = nlohmann::json;

FilmJson film_dataset(const results::DatasetInfo& info, std::vector<std::size_t> shape,
                      const std::vector<double>& values, bool is_exact) {
  return {{"unit", info.unit},
          {"description", info.description},
          {"shape", std::move(shape)},
          {"type", is_exact ? "f8" : "f4"},
          {"data", is_exact ? base64_float64(values) : base64_float32(values)}};
}

}  // namespace

std::string latest_film_json(const results::Reader& reader, const std::string& bearing) {
  const std::string group = "/bearings/" + bearing, fields = group + "/fields";
  FilmJson film{{"bearing", bearing}, {"t", nullptr}, {"datasets", FilmJson::object()}};
  if (!reader.has(fields + "/time")) return film.dump();
  const results::Array time = reader.read(fields + "/time");
  if (time.values.empty()) return film.dump();
  const std::size_t last = time.values.size() - 1;
  film["t"] = time.values[last];
  const auto add = [&](const std::string& path) {
    const results::DatasetInfo info = reader.info(path);
    if (info.is_text || (info.grows && (info.shape.empty() || info.shape[0] <= last))) return;
    // What is seen while a run goes on is its pressure and its gap.
    if (info.shape.size() > 2 && !path.ends_with("/pressure") && !path.ends_with("/thickness")) return;
    const results::Array array = info.grows ? reader.read_rows(path, last, 1) : reader.read(path);
    film["datasets"][path] = film_dataset(info, array.info.shape, array.values, path.ends_with("/time"));
  };
  for (const std::string& name : reader.children(fields)) add(fields + "/" + name);
  // What tells a skirt from a bore.
  if (const std::string mark = group + "/skirt_speed"; reader.has(mark))
    film["datasets"][mark] = film_dataset(reader.info(mark), {0}, {}, false);
  return film.dump(-1, ' ', false, FilmJson::error_handler_t::replace);
}

}  // namespace hersey::report
