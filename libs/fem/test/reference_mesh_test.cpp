#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "hersey/fem/constrained_stiffness.h"
#include "hersey/fem/heat_conduction.h"
#include "hersey/fem/load_distributions.h"
#include "hersey/fem/load_vectors.h"
#include "hersey/fem/mesh_file.h"
#include "hersey/fem/reduction.h"
#include "hersey/fem/stress.h"
#include "hersey/fem/thermal_expansion.h"
#include "hersey/fem/vibration.h"
#include "small_bodies.h"
#include "source_dir.h"

// Values of CalculiX 2.20 on the same meshes with the same elements, to the digits it was read with.
namespace hersey::fem {
namespace reference_mesh_test {

const std::string folder = std::string(hersey::source_dir()) + "/verification/data/meshes/";

struct Cantilever {
  const char* file;
  std::array<double, 6> clamped;  // Hz
  std::array<double, 3> free;     // Hz, after six zeros
  double tip;                     // m, u_z of a tip corner under gravity -z
};

const Cantilever cantilevers[] = {
    {"cant_tet10.inp", {50.252, 83.228, 309.852, 499.221, 664.174, 846.585}, {315.063, 513.808, 849.747}, -1.517696e-4},
    {"cant_hex20.inp", {50.311, 83.320, 310.186, 499.775, 658.878, 847.402}, {315.050, 513.803, 849.641}, -1.514111e-4},
};

ElasticBody cantilever(const Cantilever& c) {
  const Mesh mesh = read_mesh(folder + c.file, 1);
  REQUIRE(mesh.materials.size() == 1);
  CHECK(mesh.materials[0].youngs_modulus == 2.1e11);
  return assemble(mesh, {steel});
}

TEST_CASE("Cantilever_HasTheFrequenciesOfCalculiX") {
  constexpr double hz = 1 / (2 * std::numbers::pi), five_digits = 5e-6;
  for (const Cantilever& c : cantilevers) {
    CAPTURE(c.file);
    const ElasticBody body = cantilever(c);
    CHECK(body.mass == doctest::Approx(47.1).epsilon(1e-9));  // digits of the nodes in the file
    const Vibration clamped = natural_modes(body, dofs_of(body.mesh.node_sets.at("FIX")), {.count = 6});
    REQUIRE(clamped.solved());
    for (int k = 0; k < 6; ++k)
      CHECK(hz * clamped.omega[k] == doctest::Approx(c.clamped[k]).epsilon(five_digits + 5e-4 / c.clamped[k]));
    const Vibration free = natural_modes(body, {}, {.count = 9});
    REQUIRE(free.solved());
    CHECK(free.rigid == 6);
    for (int k = 0; k < 3; ++k)
      CHECK(hz * free.omega[6 + k] == doctest::Approx(c.free[k]).epsilon(five_digits + 5e-4 / c.free[k]));
  }
}

TEST_CASE("Cantilever_BendsUnderItsWeightAsInCalculiX") {
  for (const Cantilever& c : cantilevers) {
    CAPTURE(c.file);
    const ElasticBody body = cantilever(c);
    std::vector<Support> supports;
    for (const int dof : dofs_of(body.mesh.node_sets.at("FIX"))) supports.push_back({dof, 0});
    const StaticSolution solution = solve_static(body, supports, gravity_load(body, {0, 0, -9.81}));
    REQUIRE(solution.solved());
    int corner = -1;
    // Which nodes they are.
    for (const int node : body.mesh.node_sets.at("TIP"))
      if ((body.mesh.nodes[node] - Vector3(1, 0.05, 0.03)).norm() < 1e-9) corner = node;
    REQUIRE(corner >= 0);
    CHECK(solution.u(3 * corner + 2, 0) == doctest::Approx(c.tip).epsilon(5e-7));
  }
}

// 80 degC everywhere, a shape at 20 degC and one end clamped: the longest displacement and the energy.
TEST_CASE("ClampedCantilever_WarmsAsInCalculiX") {
  const std::vector<ThermalMaterial> thermal = {{.conductivity = 46, .expansion = 12e-6}};
  const std::array<std::array<double, 2>, 2> references = {{{7.2762630e-4, 9.697540}, {7.2857460e-4, 11.13426}}};
  for (std::size_t k = 0; k < 2; ++k) {
    CAPTURE(cantilevers[k].file);
    const ElasticBody body = cantilever(cantilevers[k]);
    std::vector<Support> supports;
    for (const int dof : dofs_of(body.mesh.node_sets.at("FIX"))) supports.push_back({dof, 0});
    const Eigen::VectorXd rise = Eigen::VectorXd::Constant(body.node_count(), 60);
    const StaticSolution solution = solve_static(body, supports, expansion_load(body, thermal, rise));
    REQUIRE(solution.solved());
    double longest = 0;
    for (Eigen::Index a = 0; a < body.node_count(); ++a)
      longest = std::max(longest, solution.u.col(0).segment<3>(3 * a).norm());
    CHECK(longest == doctest::Approx(references[k][0]).epsilon(2e-7));  // digits of the reference
    const Stress stress = recover_stress(body, solution.u.col(0), thermal, rise);
    CHECK(stress.energy == doctest::Approx(references[k][1]).epsilon(1e-6));  // digits of the reference
  }
}

// 20 degC at one end, 100 at the other, the top in air of 60 degC. CalculiX integrates faces of tet10 at three points,
// too few for what they give off: there temperatures near the top differ by 0.03 K.
TEST_CASE("CantileverBetweenTwoTemperatures_ConductsAsInCalculiX") {
  struct Node {
    long label;
    double T;
  };
  const std::array<std::array<Node, 2>, 2> references = {
      {{{{500, 60.04953}, {900, 59.97269}}}, {{{500, 60.07841}, {900, 66.81421}}}}};
  for (std::size_t k = 0; k < 2; ++k) {
    CAPTURE(cantilevers[k].file);
    const Mesh mesh = read_mesh(folder + cantilevers[k].file, 1);
    std::vector<int> top;
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
      if (mesh.nodes[a].z() > 0.03 - 1e-9) top.push_back(static_cast<int>(a));  // which nodes they are
    HeatConduction conduction(mesh, {{.conductivity = 46}},
                              {.cooled = {{outer_faces(mesh, top), 800, 60}},
                               .prescribed = {{mesh.node_sets.at("FIX"), 20}, {mesh.node_sets.at("TIP"), 100}}});
    REQUIRE(conduction.factorise().solved());
    const Eigen::VectorXd T =
        conduction.temperatures(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(mesh.nodes.size())));
    for (const Node& reference : references[k]) {
      const auto at = std::find(mesh.node_labels.begin(), mesh.node_labels.end(), reference.label);
      REQUIRE(at != mesh.node_labels.end());
      CHECK(std::abs(T[at - mesh.node_labels.begin()] - reference.T) < 1e-5);  // digits of the reference
    }
  }
}

TEST_CASE("ReducedCantilever_HasTheFrequenciesOfCalculiX") {
  const ElasticBody body = cantilever(cantilevers[0]);
  const auto frame = [&](const char* set, double x, Connection connection) {
    const std::vector<int>& nodes = body.mesh.node_sets.at(set);
    return InterfaceFrame{set, {x, 0, 0}, nodes, connection, face_weights(body.mesh, nodes)};
  };
  const Reduction reduction =
      reduce(body, {frame("FIX", 0, Connection::rigid), frame("TIP", 1, Connection::average)}, {.modes = 20});
  REQUIRE(reduction.solved());
  const Eigen::Index free = reduction.body.size() - 6;
  const Eigen::VectorXd lambda =
      Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(reduction.body.K.bottomRightCorner(free, free),
                                                                reduction.body.M.bottomRightCorner(free, free))
          .eigenvalues();
  // Twenty modes with the other end free on an average: what they leave out of the sixth.
  for (int k = 0; k < 6; ++k)
    CHECK(std::sqrt(lambda[k]) / (2 * std::numbers::pi) == doctest::Approx(cantilevers[0].clamped[k]).epsilon(1e-3));
}

TEST_CASE("RingUnderBorePressure_WidensAsInCalculiXAndLame") {
  const Mesh mesh = read_mesh(folder + "ring_hex20_fine.msh", 1);
  const ElasticBody body = assemble(mesh, {steel});
  const auto radius = [&](int node) { return mesh.nodes[node].head<2>().norm(); };
  std::vector<ElementFace> bore;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (int f = 0; f < 6; ++f) {
      const std::vector<int>& local = face_nodes(mesh.elements[e].type, f);
      const int* nodes = mesh.nodes_of(mesh.elements[e]);
      // Which nodes they are.
      if (std::all_of(local.begin(), local.end(), [&](int a) { return std::abs(radius(nodes[a]) - 0.03) < 1e-6; }))
        bore.push_back({static_cast<int>(e), f});
    }
  const Eigen::VectorXd f = pressure_load(mesh, bore, 20e6);
  for (const bool plane_strain : {false, true}) {
    std::vector<Support> supports;
    double widening = 0;
    int at_bore = 0;
    // Which nodes they are.
    for (int a = 0; a < body.node_count(); ++a)
      for (int k = 0; k < 3; ++k)
        if (std::abs(mesh.nodes[a][k]) < 1e-9 || (plane_strain && k == 2 && std::abs(mesh.nodes[a].z() - 0.02) < 1e-9))
          supports.push_back({3 * a + k, 0});
    const StaticSolution solution = solve_static(body, supports, f);
    REQUIRE(solution.solved());
    // Which nodes they are.
    for (int a = 0; a < body.node_count(); ++a)
      if (std::abs(radius(a) - 0.03) < 1e-6) {
        widening += solution.u.col(0).segment<2>(3 * a).dot(mesh.nodes[a].head<2>()) / radius(a);
        ++at_bore;
      }
    CHECK(widening / at_bore == doctest::Approx(plane_strain ? 7.874308e-6 : 8.285733e-6).epsilon(2e-7));  // CalculiX
    CHECK(widening / at_bore == doctest::Approx(plane_strain ? 7.874286e-6 : 8.285714e-6).epsilon(1e-5));  // Lame
  }
}

}  // namespace reference_mesh_test
}  // namespace hersey::fem
