#include "hersey/fem/beam.h"

#include <algorithm>
#include <array>

#include "element/beam_dual.h"
#include "hersey/core/contract.h"

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

/// Deformation of an element, and the quantities that its forces need.
struct Deformation {
  Rotation half, R_m;  ///< half: from the section at a to the middle section; R_m: of the middle section
  Vec3 psi, along;     ///< along: from a to b in the axes of the middle section
  Vec3 Gamma;
};

/// (elastic.18).
Deformation deformation(const BeamElement& element, const Ends& ends) {
  Rotation relative = inverse(ends.R_a) * ends.R_b;
  if (relative.w.value < 0) relative = {-relative.w, Dual(-1) * relative.v};
  Deformation d{.half = half_of(relative), .psi = log(relative)};
  d.R_m = ends.R_a * d.half;
  d.along = inverse(d.R_m) * (ends.r_b - ends.r_a);
  const double L = element.length;
  d.Gamma = {d.along[0] / L - 1, d.along[1] / L, d.along[2] / L};
  return d;
}

/// Forces in the middle section.
struct SectionForces {
  Vec3 N, M;
};
SectionForces section_forces(const BeamStiffness& c, const Vec3& Gamma, const Vec3& kappa) {
  return {.N = {c.EA * Gamma[0], c.GA_y * Gamma[1], c.GA_z * Gamma[2]},
          .M = {c.GJ * kappa[0], c.EI_y * kappa[1], c.EI_z * kappa[2]}};
}

/// Wrenches on both ends, moments in their sections' axes, forces in space.
struct EndForces {
  Vec3 moment_a, force_a, moment_b, force_b;
};

/// (elastic.19). d Gamma = (R_m^T d(r_b - r_a) + along x dtheta_m)/L, d psi = T^-1(psi) dtheta_b - T^-T(psi) dtheta_a,
/// dtheta_m = exp(-psi/2) dtheta_a + T(psi/2) d psi/2: the forces are what stands before each of them in d energy.
EndForces end_forces(const Deformation& d, const SectionForces& section) {
  const Vec3 couple = cross(section.N, d.along);
  const Vec3 on_psi = section.M + Dual(0.5) * transposed_tangent(Dual(0.5) * d.psi, couple);
  const Vec3 force = d.R_m * section.N;
  return {.moment_a = d.half * couple - inverse_tangent(d.psi, on_psi),
          .force_a = Dual(-1) * force,
          .moment_b = inverse_tangent(Dual(-1) * d.psi, on_psi),
          .force_b = force};
}

/// Rates of Gamma and kappa, by the same differentials: theory manual eq. (beams.2).
struct StrainRates {
  Vec3 Gamma, kappa;
};
StrainRates strain_rates(const BeamElement& element, const Ends& ends, const Deformation& d, const BeamVector& V) {
  const auto given = [&](int first) { return Vec3{Dual(V[first]), Dual(V[first + 1]), Dual(V[first + 2])}; };
  const Vec3 omega_a = given(0), omega_b = given(6);
  const Vec3 psi_rate = inverse_tangent(d.psi, omega_b) - inverse_tangent(Dual(-1) * d.psi, omega_a);
  const Vec3 omega_m =
      inverse(d.half) * omega_a + Dual(0.5) * transposed_tangent(Dual(-0.5) * d.psi, psi_rate);  // T(x) = T^T(-x)
  const Vec3 along_rate = inverse(d.R_m) * (ends.R_b * given(9) - ends.R_a * given(3)) + cross(d.along, omega_m);
  const Dual by_length = 1 / element.length;
  return {by_length * along_rate, by_length * psi_rate};
}

double energy_of(const BeamElement& element, const Deformation& d, const SectionForces& section) {
  return (element.length * dot(d.Gamma, section.N) + dot(d.psi, section.M)).value / 2;
}

SectionForces elastic_forces(const BeamElement& element, const Deformation& d) {
  return section_forces(element.stiffness, d.Gamma, Dual(1 / element.length) * d.psi);
}

/// The section's rotation with its derivatives: q (1 + theta/2) to the first order.
Rotation varied(const Eigen::Quaterniond& q, int first) {
  Rotation small{.w = 1};
  for (int k = 0; k < 3; ++k) small.v[static_cast<std::size_t>(k)] = Dual(0, 0.5 * BeamVector::Unit(first + k));
  return Rotation{q.w(), {q.x(), q.y(), q.z()}} * small;
}

/// Values and derivatives of the four parts of a wrench on each end.
void put(const EndForces& forces, BeamVector& values, BeamMatrix& derivatives) {
  int row = 0;
  for (const Vec3* part : {&forces.moment_a, &forces.force_a, &forces.moment_b, &forces.force_b})
    for (const Dual& component : *part) {
      values[row] = component.value;
      derivatives.row(row++) = component.d.transpose();
    }
}

Vector6 values(const Vec3& a, const Vec3& b) {
  return (Vector6() << a[0].value, a[1].value, a[2].value, b[0].value, b[1].value, b[2].value).finished();
}

/// From each node's axes to those of its section, in all four parts.
BeamMatrix sections_from_nodes(const BeamElement& element) {
  BeamMatrix to_section = BeamMatrix::Zero();
  for (int i = 0; i < 12; i += 3) to_section.block<3, 3>(i, i) = element.frame.transpose();
  return to_section;
}

/// A displacement in the axes of the section: r + R d to the first order.
Vec3 varied_along(const Vector3& r, const Rotation& section, int first) {
  const Vec3 d = {Dual(0, BeamVector::Unit(first)), Dual(0, BeamVector::Unit(first + 1)),
                  Dual(0, BeamVector::Unit(first + 2))};
  const Vec3 rotated = section * d;
  return {Dual(r[0]) + rotated[0], Dual(r[1]) + rotated[1], Dual(r[2]) + rotated[2]};
}

/// Both ends with all derivatives in section axes, relative to the position and axes of node a.
Ends ends_of(const BeamElement& element, const BeamMotion& motion) {
  const Eigen::Quaterniond E(element.frame);
  const Matrix3 R_ab = motion.X_a.R.transpose() * motion.X_b.R;
  Ends ends;
  ends.R_a = varied(E, 0);
  ends.R_b = varied(Eigen::Quaterniond(R_ab).normalized() * E, 6);
  ends.r_a = varied_along(Vector3::Zero(), ends.R_a, 3);
  ends.r_b = varied_along(motion.X_a.R.transpose() * (motion.X_b.r - motion.X_a.r), ends.R_b, 9);
  return ends;
}

/// Rows of d[Gamma; kappa].
Eigen::Matrix<double, 6, 12> strain_derivatives(const Deformation& d, double length) {
  Eigen::Matrix<double, 6, 12> B;
  for (int i = 0; i < 3; ++i) {
    B.row(i) = d.Gamma[static_cast<std::size_t>(i)].d.transpose();
    B.row(3 + i) = d.psi[static_cast<std::size_t>(i)].d.transpose() / length;
  }
  return B;
}

}  // namespace

BeamStiffness beam_stiffness(const BeamSection& s, const ElasticMaterial& material) {
  HERSEY_REQUIRE(std::min({s.area, s.shear_y, s.shear_z, s.I_y, s.I_z, s.J}) > 0, "a section has area and stiffness");
  const double E = material.youngs_modulus, G = E / (2 * (1 + material.poisson_ratio));
  return {E * s.area, G * s.shear_y, G * s.shear_z, G * s.J, E * s.I_y, E * s.I_z};
}

BeamMotionResponse beam_response(const BeamElement& element, const BeamMotion& motion, double damping) {
  const Ends ends = ends_of(element, motion);
  const Deformation d = deformation(element, ends);
  const BeamMatrix to_section = sections_from_nodes(element);
  BeamVector V;
  V << motion.V_a, motion.V_b;
  const StrainRates rates = strain_rates(element, ends, d, to_section * V);
  const SectionForces elastic = elastic_forces(element, d);
  const SectionForces viscous =
      section_forces(element.stiffness, Dual(damping) * rates.Gamma, Dual(damping) * rates.kappa);

  BeamMotionResponse response;
  response.energy = energy_of(element, d, elastic);
  response.strain = values(d.Gamma, Dual(1 / element.length) * d.psi);
  response.elastic = values(elastic.N, elastic.M);
  response.viscous = values(viscous.N, viscous.M);
  const Vector6 rate = values(rates.Gamma, rates.kappa);
  response.energy_rate = element.length * rate.dot(response.elastic);
  response.dissipation = element.length * rate.dot(response.viscous);
  EndForces forces = end_forces(d, {elastic.N + viscous.N, elastic.M + viscous.M});
  forces.force_a = inverse(ends.R_a) * forces.force_a;
  forces.force_b = inverse(ends.R_b) * forces.force_b;
  put(forces, response.force, response.K);
  const BeamStiffness& c = element.stiffness;
  const Vector6 D = (Vector6() << c.EA, c.GA_y, c.GA_z, c.GJ, c.EI_y, c.EI_z).finished();
  const Eigen::Matrix<double, 6, 12> B = strain_derivatives(d, element.length);
  response.C = damping * element.length * B.transpose() * D.asDiagonal() * B;

  response.force = to_section.transpose() * response.force;
  response.K = to_section.transpose() * response.K * to_section;
  response.C = to_section.transpose() * response.C * to_section;
  return response;
}

}  // namespace hersey::fem
