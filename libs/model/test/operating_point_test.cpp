#include <numbers>

#include "hersey/model/short_names.h"
#include "model_text.h"

namespace hersey::model {
namespace operating_point_test {

// A bearing without bodies. Line numbers matter.
const std::string bearing_alone = R"(hersey: 1
lubricants:
  oil: {viscosity: 15 mPa.s}
bearings:
  main:
    diameter: 45 mm
    width: 15 mm
    radial_clearance: 34 um
    lubricant: oil
    operating_point:
      journal_speed: 3000 rpm
      load: 500 N
)";

JournalPoint journal_point(const Model& model) { return std::get<JournalPoint>(*model.bearings.at(0).operating_point); }

TEST_CASE("BearingAlone_NeedsNoMachine") {
  const Model model = read_text(bearing_alone, "m.yaml");
  CHECK(model.is_of_bearings_alone());
  REQUIRE(model.bearings.size() == 1);
  REQUIRE(model.bearings[0].operating_point);
  const JournalPoint point = journal_point(model);
  CHECK(point.journal_speed == doctest::Approx(100 * std::numbers::pi));
  CHECK(point.shell_speed == 0);
  CHECK(point.load == 500);
  CHECK(point.load_angle == doctest::Approx(-std::numbers::pi / 2));
  CHECK_FALSE(point.eccentricity_ratio);
}

TEST_CASE("Machine_StillNeedsAllItsParts") {
  const std::string faults = faults_of(bearing_alone + "bodies:\n  rod: {mass: 2 kg}\n");
  CHECK(faults.find("missing key 'simulation'; expected simulation settings") != std::string::npos);
  CHECK(faults.find("m.yaml:5:3: bearings.main: missing key 'shell'; expected a body or body.frame, such as "
                    "rod.big_end") != std::string::npos);
  CHECK(faults.find("missing key 'journal'") != std::string::npos);
  CHECK(faults_of("hersey: 1\n").find("missing key 'bodies'") != std::string::npos);
}

std::string warnings_of(const std::string& text) {
  std::string all;
  for (const Fault& warning : read_text(text, "m.yaml").warnings) all += warning.text() + "\n";
  return all;
}

TEST_CASE("StarvedFilm_IsWarnedOf") {
  CHECK(warnings_of(bearing_alone)
            .starts_with("m.yaml:5:3: bearings.main: a film that starves: its edges are at the cavitation pressure"));
  for (const char* remedy :
       {"supply: {line: widest_gap}", "edge_pressure: 1 bar", "cavitation: {model: mass_conserving, pressure: -1 bar}",
        "cavitation: reynolds", "features: {inlet: {shape: hole, diameter: 6 mm, pressure: 2 bar}}"}) {
    CAPTURE(remedy);
    CHECK(warnings_of(edited(bearing_alone, "lubricant: oil", std::string("lubricant: oil\n    ") + remedy)).empty());
  }
  // A pocket that nothing feeds brings no oil.
  CHECK_FALSE(warnings_of(edited(bearing_alone, "lubricant: oil",
                                 "lubricant: oil\n    features: {pocket: {shape: hole, diameter: 6 mm, depth: 1 mm}}"))
                  .empty());
}

const std::string line_at_ten = "    supply: {line: 10 deg, pressure: 2 bar}\n";
const std::string line_at_widest = "    supply: {line: widest_gap, pressure: 2 bar}\n";

std::string with_feeds(const std::string& feeds) {
  return edited(bearing_alone, "    lubricant: oil\n", "    lubricant: oil\n" + feeds);
}

std::string groove(const std::string& name, const std::string& more) {
  return "      " + name + ": {shape: axial_groove, arc: 30 deg, length: 5 mm, " + more + "}\n";
}

// Regions at two pressures that touch: the flow between them has no limit as the grid is refined.
TEST_CASE("SupplyLineThroughAGroove_OfAnotherPressureIsAFault") {
  const auto faults = [](const std::string& line, const std::string& more) {
    return faults_of(with_feeds(line + "    features:\n" + groove("feed", more)));
  };
  CHECK(faults(line_at_ten, "pressure: 1 bar") ==
        "m.yaml:12:7: bearings.main.features.feed: lies on the supply line (m.yaml:10), which has another pressure; "
        "expected the same constant pressure, or another angle");
  CHECK(faults(line_at_ten, "pressure: {expression: \"2 + t\", unit: bar}").find("lies on the supply line") !=
        std::string::npos);
  for (const char* good : {"pressure: 2 bar", "angle: 30 deg, pressure: 1 bar", "depth: 1 mm"}) {
    CAPTURE(good);
    CHECK_NOTHROW(read_text(with_feeds(line_at_ten + "    features:\n" + groove("feed", good)), "m.yaml"));
  }
}

TEST_CASE("ReservoirsThatMeetAsTheJournalRotates_CauseAWarning") {
  const auto warnings = [](const std::string& feeds) { return warnings_of(with_feeds(feeds)); };
  const std::string one = groove("one", "pressure: 1 bar");
  CHECK(warnings(line_at_widest + "    features:\n" + one) ==
        "m.yaml:12:7: bearings.main.features.one: may lie under the supply line (m.yaml:10), which has another "
        "pressure; expected the same constant pressure, or that they never meet; while they do, the flow from one to "
        "the other depends on the grid\n");
  CHECK(warnings(line_at_ten + "    features:\n" + groove("one", "angle: 90 deg, on: journal, pressure: 1 bar"))
            .find("passes over the supply line (m.yaml:10)") != std::string::npos);
  CHECK(warnings("    features:\n" + one + groove("two", "angle: 180 deg, on: journal, pressure: 2 bar"))
            .find("m.yaml:12:7: bearings.main.features.two: passes over 'one' (m.yaml:11), which has another pressure, "
                  "as the journal rotates") == 0);
  for (const std::string& good : {groove("two", "angle: 180 deg, on: journal, pressure: 1 bar"),
                                  groove("two", "angle: 180 deg, on: journal, z: 5 mm, pressure: 2 bar"),
                                  groove("two", "on: journal, depth: 1 mm")})
    CHECK(warnings("    features:\n" + groove("one", "pressure: 1 bar") + good).find("passes over") ==
          std::string::npos);
}

TEST_CASE("GroovesOnEachOther_WhoseDepthsAdd_AreWarnedOf") {
  const auto warnings = [](const std::string& two) {
    return warnings_of(
        with_feeds("    features:\n" + groove("one", "pressure: 1 bar, depth: 1 mm") + groove("two", two)));
  };
  CHECK(warnings("angle: 20 deg, pressure: 1 bar, depth: 0.5 mm") ==
        "m.yaml:12:7: bearings.main.features.two: overlaps 'one' (m.yaml:11), and where both lie they are 1.5 mm deep, "
        "the sum of both; expected grooves and holes with room between them, or a depth of one of the two alone\n");
  for (const char* good : {"angle: 20 deg, pressure: 1 bar", "angle: 31 deg, pressure: 1 bar, depth: 1 mm",
                           "angle: 20 deg, z: 5 mm, pressure: 1 bar, depth: 1 mm", "on: journal, depth: 1 mm"}) {
    CAPTURE(good);
    CHECK(warnings(good).find("overlaps") == std::string::npos);
  }
}

TEST_CASE("GrooveOpenToAnEdgeOfAnotherPressure_IsWarnedOf") {
  const auto warnings = [](const std::string& edges, const std::string& more) {
    return warnings_of(
        with_feeds(edges + "    features:\n      feed: {shape: axial_groove, arc: 30 deg, " + more + "}\n"));
  };
  CHECK(warnings("", "pressure: 1 bar") ==
        "m.yaml:11:7: bearings.main.features.feed: it is open to an edge that has another pressure; expected a "
        "`length` that ends before the edge, below 15 mm, or the feature's pressure as edge_pressure; the flow from it "
        "over that edge depends on the grid and grows as that is refined\n");
  CHECK(warnings("    edge_pressure: {left: 1 bar, right: 0 bar}\n", "z: -2.5 mm, length: 10 mm, pressure: 1 bar")
            .empty());
  // 15 mm wide with cells of 1.25 mm.
  CHECK(warnings("", "length: 14 mm, pressure: 1 bar")
            .starts_with(
                "m.yaml:11:7: bearings.main.features.feed: it ends 0.5 mm from an edge that has another pressure, "
                "less than half a cell of the grid; expected grid.axial of at least 16, or cells"));
  CHECK(warnings("", "length: 13.5 mm, pressure: 1 bar").empty());
  CHECK_FALSE(warnings("    edge_pressure: {left: 1 bar, right: 0 bar}\n", "z: 2.5 mm, length: 10 mm, pressure: 1 bar")
                  .empty());
  CHECK(warnings("    edge_pressure: 1 bar\n", "pressure: 1 bar").empty());
}

TEST_CASE("UnphysicalOil_IsWarnedOf") {
  const std::string fed = edited(bearing_alone, "lubricant: oil", "lubricant: oil\n    supply: {line: widest_gap}");
  CHECK(warnings_of(fed).empty());
  const auto with = [&](const char* oil) { return warnings_of(edited(fed, "viscosity: 15 mPa.s", oil)); };
  CHECK(with("viscosity: 15 MPa.s") ==
        "m.yaml:3:20: lubricants.oil.viscosity: a viscosity of 1.5e+10 mPa.s, far from what is usual; expected about 1 "
        "mPa.s to 1 Pa.s for oils at work, 0.3 mPa.s for hot water; is it in the right unit?\n");
  CHECK(with("viscosity: 15 mPa.s, pressure_viscosity: 12 1/MPa").find("pressure_viscosity: a value") !=
        std::string::npos);
  CHECK(with("viscosity: 15 mPa.s, pressure_viscosity: {law: barus, alpha: 12 1/MPa}").find("alpha: a value") !=
        std::string::npos);
  CHECK(with("viscosity: 15 mPa.s, density: 850 g/cm^3").find("density: a value") != std::string::npos);
  CHECK(with("viscosity: 15 mPa.s, compressibility: {law: dowson_higginson, rise: 3e-9 1/Pa}")
            .find("more than doubles its density") != std::string::npos);
}

TEST_CASE("LoadAndPosition_ExcludeEachOther") {
  CHECK(faults_of(bearing_alone + "      eccentricity_ratio: 0.5\n") ==
        "m.yaml:13:7: bearings.main.operating_point.eccentricity_ratio: keys 'load' and 'eccentricity_ratio' together; "
        "expected exactly one of them; with --set, give the other one as 'none'");
  CHECK(faults_of(edited(bearing_alone, "      load: 500 N\n", "")) ==
        "m.yaml:10:5: bearings.main.operating_point: neither 'load' nor 'eccentricity_ratio'; expected exactly one of "
        "them");
  const Model model =
      read_text(bearing_alone, "m.yaml",
                {"bearings.main.operating_point.load=none", "bearings.main.operating_point.eccentricity_ratio=0.5"});
  CHECK_FALSE(journal_point(model).load);
  CHECK(journal_point(model).eccentricity_ratio == 0.5);
}

TEST_CASE("ImpossibleOperatingPoints_AreFaults") {
  CHECK(faults_of(edited(bearing_alone, "3000 rpm", "3000 rpm\n      shell_speed: -3000 rpm"))
            .find("speeds that drag no oil into the gap") != std::string::npos);
  CHECK(faults_of(bearing_alone + "      tilt_x: 1 deg\n").find("touches the shell") != std::string::npos);
  CHECK(faults_of(edited(bearing_alone, "load: 500 N", "load: -500 N")).find("a force > 0") != std::string::npos);
  for (const char* ratio : {"1", "1.005", "30"})
    CHECK(faults_of(edited(bearing_alone, "load: 500 N", std::string("eccentricity_ratio: ") + ratio))
              .find("touches the shell") != std::string::npos);
  CHECK(faults_of(edited(bearing_alone, "load: 500 N", "eccentricity_ratio: -0.1")).find(">= 0") != std::string::npos);
}

// Lobes open the bore by 10 um in the direction of the journal.
TEST_CASE("EccentricitiesAboveOne_AreReadWhereTheGapStaysOpen") {
  const std::string lobed =
      edited(bearing_alone, "    lubricant: oil\n",
             "    lubricant: oil\n    shape: [{profile: lobes, on: shell, offset: 10 um, angle: 0 "
             "deg, count: 2}]\n");
  const auto at = [&](const std::string& ratio, const std::string& angle) {
    return edited(lobed, "load: 500 N", "eccentricity_ratio: " + ratio + "\n      eccentricity_angle: " + angle);
  };
  int open = 0;
  for (const char* angle : {"0 deg", "90 deg"}) open += faults_of(at("1.05", angle)) == "no fault";
  CHECK(open == 1);  // where the lobes are deepest, and not across
}

TEST_CASE("RadialVelocity_NeedsAPosition") {
  const std::string squeeze = edited(edited(bearing_alone, "journal_speed: 3000 rpm", "journal_speed: 0 rpm"),
                                     "load: 500 N", "eccentricity_ratio: 0.5\n      radial_velocity: 20 mm/s");
  CHECK(journal_point(read_text(squeeze, "m.yaml")).radial_velocity == doctest::Approx(0.02));
  CHECK(
      faults_of(edited(bearing_alone, "load: 500 N", "load: 500 N\n      radial_velocity: 20 mm/s"))
          .find("a velocity along a position that is sought; expected a radial_velocity with an eccentricity_ratio") !=
      std::string::npos);
  CHECK(faults_of(edited(squeeze, "20 mm/s", "0 mm/s")).find("speeds that drag no oil") != std::string::npos);
}

TEST_CASE("ClosedEdges_NeedAPressureSomewhere") {
  const auto with = [](const std::string& keys) {
    return edited(bearing_alone, "lubricant: oil", "lubricant: oil\n    " + keys);
  };
  const Model model = read_text(with("edge_pressure: closed\n    supply: {line: widest_gap}"), "m.yaml");
  CHECK(film::is_closed(model.bearings[0].film));
  CHECK(model.warnings.empty());
  CHECK(faults_of(with("edge_pressure: closed")).find("closed edges and no supply: the pressure is given nowhere") !=
        std::string::npos);
  CHECK(faults_of(with("edge_pressure: closed\n    supply: {line: 0 deg}\n    ambient_fill: 0.5"))
            .find("oil outside edges that are closed") != std::string::npos);
  const film::FilmModel capped =
      read_text(with("edge_pressure: {left: closed, right: 1 bar}"), "m.yaml").bearings[0].film;
  CHECK(capped.edge_left.kind == film::EdgeKind::closed);
  CHECK(capped.edge_right.kind == film::EdgeKind::pressure);
  CHECK(capped.edge_right.pressure == 1e5);
  CHECK(faults_of(with("edge_pressure: {left: closed, right: 0 bar}\n    ambient_fill: {left: 0.5, right: 1}"))
            .find("oil outside edges that are closed") != std::string::npos);
  CHECK(faults_of(with("edge_pressure: shut")).find("expected closed or a pressure") != std::string::npos);
}

TEST_CASE("Summits_AreNoHigherThanFourTimesTheirRoughness") {
  const auto with = [](const std::string& height) {
    return edited(bearing_alone, "lubricant: oil",
                  "lubricant: oil\n    asperities: {model: greenwood_tripp, roughness: 0.5 um, mean_summit_height: " +
                      height + ", composite_modulus: 57 GPa}");
  };
  CHECK(read_text(with("1.5 um"), "m.yaml").bearings[0].film.asperities.mean_summit_height == doctest::Approx(1.5e-6));
  CHECK(faults_of(with("3 um")).find("3 um, 6 times the summits' roughness; expected at most 4 times") !=
        std::string::npos);
}

TEST_CASE("ConstantBulkModulus_IsRead") {
  const Model model = read_text(edited(bearing_alone, "{viscosity: 15 mPa.s}",
                                       "{viscosity: 15 mPa.s, compressibility: {law: constant_bulk_modulus, "
                                       "bulk_modulus: 1.7 GPa}}"),
                                "m.yaml");
  CHECK(std::get<film::ConstantBulkModulus>(model.bearings[0].film.lubricant.density_law).bulk_modulus == 1.7e9);
}

TEST_CASE("NamesOfAKind_AreThoseOfABearingOfIt") {
  const Model model = read_text(bearing_alone, "m.yaml");
  const std::optional<BearingKindNames> names = names_of_kind("journal", "main", "oil");
  REQUIRE(names);
  CHECK(names->title == "Journal bearing");
  CHECK(names->point_keys.front() == "journal_speed");
  const ShortNames of_bearing = short_names(model, model.bearings.at(0));
  CHECK(names->short_names.paths == of_bearing.paths);
  CHECK(names->short_names.load_or_position == of_bearing.load_or_position);
  CHECK(names_of_kind("", "main", "oil")->kind == "journal");
  CHECK(names_of_kind("plane_slider", "pad", "oil")->short_names.load_or_position.second == "film_thickness");
  CHECK_FALSE(names_of_kind("journall", "main", "oil"));
}

}  // namespace operating_point_test
}  // namespace hersey::model
