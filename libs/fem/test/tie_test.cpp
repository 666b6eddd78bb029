// Two halves that are tied in any of the ways files know are the body that shares its nodes.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <functional>
#include <string>
#include <vector>

#include "hersey/fem/constrained_stiffness.h"
#include "hersey/fem/load_vectors.h"
#include "hersey/fem/mesh_file.h"
#include "hersey/fem/mesh_quality.h"
#include "hersey/fem/reduction.h"
#include "hersey/fem/ties.h"
#include "hersey/fem/vibration.h"
#include "small_bodies.h"

namespace hersey::fem {
namespace tie_test {

constexpr int kLabelsOfTop = 100;  // nodes of the upper half are numbered from here on

const Vector3 kHalf(0.4, 0.3, 0.5);
const std::array<int, 3> kCells{2, 2, 2};

/// Two boxes of one type, the second on top of the first: nodes of both, and the pairs that lie on each other.
struct Halves {
  Mesh bottom, top;
  std::vector<std::pair<long, long>> pairs;

  explicit Halves(ElementType type) : bottom(box_mesh(type, kHalf, kCells)), top(bottom) {
    for (Vector3& r : top.nodes) r.z() += kHalf.z();
    for (long& label : top.node_labels) label += kLabelsOfTop;
    for (const int a : bottom.node_sets.at("z1"))
      for (const int b : top.node_sets.at("z0"))
        if ((bottom.nodes[a] - top.nodes[b]).norm() < 1e-9)  // a millionth of an element
          pairs.emplace_back(bottom.node_labels[a], top.node_labels[b]);
  }
};

std::string nastran_nodes(const Mesh& mesh) {
  std::string text;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    text += fmt::format("GRID,{},,{:.12f},{:.12f},{:.12f}\n", mesh.node_labels[n], mesh.nodes[n].x(), mesh.nodes[n].y(),
                        mesh.nodes[n].z());
  return text;
}

std::string nastran_elements(const Mesh& mesh, long from, const std::function<long(long)>& label) {
  std::string text;
  for (const Element& e : mesh.elements) {
    text += fmt::format("CHEXA,{},{}", from + e.label, from + 1);
    for (int k = 0; k < 8; ++k)
      text += fmt::format("{},{}", k == 6 ? "\n" : "", label(mesh.node_labels[mesh.nodes_of(e)[k]]));
    text += "\n";
  }
  return text;
}

std::string nastran(const Halves& halves, const std::string& ties) {
  const auto same = [](long label) { return label; };
  return nastran_nodes(halves.bottom) + nastran_nodes(halves.top) + nastran_elements(halves.bottom, 0, same) +
         nastran_elements(halves.top, 50, same) + ties + "ENDDATA\n";
}

std::string abaqus(const Halves& halves, const std::string& ties) {
  std::string text = "*NODE\n";
  for (const Mesh* mesh : {&halves.bottom, &halves.top})
    for (std::size_t n = 0; n < mesh->nodes.size(); ++n)
      text += fmt::format("{},{:.12f},{:.12f},{:.12f}\n", mesh->node_labels[n], mesh->nodes[n].x(), mesh->nodes[n].y(),
                          mesh->nodes[n].z());
  long label = 0;
  for (const Mesh* mesh : {&halves.bottom, &halves.top}) {
    text += fmt::format("*ELEMENT,TYPE=C3D8,ELSET={}\n", label == 0 ? "bottom" : "top");
    for (const Element& e : mesh->elements) {
      text += fmt::format("{}", ++label);
      for (int k = 0; k < 8; ++k) text += fmt::format(",{}", mesh->node_labels[mesh->nodes_of(e)[k]]);
      text += "\n";
    }
  }
  const auto surface = [](const char* name, const char* elements, const char* face) {
    return fmt::format("*SURFACE,NAME={}\n{},{}\n", name, elements, face);
  };
  return text + surface("up", "bottom", "S2") + surface("down", "top", "S1") + ties;
}

Mesh read(const std::string& text, MeshFormat format, std::vector<Fault>* warnings = nullptr) {
  return parse_mesh(text, format, "x", 1, warnings);
}

std::string for_pairs(const Halves& halves, const std::function<std::string(long, long, int)>& entry) {
  std::string text;
  int number = 0;
  for (const auto& [a, b] : halves.pairs) text += entry(a, b, ++number);
  return text;
}

struct Tied {
  const char* name;
  Mesh mesh;
};

std::vector<Tied> all_ties(const Halves& halves) {
  std::vector<Tied> all;
  const auto add = [&](const char* name, const std::string& text, MeshFormat format) {
    all.push_back({name, read(text, format)});
  };
  add("RBE2",
      nastran(halves, for_pairs(halves, [](long a, long b,
                                           int k) { return fmt::format("RBE2,{},{},123,{}\n", 900 + k, a, b); })),
      MeshFormat::nastran);
  add("RBAR",
      nastran(halves,
              for_pairs(halves, [](long a, long b,
                                   int k) { return fmt::format("RBAR,{},{},{},123456,,,123\n", 900 + k, a, b); })),
      MeshFormat::nastran);
  add("RBE3",
      nastran(halves, for_pairs(halves,
                                [](long a, long b, int k) {
                                  // Of one member with all its components: it moves as that one.
                                  return fmt::format("RBE3,{},,{},123,1.,123456,{}\n", 900 + k, b, a);
                                })),
      MeshFormat::nastran);
  // In the axes of a rotated system, in which the same three components span the same displacements.
  add("MPC in rotated axes",
      "CORD2C,7,,0.,0.,0.,0.3,0.2,1.\n,1.,0.,0.\nGRDSET,,,,,,7\n" +
          nastran(halves, for_pairs(halves,
                                    [](long a, long b, int) {
                                      std::string text;
                                      for (int c = 1; c <= 3; ++c)
                                        text += fmt::format("MPC,1,{},{},2.,{},{},-2.\n", a, c, b, c);
                                      return text;
                                    })),
      MeshFormat::nastran);
  add("EQUATION",
      abaqus(halves, for_pairs(halves,
                               [](long a, long b, int) {
                                 std::string text = "*EQUATION\n";
                                 for (int c = 1; c <= 3; ++c)
                                   text += fmt::format("2\n{},{},1.,{},{},-1.\n", b, c, a, c);
                                 return text;
                               })),
      MeshFormat::abaqus);
  add("TIE", abaqus(halves, "*TIE,NAME=t\ndown,up\n"), MeshFormat::abaqus);
  add("TIE the other way", abaqus(halves, "*TIE,NAME=t,ADJUST=NO\nup,down\n"), MeshFormat::abaqus);
  add("MPC TIE",
      abaqus(halves,
             "*MPC\n" + for_pairs(halves, [](long a, long b, int) { return fmt::format("TIE,{},{}\n", b, a); })),
      MeshFormat::abaqus);
  return all;
}

Mesh merged(const Halves& halves) {
  const auto label = [&](long top) {
    for (const auto& [a, b] : halves.pairs)
      if (b == top) return a;
    return top;
  };
  const auto same = [](long l) { return l; };
  return read(nastran_nodes(halves.bottom) + nastran_nodes(halves.top) + nastran_elements(halves.bottom, 0, same) +
                  nastran_elements(halves.top, 50, label) + "ENDDATA\n",
              MeshFormat::nastran);
}

Eigen::VectorXd frequencies(const Mesh& mesh, const std::vector<int>& fixed) {
  const Vibration modes = natural_modes(assemble(mesh, {steel}), fixed, {.count = 12});
  REQUIRE(modes.solved());
  return modes.omega;
}

/// Nodes at the height 0, wherever the file's labels put them.
std::vector<int> foot(const Mesh& mesh) {
  std::vector<int> nodes;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    // A millionth of an element.
    if (std::abs(mesh.nodes[n].z()) < 1e-9) nodes.push_back(static_cast<int>(n));
  return nodes;
}

TEST_CASE("TiedHalves_VibrateAsTheBodyThatSharesItsNodes") {
  const Halves halves(ElementType::hex8);
  const Mesh one = merged(halves);
  const Eigen::VectorXd free = frequencies(one, {}), fixed = frequencies(one, dofs_of(foot(one)));
  for (const Tied& tied : all_ties(halves)) {
    CAPTURE(tied.name);
    CHECK(tied.mesh.ties.size() == 27);  // three for each of nine pairs
    CHECK(quality_of(tied.mesh).parts.size() == 1);
    // Lanczos iteration stops at 1e-7, which squared is round-off of the factors.
    CHECK((frequencies(tied.mesh, {}) - free).norm() < 1e-9 * free.norm());
    CHECK((frequencies(tied.mesh, dofs_of(foot(tied.mesh))) - fixed).norm() < 1e-9 * fixed.norm());
  }
}

TEST_CASE("Ties_LetTheBodyMoveRigidly") {
  const Halves halves(ElementType::hex8);
  std::vector<Tied> all = all_ties(halves);
  const std::string far = "GRID,800,,2.,1.,3.\n";  // of no element
  const std::string members = "RBE2,1,800,123,1,2,3,4,\n,5,101,105,106\n";
  all.push_back({"RBE2 on a far point", read(far + nastran(halves, members), MeshFormat::nastran)});
  all.push_back(
      {"RBE3 of a face", read(nastran(halves, "RBE3,1,,127,123,1.,123,1,2,\n,3,2.,123,5,9\n"), MeshFormat::nastran)});
  all.push_back({"RBE1", read(nastran(halves, "RBE1,1,1,123,2,23,4,3\n,UM,110,123,127,12\n"), MeshFormat::nastran)});
  all.push_back({"RROD", read(nastran(halves, "RROD,1,1,127\n"), MeshFormat::nastran)});
  all.push_back({"RIGID BODY",
                 read(abaqus(halves, "*NSET,NSET=n\n1,2,3,110\n*RIGID BODY,NSET=n,REF NODE=1\n"), MeshFormat::abaqus)});
  for (const Tied& tied : all) {
    CAPTURE(tied.name);
    CHECK_FALSE(tied.mesh.ties.empty());
    const Eigen::MatrixXd left = tie_constraints(tied.mesh, {}).C * rigid_motions(tied.mesh, Vector3(0.1, -0.3, 0.2));
    // Positions have twelve digits in the file, arms are of the order of one.
    CHECK(left.cwiseAbs().maxCoeff() < 1e-10);
  }
}

TEST_CASE("RigidNodes_KeepSixCoordinates_WhateverTheirReference") {
  const Halves halves(ElementType::hex8);
  const auto ties = [&](const std::string& entries) {
    return read("GRID,800,,2.,1.,3.\nGRID,801,,0.,0.,0.\n" + nastran(halves, entries), MeshFormat::nastran).ties.size();
  };
  CHECK(ties("RBE2,1,800,123,1,2,5,101\n") == 3 * 4 - 6);
  CHECK(ties("RBE2,1,800,123456,1,2,5,101\n") == 3 * 4 - 6);  // rotations of solids' nodes are no one's
  CHECK(ties("RBE2,1,1,123,2,5,101\n") == 3 * 4 - 6);
  CHECK(ties("RBE2,1,800,123456,801\nRBE2,2,801,123,1,2,5,101\n") == 3 * 4 - 6);     // a chain
  CHECK(ties("RBE2,1,800,123,1,2,5,101\nRBE2,2,800,123,1,2,5,101\n") == 3 * 4 - 6);  // said twice
  CHECK(ties("RBE2,1,800,123,1\n") == 0);
}

TEST_CASE("ReducedBodyOfTiedHalves_IsThatOfTheMergedMesh") {
  const Halves halves(ElementType::hex8);
  const auto reduced = [](const Mesh& mesh) {
    const InterfaceFrame frame{"foot", Vector3::Zero(), foot(mesh), Connection::rigid, {}};
    Reduction reduction = reduce(assemble(mesh, {steel}), {frame}, {.modes = 6});
    REQUIRE(reduction.solved());
    return reduction.body;
  };
  const ReducedBody expected = reduced(merged(halves));
  for (const Tied& tied : all_ties(halves)) {
    CAPTURE(tied.name);
    const ReducedBody body = reduced(tied.mesh);
    // Two factorisations of stiffnesses whose condition numbers are 1e6.
    CHECK((body.internal_omega - expected.internal_omega).norm() < 1e-9 * expected.internal_omega.norm());
    // Likewise.
    CHECK((body.M.topLeftCorner<6, 6>() - expected.M.topLeftCorner<6, 6>()).norm() < 1e-9 * expected.M.norm());
  }
}

TEST_CASE("SupportsOfTiedNodes_BearTheLoad") {
  const Halves halves(ElementType::hex8);
  for (const Tied& tied : all_ties(halves)) {
    CAPTURE(tied.name);
    const ElasticBody body = assemble(tied.mesh, {steel});
    // All nodes of the lower half are fixed, those that ties reach among them.
    std::vector<int> low;
    for (std::size_t n = 0; n < body.mesh.nodes.size(); ++n)
      if (body.mesh.node_labels[n] < kLabelsOfTop) low.push_back(static_cast<int>(n));
    std::vector<Support> supports;
    for (const int dof : dofs_of(low)) supports.push_back({dof, 0});
    const Vector3 g(1, 2, -9.81);
    const StaticSolution solution = solve_static(body, supports, gravity_load(body, g));
    REQUIRE(solution.solved());
    Vector3 sum = Vector3::Zero();
    for (Eigen::Index n = 0; n < body.node_count(); ++n) sum += solution.reaction.block<3, 1>(3 * n, 0);
    CHECK((sum + body.mass * g).norm() < 1e-9 * body.mass * g.norm());  // round-off of the factors
  }
}

TEST_CASE("TwoRigidFrames_OnBothSidesOfATie_AreRefused") {
  const Halves halves(ElementType::hex8);
  const Mesh mesh = read(abaqus(halves, "*TIE,NAME=t\ndown,up\n"), MeshFormat::abaqus);
  const auto nodes = [&](const char* surface) { return mesh.node_sets.at(surface); };
  const InterfaceFrame up{"up", Vector3::Zero(), nodes("up"), Connection::rigid, {}};
  const InterfaceFrame down{"down", Vector3::Zero(), nodes("down"), Connection::rigid, {}};
  CHECK(reduce(assemble(mesh, {steel}), {up}, {.modes = 2}).solved());
  const Reduction reduction = reduce(assemble(mesh, {steel}), {up, down}, {.modes = 2});
  CHECK_FALSE(reduction.solved());
  CHECK(reduction.message.find("hold nodes that a tie of the mesh joins") != std::string::npos);
}

TEST_CASE("TiesBetweenMeshesThatDoNotMatch_PassThePatchTest") {
  // The lower faces are coarser than the nodes that hang on them.
  Halves halves(ElementType::hex8);
  halves.top = box_mesh(ElementType::hex8, kHalf, {3, 4, 2});
  for (Vector3& r : halves.top.nodes) r.z() += kHalf.z();
  for (long& label : halves.top.node_labels) label += kLabelsOfTop;
  const Mesh mesh = read(abaqus(halves, "*TIE,NAME=t\ndown,up\n"), MeshFormat::abaqus);
  const ElasticBody body = assemble(mesh, {steel});
  const Matrix3 gradient = (Matrix3() << 1, 2, 3, -4, 5, 6, 7, -8, 9).finished();
  Eigen::VectorXd u(body.size());
  for (Eigen::Index n = 0; n < body.node_count(); ++n) u.segment<3>(3 * n) = gradient * mesh.nodes[n];
  const Eigen::SparseMatrix<double> C = tie_constraints(mesh, {}).C;
  CHECK((C * u).norm() < 1e-10 * u.norm());  // twelve digits of positions
}

TEST_CASE("TiesThatCannotBeFollowed_AreReportedWithTheirLine") {
  const Halves halves(ElementType::hex8);
  const auto refusal = [&](const std::string& text, MeshFormat format) -> std::string {
    try {
      (void)read(text, format);
    } catch (const InputError& error) {
      return error.faults().at(0).found;
    }
    return "none";
  };
  const auto of_nastran = [&](const std::string& entry) {
    return refusal(nastran(halves, entry), MeshFormat::nastran);
  };
  CHECK(of_nastran("RBE2,1,777,123,1\n") == "the grid point 777, which the file does not define");
  CHECK(of_nastran("RBE2,1,1,129,2\n") == "components '129' in RBE2");
  CHECK(of_nastran("RBAR,1,1,101,12\n") == "a rigid element with 2 independent components");
  CHECK(of_nastran("RBE3,1,,101,123,1.,123,1,2\n").starts_with("an RBE3 whose grid points"));
  CHECK(of_nastran("MPC,1,1,9,1.,2,1,-1.\n") == "component 9 in MPC");
  const auto of_abaqus = [&](const std::string& entry) { return refusal(abaqus(halves, entry), MeshFormat::abaqus); };
  CHECK(of_abaqus("*TIE,NAME=t\ndown,upp\n") == "a tie to 'upp', which has no faces");
  CHECK(of_abaqus("*TIE,NAME=t\ndwn,up\n") == "the set 'dwn', which the file does not define");
  CHECK(of_abaqus("*EQUATION\n2\n1,1,1.\n") == "an equation that lacks 1 terms");
  CHECK(of_abaqus("*EQUATION\n2\n1,1,1.,777,1,-1.\n") == "node 777, which the file does not contain");
  CHECK(of_abaqus("*RIGID BODY,REF NODE=1\n") == "*RIGID BODY without a set");
  CHECK(of_abaqus("*TRANSFORM,NSET=up\n1.,0.,0.,0.,1.,0.\n*EQUATION\n2\n19,1,1.,101,1,-1.\n")
            .starts_with("an equation of node 19, whose axes *TRANSFORM rotates"));
  std::vector<Fault> warnings;
  const Mesh far = read(abaqus(halves, "*TIE,NAME=t,POSITION TOLERANCE=0.01\nfoot,up\n*NSET,NSET=foot\n1,2,3\n"),
                        MeshFormat::abaqus, &warnings);
  CHECK(far.ties.empty());
  REQUIRE_FALSE(warnings.empty());
  CHECK(warnings[0].found == "3 nodes of 'foot' farther than 0.01 from 'up'; the first is 1");
}

TEST_CASE("EquationsBetweenSets_PairTheirNodes") {
  const Halves halves(ElementType::hex8);
  std::string of_sets = "*NSET,NSET=a\n", more = "*NSET,NSET=b\n";
  for (const auto& [a, b] : halves.pairs) of_sets += fmt::format("{}\n", a), more += fmt::format("{}\n", b);
  const std::string equations = "*EQUATION\n2\nb,1,1.,a,1,-1.\n2\nb,2,1.,a,2,-1.\n2\nb,3,1.,a,3,-1.\n";
  const Mesh mesh = read(abaqus(halves, of_sets + more + equations), MeshFormat::abaqus);
  const Eigen::VectorXd expected = frequencies(merged(halves), {});
  CHECK((frequencies(mesh, {}) - expected).norm() < 1e-9 * expected.norm());  // as above
}

TEST_CASE("PartsThatNothingJoins_AreRefused_UnlessTheyAreMeant") {
  const Halves halves(ElementType::hex8);
  const Mesh mesh = read(nastran(halves, "SET1,4,1,101\nSET1,5,1,2\n"), MeshFormat::nastran);
  const MeshQuality quality = quality_of(mesh);
  CHECK(quality.parts.size() == 2);
  CHECK(quality.joining_sets == std::vector<std::string>{"set_4"});
  const std::vector<Fault> faults = faults_of(quality, "x");
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].suggestion.find("sets with nodes of several parts: set_4") != std::string::npos);
  CHECK(faults_of(quality, "x", Parts::apart).empty());
  const std::vector<Fault> warnings = warnings_of(quality, "x", Parts::apart);
  REQUIRE_FALSE(warnings.empty());
  CHECK(warnings[0].found.starts_with("2 parts that share no node"));
  // A rigid frame on nodes of both joins them: it moves as a whole.
  std::vector<int> both = foot(mesh);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (mesh.nodes[n].z() > 2 * kHalf.z() - 1e-9) both.push_back(static_cast<int>(n));
  const InterfaceFrame frame{"both", Vector3::Zero(), both, Connection::rigid, {}};
  CHECK(reduce(assemble(mesh, {steel}), {frame}, {.modes = 2}).solved());
  const InterfaceFrame lower{"lower", Vector3::Zero(), foot(mesh), Connection::rigid, {}};
  CHECK_FALSE(reduce(assemble(mesh, {steel}), {lower}, {.modes = 2}).solved());
}

}  // namespace tie_test
}  // namespace hersey::fem
