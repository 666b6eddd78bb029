#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "hersey/bearing/journal_bearing.h"
#include "hersey/bearing/oil_circuit.h"

// A film on a node of a circuit that gets less oil than the film would take: no bodies.
namespace hersey::bearing {
namespace starved_feed_test {

film::FilmModel grooved_film(film::Cavitation cavitation = film::Cavitation::mass_conserving) {
  film::FilmModel model;
  model.R = 0.03;
  model.L = 0.03;
  model.c = 40e-6;
  model.grid = {.n_phi = 24, .n_z = 9};
  model.lubricant.mu0 = 0.012;
  model.fill_speed = 300;  // rad/s, that of the journal
  model.cavitation = cavitation;
  model.features = {{.name = "groove", .phi = 1.6, .arc = 1, .length = 0.012, .pressure = 0}};
  return model;
}

/// A pump of constant flow, a pipe to the groove's node; a pump that drains the node in part where `drained` > 0.
struct Starved {
  std::shared_ptr<FilmForce> film;
  OilCircuit circuit;
  mbd::ForceResponse response;

  static std::shared_ptr<FilmForce> film_of(const film::FilmModel& model) {
    BearingOptions options;
    options.starts_steady = true;
    options.film.rtol = 1e-12;  // far below the differences taken here
    options.feature_pressures = {std::make_shared<ConstantFunction>(0.0)};
    options.circuit_ports = {0};
    return std::make_shared<JournalBearing>("main", model, options);
  }
  static circuit::Network pumped(double rate, double drained) {
    circuit::Network network{
        .nodes = {{"sump", true}, {"gallery"}, {"groove"}},
        .elements = {{"pump", 0, 1, circuit::GivenFlow{rate}}, {"pipe", 1, 2, circuit::Resistance{1e9}}},
        .oil = {.mu = 0.012, .density = 850}};
    if (drained > 0) network.elements.push_back({"drain", 2, 0, circuit::GivenFlow{drained}});
    return network;
  }
  explicit Starved(double rate, double drained = 0, const film::FilmModel& model = grooved_film())
      : film(film_of(model)),
        circuit(pumped(rate, drained), {{film, 0, {2}}}, {std::make_shared<ConstantFunction>(0), nullptr, nullptr},
                {}) {}

  const mbd::ForceResponse& at(const mbd::RelativeMotion& motion) {
    for (int k = 0; k < 30; ++k) {
      circuit.follow({0, 0, {&motion, 1}, {}});
      film->evaluate(motion, true, response);
      circuit.condense({&response, 1});
      REQUIRE_MESSAGE(circuit.domain_error().empty(), circuit.domain_error());
      REQUIRE_MESSAGE(film->domain_error().empty(), film->domain_error());
      if (circuit.internal_residual() < 1e-13) return response;  // of the largest flow
    }
    FAIL("no balance of film and circuit");
    return response;
  }
  const CircuitObservation& observed(const mbd::RelativeMotion& motion) {
    (void)at(motion);
    circuit.accept_step();
    film->accept_step(motion);
    return circuit.observation();
  }
};

const Vector3 kPosition(12e-6, -18e-6, 0), kSpin(0, 0, 300);  // m, rad/s

// The journal's centre at `e` moves at `rate` where it is at kPosition; a twist has the velocity at the shell's origin.
mbd::RelativeMotion motion_at(const Vector3& e, const Vector3& rate) {
  mbd::RelativeMotion motion;
  motion.X_AB.r = e;
  motion.V_AB_A << kSpin, rate - kSpin.cross(kPosition);
  return motion;
}

double taken_from_a_full_groove() {
  Starved ample(1e-3, 1e-3);  // m^3/s: far more than the film takes, and a drain that leaves it little pressure
  return ample.observed(motion_at(kPosition, Vector3::Zero())).drawn[2];
}

TEST_CASE("FilmOnAStarvedNode_TakesWhatThePumpGives") {
  const mbd::RelativeMotion motion = motion_at(kPosition, Vector3::Zero());
  const double full = taken_from_a_full_groove();
  REQUIRE(full > 1e-7);  // m^3/s
  double before = 0;
  for (const double part : {0.05, 0.1, 0.3, 0.6}) {
    CAPTURE(part);
    Starved starved(part * full);
    const CircuitObservation& seen = starved.observed(motion);
    CHECK(seen.drawn[2] == doctest::Approx(part * full).epsilon(1e-9));  // of the largest flow
    const BearingObservation film = starved.film->observe(motion);
    CHECK(film.film.flow_left + film.film.flow_right == doctest::Approx(part * full).epsilon(1e-9));  // as above
    CHECK(film.film.flow_features[0] == doctest::Approx(part * full).epsilon(1e-9));                  // as above
    CHECK(seen.pressures[2] == 0);
    CHECK(seen.fills[2] < 1);
    CHECK(seen.fills[2] > before);  // the more oil comes, the fuller the groove
    before = seen.fills[2];
    CHECK(seen.fills[1] == 1);  // before the pipe there is a pressure
  }
}

// Between two pumps: film and drain have the same fill of the node.
TEST_CASE("DrainOfAStarvedNode_TakesItsFill") {
  const double full = taken_from_a_full_groove();
  Starved starved(0.5 * full, 2 * full);
  const CircuitObservation& seen = starved.observed(motion_at(kPosition, Vector3::Zero()));
  CHECK(seen.fills[2] < 0.3);
  CHECK(seen.flows[2] == doctest::Approx(seen.fills[2] * 2 * full).epsilon(1e-9));    // of the largest flow
  CHECK(seen.drawn[2] + seen.flows[2] == doctest::Approx(0.5 * full).epsilon(1e-9));  // as above
}

TEST_CASE("WrenchOfAStarvedFilm_HasTheDerivativesOfItsDifferences") {
  const Vector3 rate(1e-3, -2e-3, 0);
  Starved starved(0.4 * taken_from_a_full_groove());
  const mbd::ForceResponse response = starved.at(motion_at(kPosition, rate));
  starved.circuit.accept_step();
  REQUIRE(starved.circuit.observation().fills[2] < 1);
  const double step = 1e-9, rate_step = 1e-6;  // of 40 um, and of 2 mm/s
  for (const Eigen::Index k : {0, 1}) {
    const Vector3 along = Vector3::Unit(k);
    const auto wrench = [&](double by, double rate_by) -> Vector6 {
      return starved.at(motion_at(kPosition + by * along, rate + rate_by * along)).W_B_A;
    };
    const Vector6 by_rate = (wrench(0, rate_step) - wrench(0, -rate_step)) / (2 * rate_step);
    CHECK((response.dW_dV.col(3 + k) - by_rate).norm() < 1e-5 * by_rate.norm());  // of steps that leave 1e-6
    const Vector6 by_position = (wrench(step, 0) - wrench(-step, 0)) / (2 * step);
    CHECK((response.dW_dX.col(3 + k) - by_position).norm() < 1e-4 * by_position.norm());  // rupture fronts bend it
  }
}

// Without a fill fraction the film draws full oil, of which the node gives its fill.
TEST_CASE("FilmWithoutFill_GetsWhatThePumpGives") {
  const mbd::RelativeMotion motion = motion_at(kPosition, Vector3::Zero());
  for (const auto cavitation : {film::Cavitation::reynolds, film::Cavitation::guembel}) {
    Starved starved(1e-8, 0, grooved_film(cavitation));  // m^3/s, a tenth of what it draws
    const CircuitObservation& seen = starved.observed(motion);
    CHECK(seen.drawn[2] == doctest::Approx(1e-8).epsilon(1e-9));  // of the largest flow
    const double drawn = starved.film->observe(motion).film.flow_features[0];
    REQUIRE(drawn > 1e-8);
    CHECK(seen.fills[2] == doctest::Approx(1e-8 / drawn).epsilon(1e-9));  // as above
  }
}

}  // namespace starved_feed_test
}  // namespace hersey::bearing
