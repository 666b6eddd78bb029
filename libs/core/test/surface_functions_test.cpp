#include "hersey/core/surface_functions.h"

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "hersey/core/contract.h"

namespace hersey {
namespace surface_functions_test {

constexpr double pi = std::numbers::pi;
constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double width = 0.02;  // m

const std::vector<std::array<int, 2>> sizes{{4, 1}, {5, 2}, {8, 3}, {12, 4}, {24, 7}};

/// All functions at a point, the zero ones too.
std::vector<SurfaceTerm> all_at(const SurfaceFunctions& functions, double phi, double z) {
  std::vector<SurfaceTerm> terms, all(static_cast<std::size_t>(functions.count()));
  functions.at(phi, z, terms);
  for (const SurfaceTerm& term : terms) {
    SurfaceTerm& sum = all[static_cast<std::size_t>(term.index)];
    sum.value += term.value;
    sum.by_phi += term.by_phi;
    sum.by_phi_phi += term.by_phi_phi;
  }
  return all;
}

TEST_CASE("SurfaceFunctions_AddUpToOne") {
  for (const auto& [around, along] : sizes) {
    const SurfaceFunctions functions(around, along, width);
    std::vector<SurfaceTerm> terms;
    for (int i = -30; i <= 60; ++i)
      for (int k = -12; k <= 12; ++k) {
        functions.at(0.217 * i, k * width / 20, terms);
        double sum = 0, slope = 0, curvature = 0;
        for (const SurfaceTerm& term : terms) {
          CHECK(term.index >= 0);
          CHECK(term.index < functions.count());
          CHECK(term.value >= 0);
          sum += term.value;
          slope += term.by_phi;
          curvature += term.by_phi_phi;
        }
        CHECK(std::abs(sum - 1) < 16 * eps);
        CHECK(std::abs(slope) < 64 * eps * around);
        CHECK(std::abs(curvature) < 64 * eps * around * around);
      }
  }
}

TEST_CASE("SurfaceFunctions_DerivativesMatchFiniteDifferences") {
  for (const auto& [around, along] : sizes) {
    const SurfaceFunctions functions(around, along, width);
    const double h = 1e-5, functions_per_rad = around / (2 * pi);
    for (const double phi : {-3.0, -0.01, 0.4, 2.0, 6.2})
      for (const double z : {-0.009, 0.0013, 0.0099}) {
        const std::vector<SurfaceTerm> here = all_at(functions, phi, z);
        const std::vector<SurfaceTerm> before = all_at(functions, phi - h, z), after = all_at(functions, phi + h, z);
        for (std::size_t j = 0; j < here.size(); ++j) {
          // Central differences of a cubic: h^2 / 6 times its third derivative, at most 3 functions_per_rad^3; of its
          // slope they are exact within a piece.
          const double error = h * h * functions_per_rad * functions_per_rad * functions_per_rad;
          CHECK(std::abs((after[j].value - before[j].value) / (2 * h) - here[j].by_phi) < error + 4 * eps / h);
          CHECK(std::abs((after[j].by_phi - before[j].by_phi) / (2 * h) - here[j].by_phi_phi) <
                h * functions_per_rad * functions_per_rad * functions_per_rad * 3 + 8 * functions_per_rad * eps / h);
        }
      }
  }
}

TEST_CASE("SurfaceFunctions_ArePeriodicAround_EndAtTheEdges") {
  const SurfaceFunctions functions(9, 5, width);
  for (const double z : {-0.008, 0.003}) {
    const std::vector<SurfaceTerm> here = all_at(functions, 1.3, z), a_turn_on = all_at(functions, 1.3 - 4 * pi, z);
    for (std::size_t j = 0; j < here.size(); ++j) CHECK(std::abs(here[j].value - a_turn_on[j].value) < 256 * eps);
  }
  const std::vector<SurfaceTerm> end = all_at(functions, 0.7, width / 2), beyond = all_at(functions, 0.7, 3 * width);
  for (std::size_t j = 0; j < end.size(); ++j) CHECK(end[j].value == beyond[j].value);
  // At its end a clamped spline has one function only.
  double last = 0;
  for (int i = 0; i < 9; ++i) last += end[static_cast<std::size_t>(4 * 9 + i)].value;
  CHECK(std::abs(last - 1) < 16 * eps);
}

TEST_CASE("SurfaceFunctions_PeakWhereTheyAreSaidTo") {
  const SurfaceFunctions functions(10, 1, width);
  for (int i = 0; i < 10; ++i) {
    const std::vector<SurfaceTerm> here = all_at(functions, 2 * pi * i / 10, 0);
    CHECK(std::abs(here[static_cast<std::size_t>(i)].value - 2.0 / 3) < 64 * eps);
    CHECK(std::abs(here[static_cast<std::size_t>(i)].by_phi) < 64 * eps * 10);
  }
}

/// Largest error of the spline that meets cos(phi) at its knots.
double error_of_cosine(int around) {
  const SurfaceFunctions functions(around, 1, width);
  const double h = 2 * pi / around, factor = 3 / (2 + std::cos(h));  // (c_{i-1} + 4 c_i + c_{i+1}) / 6 = cos(phi_i)
  double worst = 0;
  std::vector<SurfaceTerm> terms;
  for (int i = 0; i < 1000; ++i) {
    const double phi = 2 * pi * i / 1000;
    functions.at(phi, 0, terms);
    double value = 0;
    for (const SurfaceTerm& term : terms) value += term.value * factor * std::cos(h * term.index);
    worst = std::max(worst, std::abs(value - std::cos(phi)));
  }
  return worst;
}

TEST_CASE("Cosine_IsMetToFourthOrder") {
  const double coarse = error_of_cosine(12), fine = error_of_cosine(24), finest = error_of_cosine(48);
  CHECK(coarse < 1e-3);  // twelve arcs of 30 degrees, fourth order
  CHECK(std::log2(coarse / fine) == doctest::Approx(4).epsilon(0.05));
  CHECK(std::log2(fine / finest) == doctest::Approx(4).epsilon(0.05));
}

TEST_CASE("Polynomials_AlongAreMetExactlyUpToTheDegree") {
  // Coefficients of z are the Greville points: means of `degree` knots running.
  for (const int along : {2, 3, 4, 7}) {
    CAPTURE(along);
    const SurfaceFunctions functions(4, along, width);
    const int degree = std::min(3, along - 1), intervals = along - degree;
    for (const double z : {-0.01, -0.0071, 0.0, 0.0042, 0.01}) {
      std::vector<SurfaceTerm> terms;
      functions.at(1.1, z, terms);
      double value = 0;
      for (const SurfaceTerm& term : terms) {
        const int k = term.index / functions.around();
        double greville = 0;
        for (int r = 1; r <= degree; ++r) greville += std::clamp(k + r - degree, 0, intervals);
        value += term.value * (greville / (degree * intervals) - 0.5) * width;
      }
      CHECK(std::abs(value - z) < 32 * eps * width);
    }
  }
}

TEST_CASE("SurfaceFunctions_RefuseWhatTheyCannotBe") {
  CHECK_THROWS_AS(SurfaceFunctions(3, 2, width), ContractError);
  CHECK_THROWS_AS(SurfaceFunctions(8, 0, width), ContractError);
  CHECK_THROWS_AS(SurfaceFunctions(8, 2, 0), ContractError);
}

TEST_CASE("FunctionsOnAnArc_AddUpToOne_AndGoOnBeyondItsEnds") {
  const SurfaceArc arc{5.5, 1.3};  // across the angle 0
  for (const int around : {4, 5, 9}) {
    const SurfaceFunctions functions(around, 3, width, arc);
    for (int i = -40; i <= 40; ++i) {
      double sum = 0;
      for (const SurfaceTerm& term : all_at(functions, 0.157 * i, 0.3 * width)) {
        CHECK(term.value >= 0);
        sum += term.value;
      }
      CHECK(std::abs(sum - 1) < 16 * eps);
    }
    const auto at_end = all_at(functions, arc.from + arc.over, 0),
               beyond = all_at(functions, arc.from + arc.over + 0.5, 0);
    for (std::size_t j = 0; j < at_end.size(); ++j) {
      CHECK(std::abs(beyond[j].value - at_end[j].value) < 16 * eps);
      CHECK(beyond[j].by_phi == 0);
    }
  }
}

// Cubic polynomials of the angle are among them, with all derivatives.
TEST_CASE("FunctionsOnAnArc_MeetCubicsExactly") {
  const SurfaceArc arc{-0.4, 1.1};
  constexpr int around = 7;
  const SurfaceFunctions functions(around, 1, width, arc);
  const auto cubic_at = [&](double phi) { return phi * phi * phi - 0.3 * phi * phi + 2 * phi - 1; };
  Eigen::MatrixXd A(4 * around, around);
  Eigen::VectorXd b(A.rows());
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    const double phi = arc.from + arc.over * static_cast<double>(i) / static_cast<double>(A.rows() - 1);
    const auto all = all_at(functions, phi, 0);
    for (Eigen::Index j = 0; j < around; ++j) A(i, j) = all[static_cast<std::size_t>(j)].value;
    b[i] = cubic_at(phi);
  }
  const Eigen::VectorXd c = A.colPivHouseholderQr().solve(b);
  constexpr double round_off_of_fit = 1e-10;  // condition of the fit and two derivatives
  for (const double phi : {-0.35, 0.0, 0.21, 0.65}) {
    double value = 0, slope = 0, curvature = 0;
    const auto all = all_at(functions, phi, 0);
    for (Eigen::Index j = 0; j < around; ++j) {
      const SurfaceTerm& term = all[static_cast<std::size_t>(j)];
      value += c[j] * term.value, slope += c[j] * term.by_phi, curvature += c[j] * term.by_phi_phi;
    }
    CHECK(std::abs(value - cubic_at(phi)) < round_off_of_fit);
    CHECK(std::abs(slope - (3 * phi * phi - 0.6 * phi + 2)) < round_off_of_fit);
    CHECK(std::abs(curvature - (6 * phi - 0.6)) < round_off_of_fit);
  }
}

}  // namespace surface_functions_test
}  // namespace hersey
