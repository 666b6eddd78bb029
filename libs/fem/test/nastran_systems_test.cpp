// A body is the same in whatever coordinate systems its grid points are written.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "element/element_kind.h"
#include "hersey/fem/elastic_body.h"
#include "hersey/fem/mesh_file.h"
#include "hersey/fem/mesh_quality.h"
#include "small_bodies.h"

namespace hersey::fem {
namespace nastran_systems_test {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double kDegreesOf = 180 / std::numbers::pi;

Mesh read(const std::string& text, std::vector<Fault>* warnings = nullptr) {
  return parse_mesh(text, MeshFormat::nastran, "x", 1, warnings);
}

std::string refusal(const std::string& text) {
  try {
    (void)read(text);
  } catch (const InputError& error) {
    return fmt::format("{}: {}", error.faults().at(0).position.line, error.faults().at(0).found);
  }
  return "none";
}

struct Axes {
  Vector3 origin = Vector3::Zero();
  Matrix3 R = Matrix3::Identity();  // columns in the system before
  char kind = 'R';
};

Vector3 along(char kind, const Vector3& q) {
  if (kind == 'R') return q;
  const double a = q[1] / kDegreesOf, b = q[2] / kDegreesOf;
  if (kind == 'C') return {q[0] * std::cos(a), q[0] * std::sin(a), q[2]};
  return {q[0] * std::sin(a) * std::cos(b), q[0] * std::sin(a) * std::sin(b), q[0] * std::cos(a)};
}

/// Coordinates as a file writes them of a point with these components along the system's axes.
Vector3 coordinates(char kind, const Vector3& x) {
  const double phi = kDegreesOf * std::atan2(x.y(), x.x()), rho = std::hypot(x.x(), x.y());
  if (kind == 'R') return x;
  if (kind == 'C') return {rho, phi, x.z()};
  return {x.norm(), kDegreesOf * std::atan2(rho, x.z()), phi};
}

std::string numbers(const Vector3& x) { return fmt::format("{:.17f},{:.17f},{:.17f}", x[0], x[1], x[2]); }

/// The coordinates in the last of a chain of systems, each defined by three points in the one before.
struct Chain {
  std::vector<Axes> systems;

  [[nodiscard]] Vector3 in_last(Vector3 r) const {
    for (const Axes& axes : systems) r = axes.R.transpose() * (r - axes.origin);
    return coordinates(systems.back().kind, r);
  }

  [[nodiscard]] std::string entries() const {
    std::string text;
    char before = 'R';
    for (std::size_t k = 0; k < systems.size(); ++k) {
      const Axes& axes = systems[k];
      const Vector3 a = axes.origin, b = a + 2 * axes.R.col(2), c = a + 0.5 * axes.R.col(0) + 0.7 * axes.R.col(2);
      text += fmt::format("CORD2{},{},{},{},{}\n,{}\n", axes.kind, 10 + k, k == 0 ? 0 : 9 + k,
                          numbers(coordinates(before, a)), numbers(coordinates(before, b)),
                          numbers(coordinates(before, c)));
      before = axes.kind;
    }
    return text;
  }
};

Chain chain_of(const std::string& kinds) {
  Chain chain;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const double angle = 0.4 + 0.3 * static_cast<double>(k);
    chain.systems.push_back({Vector3(0.3, -0.2 + 0.1 * static_cast<double>(k), 0.7),
                             Eigen::AngleAxisd(angle, Vector3(1, 2, -1).normalized()).toRotationMatrix(), kinds[k]});
  }
  return chain;
}

std::string body(const Mesh& mesh, const std::function<std::string(const Vector3&)>& coordinates,
                 const std::string& system) {
  std::string text;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    text += fmt::format("GRID,{},{},{}\n", mesh.node_labels[n], system, coordinates(mesh.nodes[n]));
  for (const Element& e : mesh.elements) {
    text += fmt::format("CHEXA,{},1", e.label);
    for (int k = 0; k < 8; ++k) text += fmt::format("{},{}", k == 6 ? "\n" : "", mesh.node_labels[mesh.nodes_of(e)[k]]);
    text += "\n";
  }
  return text + "ENDDATA\n";
}

TEST_CASE("TheSameBody_InBasicAndInChainedSystems_HasTheSameMatrices") {
  const Mesh box = distorted_box(ElementType::hex8);
  const ElasticBody basic = assemble(read(body(box, numbers, "")), {steel});
  for (const std::string kinds : {"R", "C", "S", "RC", "CS", "SC", "RCSR", "CRS"}) {
    CAPTURE(kinds);
    const Chain chain = chain_of(kinds);
    const auto coordinates = [&](const Vector3& r) { return numbers(chain.in_last(r)); };
    // Systems may stand behind the points that use them.
    const std::string text = body(box, coordinates, std::to_string(9 + kinds.size()));
    const ElasticBody chained = assemble(read(chain.entries() + text), {steel});
    // Seventeen digits and the round-off of some rotations; strains divide by the elements' size.
    CHECK((chained.K - basic.K).norm() < 1000 * eps * basic.K.norm());
    CHECK((chained.m - basic.m).norm() < 1000 * eps * basic.m.norm());
    const std::string by_default = fmt::format("GRDSET,,{}\n", 9 + kinds.size()) + body(box, coordinates, "");
    CHECK((assemble(read(chain.entries() + by_default), {steel}).K - basic.K).norm() < 1000 * eps * basic.K.norm());
  }
}

TEST_CASE("SystemsByGridPoints_AreThoseByTheirPositions") {
  const Mesh box = distorted_box(ElementType::hex8);
  const Chain chain = chain_of("RC");
  const auto coordinates = [&](const Vector3& r) { return numbers(chain.in_last(r)); };
  const std::string text = body(box, coordinates, "11");
  const Mesh expected = read(chain.entries() + text);
  // The second system by points 91 to 93, which lie in the first one.
  const Axes& last = chain.systems[1];
  const Vector3 b = last.origin + last.R.col(2), c = last.origin + last.R.col(0);
  const std::string first = chain.entries().substr(0, chain.entries().find("CORD2C"));
  const std::string by_grids = first + fmt::format("CORD1C,11,91,92,93\nGRID,91,10,{}\nGRID,92,10,{}\nGRID,93,10,{}\n",
                                                   numbers(last.origin), numbers(b), numbers(c));
  const Mesh mesh = read(by_grids + text);
  REQUIRE(mesh.nodes.size() == expected.nodes.size());
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) CHECK((mesh.nodes[n] - expected.nodes[n]).norm() < 100 * eps);
}

const std::string kTetIn7 =
    "GRID,1,7,0.,0.,0.\nGRID,2,7,1.,0.,0.\nGRID,3,7,0.,1.,0.\nGRID,4,7,0.,0.,1.\nCTETRA,1,1,1,2,3,4\n";

TEST_CASE("SystemsThatLeadNowhere_AreReportedWithTheirLine") {
  CHECK(refusal(kTetIn7) == "1: the coordinate system 7, which the file does not define");
  const std::string points = "0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n";
  CHECK(refusal(kTetIn7 + "CORD2R,7,8," + points + "CORD2C,8,7," + points)
            .ends_with("the coordinate system 7 is defined by itself, through other systems"));
  CHECK(refusal(kTetIn7 + "CORD1R,7,1,2,3\n") ==
        "6: the coordinate system 7 is defined by itself, through other systems");
  CHECK(refusal(kTetIn7 + "CORD1R,7,91,92,93\n") == "6: the grid point 91, which the file does not define");
  CHECK(refusal(kTetIn7 + "CORD2R,7,,0.,0.,0.,0.,0.,1.\n,0.,0.,2.\n") ==
        "6: the coordinate system 7 has its three points on one line");
  CHECK(refusal(kTetIn7 + "CORD2R,7,," + points + "CORD2R,7,,1." + points.substr(2)) ==
        "8: the coordinate system 7 is already defined in line 6, differently");
  CHECK(refusal(kTetIn7 + "CORD2R,7,," + points + "CORD2R,7,," + points) == "none");
  CHECK(refusal("CORD2R,5\n" + kTetIn7 + "CORD2R,7,," + points) == "none");  // nothing lies in 5
}

TEST_CASE("SolidsNumberedLeftHanded_AreTheSameSolids") {
  for (const ElementType type :
       {ElementType::tet10, ElementType::wedge15, ElementType::hex20, ElementType::pyramid13}) {
    CAPTURE(name_of(type));
    const NodeColumns x = distorted_element(type);
    const std::string entry = type == ElementType::tet10     ? "CTETRA"
                              : type == ElementType::wedge15 ? "CPENTA"
                              : type == ElementType::hex20   ? "CHEXA"
                                                             : "CPYRAM";
    const auto text = [&](bool is_mirrored) {
      std::string grids, nodes;
      std::vector<Eigen::Index> fields(static_cast<std::size_t>(x.cols()));
      const std::vector<std::size_t>& order = kind_of(type).files.nastran_order;
      for (Eigen::Index a = 0; a < x.cols(); ++a) {
        fields[order.empty() ? static_cast<std::size_t>(a) : order[static_cast<std::size_t>(a)]] = a + 1;
        grids += fmt::format("GRID,{},,{:.15f},{:.15f},{:.15f}\n", a + 1, x(0, a), x(1, a),
                             is_mirrored ? -x(2, a) : x(2, a));
      }
      for (std::size_t k = 0; k < fields.size(); ++k)
        nodes += fmt::format("{},{}", k == 6 || k == 14 ? "\n" : "", fields[k]);
      return grids + entry + ",1,1" + nodes + "\nENDDATA\n";
    };
    const Mesh right = read(text(false)), left = read(text(true));
    CHECK(quality_of(left).folded.empty());
    CHECK(quality_of(left).volume == doctest::Approx(quality_of(right).volume).epsilon(1000 * eps));
  }
}

TEST_CASE("Replication_WritesWhatItStandsFor") {
  const std::string rest =
      "GRID,10,,0.,1.,0.\nGRID,11,,0.,0.,1.\nCTETRA,1,1,1,2,10,11\n=,*1,=,*1,*1,==\n=(2)\nENDDATA\n";
  const std::string written =
      "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,2.,0.,0.\nGRID,4,,3.,0.,0.\nGRID,5,,4.,0.,0.\n";
  const std::string whole =
      "GRID,10,,0.,1.,0.\nGRID,11,,0.,0.,1.\nCTETRA,1,1,1,2,10,11\nCTETRA,2,1,2,3,10,11\nCTETRA,3,1,3,4,10,11\nCTETRA,"
      "4,1,"
      "4,5,10,11\nENDDATA\n";
  const Mesh expected = read(written + whole);
  for (const std::string grids :
       {"GRID,1,,0.,0.,0.\n=,*1,=,*1.,==\n=3\n", "GRID,1,,0.,0.,0.\n=,*(1),,*(1.),=,=\n=(3)\n",
        "GRID           1              0.      0.      0.\n=       *(1)    =       *(1.)   ==\n=(3)\n"}) {
    CAPTURE(grids);
    const Mesh mesh = read(grids + rest);
    CHECK(mesh.nodes == expected.nodes);
    CHECK(mesh.connectivity == expected.connectivity);
  }
  CHECK(refusal("=,*1\n" + written + whole).starts_with("1: a replication of no entry"));
  CHECK(refusal("GRID,1,,0.,0.,0.\n=(99999999999)\n").starts_with("2: a replication without its count"));
  // A count repeats the step of the entry right before it.
  CHECK(refusal("GRID,1,,0.,0.,0.\n=,*1,==\nCORD2R,5,,1.,2.,3.,4.,5.,6.\n,7.,8.,9.\n=(2)\n")
            .starts_with("5: a replication without its count, or of no step"));
  CHECK(refusal("GRID,1,,0.,0.,0.\n=,*x\n").starts_with("2: a replication that adds to what is no number"));
}

TEST_CASE("ShortenedWords_AndContinuationsByTheirNames_AreRead") {
  const std::string points = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n";
  for (const std::string begin : {"BEGIN BULK", "BEGIN BU", "begin b", "BEGIN  BULK $ x"}) {
    CAPTURE(begin);
    std::vector<Fault> warnings;
    CHECK(read("SOL 103\nCEND\nSET 3 = 1 THRU 4 EXCEPT 2, 9\n" + begin + "\n" + points + "CTETRA,1,1,1,2,3,4\nENDD\n",
               &warnings)
              .node_sets.at("set_3") == std::vector<int>{0, 2, 3});
    CHECK(warnings.empty());
  }
  // The first letter of a continuation's name is replaced by the sign.
  CHECK(read(points + "CTETRA  1       1       1       2       3       4                       P51\n"
                      "+51\nENDDATA\n")
            .elements.size() == 1);
  std::vector<Fault> warnings;
  (void)read("SET 1 = AERO1\nBEGIN BULK\n" + points + "CTETRA,1,1,1,2,3,4\nENDDATA\n", &warnings);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].found == "'AERO1' in SET 1");
}

}  // namespace nastran_systems_test
}  // namespace hersey::fem
