// Mechanisms of the IFToMM library of benchmark problems (University of A Coruna, lim.ii.udc.es/mbsbenchmark).
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <utility>

#include "simulate.h"
#include "test_mechanisms.h"

namespace hersey::mbd {
namespace {

constexpr double kPi = std::numbers::pi;

/// Rows of numbers of a CSV file with `#` comments and one header line.
std::vector<std::vector<double>> read_csv(const std::string& name) {
  std::ifstream file(std::string(HERSEY_SOURCE_DIR) + "/verification/data/" + name);
  REQUIRE(file.good());
  std::vector<std::vector<double>> rows;
  bool header = true;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (std::exchange(header, false)) continue;
    std::vector<double>& row = rows.emplace_back();
    std::stringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
  }
  return rows;
}

/// A02: N four-bar loops of uniform rods of 1 m and 1 kg, cranks upright, the first coupler point at 1 m/s. Cylindrical
/// and spherical coupler joints close each loop in space without redundancy.
std::unique_ptr<Mechanism> four_bars(int N) {
  MechanismBuilder b;
  b.set_gravity({0, -9.81, 0});
  const auto rod = [&](const std::string& name) {
    return b.add_body(
        {.name = name, .mass = 1, .com = {0.5, 0, 0}, .inertia = Vector3(0, 1.0 / 12, 1.0 / 12).asDiagonal()});
  };
  std::vector<FrameId> tops;
  for (int i = 0; i <= N; ++i) {
    const BodyId crank = rod("crank" + std::to_string(i));
    const FrameId foot =
        b.add_frame({.name = "foot", .body = b.ground(), .X_BF = {Matrix3::Identity(), {double(i), 0, 0}}});
    b.add_joint({.name = "foot" + std::to_string(i),
                 .type = JointType::revolute,
                 .inboard = foot,
                 .outboard = b.frame_of(crank),
                 .initial = {0.5 * kPi},
                 .initial_rate = {-1}});
    tops.push_back(b.add_frame({.name = "top", .body = crank, .X_BF = {Matrix3::Identity(), {1, 0, 0}}}));
  }
  for (int i = 0; i < N; ++i) {
    const BodyId coupler = rod("coupler" + std::to_string(i));
    b.add_joint({.name = "left" + std::to_string(i),
                 .type = JointType::cylindrical,
                 .inboard = tops[i],
                 .outboard = b.frame_of(coupler),
                 .initial = {0, -0.5 * kPi},
                 .initial_rate = {0, 1}});
    b.add_joint({.name = "right" + std::to_string(i),
                 .type = JointType::spherical,
                 .inboard = b.add_frame({.name = "end", .body = coupler, .X_BF = {Matrix3::Identity(), {1, 0, 0}}}),
                 .outboard = tops[i + 1]});
  }
  return b.finalise();
}

TEST_CASE("FourBars_PassTheirSingularPositionOnTheRightBranch") {
  const auto m = four_bars(2);
  solver::State state = test::start(*m);
  const auto reference = read_csv("four_bar_n2.csv");
  double worst = 0;
  std::size_t next = 1;
  // First coupler point B0: the tip of crank 0.
  test::run(*m, state, 10, 10000, 0.9, [&](const solver::State& s) {
    if (next >= reference.size() || s.t < reference[next][0] - 1e-9) return;
    const FrameMotion crank = m->frame_motion(s, m->spec().body_frames[1]);
    const Vector3 B0 = crank.X_WF * Vector3(1, 0, 0);
    worst = std::max(worst, std::hypot(B0.x() - reference[next][1], B0.y() - reference[next][2]));
    ++next;
  });
  CHECK(next == reference.size());
  MESSAGE("largest error of B0 ", worst);
  CHECK(worst < 1e-3);  // the benchmark's own measure
}

}  // namespace
}  // namespace hersey::mbd
