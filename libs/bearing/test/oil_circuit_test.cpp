#include "hersey/bearing/oil_circuit.h"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "hersey/bearing/journal_bearing.h"

// A film and the circuit that feeds it, by themselves: no bodies.
namespace hersey::bearing {
namespace oil_circuit_test {

constexpr double kSupply = 4e5;  // Pa

film::FilmModel fed_film() {
  film::FilmModel model;
  model.R = 0.03;
  model.L = 0.03;
  model.c = 40e-6;
  model.grid = {.n_phi = 24, .n_z = 9};
  model.lubricant.mu0 = 0.012;
  const double arc = 1;
  model.features = {{.name = "upper", .phi = 1.6, .arc = arc, .length = 0.012, .pressure = 0},
                    {.name = "lower", .phi = 4.0, .arc = arc, .length = 0.012, .pressure = 0}};
  return model;
}

// A supply, a turbulent drilling to the first port, an orifice from there to the second.
circuit::Network bores() {
  return {
      .nodes = {{"supply", true}, {"upper"}, {"lower"}},
      .elements = {{"drilling", 0, 1, circuit::Drilling{.length = 0.05, .diameter = 1.2e-3, .loss_coefficient = 1.5}},
                   {"orifice", 1, 2, circuit::Orifice{.diameter = 0.8e-3}}},
      .oil = {.mu = 0.012, .density = 850}};
}

struct Fed {
  std::shared_ptr<FilmForce> film;
  OilCircuit circuit;
  mbd::ForceResponse response;

  static std::shared_ptr<FilmForce> film_of(bool has_circuit) {
    BearingOptions options;
    options.starts_steady = true;
    options.film.rtol = 1e-12;  // far below the differences taken here
    for (int k = 0; k < 2; ++k) options.feature_pressures.push_back(std::make_shared<ConstantFunction>(0.0));
    if (has_circuit) options.circuit_ports = {0, 1};
    return std::make_shared<JournalBearing>("main", fed_film(), options);
  }
  Fed()
      : film(film_of(true)),
        circuit(bores(), {{film, 0, {1, 2}}}, {std::make_shared<ConstantFunction>(kSupply), nullptr, nullptr}, {}) {}

  /// Evaluates until film and circuit are in balance.
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
};

mbd::RelativeMotion motion_at(const Vector3& e, const Vector3& rate) {
  mbd::RelativeMotion motion;
  motion.X_AB.r = e;
  motion.V_AB_A << 0, 0, 300, rate;
  return motion;
}

const Vector3 kPosition(12e-6, -18e-6, 0), kRate(1e-3, -2e-3, 0);

// Film, ports and circuit together: the exact derivative of what all of them are in balance at.
TEST_CASE("WrenchOfAFedFilm_HasTheDerivativesOfItsDifferences") {
  Fed fed;
  const mbd::ForceResponse response = fed.at(motion_at(kPosition, kRate));
  const double step = 1e-9, rate_step = 1e-6;  // of 40 um, and of 2 mm/s
  for (const Eigen::Index k : {0, 1}) {
    const Vector3 along = Vector3::Unit(k);
    const auto wrench = [&](double by, double rate_by) -> Vector6 {
      return fed.at(motion_at(kPosition + by * along, kRate + rate_by * along)).W_B_A;
    };
    // A twist moves the journal's centre at fixed velocity of the point at the shell's origin, which turns with it.
    const Vector6 by_rate = (wrench(0, rate_step) - wrench(0, -rate_step)) / (2 * rate_step);
    CHECK((response.dW_dV.col(3 + k) - by_rate).norm() < 1e-5 * by_rate.norm());  // of steps that leave 1e-6
    const Vector6 by_position = (wrench(step, 0) - wrench(-step, 0)) / (2 * step);
    CHECK((response.dW_dX.col(3 + k) - by_position).norm() < 1e-4 * by_position.norm());  // rupture fronts bend it
  }
}

// The flows at which circuit and film agree are those of the film with the circuit's pressures given.
TEST_CASE("FedFilm_IsThatOfThePressuresFound") {
  Fed fed;
  const mbd::RelativeMotion motion = motion_at(kPosition, kRate);
  const Vector6 wrench = fed.at(motion).W_B_A;
  fed.circuit.accept_step();
  const Eigen::VectorXd p = fed.circuit.observation().pressures, drawn = fed.circuit.observation().drawn;
  CHECK(p[0] == kSupply);
  CHECK(p[1] < p[0]);
  CHECK(std::abs(fed.circuit.observation().flows[0] - drawn[1] - drawn[2]) < 1e-12 * drawn[1]);  // balanced to 1e-13

  BearingOptions options;
  options.starts_steady = true;
  options.film.rtol = 1e-12;  // as above
  for (const double pressure : {p[1], p[2]})
    options.feature_pressures.push_back(std::make_shared<ConstantFunction>(pressure));
  JournalBearing given("main", fed_film(), options);
  mbd::ForceResponse response;
  given.evaluate(motion, true, response);
  REQUIRE(given.domain_error().empty());
  CHECK((response.W_B_A - wrench).norm() < 1e-9 * wrench.norm());  // films solved to 1e-12, one increment apart
}

// A journal's hole passes the lower groove's end, and feeds a bore that leads out of the journal.
struct Passing {
  std::shared_ptr<FilmForce> film;
  OilCircuit circuit;
  mbd::ForceResponse response;

  static film::FilmModel model() {
    film::FilmModel model = fed_film();
    model.features = {{.name = "groove", .phi = 1.6, .arc = 2, .length = 0.006, .pressure = 0},
                      {.name = "hole",
                       .shape = film::Ellipse{},
                       .surface = film::Surface::journal,
                       .phi = 0.3,
                       .arc = 0.15,
                       .length = 0.0045,
                       .pressure = 0}};
    model.grid = {.n_phi = 48, .n_z = 13};
    return model;
  }
  static std::shared_ptr<FilmForce> film_of() {
    BearingOptions options;
    options.starts_steady = true;
    options.film.rtol = 1e-12;  // far below the differences taken here
    for (int k = 0; k < 2; ++k) options.feature_pressures.push_back(std::make_shared<ConstantFunction>(0.0));
    options.circuit_ports = {0, 1};
    return std::make_shared<JournalBearing>("main", model(), options);
  }
  static circuit::Network network() {
    return {.nodes = {{"supply", true}, {"groove"}, {"hole"}, {"pin", true}},
            .elements = {{"branch", 0, 1, circuit::Drilling{.length = 0.05, .diameter = 2e-3}},
                         {.name = "mouth", .from = 1, .to = 2, .law = circuit::HoleOverGroove{}, .hole = 0},
                         {"crank", 2, 3, circuit::Drilling{.length = 0.07, .diameter = 2e-3}}},
            .oil = {.mu = 0.012, .density = 850}};
  }
  Passing()
      : film(film_of()),
        circuit(network(), {{film, 0, {1, 2}}},
                {std::make_shared<ConstantFunction>(kSupply), nullptr, nullptr, std::make_shared<ConstantFunction>(0)},
                {}, {{0, model().features[1], model().features[0]}}) {}

  // At an angle of the journal, turned there about the shell's axis from `from`.
  static mbd::RelativeMotion turned(double angle, double from) {
    mbd::RelativeMotion motion = motion_at(kPosition, kRate);
    motion.X_AB.R = Eigen::AngleAxisd(angle, Vector3::UnitZ()).toRotationMatrix();
    motion.X_AB.r = Eigen::AngleAxisd(angle - from, Vector3::UnitZ()) * kPosition;
    return motion;
  }
  const mbd::ForceResponse& at(const mbd::RelativeMotion& motion) {
    for (int k = 0; k < 40; ++k) {
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
  double through_the_hole(double angle) {
    (void)at(turned(angle, angle));
    circuit.accept_step();
    return circuit.observation().flows[1];
  }
};

// The groove's end, at 2.6 rad, is over the hole's middle at 2.3 rad of the journal.
TEST_CASE("WrenchOfAPassingHole_HasTheDerivativesOfItsDifferences") {
  Passing passing;
  for (const double angle : {1.0, 2.28}) {  // rad: within the groove, and half way over its end
    const mbd::ForceResponse response = passing.at(Passing::turned(angle, angle));
    const double step = 1e-6;  // rad
    const auto wrench = [&](double by) -> Vector6 { return passing.at(Passing::turned(angle + by, angle)).W_B_A; };
    const Vector6 by_angle = (wrench(step) - wrench(-step)) / (2 * step);
    CHECK((response.dW_dX.col(2) - by_angle).norm() < 1e-4 * by_angle.norm());  // rupture fronts bend it
  }
}

TEST_CASE("PassingHole_IsFedOverTheGrooveOnly") {
  Passing passing;
  CHECK(passing.through_the_hole(1.3) > 1e-6);  // m^3/s: some 0.1 l/min
  CHECK(passing.through_the_hole(4.5) == 0);    // over the land
  CHECK(passing.circuit.observation().open_areas[0] == 0);
  CHECK(passing.through_the_hole(2.375) < 2e-3 * passing.through_the_hole(1.3));  // all but shut
}

}  // namespace oil_circuit_test
}  // namespace hersey::bearing
