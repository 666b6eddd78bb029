#pragma once

#include <array>
#include <cmath>

#include "hersey/core/spatial.h"
#include "hersey/fem/beam.h"
#include "varied.h"

namespace hersey::mbd::test {

/// A line and its sections whose motion is given: bent both ways, twisted, stretched and sheared by strains of some
/// percent, rotated and moved as a whole. At t = 0 it is straight along x, and does not begin to deform suddenly.
struct ManufacturedLine {
  double bend = 0.7;    ///< amplitude of the deformations that differ along the line [-]
  double strain = 0.1;  ///< of stretch and shears that are the same all along [-]
  double pace = 2;      ///< of both [rad/s]

  template <class T>
  [[nodiscard]] T amplitude(const T& t) const {
    using std::sin;
    const T s = sin(pace * t);
    return s * s;
  }
  /// Axes of the whole.
  template <class T>
  [[nodiscard]] MatrixOf<T> axes(const T& t) const {
    using std::sin;
    return rotated_about<T>(2, 1.6 * t + 0.3 * sin(2.0 * t)) *
           (rotated_about<T>(0, -0.8 * t) * rotated_about<T>(1, 0.5 * sin(1.5 * t)));
  }
  /// Origin of the whole [m].
  template <class T>
  [[nodiscard]] VectorOf<T> origin(const T& t) const {
    using std::sin;
    return {0.4 * sin(1.7 * t), 0.3 * t - 0.2 * t * t, -0.5 * t};
  }
  /// Axes of the section at x, x along the line [m].
  template <class T>
  [[nodiscard]] MatrixOf<T> R(const T& x, const T& t) const {
    using std::cos, std::sin;
    const T A = bend * amplitude(t);
    return axes(t) * (rotated_about<T>(2, A * sin(1.5 * x + T(0.3))) *
                      (rotated_about<T>(1, 0.8 * A * cos(1.2 * x)) * rotated_about<T>(0, A * (0.7 * x + 0.3 * x * x))));
  }
  /// The line: along the normals of the sections to the second order of the bend, and strained beside that [m].
  template <class T>
  [[nodiscard]] VectorOf<T> r(const T& x, const T& t) const {
    using std::cos, std::sin;
    const T A = bend * amplitude(t), B = strain * amplitude(t);
    const T up = 1.5 * x + T(0.3), side = 1.2 * x;  // angles of R above
    const T squares =
        0.5 * x - (1 / 6.0) * (sin(2.0 * up) - T(std::sin(0.6))) + 0.32 * x + (0.64 / 4.8) * sin(2 * side);
    const VectorOf<T> line{x + B * x - 0.5 * A * A * squares + 0.05 * A * sin(2.0 * x),
                           (1 / 1.5) * A * (T(std::cos(0.3)) - cos(up)) - 0.6 * B * x,
                           (-0.8 / 1.2) * A * sin(side) + 0.8 * B * x + 0.04 * A * x * x};
    return origin(t) + axes(t) * line;
  }
};

/// Loads that a beam needs to move along a given line, theory manual eq. (beams.9).
struct ManufacturedBeam {
  ManufacturedLine line;
  double length = 1;                                           // [m]
  fem::BeamStiffness stiffness{30, 12, 15, 0.6, 0.8, 1.1};     // soft: strains and waves of the motion's own size
  double mass_per_length = 1;                                  // [kg/m]
  std::array<double, 3> inertia_per_length{0.05, 0.02, 0.03};  // [kg m]
  double damping = 0.02;                                       // [s]

  /// Six numbers, rotations and moments first where they are motions or wrenches.
  template <class T>
  using Six = std::array<VectorOf<T>, 2>;

  /// [Gamma; kappa] of the section at x.
  template <class T>
  [[nodiscard]] Six<T> strains(const T& x, const T& t) const {
    using V = Varied<T>;
    const V now(t, T(0.0));
    const MatrixOf<T> R_T = transposed(line.R(x, t));
    VectorOf<T> Gamma = R_T * slope_of([&](const V& y) { return line.r(y, now); }, x);
    Gamma[0] += T(-1.0);
    return {Gamma, axial(R_T * slope_of([&](const V& y) { return line.R(y, now); }, x))};
  }
  /// [N; M] there, in the section's axes (beams.3).
  template <class T>
  [[nodiscard]] Six<T> section_forces(const T& x, const T& t) const {
    using V = Varied<T>;
    const auto [Gamma, kappa] = strains(x, t);
    const auto [Gamma_rate, kappa_rate] = slope_of([&](const V& s) { return strains(V(x, T(0.0)), s); }, t);
    const fem::BeamStiffness& c = stiffness;
    const VectorOf<T> N = Gamma + damping * Gamma_rate, M = kappa + damping * kappa_rate;
    return {VectorOf<T>{c.EA * N[0], c.GA_y * N[1], c.GA_z * N[2]},
            VectorOf<T>{c.GJ * M[0], c.EI_y * M[1], c.EI_z * M[2]}};
  }
  /// [m; n], the same in ground's axes.
  template <class T>
  [[nodiscard]] Six<T> wrench(const T& x, const T& t) const {
    const MatrixOf<T> R = line.R(x, t);
    const auto [N, M] = section_forces(x, t);
    return {R * M, R * N};
  }
  /// Momenta per length, [angular about the line; linear], ground's axes.
  template <class T>
  [[nodiscard]] Six<T> momenta(const T& x, const T& t) const {
    using V = Varied<T>;
    const V here(x, T(0.0));
    const MatrixOf<T> R = line.R(x, t);
    VectorOf<T> spin = axial(transposed(R) * slope_of([&](const V& s) { return line.R(here, s); }, t));
    for (std::size_t i = 0; i < 3; ++i) spin[i] = inertia_per_length[i] * spin[i];
    return {R * spin, mass_per_length * slope_of([&](const V& s) { return line.r(here, s); }, t)};
  }
  /// Moment and force from outside per length that the motion needs, ground's axes [N; N/m].
  [[nodiscard]] Vector6 load(double x, double t) const {
    using V = Varied<double>;
    const Six<double> inertia = slope_of([&](const V& s) { return momenta(V(x), s); }, t);
    const Six<double> change = slope_of([&](const V& y) { return wrench(y, V(t)); }, x);
    const Vector3 along = vector(slope_of([&](const V& y) { return line.r(y, V(t)); }, x));
    Vector6 load = six(inertia) - six(change);
    load.head<3>() -= along.cross(vector(wrench(x, t)[1]));
    return load;
  }
  /// Kinetic and strain energy per length [J/m].
  [[nodiscard]] Eigen::Vector2d energies(double x, double t) const {
    using V = Varied<double>;
    const MatrixOf<double> R_T = transposed(line.R(x, t));
    const Vector3 omega = vector(axial(R_T * slope_of([&](const V& s) { return line.R(V(x), s); }, t)));
    const Vector3 v = vector(slope_of([&](const V& s) { return line.r(V(x), s); }, t));
    const fem::BeamStiffness& c = stiffness;
    const Vector6 C = (Vector6() << c.EA, c.GA_y, c.GA_z, c.GJ, c.EI_y, c.EI_z).finished();
    const Vector6 strain = six(strains(x, t));
    return 0.5 * Eigen::Vector2d(
                     mass_per_length * v.squaredNorm() + omega.dot(vector(inertia_per_length).cwiseProduct(omega)),
                     strain.dot(C.cwiseProduct(strain)));
  }
  [[nodiscard]] static Vector6 six(const Six<double>& a) {
    return (Vector6() << vector(a[0]), vector(a[1])).finished();
  }
};

}  // namespace hersey::mbd::test
