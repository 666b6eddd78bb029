#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "hersey/core/spatial.h"
#include "hersey/fem/elastic_body.h"
#include "hersey/fem/load_vectors.h"
#include "varied.h"

namespace hersey::mbd::test {

/// A solid whose motion is given, x = r(t) + Q(t) (X + sum a_k(t) phi_k(X)), and what it needs to move so, theory
/// manual eq. (flexible-bodies.29).
///
/// Motion has, for any kind of number T:  origin(t), axes(t), amplitudes(t) and shapes(X): r, Q, a_k and phi_k.
template <class Motion>
struct ManufacturedSolid {
  static constexpr std::size_t shape_count = 2;
  template <class T>
  using Each = std::array<T, shape_count>;

  Motion motion;
  fem::SolidMaterial material;
  double damping = 0;  ///< c_k of (flexible-bodies.21) [s]

  /// The motion at one instant: second derivatives of r, Q and Q a_k, and what deforms.
  struct Instant {
    Vector3 r, r_rate, r_acc;
    Matrix3 Q, Q_rate, Q_acc;
    Each<Matrix3> Qa, Qa_rate, Qa_acc;
    Each<double> a, a_rate;

    [[nodiscard]] Vector3 position(const Vector3& X, const Each<Vector3>& phi) const { return of(r, Q, Qa, X, phi); }
    [[nodiscard]] Vector3 velocity(const Vector3& X, const Each<Vector3>& phi) const {
      return of(r_rate, Q_rate, Qa_rate, X, phi);
    }
    [[nodiscard]] Vector3 acceleration(const Vector3& X, const Each<Vector3>& phi) const {
      return of(r_acc, Q_acc, Qa_acc, X, phi);
    }

   private:
    [[nodiscard]] static Vector3 of(const Vector3& r, const Matrix3& Q, const Each<Matrix3>& Qa, const Vector3& X,
                                    const Each<Vector3>& phi) {
      return r + Q * X + Qa[0] * phi[0] + Qa[1] * phi[1];
    }
  };

  [[nodiscard]] Instant at(double t) const {
    using V = Varied<double>;
    const auto origin = [&](const auto& s) { return motion.origin(s); };
    const auto axes = [&](const auto& s) { return motion.axes(s); };
    const auto all = [](const auto& f, double s) {
      return std::array{f(s), slope_of(f, s), slope_of([&](const V& at) { return slope_of(f, at); }, s)};
    };
    Instant now;
    const auto r = all(origin, t);
    const auto Q = all(axes, t);
    now.r = vector(r[0]), now.r_rate = vector(r[1]), now.r_acc = vector(r[2]);
    now.Q = matrix(Q[0]), now.Q_rate = matrix(Q[1]), now.Q_acc = matrix(Q[2]);
    for (std::size_t k = 0; k < shape_count; ++k) {
      const auto a = all([&](const auto& s) { return motion.amplitudes(s)[k]; }, t);
      now.a[k] = a[0], now.a_rate[k] = a[1];
      now.Qa[k] = a[0] * now.Q;
      now.Qa_rate[k] = a[1] * now.Q + a[0] * now.Q_rate;
      now.Qa_acc[k] = a[2] * now.Q + 2 * a[1] * now.Q_rate + a[0] * now.Q_acc;
    }
    return now;
  }

  /// Gradients of the shapes, dphi_i/dX_j.
  template <class T>
  [[nodiscard]] Each<MatrixOf<T>> gradients(const VectorOf<T>& X) const {
    Each<MatrixOf<T>> G;
    for (std::size_t j = 0; j < 3; ++j) {
      VectorOf<Varied<T>> varied;
      for (std::size_t i = 0; i < 3; ++i) varied[i] = Varied<T>(X[i], T(i == j ? 1.0 : 0.0));
      const Each<VectorOf<T>> columns = slopes(motion.shapes(varied));
      for (std::size_t k = 0; k < shape_count; ++k)
        for (std::size_t i = 0; i < 3; ++i) G[k][i][j] = columns[k][i];
    }
    return G;
  }
  /// Components of H and of E and dE/dt there, in the axes of the body.
  template <class T>
  struct Strain {
    MatrixOf<T> F, E, E_rate;
  };
  template <class T>
  [[nodiscard]] static Strain<T> strain(const Instant& now, const Each<MatrixOf<T>>& G) {
    MatrixOf<T> H, H_rate;
    for (std::size_t i = 0; i < 3; ++i) {
      H[i] = now.a[0] * G[0][i] + now.a[1] * G[1][i];
      H_rate[i] = now.a_rate[0] * G[0][i] + now.a_rate[1] * G[1][i];
    }
    const MatrixOf<T> H_T = transposed(H), rate = H_rate + H_T * H_rate;
    Strain<T> all{H, H + H_T + H_T * H, rate + transposed(rate)};
    for (std::size_t i = 0; i < 3; ++i) {
      all.F[i][i] += T(1.0);
      all.E[i] = 0.5 * all.E[i];
      all.E_rate[i] = 0.5 * all.E_rate[i];
    }
    return all;
  }
  /// P = F S by the law of St. Venant and Kirchhoff, S = D (E + c_k dE/dt), in the axes of the body.
  template <class T>
  [[nodiscard]] MatrixOf<T> stress(const Instant& now, const Each<MatrixOf<T>>& G) const {
    const Strain<T> all = strain(now, G);
    constexpr std::array<std::array<std::size_t, 2>, 6> of{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
    MatrixOf<T> S{};
    for (std::size_t n = 0; n < 6; ++n) {
      const auto [k, l] = of[n];
      const T strain = (n < 3 ? 1.0 : 2.0) * (all.E[k][l] + damping * all.E_rate[k][l]);
      for (std::size_t m = 0; m < 6; ++m) {
        const T share = material.D(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(n)) * strain;
        const auto [i, j] = of[m];
        S[i][j] += share;
        if (i != j) S[j][i] += share;
      }
    }
    return all.F * S;
  }
  /// Traction on the face of undeformed normal `n`, per undeformed area, ground's axes [Pa].
  [[nodiscard]] Vector3 traction(const Instant& now, const Vector3& X, const Vector3& n) const {
    return now.Q * (matrix(stress<double>(now, gradients<double>({X[0], X[1], X[2]}))) * n);
  }

  /// Loads that a point of the body needs at an instant.
  struct Point {
    Vector3 X;
    Each<Vector3> phi;
    std::array<Each<MatrixOf<Varied<double>>>, 3> G;  ///< gradients, with their slopes along each axis
  };
  [[nodiscard]] Point point(const Vector3& X) const {
    Point point{.X = X, .phi = {}, .G = {}};
    const auto phi = motion.shapes(VectorOf<double>{X[0], X[1], X[2]});
    for (std::size_t k = 0; k < shape_count; ++k) point.phi[k] = vector(phi[k]);
    for (int j = 0; j < 3; ++j) {
      VectorOf<Varied<double>> varied;
      for (int i = 0; i < 3; ++i) varied[static_cast<std::size_t>(i)] = Varied<double>(X[i], i == j ? 1.0 : 0.0);
      point.G[static_cast<std::size_t>(j)] = gradients(varied);
    }
    return point;
  }
  /// Force from outside per undeformed volume, ground's axes [N/m^3].
  [[nodiscard]] Vector3 load(const Instant& now, const Point& point) const {
    Vector3 divergence = Vector3::Zero();
    for (std::size_t j = 0; j < 3; ++j) {
      const auto slope = slopes(stress(now, point.G[j]));
      for (std::size_t i = 0; i < 3; ++i) divergence[static_cast<Eigen::Index>(i)] += slope[i][j];
    }
    return material.density * now.acceleration(point.X, point.phi) - now.Q * divergence;
  }
  /// Kinetic and strain energy per undeformed volume [J/m^3].
  [[nodiscard]] Eigen::Vector2d energies(const Instant& now, const Point& point) const {
    const Matrix3 E = matrix(strain(now, gradients<double>({point.X[0], point.X[1], point.X[2]})).E);
    const Vector6 strain = (Vector6() << E.diagonal(), 2 * E(0, 1), 2 * E(1, 2), 2 * E(0, 2)).finished();
    return 0.5 * Eigen::Vector2d(material.density * now.velocity(point.X, point.phi).squaredNorm(),
                                 strain.dot(material.D * strain));
  }
};

}  // namespace hersey::mbd::test
