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
            .find("a skirt whose middle is at rest") != std::string::npos);
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
