#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "hersey/core/input_error.h"
#include "tilting_pad_cases.h"

// Pads that bend under their films.
namespace hersey::study {
namespace elastic_pad_study_test {

const std::string steel = "bearings.main.pads.elastic={youngs_modulus: 210 GPa}";
const std::string thin = "bearings.main.pads.thickness=10 mm";

TEST_CASE("StiffPads_AreThoseThatDoNotBend") {
  constexpr double of_stiffness = 1e-4;  // a film's pressure over a modulus of 2.1e16 Pa, and the mean of four grids
  const BearingSolution rigid = solved_pads({"nu=0.5"}),
                        stiff = solved_pads({"nu=0.5", "bearings.main.pads.elastic={youngs_modulus: 2.1e16 Pa}"});
  for (const char* key : {"h_min", "p_max", "side_flow", "power_film", "pad_force_1", "pad_tilt_2", "pad_h_pivot_3"})
    CHECK(figure_of_pads(stiff, key) == doctest::Approx(figure_of_pads(rigid, key)).epsilon(of_stiffness));
  check_near(stiff.coefficients.K, rigid.coefficients.K, of_stiffness);
  check_near(stiff.coefficients.C, rigid.coefficients.C, of_stiffness);
}

TEST_CASE("PadsThatBend_HaveTheSameNumbersTurnedAndMirrored") {
  constexpr double solved_for = 1e-6;  // equations are solved to 1e-8 and better
  const BearingSolution one = solved_pads({steel, thin, "a=-80 deg", "offset=0.55"});
  const BearingSolution turned = solved_pads({steel, thin, "a=-80 deg", "offset=0.55", "turn=137 deg"});
  const BearingSolution mirrored = solved_pads({steel, thin, "a=-100 deg", "offset=0.45", "s=-3000 rpm"});
  for (const BearingSolution* other : {&turned, &mirrored}) {
    CHECK(other->numbers.eccentricity_ratio == doctest::Approx(one.numbers.eccentricity_ratio).epsilon(solved_for));
    for (const char* key : {"h_min", "p_max", "side_flow", "power_film", "pad_force_1"})
      CHECK(figure_of_pads(*other, key) == doctest::Approx(figure_of_pads(one, key)).epsilon(solved_for));
    check_near(other->coefficients.K, one.coefficients.K, solved_for);
    check_near(other->coefficients.C, one.coefficients.C, solved_for);
  }
}

// Films open towards both ends of a loaded pad that bends, as a larger circle would: it is softer, and the more so the
// thinner it is.
TEST_CASE("ThinnerPads_BendMore") {
  const BearingSolution rigid = solved_pads({"nu=0"}), thick = solved_pads({steel, "nu=0"}),
                        slender = solved_pads({steel, thin, "nu=0"});
  CHECK(thick.coefficients.K(0, 0) < rigid.coefficients.K(0, 0));
  CHECK(slender.coefficients.K(0, 0) < thick.coefficients.K(0, 0));
  const double bend = figure_of_pads(thick, "pad_bending_1"), more = figure_of_pads(slender, "pad_bending_1");
  CHECK(bend > 0);
  // A slender beam's bends with the cube of its thickness; shear and the seat's own yielding do not.
  CHECK(more / bend > 4);
  CHECK(more / bend < 8);
}

// At frequency 0 stiffness is what the force does as the journal is moved, pads follow and bend.
TEST_CASE("SlowStiffnessOfPadsThatBend_IsTheDifferenceOfForces") {
  const auto carried = [](double ratio) {
    return Eigen::Vector2d(solved_pads({steel, thin, "load=none", fmt::format("ratio={}", ratio), "nu=0"}).state.load);
  };
  constexpr double e = 0.5, step = 2e-4, c = 1e-4;
  const BearingSolution here = solved_pads({steel, thin, "load=none", fmt::format("ratio={}", e), "nu=0"});
  const Eigen::Matrix2d K = here.state.coefficients.stiffness.topLeftCorner<2, 2>();
  const Eigen::Vector2d outwards = (carried(e + step) - carried(e - step)) / (2 * step * c);
  constexpr double of_differences = 1e-3;  // coefficients are means over four grids, forces those of one
  CHECK((K * Eigen::Vector2d(0, -1) - outwards).norm() < of_differences * K.norm());
}

TEST_CASE("ShapesOfPads_ConvergeFast") {
  const auto with_modes = [](int modes) {
    return solved_pads(
        {fmt::format("bearings.main.pads.elastic={{youngs_modulus: 210 GPa, modes: {}}}", modes), thin, "nu=0"});
  };
  const BearingSolution few = with_modes(4), usual = with_modes(16), many = with_modes(32);
  const auto error = [&](const BearingSolution& of) {
    return std::abs(figure_of_pads(of, "h_min") / figure_of_pads(many, "h_min") - 1);
  };
  CHECK(error(usual) < 1e-3);  // of the thinnest film, that of the default number
  CHECK(error(usual) < error(few));
}

TEST_CASE("FaultsOfPadsThatBend_NameThePad") {
  const auto fault_of = [](const std::vector<std::string>& overrides) {
    try {
      (void)solved_pads(overrides);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(fault_of({steel, "bearings.main.pads.mass=1 kg"}).find("`mass` of pads that bend") != std::string::npos);
  CHECK(fault_of({steel, "bearings.main.pads.density=0 kg/m^3"}).find("without density") != std::string::npos);
  CHECK(fault_of({"bearings.main.pads.elastic={youngs_modulus: 210 GPa, seat: 80 mm}"}).find("outside the pad") !=
        std::string::npos);
}

}  // namespace elastic_pad_study_test
}  // namespace hersey::study
