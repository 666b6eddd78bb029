#include "hersey/mbd/contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "contact/contact_point_force.h"
#include "contact/contact_points.h"
#include "hersey/core/contract.h"

namespace hersey::mbd {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

double size_of_mesh(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vector3& corner : mesh.corners) box.extend(corner);
  const Vector3 half = 0.5 * box.sizes();
  // A flat sheet has no thickness; what limits penetration is then its partner.
  return half.minCoeff() > 1e-6 * half.maxCoeff() ? half.minCoeff() : half.maxCoeff();
}

/// Radius, or half of the smallest extent [m].
double size_of(const ShapeGeometry& shape) {
  if (const auto* ball = std::get_if<Sphere>(&shape)) return ball->radius;
  if (const auto* capsule = std::get_if<Capsule>(&shape)) return capsule->radius;
  if (const auto* cylinder = std::get_if<Cylinder>(&shape))
    return std::min(cylinder->radius, 0.5 * (cylinder->to - cylinder->from).norm());
  if (const auto* box = std::get_if<Box>(&shape)) return 0.5 * box->size.minCoeff();
  if (const auto* mesh = std::get_if<std::shared_ptr<const TriangleMesh>>(&shape)) return size_of_mesh(**mesh);
  return kUnbounded;
}

/// Returns a vector fixed in B, given in A, with its derivative by the rotation of B.
Vec3<Dual> rotating_vector(const Vector3& v) {
  Vec3<Dual> rotated;
  const Matrix3 dv = -skew(v);
  for (int i = 0; i < 3; ++i) {
    rotated[i] = Dual(v[i]);
    for (int k = 0; k < 3; ++k) rotated[i].d[k] = dv(i, k);
  }
  return rotated;
}

/// X_AB moved by a twist xi, d/dxi: rotations act from the left, in A's axes.
PoseOf<Dual> pose_with_derivatives(const Pose& X) {
  PoseOf<Dual> dual;
  dual.x = rotating_vector(X.R.col(0));
  dual.y = rotating_vector(X.R.col(1));
  dual.z = rotating_vector(X.R.col(2));
  dual.r = rotating_vector(X.r);
  for (int i = 0; i < 3; ++i) dual.r[i].d[3 + i] = 1;
  return dual;
}

struct VelocityOf {
  Vec3<Dual> omega, v;
};

VelocityOf velocity_with_derivatives(const Vector6& V) {
  VelocityOf dual;
  for (int i = 0; i < 3; ++i) {
    dual.omega[i] = Dual(V[i]);
    dual.omega[i].d[6 + i] = 1;
    dual.v[i] = Dual(V[3 + i]);
    dual.v[i].d[9 + i] = 1;
  }
  return dual;
}

}  // namespace

struct Contact::Workspace {
  std::unique_ptr<ContactSearch> search;
  std::vector<ContactPointId> found;
};

/// Motion of B's material at one contact point: the pose of B shifted by the displacement of the corner, and the
/// velocity of deformation of the corner, in A.
struct Contact::MaterialMotion {
  Pose X_AB;
  Vector3 velocity = Vector3::Zero();
  int corner = -1;  ///< -1 for a rigid shape
};

Contact::Contact(const ShapeGeometry& a, const ShapeGeometry& b, const ContactLaw& law)
    : law_(law), deepest_(deepest_share * std::min(size_of(a), size_of(b))), work_(std::make_unique<Workspace>()) {
  HERSEY_REQUIRE(law.stiffness > 0 && law.exponent >= 1 && law.damping >= 0, "surfaces resist penetration");
  HERSEY_REQUIRE(law.friction >= 0 && (law.friction == 0 || law.slip_speed > 0), "friction is regularised");
  work_->search = make_contact_search(a, b);
  HERSEY_REQUIRE(work_->search != nullptr, "the pair of shapes is supported");
  work_->found.reserve(16);
}

Contact::Contact(const ShapeGeometry& a, std::shared_ptr<const TriangleMesh> b, Eigen::MatrixXd displacements,
                 const ContactLaw& law)
    : law_(law),
      displacements_(std::move(displacements)),
      deepest_(deepest_share * std::min(size_of(a), size_of_mesh(*b))),
      work_(std::make_unique<Workspace>()) {
  HERSEY_REQUIRE(displacements_.rows() == 3 * static_cast<Eigen::Index>(b->corners.size()), "one of every corner");
  HERSEY_REQUIRE(can_touch_deforming(a), "corners touch a solid");
  work_->search = corners_on_solid(std::move(b), a, true);
}

Contact::~Contact() = default;

Contact::MaterialMotion Contact::material_motion(const RelativeMotion& motion, int corner) const {
  MaterialMotion material{motion.X_AB};
  if (displacements_.rows() == 0) return material;
  const auto U = displacements_.middleRows<3>(3 * corner);
  material.X_AB.r += motion.X_AB.R * (U * motion.s);
  material.velocity = motion.X_AB.R * (U * motion.s_rate);
  material.corner = corner;
  return material;
}

const std::vector<ContactPointId>& Contact::find(const RelativeMotion& motion) const {
  work_->found.clear();
  if (displacements_.rows() == 0) {
    work_->search->find(motion.X_AB, work_->found);
    return work_->found;
  }
  work_->search->find_all(work_->found);
  std::erase_if(work_->found, [&](const ContactPointId& id) {
    return !(work_->search->point(id, plain_pose(material_motion(motion, id.index).X_AB)).gap < 0);
  });
  return work_->found;
}

/// Adds the generalised forces of a force on B at a contact point on the shapes that move its corner.
void Contact::push_shapes(const MaterialMotion& material, const Vector3& force, ForceResponse& response) const {
  if (material.corner < 0) return;
  response.Q.noalias() +=
      displacements_.middleRows<3>(3 * material.corner).transpose() * (material.X_AB.R.transpose() * force);
}

/// Adds the derivatives of these forces; `derivative` is that of torque and force by [twist; velocity] of the contact
/// point, 12 columns.
void Contact::differentiate_shapes(const MaterialMotion& material, const Vector3& force,
                                   const Eigen::Matrix<double, 6, 12>& derivative, ForceResponse& response) const {
  if (material.corner < 0) return;
  const auto U = displacements_.middleRows<3>(3 * material.corner);
  const Matrix3& R = material.X_AB.R;
  const Eigen::Matrix<double, 3, Eigen::Dynamic> RU = R * U;
  Eigen::Matrix<double, 3, 6> by_twist = derivative.block<3, 6>(3, 0);
  by_twist.leftCols<3>() += skew(force);  // the shapes rotate with B
  response.dW_ds.noalias() += derivative.middleCols<3>(3) * RU;
  response.dW_dr.noalias() += derivative.middleCols<3>(9) * RU;
  response.dQ_dX.noalias() += RU.transpose() * by_twist;
  response.dQ_dV.noalias() += RU.transpose() * derivative.block<3, 6>(3, 6);
  response.dQ_ds.noalias() += RU.transpose() * (derivative.block<3, 3>(3, 3) * RU);
  response.dQ_dr.noalias() += RU.transpose() * (derivative.block<3, 3>(3, 9) * RU);
}

void Contact::evaluate(const RelativeMotion& motion, bool want_tangent, ForceResponse& response) {
  response.set_zero(motion.s.size());
  too_deep_ = 0;
  const Vector3 omega = motion.V_AB_A.head<3>(), v = motion.V_AB_A.tail<3>();
  for (const ContactPointId& id : find(motion)) {
    const MaterialMotion material = material_motion(motion, id.index);
    const ContactPoint<double> point = work_->search->point(id, plain_pose(material.X_AB));
    if (-point.gap > deepest_) too_deep_ = std::max(too_deep_, -point.gap);
    // B's material moves with (contact.1), and with (contact.4) where it deforms.
    const ContactPointForce<double> force =
        contact_point_force<double>(law_, point, v + omega.cross(point.position) + material.velocity);
    const Vector3 f = force.normal * point.normal + force.friction;
    response.W_B_A.head<3>() += point.position.cross(f);
    response.W_B_A.tail<3>() += f;
    push_shapes(material, f, response);
  }
  if (!want_tangent) return;
  for (const ContactPointId& id : work_->found) differentiate(id, motion, response);
}

void Contact::differentiate(const ContactPointId& id, const RelativeMotion& motion, ForceResponse& response) const {
  const MaterialMotion material = material_motion(motion, id.index);
  const VelocityOf V = velocity_with_derivatives(motion.V_AB_A);
  const ContactPoint<Dual> point = work_->search->point(id, pose_with_derivatives(material.X_AB));
  Vec3<Dual> velocity = V.v + cross(V.omega, point.position);
  if (material.corner >= 0) velocity += rotating_vector(material.velocity);
  const ContactPointForce<Dual> force = contact_point_force<Dual>(law_, point, velocity);
  const Vec3<Dual> f = scaled(force.normal, point.normal) + force.friction;
  const Vec3<Dual> torque = cross(point.position, f);
  Eigen::Matrix<double, 6, 12> derivative;
  Vector3 value;
  for (int i = 0; i < 3; ++i) {
    derivative.row(i) = torque[i].d.matrix().transpose();
    derivative.row(3 + i) = f[i].d.matrix().transpose();
    value[i] = value_of(f[i]);
  }
  response.dW_dX += derivative.leftCols<6>();
  response.dW_dV += derivative.rightCols<6>();
  differentiate_shapes(material, value, derivative, response);
}

double Contact::stored_energy(const RelativeMotion& motion) const {
  double energy = 0;
  for (const ContactPointId& id : find(motion)) {
    const ContactPoint<double> point = work_->search->point(id, plain_pose(material_motion(motion, id.index).X_AB));
    energy += point.weight * law_.stiffness * std::pow(-point.gap, law_.exponent + 1) / (law_.exponent + 1);
  }
  return energy;
}

std::string Contact::domain_error() const {
  if (too_deep_ == 0) return {};
  return fmt::format("the shapes overlap by {:.3g} mm, more than {:.3g} mm ({:g} % of the smaller one's size)",
                     1e3 * too_deep_, 1e3 * deepest_, 100 * deepest_share);
}

double Contact::smallest_gap(const RelativeMotion& motion) const {
  if (displacements_.rows() == 0) return work_->search->smallest_gap(motion.X_AB);
  double nearest = kUnbounded;
  std::vector<ContactPointId> all;
  work_->search->find_all(all);
  for (const ContactPointId& id : all)
    nearest = std::min(nearest, work_->search->point(id, plain_pose(material_motion(motion, id.index).X_AB)).gap);
  return nearest;
}

ContactObservation Contact::observe(const RelativeMotion& motion) {
  ContactObservation observation;
  observation.gap = smallest_gap(motion);
  const Vector3 omega = motion.V_AB_A.head<3>(), v = motion.V_AB_A.tail<3>();
  for (const ContactPointId& id : find(motion)) {
    const MaterialMotion material = material_motion(motion, id.index);
    const ContactPoint<double> point = work_->search->point(id, plain_pose(material.X_AB));
    const Vector3 velocity = v + omega.cross(point.position) + material.velocity;
    const ContactPointForce<double> force = contact_point_force<double>(law_, point, velocity);
    const double rate = -point.normal.dot(velocity);
    const double elastic = point.weight * law_.stiffness * std::pow(-point.gap, law_.exponent);
    ++observation.spots;
    observation.normal_force += force.normal;
    observation.friction += force.friction;
    observation.force += force.normal * point.normal + force.friction;
    observation.position += force.normal * point.position;
    observation.damping_power += (force.normal - elastic) * rate;
    observation.friction_power -= force.friction.dot(velocity);
  }
  observation.position /= observation.normal_force;  // not a number without contact
  return observation;
}

bool can_touch(const ShapeGeometry& a, const ShapeGeometry& b) { return make_contact_search(a, b) != nullptr; }

bool can_touch_deforming(const ShapeGeometry& shape) {
  return !std::holds_alternative<std::shared_ptr<const TriangleMesh>>(shape);
}

bool touches_with_pressure(const ShapeGeometry& a, const ShapeGeometry& b) {
  const std::unique_ptr<ContactSearch> search = make_contact_search(a, b);
  return search != nullptr && search->weighs_area();
}

std::string name_of(const ShapeGeometry& shape) {
  struct Name {
    std::string operator()(const Sphere&) const { return "sphere"; }
    std::string operator()(const Cylinder&) const { return "cylinder"; }
    std::string operator()(const Capsule&) const { return "capsule"; }
    std::string operator()(const Box&) const { return "box"; }
    std::string operator()(const HalfSpace&) const { return "half_space"; }
    std::string operator()(const std::shared_ptr<const TriangleMesh>&) const { return "mesh"; }
  };
  return std::visit(Name{}, shape);
}

}  // namespace hersey::mbd
