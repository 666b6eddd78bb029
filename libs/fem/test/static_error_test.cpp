// Static shapes for surfaces under load, against the whole mesh.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "hersey/fem/constrained_stiffness.h"
#include "hersey/fem/load_distributions.h"
#include "hersey/fem/mesh_file.h"
#include "hersey/fem/reduction.h"
#include "small_bodies.h"
#include "source_dir.h"

namespace hersey::fem {
namespace static_error_test {

Mesh conrod() { return read_mesh(std::filesystem::path(hersey::source_dir()) / "examples/meshes/conrod.msh", 1e-3); }

TEST_CASE("BoreOf_FindsAxisAndCentreAlsoOfHalfABore") {
  const Mesh mesh = conrod();
  std::vector<ElementFace> faces = faces_called(mesh, "small_end");
  for (const bool half : {false, true}) {
    CAPTURE(half);
    if (half)
      std::erase_if(faces, [&](const ElementFace& face) {
        const Element& element = mesh.elements[static_cast<std::size_t>(face.element)];
        const int node = mesh.nodes_of(element)[face_nodes(element.type, face.face)[0]];
        return mesh.nodes[static_cast<std::size_t>(node)].x() < 0;
      });
    const std::optional<Pose> bore = bore_of(mesh, faces);
    REQUIRE(bore);
    CHECK(std::abs(bore->R(2, 2)) > 1 - 1e-6);
    CHECK((bore->r - Vector3(0, 0.14, 0)).head<2>().norm() < 2e-4);  // bore of 20 mm diameter in parabolic facets
  }
  CHECK_FALSE(bore_of(mesh, outer_faces(mesh, mesh.node_sets.at("rod"))).has_value());
  const Mesh box = box_mesh(ElementType::hex8, {1, 1, 1}, {1, 1, 1});
  CHECK_FALSE(bore_of(box, box.surfaces.at("x0")).has_value());
  CHECK(loaded_surface(box, "x0", 4).loads.cols() == 3);  // 1 and what grows along both sides
}

TEST_CASE("StaticError_HoldsForACosinePressureNotAmongTheShapes") {
  const Mesh mesh = conrod();
  const ElasticBody body = assemble(mesh, {steel});
  const auto frame = [&](const char* name) {
    const std::vector<int>& nodes = mesh.node_sets.at(name);
    return InterfaceFrame{name, face_centre(mesh, nodes), nodes, Connection::average, face_weights(mesh, nodes)};
  };
  const std::vector<InterfaceFrame> frames = {frame("small_end"), frame("big_end")};
  const LoadedSurface bore = loaded_surface(mesh, "big_end", 4);
  const Eigen::VectorXd load = cosine_pressure_load(mesh, faces_called(mesh, "big_end"), Vector3(0.6, 0.8, 0));
  // The whole mesh with its frames fixed.
  const FrameSupports supports = frame_supports(mesh, frames);
  ConstrainedStiffness fixed(body.K, body.m, supports.fixed_dofs, supports.C);
  REQUIRE(fixed.factorise().solved());
  const Eigen::VectorXd exact = fixed.solve(load);
  const auto size_on_bore = [&](const Eigen::VectorXd& u) {
    double sum = 0;
    for (std::size_t i = 0; i < bore.nodes.size(); ++i)
      sum += bore.areas[i] * u.segment<3>(3 * bore.nodes[i]).squaredNorm();
    return std::sqrt(sum);
  };
  const auto error_of = [&](double asked, StaticError& error) {
    ReductionOptions options;
    options.modes = 10;
    options.surfaces = {bore};
    options.static_error = asked;
    const Reduction reduction = reduce(body, frames, options);
    REQUIRE(reduction.solved());
    error = reduction.body.static_errors.at(0);
    const Eigen::Index n = reduction.body.internal_omega.size();
    const Eigen::MatrixXd V = reduction.body.Phi.rightCols(n);
    const Eigen::VectorXd q =
        reduction.body.internal_omega.cwiseAbs2().cwiseInverse().asDiagonal() * (V.transpose() * load);
    return size_on_bore(V * q - exact) / size_on_bore(exact);
  };
  StaticError alone, kept;
  const double without = error_of(std::numeric_limits<double>::infinity(), alone);
  const double with = error_of(0.01, kept);
  MESSAGE("bore under a cosine pressure: 10 modes miss " << 100 * without << " %, with static shapes " << 100 * with
                                                         << " %");
  CHECK(alone.modes == alone.reduced);
  CHECK(alone.modes > 0.1);
  CHECK(kept.modes == doctest::Approx(alone.modes));
  CHECK(kept.reduced <= 0.01);
  CHECK(kept.shapes == 18);
  CHECK(without > 0.05);
  CHECK(with < 0.01);
}

}  // namespace static_error_test
}  // namespace hersey::fem
