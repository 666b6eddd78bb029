// A bearing by itself whose shell or journal is a mesh that deforms.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <fstream>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "hersey/study/bearing_study.h"
#include "meshed_bearing.h"
#include "ring_file.h"
#include "temporary_directory.h"

namespace hersey::study {
namespace elastic_bearing_test {

constexpr double kSolved = 1e-8;  // the search ends at 1e-10 of the load and of the film's largest throughput

constexpr double pi = std::numbers::pi;
constexpr double c = 34e-6;

/// A shaft turning in a ring that a foot holds, its bearing's frame the mean of the bore.
const std::string machine =
    MeshedBearing{
        .title = "A shaft in a ring on a foot",
        .ring = {"ring.inp", "form: nodal\ndamping: {stiffness: 20 us}",
                 "foot: {nodes: foot, origin: 0 0 0 mm}\n"
                 "bore: {nodes: bore, connection: average, origin: 0 0 0 mm}"},
        .rigid_shaft = "{mass: 0.1 kg, inertia: {xx: 1e-4 kg.m^2, yy: 1e-4 kg.m^2, zz: 1e-4 kg.m^2}}",
        .foundation = "ring.foot",
        .shell = "ring.bore",
        .initial = "{x: 6 um, y: -24 um, rotation_rate: 3000 rpm}",
        .load = "1.5 kN",
        .film =
            "grid: {circumferential: 40, axial: 7}\n"
            "shell_surface: {faces: bore, functions: [16, 3]}\n"
            "operating_point: {journal_speed: 3000 rpm, load: 1.5 kN, load_angle: -90 deg}",
        .simulation = "{duration: 150 ms, step: 1 ms, spectral_radius: 0.6, settle: {tolerance: 1e-8, over: 10 ms}}"}
        .text();

/// The same rotationally symmetric ring: supported at its outside.
const std::vector<std::string> round = {"bodies.ring.frames.foot.nodes=outside",
                                        "bodies.ring.frames.foot.connection=average"};

struct Rig {
  TemporaryDirectory folder;
  std::string path = folder / "model.yaml";

  explicit Rig(const std::string& text = machine) {
    std::ofstream(folder / "ring.inp") << RingFile{.outer = 36}.text();
    std::ofstream(folder / "shaft.inp") << RingFile{.inner = 12, .outer = 22.466}.text();
    std::ofstream(folder / "model.yaml") << text;
  }

  [[nodiscard]] BearingSolution solved(const std::vector<std::string>& overrides, bool grid_error = false) const {
    auto solutions = solve_bearings(path, {{overrides, "", "", {}}}, {.bearing = "", .grid_error = grid_error});
    INFO(solutions.at(0).message);
    REQUIRE(solutions.at(0).solved());
    return std::move(solutions.front());
  }
};

std::string point(const std::string& key, double value, const std::string& unit) {
  return "bearings.main.operating_point." + key + "=" + std::to_string(value) + unit;
}

std::vector<std::string> with(std::vector<std::string> list, const std::vector<std::string>& more) {
  list.insert(list.end(), more.begin(), more.end());
  return list;
}

/// Overrides that put the journal at `e`.
std::vector<std::string> at_position(const Eigen::Vector2d& e) {
  const std::string path = "bearings.main.operating_point.";
  char ratio[64], angle[64];
  std::snprintf(ratio, sizeof ratio, "eccentricity_ratio=%.15g", e.norm() / c);
  std::snprintf(angle, sizeof angle, "eccentricity_angle=%.15g rad", std::atan2(e.y(), e.x()));
  return {path + "load=none", path + ratio, path + angle};
}

Eigen::Vector2d turned(double angle, const Eigen::Vector2d& v) { return Eigen::Rotation2Dd(angle) * v; }

/// Last values of a settled run.
struct Settled {
  Eigen::Vector2d e;
  double h_min, p_max, torque;
};

Settled settled_run(const Rig& rig, const std::vector<std::string>& overrides) {
  const std::filesystem::path results = rig.folder / "r.h5";
  const run::Summary summary = run::simulate(model::read(rig.path, overrides), {.results = results});
  INFO(summary.message);
  REQUIRE(summary.status == run::Status::completed);
  REQUIRE(summary.message.starts_with("settled"));
  const results::Reader reader(results);
  const std::vector<double> e = reader.read("/bearings/main/eccentricity").values;
  const auto last = [&](const char* name) { return reader.read(std::string("/bearings/main/") + name).values.back(); };
  return {{e[e.size() - 2], e[e.size() - 1]}, last("h_min"), last("p_max"), last("torque_journal")};
}

void check_equal(const BearingSolution& alone, const Settled& settled, double tolerance) {
  const bearing::SteadyState& state = alone.state;
  CHECK((state.e - settled.e).norm() < tolerance * settled.e.norm());
  CHECK(state.film.h_min == doctest::Approx(settled.h_min).epsilon(tolerance));
  CHECK(state.film.p_max == doctest::Approx(settled.p_max).epsilon(tolerance));
  CHECK(state.film.torque_journal == doctest::Approx(settled.torque).epsilon(tolerance));
}

TEST_CASE("ElasticBearing_OfNodes_IsTheSettledRun") {
  const Rig rig;
  const BearingSolution alone = rig.solved({});
  check_equal(alone, settled_run(rig, {}), 1e-5);
  // The ring takes part: rigid, it gives another answer.
  const BearingSolution rigid = rig.solved({"bearings.main.shell_surface=rigid"});
  CHECK((alone.state.e - rigid.state.e).norm() > 0.05 * alone.state.e.norm());
}

TEST_CASE("ElasticBearing_OfModes_IsTheSettledRun") {
  const Rig rig;
  const std::vector<std::string> modal = {"bodies.ring.flexible.form=modal", "bodies.ring.flexible.modes=20"};
  const BearingSolution alone = rig.solved(modal);
  check_equal(alone, settled_run(rig, modal), 1e-5);
  // That many modes answer nearly as all nodes do.
  CHECK((alone.state.e - rig.solved({}).state.e).norm() < 1e-3 * c);  // twenty modes and film modes against every node
}

/// The frame that carries the body's axes is the bearing's: reactions act where the body has moved to.
TEST_CASE("ElasticBearing_WhoseFrameCarriesTheBody_IsTheSettledRun") {
  std::string text = machine;
  const std::string foot = "      foot: {nodes: foot, origin: 0 0 0 mm}\n";
  const std::string bore = "      bore: {nodes: bore, connection: average, origin: 0 0 0 mm}\n";
  text.replace(text.find(foot + bore), foot.size() + bore.size(), bore + foot);
  const Rig rig(text);
  check_equal(rig.solved({}), settled_run(rig, {}), 2e-5);
}

TEST_CASE("ElasticBearing_ItsIntegralsBalance") {
  const BearingSolution solution = Rig().solved({"bearings.main.shear_force=torque_only"});
  const film::FilmModel& film = solution.model;
  const film::FilmFields fields = bearing::steady_fields(film, solution.state);
  // Pressure on the deformed bore: along its normal, e_r - d_phi/R e_phi, from the fields alone.
  const int n = film.grid.n_phi, m = film.grid.n_z;
  Eigen::Vector2d force = Eigen::Vector2d::Zero();
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      const double phi = film.grid.phi(i), simpson = j == 0 || j == m - 1 ? 1.0 / 3 : j % 2 == 1 ? 4.0 / 3 : 2.0 / 3;
      const double weight = simpson * film.L / (m - 1);
      const auto d = [&](int k) { return fields.d_shell[film.grid.index((k + n) % n, j)]; };
      const double slope = (d(i + 1) - d(i - 1)) / (4 * pi / n) / film.R;
      const Eigen::Vector2d e_r(std::cos(phi), std::sin(phi)), e_phi(-e_r.y(), e_r.x());
      force += fields.p[film.grid.index(i, j)] * weight * film.R * 2 * pi / n * (e_r - slope * e_phi);
    }
  }
  CHECK((force - solution.state.load).norm() < 2e-3 * 1500);
  CHECK(solution.state.load.norm() == doctest::Approx(1500).epsilon(kSolved));
  CHECK(solution.state.film.mass_balance_error < kSolved);
  // What the torques put in is what the film's integrals over the deformed gap take.
  const double put_in = -solution.state.film.torque_journal * solution.state.point.journal_speed;
  CHECK(put_in == doctest::Approx(solution.state.film.power_taken()).epsilon(2e-3));
  CHECK(fields.d_shell.size() == n * m);
  CHECK(fields.d_shell.cwiseAbs().maxCoeff() > 1e-6);
}

void check_stiffness(const Rig& rig, const std::vector<std::string>& overrides, const Eigen::Vector2d& e) {
  const BearingSolution middle = rig.solved(with(overrides, at_position(e)));
  const double step = 1e-4 * c;
  Eigen::Matrix2d differences;
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector2d d = step * Eigen::Vector2d::Unit(k);
    differences.col(k) = (rig.solved(with(overrides, at_position(e + d))).state.load -
                          rig.solved(with(overrides, at_position(e - d))).state.load) /
                         (2 * step);
  }
  const Eigen::Matrix2d K = middle.tangent.stiffness.topLeftCorner<2, 2>();
  CHECK((K - differences).norm() < 2e-4 * K.norm());
}

TEST_CASE("ElasticBearing_StiffnessMatchesDifferencesOfTheForce") {
  check_stiffness(Rig(), {}, c * Eigen::Vector2d(0.2, -0.75));
}

/// A rotationally symmetric bearing, in axes that rotate with its journal around the shell at Omega, is a steady one
/// whose oil is dragged by omega - 2 Omega: b (z x e) = -2 dF/d omega (bearing.30), the motion of the deformation
/// included.
TEST_CASE("ElasticBearing_DampingIsThatOfAFlowSeenFromTurningAxes") {
  const Rig rig;
  const Eigen::Vector2d e = c * Eigen::Vector2d(0.3, -0.4);
  // Oil everywhere: a fill fraction would be carried around by other means.
  const std::vector<std::string> full = with(
      with(round, {"bearings.main.edge_pressure=100 bar", "bearings.main.shear_force=torque_only"}), at_position(e));
  const auto force = [&](double speed) {
    return rig.solved(with(full, {point("journal_speed", speed, " rad/s")})).state.load;
  };
  const double omega = 300, step = 1;
  const Eigen::Vector2d by_speed = (force(omega + step) - force(omega - step)) / (2 * step);
  const BearingSolution middle = rig.solved(with(full, {point("journal_speed", omega, " rad/s")}));
  REQUIRE(middle.state.film.cavitated_share == 0);
  const Eigen::Matrix2d b = middle.state.coefficients.damping.topLeftCorner<2, 2>();
  const Eigen::Vector2d whirling = b * Eigen::Vector2d(-e.y(), e.x());
  CHECK((whirling + 2 * by_speed).norm() < 2e-3 * whirling.norm());
  // Without the deformation's own velocity it would be another.
  const BearingSolution rigid =
      rig.solved(with(full, {point("journal_speed", omega, " rad/s"), "bearings.main.shell_surface=rigid"}));
  CHECK((rigid.state.coefficients.damping.topLeftCorner<2, 2>() - b).norm() > 0.01 * b.norm());
}

TEST_CASE("ElasticBearing_OfAStiffBody_IsTheRigidOne") {
  const Rig rig;
  const BearingSolution stiff = rig.solved({"bodies.ring.flexible.material.youngs_modulus=2.1e9 GPa"});
  const BearingSolution rigid = rig.solved({"bearings.main.shell_surface=rigid"});
  // 1e7 times as stiff: it gives way by that much less.
  CHECK((stiff.state.e - rigid.state.e).norm() < 1e-6 * c);
  CHECK(stiff.state.film.p_max == doctest::Approx(rigid.state.film.p_max).epsilon(1e-6));
  CHECK((stiff.state.coefficients.stiffness - rigid.state.coefficients.stiffness).norm() <
        1e-5 * rigid.state.coefficients.stiffness.norm());
  CHECK((stiff.state.coefficients.damping - rigid.state.coefficients.damping).norm() <
        1e-5 * rigid.state.coefficients.damping.norm());
}

TEST_CASE("ElasticBearing_TurnedOrMirrored_IsTheSame") {
  const Rig rig;
  const BearingSolution down = rig.solved(round);
  const BearingSolution right = rig.solved(with(round, {point("load_angle", 0, " deg")}));
  const BearingSolution mirrored = rig.solved(with(round, {point("journal_speed", -3000, " rpm")}));
  const auto same = [&](const BearingSolution& other, const Eigen::Vector2d& e) {
    // Mesh, functions and grid are alike in all quarters: what the searches leave, a hundredfold and more.
    CHECK((other.state.e - e).norm() < 1e-5 * c);
    CHECK(other.state.film.h_min == doctest::Approx(down.state.film.h_min).epsilon(1e-5));
    CHECK(other.state.film.p_max == doctest::Approx(down.state.film.p_max).epsilon(1e-5));
    // The same, of derivatives.
    CHECK(other.coefficients.K(0, 1) == doctest::Approx(down.coefficients.K(0, 1)).epsilon(1e-4));
    CHECK(other.coefficients.C(0, 0) == doctest::Approx(down.coefficients.C(0, 0)).epsilon(1e-4));
  };
  same(right, turned(0.5 * pi, down.state.e));
  same(mirrored, {-down.state.e.x(), down.state.e.y()});
}

TEST_CASE("ElasticBearing_LoadOfAPosition_LeadsBackToIt") {
  const Rig rig;
  const BearingSolution by_load = rig.solved({}, true);
  const BearingSolution by_position = rig.solved(at_position(by_load.state.e));
  // Both searches end at 1e-10 of film and load.
  CHECK((by_position.state.load - by_load.state.load).norm() < 1e-6 * 1500);
  CHECK(by_load.grid_error.known);
}

/// A shaft of a mesh.
const std::string hollow = R"(bodies.shaft={flexible: {mesh: shaft.inp, length_unit: 1 mm, form: nodal,
 damping: {stiffness: 20 us}, material: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}},
 frames: {pin: {nodes: bore, connection: average, origin: 0 0 0 mm}}})";

/// A journal of a mesh instead of the shell, of which everything else holds.
const std::vector<std::string> hollow_shaft = {"bearings.main.shell_surface=rigid",
                                               "bearings.main.journal_surface={within: 0.1 mm, functions: [16, 3]}",
                                               hollow,
                                               "bearings.main.journal=shaft.pin",
                                               "joints.slide.between=[ground, shaft.pin]",
                                               "forces.push.body=shaft.pin"};

TEST_CASE("ElasticJournal_IsSupportedAtItsJoint_AndDeforms") {
  const Rig rig;
  const BearingSolution solution = rig.solved(hollow_shaft);
  REQUIRE(solution.elasticity->journal);
  CHECK(solution.elasticity->journal->supported_at == std::vector<std::string>{"pin"});
  CHECK(solution.state.d_journal.minCoeff() < -1e-7);  // it gives way by more than round-off
  check_stiffness(rig, hollow_shaft, c * Eigen::Vector2d(0.2, -0.75));
  const BearingSolution stiff =
      rig.solved(with(hollow_shaft, {"bodies.shaft.flexible.material.youngs_modulus=2.1e9 GPa"}));
  const BearingSolution rigid = rig.solved({"bearings.main.shell_surface=rigid"});
  CHECK((stiff.state.e - rigid.state.e).norm() < 1e-6 * c);  // 1e7 times as stiff: it gives way by that much less
}

/// In a run the mesh rotates through its deformation, whose functions and elements leave a ripple: the mean of a
/// revolution.
TEST_CASE("ElasticJournal_IsTheMeanOfARevolutionInARun") {
  const Rig rig;
  const std::vector<std::string> soft =
      with(hollow_shaft, {"bodies.shaft.flexible.form=modal", "bodies.shaft.flexible.material.youngs_modulus=60 GPa",
                          "bodies.shaft.flexible.damping.stiffness=0.2 us",
                          "simulation={duration: 40 ms, step: 0.5 ms, spectral_radius: 0.6}"});
  const BearingSolution alone = rig.solved(soft);
  const std::filesystem::path results = rig.folder / "r.h5";
  const run::Summary summary = run::simulate(model::read(rig.path, soft), {.results = results});
  INFO(summary.message);
  REQUIRE(summary.status == run::Status::completed);
  const results::Reader reader(results);
  const auto mean = [&](const char* name) {
    const std::vector<double> values = reader.read(std::string("/bearings/main/") + name).values;
    constexpr int revolution = 40;  // steps
    return std::accumulate(values.end() - revolution, values.end(), 0.0) / revolution;
  };
  // Ripple of functions and elements in the mean of a revolution.
  CHECK(alone.numbers.eccentricity_ratio == doctest::Approx(mean("eccentricity_ratio")).epsilon(1e-3));
  CHECK(alone.state.film.torque_journal == doctest::Approx(mean("torque_journal")).epsilon(1e-3));
  const BearingSolution rigid = rig.solved({"bearings.main.shell_surface=rigid"});
  CHECK(std::abs(rigid.numbers.eccentricity_ratio - alone.numbers.eccentricity_ratio) > 0.02);
}

TEST_CASE("ElasticBearing_IsSupportedAtJoints_ThenAtOtherForces_ThenByItself") {
  using Names = std::vector<std::string>;
  const auto supported_at = [](const Rig& rig) { return rig.solved({}).elasticity->shell->supported_at; };
  CHECK(supported_at(Rig()) == Names{"foot"});
  const std::string clamp = "  clamp: {type: fixed, between: [ground, ring.foot]}\n";
  std::string loose = machine;
  loose.replace(loose.find(clamp), clamp.size(), "");
  CHECK(supported_at(Rig(loose)) == Names{"bore"});
  const std::string push = "  push: {type: force, body: shaft, components: [0 N, -1.5 kN, 0 N]}\n";
  std::string on_bushing = loose, on_itself = loose;
  const std::string rest = "between: [ground, ring.FRAME], stiffness: 1e9 1e9 1e9 N/m}\n";
  const auto bushing = [&](const std::string& frame) {
    std::string text = "  rest: {type: bushing, " + rest;
    return push + text.replace(text.find("FRAME"), 5, frame);
  };
  on_bushing.replace(on_bushing.find(push), push.size(), bushing("foot"));
  CHECK(supported_at(Rig(on_bushing)) == Names{"foot"});
  on_itself.replace(on_itself.find(push), push.size(), bushing("bore"));
  CHECK(supported_at(Rig(on_itself)) == Names{"bore"});
}

TEST_CASE("ElasticBearing_WhatItCannotAnswer_IsRefusedAtItsLine") {
  const Rig rig;
  const auto fault = [&](const std::vector<std::string>& overrides) {
    try {
      (void)solve_bearings(rig.path, {{overrides, "", "", {}}}, {});
    } catch (const InputError& error) {
      return error.faults().front();
    }
    FAIL("no fault");
    return Fault{};
  };
  const Fault turning = fault({point("shell_speed", 100, " rpm")});
  CHECK(turning.position.line > 0);
  CHECK(turning.found == "a shell that rotates and deforms");
  CHECK(turning.suggestion.find("bearings.main.shell_surface=rigid") != std::string::npos);
  const Fault squeezed = fault(with(at_position({0, -0.5 * c}), {point("radial_velocity", 1, " mm/s")}));
  CHECK(squeezed.found == "a velocity of the journal between surfaces that deform");
}

/// From hardly deformed to pushed in by more than the clearance.
TEST_CASE("SoftRing_LoadsOfEverySize_AreFoundAndBorne") {
  const Rig rig;
  double last = 0;
  for (const double load : {20.0, 50.0, 100.0, 200.0, 500.0, 1000.0}) {
    CAPTURE(load);
    const BearingSolution solution =
        rig.solved({"bodies.ring.flexible.material.youngs_modulus=10 GPa", point("load", load, " N")});
    CHECK(solution.state.load.norm() == doctest::Approx(load).epsilon(kSolved));
    CHECK(solution.state.film.h_min > 1e-6);
    const double deformed = solution.state.d_shell.cwiseAbs().maxCoeff();
    CHECK(deformed > last);
    last = deformed;
  }
  CHECK(last > c);
}

TEST_CASE("Sweep_OfElasticBearings_ReducesEachMeshOnce") {
  const Rig rig;
  std::vector<model::StudyRun> runs;
  for (const double load : {300.0, 600.0, 900.0}) runs.push_back({{point("load", load, " N")}, "", "", {}});
  runs.push_back({{"bodies.ring.flexible.material.youngs_modulus=100 GPa"}, "", "", {}});
  const std::vector<BearingSolution> solutions = solve_bearings(rig.path, runs, {.bearing = "", .grid_error = false});
  for (const BearingSolution& solution : solutions) REQUIRE(solution.solved());
  CHECK(solutions[0].elasticity == solutions[2].elasticity);
  CHECK(solutions[0].elasticity != solutions[3].elasticity);
  CHECK(solutions[0].state.d_shell.norm() < solutions[2].state.d_shell.norm());
}

}  // namespace elastic_bearing_test
}  // namespace hersey::study
