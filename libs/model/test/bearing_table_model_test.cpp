#include <doctest/doctest.h>

#include <fstream>
#include <string>

#include "hersey/model/build.h"
#include "model_text.h"
#include "temporary_directory.h"

// Bearings by a table of their coefficients, in a file or in the model.
namespace hersey::model {
namespace bearing_table_model_test {

const std::string kRotor = R"(hersey: 1
bodies:
  rotor: {mass: 10 kg, inertia: {xx: 0.1 kg.m^2, yy: 0.1 kg.m^2, zz: 0.05 kg.m^2}}
joints:
  free: {type: free, between: [ground, rotor]}
forces:
  seal:
    type: bearing_table
    between: [ground, rotor]
    stiffness: {xx: 3 MN/m, xy: 2 MN/m, yx: -2 MN/m, yy: 4 MN/m}
    damping: {xx: 5 kN.s/m, yy: 6 kN.s/m}
    inertia: {xx: 2 kg, yy: 2 kg}
    force: {y: 98 N}
simulation: {duration: 1 ms, step: 0.1 ms}
)";

const std::string kHeader =
    "speed [rpm], k_xx [MN/m], kxy [N/m], k_yx [N/m], k_yy [N/m], c_xx [N.s/mm], c_yy [N.s/m], m_xx [kg], m_yy [kg], "
    "force_y [N]\n";
const std::string kRow = ", 3, 2e6, -2e6, 4e6, 5, 6e3, 2, 2, 98\n";

struct TableFile {
  TemporaryDirectory folder;
  std::string path = (folder / "seal.csv").string();

  // The rotor's text with the file in place of the coefficients.
  [[nodiscard]] std::string rotor_with(const std::string& table) const {
    std::ofstream(path) << table;
    const auto begin = kRotor.find("    stiffness:"), end = kRotor.find("simulation:");
    return kRotor.substr(0, begin) + "    file: " + path + "\n" + kRotor.substr(end);
  }
};

const mbd::BearingCoefficientTable& table_of(const Model& model) {
  return *model.forces.at(0).as<BearingTable>()->table;
}

TEST_CASE("BearingTable_MeansTheSameInAFileAndInTheModel") {
  const TableFile file;
  const Model inline_model = read_text(kRotor, "m.yaml");
  const Model by_file = read_text(file.rotor_with(kHeader + "100" + kRow + "900" + kRow), "m.yaml");
  const mbd::BearingCoefficients a = table_of(inline_model).at(3), b = table_of(by_file).at(50);
  constexpr double kUnits = 1e-14;  // of converted numbers
  CHECK((a.stiffness - b.stiffness).norm() < kUnits * a.stiffness.norm());
  CHECK((a.damping - b.damping).norm() < kUnits * a.damping.norm());
  CHECK(a.inertia == b.inertia);
  CHECK(a.force == b.force);
  CHECK(a.position == b.position);
  CHECK(a.stiffness(0, 1) == 2e6);
  CHECK(a.stiffness(1, 0) == -2e6);
  CHECK(table_of(by_file).lowest() == doctest::Approx(10.471975511965978));
  (void)build(inline_model);
  (void)build(by_file);
}

TEST_CASE("FaultsOfABearingTable_NameTheColumnOrTheKey") {
  const TableFile file;
  const auto of_table = [&](const std::string& table) { return faults_of(file.rotor_with(table)); };
  const auto has = [](const std::string& text, const std::string& part) {
    CAPTURE(text);
    CHECK(text.find(part) != std::string::npos);
  };
  has(of_table("speed [rpm], k_xx [N/m], k_yy [N/m], kk_xy [N/m]\n1, 2, 3, 4\n"), "column 'kk_xy'");
  has(of_table("speed [rpm], k_xx [N/m]\n1, 2\n"), "no column 'k_yy'");
  has(of_table("speed [rpm], k_xx, k_yy [N/m]\n1, 2, 3\n"), "column 'k_xx' in no unit");
  has(of_table("speed [rpm], k_xx [kg], k_yy [N/m]\n1, 2, 3\n"), "column 'k_xx'");
  has(of_table("speed [rpm], k_xx [N/m], k_yy [N/m], k_xx [N/m]\n1, 2, 3, 4\n"), "a second time");
  has(of_table(kHeader + "900" + kRow + "100" + kRow), "speeds that ascend");
  has(of_table(kHeader + "900" + kRow + "900" + kRow), "a speed that is not above the one before");
  has(of_table("speed [rpm], k_xx [N/m], k_yy [N/m], m_xx [kg], m_xy [kg]\n1, 2, 3, 4, 5\n"),
      "an inertia whose xy and yx differ");
  has(faults_of(edited(kRotor, "    stiffness:", "    file: seal.csv\n    stiffness:")), "'stiffness' beside a file");
  has(faults_of(edited(kRotor, "    stiffness: {xx: 3 MN/m, xy: 2 MN/m, yx: -2 MN/m, yy: 4 MN/m}\n", "")),
      "neither 'file' nor 'stiffness'");
  has(faults_of(edited(kRotor, "xx: 3 MN/m, ", "")), "missing key 'xx'");
  has(faults_of(edited(kRotor, "stiffness: {xx", "stiffness: {zz: 1 N/m, xx")), "'zz'");
}

}  // namespace bearing_table_model_test
}  // namespace hersey::model
