#include "hersey/fem/shape_functions.h"

#include <doctest/doctest.h>

#include <limits>

#include "hersey/core/contract.h"
#include "hersey/fem/quadrature.h"
#include "small_bodies.h"

namespace hersey::fem {
namespace shape_functions_test {

constexpr double eps = std::numeric_limits<double>::epsilon();

TEST_CASE("ShapeFunctions_AreOneAtTheirOwnNodeAndZeroAtOthers") {
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const Eigen::Matrix3Xd nodes = natural_nodes(type);
    REQUIRE(nodes.cols() == node_count(type));
    for (Eigen::Index a = 0; a < nodes.cols(); ++a) {
      const NodeValues N = shape_functions(type, nodes.col(a)).N;
      CHECK((N - NodeValues::Unit(N.size(), a)).cwiseAbs().maxCoeff() < 8 * eps);
    }
  }
}

TEST_CASE("ShapeFunctions_SumToOneAndTheirDerivativesAreExact") {
  const Vector3 xi(0.21, 0.34, 0.13);
  const double h = 1e-5;  // central difference: error h^2 and eps/h
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const ShapeFunctions s = shape_functions(type, xi);
    CHECK(std::abs(s.N.sum() - 1) < 20 * eps);
    for (int k = 0; k < 3; ++k) {
      const NodeValues difference =
          (shape_functions(type, xi + h * Vector3::Unit(k)).N - shape_functions(type, xi - h * Vector3::Unit(k)).N) /
          (2 * h);
      CHECK((s.dN.col(k) - difference).cwiseAbs().maxCoeff() < 10 * h * h);
    }
  }
}

TEST_CASE("FaceShapes_AreTheSolidsShapesOnTheirFaces") {
  for (const ElementType type : solids)
    for (int face = 0; face < face_count(type); ++face) {
      CAPTURE(name_of(type));
      CAPTURE(face);
      const Eigen::Matrix3Xd nodes = natural_nodes(type);
      const std::vector<int>& of_face = face_nodes(type, face);
      const FaceShape s = face_shape(static_cast<int>(of_face.size()), 0.2, 0.3);
      Eigen::Matrix3Xd corners(3, of_face.size());
      for (std::size_t a = 0; a < of_face.size(); ++a)
        corners.col(static_cast<Eigen::Index>(a)) = nodes.col(of_face[a]);
      const Vector3 xi = corners * s.N;
      const NodeValues solid = shape_functions(type, xi).N;
      double others = 0;
      for (Eigen::Index a = 0; a < solid.size(); ++a) {
        const auto at = std::find(of_face.begin(), of_face.end(), a);
        const double on_face = at == of_face.end() ? 0 : s.N[at - of_face.begin()];
        others = std::max(others, std::abs(solid[a] - on_face));
      }
      CHECK(others < 20 * eps);
      // Outward: away from the element's middle.
      const Eigen::Matrix<double, 3, 2> t = corners * s.dN;
      CHECK(t.col(0).cross(t.col(1)).dot(xi - nodes.rowwise().mean()) > 0);
    }
}

TEST_CASE("Quadrature_WeightsAddUpToTheVolumeAndPolynomialsAreExact") {
  const auto integral = [](const std::vector<QuadraturePoint>& points, int a, int b, int c) {
    double sum = 0;
    for (const auto& [xi, w] : points) sum += w * std::pow(xi[0], a) * std::pow(xi[1], b) * std::pow(xi[2], c);
    return sum;
  };
  const auto factorial = [](int n) { return std::tgamma(n + 1.0); };
  // int over the tetrahedron of x^a y^b z^c = a! b! c!/(a + b + c + 3)!; the mass of tet10 needs degree 4.
  for (int a = 0; a <= 5; ++a)
    for (int b = 0; a + b <= 5; ++b)
      for (int c = 0; a + b + c <= 5; ++c)
        CHECK(
            integral(mass_points(ElementType::tet10), a, b, c) ==
            doctest::Approx(factorial(a) * factorial(b) * factorial(c) / factorial(a + b + c + 3)).epsilon(100 * eps));
  for (int a = 0; a <= 5; ++a)
    for (int b = 0; a + b <= 5; ++b)
      CHECK(integral(face_points(6), a, b, 0) ==
            doctest::Approx(factorial(a) * factorial(b) / factorial(a + b + 2)).epsilon(100 * eps));
  CHECK(integral(mass_points(ElementType::wedge15), 0, 0, 4) == doctest::Approx(0.2).epsilon(100 * eps));
  CHECK(integral(mass_points(ElementType::hex20), 4, 2, 0) == doctest::Approx(8.0 / 15).epsilon(100 * eps));
  CHECK(integral(stiffness_points(ElementType::tet10), 2, 0, 0) == doctest::Approx(1.0 / 60).epsilon(100 * eps));
}

TEST_CASE("ShapeFunctions_OfABeamAreRefused") {
  CHECK_THROWS_AS((void)shape_functions(ElementType::beam2, Vector3::Zero()), ContractError);
}

}  // namespace shape_functions_test
}  // namespace hersey::fem
