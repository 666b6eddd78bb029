#include "hersey/fem/film_pressure.h"

#include <cmath>

#include "hersey/core/contract.h"
#include "hersey/fem/load_distributions.h"
#include "surface/film_coordinates.h"

namespace hersey::fem {

using Eigen::Index;
using Eigen::VectorXd;

SurfacePressure::SurfacePressure(const Mesh& mesh, const FilmSurface& surface)
    : functions_(surface.functions), G_(surface.G) {
  const Pose to_cylinder = surface.cylinder.X.inverse();
  const double edge = surface.cylinder.L / 2 * (1 + 1e-6);  // round-off of the mesh file's numbers
  std::vector<CylinderPoint> points;
  for (const int node : nodes_on(mesh, surface.faces)) {
    const CylinderPoint point = cylinder_point(to_cylinder * mesh.nodes[static_cast<std::size_t>(node)]);
    if (std::abs(point.z) > edge) continue;
    nodes_.push_back(node);
    points.push_back(point);
  }
  psi_.setZero(static_cast<Index>(nodes_.size()), functions_.count());
  std::vector<SurfaceTerm> terms;
  for (std::size_t i = 0; i < points.size(); ++i) {
    functions_.at(points[i].phi, points[i].z, terms);
    for (const SurfaceTerm& term : terms) psi_(static_cast<Index>(i), term.index) = term.value;
  }
}

VectorXd SurfacePressure::coefficients(const VectorXd& phi, const VectorXd& z, const VectorXd& forces) const {
  HERSEY_REQUIRE(phi.size() == forces.size() && z.size() == forces.size(), "a position for each force");
  VectorXd sums = VectorXd::Zero(functions_.count());
  std::vector<SurfaceTerm> terms;
  for (Index k = 0; k < forces.size(); ++k) {
    functions_.at(phi[k], z[k], terms);
    for (const SurfaceTerm& term : terms) sums[term.index] += term.value * forces[k];
  }
  return G_.solve(sums);
}

void SurfacePressure::add(const VectorXd& coefficients, VectorXd& at_nodes) const {
  const VectorXd pressure = psi_ * coefficients;
  for (std::size_t i = 0; i < nodes_.size(); ++i) at_nodes[nodes_[i]] += pressure[static_cast<Index>(i)];
}

}  // namespace hersey::fem
