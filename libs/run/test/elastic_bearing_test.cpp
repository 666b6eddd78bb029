// The paper's rig with a rod that bends under the film: limits, couplings, balances.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "hersey/fem/elastic_body.h"
#include "hersey/model/read.h"
#include "hersey/run/simulate.h"
#include "temporary_directory.h"

namespace hersey::run {
namespace {

const std::filesystem::path kFolder = std::filesystem::path(HERSEY_SOURCE_DIR) / "examples/flexible_big_end";

std::string rig() {
  std::ostringstream text;
  text << std::ifstream(kFolder / "model.yaml").rdbuf();
  std::string model = text.str();
  model.resize(model.find("study:"));  // one run, not its study
  return model;
}

Summary run(const std::string& text, std::vector<std::string> overrides) {
  for (const char* smaller : {"bearings.big_end.grid={circumferential: 36, axial: 7}", "simulation.duration=100 deg",
                              "load=1500 N", "output.fields_every=90 deg"})
    overrides.insert(overrides.begin(), smaller);
  const TemporaryDirectory folder;
  const model::Model model = model::read_text(text, (kFolder / "model.yaml").string(), overrides);
  const Summary summary = simulate(model, {.results = folder / "r.h5"});
  INFO(summary.message);
  REQUIRE(summary.status == Status::completed);
  return summary;
}

/// The rig with a rigid rod of the mesh's mass.
std::string rigid_rig() {
  const model::Model model = model::read_text(rig(), (kFolder / "model.yaml").string());
  const auto rod =
      std::find_if(model.bodies.begin(), model.bodies.end(), [](const auto& b) { return b.name == "rod"; });
  const fem::ElasticBody body = fem::assemble(*rod->flexible->mesh, rod->flexible->materials);
  const Matrix3& J = body.inertia;
  std::string text = rig();
  const auto first = text.find("  rod:"), last = text.find("joints:");
  text.replace(
      first, last - first,
      fmt::format("  rod:\n    mass: {:.15g} kg\n    centre_of_mass: {:.15g} {:.15g} {:.15g} m\n"
                  "    inertia: {{xx: {:.15g} kg.m^2, yy: {:.15g} kg.m^2, zz: {:.15g} kg.m^2, xy: {:.15g} kg.m^2, "
                  "xz: {:.15g} kg.m^2, yz: {:.15g} kg.m^2}}\n"
                  "    frames:\n      big_end: {{origin: 0 0 0 mm}}\n      small_end: {{origin: 0 140 0 mm}}\n\n",
                  body.mass, body.centre.x(), body.centre.y(), body.centre.z(), J(0, 0), J(1, 1), J(2, 2), J(0, 1),
                  J(0, 2), J(1, 2)));
  const auto surface = text.find("    shell_surface");
  return text.erase(surface, text.find('\n', surface) + 1 - surface);
}

void check_same(const Summary& a, const Summary& b, double tolerance) {
  CHECK(a.bearings[0].moft == doctest::Approx(b.bearings[0].moft).epsilon(tolerance));
  CHECK(a.bearings[0].pofp == doctest::Approx(b.bearings[0].pofp).epsilon(tolerance));
  CHECK(a.bearings[0].eccentricity_ratio == doctest::Approx(b.bearings[0].eccentricity_ratio).epsilon(tolerance));
  CHECK(a.bearings[0].mean_power == doctest::Approx(b.bearings[0].mean_power).epsilon(tolerance));
}

TEST_CASE("FilmInAStiffRod_IsThatInARigidOne") {
  const std::vector<std::string> stiff{"bodies.rod.flexible.material.youngs_modulus=2.1e17 Pa",
                                       "bodies.rod.flexible.modes=0", "bodies.rod.flexible.damping.stiffness=0 s"};
  const Summary rigid = run(rigid_rig(), {});
  check_same(run(rig(), stiff), rigid, 1e-4);
  // Steel is another matter.
  CHECK(std::abs(run(rig(), {}).bearings[0].moft / rigid.bearings[0].moft - 1) > 0.02);
}

TEST_CASE("FilmInANodalRod_IsThatInAModalOne") {
  const Summary modal = run(rig(), {}), nodal = run(rig(), {"bodies.rod.flexible.form=nodal"});
  check_same(modal, nodal, 0.01);
  for (const Summary& summary : {modal, nodal}) {
    CHECK(summary.worst_power_balance < 1e-9);
    CHECK(summary.bearings[0].worst_mass_balance < 1e-7);
    CHECK(summary.newton_iterations <= 6 * summary.steps);
  }
}

}  // namespace
}  // namespace hersey::run
