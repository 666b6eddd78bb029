#include "hersey/bearing/film_inertia.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hersey/bearing/clearance.h"
#include "hersey/bearing/operating_point.h"
#include "hersey/bearing/steady_bearing.h"
#include "hersey/core/contract.h"

namespace hersey::bearing {
namespace {

using Eigen::Index;
using Eigen::Matrix2d;
using Eigen::Vector2d;
using Matrix26 = Eigen::Matrix<double, 2, 6>;
using Matrix36 = Eigen::Matrix<double, 3, 6>;

// Eccentricities at which the mass is computed, and the largest ratio among them. The two functions of (damper.13) are
// smooth: on short and long films, open and closed, a polynomial of degree 7 differs from them by less than 5e-4, one
// of degree 5 by 4e-3, one of degree 9 by 3e-5.
constexpr Index kMassPoints = 8;
constexpr double kLargestRatio = 0.98;

// s = sqrt(1 - ratio^2) below which the mass grows no more: a ratio of 0.999. A liner lets a journal pass 1.
constexpr double kSmallestRoot = 0.05;

/// A function of s with its first two derivatives.
struct Jet {
  double f = 0, d = 0, dd = 0;
};
Jet operator*(const Jet& a, const Jet& b) {
  return {a.f * b.f, a.d * b.f + a.f * b.d, a.dd * b.f + 2 * a.d * b.d + a.f * b.dd};
}
Jet reciprocal(const Jet& a) {
  const double r = 1 / a.f;
  return {r, -r * r * a.d, r * r * (2 * r * a.d * a.d - a.dd)};
}

/// A polynomial in x = 1 - s.
Jet polynomial_in_rest(const Eigen::VectorXd& coefficients, double s) {
  const double x = 1 - s;
  Jet p;
  for (Index k = coefficients.size(); k-- > 0;) {
    p.dd = p.dd * x + 2 * p.d;
    p.d = p.d * x + p.f;
    p.f = p.f * x + coefficients[k];
  }
  return {p.f, -p.d, p.dd};
}

/// A function of s as one of the squared eccentricity c^2 (1 - s^2).
Jet by_square(const Jet& a, double s, double c) {
  const double rate = -1 / (2 * c * c * s);
  return {a.f, rate * a.d, rate * (rate * a.dd - rate / s * a.d)};
}

/// A and B of M = A 1 + B e e^T (damper.13), by the squared eccentricity.
struct MassSeries {
  Jet A, B;
};

MassSeries mass_series(const Eigen::VectorXd& tangential, const Eigen::VectorXd& difference, double c, double square) {
  const double s = std::sqrt(std::max(1 - square / (c * c), kSmallestRoot * kSmallestRoot));
  const Jet root{s, 1, 0}, more = reciprocal({1 + s, 1, 0}), twice{2, 0, 0};
  const Jet A = twice * polynomial_in_rest(tangential, s) * more;
  const Jet B = Jet{2 / (c * c), 0, 0} * polynomial_in_rest(difference, s) * reciprocal(root) * more * more;
  if (s <= kSmallestRoot) return {{A.f, 0, 0}, {B.f, 0, 0}};
  return {by_square(A, s, c), by_square(B, s, c)};
}

/// Position, velocity and acceleration of the journal's origin in the shell's axes, and how they change with twist,
/// velocity and acceleration.
struct CentreMotion {
  explicit CentreMotion(const mbd::RelativeMotion& motion) : r(motion.X_AB.r) {
    const Vector3 omega = motion.V_AB_A.head<3>(), alpha = motion.A_AB_A.head<3>();
    r_rate = motion.V_AB_A.tail<3>() + omega.cross(r);
    r_rate2 = motion.A_AB_A.tail<3>() + alpha.cross(r) + omega.cross(r_rate);
    by_twist << -skew(r), Matrix3::Identity();
    const Matrix3 W = skew(omega);
    rate_by_twist = W * by_twist;
    rate2_by_twist = (skew(alpha) + W * W) * by_twist;
    rate2_by_velocity = W * by_twist;
    rate2_by_velocity.leftCols<3>() -= skew(r_rate);
  }
  Vector3 r, r_rate, r_rate2;
  Matrix36 by_twist;  // also that of the velocity by the velocity, and of the acceleration by the acceleration
  Matrix36 rate_by_twist, rate2_by_twist, rate2_by_velocity;
};

/// (damper.15) with its derivatives by position, velocity and acceleration.
struct InertiaForce {
  Vector2d F;
  Matrix2d by_e, by_rate, by_rate2;
};

InertiaForce inertia_force(const MassSeries& mass, const Vector2d& e, const Vector2d& v, const Vector2d& a) {
  const auto& [A, B] = mass;
  const double p = e.dot(v), w = v.squaredNorm(), ea = e.dot(a);
  const double N = B.d * p * p + (B.f - A.d) * w;
  InertiaForce force;
  force.F = -A.f * a - B.f * ea * e - 2 * A.d * p * v - N * e;
  const Matrix2d one = Matrix2d::Identity();
  force.by_rate2 = -A.f * one - B.f * e * e.transpose();
  force.by_rate = -2 * A.d * (v * e.transpose() + p * one) - e * (2 * B.d * p * e + 2 * (B.f - A.d) * v).transpose();
  force.by_e = -2 * A.d * a * e.transpose() - 2 * B.d * ea * e * e.transpose() - B.f * (e * a.transpose() + ea * one) -
               4 * A.dd * p * v * e.transpose() - 2 * A.d * v * v.transpose() - N * one -
               e * (2 * B.dd * p * p * e + 2 * B.d * p * v + 2 * (B.d - A.dd) * w * e).transpose();
  return force;
}

Vector3 in_space(const Vector2d& F) { return {F.x(), F.y(), 0}; }

}  // namespace

FilmInertia::FilmInertia(const film::FilmModel& film, double momentum_factor) : clearance_(clearance(film)) {
  HERSEY_REQUIRE(momentum_factor > 0, "oil with inertia");
  film::FilmModel full = film;
  full.cavitation = film::Cavitation::full_film;
  Eigen::MatrixXd powers(kMassPoints, kMassPoints), values(kMassPoints, 2);
  const double last = 1 - std::sqrt(1 - kLargestRatio * kLargestRatio);
  for (Index k = 0; k < kMassPoints; ++k) {
    // The points of Chebyshev and Lobatto between x = 0, the centre, and the largest ratio.
    const double x = 0.5 * last * (1 - std::cos(std::numbers::pi * static_cast<double>(k) / (kMassPoints - 1)));
    const double s = 1 - x;
    OperatingPoint point;
    point.e = Vector2d(clearance_ * std::sqrt(1 - s * s), 0);
    SteadyState state;
    const SteadySummary found = solve_steady(full, point, {.inertia_factor = momentum_factor}, state);
    HERSEY_REQUIRE(found.solved(), "a full film at rest has a solution");
    const auto& M = state.coefficients.inertia;
    for (Index power = 0; power < kMassPoints; ++power) powers(k, power) = std::pow(x, static_cast<double>(power));
    values(k, 0) = M(1, 1) * (1 + s) / 2;      // g_t
    values(k, 1) = M(0, 0) * s * (1 + s) / 2;  // g_r
  }
  // At the centre no direction is another.
  values.row(0).setConstant(values.row(0).mean());
  const Eigen::MatrixXd fitted = powers.partialPivLu().solve(values);
  tangential_ = fitted.col(0);
  // Q = (g_r - s g_t)/(1 - s): the numerator's first coefficient is zero.
  Eigen::VectorXd numerator = Eigen::VectorXd::Zero(kMassPoints + 1);
  numerator.head(kMassPoints) = fitted.col(1) - fitted.col(0);
  numerator.tail(kMassPoints) += fitted.col(0);
  difference_ = numerator.tail(kMassPoints);
}

FilmInertia::Masses FilmInertia::masses(double eccentricity) const {
  const double square = eccentricity * eccentricity;
  const MassSeries mass = mass_series(tangential_, difference_, clearance_, square);
  return {mass.A.f + mass.B.f * square, mass.A.f};
}

void FilmInertia::add(const mbd::RelativeMotion& motion, bool want_tangent, mbd::ForceResponse& response) const {
  const CentreMotion at(motion);
  const Vector2d e = at.r.head<2>();
  const MassSeries mass = mass_series(tangential_, difference_, clearance_, e.squaredNorm());
  const InertiaForce force = inertia_force(mass, e, at.r_rate.head<2>(), at.r_rate2.head<2>());
  const Vector3 F = in_space(force.F);
  response.W_B_A.head<3>() += at.r.cross(F);
  response.W_B_A.tail<3>() += F;
  const auto rows = [](const Matrix36& by) { return by.topRows<2>(); };
  const auto add_to = [&](Matrix6& derivative, const Matrix26& dF) {
    derivative.topRows<3>() += skew(at.r).leftCols<2>() * dF;
    derivative.middleRows<2>(3) += dF;
  };
  add_to(response.dW_dA, force.by_rate2 * rows(at.by_twist));
  if (!want_tangent) return;
  add_to(response.dW_dX, force.by_e * rows(at.by_twist) + force.by_rate * rows(at.rate_by_twist) +
                             force.by_rate2 * rows(at.rate2_by_twist));
  response.dW_dX.topRows<3>() -= skew(F) * at.by_twist;
  add_to(response.dW_dV, force.by_rate * rows(at.by_twist) + force.by_rate2 * rows(at.rate2_by_velocity));
}

Vector6 FilmInertia::wrench(const mbd::RelativeMotion& motion) const {
  mbd::ForceResponse alone;
  add(motion, false, alone);
  return alone.W_B_A;
}

// (damper.14)
double FilmInertia::energy(const mbd::RelativeMotion& motion) const {
  const CentreMotion at(motion);
  const Vector2d e = at.r.head<2>(), v = at.r_rate.head<2>();
  const MassSeries mass = mass_series(tangential_, difference_, clearance_, e.squaredNorm());
  const double p = e.dot(v);
  return 0.5 * (mass.A.f * v.squaredNorm() + mass.B.f * p * p);
}

}  // namespace hersey::bearing
