// Solids of finite strain that move as is given: the order of their elements in space, order two in time.
#include "manufactured_solid.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "hersey/fem/reduction.h"
#include "hersey/fem/shape_functions.h"
#include "hersey/mbd/mechanism_builder.h"
#include "hersey/mbd/nodal_body.h"
#include "observed_order.h"
#include "simulate.h"
#include "test_mechanisms.h"

namespace hersey::mbd {
namespace manufactured_solid_test {

using Eigen::Index;
using Eigen::Matrix3Xd;
using test::operator*;
using test::MatrixOf, test::VectorOf;

/// Every shape has its own stiffness in each direction, none of them along the axes of the body.
const fem::SolidMaterial skewed = fem::orthotropic({.E_1 = 120,
                                                    .E_2 = 80,
                                                    .E_3 = 60,
                                                    .nu_12 = 0.3,
                                                    .nu_23 = 0.2,
                                                    .nu_13 = 0.25,
                                                    .G_12 = 40,
                                                    .G_23 = 25,
                                                    .G_13 = 30,
                                                    .density = 1,
                                                    .R = rotation_exp({0.5, -0.8, 0.3}).toRotationMatrix()});

/// A block and a mesh of it.
struct Block {
  fem::ElementType type = fem::ElementType::hex8;
  std::array<int, 3> cells{2, 1, 1};
  int steps = 4;
  double end = 0.5;
};
const Vector3 size{1, 0.5, 0.5};

/// Points of the elements with the solid's data.
template <class Solid>
struct MeshPoint {
  const fem::Element* element;
  fem::NodeValues N;
  double volume;
  typename Solid::Point point;
};
template <class Solid>
std::vector<MeshPoint<Solid>> points_of(const Solid& exact, const fem::ElasticBody& body) {
  std::vector<MeshPoint<Solid>> points;
  for (const fem::Element& element : body.mesh.elements) {
    const fem::NodeColumns x = body.positions_of(element);
    for (const auto& [xi, weight] : fem::mass_points(element.type)) {
      const fem::ShapeFunctions shape = fem::shape_functions(element.type, xi);
      const double volume = weight * fem::element_point(shape, x).jacobian;
      points.push_back({&element, shape.N, volume, exact.point(x * shape.N)});
    }
  }
  return points;
}

/// Forces on the nodes at the ends of the steps, between which they change evenly; integrated with the functions of the
/// elements (theory manual, flexible-bodies.29).
template <class Solid>
void add_loads(MechanismBuilder& b, ElasticId elastic, const Solid& exact, const fem::ElasticBody& body,
               const std::vector<MeshPoint<Solid>>& points, const Block& how) {
  std::vector<fem::ElementFace> skin;
  for (const auto& [name, faces] : body.mesh.surfaces) skin.insert(skin.end(), faces.begin(), faces.end());
  const double dt = how.end / how.steps;
  for (int step = 0; step <= how.steps; ++step) {
    const auto now = exact.at(step * dt);
    Eigen::VectorXd forces = fem::traction_load(
        body.mesh, skin, [&](const Vector3& X, const Vector3& normal) { return exact.traction(now, X, normal); });
    for (const MeshPoint<Solid>& at : points) {
      const Vector3 force = at.volume * exact.load(now, at.point);
      const int* nodes = body.mesh.nodes_of(*at.element);
      for (Index a = 0; a < at.N.size(); ++a) forces.segment<3>(3 * nodes[a]) += at.N[a] * force;
    }
    const NodalLoad load{.name = std::to_string(step),
                         .axes = LoadAxes::ground,
                         .forces = Eigen::Map<const Matrix3Xd>(forces.data(), 3, forces.size() / 3)};
    const auto share = [=](double t) { return std::max(0.0, 1 - std::abs(t / dt - step)); };
    const auto unknown = [](double) { return std::nan(""); };  // its slopes are not used
    b.add_nodal_load(elastic, load, test::time_function(share, unknown, unknown));
  }
}

/// Returns the errors of the block at the end.
template <class Solid>
test::Errors errors_of(const Solid& exact, const Block& how) {
  const fem::ElasticBody body = fem::assemble(fem::box_mesh(how.type, size, how.cells), {exact.material});
  const std::vector<fem::InterfaceFrame> frames{
      {"root", {0, size.y() / 2, size.z() / 2}, body.mesh.node_sets.at("x0"), fem::Connection::rigid, {}}};
  const fem::Reduction reduction = fem::reduce(body, frames, {.modes = 0});
  REQUIRE_MESSAGE(reduction.solved(), reduction.message);
  const auto solid = std::make_shared<NodalBody>(
      body, reduction.body, RayleighDamping{.mass = 0, .stiffness = exact.damping}, Strain::finite);
  solid->start_undeformed();

  MechanismBuilder b;
  const FlexibleBodyIds ids = b.add_flexible_body("block", {}, solid);
  const auto start = exact.at(0);
  const Matrix3 spin = start.Q.transpose() * start.Q_rate;
  b.add_joint(
      {.name = "free",
       .type = JointType::free,
       .inboard = b.frame_of(b.ground()),
       .outboard = ids.frames[0],
       .initial = {start.r[0], start.r[1], start.r[2], 0, 0, 0},
       .initial_rate = {start.r_rate[0], start.r_rate[1], start.r_rate[2], spin(2, 1), spin(0, 2), spin(1, 0)}});
  const auto points = points_of(exact, body);
  add_loads(b, ids.elastic, exact, body, points, how);
  const auto m = b.finalise();
  solver::State state = test::start(*m);
  test::run(*m, state, how.end, how.steps);

  test::Errors errors;
  const auto last = exact.at(how.end);
  const FrameMotion root = m->frame_motion(state, ids.frames[0]);
  errors.add("rotation of the frame [rad]", rotation_log(Eigen::Quaterniond(root.X_WF.R * last.Q.transpose())).norm());
  errors.add("position of the frame [m]", (root.X_WF.r - last.r).norm());
  const ElasticObservation observation = m->observe(state).elastics[0];
  const Eigen::VectorXd u = solid->displacements(observation.motion, {});
  Eigen::Vector2d energy(-observation.energy.kinetic, -observation.energy.strain);
  for (const auto& at : points) {
    Vector3 y = at.point.X;
    const int* nodes = body.mesh.nodes_of(*at.element);
    for (Index a = 0; a < at.N.size(); ++a) y += at.N[a] * u.segment<3>(3 * nodes[a]);
    errors.add("position [m]", (root.X_WF * y - last.position(at.point.X, at.point.phi)).norm(), at.volume);
    energy += at.volume * exact.energies(last, at.point);
  }
  errors.add("kinetic energy [J]", energy[0]);
  errors.add("strain energy [J]", energy[1]);
  return errors;
}

/// Rotates at a constant rate about a skew axis through its corner and deforms with the square of time, by strains of
/// up to a tenth: steps of any length have this exactly, so that what is left is the elements' error.
struct EvenMotion {
  double amplitude = 0.5;  ///< [1/s^2]

  template <class T>
  [[nodiscard]] VectorOf<T> origin(const T&) const {
    return {T(0.3), T(-0.2), T(0.5)};
  }
  template <class T>
  [[nodiscard]] MatrixOf<T> axes(const T& t) const {
    const MatrixOf<T> tilt = test::rotated_about<T>(0, T(0.7)) * test::rotated_about<T>(1, T(-0.4));
    return tilt * (test::rotated_about<T>(2, 3.0 * t) * test::transposed(tilt));
  }
  template <class T>
  [[nodiscard]] std::array<T, 2> amplitudes(const T& t) const {
    return {amplitude * t * t, T(0.0)};
  }
  template <class T>
  [[nodiscard]] std::array<VectorOf<T>, 2> shapes(const VectorOf<T>& X) const {
    using std::cos, std::sin;
    const auto& [x, y, z] = X;
    return {VectorOf<T>{0.15 * x * sin(2.0 * x + 1.5 * y - z + T(0.3)), 0.35 * x * cos(1.2 * x - 0.8 * y + 1.1 * z),
                        0.3 * x * sin(1.7 * x + y + 0.6 * z + T(1.0))},
            VectorOf<T>{}};
  }
};

/// Deforms evenly over the block, by strains of some tens of percent, while it rotates and moves unevenly: elements
/// have this exactly, so that what is left is the steps' error.
struct UniformMotion {
  template <class T>
  [[nodiscard]] VectorOf<T> origin(const T& t) const {
    using std::sin;
    return {0.4 * sin(3.0 * t), 0.3 * t - 0.2 * t * t, -0.5 * t};
  }
  template <class T>
  [[nodiscard]] MatrixOf<T> axes(const T& t) const {
    using std::sin;
    return test::rotated_about<T>(2, 2.0 * t + 0.3 * sin(4.0 * t)) *
           (test::rotated_about<T>(0, -0.8 * t) * test::rotated_about<T>(1, 0.5 * sin(3.0 * t)));
  }
  template <class T>
  [[nodiscard]] std::array<T, 2> amplitudes(const T& t) const {
    using std::sin;
    const T s = sin(3.0 * t), c = sin(2.0 * t);
    return {s * s, c * c};
  }
  template <class T>
  [[nodiscard]] std::array<VectorOf<T>, 2> shapes(const VectorOf<T>& X) const {
    const T& x = X[0];
    return {VectorOf<T>{0.15 * x, 0.1 * x, T(0.0)}, VectorOf<T>{T(0.0), -0.1 * x, 0.2 * x}};
  }
};

TEST_CASE("ManufacturedSolid_IsMetWithTheOrderOfItsElements") {
  const test::ManufacturedSolid<EvenMotion> exact{.motion = {}, .material = skewed, .damping = 0.02};
  struct Case {
    fem::ElementType type;
    std::array<int, 3> cells;  // across, of three meshes
    double order;
  };
  // The order is two with linear shape functions and three with quadratic ones. The frame's motion and energies have at
  // least that order.
  for (const Case& each : {Case{fem::ElementType::hex8, {1, 2, 4}, 2}, Case{fem::ElementType::tet10, {1, 2, 3}, 3},
                           Case{fem::ElementType::hex20, {1, 2, 3}, 3}}) {
    const std::string type = fem::name_of(each.type);
    CAPTURE(type);
    std::vector<test::Errors> on;
    for (const int n : each.cells) on.push_back(errors_of(exact, {.type = each.type, .cells = {2 * n, n, n}}));
    const double ratio = static_cast<double>(each.cells[2]) / each.cells[1];
    test::check_orders(on, each.order, 0.3, ratio, "position [m]");
  }
}

TEST_CASE("ManufacturedSolidOfUniformStrain_IsMetWithOrderTwoInTime") {
  const test::ManufacturedSolid<UniformMotion> exact{.motion = {}, .material = skewed, .damping = 0.02};
  for (const fem::ElementType type : {fem::ElementType::hex8, fem::ElementType::tet10}) {
    std::vector<test::Errors> on;
    for (const int n : {1, 2, 4}) on.push_back(errors_of(exact, {.type = type, .cells = {1, 1, 1}, .steps = 20 * n}));
    test::check_orders(on, 2, 0.1);
  }
}

}  // namespace manufactured_solid_test
}  // namespace hersey::mbd
