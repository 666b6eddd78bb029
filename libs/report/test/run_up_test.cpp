#include "run_up.h"

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "hersey/results/writer.h"
#include "summary.h"
#include "temporary_directory.h"

namespace hersey::report {
namespace run_up_test {

constexpr double kTurn = 2 * std::numbers::pi;

/// A run of 4 s whose shaft goes evenly from one speed to another [1/s]; its journal circles once a revolution, by 3 um
/// at 20 revolutions a second and less elsewhere, a quarter of a revolution behind.
struct ShaftRun {
  double first, last;
  bool has_joint = true;
  int rows = 8000;

  void write(const std::filesystem::path& path) const {
    results::Writer writer(path, {.overwrite = true});
    writer.attribute("/bearings/main", "radial_clearance", 34e-6);
    const results::Series time = writer.series("/time", 1, "s", "time");
    const results::Series orbit = writer.series("/bearings/main/eccentricity", 2, "m", "position");
    const results::Series spin = writer.series("/bodies/rotor/angular_velocity", 3, "rad/s", "angular velocity");
    const results::Series place = writer.series("/bodies/rotor/position", 3, "m", "position");
    // A station that moves like the journal, and the housing, which moves by half as much.
    const results::Series station = writer.series("/bodies/rotor.left/position", 3, "m", "position");
    const results::Series housing = writer.series("/bodies/housing/position", 3, "m", "position");
    std::optional<results::Series> joint;
    if (has_joint) {
      joint = writer.series("/joints/turning/coordinates", 3, "SI", "coordinates");
      writer.attribute("/joints/turning", "coordinate_names", std::vector<std::string>{"x", "y", "rotation"});
    }
    for (int k = 0; k <= rows; ++k) {
      const double t = 4.0 * k / rows, rate = (last - first) / 4;
      const double theta = kTurn * (first * t + rate * t * t / 2), speed = first + rate * t;
      const double size = 3e-6 / (1 + std::pow((speed - 20) / 5, 2));
      time.append(t);
      orbit.append({5e-6 + size * std::sin(theta), -size * std::cos(theta)});
      spin.append({0, 0, kTurn * speed});
      place.append({0, 0, 0.1});
      station.append({size * std::sin(theta), -size * std::cos(theta), 0.1});
      housing.append({size / 2 * std::sin(theta), 0, 1e-9 * std::sin(theta)});
      if (joint) joint->append({0, 0, theta});
    }
    writer.finish(results::Status::completed);
  }
};

struct Written {
  TemporaryDirectory directory;
  results::Reader reader;

  explicit Written(const ShaftRun& run)
      : reader([&] {
          run.write(directory / "run.h5");
          return directory / "run.h5";
        }()) {}
};

TEST_CASE("RunUp_IsFoundWithTheOrbitOfItsJournal") {
  for (const bool has_joint : {true, false}) {
    CAPTURE(has_joint);
    const Written run({.first = 10, .last = 40, .has_joint = has_joint});
    const std::optional<RunUp> found = find_run_up(run.reader);
    REQUIRE(found);
    CHECK(found->shafts.front().name == (has_joint ? "turning" : "rotor"));
    REQUIRE(found->displacements.size() == 3);  // the rotor does not move, its station as the journal
    CHECK(found->displacements[2].path == "/bodies/housing/position");
    CHECK(found->displacements[2].column == 0);
    CHECK(found->displacements[1].path == "/bearings/main/eccentricity");
    CHECK(found->displacements[1].column == 1);
    const OrderTracks& x = found->displacements[0].tracks;
    for (std::size_t k = 0; k < x.time.size(); ++k) {
      const double expected = 3e-6 / (1 + std::pow((x.speed[k] / kTurn - 20) / 5, 2));
      // A window of eight revolutions at 20 1/s covers 3 1/s of the peak, whose curvature takes 2 % off.
      CHECK(std::abs(std::abs(x.at(k, 1)) - expected) < 0.025 * 3e-6);
      CHECK(std::abs(-std::arg(x.at(k, 1)) - kTurn / 4) < 0.02);  // the peak's slope in a window
    }
  }
}

/// Two shafts, of which the second rotates by `ratio` of the first and the other way round, about an axis that lies
/// obliquely in space. Its journal and its disc circle once in its own revolution, by 2 um.
results::Reader two_shafts(const std::filesystem::path& path, double ratio, bool has_joint) {
  {
    results::Writer writer(path, {.overwrite = true});
    const results::Series time = writer.series("/time", 1, "s", "time");
    const results::Series orbit = writer.series("/bearings/second/eccentricity", 2, "m", "position");
    const results::Series slip = writer.series("/bearings/second/speed", 1, "rad/s", "speed");
    const results::Series first_spin = writer.series("/bodies/first/angular_velocity", 3, "rad/s", "angular velocity");
    const results::Series first = writer.series("/bodies/first/position", 3, "m", "position");
    const results::Series spin = writer.series("/bodies/second/angular_velocity", 3, "rad/s", "angular velocity");
    const results::Series second = writer.series("/bodies/second/position", 3, "m", "position");
    const results::Series joint = writer.series("/joints/fast/coordinates", 1, "rad", "coordinates");
    writer.attribute("/joints/fast", "coordinate_names", std::vector<std::string>{"rotation"});
    std::optional<results::Series> slow;
    if (has_joint) {
      slow = writer.series("/joints/slow/coordinates", 1, "rad", "coordinates");
      writer.attribute("/joints/slow", "coordinate_names", std::vector<std::string>{"rotation"});
    }
    for (int k = 0; k <= 8000; ++k) {
      const double t = 4.0 * k / 8000, speed = kTurn * (10 + 7.5 * t), theta = kTurn * (10 * t + 3.75 * t * t);
      const double own = -ratio * theta;
      time.append(t);
      orbit.append({2e-6 * std::cos(own), 2e-6 * std::sin(own)});
      slip.append(-ratio * speed);
      first_spin.append({0, 0, speed});
      first.append({3e-6 * std::cos(theta), 3e-6 * std::sin(theta), 0});
      spin.append({-ratio * speed * 0.6, 0, -ratio * speed * 0.8});
      second.append({1 + 2e-6 * std::sin(own), 1e-6 * std::cos(own), 0});
      joint.append({theta});
      if (slow) slow->append({own});
    }
    writer.finish(results::Status::completed);
  }
  return results::Reader(path);
}

TEST_CASE("SecondShaft_HasTheOrdersOfItsOwnRevolutions") {
  const TemporaryDirectory directory;
  for (const bool has_joint : {true, false}) {
    CAPTURE(has_joint);
    const results::Reader reader = two_shafts(directory / "run.h5", 0.37, has_joint);
    const std::optional<RunUp> found = find_run_up(reader);
    REQUIRE(found);
    REQUIRE(found->shafts.size() == 2);
    CHECK(found->shafts[0].name == "fast");
    CHECK(found->shafts[1].name == (has_joint ? "slow" : "second"));
    REQUIRE(found->displacements.size() == 5);  // the disc's y is by half as large as its x; the journal's x is its -y
    for (const RunUpSignal& signal : found->displacements) {
      CAPTURE(signal.path);
      CAPTURE(signal.column);
      const bool is_first = signal.path == "/bodies/first/position";
      CHECK(signal.shaft == (is_first ? 0 : 1));
      const RunUpSignal::Peak peak = signal.peak();
      const bool is_small = signal.path == "/bodies/second/position" && signal.column == 1;
      // A sine of the order is fitted exactly but for its speed's change within the rows, and the round-off of results.
      CHECK(peak.size == doctest::Approx(is_first ? 3e-6 : is_small ? 1e-6 : 2e-6).epsilon(1e-3));
    }
    const nlohmann::json data = run_up_data(reader);
    CHECK(data["shaft"] == "fast");
    CHECK(data["displacements"][0]["shaft"] == found->shafts[1].name);
  }
}

// What is as fast as the shaft of the run, or does not rotate, keeps that.
TEST_CASE("ShaftsOfOneSpeed_AreOne") {
  const TemporaryDirectory directory;
  for (const double ratio : {1.0, 0.0}) {
    const std::optional<RunUp> found = find_run_up(two_shafts(directory / "run.h5", ratio, true));
    REQUIRE(found);
    CHECK(found->shafts.size() == 1);
  }
}

// 100 revolutions in 4 s: one of 10, and a shaft whose teeth are one fewer.
TEST_CASE("ShaftOfFewRevolutions_HasNoOrders") {
  const TemporaryDirectory directory;
  const std::optional<RunUp> found = find_run_up(two_shafts(directory / "run.h5", 0.1, true));
  REQUIRE(found);
  CHECK(found->shafts.size() == 1);
  for (const RunUpSignal& signal : found->displacements) CHECK(signal.path == "/bodies/first/position");
  const std::optional<RunUp> near = find_run_up(two_shafts(directory / "run.h5", 0.992, true));
  REQUIRE(near);
  CHECK(near->shafts.size() == 2);
}

TEST_CASE("ConstantSpeed_OrFewRevolutions_AreNoRunUp") {
  CHECK(!find_run_up(Written({.first = 20, .last = 20}).reader));
  CHECK(!find_run_up(Written({.first = 20, .last = 23}).reader));
  CHECK(find_run_up(Written({.first = 20, .last = 25}).reader));
  CHECK(!find_run_up(Written({.first = 1, .last = 8}).reader));
  CHECK(run_up_data(Written({.first = 20, .last = 20}).reader).is_null());
}

TEST_CASE("CoastDown_HasTheOrdersOfTheRunUp") {
  const Written up({.first = 10, .last = 40}), down({.first = 40, .last = 10});
  const RunUpSignal::Peak a = find_run_up(up.reader)->displacements[0].peak();
  const RunUpSignal::Peak b = find_run_up(down.reader)->displacements[0].peak();
  // Places of windows differ: 0.15 1/s from one to the next.
  CHECK(a.size == doctest::Approx(b.size).epsilon(2e-3));
  CHECK(a.speed == doctest::Approx(kTurn * 20).epsilon(0.01));
  CHECK(b.speed == doctest::Approx(kTurn * 20).epsilon(0.01));
}

TEST_CASE("Summary_HasTheLargestFirstOrder") {
  const Written run({.first = 10, .last = 40});
  std::vector<SummaryRow> rows = summarise(run.reader, "run");
  std::erase_if(rows, [](const SummaryRow& row) { return row.group != "run-up"; });
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].name == "largest 1x amplitude, main");
  CHECK(rows[1].name == "largest 1x amplitude, housing");
  CHECK(rows[1].value == doctest::Approx(1.5).epsilon(0.025));
  CHECK(rows[0].unit == "µm");
  CHECK(rows[0].value == doctest::Approx(3).epsilon(0.025));  // as above
  // Of x and y, equally large but for round-off, either.
  const std::string& where = rows[0].where;
  CHECK(where.find(where.starts_with("along x") ? "lags by 90°" : "180°") != std::string::npos);
}

TEST_CASE("PageData_HasTracksAndSpectra") {
  const Written run({.first = 10, .last = 40});
  const nlohmann::json data = run_up_data(run.reader);
  CHECK(data["shaft"] == "turning");
  CHECK(data["revolutions"] == 8);
  REQUIRE(data["displacements"].size() == 3);
  const nlohmann::json& x = data["displacements"][0];
  CHECK(x["amplitude"]["shape"] == nlohmann::json({200, 3}));
  CHECK(x["lag"]["shape"] == nlohmann::json({200, 3}));
  CHECK(x["cascade"]["amplitude"]["shape"][0] == x["cascade"]["speed"]["shape"][0]);
  CHECK(x["cascade"]["amplitude"]["shape"][1] == x["cascade"]["frequency"]["shape"][0]);
}

}  // namespace run_up_test
}  // namespace hersey::report
