#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "hersey/bearing/squeeze_film_damper.h"
#include "hersey/bearing/steady_bearing.h"
#include "relative.h"

// Squeeze-film dampers on circular orbits and in small motions.
namespace hersey::bearing {
namespace damper_test {

constexpr double pi = std::numbers::pi;
constexpr double kSolved = 1e-8;  // films are solved to 1e-10 of their largest flow

film::FilmModel damper(film::Cavitation cavitation = film::Cavitation::full_film) {
  film::FilmModel model{.R = 0.05, .L = 0.05, .c = 100e-6, .grid = {90, 17}, .cavitation = cavitation};
  if (cavitation == film::Cavitation::reynolds || cavitation == film::Cavitation::mass_conserving)
    model.supply = {.kind = film::SupplyKind::widest_gap, .phi = 0, .pressure = 0};
  return model;
}

film::FilmModel sealed(double leakage) {
  film::FilmModel model = damper();
  model.edge_left = model.edge_right = {.kind = film::EdgeKind::leaking, .pressure = 0, .leakage = leakage};
  return model;
}

OperatingPoint orbit(const film::FilmModel& model, double epsilon, double speed, double angle = 0) {
  OperatingPoint point;
  point.e = epsilon * model.c * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  point.whirl_speed = speed;
  return point;
}

SteadyState solved(const film::FilmModel& model, const OperatingPoint& point, double inertia_factor = 0) {
  SteadyState state;
  const film::FilmModel scaled = scaled_for(model, point);
  const SteadySummary summary =
      solve_steady(scaled, point, {.kind = squeeze_film_damper_kind(), .inertia_factor = inertia_factor}, state);
  REQUIRE_MESSAGE(summary.solved(), summary.message);
  return state;
}

/// Force on the journal, outwards and from x towards y.
Eigen::Vector2d polar_force(const SteadyState& state) {
  const Eigen::Vector2d r = state.e.normalized();
  return {-r.dot(state.load), -(r.x() * state.load.y() - r.y() * state.load.x())};
}

// In axes that rest, with the velocity of the orbit: without a fill fraction, which has a past, that is the same film.
TEST_CASE("Orbit_IsTheFilmOfItsVelocity") {
  for (const auto cavitation : {film::Cavitation::full_film, film::Cavitation::guembel, film::Cavitation::reynolds}) {
    const film::FilmModel model = damper(cavitation);
    const OperatingPoint turning = orbit(model, 0.6, 120, 0.7);
    OperatingPoint moving = turning;
    moving.whirl_speed = 0;
    moving.e_rate = 120 * Eigen::Vector2d(-turning.e.y(), turning.e.x());
    const Eigen::Vector2d a = polar_force(solved(model, turning)), b = polar_force(solved(model, moving));
    // The wedge of one and the squeeze of the other are interpolated differently: of the grid's second order.
    CHECK((a - b).norm() < 2e-3 * a.norm());
  }
}

TEST_CASE("MirroredAndRotatedOrbits_HaveTheSameForce") {
  for (const auto cavitation : {film::Cavitation::full_film, film::Cavitation::mass_conserving}) {
    const film::FilmModel model = damper(cavitation);
    const double step = 2 * pi / model.grid.n_phi;
    const Eigen::Vector2d force = polar_force(solved(model, orbit(model, 0.6, 120)));
    const Eigen::Vector2d rotated = polar_force(solved(model, orbit(model, 0.6, 120, 7 * step)));
    const Eigen::Vector2d mirrored = polar_force(solved(model, orbit(model, 0.6, -120)));
    CHECK((rotated - force).norm() < kSolved * force.norm());
    CHECK(mirrored.x() == relative(force.x()).epsilon(1e-6).scale(force.norm()));  // sums in another order
    CHECK(mirrored.y() == relative(-force.y()).epsilon(1e-6));                     // the same
    CHECK(force.y() < 0);                                                          // against the motion
  }
}

TEST_CASE("HalfFilm_HasHalfTheDamping") {
  const Eigen::Vector2d full = polar_force(solved(damper(), orbit(damper(), 0.5, 100)));
  const film::FilmModel cut = damper(film::Cavitation::guembel);
  const Eigen::Vector2d half = polar_force(solved(cut, orbit(cut, 0.5, 100)));
  CHECK(std::abs(full.x()) < kSolved * full.norm());  // the full film is antisymmetric
  CHECK(half.y() == relative(0.5 * full.y()).epsilon(kSolved));
  CHECK(half.x() < 0);  // the centripetal force of the pi film
}

// (damper.10)
TEST_CASE("SmallOrbits_HaveTheClosedFormBetweenSeals") {
  for (const double kappa : {1e-3, 0.3, 1.0, 10.0, 1e6}) {
    CAPTURE(kappa);
    const film::FilmModel model = sealed(kappa);
    const double lambda = model.L / (2 * model.R), sinh = std::sinh(lambda), cosh = std::cosh(lambda);
    const double exact = 3 * pi / (lambda * lambda) * (1 - kappa * sinh / (lambda * (lambda * sinh + kappa * cosh)));
    const double unit = model.lubricant.mu0 * model.R * std::pow(model.L / model.c, 3);
    OperatingPoint rest;
    const DynamicCoefficients all = solved(model, rest).coefficients;
    CHECK(all.damping(0, 0) / unit == relative(exact).epsilon(4e-3));       // of the grid's second order: 3e-3 here
    CHECK(all.damping(1, 1) == relative(all.damping(0, 0)).epsilon(1e-6));  // of the film's tolerance
    CHECK(std::abs(all.stiffness(0, 0)) < kSolved * 100 * all.damping(0, 0));
    // -dF/dv of a small orbit is its damping.
    const OperatingPoint small = orbit(model, 1e-3, 100);
    const double b = -polar_force(solved(model, small)).y() / (1e-3 * model.c * 100);
    CHECK(b == relative(all.damping(0, 0)).epsilon(1e-3));  // of second order in the eccentricity, and of the grid
  }
}

TEST_CASE("LongDamper_HasItsClosedForm") {
  film::FilmModel model = damper();
  model.edge_left.kind = model.edge_right.kind = film::EdgeKind::closed;
  model.supply = {.kind = film::SupplyKind::widest_gap, .phi = 0, .pressure = 0};
  model.grid.n_phi = 180;
  for (const double e : {0.2, 0.6}) {
    const double b = -polar_force(solved(model, orbit(model, e, 100))).y() / (e * model.c * 100);
    const double exact =
        24 * pi * model.lubricant.mu0 * std::pow(model.R / model.c, 3) * model.L / ((2 + e * e) * std::sqrt(1 - e * e));
    CHECK(b == relative(exact).epsilon(1e-3));  // of the grid's second order
  }
}

// The journal's work is dissipated in the film, and in the seals by the pressure before them.
TEST_CASE("WorkOfAnOrbit_IsDissipated") {
  for (const auto cavitation : {film::Cavitation::full_film, film::Cavitation::mass_conserving}) {
    const film::FilmModel model = damper(cavitation);
    const SteadyState state = solved(model, orbit(model, 0.5, 100));
    const double work = -polar_force(state).y() * 0.5 * model.c * 100;
    CHECK(work == relative(state.film.power_taken()).epsilon(5e-3));  // of the grid's second order
    CHECK(work == relative(state.film.power_film).epsilon(5e-3));     // edges at p_cav take no power
  }
  const film::FilmModel leaking = sealed(1);
  const SteadyState state = solved(leaking, orbit(leaking, 0.5, 100));
  const double work = -polar_force(state).y() * 0.5 * leaking.c * 100;
  CHECK(work == relative(state.film.power_taken()).epsilon(5e-3));
  CHECK(state.film.power_film < 0.9 * work);  // the rest is the seals'
}

TEST_CASE("AddedMass_IsTheKineticEnergyOfTheFlow") {
  const film::FilmModel model = damper();
  const double rho = model.lubricant.density, mu = model.lubricant.mu0;
  const DynamicCoefficients centred = solved(model, {}, 1.2).coefficients;
  // At the centre the flow is the same as that which dissipates: M = rho c^2/(10 mu) C.
  const double per_damping = rho * model.c * model.c / (10 * mu);
  CHECK(centred.inertia(0, 0) == relative(per_damping * centred.damping(0, 0)).epsilon(1e-6));  // sums of the grid
  CHECK(std::abs(centred.inertia(0, 1)) < kSolved * centred.inertia(0, 0));
  CHECK(solved(model, {}, 1).coefficients.inertia(0, 0) == relative(centred.inertia(0, 0) / 1.2).epsilon(kSolved));
  OperatingPoint beside;
  beside.e = model.c * Eigen::Vector2d(0.3, 0.4);
  const DynamicCoefficients off = solved(model, beside, 1.2).coefficients;
  CHECK(off.inertia(0, 1) == relative(off.inertia(1, 0)).epsilon(1e-3));  // symmetric but for the weights across z
  CHECK(off.inertia(0, 0) > centred.inertia(0, 0));
  CHECK(off.inertia.topLeftCorner<2, 2>().determinant() > 0);
  // Along the eccentricity and across it nothing couples.
  const Eigen::Vector2d r(0.6, 0.8), t(-0.8, 0.6);
  const Eigen::Matrix2d M = off.inertia.topLeftCorner<2, 2>();
  CHECK(std::abs(r.dot(M * t)) < 1e-3 * r.dot(M * r));  // the same
  CHECK(solved(model, beside).coefficients.inertia.size() == 0);
}

}  // namespace damper_test
}  // namespace hersey::bearing
