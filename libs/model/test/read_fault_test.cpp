#include <algorithm>

#include "model_text.h"
#include "source_dir.h"

// One test per kind of fault: where it is, what was found, what is expected, what to write instead.
namespace hersey::model {
namespace read_fault_test {

TEST_CASE("ExplicitMethod_IsRefusedWhereItCannotStep") {
  const std::string machine = R"(hersey: 1
bodies:
  block: {mass: 1 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}
joints: {rail: {type: prismatic, between: [ground, block], axis: x}}
simulation: {duration: 1 s, step: 1 ms, integrator: dormand_prince}
)";
  CHECK(read_text(machine, "m.yaml").simulation.integrator == Integrator::dormand_prince);
  CHECK(faults_of(edited(machine, "dormand_prince", "euler")).find("generalized_alpha") != std::string::npos);
  const std::string kinematic = faults_of(edited(machine, "step: 1 ms", "step: 1 ms, analysis: kinematics"));
  CHECK(kinematic.find("m.yaml:5") != std::string::npos);
  CHECK(kinematic.find("integrates nothing") != std::string::npos);
  const std::string with_films = faults_of(good_model, {"simulation.integrator=dormand_prince"});
  CHECK(with_films.find("the explicit method in a machine with bearing 'big_end'") != std::string::npos);
  CHECK(with_films.find("generalized_alpha") != std::string::npos);
}

TEST_CASE("UnknownKey_NamesTheNearest") {
  CHECK(faults_after("    diameter: 45 mm\n", "    diameter: 45 mm\n    widht: 3 mm\n") ==
        "m.yaml:27:5: bearings.big_end: unknown key 'widht'; did you mean 'width'? expected shell, journal, diameter, "
        "width, radial_clearance, diametral_clearance, grid, edge_pressure, ambient_fill, thermal, supply, features, "
        "bore, arcs, shape, shell_surface, journal_surface, operating_point, oil_inertia, shear_force, roughness, "
        "materials, wear, "
        "lubricant, "
        "pressures, "
        "cavitation, initial_fill, asperities, compliance, permissible_pressure, cavitated_shear, turbulence, solver, "
        "coupling or "
        "kind");
}

TEST_CASE("UnphysicalPressures_AreReported") {
  const auto with = [](const std::string& lines) {
    return faults_after("    lubricant: oil\n", "    lubricant: oil\n" + lines);
  };
  CHECK(with("    cavitation: {model: reynolds, pressure: -1.2 bar}\n") ==
        "m.yaml:30:45: bearings.big_end.cavitation.pressure: -1.2 bar, below a vacuum; expected a gauge pressure of at "
        "least -1.01325 bar");
  CHECK(with("    pressures: absolute\n    edge_pressure: 1 bar\n    cavitation: {model: reynolds, pressure: -0.2 "
             "bar}\n") ==
        "m.yaml:32:45: bearings.big_end.cavitation.pressure: -0.2 bar, below a vacuum; expected an absolute pressure "
        "of at least 0; pressures: gauge counts from the atmosphere");
  CHECK(with("    pressures: absolute\n") ==
        "m.yaml:30:5: bearings.big_end.pressures: absolute pressures without 'edge_pressure'; expected the pressure "
        "outside both edges; edge_pressure: 1.013 bar is the atmosphere");
  CHECK(with("    edge_pressure: 1 bar\n    ambient_fill: 0.5\n") ==
        "m.yaml:31:19: bearings.big_end.ambient_fill: 0.5 at an edge above the cavitation pressure; expected 1: such "
        "an edge is flooded; or the cavitation pressure as this edge's pressure");
  CHECK(with("    cavitation: reynolds\n    ambient_fill: 0.5\n") ==
        "m.yaml:31:5: bearings.big_end.ambient_fill: a fill fraction outside a film that has none inside; expected "
        "cavitation: mass_conserving, or no ambient_fill");
  CHECK(with("    cavitation: reynolds\n    initial_fill: 0.5\n") ==
        "m.yaml:31:5: bearings.big_end.initial_fill: a dry start of a film that does not conserve oil; expected "
        "cavitation: mass_conserving, or no initial_fill");
  CHECK(with("    ambient_fill: 1.5\n").find(">= 0 and <= 1") != std::string::npos);
}

TEST_CASE("ImpossibleRoughness_IsReported") {
  const auto with = [](const std::string& lines) {
    return faults_after("    lubricant: oil\n", "    lubricant: oil\n" + lines);
  };
  CHECK(with("    roughness: {}\n") ==
        "m.yaml:30:5: bearings.big_end.roughness: neither 'shell' nor 'journal'; expected at least one of them, with "
        "its sigma");
  CHECK(with("    roughness: {shell: {sigma: 20 um}}\n") ==
        "m.yaml:30:5: bearings.big_end.roughness: a roughness of 20 um in a clearance of 34 um; expected at most a "
        "third of the clearance: else the surfaces touch all around");
  CHECK(with("    roughness: {shell: {sigma: 1 um, gamma: 12}}\n").find("gamma: '12'; expected a number") !=
        std::string::npos);
  CHECK(with("    roughness: {shell: {gamma: 1}}\n").find("missing key 'sigma'") != std::string::npos);
  CHECK(with("    asperities: {model: greenwood_tripp, composite_modulus: 57 GPa}\n") ==
        "m.yaml:30:5: bearings.big_end.asperities: missing key 'roughness'; expected a length > 0, such as 1 um; or "
        "give the bearing's roughness, surface by surface");
}

TEST_CASE("NumbersBeyondAnyMachine_AreReported") {
  CHECK(faults_after("diameter: 45 mm", "diameter: 1e308 mm") ==
        "m.yaml:26:15: bearings.big_end.diameter: 1e+305 m; expected a length of at most 1e+06 m in size");
  CHECK(faults_after("speed: 3000 rpm", "speed: 1e-308 rpm").find("0 or of at least 1e-100 rad/s in size") !=
        std::string::npos);
  CHECK(faults_after("500 N", "1e300 N").find("a force of at most 1e+18 N in size") != std::string::npos);
}

TEST_CASE("MaterialsBesideACompositeModulus_AreReportedOrRefused") {
  const auto bearing_with = [](const std::string& modulus, const std::string& heat, const std::string& contact) {
    const std::string material = "{youngs_modulus: 210 GPa, poisson_ratio: 0.3" + heat + "}";
    return edited(good_model, "    lubricant: oil\n",
                  "    lubricant: oil\n    materials: {shell: " + material + ", journal: " + material + "}\n" +
                      contact + modulus);
  };
  const std::string column = "    compliance: {model: column", given = ", composite_modulus: 57 GPa}\n";
  const std::string effusive = ", density: 7300 kg/m^3, conductivity: 55 W/m/K, specific_heat: 230 J/kg/K";
  CHECK(faults_of(bearing_with(given, "", column)) ==
        "m.yaml:31:52: bearings.big_end.compliance.composite_modulus: a composite modulus beside `materials`, whose "
        "moduli then would not count; expected one of both; leave out `materials`, or `composite_modulus` where theirs "
        "is meant");
  // The good model's film starves, which is warned of; nothing else is.
  CHECK(read_text(bearing_with("}\n", "", column), "m.yaml").warnings.size() == 1);
  const auto warning = [](const std::string& text) { return read_text(text, "m.yaml").warnings.at(0).text(); };
  CHECK(warning(bearing_with(given, effusive, column)).find("the materials share heat only") != std::string::npos);
  CHECK(warning(bearing_with("", "", "")).find("materials that nothing takes") != std::string::npos);
}

TEST_CASE("MissingKey_IsReportedAtItsParent") {
  CHECK(faults_after("    diameter: 45 mm\n", "") ==
        "m.yaml:23:3: bearings.big_end: missing key 'diameter'; expected a length > 0, such as 45 mm");
  CHECK(faults_after("hersey: 1\n", "") == "m.yaml:1:1: missing key 'hersey'; expected 1");
}

TEST_CASE("WrongVersion_IsReported") {
  CHECK(faults_after("hersey: 1", "hersey: 2") == "m.yaml:1:9: hersey: '2'; expected 1");
}

TEST_CASE("WrongDimension_IsNamed") {
  CHECK(faults_after("diameter: 45 mm", "diameter: 45 kPa") ==
        "m.yaml:26:15: bearings.big_end.diameter: a pressure (kPa); expected a length > 0, such as 45 mm");
}

TEST_CASE("MissingUnit_IsReported") {
  CHECK(faults_after("diameter: 45 mm", "diameter: 45") ==
        "m.yaml:26:15: bearings.big_end.diameter: a number without unit; expected a length > 0, such as 45 mm");
}

TEST_CASE("UnknownUnit_NamesTheNearest") {
  CHECK(faults_after("viscosity: 15 mPa.s", "viscosity: 15 mPas") ==
        "m.yaml:21:20: lubricants.oil.viscosity: unknown unit 'mPas'; did you mean 'mPa.s'? expected a dynamic "
        "viscosity > 0, such as 15 mPa.s");
}

TEST_CASE("Frequency_IsNoAngularVelocity") {
  CHECK(faults_after("speed: \"${speed}\"", "speed: 50 Hz") ==
        "m.yaml:17:53: drives.motor.speed: a frequency (Hz); expected an angular velocity or a velocity, such as "
        "3570 rpm");
}

TEST_CASE("ValueOutOfRange_IsReported") {
  CHECK(faults_after("diameter: 45 mm", "diameter: -45 mm") ==
        "m.yaml:26:15: bearings.big_end.diameter: '-45 mm'; expected a length > 0, such as 45 mm");
  CHECK(faults_after("mass: 1 kg", "mass: -1 kg") ==
        "m.yaml:8:11: bodies.shaft.mass: '-1 kg'; expected a mass >= 0, such as 5 kg");
}

TEST_CASE("NotANumber_IsReported") {
  CHECK(faults_after("diameter: 45 mm", "diameter: nan mm") ==
        "m.yaml:26:15: bearings.big_end.diameter: 'nan mm'; expected a finite number");
  CHECK(faults_after("diameter: 45 mm", "diameter: inf mm") ==
        "m.yaml:26:15: bearings.big_end.diameter: 'inf mm'; expected a finite number");
  CHECK(faults_after("diameter: 45 mm", "diameter: .nan") ==
        "m.yaml:26:15: bearings.big_end.diameter: '.nan'; expected a length > 0, such as 45 mm");
  CHECK(faults_after("diameter: 45 mm", "diameter: 4,5 mm") ==
        "m.yaml:26:15: bearings.big_end.diameter: '4,5 mm'; expected a decimal point; write 4.5 mm");
}

TEST_CASE("WrongKindOfValue_IsReported") {
  CHECK(faults_after("diameter: 45 mm", "diameter: [45 mm]") ==
        "m.yaml:26:15: bearings.big_end.diameter: a list; expected a length > 0, such as 45 mm");
  CHECK(faults_after("diameter: 45 mm", "diameter: {mm: 45}") ==
        "m.yaml:26:15: bearings.big_end.diameter: a mapping; expected a length > 0, such as 45 mm");
  CHECK(faults_after("diameter: 45 mm", "diameter:") ==
        "m.yaml:26:5: bearings.big_end.diameter: nothing; expected a length > 0, such as 45 mm");
  CHECK(faults_after("  oil: {viscosity: 15 mPa.s}", "  oil: 15 mPa.s") ==
        "m.yaml:21:8: lubricants.oil: '15 mPa.s'; expected a lubricant {key: value, ...}");
  CHECK(
      faults_after("between: [ground, rod]", "between: ground") ==
      "m.yaml:15:34: joints.guide.between: 'ground'; expected two frames in brackets, such as [crank.pin, crank.pin]");
  CHECK(faults_after("between: [ground, rod]", "between: [ground]") ==
        "m.yaml:15:34: joints.guide.between: a list of 1; expected two frames in brackets, such as [crank.pin, "
        "crank.pin]");
}

TEST_CASE("WrongNumberOfComponents_IsReported") {
  CHECK(faults_after("origin: 0 50 0 mm", "origin: 0 50 mm") ==
        "m.yaml:11:21: bodies.shaft.frames.pin.origin: '0 50 mm'; expected 3 numbers and a unit of length, such as "
        "0 50 0 mm");
  CHECK(faults_after("origin: 0 50 0 mm", "origin: [0, 50 mm]") ==
        "m.yaml:11:21: bodies.shaft.frames.pin.origin: a list of 2; expected 3 numbers and a unit of length, such as "
        "0 50 0 mm");
}

TEST_CASE("DuplicateKey_NamesTheFirst") {
  CHECK(faults_after("    width: 15.6 mm\n", "    width: 15.6 mm\n    diameter: 3 mm\n") ==
        "m.yaml:28:5: duplicate key 'diameter' (first at line 26); expected each key once");
}

TEST_CASE("SyntaxErrors_AreReportedAlone") {
  CHECK(faults_after("rod: {mass: 2 kg}", "rod: {mass: 2 kg") ==
        "m.yaml:13:7: a '{' without its '}'; expected valid YAML");
  CHECK(faults_after("  oil: {", "\toil: {") ==
        "m.yaml:21:5: a tab before the text of its line; expected spaces before it; indent with spaces, not tabs");
  CHECK(faults_after("\"-${load}\"", "-${load}") ==
        "m.yaml:19:54: a '[' without its ']'; expected valid YAML; inside braces and brackets write \"${name}\" in "
        "quotes");
  CHECK(faults_of("") == "m.yaml:1:1: an empty file; expected a model, beginning with 'hersey: 1'");
  CHECK(faults_of("- a\n- b\n") == "m.yaml:1:1: a list; expected a model {key: value, ...}");
}

TEST_CASE("ASecondDocument_IsReported") {
  CHECK(faults_of(good_model + "---\nhersey: 1\n") ==
        "m.yaml: a second YAML document; expected one document; remove the line '---'");
}

TEST_CASE("AnAliasOfItself_IsReported") {
  CHECK(faults_after("rod: {mass: 2 kg}", "rod: &r {mass: *r}") ==
        "m.yaml:12:18: an alias of the value that contains it; expected an alias of an earlier value");
}

TEST_CASE("ExplodingAliases_EndWithAFault") {
  std::string text = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + before;
    for (int j = 1; j < 10; ++j) text += ", " + before;
    text += "]\n";
  }
  CHECK(faults_of(text) ==
        "m.yaml:5:40: aliases that repeat more than 100000 values; expected at most 100000 values repeated by aliases");
}

TEST_CASE("Names_AreIdentifiers") {
  CHECK(faults_after("  oil: {", "  2-oil: {")
            .starts_with(
                "m.yaml:21:3: lubricants: name '2-oil'; expected letters, digits and _, beginning with a letter"));
}

TEST_CASE("UnknownWord_NamesTheNearest") {
  CHECK(faults_after("type: planar", "type: plannar") ==
        "m.yaml:15:17: joints.guide.type: 'plannar'; did you mean 'planar'? expected fixed, revolute, prismatic, "
        "cylindrical, spherical, planar, universal, screw or free");
  CHECK(
      faults_after("    lubricant: oil\n", "    lubricant: oil\n    solver: newtn\n") ==
      "m.yaml:30:13: bearings.big_end.solver: 'newtn'; did you mean 'newton'? expected auto, newton, multigrid or sor");
}

TEST_CASE("KeyOfAnotherVariant_NamesItsOwner") {
  CHECK(faults_after("    lubricant: oil\n", "    lubricant: oil\n    compliance: {model: rigid, length: 5 mm}\n") ==
        "m.yaml:30:32: bearings.big_end.compliance: key 'length', which model rigid does not have; expected model; "
        "'length' belongs to model column");
}

TEST_CASE("MissingTag_ListsTheVariants") {
  CHECK(faults_after("type: revolute, ", "") ==
        "m.yaml:14:3: joints.main: missing key 'type'; expected fixed, revolute, prismatic, cylindrical, spherical, "
        "planar, universal, screw or free");
}

TEST_CASE("ExactlyOneOfTwoKeys_IsDemanded") {
  CHECK(faults_after("    lubricant: oil\n", "    lubricant: oil\n    diametral_clearance: 68 um\n") ==
        "m.yaml:30:5: bearings.big_end: keys 'radial_clearance' and 'diametral_clearance' together; expected exactly "
        "one of them");
  CHECK(faults_after("    radial_clearance: 34 um\n", "") ==
        "m.yaml:23:3: bearings.big_end: none of the keys 'radial_clearance' and 'diametral_clearance'; expected "
        "exactly one of them");
}

TEST_CASE("KeysThatBelongTogether_AreDemanded") {
  CHECK(faults_after("body: rod, ", "body: rod, direction: 0 1 0, ") ==
        "m.yaml:19:34: forces.push: key 'direction' without 'magnitude'; expected both or neither");
}

TEST_CASE("UnknownReferences_NameTheNearest") {
  CHECK(faults_after("shell: rod", "shell: rdo") ==
        "m.yaml:24:12: bearings.big_end.shell: unknown body 'rdo'; did you mean 'rod'? expected ground, shaft or rod");
  CHECK(
      faults_after("journal: shaft.pin", "journal: shaft.pni") ==
      "m.yaml:25:14: bearings.big_end.journal: unknown frame 'pni' of body 'shaft'; did you mean 'pin'? expected pin");
  CHECK(faults_after("shell: rod", "shell: rod.pin") ==
        "m.yaml:24:12: bearings.big_end.shell: unknown frame 'pin' of body 'rod'; expected 'rod' alone, for it has no "
        "frames");
  CHECK(faults_after("lubricant: oil", "lubricant: oli") ==
        "m.yaml:29:16: bearings.big_end.lubricant: unknown lubricant 'oli'; did you mean 'oil'? expected oil");
  CHECK(faults_after("joint: main", "joint: mian")
            .starts_with(
                "m.yaml:17:18: drives.motor.joint: unknown joint 'mian'; did you mean 'main'? expected main or guide"));
  CHECK(faults_after("coordinate: rotation", "coordinate: rotatoin")
            .starts_with("m.yaml:17:36: drives.motor.coordinate: unknown coordinate 'rotatoin' of joint 'main'; did "
                         "you mean 'rotation'? expected rotation"));
  CHECK(faults_after("shell: rod", "shell: rod.big.end") ==
        "m.yaml:24:12: bearings.big_end.shell: 'rod.big.end'; expected a body or body.frame, such as rod.big_end");
}

TEST_CASE("PartsOfOneBody_AreNoJointOrBearing") {
  CHECK(faults_after("shell: rod", "shell: shaft") ==
        "m.yaml:25:14: bearings.big_end.journal: shell and journal on body 'shaft'; expected frames of two bodies");
  CHECK(faults_after("between: [ground, rod]", "between: [rod, rod]") ==
        "m.yaml:15:40: joints.guide.between.1: both frames on body 'rod'; expected frames of two bodies");
}

TEST_CASE("ImpossibleInertia_IsReported") {
  CHECK(faults_after("zz: 1e-3 kg.m^2", "zz: 3e-3 kg.m^2") ==
        "m.yaml:9:5: bodies.shaft.inertia: principal moments of inertia 0.001, 0.001 and 0.003 kg.m^2; expected none "
        "negative, and none greater than the sum of the others");
}

TEST_CASE("DirectionWithoutLength_IsReported") {
  CHECK(faults_after("axis: 0 0 2", "axis: 0 0 0") ==
        "m.yaml:11:49: bodies.shaft.frames.pin.rotation.axis: a direction of length 0; expected x, y, z or 3 numbers, "
        "such as "
        "0 0 1");
}

TEST_CASE("FeaturesThatCannotBe_AreReported") {
  const auto faults = [](const std::string& features) {
    return faults_after("    lubricant: oil\n", "    lubricant: oil\n    features:\n" + features);
  };
  CHECK(faults("      a: {shape: hole, z: 6 mm, diameter: 5 mm, pressure: 0 Pa}\n") ==
        "m.yaml:31:7: bearings.big_end.features.a: it reaches 8.5 mm from the middle of the bearing; expected at most "
        "half the bearing's width, 7.8 mm");
  CHECK(faults("      a: {shape: hole, diameter: 2 mm, pressure: 0 Pa}\n") ==
        "m.yaml:31:7: bearings.big_end.features.a: fewer than 3 nodes of the 60 x 13 grid across it; expected a finer "
        "grid or a larger one of it; grid: {circumferential: 142, axial: 17} would do");
  CHECK(faults("      a: {shape: hole, diameter: 1e-12 mm, pressure: 0 Pa}\n") ==
        "m.yaml:31:7: bearings.big_end.features.a: fewer than 3 nodes of the 60 x 13 grid across it; expected a larger "
        "one of it");
  CHECK(faults("      a: {shape: hole, diameter: 5 mm, pressure: 1 bar}\n"
               "      b: {shape: axial_groove, angle: 10 deg, arc: 20 deg, pressure: 2 bar}\n") ==
        "m.yaml:32:7: bearings.big_end.features.b: overlaps 'a' (m.yaml:31), which has another pressure; expected the "
        "same constant pressure, or room between them");
  CHECK(faults("      a: {shape: hole, diameter: 5 mm, pressure: -1 bar}\n")
            .starts_with(
                "m.yaml:31:50: bearings.big_end.features.a.pressure: -100000 Pa, below the cavitation pressure"));
  CHECK(faults("      a: {shape: hole, diameter: 5 mm, pressure: {expression: \"1 + guide.x\", unit: bar}}\n")
            .ends_with("a pressure that follows 'guide.x'; expected a function of time or of the rotation of "
                       "simulation.crank"));
}

TEST_CASE("ShapeThatClosesTheGap_IsReported") {
  CHECK(
      faults_after("    lubricant: oil\n", "    lubricant: oil\n    shape: [{profile: ovality, amplitude: 40 um}]\n") ==
      "m.yaml:30:5: bearings.big_end.shape: a shape that closes the gap by 6 um; expected deviations within the "
      "clearance, 34 um");
}

TEST_CASE("ThinOilOfRoelands_IsRefused") {
  CHECK(
      faults_after("{viscosity: 15 mPa.s}", "{viscosity: 0.05 mPa.s, pressure_viscosity: {law: roelands, z: 0.6}}") ==
      "m.yaml:21:20: lubricants.oil.viscosity: a viscosity at or below Roelands' 0.0632 mPa.s; expected a larger one, "
      "or another law in pressure_viscosity");
}

TEST_CASE("ClearanceOfTheBearingsSize_IsAWrongUnit") {
  CHECK(faults_after("radial_clearance: 34 um", "radial_clearance: 34 mm") ==
        "m.yaml:28:23: bearings.big_end.radial_clearance: a clearance of more than a tenth of the radius; expected a "
        "thin gap: common are radial clearances of 0.0005 to 0.002 radii");
}

TEST_CASE("PressuresBelowCavitation_AreReported") {
  CHECK(
      faults_after("    lubricant: oil\n",
                   "    lubricant: oil\n    cavitation: {model: reynolds, pressure: 1 bar}\n    edge_pressure: 1 bar\n"
                   "    supply: {line: 0 deg, pressure: 0.5 bar}\n") ==
      "m.yaml:32:37: bearings.big_end.supply.pressure: 50000 Pa, below the cavitation pressure 100000 Pa; expected at "
      "least the cavitation pressure, on the same scale; with gauge pressures, cavitation is often near -1 bar");
}

TEST_CASE("MissingModulus_PointsAtTheMaterials") {
  CHECK(faults_after("    lubricant: oil\n", "    lubricant: oil\n    compliance: column\n") ==
        "m.yaml:30:5: bearings.big_end.compliance: missing key 'composite_modulus'; expected an elastic modulus > 0, "
        "such as 57 GPa; or give the bearing's materials");
}

TEST_CASE("AngleWithoutCrank_NamesTheMissingKey") {
  CHECK(faults_after("  crank: main\n", "") ==
        "m.yaml:31:13: simulation.duration: an angle; expected a time, or a crank that converts angles to times; add "
        "simulation.crank with the name of a driven revolute joint\n"
        "m.yaml:32:9: simulation.step: an angle; expected a time, or a crank that converts angles to times; add "
        "simulation.crank with the name of a driven revolute joint");
}

TEST_CASE("CrankWithoutDrive_IsReported") {
  CHECK(
      faults_after("speed: \"${speed}\"", "position: 0 deg") ==
      "m.yaml:31:10: simulation.crank: joint 'main', which no drive rotates at a constant speed; expected a joint with "
      "a drive such as {joint: main, coordinate: rotation, speed: 3570 rpm}");
  CHECK(faults_after("crank: main", "crank: guide") ==
        "m.yaml:31:10: simulation.crank: joint 'guide', which is not revolute; expected a revolute joint");
}

TEST_CASE("ImpossibleCycles_AreReported") {
  CHECK(faults_after("duration: 2 rev", "cycle: {period: 360.5 deg}") ==
        "m.yaml:32:19: simulation.cycle.period: a cycle of 360.5 steps; expected a whole number of steps; change the "
        "step, or let steps be chosen with step: {tolerance: 1e-4}");
  CHECK(
      faults_after("duration: 2 rev", "cycle: {until_converged: 1}") ==
      "m.yaml:32:3: simulation.cycle: missing key 'period'; expected a time or an angle > 0, such as 720 deg, or "
      "{about}\n"
      "m.yaml:32:28: simulation.cycle.until_converged: '1'; expected a number without unit >= 0 and < 1, such as 0.01");
  CHECK(faults_after("duration: 2 rev", "duration: 2 rev\n  checkpoint: {every: 0 s}") ==
        "m.yaml:33:23: simulation.checkpoint.every: '0 s'; expected a time or an angle > 0, such as 0.1 s");
}

TEST_CASE("ImpossibleSteps_AreReported") {
  CHECK(faults_after("step: 1 deg", "step: 3 rev") ==
        "m.yaml:33:9: simulation.step: a step longer than the run; expected a step of at most the duration");
  CHECK(faults_after("step: 1 deg", "analysis: dynamics") ==
        "m.yaml:30:1: simulation: missing key 'step'; expected a time or an angle > 0, such as 0.1 ms, or {tolerance}");
  CHECK(faults_after("step: 1 deg", "step: {tolerance: 1e-4, smallest: 1 ms, largest: 0.5 ms}") ==
        "m.yaml:33:37: simulation.step.smallest: a smallest step longer than the largest; expected at most the largest "
        "step");
  CHECK(faults_after("step: 1 deg", "step: {tolerance: 2}") ==
        "m.yaml:33:21: simulation.step.tolerance: '2'; expected a number without unit >= 1e-12 and <= "
        "0.1, such as 1e-4");
  CHECK(faults_after("step: 1 deg", "step: 1 deg\noutput: {interval: 1 ms}") ==
        "m.yaml:34:20: output.interval: an interval with a fixed step; expected an error control, such as step: "
        "{tolerance: 1e-4}; with a fixed step, `every` counts the steps between rows");
  CHECK(faults_after("step: 1 deg", "step: 1 deg\n  smallest_step: 1 s") ==
        "m.yaml:34:18: simulation.smallest_step: a smallest step longer than the step; expected at most the step");
}

TEST_CASE("TwoDrivesOfOneCoordinate_AreReported") {
  CHECK(faults_after("forces:", "  second: {joint: main, coordinate: rotation, position: 0}\nforces:") ==
        "m.yaml:18:3: drives.second: a second drive of main.rotation; expected one drive per coordinate; the other is "
        "'motor'");
}

TEST_CASE("DriveInTheWrongUnit_IsReported") {
  CHECK(faults_after("speed: \"${speed}\"", "position: 5 mm")
            .starts_with("m.yaml:17:56: drives.motor.position: a length; expected an angle, such as 90 deg"));
}

TEST_CASE("AllFaults_AreReportedTogether") {
  std::string text = edited(good_model, "diameter: 45 mm", "diamter: 45 mm");
  text = edited(text, "viscosity: 15 mPa.s", "viscosity: 15 mPa");
  text = edited(text, "mass: 2 kg", "mass: 2 m");
  text = edited(text, "journal: shaft.pin", "journal: shaft.pni");
  text = edited(text, "step: 1 deg", "step: 1 K");
  try {
    (void)read_text(text, "m.yaml");
    FAIL("accepted");
  } catch (const InputError& error) {
    std::vector<int> lines;
    for (const Fault& fault : error.faults()) lines.push_back(fault.position.line);
    CHECK(lines == std::vector<int>{12, 21, 25, 26, 33});
  }
}

TEST_CASE("MisspelledKey_IsOneFault") {
  // The key that is missing for it, and all that refers to what stands in it, follow from it.
  const auto only = [](const std::string& from, const std::string& to, const std::string& fault) {
    const std::string faults = faults_after(from, to);
    CAPTURE(faults);
    CHECK(faults.find(fault) != std::string::npos);
    CHECK(std::count(faults.begin(), faults.end(), '\n') == 0);
  };
  only("    diameter: 45 mm", "    diamter: 45 mm", "unknown key 'diamter'; did you mean 'diameter'?");
  only("bodies:", "bodise:", "m.yaml:6:1: unknown key 'bodise'; did you mean 'bodies'?");
  only("    frames:", "    farmes:", "unknown key 'farmes'; did you mean 'frames'?");
  only("lubricants:", "lubricnats:", "unknown key 'lubricnats'; did you mean 'lubricants'?");
  only("simulation:", "simulaton:", "unknown key 'simulaton'; did you mean 'simulation'?");
  // What is wrong besides stays, within it too where it was said before.
  const std::string two =
      faults_of(edited(edited(good_model, "diameter: 45 mm", "diamter: 45 mm"), "mass: 2 kg", "mass: 2 m"));
  CHECK(two.find("bodies.rod.mass: a length") != std::string::npos);
  CHECK(std::count(two.begin(), two.end(), '\n') == 1);
  // A key that is there already is not what is meant.
  const std::string both = faults_after("    diameter: 45 mm", "    diameter: 45 s\n    diamter: 45 mm");
  CHECK(both.find("bearings.big_end.diameter: a time") != std::string::npos);
  CHECK(both.find("unknown key 'diamter'") != std::string::npos);
}

TEST_CASE("WrongUnitOfAParameter_LeadsToIt") {
  CHECK(faults_after("speed: 3000 rpm", "speed: 3000 mm") ==
        "m.yaml:5:10: parameters.speed: a length (mm), used in line 17 by drives.motor.speed; expected an angular "
        "velocity or a velocity, such as 3570 rpm");
  // Where another use takes the value, the use is wrong.
  const std::string twice = edited(good_model, "mass: 2 kg", "mass: \"${load}\"");
  CHECK(faults_of(twice).find("m.yaml:12:15: bodies.rod.mass: a force (N) (from parameter load in line 4)") !=
        std::string::npos);
  // Several uses that all want the same are one fault.
  std::string lengths = edited(good_model, "load: 500 N", "load: 500 N\n  size: 5 kg");
  lengths = edited(lengths, "diameter: 45 mm", "diameter: \"${size}\"");
  lengths = edited(lengths, "width: 15.6 mm", "width: \"${size}\"");
  lengths = edited(lengths, "radial_clearance: 34 um", "radial_clearance: \"${size}\"");
  const std::string merged = faults_of(lengths);
  CHECK(
      merged.starts_with("m.yaml:5:9: parameters.size: a mass (kg), used in line 27 by bearings.big_end.diameter and "
                         "at 2 more places; expected a length > 0"));
  CHECK(std::count(merged.begin(), merged.end(), '\n') == 0);
}

TEST_CASE("WrongIndentation_IsToldWithWhatIsAllowed") {
  CHECK(faults_after("    width: 15.6 mm", "     width: 15.6 mm") ==
        "m.yaml:27:6: 'width' indented by 5 spaces, deeper than 'diameter' in line 26, which has a value already; "
        "expected 4 spaces, as 'diameter' in line 26, or 2 spaces, as 'big_end' in line 23, or no spaces, as "
        "'bearings' in line 22; keys that belong together stand exactly below each other");
  CHECK(faults_after("    width: 15.6 mm", "   width: 15.6 mm")
            .starts_with("m.yaml:27:4: 'width' indented by 3 spaces; expected 4 spaces, as 'diameter' in line 26, or 2 "
                         "spaces, as 'big_end'"));
  CHECK(faults_after("simulation:", " simulation:").starts_with("m.yaml:30:2: 'simulation' indented by 1 space; "));
  // A colon that does not fit for another reason.
  CHECK(faults_after("title: Test", "title: Test: more").find("a ':' that does not fit here") != std::string::npos);
  CHECK(faults_after("title: Test", "title: Test: more").find("indented") == std::string::npos);
}

TEST_CASE("UnreadableFiles_AreReported") {
  CHECK_THROWS_WITH_AS((void)read("/nonexistent/m.yaml"),
                       "/nonexistent/m.yaml: no readable file; expected a model file", InputError);
  CHECK_THROWS_WITH_AS((void)read(hersey::source_dir()),
                       (std::string(hersey::source_dir()) + ": a directory; expected a model file").c_str(),
                       InputError);
}

}  // namespace read_fault_test
}  // namespace hersey::model
