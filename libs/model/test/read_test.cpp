#include "hersey/model/read.h"

#include <fstream>
#include <limits>
#include <map>
#include <numbers>

#include "model_text.h"
#include "temporary_directory.h"

namespace hersey::model {
namespace read_test {

constexpr double pi = std::numbers::pi;
constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double rounding = 16 * eps;  // unit factors are decimal fractions: a few roundings each

doctest::Approx near(double value) { return doctest::Approx(value).epsilon(rounding); }

TEST_CASE("GoodModel_IsReadInSI") {
  const Model model = read_text(good_model, "m.yaml");
  CHECK(model.title == "Test");
  REQUIRE(model.parameters.size() == 2);
  CHECK(model.parameters[0].name == "load");
  CHECK(model.parameters[0].text == "500 N");
  REQUIRE(model.bodies.size() == 2);
  const Body& shaft = model.bodies[0];
  CHECK(shaft.name == "shaft");
  CHECK(shaft.mass == 1);
  CHECK(shaft.inertia == Matrix3(Vector3(1e-3, 1e-3, 1e-3).asDiagonal()));
  REQUIRE(shaft.frames.size() == 1);
  CHECK(shaft.frames[0].X_BF.r == Vector3(0, 0.05, 0));
  // The rotation is 90 degrees about z, independent of the axis' length 2: x is mapped to y.
  CHECK((shaft.frames[0].X_BF.R * Vector3::UnitX() - Vector3::UnitY()).norm() < 4 * eps);
  REQUIRE(model.joints.size() == 2);
  CHECK(model.joints[0].type == JointType::revolute);
  CHECK(model.joints[0].inboard.body == "ground");
  CHECK(model.joints[0].outboard.body == "shaft");
  CHECK(model.joints[0].axis == Vector3::UnitZ());
  REQUIRE(model.drives.size() == 1);
  CHECK(model.drives[0].prescribes == Drive::Prescribes::speed);
  CHECK(model.drives[0].motion.value->value({}) == near(100 * pi));
  REQUIRE(model.forces.size() == 1);
  REQUIRE(model.forces[0].as<BodyLoad>()->functions.size() == 3);
  CHECK(model.forces[0].as<BodyLoad>()->functions[1].value->value({}) == -500);
  REQUIRE(model.bearings.size() == 1);
  const Bearing& bearing = model.bearings[0];
  CHECK(bearing.journal.body == "shaft");
  CHECK(bearing.journal.frame == "pin");
  CHECK(bearing.film.R == near(0.0225));
  CHECK(bearing.film.L == near(0.0156));
  CHECK(bearing.film.c == near(34e-6));
  CHECK(bearing.film.lubricant.mu0 == near(0.015));
}

// Six different elements: each is found on both sides of the diagonal.
TEST_CASE("Inertia_HasEachElementAtItsName") {
  const std::string given =
      "{xx: 5 kg.m^2, yy: 6 kg.m^2, zz: 7 kg.m^2, xy: 0.1 kg.m^2, yz: 0.2 kg.m^2, zx: 0.3 kg.m^2}";
  const Matrix3 inertia =
      read_text(edited(good_model, "{xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}", given), "m.yaml")
          .bodies[0]
          .inertia;
  const std::string axes = "xyz";
  for (const auto& [name, value] :
       std::map<std::string, double>{{"xx", 5}, {"yy", 6}, {"zz", 7}, {"xy", 0.1}, {"yz", 0.2}, {"zx", 0.3}}) {
    const std::string key = name;  // clang 14 captures no structured binding
    CAPTURE(key);
    const auto row = static_cast<Eigen::Index>(axes.find(name[0])),
               column = static_cast<Eigen::Index>(axes.find(name[1]));
    CHECK(inertia(row, column) == value);
    CHECK(inertia(column, row) == value);
  }
}

TEST_CASE("Defaults_AreThoseOfTheReference") {
  const Model model = read_text(good_model, "m.yaml");
  const film::FilmModel& film = model.bearings[0].film;
  CHECK(film.grid.n_phi == 60);
  CHECK(film.grid.n_z == 13);
  CHECK(film.cavitation == film::Cavitation::mass_conserving);
  CHECK(film.supply.kind == film::SupplyKind::none);
  CHECK(film.asperities.model == film::AsperityModel::none);
  CHECK(film.compliance == 0);
  CHECK(std::holds_alternative<film::ConstantViscosity>(film.lubricant.viscosity_law));
  CHECK(std::holds_alternative<film::Incompressible>(film.lubricant.density_law));
  CHECK(film.lubricant.density == 850);
  CHECK(film.cavitated_shear == film::CavitatedShear::film_share);
  CHECK(film.shear_force == film::ShearForce::full);
  CHECK(model.bearings[0].solver == film::FilmSolver::newton);
  CHECK(model.bearings[0].coupling.scheme == CouplingScheme::monolithic);
  CHECK(model.gravity == Vector3::Zero());
  CHECK(model.simulation.spectral_radius == 0.8);
  CHECK(model.simulation.max_iterations == 50);
  CHECK(model.simulation.smallest_step == 1e-9);
  CHECK_FALSE(model.simulation.settle.has_value());
  CHECK(model.output.every == 1);
  CHECK(model.output.fields_every == near(model.simulation.duration / 100));
  CHECK_FALSE(model.study.has_value());
}

TEST_CASE("CrankAngles_BecomeTimes") {
  const std::string text = good_model + "  settle: {over: 180 deg}\noutput:\n  fields_every: 45 deg\n";
  const Model model = read_text(
      edited(text, "between: [ground, shaft]", "between: [ground, shaft], initial: {rotation: 30 deg}"), "m.yaml");
  // 3000 rpm: one revolution takes 20 ms.
  CHECK(model.simulation.duration == near(0.04));
  CHECK(model.simulation.step == near(0.02 / 360));
  REQUIRE(model.simulation.settle.has_value());
  CHECK(model.simulation.settle->over == near(0.01));
  CHECK(model.output.fields_every == near(0.0025));
  REQUIRE(model.simulation.crank.has_value());
  CHECK(model.simulation.crank->joint == "main");
  CHECK(model.simulation.crank->speed == near(100 * pi));
  CHECK(model.simulation.crank->initial_angle == near(pi / 6));
}

TEST_CASE("CyclesAndCheckpoints_AreRead") {
  CHECK(read_text(good_model, "m.yaml").simulation.checkpoint.wall_time == 300);
  CHECK(read_text(good_model, "m.yaml").simulation.checkpoint.every == 0);
  CHECK_FALSE(read_text(good_model, "m.yaml").simulation.cycle.has_value());
  const Model model = read_text(edited(good_model, "duration: 2 rev",
                                       "cycle: {period: 360 deg, until_converged: 0.02, most: 7}\n"
                                       "  checkpoint: {every: 90 deg, wall_time: 1 min}"),
                                "m.yaml");
  REQUIRE(model.simulation.cycle.has_value());
  CHECK(model.simulation.cycle->period == near(0.02));
  CHECK(model.simulation.cycle->tolerance == 0.02);
  CHECK(model.simulation.cycle->most == 7);
  CHECK(model.simulation.duration == near(0.14));
  const Model shorter =
      read_text(edited(good_model, "duration: 2 rev", "duration: 2 rev\n  cycle: {period: 1 rev}"), "m.yaml");
  CHECK(shorter.simulation.duration == near(0.04));
  CHECK(model.output.fields_every == near(0.0002));
  CHECK(model.simulation.checkpoint.every == near(0.005));
  CHECK(model.simulation.checkpoint.wall_time == 60);
}

TEST_CASE("CrankTurningBackwards_StillTakesPositiveTime") {
  const Model model = read_text(edited(good_model, "speed: 3000 rpm", "speed: -3000 rpm"), "m.yaml");
  CHECK(model.simulation.duration == near(0.04));
  CHECK(model.simulation.crank->speed == near(-100 * pi));
}

TEST_CASE("SolverIsChosenBySize_UnlessGiven") {
  const auto solver_of = [](const std::string& lines) {
    return read_text(edited(good_model, "    lubricant: oil\n", "    lubricant: oil\n" + lines), "m.yaml")
        .bearings[0]
        .solver;
  };
  const std::string fine = "    grid: {circumferential: 480, axial: 97}\n";
  CHECK(solver_of("") == film::FilmSolver::newton);
  CHECK(solver_of(fine) == film::FilmSolver::multigrid);
  CHECK(solver_of("    solver: auto\n") == film::FilmSolver::newton);
  CHECK(solver_of(fine + "    solver: auto\n") == film::FilmSolver::multigrid);
  CHECK(solver_of(fine + "    solver: newton\n") == film::FilmSolver::newton);
  CHECK(solver_of("    solver: multigrid\n") == film::FilmSolver::multigrid);
}

TEST_CASE("EverythingAboutABearing_IsRead") {
  const std::string text = edited(good_model, "    radial_clearance: 34 um\n", R"(    diametral_clearance: 68 um
    grid: {circumferential: 120, axial: 25}
    cavitation: {model: reynolds, pressure: -0.5 bar}
    edge_pressure: {left: 1 bar, right: 2 bar}
    supply: {line: 180 deg, pressure: 3 bar}
    asperities: {model: greenwood_tripp, roughness: 1 um, friction: 0.08}
    compliance: {model: column}
    materials:
      shell: {youngs_modulus: 210 GPa, poisson_ratio: 0.3}
      journal: {youngs_modulus: 210 GPa, poisson_ratio: 0.3}
    cavitated_shear: full
    shear_force: torque_only
    solver: sor
    coupling: {scheme: partitioned, acceleration: aitken, relaxation: 0.5, max_iterations: 7}
)");
  const Bearing bearing = read_text(text, "m.yaml").bearings[0];
  const film::FilmModel& film = bearing.film;
  const double E = 210e9 / (2 * 0.91);
  CHECK(film.c == near(34e-6));
  CHECK(film.grid.n_phi == 120);
  CHECK(film.grid.n_z == 25);
  CHECK(film.cavitation == film::Cavitation::reynolds);
  CHECK(film.p_cav == -0.5e5);
  CHECK(film.edge_left.pressure == 1e5);
  CHECK(film.edge_right.pressure == 2e5);
  CHECK(film.supply.kind == film::SupplyKind::fixed_angle);
  CHECK(film.supply.phi == near(pi));
  CHECK(film.supply.pressure == near(3e5));
  CHECK(film.asperities.model == film::AsperityModel::greenwood_tripp_exact);
  CHECK(film.asperities.sigma == near(1e-6));
  CHECK(film.asperities.elastic_factor == 3e-3);
  CHECK(film.asperities.composite_modulus == near(E));
  CHECK(film.asperities.mu_friction == 0.08);
  CHECK(film.compliance == near(0.0225 / E));  // the columns are as long as the radius
  CHECK(film.cavitated_shear == film::CavitatedShear::full);
  CHECK(film.shear_force == film::ShearForce::torque_only);
  CHECK(bearing.solver == film::FilmSolver::sor);
  CHECK(bearing.coupling.scheme == CouplingScheme::partitioned);
  CHECK(bearing.coupling.acceleration == solver::Acceleration::aitken);
  CHECK(bearing.coupling.relaxation == 0.5);
  CHECK(bearing.coupling.max_iterations == 7);
}

TEST_CASE("RoughnessAndSurroundings_AreRead") {
  const std::string text = edited(good_model, "    lubricant: oil\n", R"(    lubricant: oil
    pressures: absolute
    cavitation: {model: mass_conserving, pressure: 0.3 bar}
    edge_pressure: {left: 0.3 bar, right: 1 bar}
    ambient_fill: {left: 0.4, right: 1}
    roughness: {shell: {sigma: 0.6 um, gamma: 0.11}, journal: {sigma: 0.8 um}}
    asperities: {model: greenwood_tripp, composite_modulus: 57 GPa}
)");
  const Bearing bearing = read_text(text, "m.yaml").bearings[0];
  CHECK(bearing.film.pressures == film::PressureScale::absolute);
  CHECK(bearing.film.edge_left.ambient_fill == 0.4);
  CHECK(bearing.film.edge_right.ambient_fill == 1);
  const film::Roughness& roughness = bearing.film.roughness;
  CHECK(roughness.flow_factors == film::FlowFactors::patir_cheng);
  CHECK(roughness.shell.sigma == near(0.6e-6));
  CHECK(roughness.shell.gamma == 0.11);
  CHECK(roughness.journal.sigma == near(0.8e-6));
  CHECK(roughness.journal.gamma == 1);
  CHECK(bearing.film.asperities.sigma == near(1e-6));  // of both surfaces together

  const Bearing plain = read_text(good_model, "m.yaml").bearings[0];
  CHECK(plain.film.pressures == film::PressureScale::gauge);
  CHECK(plain.film.edge_left.ambient_fill == 0);
  CHECK_FALSE(plain.film.roughness.counts());
  const std::string one = edited(good_model, "    lubricant: oil\n",
                                 "    lubricant: oil\n    ambient_fill: 0.25\n    roughness: {shell: {sigma: 1 um}, "
                                 "flow_factors: none}\n");
  const Bearing other = read_text(one, "m.yaml").bearings[0];
  CHECK(other.film.edge_right.ambient_fill == 0.25);
  CHECK_FALSE(other.film.roughness.counts());
}

TEST_CASE("OneWord_StandsForAModelWithoutSettings") {
  const std::string text = edited(good_model, "    lubricant: oil\n",
                                  "    lubricant: oil\n    cavitation: guembel\n    supply: {line: widest_gap}\n"
                                  "    compliance: rigid\n    coupling: partitioned\n");
  const Bearing bearing = read_text(text, "m.yaml").bearings[0];
  CHECK(bearing.film.cavitation == film::Cavitation::guembel);
  CHECK(bearing.film.supply.kind == film::SupplyKind::widest_gap);
  CHECK(bearing.film.compliance == 0);
  CHECK(bearing.coupling.scheme == CouplingScheme::partitioned);
}

TEST_CASE("JointsOfEveryType_AreRead") {
  const std::string text = edited(good_model, "  guide: {type: planar, between: [ground, rod]}\n", R"(
  guide: {type: planar, between: [ground, rod], axis: x, initial: {x: 1 mm, rotation_rate: 60 deg/s}}
  a: {type: fixed, between: [ground, rod]}
  b: {type: prismatic, between: [ground, rod], axis: 0 3 4, initial: {translation: 2 mm, translation_rate: 1 m/s}}
  c: {type: cylindrical, between: [ground, rod]}
  d: {type: spherical, between: [ground, rod], initial: {orientation: 0 0 90 deg}}
  e: {type: free, between: [ground, rod], initial: {position: [1 mm, 0, 2 cm], velocity: 0 1 0 m/s}}
)");
  const Model model = read_text(text, "m.yaml");
  REQUIRE(model.joints.size() == 7);
  CHECK(model.joints[1].axis == Vector3::UnitX());
  REQUIRE(model.joints[1].initial.size() == 2);
  CHECK(model.joints[1].initial[0].coordinate == "x");
  CHECK(model.joints[1].initial[0].value == std::vector<double>{1e-3});
  CHECK(model.joints[2].type == JointType::fixed);
  CHECK(model.joints[3].type == JointType::prismatic);
  CHECK((model.joints[3].axis - Vector3(0, 0.6, 0.8)).norm() < 4 * eps);
  CHECK(model.joints[4].type == JointType::cylindrical);
  CHECK(model.joints[5].type == JointType::spherical);
  CHECK(model.joints[5].initial[0].value[2] == near(pi / 2));
  CHECK(model.joints[6].type == JointType::free);
  CHECK(model.joints[6].initial[0].value == std::vector<double>{1e-3, 0, 0.02});
}

TEST_CASE("ForcesOfEveryType_AreRead") {
  const std::string text =
      edited(good_model,
             "lubricants:", R"(  twist: {type: torque, body: shaft.pin, direction: 0 0 3, magnitude: 2 N.m, axes: body}
  spring: {type: spring_damper, between: [ground, rod], stiffness: 10 N/mm, damping: 3 N.s/m, free_length: 5 cm}
  torsion: {type: torsion_spring, joint: guide, stiffness: 20 N.m, free_angle: 180 deg}
lubricants:)");
  const Model model = read_text(text, "m.yaml");
  REQUIRE(model.forces.size() == 4);
  const auto& push = std::get<BodyLoad>(model.forces[0].data);
  CHECK_FALSE(push.is_torque);
  CHECK(push.axes == Axes::ground);
  const auto& twist = std::get<BodyLoad>(model.forces[1].data);
  CHECK(twist.is_torque);
  CHECK(twist.at.frame == "pin");
  CHECK(twist.axes == Axes::body);
  CHECK(twist.direction == Vector3::UnitZ());
  REQUIRE(twist.functions.size() == 1);
  CHECK(twist.functions[0].value->value({}) == 2);
  const auto& spring = std::get<SpringDamper>(model.forces[2].data);
  CHECK(spring.to.body == "rod");
  CHECK(spring.stiffness == near(1e4));
  CHECK(spring.free_length == near(0.05));
  const auto& torsion = std::get<CoordinateSpring>(model.forces[3].data);
  CHECK(torsion.on.joint == "guide");
  CHECK(torsion.on.coordinate == "rotation");
  CHECK(torsion.stiffness == near(20));
  CHECK(torsion.free_position == near(pi));
}

TEST_CASE("Positions_PointAtTheKeys") {
  const Model model = read_text(good_model, "m.yaml");
  CHECK(model.bodies[1].position.line == 12);
  CHECK(model.joints[0].position.line == 14);
  CHECK(model.bearings[0].position.line == 23);
  const SourcePosition clearance = model.position_of("bearings.big_end.radial_clearance");
  CHECK(clearance.file == "m.yaml");
  CHECK(clearance.line == 28);
  CHECK(clearance.column == 5);
  // Not in the file: the nearest parent that is.
  CHECK(model.position_of("bearings.big_end.grid.axial").line == 23);
  CHECK(model.position_of("output.every").line == 0);
}

TEST_CASE("AnchorsAndAliases_AreUnderstood") {
  const std::string text = edited(edited(good_model, "rod: {mass: 2 kg}", "rod: {mass: &m 2 kg}\n  third: {mass: *m}"),
                                  "  oil:", "  thin: &o {viscosity: 5 mPa.s}\n  copy: *o\n  oil:");
  const Model model = read_text(text, "m.yaml");
  CHECK(model.bodies[2].mass == 2);
  CHECK(model.lubricants[1].data.mu0 == near(0.005));
}

TEST_CASE("Lubricants_HaveTheirLaws") {
  const std::string text =
      edited(good_model, "  oil: {viscosity: 15 mPa.s}\n",
             "  oil: {viscosity: 15 mPa.s, pressure_viscosity: 2e-8 1/Pa, compressibility: dowson_higginson}\n"
             "  thick: {viscosity: 40 mPa.s, pressure_viscosity: {law: roelands, z: 0.6}}\n"
             "  same: {viscosity: 15 mPa.s, pressure_viscosity: {law: barus, alpha: 2e-8 1/Pa}}\n");
  const Model model = read_text(text, "m.yaml");
  CHECK(std::get<film::Barus>(model.bearings[0].film.lubricant.viscosity_law).alpha == near(2e-8));
  CHECK(std::get<film::DowsonHigginson>(model.bearings[0].film.lubricant.density_law).saturation == near(1.7e-9));
  CHECK(std::get<film::Roelands>(model.lubricants[1].data.viscosity_law).z == near(0.6));
  CHECK(std::get<film::Barus>(model.lubricants[2].data.viscosity_law).alpha == near(2e-8));
}

TEST_CASE("Features_AreHolesAndGrooves") {
  const std::string text = edited(good_model, "    lubricant: oil\n", R"(    lubricant: oil
    features:
      feed: {shape: hole, on: journal, angle: 30 deg, z: 1 mm, diameter: 5 mm,
             pressure: {expression: '3 + sin(main.rotation)', unit: bar}}
      groove: {shape: axial_groove, angle: 180 deg, arc: 20 deg, pressure: 2 bar}
      ring: {shape: circumferential_groove, angle: 0 deg, length: 4 mm, arc: 90 deg, pressure: 0 Pa}
      slot: {shape: oval_hole, angle: 90 deg, around: 9 mm, along: 4.5 mm, pressure: 1 bar}
      recess: {shape: pocket, angle: 270 deg, arc: 30 deg, length: 8 mm, depth: 0.3 mm}
)");
  const Model model = read_text(text, "m.yaml");
  const std::vector<film::SurfaceFeature>& features = model.bearings[0].film.features;
  REQUIRE(features.size() == 5);
  CHECK(features[0].surface == film::Surface::journal);
  CHECK(std::holds_alternative<film::Ellipse>(features[0].shape));
  CHECK(features[0].arc == near(5.0 / 22.5));
  CHECK(features[0].z == near(1e-3));
  CHECK(model.bearings[0].feature_pressures[0].variables.size() == 1);
  CHECK(features[1].length == near(0.0156));
  CHECK(features[1].pressure == near(2e5));
  CHECK(features[2].arc == near(pi / 2));
  CHECK(features[3].arc == near(0.4));
  CHECK(features[3].is_fed);
  CHECK(features[3].depth == 0);
  CHECK_FALSE(features[4].is_fed);
  CHECK(features[4].depth == near(3e-4));
}

TEST_CASE("Shape_IsAListOfProfiles") {
  const Model model = read_text(edited(good_model, "    lubricant: oil\n", R"(    lubricant: oil
    shape:
      - {profile: barrel, drop: 5 um}
      - {profile: taper, rise: -3 um}
      - {profile: ovality, on: journal, amplitude: 4 um, angle: 90 deg}
      - {profile: lobes, offset: 20 um}
)"),
                                "m.yaml");
  const std::vector<film::Profile>& profiles = model.bearings[0].film.profiles;
  REQUIRE(profiles.size() == 4);
  CHECK(std::get<film::Barrel>(profiles[0].shape).drop == near(5e-6));
  CHECK(std::get<film::Taper>(profiles[1].shape).rise == near(-3e-6));
  CHECK(std::get<film::Ovality>(profiles[2].shape).angle == near(pi / 2));
  CHECK(std::get<film::Lobes>(profiles[3].shape).count == 2);
  CHECK(profiles[2].surface == film::Surface::journal);
  CHECK(profiles[3].surface == film::Surface::shell);
}

TEST_CASE("EmptySections_AreAllowed") {
  // All forces commented out: YAML reads nothing.
  CHECK(faults_after("  push: {type: force, body: rod, components: [0 N, \"-${load}\", 0 N]}\n", "  # push\n") ==
        "no fault");
}

TEST_CASE("RefinedGrid_IsFineAtItsRefinements") {
  const Model model = read_text(edited(good_model, "    lubricant: oil\n", R"(    lubricant: oil
    features:
      groove: {shape: axial_groove, angle: 90 deg, arc: 20 deg, length: 8 mm, pressure: 2 bar}
    grid:
      circumferential: 90
      axial: 21
      refine:
        - {towards: edges, factor: 4}
        - {towards: features, reach: 1 mm}
        - {towards: angle, angle: 270 deg, factor: 5}
)"),
                                "m.yaml");
  const film::Grid& grid = model.bearings[0].film.grid;
  REQUIRE(grid.n_phi == 90);
  REQUIRE(grid.n_z == 21);
  const auto cell_at = [&](double degrees) {
    int i = 0;
    while (grid.phi(i + 1) < degrees * pi / 180) ++i;
    return (grid.phi(i + 1) - grid.phi(i)) * 180 / pi;
  };
  CHECK(cell_at(270) < 0.3 * cell_at(180));
  CHECK(cell_at(80) < 0.5 * cell_at(180));
  CHECK(cell_at(100) < 0.5 * cell_at(180));
  const auto height = [&](int j) { return grid.z_over_L(j + 1) - grid.z_over_L(j); };
  CHECK(height(0) < 0.7 * height(10));
  CHECK(height(0) == near(height(19)));
}

TEST_CASE("FileReadOnce_GivesTheModelsOfEachReading") {
  const TemporaryDirectory folder;
  const std::string path = (folder / "m.yaml").string();
  std::ofstream(path) << good_model;
  const ModelFile file(path);
  const std::string width = "bearings.big_end.width=17 mm";
  const Model before = read(path), wider = read(path, {width});
  REQUIRE(wider.bearings[0].film.L == near(17e-3));
  std::ofstream(path) << "hersey: 1\n";  // noticed by nobody who has read it
  for (int round = 0; round < 2; ++round) {
    CHECK(file.read().bearings[0].film.L == before.bearings[0].film.L);
    CHECK(file.read({width}).bearings[0].film.L == wider.bearings[0].film.L);
    CHECK(file.read({width}).resolved_text == wider.resolved_text);
    CHECK_THROWS_WITH_AS((void)file.read({"bearings.big_end.widht=17 mm"}), doctest::Contains("did you mean"),
                         InputError);
  }
  CHECK_THROWS_AS(ModelFile((folder / "none.yaml").string()), InputError);
}

TEST_CASE("Solver_IsOneOfThree") {
  const auto solver = [](const std::string& name) {
    const std::string text =
        edited(good_model, "    lubricant: oil\n", "    lubricant: oil\n    solver: " + name + "\n");
    return read_text(text, "m.yaml").bearings[0].solver;
  };
  CHECK(solver("newton") == film::FilmSolver::newton);
  CHECK(solver("multigrid") == film::FilmSolver::multigrid);
  CHECK(solver("sor") == film::FilmSolver::sor);
}

TEST_CASE("Turbulence_HasTheBandOfItsNumber") {
  const auto read = [](const std::string& turbulence) {
    const Model model = read_text(
        edited(good_model, "    lubricant: oil\n", "    lubricant: oil\n    turbulence: " + turbulence + "\n"),
        "m.yaml");
    return model.bearings[0].film.turbulence;
  };
  CHECK_FALSE(read("none").counts());
  const film::Turbulence by_reynolds = read("ng_pan");
  CHECK(by_reynolds.model == film::TurbulenceModel::ng_pan);
  CHECK(by_reynolds.onset == 900);
  CHECK(by_reynolds.full == 1600);
  const film::Turbulence by_taylor = read("{model: hirs, transition: taylor, full: 60}");
  CHECK(by_taylor.number == film::TransitionNumber::taylor);
  CHECK(by_taylor.onset == 41.2);
  CHECK(by_taylor.full == 60);
  const film::Turbulence given = read("{model: constantinescu, onset: 500, full: 1e3, prandtl: 0.8}");
  CHECK(given.onset == 500);
  CHECK(given.full == 1000);
  CHECK(given.prandtl == 0.8);
}

}  // namespace read_test
}  // namespace hersey::model
