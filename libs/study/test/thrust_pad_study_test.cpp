#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "hersey/model/read.h"
#include "hersey/study/bearing_study.h"
#include "relative.h"

// Thrust bearings of pads on pivots by themselves: an independent solution, closed forms, and answers that must not
// depend on how a bearing is written down.
namespace hersey::study {
namespace thrust_pad_study_test {

constexpr double degree = std::numbers::pi / 180;

const std::string model_of_pads = R"(hersey: 1
parameters: {load: none, film: 30 um, nu: 1, count: 6, s: 300 rad/s, sense: positive, offset: 0.6, r: 76 mm, first: 0 deg,
             ax: 0 rad, ay: 0 rad, along: 13, radial: 9, inner: 100 mm, outer: 200 mm, crown: 0 um, form: point, t: 0.01 mm}
lubricants:
  oil: {viscosity: 20 mPa.s}
bearings:
  main:
    kind: tilting_pad_thrust
    inner_diameter: "${inner}"
    outer_diameter: "${outer}"
    pads: {count: "${count}", arc: 50 deg, offset: "${offset}", pivot_radius: "${r}", angle: "${first}", density: 0 kg/m^3,
           thickness: "${t}"}
    pivot: {type: rigid, form: "${form}"}
    sense: "${sense}"
    shape: [{profile: crown, drop: "${crown}"}]
    shear_force: none
    lubricant: oil
    grid: {along: "${along}", radial: "${radial}"}
    operating_point: {speed: "${s}", load: "${load}", film_thickness: "${film}", tilt_x: "${ax}", tilt_y: "${ay}",
                      whirl_ratio: "${nu}"}
)";

BearingSolution attempted(const std::vector<std::string>& overrides) {
  return BearingSolver().solve(model::read_text(model_of_pads, "m.yaml", overrides), {.grid_error = false});
}

/// Figures of a solved bearing, in SI.
class Figures {
 public:
  explicit Figures(const std::vector<std::string>& overrides) {
    const BearingSolution solution = attempted(overrides);
    REQUIRE_MESSAGE(solution.solved(), solution.message);
    for (const BearingFigure& f : figures_of(solution)) all_[f.key] = f.si * f.value;
    K = solution.state.coefficients.stiffness;
    C = solution.state.coefficients.damping;
  }
  double operator[](const std::string& key) const {
    REQUIRE_MESSAGE(all_.contains(key), key);
    return all_.at(key);
  }
  /// F_z, M_y and -M_x of the films on the stator, as (thrust.6) has them.
  [[nodiscard]] Eigen::Vector3d forces() const { return {-(*this)["load"], (*this)["moment_y"], -(*this)["moment_x"]}; }

  Eigen::Matrix3d K, C;

 private:
  std::map<std::string, double> all_;
};

void check_near(const Eigen::Matrix3d& found, const Eigen::Matrix3d& expected, double tolerance) {
  CAPTURE(found);
  CAPTURE(expected);
  const Eigen::Vector3d arms(1, 0.075, 0.075);  // tilts move the pads by these [m]
  const Eigen::Matrix3d difference =
      arms.cwiseInverse().asDiagonal() * (found - expected) * arms.cwiseInverse().asDiagonal();
  CHECK(difference.cwiseAbs().maxCoeff() < tolerance * std::abs(expected(0, 0)));
}

// An independent program on three grids, pads without mass, pivots in the film: numbers over the film h at the pivot.
TEST_CASE("PivotedThrustPads_MatchAnIndependentProgram") {
  constexpr double mu = 0.02, omega = 300, r_o = 0.1, h = 30e-6, of_grid = 1.2e-3;  // (1/30)^2
  const std::vector<std::string> fine{"along=41", "radial=31"};
  const Figures found(fine);
  const double load = 6 * 0.01678395 * mu * omega * std::pow(r_o, 4) / (h * h);
  CHECK(found["load"] == relative(load).epsilon(of_grid));
  CHECK(found["pad_load_3"] == relative(load / 6).epsilon(of_grid));
  CHECK(found["pad_h_pivot_2"] == relative(h).epsilon(1e-5));  // of thin pads
  CHECK(found["pad_tilt_along_1"] * r_o / h == relative(1.116087).epsilon(of_grid));
  CHECK(found["pad_tilt_across_1"] * r_o / h == relative(0.0762492).epsilon(4 * of_grid));  // a small part of the tilt
  CHECK(found["pad_h_min_5"] == relative(0.631977 * h).epsilon(of_grid));
  CHECK(found["pad_centre_r_4"] == relative(0.076).epsilon(1e-5));            // above the pivot
  CHECK(found["pad_centre_angle_4"] == relative(30 * degree).epsilon(1e-5));  // likewise
  CHECK(found["pad_flow_in_1"] == relative(0.2374607 * omega * r_o * r_o * h).epsilon(of_grid));
  CHECK(found["flow_outer"] == relative(6 * 0.0618792 * omega * r_o * r_o * h).epsilon(4 * of_grid));
  CHECK(found["power_film"] == relative(6 * 0.2056619 * mu * omega * omega * std::pow(r_o, 4) / h).epsilon(of_grid));
  CHECK(found["stiffness"] * h / load == relative(2.461597).epsilon(of_grid));
  CHECK(found["damping"] * omega * h / load == relative(2.985266).epsilon(of_grid));
  const Figures slow({"along=41", "radial=31", "nu=0"});
  CHECK(slow["damping"] * omega * h / load == relative(3.306709).epsilon(of_grid));
}

// Flat pads on rigid points: every film is a copy of every other (thrust.13), and a pad hands on what acts at its pivot
// only, so that six of them resist a tilt by half of r_p^2 times what they do along the axis (thrust.14).
TEST_CASE("SlowFlatPads_HaveTwiceTheLoadOverTheFilm") {
  for (const char* film : {"film=20 um", "film=60 um"}) {
    const Figures slow({film, "nu=0"}), fast({film, "nu=1.7"});
    CHECK(slow["stiffness"] * slow["film_thickness_axis"] / slow["load"] ==
          relative(2).epsilon(2e-6));  // of slopes of 1e-3 and less
    for (const Figures* at : {&slow, &fast}) {
      const double half = 0.5 * 0.076 * 0.076;
      check_near(at->K, Eigen::Vector3d(1, half, half).asDiagonal() * Eigen::Matrix3d::Identity() * at->K(0, 0),
                 1e-4);  // slopes of pads
      check_near(at->C, Eigen::Vector3d(1, half, half).asDiagonal() * Eigen::Matrix3d::Identity() * at->C(0, 0),
                 1e-4);  // likewise
    }
  }
}

TEST_CASE("SameThrustPads_HaveTheSameNumbersTurnedMirroredAndLarger") {
  constexpr double a = 1.2e-4, b = -0.7e-4, solved_for = 1e-6;  // equations are solved to 1e-8 and better
  const auto with = [](double ax, double ay, std::vector<std::string> more) {
    more.insert(more.begin(), {fmt::format("ax={:.17g} rad", std::atan(ax)),
                               fmt::format("ay={:.17g} rad", std::atan(ay)), "count=5", "crown=8 um"});
    return Figures(more);
  };
  const double c = std::cos(77 * degree), s = std::sin(77 * degree);
  const Figures one = with(a, b, {}), turned = with(a * c - b * s, a * s + b * c, {"first=77 deg"}),
                mirrored = with(a, -b, {"s=-300 rad/s", "sense=negative"}),
                larger =
                    with(a, b, {"inner=200 mm", "outer=400 mm", "r=152 mm", "film=60 um", "crown=16 um", "t=0.02 mm"});
  for (const auto& other : {&turned, &mirrored, &larger}) {
    const double lengths = other == &larger ? 2 : 1;
    CAPTURE(lengths);
    CHECK((*other)["load"] == relative(lengths * lengths * one["load"]).epsilon(solved_for));
    CHECK((*other)["h_min"] == relative(lengths * one["h_min"]).epsilon(solved_for));
    CHECK((*other)["p_max"] == relative(one["p_max"]).epsilon(solved_for));
    CHECK((*other)["side_flow"] == relative(std::pow(lengths, 3) * one["side_flow"]).epsilon(solved_for));
    CHECK((*other)["stiffness"] == relative(lengths * one["stiffness"]).epsilon(solved_for));
    CHECK((*other)["damping"] == relative(lengths * one["damping"]).epsilon(solved_for));
    CHECK((*other)["pad_tilt_along_1"] == relative(one["pad_tilt_along_1"]).epsilon(solved_for));
  }
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.bottomRightCorner<2, 2>() << c, -s, s, c;
  const Eigen::Vector3d mirror(1, 1, -1);
  check_near(turned.K, turn * one.K * turn.transpose(), 1e-5);  // means over grids, of slopes of 1e-4
  check_near(turned.C, turn * one.C * turn.transpose(), 1e-5);  // likewise
  check_near(mirrored.K, mirror.asDiagonal() * one.K * mirror.asDiagonal(), 1e-5);  // likewise
}

TEST_CASE("OnePad_BearsItsPartOfTheLoad") {
  const Figures all({}), one({"count=1", "film=none", fmt::format("load={:.17g} N", all["load"] / 6)});
  constexpr double solved_for = 1e-6;  // equations are solved to 1e-8 and better
  CHECK(one["film_thickness_axis"] == relative(30e-6).epsilon(solved_for));
  for (const char* key : {"pad_tilt_along_1", "pad_tilt_across_1", "pad_h_min_1", "pad_p_max_1", "pad_flow_in_1"})
    CHECK(one[key] == relative(all[key]).epsilon(solved_for));
  CHECK(6 * one["stiffness"] == relative(all["stiffness"]).epsilon(solved_for));
}

// At frequency 0 stiffness is what forces and moments do as the collar is moved and pads follow.
TEST_CASE("SlowStiffnessOfPads_IsTheDifferenceOfForces") {
  for (const char* form : {"form=point", "form=line"}) {
    CAPTURE(form);
    constexpr double a = 5e-5, dz = 1e-8, da = 2e-7;
    const auto at = [form](double z, double ax, double ay, const char* nu) {
      return Figures({form, fmt::format("film={:.17g} m", z), fmt::format("ax={:.17g} rad", std::atan(ax)),
                      fmt::format("ay={:.17g} rad", std::atan(ay)), "count=4", nu});
    };
    Eigen::Matrix3d K;
    K.col(0) = (at(40e-6 + dz, a, 0, "nu=1").forces() - at(40e-6 - dz, a, 0, "nu=1").forces()) / (2 * dz);
    K.col(1) = (at(40e-6, a + da, 0, "nu=1").forces() - at(40e-6, a - da, 0, "nu=1").forces()) / (2 * da);
    K.col(2) = (at(40e-6, a, da, "nu=1").forces() - at(40e-6, a, -da, "nu=1").forces()) / (2 * da);
    check_near(at(40e-6, a, 0, "nu=0").K, K, 1e-3);  // of slopes of pads and of differences
  }
}

// A spring below the pivot is in series with the film: a closed form with what rigid pivots have at that film.
TEST_CASE("PivotOnASpring_IsInSeriesWithTheFilm") {
  constexpr double k = 5e8;  // N/m, of each of six
  const Figures rigid({"nu=0"});
  const double travel = rigid["load"] / 6 / k;
  const std::string spring = fmt::format("bearings.main.pivot={{type: spring, stiffness: {} N/m}}", k);
  const Figures yielding({"nu=0", spring, "film=none", fmt::format("load={:.17g} N", rigid["load"])});
  constexpr double slopes = 1e-5;  // forces lean from the pivot by the pad's tilt, squared; Newton's tolerance
  CHECK(yielding["pad_pivot_travel_2"] == relative(travel).epsilon(slopes));
  CHECK(yielding["film_thickness_axis"] == relative(30e-6 - travel).epsilon(slopes));
  CHECK(yielding["pad_h_pivot_1"] == relative(30e-6).epsilon(1e-4));  // between the nodes of a coarse grid
  CHECK(1 / yielding["stiffness"] == relative(1 / rigid["stiffness"] + 1 / (6 * k)).epsilon(slopes));
}

TEST_CASE("PadsWithoutAWedge_AreReported") {
  const BearingSolution none = attempted({"offset=0.3", "film=none", "load=10 kN"});
  CHECK_FALSE(none.solved());
  CHECK(none.message.find("flat pads have no wedge where their pivots do not lie behind the middle") !=
        std::string::npos);
  const BearingSolution leaning = attempted({"ax=1 deg"});
  CHECK(leaning.message.find("a collar that leans by so much touches the pads") != std::string::npos);
}

}  // namespace thrust_pad_study_test
}  // namespace hersey::study
