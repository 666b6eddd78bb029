#include <filesystem>
#include <fstream>
#include <numbers>

#include "hersey/bearing/skirt.h"
#include "model_text.h"
#include "temporary_directory.h"

// A piston's skirt from the model file, and what may be wrong with it.
namespace hersey::model {
namespace skirt_model_test {

const std::string skirt = R"(hersey: 1
lubricants: {oil: {viscosity: 8 mPa.s}}
bearings:
  skirt:
    kind: skirt
    diameter: 85 mm
    length: 45 mm
    radial_clearance: 40 um
    lubricant: oil
    operating_point: {speed: -8 m/s, offset_top: 10 um, offset_bottom: 20 um}
)";

std::string with_line(const std::string& line) {
  return edited(skirt, "    lubricant: oil\n", "    lubricant: oil\n    " + line + "\n");
}
std::string with_point(const std::string& point) {
  return edited(skirt, "{speed: -8 m/s, offset_top: 10 um, offset_bottom: 20 um}", point);
}

/// The faults of a skirt with a profile from `skirt.csv`, the folder's name left out.
std::string faults_with_table(const std::string& csv,
                              const std::string& line = "shape: [{profile: table, file: skirt.csv}]") {
  const TemporaryDirectory folder;
  std::ofstream(folder / "skirt.csv") << csv;
  std::ofstream(folder / "m.yaml") << with_line(line);
  try {
    (void)read((folder / "m.yaml").string());
  } catch (const InputError& error) {
    std::string text = error.what();
    const std::string prefix = folder.path().string() + "/";
    for (auto at = text.find(prefix); at != std::string::npos; at = text.find(prefix)) text.erase(at, prefix.size());
    return text;
  }
  return "no fault";
}

/// A table over both sides, at heights -22.5 and 22.5 mm.
std::string table(const std::string& angles_of_antithrust, const std::string& top = "22.5") {
  std::string csv = "angle [deg], z [mm], opening [um]\n";
  for (const std::string& z : {std::string("-22.5"), top})
    for (const std::string& angle : {std::string("-40"), std::string("0"), std::string("40")})
      csv += angle + ", " + z + ", 3\n";
  for (const std::string& z : {std::string("-22.5"), top})
    csv += angles_of_antithrust.empty() ? "" : angles_of_antithrust + ", " + z + ", 3\n";
  return csv;
}

TEST_CASE("Skirt_IsReadWithItsTwoSides") {
  const Model model = read_text(with_line("arc_antithrust: 60 deg"), "m.yaml");
  const film::FilmModel& film = model.bearings[0].film;
  CHECK(std::holds_alternative<film::Skirt>(film.surface));
  REQUIRE(film.grid.patches.size() == 2);
  constexpr double degree = std::numbers::pi / 180;
  CHECK(film.grid.phi(0) == doctest::Approx(-40 * degree));
  CHECK(film.grid.phi(film.grid.n_phi - 1) == doctest::Approx(210 * degree));
  CHECK(film.edge_right.ambient_fill == 1);
  const Model starved = read_text(with_line("ambient_fill: {top: 0.3, bottom: 1, sides: 0.5}"), "m.yaml");
  CHECK(starved.bearings[0].film.edge_right.ambient_fill == 0.3);
  CHECK(starved.bearings[0].film.ends[1].last.ambient_fill == 0.5);
}

TEST_CASE("OilOfASkirt_IsReadAsLayersOfBothEdges") {
  const auto film_with = [](const std::string& line) { return read_text(with_line(line), "m.yaml").bearings[0].film; };
  const film::FilmModel both = film_with("oil: {top: 3 um, bottom: flooded, sides: flooded}");
  CHECK(both.edge_right.layer == 3e-6);
  CHECK_FALSE(both.edge_left.layer.has_value());
  CHECK(both.edge_left.ambient_fill == 1);
  CHECK(both.ends[1].first.ambient_fill == 1);
  const film::FilmModel one = film_with("oil: 20 um");
  CHECK(one.edge_right.layer.value_or(0) == doctest::Approx(20e-6));
  CHECK(one.edge_left.layer.value_or(0) == doctest::Approx(20e-6));
  CHECK(one.ends[0].last.ambient_fill == 0);
  const film::FilmModel flooded = film_with("oil: flooded");
  CHECK_FALSE(flooded.edge_right.layer.has_value());
  CHECK(flooded.ends[0].last.ambient_fill == 1);
}

TEST_CASE("OilOfASkirtThatCannotBe_IsReported") {
  const auto says = [](const std::string& line, const std::string& text) {
    const std::string faults = faults_of(with_line(line));
    CAPTURE(faults);
    CHECK(faults.find(text) != std::string::npos);
  };
  says("oil: 3 um\n    ambient_fill: 0.5", "both 'oil' and 'ambient_fill'; expected one of them");
  says("oil: {top: 3 um, bottom: 5 um}\n    edge_pressure: 1 bar",
       "a layer of oil before an edge that is not at the cavitation pressure");
  says("oil: 3 um\n    cavitation: reynolds", "a layer of oil before a film that does not conserve oil");
}

TEST_CASE("PositionsOfSkirtsThatCannotBe_AreReported") {
  CHECK(faults_of(skirt) == "no fault");
  const std::string at = "m.yaml:10:";
  CHECK(faults_of(with_point("{speed: -8 m/s, offset_top: 10 um}"))
            .find("the offset of one end; expected those of both ends") != std::string::npos);
  CHECK(faults_of(with_point("{speed: -8 m/s}")).find("neither offsets nor 'side_force'") != std::string::npos);
  CHECK(faults_of(with_point("{speed: -8 m/s, offset_top: 1 um, offset_bottom: 1 um, side_force: 10 N}"))
            .find("offsets and 'side_force' together") != std::string::npos);
  CHECK(faults_of(with_point("{speed: -8 m/s, side_force: 10 N, velocity_top: 1 mm/s}"))
            .find("a velocity along an offset that is sought") != std::string::npos);
  CHECK(faults_of(with_point("{speed: -8 m/s, offset_top: 1 um, offset_bottom: 1 um, tilt: 1 mrad}"))
            .find("a tilt beside the offsets") != std::string::npos);
  CHECK(faults_of(with_point("{speed: 0 m/s, offset_top: 1 um, offset_bottom: 1 um}"))
            .find("a skirt at rest, which moves no oil") != std::string::npos);
  CHECK(faults_of(with_point("{speed: 0 m/s, offset_top: 1 um, offset_bottom: 1 um, velocity_top: 1 mm/s, "
                             "velocity_bottom: -1 mm/s}")) == "no fault");
  CHECK(faults_of(with_point("{speed: -8 m/s, offset_top: 50 um, offset_bottom: 10 um}")).starts_with(at));
  CHECK(faults_of(with_point("{speed: -8 m/s, offset_top: 50 um, offset_bottom: 10 um}"))
            .find("a skirt that touches the liner") != std::string::npos);
}

TEST_CASE("SkirtsThatCannotBe_AreReported") {
  CHECK(faults_of(edited(skirt, "radial_clearance: 40 um", "radial_clearance: 40 mm"))
            .find("a clearance of more than a tenth of the radius") != std::string::npos);
  CHECK(faults_of(with_line("shape: [{profile: barrel, top: 30 um, bottom: 20 um, apex: 30 mm}]"))
            .find("a widest place 30 mm from the middle") != std::string::npos);
  CHECK(faults_of(with_line("edge_pressure: closed")).find("closed edges: the pressure is given nowhere") !=
        std::string::npos);
}

TEST_CASE("ProfilesOfSkirtsThatCannotBe_AreReported") {
  const std::string path = "bearings.skirt.shape.0.file: ";
  CHECK(faults_with_table(table("180")) == "no fault");
  CHECK(faults_with_table(table("180", "40")) ==
        "skirt.csv:5:1: " + path +
            "z = 40 mm, beyond the skirt's end; expected z from -22.5 to 22.5 mm, from the middle of the skirt");
  CHECK(faults_with_table(table("180", "10")).find("heights z from -22.5 to 10 mm; expected the whole width") !=
        std::string::npos);
  CHECK(faults_with_table("angle [deg], z [mm], opening [um]\n-40, 0, 1\n0, 0, 1\n30, 0, 1\n")
            .find("no angle from 40 to 140 deg, where both sides of the skirt end") != std::string::npos);
  CHECK(faults_with_table("angle [deg], z [mm], opening [um]\n-40, 0, 1\n0, 0, 1\n40, 0, 1\n0, 2, 1\n") ==
        "skirt.csv:5:1: " + path + "1 of 3 angles at this z; expected an opening for every angle at every z");
}

// A profile from a table is that of the closed form where the table has its values.
TEST_CASE("TableOfASkirt_OpensTheGapAsItSays") {
  const TemporaryDirectory folder;
  std::ofstream csv(folder / "skirt.csv");
  csv << "angle [deg], z [mm], opening [um]\n";
  for (const double z : {-22.5, 0.0, 22.5})
    for (const double angle : {-40.0, 0.0, 40.0, 140.0, 180.0, 220.0})
      csv << angle << ", " << z << ", " << 10 + z / 9 + angle / 100 << "\n";
  csv.close();
  std::ofstream(folder / "m.yaml") << with_line("shape: [{profile: table, file: skirt.csv}]");
  const Model model = read((folder / "m.yaml").string());
  const auto& kind = dynamic_cast<const bearing::PistonSkirt&>(*model.bearings[0].kind);
  const film::FilmModel& film = model.bearings[0].film;
  const Eigen::VectorXd opening = kind.opening(film);
  const film::Grid& grid = film.grid;
  CHECK(opening[grid.index(0, 0)] == doctest::Approx(7.1e-6));
  CHECK(opening[grid.index(grid.n_phi - 1, grid.n_z - 1)] == doctest::Approx(14.7e-6));
  CHECK(opening[grid.index(grid.patches[1] - 1, grid.n_z / 2)] == doctest::Approx(10.4e-6));
}

// A liner's table may lie anywhere along it.
TEST_CASE("LinerOfASkirt_IsReadFromATable") {
  const std::string line = "liner_shape: {file: skirt.csv}";
  CHECK(faults_with_table(
            "angle [deg], z [mm], opening [um]\n0, 30, 1\n90, 30, 2\n180, 30, 1\n0, 60, 1\n90, 60, 2\n180, 60, 1\n",
            line) == "no fault");
  CHECK(faults_with_table("angle [deg], z [mm], opening [um]\n0, 30, 1\n90, 30, 2\n180, 30, 1\n0, 60, 1\n", line) ==
        "skirt.csv:5:1: bearings.skirt.liner_shape.file: 1 of 3 angles at this z; expected an opening for every angle "
        "at every z");
}

}  // namespace skirt_model_test
}  // namespace hersey::model
