#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "hersey/model/written.h"
#include "model_text.h"

namespace hersey::model {
namespace override_test {

double push_force(const std::vector<std::string>& overrides) {
  return read_text(good_model, "m.yaml", overrides).forces[0].as<BodyLoad>()->functions[1].value->value({});
}

TEST_CASE("Parameters_AreReplacedFromOutside") {
  CHECK(push_force({}) == -500);
  CHECK(push_force({"load=2 kN"}) == -2000);
  CHECK(push_force({"load=500N", "load=800N"}) == -800);  // the last one counts
  CHECK(push_force({"parameters.load=3 kN"}) == -3000);
}

TEST_CASE("NegatedParameter_MayBeNegativeItself") {
  CHECK(push_force({"load=-300 N"}) == 300);
  CHECK(push_force({"load=+300 N"}) == -300);
}

TEST_CASE("KeyPaths_AreReplacedFromOutside") {
  const Model model = read_text(good_model, "m.yaml",
                                {"bearings.big_end.grid.circumferential=120", "bearings.big_end.diameter=50 mm",
                                 "title=Another", "bearings.big_end.edge_pressure={left: 1 bar, right: 2 bar}",
                                 "forces.push.components.0=7 N", "gravity=0 0 -9.81 m/s^2"});
  CHECK(model.bearings[0].film.grid.n_phi == 120);
  CHECK(model.bearings[0].film.grid.n_z == 13);
  CHECK(model.bearings[0].film.R == doctest::Approx(0.025).epsilon(1e-15));  // round-off of units
  CHECK(model.bearings[0].film.edge_right.pressure == 2e5);
  CHECK(model.title == "Another");
  CHECK(model.forces[0].as<BodyLoad>()->functions[0].value->value({}) == 7);
  CHECK(model.gravity.z() == -9.81);
}

TEST_CASE("AnOverride_MayUseParameters") {
  const Model model = read_text(good_model, "m.yaml", {"forces.push.components.0=${load}"});
  CHECK(model.forces[0].as<BodyLoad>()->functions[0].value->value({}) == 500);
}

TEST_CASE("Parameters_MayUseThoseAbove") {
  const std::string text = edited(edited(good_model, "  speed: 3000 rpm", "  half: \"-${load}\"\n  speed: 3000 rpm"),
                                  "components: [0 N,", "components: [\"${half}\",");
  CHECK(read_text(text, "m.yaml").forces[0].as<BodyLoad>()->functions[0].value->value({}) == -500);
}

TEST_CASE("ParametersInsideText_AreReplaced") {
  const std::string text = edited(edited(good_model, "title: Test", "title: Test at ${load}, ${speed}"),
                                  "[0 N, \"-${load}\", 0 N]", "[0 N, {expression: \"-${amount}*t\", unit: N}, 0 N]");
  const Model model = read_text(edited(text, "  load: 500 N", "  load: 500 N\n  amount: 25"), "m.yaml");
  CHECK(model.title == "Test at 500 N, 3000 rpm");
  CHECK(model.forces[0].as<BodyLoad>()->functions[1].value->value(std::array{2.0}) == -50);
}

TEST_CASE("ParametersInsideVectors_KeepTheirUnit") {
  const std::string text = edited(edited(good_model, "  load: 500 N", "  load: 500 N\n  g: 981 cm/s^2"),
                                  "bodies:", "gravity: 0 -${g} 0 m/s^2\nbodies:");
  CHECK((read_text(text, "m.yaml").gravity - Vector3(0, -9.81, 0)).norm() < 1e-15);  // round-off of units
}

/// The model with a force in x written so, and parameters above the others.
std::string with_force_in_x(const std::string& force, const std::string& parameters) {
  return edited(edited(good_model, "  load: 500 N", parameters + "  load: 500 N"), "[0 N, \"-${load}\"",
                "[" + force + ", \"-${load}\"");
}

double force_in_x(const std::string& force, const std::string& parameters, double t = 0) {
  const Model model = read_text(with_force_in_x(force, parameters), "m.yaml");
  const Function& function = model.forces[0].as<BodyLoad>()->functions[0];
  const std::vector<double> x(function.variables.size(), t);
  return function.value->value(x);
}

TEST_CASE("ParametersInExpressions_StandInParentheses") {
  const auto value = [](const std::string& expression, const std::string& a, double t = 0) {
    return force_in_x("{expression: \"" + expression + "\", unit: N}", "  a: \"" + a + "\"\n", t);
  };
  CHECK(value("2-${a}*1", "-3") == 5);
  CHECK(value("10-${a}^2", "-3") == 1);
  CHECK(value("${a}^2", "-3") == 9);
  CHECK(value("6/${a}", "1+2") == 2);
  CHECK(value("-${a}", "-3") == 3);
  CHECK(value("-${a}", "+3") == -3);
  CHECK(value("2*${a}", "t-1", 3) == 4);
  CHECK(value("${a}", "1+2") == 3);
}

TEST_CASE("ParametersInQuantities_FollowArithmetic") {
  const auto value = [](const std::string& quantity, const std::string& a) {
    return force_in_x("\"" + quantity + "\"", "  a: \"" + a + "\"\n");
  };
  CHECK(value("${a} N", "3") == 3);
  CHECK(value("${a} kN", "1+2") == 3000);
  CHECK(value("-${a}", "-3 N") == 3);
  CHECK(value("-${a}", "3 N") == -3);
  CHECK(value("10 N-${a}", "-3 N") == 13);
  CHECK(value("6 N/${a}", "1+2") == 2);
  CHECK(value("2*${a}", "1 N + 2 N") == 6);
  CHECK(value("${a}", "1 N + 2 N") == 3);
  CHECK(value("${a}^2*1 N", "-3") == 9);
  CHECK(value("5 ${a}", "kN") == 5000);
}

TEST_CASE("DerivedParameters_CarryTheirUnits") {
  const std::string parameters =
      "  D: 50 mm\n  psi: 1e-3\n  c: \"${psi}*${D}/2\"\n  area: \"pi/4*${D}^2\"\n  p: 2 MPa\n  push: \"${p}*${area}\"\n"
      "  strength: \"${push}/1 N\"\n  nodes: 12\n  twice: \"2*${nodes}\"\n";
  const double push = 2e6 * std::numbers::pi / 4 * 0.0025, eps = std::numeric_limits<double>::epsilon();
  CHECK(force_in_x("\"-${push}\"", parameters) == doctest::Approx(-push).epsilon(16 * eps));
  // Divided by its unit it is a number and may be part of expressions.
  CHECK(force_in_x("{expression: \"${strength}*t\", unit: N}", parameters, 2) ==
        doctest::Approx(2 * push).epsilon(16 * eps));
  const Model model =
      read_text(with_force_in_x("0 N", parameters), "m.yaml",
                {"bearings.big_end.radial_clearance=${c}", "bearings.big_end.grid.circumferential=${twice}"});
  CHECK(model.bearings[0].film.c == doctest::Approx(25e-6).epsilon(8 * eps));
  CHECK(model.bearings[0].film.grid.n_phi == 24);
  CHECK(model.parameters[2].text == "0.025 mm");
}

TEST_CASE("FormulasThatDoNotFit_AreReported") {
  const auto faults = [](const std::string& force, const std::string& a) {
    return faults_of(with_force_in_x(force, "  a: \"" + a + "\"\n"));
  };
  CHECK(
      faults("\"2*${a}\"", "3 mm") ==
      "m.yaml:4:6: parameters.a: a length (mm), used in line 20 by forces.push.components.0; expected a force, such as "
      "500 N");
  CHECK(faults("\"${a}+1 s\"", "3 N").find("used in line 20 by forces.push.components.0") != std::string::npos);
  CHECK(faults("{expression: \"2*${a}*t\", unit: N}", "500 N").find("parameters in expressions are bare numbers") !=
        std::string::npos);
  // A number beside a parameter is no number with it.
  CHECK(faults("\"2${a} N\"", "3") != "");
  std::string doubling = "  a0: 1\n";
  for (int i = 1; i < 40; ++i)
    doubling +=
        "  a" + std::to_string(i) + ": \"${a" + std::to_string(i - 1) + "} x ${a" + std::to_string(i - 1) + "}\"\n";
  CHECK(faults_of(with_force_in_x("\"${a39}\"", doubling)).find("longer than 65536") != std::string::npos);
}

TEST_CASE("FaultyOverrides_AreNamed") {
  CHECK(faults_of(good_model, {"load"}) == "--set: 'load'; expected name=value, such as load=500N");
  CHECK(faults_of(good_model, {"laod=3 N"}) ==
        "--set: unknown name 'laod'; did you mean 'load'? expected a parameter (load or speed) or a key path such as "
        "simulation.duration");
  CHECK(faults_of(good_model, {"bearing.big_end.diameter=3 mm"}) ==
        "--set: unknown name 'bearing.big_end.diameter'; did you mean 'bearings'? expected a parameter (load or speed) "
        "or a key path such as simulation.duration");
  CHECK(faults_of(good_model, {"bearings.big_end.diamter=3 mm"})
            .starts_with("--set: bearings.big_end: unknown key 'diamter'; did you mean 'diameter'? expected shell,"));
  CHECK(faults_of(good_model, {"bearings.big_end.diameter=3 s"}) ==
        "--set: bearings.big_end.diameter: a time (s); expected a length > 0, such as 45 mm");
  CHECK(faults_of(good_model, {"forces.push.components.7=3 N"}) ==
        "--set: forces.push.components.7: no item '7'; expected the number of an item, from 0");
  CHECK(faults_of(good_model, {"bearings.big_end.grid={axial: 3"}) ==
        "--set: bearings.big_end.grid: a '{' without its '}'; expected valid YAML");
  CHECK(faults_of(good_model, {"bearings.big_end.diameter="}) ==
        "--set: bearings.big_end.diameter: nothing; expected a length > 0, such as 45 mm");
}

TEST_CASE("FaultyParameter_IsReportedWhereItIsGiven") {
  CHECK(
      faults_of(good_model, {"load=5 kPa"}) ==
      "m.yaml:19:52: forces.push.components.1: a pressure (kPa) (from parameter load set by --set); expected a force, "
      "such as 500 N");
  CHECK(faults_after("load: 500 N", "load: 5 kPa") ==
        "m.yaml:4:9: parameters.load: a pressure (kPa), used in line 19 by forces.push.components.1; expected a force, "
        "such as 500 N");
}

TEST_CASE("UnknownParameter_IsReportedOnce") {
  CHECK(faults_after("\"-${load}\"", "\"-${laod}\"") ==
        "m.yaml:19:52: forces.push.components.1: unknown parameter 'laod'; did you mean 'load'? expected one of the "
        "parameters load or speed");
  CHECK(faults_after("\"-${load}\"", "\"-${load\"") ==
        "m.yaml:19:52: forces.push.components.1: '-${load'; expected a closing } after ${");
}

TEST_CASE("ResolvedText_NamesTheOverrides") {
  const Model model = read_text(good_model, "m.yaml", {"load=800 N", "title=New"});
  CHECK(model.resolved_text == "# --set load=800 N\n# --set title=New\n" + good_model);
  CHECK(read_text(good_model, "m.yaml").resolved_text == good_model);
}

TEST_CASE("WrittenValues_AreThoseOfOverridesAndParameters") {
  const auto at = [](const std::string& path, const std::vector<std::string>& overrides = {}) {
    return written_json(good_model, "m.yaml", overrides, path);
  };
  CHECK(at("parameters.load") == "\"500 N\"");
  CHECK(at("forces.push.components.1", {"load=800 N"}) == "\"-800 N\"");  // reads without its parameter
  CHECK(at("bearings.big_end.grid", {"bearings.big_end.grid={axial: 9}"}) == "{\"axial\":\"9\"}");
  CHECK_THROWS_WITH_AS((void)at("bearings.big_end.widht"), doctest::Contains("did you mean 'width'?"), InputError);
  CHECK_THROWS_AS((void)at("forces.push.components.7"), InputError);
}

}  // namespace override_test
}  // namespace hersey::model
