#include "hersey/fem/contact_modes.h"

#include <doctest/doctest.h>

#include "hersey/fem/load_vectors.h"
#include "small_bodies.h"

namespace hersey::fem {
namespace contact_modes_test {

TEST_CASE("NodalNormals_AddUpToTheFacesAndShareItEvenly") {
  for (const ElementType type : {ElementType::hex8, ElementType::hex20, ElementType::tet10}) {
    const Mesh mesh = box_mesh(type, {2, 1, 0.5}, {2, 2, 2});
    const Eigen::Matrix3Xd normals = nodal_normals(mesh, mesh.surfaces.at("x1"));
    const Vector3 sum = normals.rowwise().sum();
    CHECK((sum - Vector3(0.5, 0, 0)).norm() < 1e-14);  // round-off
    CHECK(normals.row(0).minCoeff() >= 0);
    for (const int node : mesh.node_sets.at("x1")) CHECK(normals(0, node) > 0.001);
  }
}

TEST_CASE("ContactModes_AnswerEveryForceOnTheirFaces") {
  const ElasticBody body =
      assemble(box_mesh(ElementType::hex8, {1, 0.2, 0.2}, {5, 2, 2}), {isotropic({2.1e11, 0.3, 7850})});
  ConstrainedStiffness stiffness(body.K, body.m, dofs_of(body.mesh.node_sets.at("x0")));
  REQUIRE(stiffness.factorise().solved());
  const auto& faces = body.mesh.surfaces.at("y1");
  // The nodes on the fixed end do not move.
  const FilmModes all = contact_modes(stiffness, body.mesh, faces, 100, 1e-9);
  REQUIRE(all.shapes.cols() == 15);
  const Eigen::MatrixXd f = pressure_load(body.mesh, faces, 1e6), u = stiffness.solve(f);
  const auto missed = [&](const FilmModes& modes) {
    const Eigen::MatrixXd K = modes.shapes.transpose() * modes.loads;
    const Eigen::MatrixXd near = modes.shapes * K.ldlt().solve(modes.shapes.transpose() * f);
    return (near - u).norm() / u.norm();
  };
  CHECK(missed(all) < 1e-9);  // with all modes there are: round-off of the solutions
  const FilmModes few = contact_modes(stiffness, body.mesh, faces, 3, 1e-9);
  CHECK(missed(few) < 1e-2);  // three of fifteen
  CHECK(missed(few) > 1e-9);
  CHECK(few.lost > 0);
}

}  // namespace contact_modes_test
}  // namespace hersey::fem
