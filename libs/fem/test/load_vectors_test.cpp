#include "hersey/fem/load_vectors.h"

#include <doctest/doctest.h>

#include <limits>

#include "small_bodies.h"

namespace hersey::fem {
namespace load_vectors_test {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Force and moment about the origin of nodal forces.
Vector6 resultant(const Mesh& mesh, const Eigen::VectorXd& f) {
  return rigid_motions(mesh, Vector3::Zero()).transpose() * f;
}

TEST_CASE("GravityLoad_IsTheWeightAtTheCentre") {
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const ElasticBody body = assemble(distorted_box(type), {steel});
    const Vector3 g(1, -2, -9.81), weight = body.mass * g;
    Vector6 expected;
    expected << body.centre.cross(weight), weight;
    CHECK((resultant(body.mesh, gravity_load(body, g)) - expected).norm() < 1000 * eps * expected.norm());
  }
}

TEST_CASE("PressureLoad_OnASide_IsItsAreaTimesThePressureAtItsMiddle") {
  const Vector3 size(0.3, 0.2, 0.5);
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const Mesh mesh = box_mesh(type, size, {2, 3, 1});
    CHECK(area_of(mesh, mesh.surfaces.at("y1")) == doctest::Approx(0.15).epsilon(100 * eps));
    const Vector3 force = Vector3(0, -0.15 * 4e6, 0), middle(0.15, 0.2, 0.25);
    Vector6 expected;
    expected << middle.cross(force), force;
    const Eigen::VectorXd f = pressure_load(mesh, mesh.surfaces.at("y1"), 4e6);
    CHECK((resultant(mesh, f) - expected).norm() < 1000 * eps * expected.norm());
  }
}

TEST_CASE("PressureAllAround_HasNoResultant") {
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const Mesh mesh = distorted_box(type);
    Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(mesh.nodes.size()));
    for (const auto& [name, faces] : mesh.surfaces) f += pressure_load(mesh, faces, 1e5);
    CHECK(resultant(mesh, f).norm() < 1000 * eps * f.norm());
  }
}

TEST_CASE("TractionLoad_OfAVaryingTraction_DoesItsWork") {
  const Mesh mesh = box_mesh(ElementType::hex20, {1, 2, 3}, {1, 2, 2});
  const Eigen::VectorXd f = traction_load(mesh, mesh.surfaces.at("z1"), [](const Vector3& x, const Vector3& normal) {
    return Vector3(x.y(), 0, x.x() * normal.z());
  });
  const Vector6 w = resultant(mesh, f);
  CHECK(w[3] == doctest::Approx(2));                // int y dx dy
  CHECK(w[5] == doctest::Approx(1));                // int x
  CHECK(w[0] == doctest::Approx(1));                // int y x
  CHECK(w[1] == doctest::Approx(3 * 2 - 2.0 / 3));  // int 3 y - x^2
}

}  // namespace load_vectors_test
}  // namespace hersey::fem
