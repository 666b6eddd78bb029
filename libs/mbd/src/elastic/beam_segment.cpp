#include "hersey/mbd/beam_segment.h"

#include <algorithm>

#include "hersey/core/contract.h"
#include "tree/momentum_share.h"

namespace hersey::mbd {
namespace {

using fem::BeamVector;

// As in modal_body.cpp: the share of the force of a deformation as large as the body that counts as a magnitude.
constexpr double kStiffnessShare = 1e-6;

/// Motion of one frame: acceleration of its origin with gravity taken off, in its axes.
Vector3 origin_acceleration(const ElasticFrame& frame) {
  return frame.A.tail<3>() + frame.V.head<3>().cross(frame.V.tail<3>());
}

Matrix3 relative_rotation(const ElasticMotion& motion) {
  return motion.frames[0].X_WF.R.transpose() * motion.frames[1].X_WF.R;
}

}  // namespace

BeamSegment::BeamSegment(const BeamSegmentData& data) : data_(data) {
  const fem::BeamElement& e = data.element;
  const fem::BeamStiffness& c = e.stiffness;
  HERSEY_REQUIRE(e.length > 0 && data.mass_per_length > 0 && data.damping >= 0, "a piece of a beam");
  HERSEY_REQUIRE(std::min({c.EA, c.GA_y, c.GA_z, c.GJ, c.EI_y, c.EI_z}) > 0, "a beam resists every strain");
  inertia_ = e.length / 2 * e.frame * data.inertia_per_length.asDiagonal() * e.frame.transpose();
  const double reach = std::max(data.reach, e.length);
  const double force = std::max({c.EA, c.GA_y, c.GA_z}) * reach / e.length;
  const double moment = std::max({c.GJ, c.EI_y, c.EI_z}) / e.length + force * e.length / 2;
  for (int i = 0; i < 12; ++i) round_off_[i] = kStiffnessShare * (i % 6 < 3 ? moment : force);
}

Pose BeamSegment::rest_pose(int i) const {
  return {Matrix3::Identity(), i == 0 ? Vector3(0, 0, 0) : Vector3(data_.element.length * data_.element.frame.col(0))};
}

fem::BeamMotionResponse BeamSegment::section(const ElasticMotion& motion) const {
  const ElasticFrame &a = motion.frames[0], &b = motion.frames[1];
  return fem::beam_response(data_.element, {a.X_WF, b.X_WF, a.V, b.V}, data_.damping);
}

/// Theory manual eq. (beams.4).
BeamVector BeamSegment::inertia_force(const ElasticMotion& motion) const {
  const Matrix3 R_ab = relative_rotation(motion);
  const Vector3 a = origin_acceleration(motion.frames[0]), b = origin_acceleration(motion.frames[1]);
  const double third = mass() / 3, sixth = mass() / 6;
  const auto moment = [&](const ElasticFrame& frame) {
    const Vector3 omega = frame.V.head<3>();
    return Vector3(inertia_ * frame.A.head<3>() + omega.cross(inertia_ * omega));
  };
  BeamVector force;
  force << moment(motion.frames[0]), third * a + sixth * (R_ab * b), moment(motion.frames[1]),
      third * b + sixth * (R_ab.transpose() * a);
  return force;
}

/// Theory manual eq. (beams.5).
void BeamSegment::differentiate_inertia(const ElasticMotion& motion, ElasticResponse& response) const {
  const Matrix3 R_ab = relative_rotation(motion);
  const double third = mass() / 3, sixth = mass() / 6;
  for (int i = 0; i < 2; ++i) {
    const int j = 1 - i, moment = 6 * i, force = 6 * i + 3;
    const Matrix3 R = i == 0 ? R_ab : Matrix3(R_ab.transpose());  // from the other frame's axes to this one's
    const ElasticFrame &here = motion.frames[static_cast<std::size_t>(i)],
                       &other = motion.frames[static_cast<std::size_t>(j)];
    const Vector3 omega = here.V.head<3>(), far = origin_acceleration(other);
    response.M.block<3, 3>(moment, moment) += inertia_;
    response.C.block<3, 3>(moment, moment) += skew(omega) * inertia_ - skew(inertia_ * omega);
    response.M.block<3, 3>(force, force) += third * Matrix3::Identity();
    response.M.block<3, 3>(force, 6 * j + 3) += sixth * R;
    response.C.block<3, 3>(force, moment) -= third * skew(here.V.tail<3>());
    response.C.block<3, 3>(force, force) += third * skew(omega);
    response.C.block<3, 3>(force, 6 * j) -= sixth * R * skew(other.V.tail<3>());
    response.C.block<3, 3>(force, 6 * j + 3) += sixth * R * skew(other.V.head<3>());
    response.K.block<3, 3>(force, moment) += sixth * skew(R * far);
    response.K.block<3, 3>(force, 6 * j) -= sixth * R * skew(far);
  }
}

BeamVector BeamSegment::magnitude(const ElasticMotion& motion, const BeamVector& inertia,
                                  const fem::BeamMotionResponse& strained) const {
  BeamVector size = inertia.cwiseAbs() + strained.force.cwiseAbs() + round_off_;
  if (motion.stage.dt == 0) return size;
  for (int i = 0; i < 2; ++i) {
    const Vector6& V = motion.frames[static_cast<std::size_t>(i)].V;
    size.segment<3>(6 * i) += kMomentumShare / motion.stage.dt * (inertia_ * V.head<3>()).cwiseAbs();
    size.segment<3>(6 * i + 3) += kMomentumShare / motion.stage.dt * mass() / 2 * V.tail<3>().cwiseAbs();
  }
  return size;
}

void BeamSegment::evaluate(const ElasticMotion& motion, bool want_tangent, ElasticResponse& response) {
  const fem::BeamMotionResponse strained = section(motion);
  const BeamVector inertia = inertia_force(motion);
  response.force = strained.force + inertia;
  response.magnitude = magnitude(motion, inertia, strained);
  if (!want_tangent) return;
  response.K = strained.K;
  response.C = strained.C;
  response.M.setZero(12, 12);
  differentiate_inertia(motion, response);
}

/// Theory manual eq. (beams.6).
ElasticEnergy BeamSegment::energy(const ElasticMotion& motion, const Vector3& gravity) {
  const fem::BeamMotionResponse strained = section(motion);
  const double third = mass() / 3, sixth = mass() / 6;
  ElasticEnergy e;
  e.strain = strained.energy;
  e.strain_rate = strained.energy_rate;
  e.dissipation = strained.dissipation;
  Vector3 v[2], r[2], middle = Vector3::Zero();
  for (int i = 0; i < 2; ++i) {
    const ElasticFrame& frame = motion.frames[static_cast<std::size_t>(i)];
    v[i] = frame.X_WF.R * frame.V.tail<3>();
    r[i] = frame.X_WF.r;
    middle += r[i] / 2;
    const Vector3 omega = frame.V.head<3>(), spin = inertia_ * omega;
    e.kinetic += 0.5 * omega.dot(spin);
    e.angular_momentum += frame.X_WF.R * spin;
  }
  for (int i = 0; i < 2; ++i) {
    const Vector3 p = third * v[i] + sixth * v[1 - i];
    e.kinetic += 0.5 * v[i].dot(p);
    e.momentum += p;
    e.angular_momentum += r[i].cross(p);
  }
  e.potential = -mass() * gravity.dot(middle);
  e.gravity = gravity.dot(e.momentum);
  BeamVector V;
  V << motion.frames[0].V, motion.frames[1].V;
  e.kinetic_rate = inertia_force(motion).dot(V) + e.gravity;
  return e;
}

}  // namespace hersey::mbd
