#include "hersey/mbd/contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "contact/contact_spots.h"
#include "contact/spot_force.h"
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

/// A vector of B's, given in A, with its derivative as B turns.
Vec3<Dual> turning(const Vector3& v) {
  Vec3<Dual> turned;
  const Matrix3 dv = -skew(v);
  for (int i = 0; i < 3; ++i) {
    turned[i] = Dual(v[i]);
    for (int k = 0; k < 3; ++k) turned[i].d[k] = dv(i, k);
  }
  return turned;
}

/// X_AB moved by a twist xi, d/dxi: rotations act from the left, in A's axes.
PoseOf<Dual> pose_with_derivatives(const Pose& X) {
  PoseOf<Dual> dual;
  dual.x = turning(X.R.col(0));
  dual.y = turning(X.R.col(1));
  dual.z = turning(X.R.col(2));
  dual.r = turning(X.r);
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
  std::unique_ptr<ContactSearch> finder;
  std::vector<ContactPointId> found;
};

/// Where B's material of one spot is: the pose of B that puts the undeformed corner where it is now, and the velocity
/// by which the corner deforms, in A.
struct Contact::Place {
  Pose X_AB;
  Vector3 velocity = Vector3::Zero();
  int corner = -1;  ///< -1: nothing deforms
};

Contact::Contact(const ShapeGeometry& a, const ShapeGeometry& b, const ContactLaw& law)
    : law_(law), deepest_(deepest_share * std::min(size_of(a), size_of(b))), work_(std::make_unique<Workspace>()) {
  HERSEY_REQUIRE(law.stiffness > 0 && law.exponent >= 1 && law.damping >= 0, "surfaces resist penetration");
  HERSEY_REQUIRE(law.friction >= 0 && (law.friction == 0 || law.slip_speed > 0), "friction is regularised");
  work_->finder = make_spot_finder(a, b);
  HERSEY_REQUIRE(work_->finder != nullptr, "the pair of shapes is supported");
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
  work_->finder = corners_on_solid(std::move(b), a, true);
}

Contact::~Contact() = default;

Contact::Place Contact::place_of(const RelativeMotion& motion, int corner) const {
  Place place{motion.X_AB};
  if (displacements_.rows() == 0) return place;
  const auto U = displacements_.middleRows<3>(3 * corner);
  place.X_AB.r += motion.X_AB.R * (U * motion.s);
  place.velocity = motion.X_AB.R * (U * motion.s_rate);
  place.corner = corner;
  return place;
}

const std::vector<ContactPointId>& Contact::find(const RelativeMotion& motion) const {
  work_->found.clear();
  if (displacements_.rows() == 0) {
    work_->finder->find(motion.X_AB, work_->found);
    return work_->found;
  }
  work_->finder->find_all(work_->found);
  std::erase_if(work_->found, [&](const ContactPointId& id) {
    return !(work_->finder->spot(id, plain_pose(place_of(motion, id.index).X_AB)).gap < 0);
  });
  return work_->found;
}

/// Force `f` on B at a spot, and how it changes, on the shapes that move its corner.
void Contact::push_shapes(const Place& place, const Vector3& force, ForceResponse& response) const {
  if (place.corner < 0) return;
  response.Q.noalias() +=
      displacements_.middleRows<3>(3 * place.corner).transpose() * (place.X_AB.R.transpose() * force);
}

/// With the derivatives of torque and force by [twist; velocity] of a spot, (12 columns each).
void Contact::differentiate_shapes(const Place& place, const Vector3& force, const Eigen::Matrix<double, 6, 12>& spot,
                                   ForceResponse& response) const {
  if (place.corner < 0) return;
  const auto U = displacements_.middleRows<3>(3 * place.corner);
  const Matrix3& R = place.X_AB.R;
  const Eigen::Matrix<double, 3, Eigen::Dynamic> RU = R * U;
  Eigen::Matrix<double, 3, 6> by_twist = spot.block<3, 6>(3, 0);
  by_twist.leftCols<3>() += skew(force);  // the shapes turn with B
  response.dW_ds.noalias() += spot.middleCols<3>(3) * RU;
  response.dW_dr.noalias() += spot.middleCols<3>(9) * RU;
  response.dQ_dX.noalias() += RU.transpose() * by_twist;
  response.dQ_dV.noalias() += RU.transpose() * spot.block<3, 6>(3, 6);
  response.dQ_ds.noalias() += RU.transpose() * (spot.block<3, 3>(3, 3) * RU);
  response.dQ_dr.noalias() += RU.transpose() * (spot.block<3, 3>(3, 9) * RU);
}

void Contact::evaluate(const RelativeMotion& motion, bool want_tangent, ForceResponse& response) {
  response.set_zero(motion.s.size());
  too_deep_ = 0;
  const Vector3 omega = motion.V_AB_A.head<3>(), v = motion.V_AB_A.tail<3>();
  for (const ContactPointId& id : find(motion)) {
    const Place place = place_of(motion, id.index);
    const ContactPoint<double> spot = work_->finder->spot(id, plain_pose(place.X_AB));
    if (-spot.gap > deepest_) too_deep_ = std::max(too_deep_, -spot.gap);
    // B's material moves with (contact.1), and with (contact.4) where it deforms.
    const ContactPointForce<double> force =
        spot_force<double>(law_, spot, v + omega.cross(spot.position) + place.velocity);
    const Vector3 f = force.normal * spot.normal + force.friction;
    response.W_B_A.head<3>() += spot.position.cross(f);
    response.W_B_A.tail<3>() += f;
    push_shapes(place, f, response);
  }
  if (!want_tangent) return;
  for (const ContactPointId& id : work_->found) differentiate(id, motion, response);
}

void Contact::differentiate(const ContactPointId& id, const RelativeMotion& motion, ForceResponse& response) const {
  const Place place = place_of(motion, id.index);
  const VelocityOf V = velocity_with_derivatives(motion.V_AB_A);
  const ContactPoint<Dual> spot = work_->finder->spot(id, pose_with_derivatives(place.X_AB));
  Vec3<Dual> velocity = V.v + cross(V.omega, spot.position);
  if (place.corner >= 0) velocity += turning(place.velocity);
  const ContactPointForce<Dual> force = spot_force<Dual>(law_, spot, velocity);
  const Vec3<Dual> f = scaled(force.normal, spot.normal) + force.friction;
  const Vec3<Dual> torque = cross(spot.position, f);
  Eigen::Matrix<double, 6, 12> derivative;
  Vector3 value;
  for (int i = 0; i < 3; ++i) {
    derivative.row(i) = torque[i].d.matrix().transpose();
    derivative.row(3 + i) = f[i].d.matrix().transpose();
    value[i] = value_of(f[i]);
  }
  response.dW_dX += derivative.leftCols<6>();
  response.dW_dV += derivative.rightCols<6>();
  differentiate_shapes(place, value, derivative, response);
}

double Contact::stored_energy(const RelativeMotion& motion) const {
  double energy = 0;
  for (const ContactPointId& id : find(motion)) {
    const ContactPoint<double> spot = work_->finder->spot(id, plain_pose(place_of(motion, id.index).X_AB));
    energy += spot.weight * law_.stiffness * std::pow(-spot.gap, law_.exponent + 1) / (law_.exponent + 1);
  }
  return energy;
}

std::string Contact::domain_error() const {
  if (too_deep_ == 0) return {};
  return fmt::format("the shapes overlap by {:.3g} mm, more than {:.3g} mm ({:g} % of the smaller one's size)",
                     1e3 * too_deep_, 1e3 * deepest_, 100 * deepest_share);
}

double Contact::smallest_gap(const RelativeMotion& motion) const {
  if (displacements_.rows() == 0) return work_->finder->smallest_gap(motion.X_AB);
  double nearest = kUnbounded;
  std::vector<ContactPointId> all;
  work_->finder->find_all(all);
  for (const ContactPointId& id : all)
    nearest = std::min(nearest, work_->finder->spot(id, plain_pose(place_of(motion, id.index).X_AB)).gap);
  return nearest;
}

ContactObservation Contact::observe(const RelativeMotion& motion) {
  ContactObservation seen;
  seen.gap = smallest_gap(motion);
  const Vector3 omega = motion.V_AB_A.head<3>(), v = motion.V_AB_A.tail<3>();
  for (const ContactPointId& id : find(motion)) {
    const Place place = place_of(motion, id.index);
    const ContactPoint<double> spot = work_->finder->spot(id, plain_pose(place.X_AB));
    const Vector3 velocity = v + omega.cross(spot.position) + place.velocity;
    const ContactPointForce<double> force = spot_force<double>(law_, spot, velocity);
    const double rate = -spot.normal.dot(velocity);
    const double elastic = spot.weight * law_.stiffness * std::pow(-spot.gap, law_.exponent);
    ++seen.spots;
    seen.normal_force += force.normal;
    seen.friction += force.friction;
    seen.force += force.normal * spot.normal + force.friction;
    seen.position += force.normal * spot.position;
    seen.damping_power += (force.normal - elastic) * rate;
    seen.friction_power -= force.friction.dot(velocity);
  }
  seen.position /= seen.normal_force;  // not a number without contact
  return seen;
}

bool can_touch(const ShapeGeometry& a, const ShapeGeometry& b) { return make_spot_finder(a, b) != nullptr; }

bool can_touch_deforming(const ShapeGeometry& shape) {
  return !std::holds_alternative<std::shared_ptr<const TriangleMesh>>(shape);
}

bool touches_with_pressure(const ShapeGeometry& a, const ShapeGeometry& b) {
  const std::unique_ptr<ContactSearch> finder = make_spot_finder(a, b);
  return finder != nullptr && finder->weighs_area();
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
