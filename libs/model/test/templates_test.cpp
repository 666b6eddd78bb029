#include <string>

#include "model_text.h"

namespace hersey::model {
namespace templates_test {

/// Line 3 contains the first template.
const std::string head = R"(hersey: 1
templates:
  plain:
    diameter: 50 mm
    width: 25 mm
    lubricant: oil
    radial_clearance: 30 um
  fed:
    parameters: {n, line: 90 deg, pressure: "${n}*1 bar"}
    use: plain
    supply: {line: "${line}", pressure: "${pressure}"}
lubricants: {oil: {viscosity: 15 mPa.s}}
bearings:
)";

Model read_bearings(const std::string& bearings, const std::vector<std::string>& overrides = {}) {
  return read_text(head + bearings, "m.yaml", overrides);
}

std::string faults_with(const std::string& bearings, const std::vector<std::string>& overrides = {}) {
  return faults_of(head + bearings, overrides);
}

TEST_CASE("Templates_AreReadAsTheirLongForm") {
  const Model model = read_bearings("  a: {use: {template: fed, n: 2}}\n  b: {use: plain}\n");
  const Model long_form = read_text(
      "hersey: 1\nlubricants: {oil: {viscosity: 15 mPa.s}}\nbearings:\n  a: {diameter: 50 mm, width: 25 mm, "
      "lubricant: oil, radial_clearance: 30 um, supply: {line: 90 deg, pressure: 2 bar}}\n",
      "m.yaml");
  REQUIRE(model.bearings.size() == 2);
  const film::FilmModel &film = model.bearings[0].film, &expected = long_form.bearings[0].film;
  CHECK(film.R == expected.R);
  CHECK(film.L == expected.L);
  CHECK(film.c == expected.c);
  CHECK(film.supply.phi == expected.supply.phi);
  CHECK(film.supply.pressure == expected.supply.pressure);
  CHECK(model.bearings[1].film.supply.kind == film::SupplyKind::none);
}

TEST_CASE("KeysBesideAUse_GoBeforeTheTemplates") {
  const Model model = read_bearings(
      "  a: {use: {template: fed, n: 2, line: 60 deg}, width: 30 mm, supply: {pressure: 4 bar}}\n"
      "  b:\n    use: plain\n    radial_clearance:\n    diametral_clearance: 80 um\n");
  CHECK(model.bearings[0].film.L == 0.03);
  CHECK(model.bearings[0].film.supply.pressure == 4e5);
  CHECK(model.bearings[0].film.supply.phi == doctest::Approx(1.0471975511965976).epsilon(1e-15));  // round-off of units
  CHECK(model.bearings[1].film.c == doctest::Approx(40e-6).epsilon(1e-15));                        // round-off of units
}

TEST_CASE("TemplatesAtTheTop_BringSeveralSections_AndNames") {
  const std::string text = edited(edited(good_model, "bodies:\n",
                                         "templates:\n"
                                         "  weight:\n"
                                         "    parameters: {n, mass: \"${n}*1 kg\"}\n"
                                         "    bodies:\n"
                                         "      weight_${n}: {mass: \"${mass}\"}\n"
                                         "    joints:\n"
                                         "      slide_${n}: {type: planar, between: [ground, \"weight_${n}\"]}\n"
                                         "use:\n"
                                         "  - {template: weight, n: 1}\n"
                                         "  - {template: weight, n: 2}\n"
                                         "bodies:\n"),
                                  "title: Test", "title: Two weights");
  const Model model = read_text(text, "m.yaml");
  REQUIRE(model.bodies.size() == 4);
  CHECK(model.bodies[2].name == "weight_1");
  CHECK(model.bodies[3].name == "weight_2");
  CHECK(model.bodies[3].mass == 2);
  CHECK(model.joints.size() == 4);
  CHECK(faults_of(edited(text, "weight, n: 2", "weight, n: 1")).find("a key that another use beside it has too") !=
        std::string::npos);
}

TEST_CASE("Overrides_ReachParametersTemplatesUsesAndTheirResults") {
  const std::string one = "  a: {use: {template: fed, n: 2}}\n";
  const auto film = [&](const char* change) { return read_bearings(one, {change}).bearings[0].film; };
  CHECK(film("templates.plain.width=20 mm").L == 0.02);
  CHECK(film("bearings.a.width=21 mm").L == 0.021);
  CHECK(film("bearings.a.supply.pressure=7 bar").supply.pressure == 7e5);
  CHECK(film("bearings.a.use.n=3").supply.pressure == doctest::Approx(3e5).epsilon(1e-15));  // round-off of units
  CHECK(film("templates.fed.parameters.pressure=6 bar").supply.pressure == 6e5);
  CHECK(read_bearings(one, {"bearings.b={use: plain}"}).bearings.size() == 2);
}

TEST_CASE("FaultsInTemplates_NameTheirLineAndTheUse") {
  CHECK(faults_of(edited(head, "width: 25 mm", "width: 25 s") + "  a: {use: {template: fed, n: 1}}\n") ==
        "m.yaml:5:12: bearings.a.width: a time (s); expected a length > 0, such as 20 mm (template plain, used in line "
        "10 of template fed, used in line 14)");
  const std::string of_argument = faults_with("  a: {use: {template: fed, n: 1 mm}}\n");
  CHECK(of_argument.starts_with("m.yaml:11:41: bearings.a.supply.pressure: "));
  CHECK(of_argument.find("(from parameter pressure in line 9)") != std::string::npos);
  CHECK(of_argument.ends_with("(template fed, used in line 14)"));
  CHECK(faults_of(edited(head, "pressure: \"${pressure}\"}", "pressure: \"${presure}\"}") +
                  "  a: {use: {template: fed, n: 1}}\n")
            .starts_with("m.yaml:11:41: bearings.a.supply.pressure: unknown parameter 'presure'; did you mean "
                         "'pressure'? expected one of the parameters line, n or pressure"));
}

TEST_CASE("WrongUses_AreReported") {
  CHECK(faults_with("  a: {use: {template: fde, n: 1}}\n") ==
        "m.yaml:14:23: bearings.a.use: unknown template 'fde'; did you mean 'fed'? expected plain or fed");
  CHECK(faults_with("  a: {use: fed}\n") ==
        "m.yaml:14:12: bearings.a.use.n: missing parameter 'n'; expected a value: it has no default");
  CHECK(faults_with("  a: {use: {template: fed, n: 1, lin: 3 deg}}\n") ==
        "m.yaml:14:34: bearings.a.use.lin: unknown parameter 'lin' of template 'fed'; did you mean 'line'? expected n, "
        "line or pressure");
  CHECK(faults_with("  a: {use: {n: 1}}\n").find("without the key 'template'") != std::string::npos);
  CHECK(faults_with("  a: {use: {template: fed, n: [1]}}\n") ==
        "m.yaml:14:31: bearings.a.use.n: a list; expected a number, quantity or word");
  CHECK(faults_of("hersey: 1\ntemplates: 3\nbearings: {}\n").find("a mapping from names to templates") !=
        std::string::npos);
  CHECK(faults_of(edited(head, "  plain:\n", "  plain:\n    use: fed\n") + "  a: {use: {template: fed, n: 1}}\n")
            .find("a template that uses itself: fed -> plain -> fed") != std::string::npos);
}

TEST_CASE("Bombs_AreRefused") {
  std::string text = "hersey: 1\ntemplates:\n  t0: {a: 1}\n";
  for (int i = 1; i < 40; ++i)
    text += "  t" + std::to_string(i) + ": {x: {use: t" + std::to_string(i - 1) + "}, y: {use: t" +
            std::to_string(i - 1) + "}}\n";
  CHECK(faults_of(text + "use: t39\n").find("templates that repeat more than 100000 values") != std::string::npos);
  std::string deep = "hersey: 1\ntemplates:\n  t0: {a: 1}\n";
  for (int i = 1; i < 80; ++i) deep += "  t" + std::to_string(i) + ": {x: {use: t" + std::to_string(i - 1) + "}}\n";
  CHECK(faults_of(deep + "use: t79\n").find("64 levels") != std::string::npos);
}

TEST_CASE("UnusedTemplates_AreReported") {
  const Model model = read_bearings("  a: {use: plain}\n");
  REQUIRE(model.warnings.size() >= 1);
  CHECK(model.warnings[0].path == "templates.fed");
}

TEST_CASE("MergeKeys_AddMissingKeys") {
  const std::string text =
      "hersey: 1\nlubricants: {oil: {viscosity: 15 mPa.s}}\nbearings:\n"
      "  a: &a {diameter: 50 mm, width: 25 mm, lubricant: oil, radial_clearance: 30 um}\n"
      "  b: {<<: *a, width: 20 mm}\n"
      "  c: &c {width: 22 mm, <<: *a}\n"
      "  d: {<<: [*c, *a]}\n";
  const Model model = read_text(text, "m.yaml");
  REQUIRE(model.bearings.size() == 4);
  CHECK(model.bearings[1].film.L == 0.02);
  CHECK(model.bearings[1].film.R == model.bearings[0].film.R);
  CHECK(model.bearings[3].film.L == 0.022);
  CHECK(faults_of(edited(text, "{<<: [*c, *a]}", "{<<: 3}"))
            .find("m.yaml:7:11: '3' behind the merge key '<<'; expected an alias of a mapping") != std::string::npos);
}

}  // namespace templates_test
}  // namespace hersey::model
