// Static shapes that a loaded surface needs beside the vibration modes.
#include "reduction/static_error.h"

#include <algorithm>
#include <cmath>

namespace hersey::fem {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The part of the static displacements under a surface's pressures that the kept shapes do not represent.
struct Missing {
  const LoadedSurface* surface;
  MatrixXd residual;  ///< (3 n, shapes)
  double size;        ///< norm of the largest of these displacements, on the surface
};

VectorXd sizes_on(const LoadedSurface& surface, const MatrixXd& u) {
  VectorXd squares = VectorXd::Zero(u.cols());
  for (std::size_t i = 0; i < surface.nodes.size(); ++i)
    squares += surface.areas[i] * u.middleRows<3>(3 * surface.nodes[i]).colwise().squaredNorm().transpose();
  return squares.cwiseSqrt();
}

/// Errors of all shapes; none where frames fix the whole surface.
VectorXd errors_of(const Missing& missing) {
  const VectorXd sizes = sizes_on(*missing.surface, missing.residual);
  if (!(missing.size > 0)) return VectorXd::Zero(sizes.size());
  return sizes / missing.size;
}

double largest_error(const Missing& missing) { return errors_of(missing).maxCoeff(); }

}  // namespace

StaticShapes static_shapes(const ConstrainedStiffness& stiffness, const Vibration& modes,
                           const ReductionOptions& options) {
  StaticShapes result{.added = MatrixXd(stiffness.size(), 0), .errors = {}};
  std::vector<Missing> all;
  all.reserve(options.surfaces.size());
  const VectorXd flexibility = modes.omega.cwiseAbs2().cwiseInverse();
  for (const LoadedSurface& surface : options.surfaces) {
    MatrixXd u = stiffness.solve(surface.loads);
    const double size = sizes_on(surface, u).maxCoeff();
    u -= modes.shapes * (flexibility.asDiagonal() * (modes.shapes.transpose() * surface.loads));
    all.push_back({&surface, std::move(u), size});
    const double error = largest_error(all.back());
    result.errors.push_back({surface.name, static_cast<int>(surface.loads.cols()), error, error});
  }
  for (;;) {
    const auto worst = std::max_element(
        all.begin(), all.end(), [](const Missing& a, const Missing& b) { return largest_error(a) < largest_error(b); });
    if (worst == all.end() || !(largest_error(*worst) > options.static_error)) break;
    Index k = 0;
    errors_of(*worst).maxCoeff(&k);
    // The missing part is K-orthogonal to all shapes: its energy is the work of its load.
    const double energy = worst->residual.col(k).dot(worst->surface->loads.col(k));
    if (!(energy > 0)) break;
    const VectorXd v = worst->residual.col(k) / std::sqrt(energy);
    result.added.conservativeResize(Eigen::NoChange, result.added.cols() + 1);
    result.added.rightCols<1>() = v;
    for (Missing& missing : all) missing.residual -= v * (v.transpose() * missing.surface->loads);
  }
  for (std::size_t i = 0; i < all.size(); ++i) result.errors[i].reduced = largest_error(all[i]);
  return result;
}

}  // namespace hersey::fem
