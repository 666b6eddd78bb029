// Shapes of a mesh: exact in statics and rigid motion, and as good in vibration as modes promise.
#include "hersey/mbd/body_reduction.h"

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <numbers>

#include "flexible_beam.h"
#include "hersey/core/input_error.h"

namespace hersey::mbd {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Frequencies of the mesh itself, all degrees of freedom of which `keep` is true [Hz].
VectorXd mesh_frequencies(const fem::ElasticBody& body, const std::vector<char>& keep) {
  std::vector<Index> kept;
  for (Index i = 0; i < body.size(); ++i)
    if (keep[static_cast<std::size_t>(i / 3)] != 0) kept.push_back(i);
  const MatrixXd K = MatrixXd(body.K)(kept, kept);
  const MatrixXd M = fem::mass_times(body.m, MatrixXd::Identity(body.size(), body.size()))(kept, kept);
  const VectorXd squares =
      Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(K, M, Eigen::EigenvaluesOnly).eigenvalues();
  return squares.cwiseMax(0).cwiseSqrt() / (2 * std::numbers::pi);
}

TEST_CASE("Reduction_ModesAreThoseOfTheHeldMesh") {
  const test::Beam beam{.cells = {6, 1, 1}};
  const fem::ElasticBody body = beam.elastic();
  std::vector<char> keep(body.mesh.nodes.size(), 1);
  for (int n : body.mesh.node_sets.at("x0")) keep[static_cast<std::size_t>(n)] = 0;
  const VectorXd exact = mesh_frequencies(body, keep);
  const BodyReduction reduction = beam.reduced();
  REQUIRE(reduction.frequencies.size() == 8);
  for (std::size_t i = 0; i < 8; ++i)
    CHECK(reduction.frequencies[i] == doctest::Approx(exact[static_cast<Index>(i)]).epsilon(1e-8));
}

TEST_CASE("Reduction_FrequencyLimitLeavesOutWhatIsAbove") {
  test::Beam beam{.cells = {6, 1, 1}};
  const double third = beam.reduced().frequencies[2];
  beam.options.highest = 1.01 * third;
  CHECK(beam.reduced().frequencies.size() == 3);
}

TEST_CASE("Reduction_ContainsRigidMotionsAndStoresNoEnergyInThem") {
  for (const Connection connection : {Connection::rigid, Connection::average}) {
    test::Beam beam{.cells = {6, 1, 1}, .tip = true, .connection = connection};
    beam.options.modes = 2;
    const fem::ElasticBody body = beam.elastic();
    const auto interfaces = beam.interfaces(body.mesh);
    const BodyReduction reduction = reduce(body, interfaces, beam.options);
    // Turning both frames together: frame 0 stays, so a rigid motion about it appears as the other frame's motion only
    // if frame 0 turns too. Its stiffness against frame 1 moving alone is that of a clamped beam, in all six ways.
    const Matrix6 K = reduction.data.stiffness.topLeftCorner<6, 6>();
    CHECK(Eigen::SelfAdjointEigenSolver<Matrix6>(K).eigenvalues()[0] > 0);
    // Static answers and modes with frames held do not work on each other.
    CHECK(reduction.data.stiffness.block(6, 0, 2, 6).cwiseAbs().maxCoeff() < 1e-8 * K.norm());
    // The frame's mean motion is the one asked for; frame 0 has none.
    const auto mean = [&](std::size_t i, Index shape) {
      const MatrixXd C = mean_motion(body.mesh, interfaces[i]);
      Vector6 motion = Vector6::Zero();
      for (std::size_t n = 0; n < interfaces[i].nodes.size(); ++n)
        motion += C.middleRows<3>(3 * static_cast<Index>(n)).transpose() *
                  reduction.shapes.col(shape).segment<3>(3 * interfaces[i].nodes[n]);
      return motion;
    };
    for (Index shape = 0; shape < reduction.shapes.cols(); ++shape) {
      CHECK(mean(0, shape).norm() < 1e-9);
      const Vector6 asked = shape < 6 ? Vector6(Vector6::Unit(shape)) : Vector6(Vector6::Zero());
      CHECK((mean(1, shape) - asked).norm() < 1e-9);
    }
  }
}

TEST_CASE("Reduction_AverageIsSofterThanRigid") {
  test::Beam rigid{.cells = {8, 2, 2}, .tip = true};
  test::Beam average = rigid;
  average.connection = Connection::average;
  const MatrixXd stiff = rigid.reduced().data.stiffness.topLeftCorner<6, 6>();
  const MatrixXd soft = average.reduced().data.stiffness.topLeftCorner<6, 6>();
  CHECK(Eigen::SelfAdjointEigenSolver<MatrixXd>(stiff - soft).eigenvalues().minCoeff() > 0);
  CHECK(soft(3, 3) > 0.9 * stiff(3, 3));  // Poisson's contraction is held by the one and free in the other
}

TEST_CASE("Reduction_MassMomentsAreThoseOfTheBody") {
  const test::Beam beam{.tip = true};
  const ModalBodyData data = beam.reduced().data;
  CHECK(data.mass == doctest::Approx(beam.mass()).epsilon(1e-12));
  CHECK((data.first_moment.col(0) - beam.mass() * beam.size / 2).norm() < 1e-12 * beam.mass());
  for (std::size_t p = 0; p < 3; ++p) {
    const double length = beam.size[static_cast<Index>(p)];
    CHECK(data.second_moment[4 * p](0, 0) == doctest::Approx(beam.mass() * length * length / 3).epsilon(1e-12));
  }
}

TEST_CASE("Reduction_RefusesWhatCannotBeHeld") {
  const test::Beam beam{.cells = {4, 2, 2}};
  const fem::ElasticBody body = beam.elastic();
  const std::vector<int> face = body.mesh.node_sets.at("x0");
  std::vector<int> edge;
  for (int n : face)
    if (body.mesh.nodes[static_cast<std::size_t>(n)].y() == 0) edge.push_back(n);
  REQUIRE(edge.size() == 3);
  const auto refused = [&](const std::vector<InterfaceSpec>& interfaces, const std::string& word) {
    try {
      (void)reduce(body, interfaces, {});
    } catch (const InputError& error) {
      return std::string(error.what()).find(word) != std::string::npos;
    }
    return false;
  };
  CHECK(refused({{"root", {}, {face[0], face[1]}, Connection::rigid}}, "2 nodes"));
  CHECK(refused({{"root", {}, {}, Connection::rigid}}, "0 nodes"));
  CHECK(refused({{"root", {}, edge, Connection::average}}, "on a line"));
  CHECK(refused({{"root", {}, face, Connection::rigid}, {"again", {}, face, Connection::rigid}}, "holds too"));
}

}  // namespace
}  // namespace hersey::mbd
