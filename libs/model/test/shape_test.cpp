#include <array>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "model_text.h"
#include "temporary_directory.h"

// Shapes and pockets from the model file, and what may be wrong with them.
namespace hersey::model {
namespace shape_test {

constexpr double pi = std::numbers::pi;

std::string with_shape(const std::string& shape) {
  return edited(good_model, "    lubricant: oil\n", "    lubricant: oil\n    shape: " + shape + "\n");
}

/// The faults of the good model with a bore from `bore.csv`, the folder's name left out.
std::string faults_with(const std::string& csv) {
  const TemporaryDirectory folder;
  std::ofstream(folder / "bore.csv") << csv;
  std::ofstream(folder / "m.yaml") << with_shape("[{profile: table, file: bore.csv}]");
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

TEST_CASE("MeasuredShape_IsReadFromATable") {
  const TemporaryDirectory folder;
  std::ofstream(folder / "bore.csv") << "angle [deg], z [mm], opening [um]\n"
                                        "0, -7.8, 1\n120, -7.8, 2\n240, -7.8, 3\n"
                                        "240, 7.8, 5\n0, 7.8, 3\n120, 7.8, 4\n";
  std::ofstream(folder / "m.yaml") << with_shape("[{profile: table, file: bore.csv, on: journal}]");
  const Model model = read((folder / "m.yaml").string());
  const film::FilmModel& film = model.bearings[0].film;
  REQUIRE(film.profiles.size() == 1);
  CHECK(film.profiles[0].surface == film::Surface::journal);
  CHECK(film.profiles[0].opening(2 * pi / 3, -7.8e-3, film.L).value == doctest::Approx(2e-6));
  CHECK(film.profiles[0].opening(2 * pi / 3, 0, film.L).value == doctest::Approx(3e-6));
  CHECK(film.profiles[0].opening(4 * pi / 3 - 2 * pi, 7.8e-3, film.L).value == doctest::Approx(5e-6));
}

TEST_CASE("MeasuredShapesThatCannotBe_AreReported") {
  const std::string header = "angle [deg], z [mm], opening [um]\n", path = "bearings.big_end.shape.0.file: ";
  CHECK(faults_with(header + "0, 0, 1\n90, 0, 1\n180, 0, 1\n") == "no fault");
  CHECK(faults_with("angle [deg], z [mm], open [um]\n0, 0, 1\n") ==
        "m.yaml:30:36: " + path + "no column 'opening' in bore.csv; expected columns angle, z and opening");
  CHECK(faults_with("angle [deg], z [mm], opening [bar]\n0, 0, 1\n").find("a unit of length") != std::string::npos);
  CHECK(faults_with(header + "0, 0, 1\n90, 0, 1\n") ==
        "m.yaml:30:36: " + path + "2 angles; expected 3 or more of them");
  CHECK(faults_with(header + "0, 0, 1\n90, 0, 1\n180, 0, 1\n0, 1, 1\n") ==
        "bore.csv:5:1: " + path + "1 of 3 angles at this z; expected an opening for every angle at every z");
  CHECK(faults_with(header + "0, 0, 1\n90, 0, 1\n180, 0, 1\n90, 0, 2\n") ==
        "bore.csv:5:1: " + path + "a second opening at this angle and z; expected one for each");
  CHECK(faults_with(header + "0, 0, 1\n90, 0, 1\n360, 0, 1\n") ==
        "bore.csv:4:1: " + path +
            "angles over 360 deg or more; expected angles within 360 deg; the first follows the last");
  CHECK(faults_with(header + "0, 0, 1\n90, 0, 1\n180, 0, 1\n0, 5, 1\n90, 5, 1\n180, 5, 1\n") ==
        "m.yaml:30:36: " + path + "heights z from 0 to 5 mm; expected the whole width, -7.8 to 7.8 mm, or a single z");
  CHECK(faults_with(header + "0, 0, -20\n90, 0, -40\n180, 0, 1\n")
            .starts_with("m.yaml:30:5: bearings.big_end.shape: a shape that closes the gap by 6 um"));
}

// The journal's lobes close the gap only where they meet those of the bore.
TEST_CASE("ShapesThatMeetInSomePosition_AreReported") {
  const std::string both = "[{profile: ovality, amplitude: 20 um}, {profile: ovality, on: journal, amplitude: 20 um, ";
  CHECK(faults_after("    lubricant: oil\n", "    lubricant: oil\n    shape: " + both + "angle: 90 deg}]\n")
            .starts_with("m.yaml:30:5: bearings.big_end.shape: a shape that closes the gap by 6 um"));
}

TEST_CASE("FeatureWithoutPressureAndDepth_IsReported") {
  CHECK(
      faults_after("    lubricant: oil\n",
                   "    lubricant: oil\n    features:\n      a: {shape: hole, diameter: 5 mm}\n") ==
      "m.yaml:31:7: bearings.big_end.features.a: neither 'pressure' nor 'depth'; expected a pressure that feeds it, a "
      "depth, or both");
  // A fed hole within a pocket is no overlap of pressures, and ellipses whose boxes touch do not overlap.
  CHECK(faults_after("    lubricant: oil\n",
                     "    lubricant: oil\n    features:\n"
                     "      a: {shape: hole, diameter: 5 mm, pressure: 1 bar}\n"
                     "      b: {shape: hole, angle: 11.2 deg, z: 4.4 mm, diameter: 5 mm, pressure: 2 bar}\n"
                     "      c: {shape: pocket, arc: 30 deg, length: 6 mm, depth: 1 mm}\n") == "no fault");
}

}  // namespace shape_test
}  // namespace hersey::model
