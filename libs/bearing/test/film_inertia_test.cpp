#include "hersey/bearing/film_inertia.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "hersey/bearing/squeeze_film_damper.h"
#include "hersey/bearing/steady_bearing.h"
#include "relative.h"

// Inertia of the oil that a journal in motion feels.
namespace hersey::bearing {
namespace film_inertia_test {

constexpr double pi = std::numbers::pi;
constexpr double kFactor = 1.2;  // of the parabolic profile

film::FilmModel damper(double width, film::EdgeKind edges = film::EdgeKind::pressure) {
  film::FilmModel model{
      .R = 0.05, .L = width, .c = 100e-6, .grid = {72, 13}, .cavitation = film::Cavitation::full_film};
  model.edge_left.kind = model.edge_right.kind = edges;
  return model;
}

mbd::RelativeMotion planar(const Eigen::Vector2d& e, const Eigen::Vector2d& v, const Eigen::Vector2d& a) {
  mbd::RelativeMotion motion;
  motion.X_AB.r << e, 0;
  motion.V_AB_A.segment<2>(3) = v;
  motion.A_AB_A.segment<2>(3) = a;
  return motion;
}

mbd::RelativeMotion wild(double c) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  mbd::RelativeMotion motion;
  motion.X_AB = pose_exp((Vector6() << 0.2, -0.1, 0.7, 0.4 * c, 0.3 * c, 0.2 * c).finished());
  for (auto& x : motion.V_AB_A.head<3>()) x = uniform(random);
  for (auto& x : motion.V_AB_A.tail<3>()) x = c * uniform(random);
  for (auto& x : motion.A_AB_A.head<3>()) x = uniform(random);
  for (auto& x : motion.A_AB_A.tail<3>()) x = c * uniform(random);
  return motion;
}

// (damper.13): what the study computes at a position, between the points of the fit, too.
TEST_CASE("MassesAlongAndAcross_AreThoseOfTheFilmAtEachEccentricity") {
  for (const auto& model : {damper(0.02), damper(0.1), damper(0.05, film::EdgeKind::closed)}) {
    const FilmInertia inertia(model, kFactor);
    for (const double ratio : {0.0, 0.13, 0.37, 0.5, 0.66, 0.8, 0.9, 0.97}) {
      CAPTURE(ratio);
      OperatingPoint point;
      point.e = Eigen::Vector2d(ratio * model.c, 0);
      SteadyState state;
      REQUIRE(
          solve_steady(model, point, {.kind = squeeze_film_damper_kind(), .inertia_factor = kFactor}, state).solved());
      const auto& M = state.coefficients.inertia;
      const FilmInertia::Masses masses = inertia.masses(ratio * model.c);
      // The polynomials of (damper.13) differ by up to 5e-4.
      constexpr double fitted = 1e-3;  // twice that
      CHECK(masses.radial == relative(M(0, 0)).epsilon(fitted));
      CHECK(masses.tangential == relative(M(1, 1)).epsilon(fitted));
    }
  }
}

// A short full film between open edges: int cos^2/(1 + e cos) and int sin^2/(1 + e cos).
TEST_CASE("ShortFilm_HasTheMassesOfItsClosedForm") {
  const film::FilmModel model = damper(0.005);
  const FilmInertia inertia(model, kFactor);
  const double m = kFactor * pi * model.lubricant.density * model.R * std::pow(model.L, 3) / (12 * model.c);
  for (const double ratio : {0.0, 0.4, 0.8}) {
    const double s = std::sqrt(1 - ratio * ratio);
    const FilmInertia::Masses masses = inertia.masses(ratio * model.c);
    const double of_grid = 1.0 / (12 * 12);  // a parabola across 12 cells
    CHECK(masses.radial == relative(2 * m / (s * (1 + s))).epsilon(2 * of_grid));
    CHECK(masses.tangential == relative(2 * m / (1 + s)).epsilon(2 * of_grid));
  }
}

TEST_CASE("InertiaDerivatives_MatchFiniteDifferences") {
  const film::FilmModel model = damper(0.05);
  const FilmInertia inertia(model, kFactor);
  const mbd::RelativeMotion at = wild(model.c);
  mbd::ForceResponse response;
  inertia.add(at, true, response);
  // Central differences of third order in the step; round-off is divided by it.
  const double step = 1e-5, allowed = 1e-7;
  Eigen::Matrix<double, 6, 1> size;
  size << 1, 1, 1, Eigen::Vector3d::Constant(model.c);
  for (int k = 0; k < 6; ++k) {
    const Vector6 d = Vector6::Unit(k) * step * size[k];
    const auto difference = [&](const auto& moved) {
      return Vector6((inertia.wrench(moved(d)) - inertia.wrench(moved(-d))) / (2 * step * size[k]));
    };
    const auto by_twist = [&](const Vector6& x) {
      mbd::RelativeMotion other = at;
      other.X_AB = pose_exp(x) * at.X_AB;
      return other;
    };
    const auto by_velocity = [&](const Vector6& x) {
      mbd::RelativeMotion other = at;
      other.V_AB_A += x;
      return other;
    };
    const auto by_acceleration = [&](const Vector6& x) {
      mbd::RelativeMotion other = at;
      other.A_AB_A += x;
      return other;
    };
    CAPTURE(k);
    const auto scale = [&](const Matrix6& J) {
      return allowed * (J * size.asDiagonal()).cwiseAbs().maxCoeff() / size[k];
    };
    CHECK((difference(by_twist) - response.dW_dX.col(k)).cwiseAbs().maxCoeff() < scale(response.dW_dX));
    CHECK((difference(by_velocity) - response.dW_dV.col(k)).cwiseAbs().maxCoeff() < scale(response.dW_dV));
    CHECK((difference(by_acceleration) - response.dW_dA.col(k)).cwiseAbs().maxCoeff() < scale(response.dW_dA));
  }
}

// (damper.15) is that of (damper.14): what the journal puts in is kinetic energy, along any path.
TEST_CASE("PowerOfInertia_IsTheRateOfItsEnergy") {
  const film::FilmModel model = damper(0.05);
  const FilmInertia inertia(model, kFactor);
  const auto on_path = [&](double t) {
    const double c = model.c;
    return planar(c * Eigen::Vector2d(0.5 * std::cos(t), 0.3 + 0.4 * std::sin(1.7 * t)),
                  c * Eigen::Vector2d(-0.5 * std::sin(t), 0.68 * std::cos(1.7 * t)),
                  c * Eigen::Vector2d(-0.5 * std::cos(t), -1.156 * std::sin(1.7 * t)));
  };
  const double step = 1e-4;
  for (const double t : {0.1, 0.9, 2.3, 4.0}) {
    const mbd::RelativeMotion at = on_path(t);
    const double rate = (inertia.energy(on_path(t + step)) - inertia.energy(on_path(t - step))) / (2 * step);
    const double scale = inertia.energy(at);  // per unit of time, which is 1
    CHECK(std::abs(-inertia.wrench(at).dot(at.V_AB_A) - rate) < 10 * step * step * std::max(scale, std::abs(rate)));
  }
}

// Turned with its motion, the force turns; on a circle at a constant speed it is radial and larger than M e Omega^2 by
// the convective terms: F_r = (M_t + e M_t'/2) e Omega^2.
TEST_CASE("CircularOrbit_HasARadialForceByTheGradientOfItsEnergy") {
  const film::FilmModel model = damper(0.05);
  const FilmInertia inertia(model, kFactor);
  const double e = 0.6 * model.c, Omega = 300, step = 1e-4 * e;
  const double slope = (inertia.masses(e + step).tangential - inertia.masses(e - step).tangential) / (2 * step);
  const double outwards = (inertia.masses(e).tangential + 0.5 * e * slope) * e * Omega * Omega;
  for (const double angle : {0.0, 0.7, 2.0}) {
    const Eigen::Vector2d r(std::cos(angle), std::sin(angle)), t(-r.y(), r.x());
    const Eigen::Vector2d F = inertia.wrench(planar(e * r, e * Omega * t, -e * Omega * Omega * r)).segment<2>(3);
    CHECK(F.dot(r) == relative(outwards).epsilon(1e-7));  // of the difference for the slope
    CHECK(std::abs(F.dot(t)) < 1e-12 * outwards);         // round-off of products
  }
}

TEST_CASE("CentredJournal_HasTheMassOfSmallMotions") {
  const film::FilmModel model = damper(0.05);
  const FilmInertia inertia(model, kFactor);
  const Eigen::Vector2d a(3, -2);
  const Eigen::Vector2d F = inertia.wrench(planar({0, 0}, {0.01, 0.02}, a)).segment<2>(3);
  CHECK((F + inertia.masses(0).radial * a).norm() < 1e-14 * F.norm() + 1e-300);  // round-off; no force is smaller
  CHECK(inertia.masses(0).radial == inertia.masses(0).tangential);
  const FilmInertia uniform(model, 1);
  CHECK(uniform.masses(0).radial == relative(inertia.masses(0).radial / kFactor).epsilon(1e-12));  // round-off of sums
}

}  // namespace film_inertia_test
}  // namespace hersey::bearing
