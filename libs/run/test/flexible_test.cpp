#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "hersey/fem/mesh_file.h"
#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "small_bar.h"
#include "temporary_directory.h"
#include "vtu_field.h"

// Flexible bodies in a run: energies, power balance, deformed meshes.
namespace hersey::run {
namespace flexible_test {

TEST_CASE("FlexiblePendulum_IsRecordedAndBalanced") {
  const TemporaryDirectory folder;
  write_bar(folder / "bar.inp", 10);
  std::ofstream(folder / "model.yaml") << kPendulum;
  const model::Model model = model::read(folder / "model.yaml");
  const Summary summary = simulate(model, {.results = folder / "r.h5"});
  INFO(summary.message);
  CHECK(summary.status == Status::completed);
  // Nothing closes a loop: what is left is Newton's tolerance.
  CHECK(summary.worst_power_balance < 1e-7);
  const results::Reader reader(folder / "r.h5");
  const auto series = [&](const std::string& name) { return reader.read(name).values; };
  const auto time = series("/time"), kinetic = series("/energy/kinetic"), potential = series("/energy/potential"),
             strain = series("/energy/strain"), dissipation = series("/bodies/bar/dissipation");
  CHECK(series("/bodies/bar/amplitudes").size() == 10 * time.size());
  CHECK(strain == series("/bodies/bar/strain_energy"));
  double lost = 0, most_strain = 0;
  for (std::size_t i = 1; i < time.size(); ++i) {
    lost += 0.5 * (dissipation[i] + dissipation[i - 1]) * (time[i] - time[i - 1]);
    most_strain = std::max(most_strain, strain[i]);
  }
  CHECK(most_strain > 1e-4 * kinetic.back());
  CHECK(lost > 0);
  const double change = kinetic.back() + potential.back() + strain.back() + lost - potential.front();
  CHECK(std::abs(change) < 1e-3 * kinetic.back());  // of the trapezoidal sum, and of the step
  CHECK(std::filesystem::exists(folder / "r_bar.pvd"));
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "r_bar"))
    files += entry.path().extension() == ".vtu" ? 1 : 0;
  CHECK(files == 6);
  std::ifstream last(folder / "r_bar" / "00005.vtu", std::ios::binary);
  const std::string vtu{std::istreambuf_iterator<char>(last), {}};
  CHECK(vtu.find("von_mises") != std::string::npos);
}

// Viewers add the displacement to the points themselves: it must not be in these already.
TEST_CASE("PointsOfDeformedMeshes_HaveMovedWithoutDeforming") {
  const TemporaryDirectory folder;
  write_bar(folder / "bar.inp", 10);
  std::ofstream(folder / "model.yaml") << kPendulum;
  REQUIRE(simulate(model::read(folder / "model.yaml"), {.results = folder / "r.h5"}).status == Status::completed);
  const fem::Mesh mesh = fem::read_mesh(folder / "bar.inp", 1e-3);
  const std::filesystem::path last = folder / "r_bar" / "00005.vtu";
  const std::vector<double> points = field_of(last, "Points"), displacement = field_of(last, "displacement");
  const auto nodes = static_cast<Eigen::Index>(mesh.nodes.size());
  const Eigen::Map<const Eigen::Matrix3Xd> x(points.data(), 3, nodes), u(displacement.data(), 3, nodes);
  double most_stretched = 0;
  for (Eigen::Index n = 1; n < nodes; ++n) {
    const double length = (mesh.nodes[static_cast<std::size_t>(n)] - mesh.nodes[0]).norm();
    CHECK((x.col(n) - x.col(0)).norm() == doctest::Approx(length).epsilon(1e-12));  // doubles: round-off
    const double deformed = (x.col(n) + u.col(n) - x.col(0) - u.col(0)).norm();
    most_stretched = std::max(most_stretched, std::abs(deformed / length - 1));
  }
  CHECK(most_stretched > 1e-6);
  CHECK(u.colwise().norm().maxCoeff() > 1e-5);
  CHECK((x.col(nodes - 1) - mesh.nodes.back()).norm() > 1e-3);  // it has fallen
}

TEST_CASE("SupportedBar_SagsUnderItsWeight") {
  const TemporaryDirectory folder;
  write_bar(folder / "bar.inp", 10);
  std::string text = kPendulum;
  text.replace(text.find("type: revolute"), 14, "type: fixed").replace(text.find("duration"), 29, "analysis: static");
  text.erase(text.find("      tip:"), 26);  // fixed at one end alone: its only frame coincides with its axes
  std::ofstream(folder / "model.yaml") << text;
  const Summary summary = simulate(model::read(folder / "model.yaml"), {.results = folder / "r.h5"});
  INFO(summary.message);
  REQUIRE(summary.status == Status::completed);
  const results::Reader reader(folder / "r.h5");
  // Strain energy of a clamped bar under q = rho A g: q^2 L^5/(40 E I); four vibrations carry nearly all of it.
  const double q = 1200 * 1e-4 * 9.81, I = 1e-8 / 12;
  CHECK(reader.read("/energy/strain").values.back() ==
        doctest::Approx(q * q * std::pow(0.2, 5) / (40 * 1e9 * I)).epsilon(0.03));
}

TEST_CASE("BarUnderPressureAndForce_ShortensAndReportsTheirResultants") {
  const TemporaryDirectory folder;
  write_bar(folder / "bar.inp", 10);
  std::string text = kPendulum;
  text.replace(text.find("type: revolute"), 14, "type: fixed").replace(text.find("duration"), 29, "analysis: static");
  text.replace(text.find("gravity: 0 -9.81 0"), 18, "gravity: 0 0 0");
  text.replace(text.find("poisson_ratio: 0.3"), 18, "poisson_ratio: 0");
  text +=
      "forces:\n"
      "  press: {type: pressure, body: bar, faces: right, pressure: 2 MPa}\n"
      "  pull: {type: surface_force, body: bar, faces: right, components: [50 N, 0 N, 0 N], axes: body}\n";
  std::ofstream(folder / "model.yaml") << text;
  const Summary summary = simulate(model::read(folder / "model.yaml"), {.results = folder / "r.h5"});
  INFO(summary.message);
  REQUIRE(summary.status == Status::completed);
  const results::Reader reader(folder / "r.h5");
  const auto series = [&](const std::string& name) { return reader.read(name).values; };
  // 200 N of pressure less 50 N on 100 mm^2 of 1 GPa, 200 mm long.
  const double u = -150 * 0.2 / (1e9 * 1e-4);
  // Equilibrium to 1e-10, on a displacement that is small beside the length.
  CHECK(series("/joints/bar.tip/coordinates")[0] == doctest::Approx(u).epsilon(1e-7));
  CHECK(series("/energy/strain").back() == doctest::Approx(0.5 * 150 * -u).epsilon(1e-7));
  // Sums of nodal forces: round-off.
  CHECK(series("/surface_loads/press/force")[0] == doctest::Approx(-200).epsilon(1e-9));
  CHECK(series("/surface_loads/pull/force")[0] == doctest::Approx(50).epsilon(1e-9));
  CHECK(series("/surface_loads/press/moment")[2] == doctest::Approx(200 * 0.005).epsilon(1e-9));
  // Equilibrium to 1e-10, on a displacement that is small beside the length.
  CHECK(series("/joints/hinge/reaction_force")[0] == doctest::Approx(150).epsilon(1e-7));
}

const char* const kWind =
    "forces:\n"
    "  blow: {type: pressure, body: bar, faces: right, pressure: {expression: \"3e4*sin(200*t)\", unit: Pa}}\n"
    "  wind: {type: surface_force, body: bar, faces: right, direction: y, magnitude: {expression: \"2*t/0.05\", "
    "unit: N}}\n";

void check_pendulum_of_nodes(const std::string& strains) {
  // Without a frame at its tip the loads act on free nodes.
  const TemporaryDirectory folder;
  write_bar(folder / "bar.inp", 10);
  std::string text = kPendulum;
  text.replace(text.find("modes: 4"), 8, "modes: 4\n      form: nodal\n      strain: " + strains);
  text.replace(text.find("      tip: {nodes: right}\n"), 26, "")
      .replace(text.find("duration: 50 ms"), 15, "duration: 25 ms");
  std::ofstream(folder / "model.yaml") << text << kWind;
  const Summary summary = simulate(model::read(folder / "model.yaml"), {.results = folder / "r.h5"});
  INFO(summary.message);
  CHECK(summary.status == Status::completed);
  CHECK(summary.worst_power_balance < 1e-7);  // steps are solved to 1e-8
  CHECK(summary.newton_iterations < 4 * summary.steps);
  const results::Reader reader(folder / "r.h5");
  const auto series = [&](const std::string& name) { return reader.read(name).values; };
  const auto strain = series("/energy/strain"), wind = series("/surface_loads/wind/power");
  CHECK(strain.front() > 0);  // it hangs from the start
  CHECK(std::abs(wind.back()) > 1e-3);
  CHECK(series("/bodies/bar/amplitudes").size() == 4 * series("/time").size());
  CHECK(std::filesystem::exists(folder / "r_bar.pvd"));
}

TEST_CASE("PendulumOfNodes_IsRecordedAndBalanced") {
  check_pendulum_of_nodes("small");
  check_pendulum_of_nodes("finite");
}

TEST_CASE("BarOfFiniteStrain_IsBentIntoAnArcByAMomentAtItsTip") {
  // Curvature M/(E I) all along, to 1 rad: stresses of E kappa h/2 in axes that rotate with the strip.
  const TemporaryDirectory folder;
  write_bar(folder / "bar.inp", 10);
  std::string text = kPendulum;
  const double I = 1e-8 / 12, length = 0.2;
  text.replace(text.find("modes: 4"), 8, "modes: 4\n      form: nodal\n      strain: finite");
  text.replace(text.find("type: revolute"), 14, "type: fixed").replace(text.find("duration"), 29, "analysis: static");
  text.replace(text.find("gravity: 0 -9.81 0"), 18, "gravity: 0 0 0");
  text.replace(text.find("poisson_ratio: 0.3"), 18, "poisson_ratio: 0");
  text += fmt::format("forces:\n  turn: {{type: torque, body: bar.tip, components: [0 N.m, 0 N.m, {} N.m]}}\n",
                      1e9 * I / length);
  std::ofstream(folder / "model.yaml") << text;
  const Summary summary = simulate(model::read(folder / "model.yaml"), {.results = folder / "r.h5"});
  INFO(summary.message);
  REQUIRE(summary.status == Status::completed);
  const results::Reader reader(folder / "r.h5");
  const auto series = [&](const std::string& name) { return reader.read(name).values; };
  const auto p = series("/bodies/bar.tip/orientation");
  CHECK(2 * std::atan2(p[3], p[0]) == doctest::Approx(1).epsilon(0.01));
  const auto r = series("/joints/bar.tip/coordinates");
  CHECK(r[0] == doctest::Approx(length * (std::sin(1) - 1)).epsilon(0.01));
  CHECK(r[1] == doctest::Approx(length * (1 - std::cos(1))).epsilon(0.01));
  const double M = 1e9 * I / length;
  CHECK(series("/energy/strain").back() == doctest::Approx(0.5 * M).epsilon(0.01));
  // Equilibrium to 1e-10, of a body bent by 1 rad.
  CHECK(series("/joints/hinge/reaction_torque")[2] == doctest::Approx(-M).epsilon(1e-6));
  const std::vector<double> stress = field_of(folder / "r_bar" / "00000.vtu", "von_mises");
  CHECK(*std::max_element(stress.begin(), stress.end()) == doctest::Approx(1e9 * 0.005 / length).epsilon(0.05));
}

TEST_CASE("StiffBarOfFiniteStrain_StartsTurning") {
  // Strains of 1e-9 on a bar of steel: taken as F^T F - 1 they would be lost in round-off.
  const TemporaryDirectory folder;
  write_bar(folder / "bar.inp", 10);
  std::string text = kPendulum;
  text.replace(text.find("modes: 4"), 8, "modes: 4\n      form: nodal\n      strain: finite");
  text.replace(text.find("youngs_modulus: 1 GPa"), 21, "youngs_modulus: 210 GPa");
  text.replace(text.find("      tip: {nodes: right}\n"), 26, "");
  text.replace(text.find("bar.root]}"), 10, "bar.root], initial: {rotation_rate: 40 rad/s}}");
  text.replace(text.find("duration: 50 ms"), 15, "duration: 1 ms");
  std::ofstream(folder / "model.yaml") << text;
  const Summary summary = simulate(model::read(folder / "model.yaml"), {.results = folder / "r.h5"});
  INFO(summary.message);
  REQUIRE(summary.status == Status::completed);
  // Stretched by its own rotation: N = rho A w^2 (L^2 - x^2)/2, energy integral of N^2/(2 E A) = (rho w^2)^2 A L^5/(15
  // E).
  const double load = 1200 * 1600.0;
  const results::Reader reader(folder / "r.h5");
  CHECK(reader.read("/energy/strain").values.front() ==
        doctest::Approx(load * load * 1e-4 * std::pow(0.2, 5) / (15 * 210e9)).epsilon(0.05));
}

TEST_CASE("ClampedBodies_RunThoughNothingCanMove") {
  const TemporaryDirectory folder;
  write_bar(folder / "bar.inp", 10);
  std::string bar = kPendulum;
  bar.replace(bar.find("modes: 4"), 8, "modes: 0").replace(bar.find("      tip: {nodes: right}\n"), 26, "");
  bar.replace(bar.find("type: revolute"), 14, "type: fixed")
      .replace(bar.find("50 ms, step: 0.1 ms"), 19, "1 ms, step: 0.1 ms");
  const std::string rigid = R"(hersey: 1
gravity: 0 -9.81 0 m/s^2
bodies:
  block: {mass: 0.024 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}
joints:
  hinge: {type: fixed, between: [ground, block]}
simulation: {duration: 1 ms, step: 0.1 ms}
)";
  for (const std::string& text : {bar, rigid}) {
    for (const char* step :
         {"simulation.step=0.1 ms", "simulation.step={tolerance: 1e-4}", "simulation.analysis=static"}) {
      CAPTURE(step);
      std::ofstream(folder / "model.yaml") << text;
      const Summary summary =
          simulate(model::read(folder / "model.yaml", {step}), {.results = folder / "r.h5", .overwrite = true});
      INFO(summary.message);
      REQUIRE(summary.status == Status::completed);
      const results::Reader reader(folder / "r.h5");
      const std::vector<double> force = reader.read("/joints/hinge/reaction_force").values;
      CHECK(force[force.size() - 2] == doctest::Approx(0.024 * 9.81).epsilon(1e-9));  // 1200 kg/m^3, 20 cm^3
    }
  }
}

TEST_CASE("PendulumBlownAtItsEnd_BalancesPowers") {
  const TemporaryDirectory folder;
  write_bar(folder / "bar.inp", 10);
  std::ofstream(folder / "model.yaml") << kPendulum << kWind;
  const Summary summary = simulate(model::read(folder / "model.yaml"), {.results = folder / "r.h5"});
  INFO(summary.message);
  CHECK(summary.status == Status::completed);
  CHECK(summary.worst_power_balance < 1e-7);  // steps are solved to 1e-8
  const results::Reader reader(folder / "r.h5");
  const auto series = [&](const std::string& name) { return reader.read(name).values; };
  const auto blow = series("/surface_loads/blow/power"), wind = series("/surface_loads/wind/power"),
             loads = series("/power/loads"), force = series("/surface_loads/wind/force");
  double largest = 0;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    CHECK(loads[i] == doctest::Approx(blow[i] + wind[i]).epsilon(1e-12));  // a sum: round-off
    largest = std::max(largest, std::abs(loads[i]));
  }
  CHECK(largest > 1e-3);
  CHECK(force[force.size() - 2] == doctest::Approx(2));  // ground's y, whatever the rotation of the bar
}

/// A bar clamped at its left end is pushed down at its right one by a block that is driven.
std::string pressed_bar(const std::string& form, const std::string& shapes, const std::string& part) {
  return R"(hersey: 1
title: A bar pushed by a block
bodies:
  bar:
    flexible:
      mesh: bar.inp
      length_unit: 1 mm
      material: {youngs_modulus: 1 GPa, poisson_ratio: 0.3, density: 1200 kg/m^3}
      modes: 4
      damping: {mass: 200 1/s, stiffness: 1 ms}
      form: )" +
         form + R"(
    frames:
      root: {nodes: left}
)" + shapes +
         R"(
  block:
    mass: 1 kg
    inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}
    shapes:
      face: {shape: box, centre: 200 20 5 mm, size: 20 20 40 mm}
  ground:
    frames:
      wall: {origin: 0 5 5 mm}
    shapes:
      floor: {shape: half_space, point: 0 -50 0 mm, normal: y}  # out of reach
joints:
  clamp: {type: fixed, between: [ground.wall, bar.root]}
  guide: {type: prismatic, between: [ground, block], axis: y}
drives:
  push: {joint: guide, coordinate: translation, position: "-0.5 mm", ramp: 30 ms}
contacts:
  touch:
    between: [block.face, )" +
         part + R"(]
    stiffness: {pressure: 1 GPa, penetration: 10 um}
  fall:
    between: [ground.floor, )" +
         part + R"(]
    stiffness: {pressure: 1 GPa, penetration: 10 um}
simulation: {duration: 60 ms, step: 0.25 ms}
)";
}

TEST_CASE("BarPushedByABlock_AnswersLikeACantilever") {
  const TemporaryDirectory folder;
  write_bar(folder / "bar.inp", 10);
  const std::string faces = "    shapes:\n      end: {shape: faces, of: pad}";
  struct Case {
    std::string form, shapes, part;
  };
  // The block covers the two upper nodes of the end; by the whole skin it touches the same.
  for (const Case& c :
       {Case{"modal", faces, "bar.end"}, Case{"nodal", faces, "bar.end"}, Case{"modal", "", "bar.mesh"}}) {
    CAPTURE(c.form);
    CAPTURE(c.part);
    std::ofstream(folder / "model.yaml") << pressed_bar(c.form, c.shapes, c.part);
    const Summary summary =
        simulate(model::read(folder / "model.yaml"), {.results = folder / "r.h5", .overwrite = true});
    INFO(summary.message);
    REQUIRE(summary.status == Status::completed);
    CHECK(summary.worst_power_balance < 1e-6);  // steps are solved to 1e-8
    const results::Reader reader(folder / "r.h5");
    const double force = reader.read("/contacts/touch/normal_force").values.back();
    const double gap = reader.read("/contacts/touch/gap").values.back();
    // 3 E I/L^3 with E I = 1e9 x 1e-8/12; shear takes 0.3 %, and a load at the upper edge 5 mm above the axis nothing.
    CHECK(force == doctest::Approx(3 * 1e9 * 1e-8 / 12 / 8e-3 * (0.5e-3 + gap)).epsilon(0.02));
    CHECK(gap < 0);
    CHECK(gap > -20e-6);
  }
}

TEST_CASE("ModesOfABar_BendItsSkin") {
  const TemporaryDirectory folder;
  write_bar(folder / "bar.inp", 10);
  std::string text = kPendulum;
  text.replace(text.find("type: revolute"), 14, "type: fixed").replace(text.find("duration"), 29, "analysis: modes");
  std::ofstream(folder / "model.yaml") << text;
  const Summary summary = simulate(model::read(folder / "model.yaml"), {.results = folder / "r.h5"});
  INFO(summary.message);
  REQUIRE(summary.status == Status::completed);
  const results::Reader reader(folder / "r.h5");
  const auto series = [&](const std::string& name) { return reader.read(name).values; };
  // Clamped bar of 200 x 10 x 10 mm: 1.8751^2/(2 pi L^2) sqrt(E I/(rho A)), twice, within what shear takes.
  const double f = 3.5160 / (2 * 3.14159265 * 0.04) * std::sqrt(1e9 * 1e-4 / 12 / 1200);
  const std::vector<double> frequencies = series("/modes/fields/frequency");
  REQUIRE(frequencies.size() >= 2);
  CHECK(frequencies[0] == doctest::Approx(f).epsilon(0.02));
  CHECK(frequencies[1] == doctest::Approx(f).epsilon(0.02));
  // The skin's displacement by the mode is that of the tip's frame, relative to the root: bodies bar and bar.tip.
  const auto amplitudes = series("/modes/fields/bar_amplitudes_real"), bodies = series("/modes/fields/body_real"),
             deformation = series("/bodies/bar/shapes/mesh/deformation");
  const std::size_t shapes = amplitudes.size() / frequencies.size(), corners = deformation.size() / shapes / 3;
  double tip = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    double u = 0;  // mean of the four corners of the end
    for (std::size_t k = 0; k < shapes; ++k)
      for (std::size_t corner = corners - 4; corner < corners; ++corner)
        u += 0.25 * amplitudes[k] * deformation[3 * (k * corners + corner) + axis];
    // The frame carries the corners: far above round-off, far below another shape.
    CHECK(u == doctest::Approx(bodies[6 + 3 + axis]).epsilon(1e-5));
    tip = std::max(tip, std::abs(u));
  }
  CHECK(tip > 0.01);
}

}  // namespace flexible_test
}  // namespace hersey::run
