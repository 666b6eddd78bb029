#include "hersey/fem/reduction.h"

#include <doctest/doctest.h>

#include <limits>

#include "hersey/fem/constrained_stiffness.h"
#include "hersey/fem/load_vectors.h"
#include "hersey/fem/vibration.h"
#include "small_bodies.h"

namespace hersey::fem {
namespace reduction_test {

constexpr double kCondition = 1e-9;  // round-off times the condition of the constrained stiffness, 1e6, with a margin

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr Connection both_ways[] = {Connection::rigid, Connection::average};

ElasticBody bar(ElementType type = ElementType::hex20, const std::array<int, 3>& cells = {10, 2, 2}) {
  return assemble(box_mesh(type, {1, 0.1, 0.06}, cells), {steel});
}

InterfaceFrame frame_on(const Mesh& mesh, const std::string& set, Connection connection) {
  const std::vector<int>& nodes = mesh.node_sets.at(set);
  return {.name = set,
          .origin = {set == "x0" ? 0.0 : 1.0, 0.05, 0.03},
          .nodes = nodes,
          .connection = connection,
          .weights = face_weights(mesh, nodes)};
}

Reduction must_reduce(const ElasticBody& body, const std::vector<InterfaceFrame>& frames,
                      const ReductionOptions& options = {}) {
  Reduction reduction = reduce(body, frames, options);
  CAPTURE(reduction.message);
  REQUIRE(reduction.solved());
  return reduction;
}

Eigen::VectorXd frequencies(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M) {
  const Eigen::VectorXd lambda =
      Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(K, M, Eigen::EigenvaluesOnly).eigenvalues();
  return lambda.cwiseMax(0).cwiseSqrt();
}

TEST_CASE("FrameMotion_OfARigidMotionIsThatMotion_AndSpreadsWrenches") {
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const Mesh mesh = box_mesh(type, {1, 0.1, 0.06}, {3, 1, 2});
    const InterfaceFrame frame = frame_on(mesh, "x1", Connection::average);
    REQUIRE(frame.weights.size() == frame.nodes.size());
    double area = 0;
    for (const double weight : frame.weights) {
      CHECK(weight > 0);
      area += weight;
    }
    CHECK(area == doctest::Approx(0.006).epsilon(100 * eps));
    const Eigen::SparseMatrix<double> C = frame_motion(mesh, frame);
    const Matrix6 identity = C * rigid_motions(mesh, frame.origin);
    CHECK((identity - Matrix6::Identity()).cwiseAbs().maxCoeff() < 1000 * eps);
  }
}

TEST_CASE("RigidMotionOfTheFrames_IsOneOfTheBody") {
  const ElasticBody body = bar();
  for (const Connection connection : both_ways) {
    const ReducedBody reduced =
        must_reduce(body, {frame_on(body.mesh, "x0", connection), frame_on(body.mesh, "x1", Connection::rigid)},
                    {.modes = 5})
            .body;
    CHECK(reduced.size() == 17);
    Eigen::MatrixXd q = Eigen::MatrixXd::Zero(17, 6);
    for (int f = 0; f < 2; ++f) {
      q.block<6, 6>(6 * f, 0).setIdentity();  // turning about the mesh's origin moves the frame's origin
      q.block<3, 3>(6 * f + 3, 0) = -skew(reduced.frames[f].origin);
    }
    const Eigen::MatrixXd rigid = rigid_motions(body.mesh, Vector3::Zero());
    CHECK((reduced.Phi * q - rigid).cwiseAbs().maxCoeff() < 1e-9);  // condition number of the constrained K: 1e6
    CHECK((reduced.K * q).cwiseAbs().maxCoeff() < kCondition * reduced.K.topLeftCorner(12, 12).cwiseAbs().maxCoeff());
  }
}

TEST_CASE("ReducedCantilever_HasTheFrequenciesOfTheMesh") {
  const ElasticBody body = bar();
  const Vibration full = natural_modes(body, dofs_of(body.mesh.node_sets.at("x0")), {.count = 6});
  const ReducedBody reduced =
      must_reduce(body, {frame_on(body.mesh, "x0", Connection::rigid), frame_on(body.mesh, "x1", Connection::average)},
                  {.modes = 12})
          .body;
  const Eigen::Index free = reduced.size() - 6;
  const Eigen::VectorXd omega =
      frequencies(reduced.K.bottomRightCorner(free, free), reduced.M.bottomRightCorner(free, free));
  for (int k = 0; k < 6; ++k) {
    CHECK(omega[k] == doctest::Approx(full.omega[k]).epsilon(2e-3));
    CHECK(omega[k] > full.omega[k] * (1 - 1e-9));  // Rayleigh-Ritz: from above
  }
}

TEST_CASE("ReducedFreeBody_WithAllModes_IsTheMesh") {
  const ElasticBody body = bar(ElementType::hex8, {3, 1, 1});  // 48 degrees of freedom
  const ReducedBody reduced =
      must_reduce(body,
                  {frame_on(body.mesh, "x0", Connection::average), frame_on(body.mesh, "x1", Connection::average)},
                  {.modes = 48})
          .body;
  REQUIRE(reduced.size() == 48);
  const Vibration full = natural_modes(body, {}, {.count = 48});
  const Eigen::VectorXd omega = frequencies(reduced.K, reduced.M);
  for (int k = 6; k < 48; ++k) CHECK(omega[k] == doctest::Approx(full.omega[k]).epsilon(1e-7));  // rtol of the modes
  CHECK(omega[5] < 1e-3 * omega[6]);  // rigid motions: round-off of K over M, whose square root it is
}

TEST_CASE("ModesOfOneFrequency_AreKeptTogether") {
  const ElasticBody square = assemble(box_mesh(ElementType::hex20, {1, 0.1, 0.1}, {6, 1, 1}), {steel});
  const auto ends = [&] {
    return std::vector{frame_on(square.mesh, "x0", Connection::rigid), frame_on(square.mesh, "x1", Connection::rigid)};
  }();
  // Bars of square section bend both ways alike; frequencies are exact to the square of the modes' residual, 1e-7.
  for (const int modes : {1, 2, 3, 4}) {
    CAPTURE(modes);
    const int kept = modes < 3 ? 2 : 4;
    const ReducedBody reduced = must_reduce(square, ends, {.modes = modes}).body;
    REQUIRE(reduced.internal_omega.size() == kept);
    CHECK(reduced.internal_omega[kept - 1] ==
          doctest::Approx(reduced.internal_omega[kept - 2]).epsilon(1e-9));  // as above
  }
}

TEST_CASE("WrenchOnAFrame_MovesTheReducedBodyAsTheMesh") {
  const ElasticBody body = bar();
  const ReducedBody reduced =
      must_reduce(body, {frame_on(body.mesh, "x0", Connection::rigid), frame_on(body.mesh, "x1", Connection::average)},
                  {.modes = 3})
          .body;
  const Vector6 wrench = (Vector6() << 10, 20, -30, 400, 500, 600).finished();
  std::vector<Support> supports;
  for (const int dof : dofs_of(body.mesh.node_sets.at("x0"))) supports.push_back({dof, 0});
  const Eigen::MatrixXd f = frame_motion(body.mesh, reduced.frames[1]).transpose() * wrench;
  const StaticSolution full = solve_static(body, supports, f);
  REQUIRE(full.solved());
  Eigen::VectorXd q = Eigen::VectorXd::Zero(reduced.size());
  q.segment<6>(6) = reduced.K.block<6, 6>(6, 6).ldlt().solve(wrench);
  CHECK((reduced.Phi * q - full.u).norm() < kCondition * full.u.norm());
}

TEST_CASE("LoadShapes_AreRepresentedExactly_AndReportedWhereModesMissThem") {
  const ElasticBody body = bar();
  Eigen::MatrixXd loads(body.size(), 2);
  loads.col(0) = pressure_load(body.mesh, body.mesh.surfaces.at("z1"), 1e6);  // bends it: modes do that well
  loads.col(1) = pressure_load(body.mesh, body.mesh.surfaces.at("y0"), 1e6) +
                 pressure_load(body.mesh, body.mesh.surfaces.at("y1"), 1e6);
  const std::vector<InterfaceFrame> frames = {frame_on(body.mesh, "x0", Connection::rigid),
                                              frame_on(body.mesh, "x1", Connection::rigid)};
  const ReducedBody reduced = must_reduce(body, frames, {.modes = 10, .loads = loads}).body;
  CHECK(reduced.size() == 12 + 10 + 2);
  CHECK(reduced.energy_missed[0] < 0.02);
  CHECK(reduced.energy_missed[1] > 0.9);  // squeezing it
  std::vector<Support> supports;
  for (const auto& frame : frames)
    for (const int dof : dofs_of(frame.nodes)) supports.push_back({dof, 0});
  const StaticSolution full = solve_static(body, supports, loads);
  const Eigen::Index b = reduced.internal_first();
  const Eigen::MatrixXd Phi = reduced.Phi.rightCols(reduced.size() - b);
  const Eigen::MatrixXd q = reduced.internal_omega.cwiseAbs2().cwiseInverse().asDiagonal() * (Phi.transpose() * loads);
  // Round-off of internal modes that are orthonormalised to the loads.
  CHECK((Phi * q - full.u).norm() < 1e-7 * full.u.norm());
}

TEST_CASE("BorePressures_HaveTheResultantsOfTheirHarmonics") {
  // A block with a square hole would do; the outer sides of a box, z its axis, are simpler and as closed.
  const Mesh mesh = box_mesh(ElementType::hex20, {2, 2, 3}, {2, 2, 2});
  std::vector<ElementFace> sides;
  for (const char* name : {"x0", "x1", "y0", "y1"})
    sides.insert(sides.end(), mesh.surfaces.at(name).begin(), mesh.surfaces.at(name).end());
  const Eigen::MatrixXd f = bore_pressures(mesh, sides, {.r = {1, 1, 0}}, 1, 1);
  REQUIRE(f.cols() == 6);
  const Eigen::MatrixXd w = rigid_motions(mesh, {1, 1, 1.5}).transpose() * f;
  CHECK(w.col(1).norm() < 1e-12);                        // uniform
  CHECK(w(3, 2) < -1);                                   // cos phi pushes along -x
  CHECK(w(4, 0) == doctest::Approx(w(3, 2)));            // sin phi along -y, as strongly
  CHECK(std::abs(w(3, 5)) < 1e-12);                      // z cos phi: a moment only
  CHECK(w(1, 5) == doctest::Approx(w(3, 2) * 1.5 / 3));  // int s (h s) over the height, h = 1.5
}

TEST_CASE("FrameOnANodeOrAnEdge_MovesWithItAndRotatesWithTheElementsAround") {
  const ElasticBody body = bar(ElementType::hex20, {6, 2, 2});
  const InterfaceFrame root = frame_on(body.mesh, "x0", Connection::rigid);
  std::vector<int> edge;  // the upper edge of the free end
  double length = 0, top = 0;
  for (const Vector3& x : body.mesh.nodes) length = std::max(length, x.x()), top = std::max(top, x.z());
  for (std::size_t n = 0; n < body.mesh.nodes.size(); ++n)
    if (body.mesh.nodes[n].x() > length - 1e-9 && body.mesh.nodes[n].z() > top - 1e-9)
      edge.push_back(static_cast<int>(n));
  REQUIRE(edge.size() == 5);
  for (const std::vector<int>& nodes : {edge, std::vector<int>{edge[2]}}) {
    CAPTURE(nodes.size());
    InterfaceFrame tip{"tip", face_centre(body.mesh, nodes), nodes, Connection::average, {}};
    tip = braced(body.mesh, std::move(tip));
    CHECK(tip.nodes.size() > nodes.size());
    const ReducedBody reduced = must_reduce(body, {root, tip}, {.modes = 0}).body;
    // A force on the frame, the root at rest, against the same force shared by its own nodes of the whole mesh.
    const Eigen::MatrixXd flexibility = reduced.K.bottomRightCorner(6, 6).inverse();
    Eigen::VectorXd f = Eigen::VectorXd::Zero(body.size());
    for (const int n : nodes) f[3 * n + 2] = 1.0 / static_cast<double>(nodes.size());
    std::vector<Support> supports;
    for (const int dof : dofs_of(body.mesh.node_sets.at("x0"))) supports.push_back({dof, 0});
    const StaticSolution whole = solve_static(body, supports, f);
    REQUIRE(whole.solved());
    CHECK(flexibility(5, 5) == doctest::Approx(f.dot(whole.u.col(0))).epsilon(5e-3));
    CHECK(flexibility(1, 1) > 0);  // some nodes fix its rotation
  }
}

// The frames share an edge: what the rigid one does to it is a part of the average.
TEST_CASE("AveragingFrameOnNodesOfARigidOne_IsTheirAverageStill") {
  const ElasticBody body = bar(ElementType::hex20, {6, 2, 2});
  const InterfaceFrame root = frame_on(body.mesh, "x0", Connection::rigid),
                       top = frame_on(body.mesh, "z1", Connection::average);
  const ReducedBody reduced = must_reduce(body, {root, top}, {.modes = 4}).body;
  REQUIRE(reduced.size() == 16);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(6, 16);
  expected.middleCols<6>(6).setIdentity();
  const Eigen::MatrixXd average = frame_motion(body.mesh, top) * reduced.Phi;
  CHECK((average - expected).cwiseAbs().maxCoeff() < kCondition * reduced.Phi.cwiseAbs().maxCoeff());
}

TEST_CASE("FramesThatCannotSupportTheBody_AreReportedByName") {
  const ElasticBody body = bar(ElementType::tet4, {2, 1, 1});
  InterfaceFrame good = frame_on(body.mesh, "x0", Connection::rigid),
                 bad = frame_on(body.mesh, "x1", Connection::rigid);
  CHECK(reduce(body, {}).message.find("needs a frame") != std::string::npos);
  bad.nodes.clear();
  CHECK(reduce(body, {good, bad}).message == "frame 'x1' sits on no node");
  bad.nodes = {body.mesh.node_sets.at("x1")[0]};
  bad.weights.clear();
  CHECK(reduce(body, {good, bad}).message.find("'x1' lie on one line") != std::string::npos);
  bad = good;
  bad.name = "twin";
  CHECK(reduce(body, {good, bad}).message.find("frames 'x0' and 'twin' are both rigid and share node") !=
        std::string::npos);
}

TEST_CASE("PartNotConnectedToAnyFrame_IsReported") {
  Mesh mesh = box_mesh(ElementType::hex8, {1, 0.1, 0.06}, {2, 1, 1});
  const Mesh other = mesh;
  for (const Vector3& x : other.nodes) {
    mesh.nodes.push_back(x + Vector3(0, 5, 0));
    mesh.node_labels.push_back(mesh.node_labels.back() + 1);
  }
  for (Element e : other.elements) {
    const int* nodes = other.nodes_of(e);
    e.first = static_cast<int>(mesh.connectivity.size());
    for (int a = 0; a < 8; ++a) mesh.connectivity.push_back(nodes[a] + static_cast<int>(other.nodes.size()));
    mesh.elements.push_back(e);
  }
  const ElasticBody body = assemble(mesh, {steel});
  CHECK(reduce(body, {frame_on(mesh, "x0", Connection::rigid)}).message ==
        "a part of the body is not connected to the frames");
}

}  // namespace reduction_test
}  // namespace hersey::fem
