#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "hersey/bearing/plane_slider.h"
#include "hersey/bearing/restricted_feeds.h"
#include "hersey/bearing/steady_bearing.h"
#include "relative.h"

// Recesses behind restrictors against closed forms (theory manual, chapter hydrostatic), and relations.
namespace hersey::bearing {
namespace hydrostatic_test {

constexpr double kSolved = 1e-8;       // the search ends at 1e-10 of the load and of the film's largest throughput
constexpr double kDifferences = 1e-5;  // films solved to 1e-10, over steps of 1e-5 of the gap
constexpr double kSupply = 4e6;        // 40 bar
const film::RestrictorOil kOil{.mu = 0.03, .density = 870};

const std::vector<film::RestrictorLaw>& laws() {
  static const std::vector<film::RestrictorLaw> all{
      film::Capillary{.length = 0.04, .diameter = 0.8e-3}, film::FlowResistance{2e11},  // Pa s/m^3
      film::Orifice{.diameter = 0.6e-3, .discharge_coefficient = 0.62}, film::ConstantFlow{.rate = 6e-6}};
  return all;
}

// A long pad: a recess over its whole width between two lands, closed sides.
constexpr double kLength = 0.05, kWidth = 0.04, kRecess = 0.02, kLand = 0.5 * (kLength - kRecess), kGap = 40e-6;

struct Pad {
  film::FilmModel model;
  std::shared_ptr<const PlaneSlider> kind;
  OperatingPoint point;

  [[nodiscard]] SteadyState solve() const {
    SteadyState state;
    const SteadySummary summary = solve_steady(scaled_for(model, point), point, {.kind = kind}, state);
    REQUIRE_MESSAGE(summary.solved(), summary.message);
    return state;
  }
};

Pad long_pad(const film::RestrictorLaw& law, int cells, std::vector<PadShape> shapes = {}, double speed = 0) {
  Pad pad{
      .model = {.surface = film::Plane{}, .R = 1, .L = kWidth, .c = kGap, .grid = slider_grid(kLength, cells + 1, 3)},
      .kind = std::make_shared<PlaneSlider>(kLength, std::move(shapes)),
      .point = {.journal_speed = speed, .e = Coordinates::Constant(1, -kGap), .e_rate = Coordinates::Zero(1)}};
  pad.model.lubricant.mu0 = kOil.mu;
  pad.model.edge_left.kind = pad.model.edge_right.kind = film::EdgeKind::closed;
  pad.model.ends = {{.first = {.ambient_fill = 1}, .last = {.ambient_fill = 1}}};
  pad.model.features = {{.name = "recess",
                         .phi = 0,
                         .arc = kRecess,
                         .length = kWidth,
                         .pressure = kSupply,
                         .restrictor = film::Restrictor{law, kOil}}};
  return pad;
}

// (hydrostatic.6) and (hydrostatic.7). The pressure falls evenly over both lands: the grid has it exactly.
TEST_CASE("LongPad_HasTheClosedFormsOfItsRestrictor") {
  for (const film::RestrictorLaw& law : laws()) {
    const Pad pad = long_pad(law, 50);
    const film::Restrictor restrictor{law, kOil};
    CAPTURE(std::string(restrictor.name()));
    const SteadyState state = pad.solve();
    const double p = state.film.pressure_features[0], Q = state.film.flow_features[0], W = state.load[0];
    const double land = 2 * kWidth * std::pow(kGap, 3) / (12 * kOil.mu * kLand);
    CHECK(Q == relative(land * p).epsilon(kSolved));
    // A sum over nodes of a pressure with kinks at the recess' borders.
    const SteadyState finer = long_pad(law, 100).solve();
    const double off = W / (kWidth * (kRecess + kLand) * p) - 1,
                 off_finer = finer.load[0] / (kWidth * (kRecess + kLand) * p) - 1;
    CHECK(std::abs(off) < 4e-4);                                              // (1/50)^2
    CHECK(std::abs(off_finer) == relative(std::abs(off) / 4).epsilon(0.01));  // second order, without a third
    const film::ValueAndSlope flow = restrictor.flow(kSupply - p);
    CHECK(flow.value == relative(Q).epsilon(kSolved));
    const double k = state.coefficients.stiffness(0, 0), beta = p / kSupply;
    CHECK(k == relative(3 * W / kGap / (1 + p * flow.slope / Q)).epsilon(kSolved));
    if (std::holds_alternative<film::Capillary>(law) || std::holds_alternative<film::FlowResistance>(law))
      CHECK(k == relative(3 * W * (1 - beta) / kGap).epsilon(kSolved));
    if (std::holds_alternative<film::ConstantFlow>(law)) CHECK(k == relative(3 * W / kGap).epsilon(kSolved));
    const RestrictedFeeds feeds(pad.model, state.film);
    CHECK(feeds.pressure(0) == p);
    if (!std::holds_alternative<film::ConstantFlow>(law)) {
      CHECK(feeds.pressure_ratio(0) == relative(beta).epsilon(kSolved));
      CHECK(feeds.pumping_power() == relative(kSupply * Q).epsilon(kSolved));
    } else {
      CHECK(feeds.pumping_power() == relative(p * Q).epsilon(kSolved));
    }
    CHECK(state.film.mass_balance_error < 1e-9);  // ten times the film's tolerance
    // At rest in its plane all power is the oil's: what the recess gives is dissipated on the lands.
    CHECK(state.film.power_film == relative(p * Q).epsilon(kSolved));
  }
}

// An orifice whose creeping part is negligible: k = 6 W (1 - beta)/(h (2 - beta)).
TEST_CASE("JetOfAnOrifice_GivesItsOwnStiffness") {
  Pad pad = long_pad(film::Orifice{.diameter = 0.6e-3, .discharge_coefficient = 0.62}, 50);
  pad.model.features[0].restrictor->oil.mu = 1e-9;  // a millionth of a drop of pressure
  const SteadyState state = pad.solve();
  const double beta = state.film.pressure_features[0] / kSupply;
  CHECK(state.coefficients.stiffness(0, 0) ==
        relative(6 * state.load[0] * (1 - beta) / (kGap * (2 - beta))).epsilon(1e-6));  // likewise
}

// A pad with a taper that slides over oil from its recess: load and flow of second order.
TEST_CASE("SlidingPadWithARecess_ConvergesWithOrderTwo") {
  std::array<std::array<double, 2>, 4> figures{};
  const std::array<int, 4> cells{50, 100, 200, 800};
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const SteadyState state =
        long_pad(film::Capillary{.length = 0.04, .diameter = 0.8e-3}, cells[k], {PadRamp{kGap, kLength}}, 5).solve();
    figures[k] = {state.load[0], state.film.flow_features[0]};
  }
  for (std::size_t f = 0; f < 2; ++f) {
    CAPTURE(f);
    const auto error = [&](std::size_t k) { return figures[k][f] - figures[3][f]; };
    for (const std::size_t k : {0U, 1U}) {
      const double order = std::log2(std::abs(error(k) / error(k + 1)));
      CHECK(order > 1.8);
      CHECK(order < 2.3);  // the reference has a sixteenth of the finest error
    }
  }
}

/// A journal in a bore with four recesses, turned as a whole by a multiple of the grid's step.
film::FilmModel four_recesses(const film::RestrictorLaw& law, int steps = 0) {
  film::FilmModel model{.R = 0.05, .L = 0.08, .c = 50e-6, .grid = {48, 17}};
  model.lubricant.mu0 = kOil.mu;
  for (int k = 0; k < 4; ++k)
    model.features.push_back({.name = "recess_" + std::to_string(k),
                              .phi = k * std::numbers::pi / 2 + steps * 2 * std::numbers::pi / 48,
                              .arc = std::numbers::pi / 4,
                              .length = 0.05,
                              .pressure = kSupply,
                              .restrictor = film::Restrictor{law, kOil}});
  return model;
}

SteadyState solved(const film::FilmModel& model, const OperatingPoint& point) {
  SteadyState state;
  const SteadySummary summary = solve_steady(scaled_for(model, point), point, {}, state);
  REQUIRE_MESSAGE(summary.solved(), summary.message);
  return state;
}

TEST_CASE("CentredJournalBetweenFourRecesses_IsAsStiffInEveryDirection") {
  for (const film::RestrictorLaw& law : laws()) {
    const SteadyState state = solved(four_recesses(law), {.e = Eigen::Vector2d(0, 0)});
    const Eigen::Matrix2d K = state.coefficients.stiffness.topLeftCorner<2, 2>(),
                          C = state.coefficients.damping.topLeftCorner<2, 2>();
    for (const Eigen::Matrix2d& of : {K, C}) {
      CHECK(of(0, 0) > 0);
      CHECK(of(1, 1) == relative(of(0, 0)).epsilon(kSolved));
      CHECK(std::abs(of(0, 1)) + std::abs(of(1, 0)) < kSolved * of(0, 0));
    }
  }
}

// With the recesses' pressures free at once, as quasi-static as the film.
TEST_CASE("StiffnessAndDampingWithRestrictors_AreDifferencesOfTheForce") {
  for (const film::RestrictorLaw& law : laws()) {
    CAPTURE(law.index());
    const film::FilmModel model = four_recesses(law);
    const OperatingPoint point{
        .journal_speed = 60, .e = Eigen::Vector2d(9e-6, -14e-6), .e_rate = Eigen::Vector2d(1e-4, 2e-4)};
    const SteadyState state = solved(model, point);
    for (const bool is_rate : {false, true}) {
      for (const int j : {0, 1}) {
        const auto force = [&](double step) -> Eigen::Vector2d {
          OperatingPoint side = point;
          (is_rate ? side.e_rate : side.e)[j] += step;
          return solved(model, side).load;
        };
        const double step = is_rate ? 1e-6 : 5e-10;  // of rates of 1e-4 m/s, and of the gap
        const Eigen::Vector2d numeric = (force(step) - force(-step)) / (2 * step);
        const auto& exact = is_rate ? state.coefficients.damping : state.coefficients.stiffness;
        CHECK((exact.col(j).head<2>() - numeric).norm() < kDifferences * exact.topLeftCorner<2, 2>().norm());
      }
    }
  }
}

TEST_CASE("TurnedRecesses_TurnTheJournal") {
  const double load = 4000, turn = 5 * 2 * std::numbers::pi / 48;  // N; five steps of the grid
  for (const double speed : {0.0, 100.0}) {
    OperatingPoint point{.journal_speed = speed};
    point.load = load * Eigen::Vector2d(0.6, -0.8);
    const SteadyState straight = solved(four_recesses(laws()[0]), point);
    point.load = Eigen::Vector2d(Eigen::Rotation2Dd(turn) * Eigen::Vector2d(*point.load));
    const SteadyState turned = solved(four_recesses(laws()[0], 5), point);
    CHECK((Eigen::Rotation2Dd(turn) * Eigen::Vector2d(straight.e) - Eigen::Vector2d(turned.e)).norm() <
          kSolved * 50e-6);
    CHECK(turned.film.flow_supply == relative(straight.film.flow_supply).epsilon(kSolved));
  }
}

// Jacking: pumped into one recess below it, oil lifts a journal that does not turn.
TEST_CASE("JackingOil_LiftsAJournalAtRest") {
  for (const bool has_pump : {false, true}) {
    film::FilmModel model = four_recesses(has_pump ? laws()[3] : laws()[0]);
    model.features.erase(model.features.begin(), model.features.begin() + 3);  // what is left is below
    model.edge_left.ambient_fill = model.edge_right.ambient_fill = 1;
    OperatingPoint point{};
    point.load = Eigen::Vector2d(0, -12000);  // N
    const SteadyState state = solved(model, point);
    CHECK(state.load[1] == relative(-12000.0).epsilon(kSolved));
    CHECK(state.film.h_min > 0);
    CHECK(std::abs(state.e[0]) < kSolved * model.c);
    CHECK(state.film.h_min > 0.1 * model.c);  // no equilibrium by the wall, where lands hardly pass oil
    CHECK(state.coefficients.stiffness(1, 1) > 0);
    CHECK(state.film.flow_features[0] > 0);
    CHECK(state.film.flow_out() == relative(state.film.flow_features[0]).epsilon(kSolved));
  }
}

// The pressures before restrictors are parameters as any other: stronger pumps lift further.
TEST_CASE("StrongerSupply_LiftsTheJournalFurther") {
  double last = 0;
  for (const double supply : {2e6, 4e6, 8e6}) {  // Pa
    film::FilmModel model = four_recesses(laws()[0]);
    for (film::SurfaceFeature& feature : model.features) feature.pressure = supply;
    OperatingPoint point{.journal_speed = 50};
    point.load = Eigen::Vector2d(0, -6000);  // N
    const double h_min = solved(model, point).film.h_min;
    CHECK(h_min > last);
    last = h_min;
  }
}

}  // namespace hydrostatic_test
}  // namespace hersey::bearing
