#include "hersey/mbd/gear_mesh.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "force/taylor.h"
#include "hersey/core/contract.h"

namespace hersey::mbd {
namespace {

constexpr double kSamePitch = 1e-9;    // relative: round-off of the radii
constexpr double kMostOfPitch = 0.25;  // of the pitch: teeth that deflect more would mesh with others
constexpr double kMostTilt = 5;        // degrees between the axes: crossed axes have another line of action

/// A vector that is fixed on B, or B's origin with `shift` 1, as a function of the twist: v + xi x v + xi x (xi x v)/2.
TaylorVector moved(const Vector3& v, double shift) {
  Eigen::Matrix<double, 3, 6> first;
  first << -skew(v), shift * Matrix3::Identity();
  std::array<Taylor, 3> entries;
  for (int i = 0; i < 3; ++i) {
    // (phi x (phi x v + shift rho))_i = phi_i (phi . v) - v_i |phi|^2 + shift (phi x rho)_i
    Matrix6 second = Matrix6::Zero();
    second.topLeftCorner<3, 3>() = 0.5 * (Vector3::Unit(i) * v.transpose() + v * Vector3::Unit(i).transpose());
    second.topLeftCorner<3, 3>().diagonal().array() -= v[i];
    second.topRightCorner<3, 3>() = -0.5 * shift * skew(Vector3::Unit(i));
    second.bottomLeftCorner<3, 3>() = second.topRightCorner<3, 3>().transpose();
    entries[static_cast<std::size_t>(i)] = {v[i], first.row(i).transpose(), second};
  }
  return {entries[0], entries[1], entries[2]};
}

TaylorVector constant(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

/// (rotors.17), as a function of the twist that moves the second wheel.
struct GearMesh::Deflection {
  Taylor along;          // the line of action
  Taylor seen;           // angle at which the first wheel sees the second
  double cos_alpha = 0;  // of the pressure angle in service; above 1 there is none
  double tilt = 0;       // between the axes [deg]
};

GearMesh::GearMesh(const Data& data) : data_(data) {
  HERSEY_REQUIRE(data.teeth[0] > 0 && data.teeth[1] > 0, "wheels have teeth");
  HERSEY_REQUIRE(data.base_radius[0] > 0 && data.base_radius[1] > 0, "wheels have base circles");
  HERSEY_REQUIRE(std::abs(data.teeth[0] * data.base_radius[1] - data.teeth[1] * data.base_radius[0]) <=
                     kSamePitch * data.teeth[0] * data.base_radius[1],
                 "wheels that mesh have teeth of one pitch");
  HERSEY_REQUIRE(data.side == 1 || data.side == -1, "a torque has a sign");
  HERSEY_REQUIRE(data.stiffness >= 0 && data.damping >= 0, "a mesh stores and takes energy");
  pitch_ = 2 * std::numbers::pi * data.base_radius[0] * std::cos(data.base_helix) / data.teeth[0];
}

GearMesh::Deflection GearMesh::geometry(const RelativeMotion& motion) const {
  const double R = data_.base_radius[0] + data_.base_radius[1], side = data_.side;
  const Matrix3& axes = motion.X_AB.R;
  const TaylorVector z_1 = constant(Vector3::UnitZ()), z_2 = moved(axes.col(2), 0), d = moved(motion.X_AB.r, 1);
  Deflection found;
  found.tilt = std::atan2(axes.col(2).head<2>().norm(), axes(2, 2)) * 180 / std::numbers::pi;
  const TaylorVector both = z_1 + z_2;
  const Taylor size = sqrt(both.dot(both));
  const TaylorVector z = (1 / size) * both;
  const Taylor apart = d.dot(z);
  const TaylorVector across = d - apart * z;  // a e
  const Taylor a = sqrt(across.dot(across));
  found.cos_alpha = R / a.value;
  if (!(found.cos_alpha < 1) || !(found.tilt < kMostTilt)) return found;

  found.seen = atan2(across.y, across.x);
  const Taylor seen_from_second = atan2(-across.dot(moved(axes.col(1), 0)), -across.dot(moved(axes.col(0), 0)));
  const double tangent = std::sqrt(a.value * a.value - R * R), sin_alpha = tangent / a.value;
  // R (tan alpha - alpha), whose slope over a is sin(alpha).
  const Taylor involute =
      a.under(tangent - R * std::acos(R / a.value), sin_alpha, R * R / (a.value * a.value * a.value * sin_alpha));
  const Taylor w = apart + (data_.base_radius[1] / R) * (across.dot(z_2) / z.dot(z_2)) +
                   (data_.base_radius[0] / R) * (across.dot(z_1) / z.dot(z_1));
  const Taylor turned = data_.base_radius[0] * found.seen + data_.base_radius[1] * seen_from_second;
  found.along = std::cos(data_.base_helix) * (-side * turned - involute) + side * std::sin(data_.base_helix) * w;
  return found;
}

GearMesh::Deflection GearMesh::deflection(const RelativeMotion& motion) const {
  Deflection found = geometry(motion);
  found.along.value -= free_;
  found.along.value -= pitch_ * std::round(found.along.value / pitch_);
  // (rotors.19): once a tooth of the first wheel, which turns on as it sees the second turn back.
  if (data_.error != 0)
    found.along =
        found.along + data_.error * cos(data_.error_phase - data_.side * data_.teeth[0] * (found.seen - free_phase_));
  return found;
}

void GearMesh::mesh_here(const RelativeMotion& motion) {
  const Deflection found = geometry(motion);
  free_ = found.along.value, free_phase_ = found.seen.value;
}

void GearMesh::evaluate(const RelativeMotion& motion, bool want_tangent, ForceResponse& response) {
  response = ForceResponse{};
  fault_.clear();
  const Deflection found = deflection(motion);
  if (!(found.tilt < kMostTilt))
    fault_ = fmt::format(
        "the axes of its wheels, the z-axes of their frames, stand at {:.3g} deg to each other; they "
        "have to point the same way within {} deg",
        found.tilt, kMostTilt);
  else if (!(found.cos_alpha < 1))
    fault_ = fmt::format(
        "its wheels are {:.6g} mm apart across their axes, and involutes need more than the sum of "
        "their base radii, {:.6g} mm",
        1e3 * (data_.base_radius[0] + data_.base_radius[1]) / found.cos_alpha,
        1e3 * (data_.base_radius[0] + data_.base_radius[1]));
  else if (data_.base_radius[0] + data_.base_radius[1] > found.cos_alpha * data_.reach)
    fault_ = fmt::format(
        "its wheels are {:.6g} mm apart across their axes, and their teeth reach each other up to {:.6g} mm",
        1e3 * (data_.base_radius[0] + data_.base_radius[1]) / found.cos_alpha, 1e3 * data_.reach);
  else if (std::abs(found.along.value) > kMostOfPitch * pitch_)
    fault_ = fmt::format(
        "its teeth deflect by {:.3g} mm, more than a quarter of their pitch: the mesh is too soft for "
        "the torque, or the wheels do not roll in their ratio",
        1e3 * found.along.value);
  if (!fault_.empty()) return;

  // (rotors.18) and (rotors.20)
  const Vector6 &g = found.along.d, &V = motion.V_AB_A;
  const double F = data_.stiffness * found.along.value + data_.damping * g.dot(V);
  response.W_B_A = -F * g;
  response.summed = data_.stiffness * (data_.base_radius[0] + data_.base_radius[1]);
  response.arm = motion.X_AB.r.norm();
  if (!want_tangent) return;
  Matrix6 dg = found.along.dd;
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < 6; ++i) dg(i, j) += 0.5 * g.dot(cross_motion(Vector6::Unit(i), Vector6::Unit(j)));
  response.dW_dX = -F * dg - g * (data_.stiffness * g + data_.damping * dg.transpose() * V).transpose();
  response.dW_dV = -data_.damping * g * g.transpose();
}

double GearMesh::stored_energy(const RelativeMotion& motion) const {
  const double along = deflection(motion).along.value;
  return 0.5 * data_.stiffness * along * along;
}

double GearMesh::lost_power(const RelativeMotion& motion) const {
  const double rate = deflection(motion).along.d.dot(motion.V_AB_A);
  return data_.damping * rate * rate;
}

double GearMesh::approach(const RelativeMotion& motion) const { return geometry(motion).along.d.dot(motion.V_AB_A); }

GearMesh::Load GearMesh::load(const RelativeMotion& motion) const {
  const Deflection found = deflection(motion);
  const double rate = found.along.d.dot(motion.V_AB_A);
  Load load;
  load.deflection = found.along.value;
  load.normal = data_.stiffness * found.along.value + data_.damping * rate;
  const double transverse = load.normal * std::cos(data_.base_helix);
  load.tangential = transverse * found.cos_alpha;
  load.radial = transverse * std::sqrt(1 - found.cos_alpha * found.cos_alpha);
  load.axial = data_.side * load.normal * std::sin(data_.base_helix);
  load.damping_power = data_.damping * rate * rate;
  return load;
}

}  // namespace hersey::mbd
