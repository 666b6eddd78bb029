#include "hersey/fem/constrained_stiffness.h"

#include <doctest/doctest.h>

#include <limits>

#include "hersey/fem/load_vectors.h"
#include "small_bodies.h"

namespace hersey::fem {
namespace constrained_stiffness_test {

constexpr double eps = std::numeric_limits<double>::epsilon();

std::vector<Support> at_rest(const std::vector<int>& dofs) {
  std::vector<Support> supports;
  for (const int dof : dofs) supports.push_back({dof, 0});
  return supports;
}

TEST_CASE("PulledBar_StretchesAndContractsAsHookeSays") {
  const double E = 2.1e11, nu = 0.3, sigma = 1e8;
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const ElasticBody body = assemble(box_mesh(type, {1, 0.2, 0.3}, {3, 1, 2}), {steel});
    std::vector<Support> supports;
    for (int k = 0; k < 3; ++k)  // symmetry on three sides
      for (const int node : body.mesh.node_sets.at(std::string(1, static_cast<char>('x' + k)) + "0"))
        supports.push_back({3 * node + k, 0});
    Eigen::MatrixXd f(body.size(), 2);
    f.col(0) = pressure_load(body.mesh, body.mesh.surfaces.at("x1"), -sigma);
    f.col(1) = 2 * f.col(0);
    const StaticSolution solution = solve_static(body, supports, f);
    REQUIRE(solution.solved());
    for (std::size_t a = 0; a < body.mesh.nodes.size(); ++a) {
      const Vector3 x = body.mesh.nodes[a], u = sigma / E * Vector3(x.x(), -nu * x.y(), -nu * x.z());
      CHECK((solution.u.col(0).segment<3>(3 * a) - u).norm() < 1e4 * eps * sigma / E);
      CHECK((solution.u.col(1).segment<3>(3 * a) - 2 * u).norm() < 1e4 * eps * sigma / E);
    }
    const Vector6 wrench = rigid_motions(body.mesh, Vector3::Zero()).transpose() * solution.reaction.col(0);
    CHECK(wrench[3] == doctest::Approx(-sigma * 0.06).epsilon(1e4 * eps));
  }
}

TEST_CASE("PrescribedDisplacement_StretchesTheBar") {
  const ElasticBody body = assemble(box_mesh(ElementType::hex8, {1, 0.2, 0.3}, {3, 1, 2}), {steel});
  std::vector<Support> supports;
  for (int k = 0; k < 3; ++k)
    for (const int node : body.mesh.node_sets.at(std::string(1, static_cast<char>('x' + k)) + "0"))
      supports.push_back({3 * node + k, 0});
  for (const int node : body.mesh.node_sets.at("x1")) supports.push_back({3 * node, 1e-3});
  const StaticSolution solution = solve_static(body, supports, Eigen::MatrixXd::Zero(body.size(), 1));
  REQUIRE(solution.solved());
  double pull = 0;
  for (const int node : body.mesh.node_sets.at("x1")) pull += solution.reaction(3 * node, 0);
  CHECK(pull == doctest::Approx(2.1e11 * 1e-3 * 0.06).epsilon(1e5 * eps));
}

TEST_CASE("BodyWithoutSupports_ReportsTheNumberOfItsMotions") {
  const ElasticBody body = assemble(box_mesh(ElementType::tet10, {1, 0.2, 0.3}, {3, 1, 2}), {steel});
  const Eigen::MatrixXd f = gravity_load(body, {0, 0, -9.81});
  const auto message = [&](const std::vector<int>& fixed) { return solve_static(body, at_rest(fixed), f).message; };
  CHECK(message({}).find("6 of its 6 rigid motions") != std::string::npos);
  const std::vector<int>& x0 = body.mesh.node_sets.at("x0");
  CHECK(message(dofs_of({x0[0]})).find("3 of its 6 rigid motions") != std::string::npos);  // a ball joint
  CHECK(message(dofs_of(x0, {true, false, false})).find("3 of its 6 rigid motions") !=
        std::string::npos);  // on a plane
  CHECK(solve_static(body, at_rest(dofs_of(x0)), f).solved());
}

TEST_CASE("FixedEverywhere_NothingMoves") {
  const ElasticBody body = assemble(box_mesh(ElementType::tet4, {1, 1, 1}, {1, 1, 1}), {steel});
  std::vector<int> all;
  for (int a = 0; a < body.node_count(); ++a) all.push_back(a);
  const StaticSolution solution = solve_static(body, at_rest(dofs_of(all)), gravity_load(body, {0, 0, -1}));
  CHECK(solution.solved());
  CHECK(solution.u.norm() == 0);
  CHECK(-solution.reaction.sum() == doctest::Approx(-7850));
}

}  // namespace constrained_stiffness_test
}  // namespace hersey::fem
