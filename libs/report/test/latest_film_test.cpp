#include "hersey/report/latest_film.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "base64.h"
#include "small_run.h"

namespace hersey::report {
namespace latest_film_test {

TEST_CASE("LatestFilm_IsTheLastStoredInstant") {
  const TemporaryDirectory directory;
  const SmallRun run;
  run.write(directory.path() / "run.h5");
  const results::Reader reader(directory.path() / "run.h5");
  const nlohmann::json film = nlohmann::json::parse(latest_film_json(reader, "big_end"));
  const results::Array times = reader.read("/bearings/big_end/fields/time");
  CHECK(film["t"] == times.values.back());
  const nlohmann::json& datasets = film["datasets"];
  const std::string group = "/bearings/big_end/fields/";
  for (const char* nodes : {"phi", "z"})
    CHECK(datasets[group + nodes]["data"] == base64_float32(reader.read(group + nodes).values));
  CHECK(datasets[group + "pressure"]["shape"] == nlohmann::json{1, 4, 3});
  CHECK(datasets[group + "pressure"]["data"] == base64_float32(std::vector<double>(12, run.p_max(run.rows - 1))));
  CHECK(datasets[group + "time"]["data"] == base64_float64(std::vector<double>{times.values.back()}));
}

TEST_CASE("LatestFilm_OfNoFields_IsEmpty") {
  const TemporaryDirectory directory;
  SmallRun run;
  run.rows = 0;
  run.write(directory.path() / "run.h5");
  const results::Reader reader(directory.path() / "run.h5");
  for (const char* bearing : {"big_end", "another"}) {
    const nlohmann::json film = nlohmann::json::parse(latest_film_json(reader, bearing));
    CHECK(film["t"].is_null());
    CHECK(film["datasets"].empty());
  }
}

}  // namespace latest_film_test
}  // namespace hersey::report
