#include <array>

#include "beam_dual.h"
#include "hersey/fem/beam.h"

namespace hersey::fem {
namespace {

using Vec3 = std::array<Dual, 3>;

Vec3 operator+(const Vec3& a, const Vec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vec3 operator-(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec3 operator*(const Dual& s, const Vec3& a) { return {s * a[0], s * a[1], s * a[2]}; }
Dual dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Unit quaternion w + v.
struct Rotation {
  Dual w;
  Vec3 v;
};

Rotation operator*(const Rotation& a, const Rotation& b) {
  return {a.w * b.w - dot(a.v, b.v), cross(a.v, b.v) + a.w * b.v + b.w * a.v};
}
Rotation inverse(const Rotation& q) { return {q.w, Dual(-1) * q.v}; }
Vec3 operator*(const Rotation& q, const Vec3& x) {
  const Vec3 t = cross(q.v, x);
  return x + Dual(2) * (q.w * t + cross(q.v, t));
}

// Below this square of an angle series are used: the first term they leave out is below 1e-16.
constexpr double small_square = 1e-3;

/// Rotation vector of q, w >= 0.
Vec3 log(const Rotation& q) {
  const Dual s = dot(q.v, q.v);  // sin^2 of half the angle
  if (s.value < small_square)    // 2 asin(x)/x with x^2 = s
    return (Dual(2) + s * (1.0 / 3 + s * (3.0 / 20 + s * (5.0 / 56 + s * (35.0 / 576 + s * (63.0 / 1408)))))) * q.v;
  const Dual sine = sqrt(s);
  return (Dual(2) * atan2(sine, q.w) / sine) * q.v;
}

/// Half of the rotation q, w >= 0.
Rotation half_of(const Rotation& q) {
  const Dual w = sqrt((Dual(1) + q.w) / 2);
  return {w, (Dual(0.5) / w) * q.v};
}

/// (1 - (phi/2) cot(phi/2))/phi^2 of s = phi^2.
Dual inverse_tangent_coefficient(const Dual& s) {
  if (s.value < small_square)
    return 1.0 / 12 + s * (1.0 / 720 + s * (1.0 / 30240 + s * (1.0 / 1209600 + s * (1.0 / 47900160))));
  const Dual half = sqrt(s) / 2;
  return (Dual(1) - half * cos(half) / sin(half)) / s;
}

/// T^-1(psi) x = x + psi x x/2 + c psi x (psi x x); T^-T is T^-1(-psi).
Vec3 inverse_tangent(const Vec3& psi, const Vec3& x) {
  const Vec3 t = cross(psi, x);
  return x + Dual(0.5) * t + inverse_tangent_coefficient(dot(psi, psi)) * cross(psi, t);
}

/// T^T(psi) x = x + a psi x x + b psi x (psi x x), a = (1 - cos phi)/phi^2, b = (phi - sin phi)/phi^3.
Vec3 transposed_tangent(const Vec3& psi, const Vec3& x) {
  const Dual s = dot(psi, psi);
  Dual a = 0.5 - s * (1.0 / 24 - s * (1.0 / 720 - s * (1.0 / 40320 - s * (1.0 / 3628800))));
  Dual b = 1.0 / 6 - s * (1.0 / 120 - s * (1.0 / 5040 - s * (1.0 / 362880 - s * (1.0 / 39916800))));
  if (s.value > small_square) {
    const Dual phi = sqrt(s);
    a = (Dual(1) - cos(phi)) / s;
    b = (phi - sin(phi)) / (s * phi);
  }
  const Vec3 t = cross(psi, x);
  return x + a * t + b * cross(psi, t);
}

/// Sections and positions of both ends.
struct Ends {
  Rotation R_a, R_b;
  Vec3 r_a, r_b;
};

/// Wrenches on both ends, moments in their sections' axes, and the energy.
struct EndForces {
  Dual energy;
  Vec3 moment_a, force_a, moment_b, force_b;
};

/// (elastic.16), (elastic.17).
EndForces end_forces(const BeamElement& element, const Ends& ends) {
  Rotation relative = inverse(ends.R_a) * ends.R_b;
  if (relative.w.value < 0) relative = {-relative.w, Dual(-1) * relative.v};
  const Vec3 psi = log(relative);
  const Rotation half = half_of(relative), R_m = ends.R_a * half;
  const Vec3 along = inverse(R_m) * (ends.r_b - ends.r_a);  // in the axes of the middle section

  const BeamStiffness& c = element.stiffness;
  const double L = element.length;
  const Vec3 Gamma = {along[0] / L - 1, along[1] / L, along[2] / L};
  const Vec3 N = {c.EA * Gamma[0], c.GA_y * Gamma[1], c.GA_z * Gamma[2]};
  const Vec3 M = {c.GJ / L * psi[0], c.EI_y / L * psi[1], c.EI_z / L * psi[2]};

  // d Gamma = (R_m^T d(r_b - r_a) + along x dtheta_m)/L, d psi = T^-1(psi) dtheta_b - T^-T(psi) dtheta_a,
  // dtheta_m = exp(-psi/2) dtheta_a + T(psi/2) d psi/2: the forces are what stands before each of them in d energy.
  const Vec3 couple = cross(N, along);
  const Vec3 on_psi = M + Dual(0.5) * transposed_tangent(Dual(0.5) * psi, couple);
  const Vec3 force = R_m * N;
  return {.energy = (L * dot(Gamma, N) + dot(psi, M)) / 2,
          .moment_a = half * couple - inverse_tangent(psi, on_psi),
          .force_a = Dual(-1) * force,
          .moment_b = inverse_tangent(Dual(-1) * psi, on_psi),
          .force_b = force};
}

/// The section's rotation with its derivatives: q (1 + theta/2) to the first order.
Rotation varied(const Eigen::Quaterniond& q, int first) {
  Rotation turn{.w = 1};
  for (int k = 0; k < 3; ++k) turn.v[static_cast<std::size_t>(k)] = Dual(0, 0.5 * BeamVector::Unit(first + k));
  return Rotation{q.w(), {q.x(), q.y(), q.z()}} * turn;
}

Vec3 varied(const Vector3& r, int first) {
  return {Dual(r[0], BeamVector::Unit(first)), Dual(r[1], BeamVector::Unit(first + 1)),
          Dual(r[2], BeamVector::Unit(first + 2))};
}

}  // namespace

BeamResponse beam_response(const BeamElement& element, const BeamState& state) {
  const Eigen::Quaterniond E(element.frame);
  const auto a = static_cast<std::size_t>(element.a), b = static_cast<std::size_t>(element.b);
  const EndForces forces = end_forces(
      element, {varied(state.R[a] * E, 0), varied(state.R[b] * E, 6), varied(state.r[a], 3), varied(state.r[b], 9)});
  BeamResponse response;
  response.energy = forces.energy.value;
  int row = 0;
  for (const Vec3* part : {&forces.moment_a, &forces.force_a, &forces.moment_b, &forces.force_b})
    for (const Dual& component : *part) {
      response.force[row] = component.value;
      response.tangent.row(row++) = component.d.transpose();
    }
  // So far turns were in the section's axes; those of the unknowns are in the node's.
  BeamMatrix to_section = BeamMatrix::Identity();
  to_section.block<3, 3>(0, 0) = to_section.block<3, 3>(6, 6) = element.frame.transpose();
  response.force = to_section.transpose() * response.force;
  response.tangent = to_section.transpose() * response.tangent * to_section;
  return response;
}

}  // namespace hersey::fem
