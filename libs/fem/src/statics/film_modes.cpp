#include "hersey/fem/film_modes.h"

#include <algorithm>

#include "hersey/core/contract.h"

namespace hersey::fem {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index at_once = 48;  // solutions kept: all of them would take a gigabyte on a large mesh

}  // namespace

MatrixXd SurfaceMap::coefficients(const MatrixXd& U) const { return G.llt().solve(T.transpose() * U); }

MatrixXd SurfaceMap::compliance(const ConstrainedStiffness& stiffness) const {
  const Index count = T.cols();
  MatrixXd C(count, count);
  for (Index first = 0; first < count; first += at_once) {
    const Index columns = std::min(at_once, count - first);
    C.middleCols(first, columns) = T.transpose() * stiffness.solve(MatrixXd(T.middleCols(first, columns)));
  }
  return (C + C.transpose()) / 2;
}

FilmModes film_modes(const ConstrainedStiffness& stiffness, const SurfaceMap& surface, int most, double tolerance) {
  HERSEY_REQUIRE(most >= 0 && tolerance > 0 && tolerance < 1, "a number of modes and a share of the largest");
  HERSEY_REQUIRE(stiffness.size() == surface.T.rows(), "the surface is one of this body");
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(surface.compliance(stiffness), surface.G);
  const Eigen::VectorXd lambda = eigen.eigenvalues().reverse();
  FilmModes modes;
  const double largest = lambda[0];
  const Index above = largest > 0 ? (lambda.array() > tolerance * largest).count() : 0;
  const Index kept = std::min<Index>(above, most);
  modes.compliance = lambda.head(kept);
  modes.pressures = eigen.eigenvectors().rightCols(kept).rowwise().reverse();
  modes.loads = surface.T * modes.pressures;
  modes.shapes = stiffness.solve(modes.loads);
  if (kept < lambda.size() && largest > 0) modes.lost = std::max(0.0, lambda[kept]) / largest;
  return modes;
}

}  // namespace hersey::fem
