#include <numbers>
#include <string>

#include "hersey/film/film_model.h"
#include "model_text.h"

// A bore of arcs from the model file, and what may be wrong with it.
namespace hersey::model {
namespace arcs_test {

constexpr double degree = std::numbers::pi / 180;

std::string with_bore(const std::string& lines) {
  return R"(hersey: 1
lubricants: {oil: {viscosity: 20 mPa.s}}
bearings:
  b:
    diameter: 100 mm
    width: 50 mm
    radial_clearance: 60 um
    lubricant: oil
    )" + lines +
         "\n";
}

const film::Arcs& arcs_in(const Model& model) {
  const film::Arcs* arcs = film::arcs_of(model.bearings.at(0).film);
  REQUIRE(arcs != nullptr);
  return *arcs;
}

std::string faults_of(const std::string& lines) {
  try {
    (void)read_text(with_bore(lines), "m.yaml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no fault";
}

void check_fault(const std::string& lines, const std::string& text) {
  CAPTURE(lines);
  const std::string found = faults_of(lines);
  CAPTURE(found);
  CHECK(found.find(text) != std::string::npos);
}

TEST_CASE("BoresOfArcs_AreReadByTheirUsualNames") {
  const auto arcs = [](const std::string& bore) { return arcs_in(read_text(with_bore("bore: " + bore), "m.yaml")); };
  const film::Arcs three = arcs("{type: three_lobe, preload: 0.5, angle: -90 deg}");
  REQUIRE(three.arcs.size() == 3);
  const film::Arc& below = three.arcs[0];
  CHECK(below.from == doctest::Approx(-140 * degree));
  CHECK(below.to == doctest::Approx(-40 * degree));
  CHECK(below.thinnest == doctest::Approx(-90 * degree));
  CHECK(below.offset == doctest::Approx(60e-6));  // c_p = 120 um
  CHECK(below.extra_clearance == 0);
  CHECK(arcs("{type: four_lobe, preload: 0.2}").arcs.size() == 4);
  CHECK(arcs("{type: lobes, count: 6, preload: 0.2}").arcs.size() == 6);
  const film::Arcs half = arcs("{type: offset_half, preload: 0.5, angle: 90 deg, groove: 30 deg}");
  REQUIRE(half.arcs.size() == 2);
  for (const film::Arc& arc : half.arcs) CHECK(arc.thinnest == doctest::Approx(arc.to));
}

TEST_CASE("ArcsOneByOne_HaveClearancesAndEndsOfTheirOwn") {
  const Model model = read_text(with_bore(R"(grid: {circumferential: 72, axial: 5}
    arcs:
      b: {middle: 150 deg, arc: 60 deg, machined_clearance: 90 um, ambient_fill: {leading: 0.5, trailing: 1}}
      a: {middle: 0 deg, arc: 100 deg, preload: 0.25, offset: 0.6, radial_clearance: 75 um,
          edge_pressure: {leading: 2 bar, trailing: closed}})"),
                                "m.yaml");
  const film::FilmModel& film = model.bearings[0].film;
  const film::Arcs& arcs = arcs_in(model);
  REQUIRE(arcs.arcs.size() == 2);
  CHECK(arcs.arcs[0].name == "a");
  CHECK(arcs.arcs[0].thinnest == doctest::Approx(10 * degree));
  CHECK(arcs.arcs[0].offset == doctest::Approx(25e-6));
  CHECK(arcs.arcs[0].extra_clearance == doctest::Approx(15e-6));
  CHECK(arcs.arcs[1].offset == doctest::Approx(30e-6));
  CHECK(film.grid.patches == std::vector{0, 21});
  CHECK(film.grid.n_phi == 34);  // 100 and 60 deg by 5 deg, to four cells
  CHECK(film.ends[0].first.pressure == 2e5);
  CHECK(film.ends[0].last.kind == film::EdgeKind::closed);
  CHECK(film.ends[1].first.ambient_fill == 0.5);
  CHECK(film.ends[1].last.ambient_fill == 1);
  CHECK(!film.ends[1].last.flow);
}

TEST_CASE("OilThatReachesAnArc_IsThatOfItsEnd") {
  const Model model =
      read_text(with_bore("bore: {type: three_lobe, preload: 0.5, edge_flow: {leading: 0.6 L/min, trailing: 0 L/min}}"),
                "m.yaml");
  for (const film::PatchEnds& ends : model.bearings[0].film.ends) {
    CHECK(ends.first.flow == doctest::Approx(1e-5));  // 0.6 L/min in m^3/s
    CHECK(ends.last.flow == 0);
  }
}

TEST_CASE("GrooveOpenToAnEdgeOfAnotherPressure_IsWarnedOf") {
  const auto warnings = [](const std::string& bore) {
    return read_text(with_bore("ambient_fill: 1\n    bore: {type: three_lobe, preload: 0.5" + bore + "}"), "m.yaml")
        .warnings;
  };
  CHECK(warnings("").empty());
  const std::vector<Fault> found = warnings(", edge_pressure: 2 bar");
  REQUIRE(found.size() == 1);
  CHECK(found[0].found == "a groove at 2 bar that is open to an edge of another pressure");
}

TEST_CASE("BoresThatCannotBe_AreReported") {
  check_fault("arcs: {a: {middle: 0 deg, arc: 100 deg}, b: {middle: 90 deg, arc: 100 deg}}",
              "bearings.b.arcs.a: arc 'a' (-50 to 50 deg) overlaps 'b' (40 to 140 deg)");
  check_fault("arcs: {a: {middle: 0 deg, arc: 200 deg}, b: {middle: 180 deg, arc: 170 deg}}", "overlaps");
  check_fault("arcs: {a: {middle: 0 deg, arc: 361 deg}}", "an arc of more than 360 deg");
  check_fault("arcs: {a: {middle: 0 deg, arc: 90 deg, preload: 1}}", "a preload of 1; expected below 1");
  check_fault("arcs: {a: {middle: 0 deg, arc: 90 deg, preload: 0.1, machined_clearance: 90 um}}",
              "both 'preload' and 'machined_clearance'");
  check_fault("arcs: {a: {middle: 0 deg, arc: 300 deg, machined_clearance: 20 um}}", "arcs that close the gap");
  check_fault("bore: {type: three_lobe, preload: 0.5, groove: 130 deg}", "grooves of 130 deg, which leave nothing");
  check_fault("bore: {type: three_lobe, preload: 0.5}\n    arcs: {a: {middle: 0 deg, arc: 90 deg}}",
              "both 'bore' and 'arcs'");
  check_fault("bore: {type: three_lobe, preload: 0.5}\n    supply: {line: 90 deg}", "a supply line in a bore of arcs");
  check_fault("bore: {type: three_lobe, preload: 0.5}\n    pressures: absolute\n    edge_pressure: 1 bar",
              "absolute pressures");
  check_fault("bore: {type: three_lobe, preload: 0.5, ambient_fill: 0.5}\n    cavitation: reynolds",
              "a fill fraction in a groove");
  check_fault("bore: {type: three_lobe, preload: 0.5, ambient_fill: 0.5, edge_pressure: 1 bar}",
              "0.5 in a groove above the cavitation pressure");
  check_fault("bore: {type: three_lobe, preload: 0.5, edge_flow: 1 L/min}\n    cavitation: reynolds",
              "a flow to a film that does not conserve oil");
  check_fault("bore: {type: three_lobe, preload: 0.5, edge_flow: 1 L/min, edge_pressure: 1 bar}",
              "a flow to an edge that is not at the cavitation pressure");
  check_fault("bore: {type: three_lobe, preload: 0.5, edge_flow: 1 L/min, ambient_fill: 0.5}",
              "both 'edge_flow' and 'ambient_fill'");
  check_fault(
      "bore: {type: three_lobe, preload: 0.5}\n    features: {h: {shape: hole, angle: -30 deg, diameter: 20 mm, "
      "pressure: 1 bar}}",
      "it does not lie within one arc");
  check_fault(
      "bore: {type: three_lobe, preload: 0.5}\n    operating_point: {journal_speed: 3000 rpm, shell_speed: 10 "
      "rpm, load: 1 kN}",
      "a bore of arcs that turns under its load");
}

}  // namespace arcs_test
}  // namespace hersey::model
