#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "small_bar.h"
#include "temporary_directory.h"

// Bodies that start deformed as the forces hold them.
namespace hersey::run {
namespace static_start_test {

/// The pendulum's strain energy in time, with `change` made to its text.
std::vector<double> strain_energy(const std::string& text, const std::string& initial_deformation) {
  const TemporaryDirectory folder;
  write_bar(folder / "bar.inp", 10);
  std::ofstream(folder / "model.yaml") << text;
  const Summary summary =
      simulate(model::read(folder / "model.yaml", {"simulation.initial_deformation=" + initial_deformation}),
               {.results = folder / "r.h5"});
  INFO(summary.message);
  CHECK(summary.status == Status::completed);
  return results::Reader(folder / "r.h5").read("/energy/strain").values;
}

std::string pendulum(const std::string& joints) {
  std::string text = kPendulum;
  const std::string hinge = "  hinge: {type: revolute, between: [ground, bar.root]}\n";
  return text.replace(text.find(hinge), hinge.size(), joints);
}

/// Largest departure from where it starts, relative to it.
double swing(const std::vector<double>& energy) {
  double largest = 0;
  for (const double now : energy) largest = std::max(largest, std::abs(now - energy.front()));
  return largest / energy.front();
}

TEST_CASE("SupportedBar_StartsAtRestUnderItsWeight") {
  const std::string in_equilibrium = pendulum("  clamp: {type: fixed, between: [ground, bar.root]}\n");
  CHECK(swing(strain_energy(in_equilibrium, "static")) < 1e-6);  // residual swing of a start in static equilibrium
  const std::vector<double> undeformed = strain_energy(in_equilibrium, "none");
  CHECK(undeformed.front() == 0);
  // A start without deformation swings to twice the deflection: four times the energy, less the energy that damping
  // absorbs.
  const double at_rest = strain_energy(in_equilibrium, "static").front();
  CHECK(*std::max_element(undeformed.begin(), undeformed.end()) == doctest::Approx(4 * at_rest).epsilon(0.1));
}

// Displacements of every node, or four modes: both start undeformed if this is requested.
TEST_CASE("NodalBar_IsLetGoWhereItIsAskedFor") {
  const std::string modal = pendulum("  clamp: {type: fixed, between: [ground, bar.root]}\n");
  std::string nodal = modal;
  nodal.replace(nodal.find("modes: 4"), 8, "form: nodal");
  const std::vector<double> undeformed = strain_energy(nodal, "none");
  CHECK(undeformed.front() == 0);
  const std::vector<double> in_equilibrium = strain_energy(nodal, "internal");
  CHECK(in_equilibrium.front() > 0);
  const double highest = *std::max_element(undeformed.begin(), undeformed.end());
  CHECK(highest == doctest::Approx(4 * in_equilibrium.front()).epsilon(0.1));
  // The same swing as by modes, from the first step on.
  const std::vector<double> by_modes = strain_energy(modal, "none");
  REQUIRE(by_modes.size() == undeformed.size());
  for (std::size_t i = 0; i < undeformed.size(); ++i) CHECK(std::abs(undeformed[i] - by_modes[i]) < 0.05 * highest);
}

// By default it starts in equilibrium with its forces.
TEST_CASE("NodalBar_StartsInItsStaticAnswerByDefault") {
  const TemporaryDirectory folder;
  write_bar(folder / "bar.inp", 4);
  std::string text = pendulum("  clamp: {type: fixed, between: [ground, bar.root]}\n");
  CHECK(model::read_text(text, (folder / "model.yaml").string()).simulation.initial_deformation ==
        model::InitialDeformation::none);
  text.replace(text.find("modes: 4"), 8, "form: nodal");
  CHECK(model::read_text(text, (folder / "model.yaml").string()).simulation.initial_deformation ==
        model::InitialDeformation::internal);
}

// Its rigid rotation depends on the constraints, as do two of its deformations.
TEST_CASE("BarInALoop_StartsAtRestUnderItsWeight") {
  const std::string loop =
      pendulum(
          "  hinge: {type: revolute, between: [ground, bar.root]}\n  end: {type: spherical, between: [ground.far, "
          "bar.tip]}\n")
          .insert(std::string(kPendulum).find("  bar:"), "  ground: {frames: {far: {origin: 200 5 5 mm}}}\n");
  const std::vector<double> energy = strain_energy(loop, "static");
  CHECK(energy.front() > 0);
  CHECK(swing(energy) < 1e-6);  // residual swing of a start in static equilibrium
}

// It falls, and bends under its own inertia: not as a supported bar.
TEST_CASE("FallingPendulum_StartsWithoutVibration") {
  const std::vector<double> smooth = strain_energy(kPendulum, "static"), ringing = strain_energy(kPendulum, "none");
  const std::size_t first = 60;  // 6 ms, more than a period of its first bending vibration
  CHECK(swing({smooth.begin(), smooth.begin() + first}) < 0.05);
  CHECK(*std::max_element(ringing.begin(), ringing.begin() + first) > 3 * smooth.front());
}

}  // namespace static_start_test
}  // namespace hersey::run
