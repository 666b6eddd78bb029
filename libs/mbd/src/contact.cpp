#include "hersey/mbd/contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact_law.h"
#include "contact_spots.h"
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

/// X_AB moved by a twist xi, d/dxi: rotations act from the left, in A's axes.
PoseOf<Dual> pose_with_derivatives(const Pose& X) {
  PoseOf<Dual> dual;
  const auto with_rotation = [](const Vector3& v) {
    Vec3<Dual> turned;
    for (int i = 0; i < 3; ++i) turned[i] = Dual(v[i]);
    const Matrix3 dv = -skew(v);  // dv = phi x v
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) turned[i].d[k] = dv(i, k);
    return turned;
  };
  dual.x = with_rotation(X.R.col(0));
  dual.y = with_rotation(X.R.col(1));
  dual.z = with_rotation(X.R.col(2));
  dual.r = with_rotation(X.r);
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
  std::unique_ptr<SpotFinder> finder;
  std::vector<SpotId> found;

  const std::vector<SpotId>& find(const Pose& X_AB) {
    found.clear();
    finder->find(X_AB, found);
    return found;
  }
};

Contact::Contact(const ShapeGeometry& a, const ShapeGeometry& b, const ContactLaw& law)
    : law_(law), deepest_(deepest_share * std::min(size_of(a), size_of(b))), work_(std::make_unique<Workspace>()) {
  HERSEY_REQUIRE(law.stiffness > 0 && law.exponent >= 1 && law.damping >= 0, "surfaces resist penetration");
  HERSEY_REQUIRE(law.friction >= 0 && (law.friction == 0 || law.slip_speed > 0), "friction is regularised");
  work_->finder = make_spot_finder(a, b);
  HERSEY_REQUIRE(work_->finder != nullptr, "the pair of shapes is supported");
  work_->found.reserve(16);
}

Contact::~Contact() = default;

void Contact::evaluate(const RelativeMotion& motion, bool want_tangent, ForceResponse& response) {
  response = ForceResponse{};
  too_deep_ = 0;
  const PoseOf<double> X = plain_pose(motion.X_AB);
  const Vector3 omega = motion.V_AB_A.head<3>(), v = motion.V_AB_A.tail<3>();
  for (const SpotId& id : work_->find(motion.X_AB)) {
    const Spot<double> spot = work_->finder->spot(id, X);
    if (-spot.gap > deepest_) too_deep_ = std::max(too_deep_, -spot.gap);
    const SpotForce<double> force = spot_force<double>(law_, spot, v + omega.cross(spot.position));
    const Vector3 f = force.normal * spot.normal + force.friction;
    response.W_B_A.head<3>() += spot.position.cross(f);
    response.W_B_A.tail<3>() += f;
  }
  if (!want_tangent || work_->found.empty()) return;

  const PoseOf<Dual> X_dual = pose_with_derivatives(motion.X_AB);
  const VelocityOf V = velocity_with_derivatives(motion.V_AB_A);
  for (const SpotId& id : work_->found) {
    const Spot<Dual> spot = work_->finder->spot(id, X_dual);
    const SpotForce<Dual> force = spot_force<Dual>(law_, spot, Vec3<Dual>(V.v + cross(V.omega, spot.position)));
    const Vec3<Dual> f = scaled(force.normal, spot.normal) + force.friction;
    const Vec3<Dual> torque = cross(spot.position, f);
    for (int i = 0; i < 3; ++i) {
      response.dW_dX.row(i) += torque[i].d.head<6>().matrix().transpose();
      response.dW_dX.row(3 + i) += f[i].d.head<6>().matrix().transpose();
      response.dW_dV.row(i) += torque[i].d.tail<6>().matrix().transpose();
      response.dW_dV.row(3 + i) += f[i].d.tail<6>().matrix().transpose();
    }
  }
}

double Contact::stored_energy(const RelativeMotion& motion) const {
  const PoseOf<double> X = plain_pose(motion.X_AB);
  double energy = 0;
  for (const SpotId& id : work_->find(motion.X_AB)) {
    const Spot<double> spot = work_->finder->spot(id, X);
    energy += spot.weight * law_.stiffness * std::pow(-spot.gap, law_.exponent + 1) / (law_.exponent + 1);
  }
  return energy;
}

std::string Contact::domain_error() const {
  if (too_deep_ == 0) return {};
  return fmt::format("the shapes overlap by {:.3g} mm, more than {:.3g} mm ({:g} % of the smaller one's size)",
                     1e3 * too_deep_, 1e3 * deepest_, 100 * deepest_share);
}

ContactObservation Contact::observe(const RelativeMotion& motion) {
  ContactObservation seen;
  seen.gap = work_->finder->smallest_gap(motion.X_AB);
  const PoseOf<double> X = plain_pose(motion.X_AB);
  const Vector3 omega = motion.V_AB_A.head<3>(), v = motion.V_AB_A.tail<3>();
  for (const SpotId& id : work_->find(motion.X_AB)) {
    const Spot<double> spot = work_->finder->spot(id, X);
    const Vector3 velocity = v + omega.cross(spot.position);
    const SpotForce<double> force = spot_force<double>(law_, spot, velocity);
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

bool touches_with_pressure(const ShapeGeometry& a, const ShapeGeometry& b) {
  const std::unique_ptr<SpotFinder> finder = make_spot_finder(a, b);
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
