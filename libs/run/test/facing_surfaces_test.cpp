// Warnings and faults for bearings whose surfaces do not fit each other at the start.
#include "start/facing_surfaces.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "edited.h"
#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "meshed_bearing.h"
#include "ring_file.h"
#include "small_rig.h"
#include "temporary_directory.h"

namespace hersey::run {
namespace facing_surfaces_test {

/// A ring around a hollow shaft, both meshes.
const std::string two_meshes = MeshedBearing{.title = "A ring around a hollow shaft",
                                             .ground = "middle: {origin: 0 0 0 mm}",
                                             .ring = {"ring.inp", "modes: 1\ndamping: {stiffness: 2 us}", kHub},
                                             .shaft = {"shaft.inp", "modes: 1\ndamping: {stiffness: 2 us}", kPin},
                                             .journal = "shaft.pin",
                                             .guided_on = "ground.middle",
                                             .film =
                                                 "grid: {circumferential: 24, axial: 5}\n"
                                                 "shell_surface: {within: 0.1 mm, modes: 4}\n"
                                                 "journal_surface: {within: 0.1 mm, modes: 4}",
                                             .simulation = "{duration: 0.2 ms, step: 0.1 ms}"}
                                   .text();

/// The machine in a folder of its own.
struct Machine {
  TemporaryDirectory folder;
  std::filesystem::path file;

  explicit Machine(const std::string& text, double shaft_radius = 22.466) : file(folder / "model.yaml") {
    std::ofstream(folder / "ring.inp") << RingFile().text();
    std::ofstream(folder / "shaft.inp") << RingFile{.inner = 12, .outer = shaft_radius}.text();
    std::ofstream(file) << text;
  }

  [[nodiscard]] std::vector<Fault> warnings() const { return check(model::read(file)); }

  [[nodiscard]] Fault fault() const {
    try {
      (void)check(model::read(file));
    } catch (const InputError& error) {
      return error.faults().front();
    }
    FAIL("the model was accepted");
    return {};
  }
};

TEST_CASE("MeshesThatFit_AreNotWarnedOf") { CHECK(Machine(two_meshes).warnings().empty()); }

TEST_CASE("LocallyNegativeClearance_IsReportedWithLocationAndSize") {
  // The ring's nodes lie 50 um off the frame's axis, towards -x: the bore comes nearest at 0 deg.
  const Fault shell = Machine(edited(two_meshes, "average, origin: 0 0 0 mm", "average, origin: 0.05 0 0 mm")).fault();
  CAPTURE(shell.found);
  CHECK(shell.path == "bearings.main.shell_surface");
  CHECK(shell.position.line == 44);
  CHECK(contains(shell.found, "a clearance of -1"));  // 34 um - 50 um cos(phi): -16 um
  CHECK((contains(shell.found, "um at 1 deg, z =") || contains(shell.found, "um at 359 deg, z =")));
  CHECK(
      contains(shell.found, "the shell's mesh has a radius of 22.45 mm there, 50 um less than the bearing's 22.5 mm"));
  CHECK(contains(shell.found, "(negative on 26 % of the film)"));  // 2 acos(34/50) = 94 deg, and the fields' own width
  CHECK(contains(shell.suggestion, "the frames' origins"));

  // A shaft 20 um too thick for the clearance, all around.
  const Fault journal = Machine(two_meshes, 22.52).fault();
  CHECK(journal.path == "bearings.main.journal_surface");
  CHECK(contains(journal.found, "a clearance of -20 um at"));
  CHECK(contains(journal.found, "(negative on 1e+02 % of the film)"));
  CHECK(contains(journal.found,
                 "the journal's mesh has a radius of 22.52 mm there, 54 um more than the bearing's 22.466 mm"));
}

TEST_CASE("ClearanceOfMeshes_FollowsTheJournalAtTheStart") {
  // A shaft 15 um too thick leaves 19 um: enough in the middle, too little for a journal that starts 25 um off it.
  CHECK_NOTHROW((void)Machine(two_meshes, 22.481).warnings());
  const std::string away = edited(two_meshes, "between: [ground.middle, shaft.pin]",
                                  "between: [ground.middle, shaft.pin], initial: {x: 0 um, y: 25 um}");
  CHECK_NOTHROW((void)Machine(away).warnings());
  const Fault fault = Machine(away, 22.481).fault();
  CHECK(contains(fault.found, "a clearance of -5.9"));
  CHECK((contains(fault.found, "um at 89 deg") || contains(fault.found, "um at 91 deg")));
}

TEST_CASE("MeshOfAnotherRadiusThanTheFilms_IsWarnedOfAndInTheAssumptions") {
  const Machine machine(two_meshes, 22.476);
  const std::vector<Fault> warnings = machine.warnings();
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].path == "bearings.main.journal_surface");
  CHECK(contains(warnings[0].found, "10 um above the bearing's 22.466 mm (29 % of the clearance)"));
  const std::filesystem::path results = machine.folder / "r.h5";
  const Summary summary = simulate(model::read(machine.file), {.results = results});
  INFO(summary.message);
  REQUIRE(summary.status == Status::completed);
  int reported = 0;
  for (const auto& [name, text] : results::Reader(results).text_table("/assumptions")) {
    if (name == "main: journal surface")
      reported += contains(text, "10 um above") && contains(text, "LEAVES OUT") ? 1 : 0;
    if (name == "main: shell surface") reported += contains(text, "LEAVES OUT") ? 10 : 1;
  }
  CHECK(reported == 2);
}

TEST_CASE("SurfacesApartAlongTheAxis_DoNotFaceEachOther") {
  const Fault fault = Machine(edited(two_meshes, "middle: {origin: 0 0 0 mm}", "middle: {origin: 0 0 5 mm}")).fault();
  CHECK(fault.path == "bearings.main.journal_surface");
  CHECK(contains(fault.found,
                 "the journal's lies 5 mm along the axis from the shell's, so that 68 % of the width face it"));
  CHECK(contains(fault.suggestion, "shaft.pin"));
}

TEST_CASE("SurfacesThatLookTheWrongWay_AreReported") {
  // A shaft as the shell, and the bore of a ring as the journal in it.
  const std::string swapped =
      edited(edited(two_meshes, "shell: ring.hub", "shell: shaft.pin"), "journal: shaft.pin", "journal: ring.hub");
  try {
    (void)model::read(Machine(swapped).file);
    FAIL("the model was accepted");
  } catch (const InputError& error) {
    REQUIRE(error.faults().size() == 2);
    CHECK(error.faults()[0].path == "bearings.main.shell_surface.within");
    CHECK(contains(error.faults()[0].found, "looks away from the axis"));
    CHECK(contains(error.faults()[0].suggestion, "a shaft is the journal"));
    CHECK(error.faults()[1].path == "bearings.main.journal_surface.within");
    CHECK(contains(error.faults()[1].found, "looks towards the axis"));
    CHECK(contains(error.faults()[1].suggestion, "a bore is the shell"));
  }
}

Fault fault_of(const std::string& text) {
  try {
    (void)check(rig(text));
  } catch (const InputError& error) {
    return error.faults().front();
  }
  FAIL("the model was accepted");
  return {};
}

TEST_CASE("AxesThatCross_DoNotFaceEachOther") {
  const std::string turned = edited(
      rig_with("  pin: {mass: 1 kg,", "  pin: {frames: {across: {rotation: {axis: x, angle: 90 deg}}}, mass: 1 kg,"),
      "journal: pin", "journal: pin.across");
  const Fault fault = fault_of(turned);
  CHECK(fault.path == "bearings.big_end");
  CHECK(contains(fault.found,
                 "the surfaces do not face each other: the journal's z-axis stands at 90 deg to the shell's"));
  CHECK(contains(fault.suggestion, "turn the frame"));
}

TEST_CASE("JournalTouchingAtTheStart_IsReportedWithLocation") {
  const Fault moved = fault_of(rig_with("initial: {x: 0 um}", "initial: {x: 40 um}"));
  CHECK(contains(moved.found, "the journal touches the shell (smallest undeformed gap -6 um at 180.0 deg"));
  const Fault tilted = fault_of(edited(
      rig_with("  pin: {mass: 1 kg,", "  pin: {frames: {askew: {rotation: {axis: x, angle: 1 deg}}}, mass: 1 kg,"),
      "journal: pin", "journal: pin.askew"));
  CHECK(contains(tilted.found, "its axis 1 deg off the bore's"));
  CHECK(contains(tilted.found, "z = "));
}

}  // namespace facing_surfaces_test
}  // namespace hersey::run
