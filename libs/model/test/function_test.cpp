#include <array>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "model_text.h"

namespace hersey::model {
namespace function_test {

constexpr double pi = std::numbers::pi;

/// The good model with its force along y replaced by `function`, which starts in line 19, column 52.
std::string with_force(const std::string& function) { return edited(good_model, "\"-${load}\"", function); }

Function force_of(const std::string& function) {
  return read_text(with_force(function), "m.yaml").forces[0].as<BodyLoad>()->functions[1];
}

/// A folder of its own for a model with its table, removed at the end.
class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / "hersey_function_test") {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { std::filesystem::remove_all(path_); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(path_ / name) << text; }

  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }

  /// The faults of the good model with a force from `gas.csv`, the folder's name left out.
  [[nodiscard]] std::string faults_with(const std::string& csv) const {
    write("gas.csv", csv);
    write("m.yaml", with_force("{table: {file: gas.csv, x: angle, y: pressure}, over: main.rotation, "
                               "period: 720 deg, scale: 100 mm^2}"));
    try {
      (void)read(file("m.yaml"));
    } catch (const InputError& error) {
      std::string text = error.what();
      const std::string prefix = path_.string() + "/";
      for (auto at = text.find(prefix); at != std::string::npos; at = text.find(prefix)) text.erase(at, prefix.size());
      return text;
    }
    return "no fault";
  }

 private:
  std::filesystem::path path_;
};

TEST_CASE("Constant_HasNoVariables") {
  const Function force = force_of("3 kN");
  CHECK(force.is_constant());
  CHECK(force.value->value({}) == 3000);
  CHECK(force.path == "forces.push.components.1");
}

TEST_CASE("Expression_MayContainTimeAndJoints") {
  const Function force = force_of("{expression: \"2*t + 3*main.rotation + guide.x_rate\", unit: kN}");
  REQUIRE(force.variables.size() == 3);
  CHECK(force.variables[0].kind == Variable::Kind::time);
  CHECK(force.variables[1].kind == Variable::Kind::coordinate);
  CHECK(force.variables[1].joint == "main");
  CHECK(force.variables[1].coordinate == "rotation");
  CHECK(force.variables[2].kind == Variable::Kind::rate);
  CHECK(force.variables[2].coordinate == "x");
  CHECK(force.value->value(std::array{1.0, 2.0, 0.5}) == doctest::Approx(8500).epsilon(1e-14));  // round-off of units
}

TEST_CASE("FaultyExpressions_AreLocated") {
  // The expression's first letter is in column 66.
  CHECK(faults_of(with_force("{expression: \"2*sim(t)\", unit: N}")) ==
        "m.yaml:19:68: forces.push.components.1.expression: unknown function 'sim'; did you mean 'sin'? expected sin, "
        "cos, tan, asin, acos, atan, atan2, sinh, cosh, tanh, exp, ln, log10, sqrt, abs, sign, min or max");
  CHECK(faults_of(with_force("{expression: \"2*main.rotatoin\", unit: N}")) ==
        "m.yaml:19:68: forces.push.components.1.expression: unknown name 'main.rotatoin'; did you mean "
        "'main.rotation'? expected t, main.rotation, main.rotation_rate, guide.x, guide.x_rate, guide.y, guide.y_rate, "
        "guide.rotation or guide.rotation_rate");
  CHECK(
      faults_of(with_force("{expression: \"2*(t\", unit: N}")) ==
      "m.yaml:19:70: forces.push.components.1.expression: a parenthesis is not closed; expected an expression such as "
      "100*sin(2*pi*50*t)");
  CHECK(faults_of(with_force("{expression: 1/t, unit: N}")) ==
        "m.yaml:19:65: forces.push.components.1.expression: '1/t', which is inf at the start; expected a finite value");
  CHECK(faults_of(with_force("{expression: 2*t, unit: m}")) ==
        "m.yaml:19:76: forces.push.components.1.unit: a length (m); expected a unit of force, such as N");
  CHECK(faults_of(with_force("{expresion: 2*t, unit: N}")) ==
        "m.yaml:19:53: forces.push.components.1: unknown key 'expresion'; did you mean 'expression'? expected "
        "expression, table or fmu");
  CHECK(
      faults_of(with_force("{value: 3}")) ==
      "m.yaml:19:52: forces.push.components.1: a mapping without any of the keys expression, table or fmu; expected a "
      "constant such as 500 N, an expression, a table or the output of an FMU");
}

TEST_CASE("Drive_DependsOnTimeAlone") {
  const std::string swing =
      "  swing: {joint: guide, coordinate: rotation, position: {expression: \"5*sin(t)\", unit: deg}}\nforces:";
  const Model model = read_text(edited(good_model, "forces:", swing), "m.yaml");
  // Round-off of units.
  CHECK(model.drives[1].motion.value->value(std::array{pi / 2}) == doctest::Approx(5 * pi / 180).epsilon(1e-14));
  CHECK(faults_after("forces:",
                     "  x: {joint: guide, coordinate: x, position: {expression: main.rotation, unit: m}}\nforces:") ==
        "m.yaml:18:46: drives.x.position: a drive that depends on main.rotation; expected a function of time alone");
}

TEST_CASE("InlineTable_IsConvertedAndScaled") {
  const Function force =
      force_of("{table: {x_unit: ms, y_unit: bar, points: [[0, 1], [100, 3]]}, scale: 2 cm^2, interpolation: linear}");
  REQUIRE(force.variables.size() == 1);
  CHECK(force.variables[0].kind == Variable::Kind::time);
  // 2 bar on 2 cm^2 are 40 N.
  // Round-off of units.
  CHECK(force.value->value(std::array{0.05}) == doctest::Approx(40).epsilon(1e-14));
  REQUIRE(force.domain.has_value());
  CHECK(force.domain->second == doctest::Approx(0.1).epsilon(1e-15));
}

TEST_CASE("TableFromFile_IsConvertedAndScaled") {
  const Folder folder;
  CHECK(folder.faults_with("# a cycle\r\nangle [deg]; pressure [bar]\r\n0; 1\r\n\r\n360; 11\r\n") == "no fault");
  const Model model = read(folder.file("m.yaml"));
  const Function& force = model.forces[0].as<BodyLoad>()->functions[1];
  REQUIRE(force.variables.size() == 1);
  CHECK(force.variables[0].joint == "main");
  CHECK_FALSE(force.domain.has_value());  // periodic: covers everything
  // 90 degrees into the first half: a quarter of the way from 1 to 11 bar, on 1 cm^2. Round-off of units and of whole
  // revolutions.
  CHECK(force.value->value(std::array{pi / 2}) == doctest::Approx(35).epsilon(1e-13));
  CHECK(force.value->value(std::array{pi / 2 + 4 * pi}) == doctest::Approx(35).epsilon(1e-13));
  CHECK(force.value->value(std::array{3 * pi}) == doctest::Approx(60).epsilon(1e-13));  // on the way back to 1 bar
}

TEST_CASE("FaultyTableFiles_AreLocated") {
  const Folder folder;
  CHECK(folder.faults_with("angle [deg], pressure [bar]\n0, 1\n360, nan\n") ==
        "gas.csv:3:6: 'nan'; expected a finite number");
  CHECK(folder.faults_with("angle [deg], pressure [bar]\n0, 1\n360, \n") ==
        "gas.csv:3:5: ''; expected a finite number");
  CHECK(folder.faults_with("angle [deg], pressure [bar]\n0, 1\n360\n") ==
        "gas.csv:3:1: 1 values; expected 2 as in the header");
  CHECK(folder.faults_with("angle [deg], pressure [bar]\n0, 1\n90, 2\n80, 3\n") ==
        "gas.csv:4:1: forces.push.components.1: an x that does not increase; expected each x greater than the one "
        "before");
  CHECK(folder.faults_with("angle [deg], pressure [bar]\n0, 1\n720, 2\n") ==
        "gas.csv:3:1: forces.push.components.1: a last value that differs from the first, one period before; expected "
        "the same value");
  CHECK(folder.faults_with("") == "gas.csv:1:1: no rows; expected a line of column names, then rows of numbers");
  CHECK(folder.faults_with("angle [deg], presure [bar]\n0, 1\n") ==
        "m.yaml:19:89: forces.push.components.1.table.y: no column 'pressure' in gas.csv; did you mean 'presure'? "
        "expected angle or presure");
  CHECK(folder.faults_with("angle, pressure [bar]\n0, 1\n") ==
        "m.yaml:19:79: forces.push.components.1.table.x: a number without unit; expected a unit of angle, such as deg");
  CHECK(folder.faults_with("angle [s], pressure [bar]\n0, 1\n") ==
        "m.yaml:19:79: forces.push.components.1.table.x: a time (s); expected a unit of angle, such as deg");
  CHECK(folder.faults_with("angle [deg], pressure [K]\n0, 1\n") ==
        "m.yaml:19:145: forces.push.components.1.scale: a quantity in (K).(mm^2); expected a unit of force, such as N");
  CHECK(folder.faults_with("angle [deg], pressure [bar]\n0, 1\n800, 1\n") ==
        "m.yaml:19:53: forces.push.components.1.table: a table longer than its period; expected x within one period");
}

TEST_CASE("MissingTableFile_IsReported") {
  CHECK(faults_of(with_force("{table: {file: nosuch.csv, x: a, y: b}}")) ==
        "m.yaml:19:67: forces.push.components.1.table.file: no readable file nosuch.csv; expected a table beside the "
        "model file");
}

TEST_CASE("FaultyInlineTables_AreLocated") {
  CHECK(
      faults_of(with_force("{table: {x_unit: s, y_unit: N, points: [[0, 1], [1, .nan]]}}")) ==
      "m.yaml:19:104: forces.push.components.1.table.points.1.1: '.nan'; expected a number without unit, such as 0.5");
  CHECK(faults_of(with_force("{table: {x_unit: s, y_unit: N, points: [[0, 1], [0, 2]]}}")) ==
        "m.yaml:19:100: forces.push.components.1: an x that does not increase; expected each x greater than the one "
        "before");
  CHECK(faults_of(with_force("{table: {x_unit: s, y_unit: N, points: [[0, 1], [1, 2]]}, over: main.rotaton}")) ==
        "m.yaml:19:116: forces.push.components.1.over: 'main.rotaton'; did you mean 'main.rotation'? expected time, "
        "main.rotation, main.rotation_rate, guide.x, guide.x_rate, guide.y, guide.y_rate, guide.rotation or "
        "guide.rotation_rate");
  CHECK(faults_of(with_force("{table: {x_unit: s, y_unit: N, points: [[0, 1], [1, 1]]}, period: 720 deg}")) ==
        "m.yaml:19:118: forces.push.components.1.period: an angle; expected a time, such as 0.1 ms");
}

TEST_CASE("ShiftedTable_BeginsLater") {
  const std::string table =
      "{table: {x_unit: deg, y_unit: N, points: [[0, 1], [90, 5], [360, 1]]}, over: main.rotation, period: 360 deg";
  const Function plain = force_of(table + "}"), shifted = force_of(table + ", shift: 120 deg}");
  for (const double angle : {0.0, 1.0, 2.5, 6.0}) {
    const double later = angle + 2 * pi / 3;
    CHECK(shifted.value->value({&later, 1}) == doctest::Approx(plain.value->value({&angle, 1})));
  }
  CHECK(faults_of(with_force(table + ", shift: 1 ms}")).find("shift: a time; expected an angle") != std::string::npos);
}

TEST_CASE("TableThatDoesNotCoverTheRun_IsReportedBeforeIt") {
  // The run lasts two revolutions at 3000 rpm: 40 ms, 720 degrees.
  CHECK(faults_of(with_force("{table: {x_unit: ms, y_unit: N, points: [[0, 1], [40, 1]]}}")) == "no fault");
  CHECK(
      faults_of(with_force("{table: {x_unit: ms, y_unit: N, points: [[0, 1], [30, 1]]}}")) ==
      "m.yaml:19:52: forces.push.components.1: a table that covers 0 to 0.03 s; expected one that covers the run, 0 to "
      "0.04 s; add points, or a period after which it repeats");
  CHECK(faults_of(with_force("{table: {x_unit: deg, y_unit: N, points: [[0, 1], [360, 1]]}, over: main.rotation}")) ==
        "m.yaml:19:52: forces.push.components.1: a table that covers 0 to 360 deg; expected one that covers the run, 0 "
        "to 720 deg; add points, or a period after which it repeats");
  CHECK(faults_of(with_force("{table: {x_unit: deg, y_unit: N, points: [[0, 1], [360, 1]]}, over: main.rotation, "
                             "period: 360 deg}")) == "no fault");
  // The range of the rod's sliding is unknown before the run.
  CHECK(faults_of(with_force("{table: {x_unit: mm, y_unit: N, points: [[0, 1], [1, 1]]}, over: guide.x}")) ==
        "no fault");
}

}  // namespace function_test
}  // namespace hersey::model
