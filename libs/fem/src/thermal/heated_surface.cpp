#include "hersey/fem/heated_surface.h"

#include <algorithm>
#include <cmath>

#include "hersey/core/contract.h"
#include "hersey/core/two_pi.h"
#include "hersey/fem/constrained_stiffness.h"
#include "hersey/fem/thermal_expansion.h"
#include "hersey/fem/ties.h"
#include "surface/film_coordinates.h"
#include "surface/film_quadrature.h"

namespace hersey::fem {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index sources_at_once = 48;  // displacements kept: all of them would take a gigabyte on a large mesh

/// The two angles between which one lies, and the share of the way from the first to the second.
struct Between {
  Index first = 0, second = 0;
  double share = 0;
};

Between between(const std::vector<double>& angles, double phi) {
  const auto n = static_cast<Index>(angles.size());
  const double at = angles.front() + std::fmod(std::fmod(phi - angles.front(), two_pi) + two_pi, two_pi);
  const auto after = std::upper_bound(angles.begin(), angles.end(), at);
  const Index second = after - angles.begin();
  const double from = angles[static_cast<std::size_t>(second - 1)];
  const double to = second < n ? *after : angles.front() + two_pi;
  return {second - 1, second % n, (at - from) / (to - from)};
}

/// Pieces of a face's edges, at least three to the distance of two angles.
int pieces_of(const Mesh& mesh, const FilmSurface& surface, const std::vector<double>& angles) {
  const Pose to_cylinder = surface.cylinder.X.inverse();
  double widest = 0, finest = angles.front() + two_pi - angles.back();
  for (const ElementFace face : surface.faces) {
    const CylinderBox box = cylinder_box(mesh, face, to_cylinder);
    widest = std::max(widest, box.phi_high - box.phi_low);
  }
  for (std::size_t i = 1; i < angles.size(); ++i) finest = std::min(finest, angles[i] - angles[i - 1]);
  constexpr double per_distance = 3, most = 24;
  return static_cast<int>(std::clamp(std::ceil(per_distance * widest / finest), 2.0, most));
}

/// Heat into the nodes of a unit of it into each angle, (nodes, angles); its transpose takes means of temperatures.
MatrixXd heat_of_angles(const Mesh& mesh, const FilmSurface& surface, const std::vector<double>& angles) {
  MatrixXd P = MatrixXd::Zero(static_cast<Index>(mesh.nodes.size()), static_cast<Index>(angles.size()));
  const int pieces = pieces_of(mesh, surface, angles);
  for (const ElementFace face : surface.faces)
    visit_film_points(mesh, face, surface.cylinder, pieces, [&](const FilmPoint& point) {
      const Between at = between(angles, point.phi);
      const double area = std::abs(point.area);
      for (std::size_t a = 0; a < point.nodes.size(); ++a) {
        const double share = area * point.N[static_cast<Index>(a)];
        P(point.nodes[a], at.first) += (1 - at.share) * share;
        P(point.nodes[a], at.second) += at.share * share;
      }
    });
  const Eigen::RowVectorXd areas = P.colwise().sum();  // the shape functions add up to one
  HERSEY_REQUIRE((areas.array() > 0).all(), "a surface all around the film");
  return P * areas.cwiseInverse().asDiagonal();
}

/// Returns the same for a unit of heat that is spread evenly over all of the surface (thermal.59).
MatrixXd even_heat(const Mesh& mesh, const FilmSurface& surface) {
  constexpr int pieces = 2;  // its quadrature is exact for the polynomials of a face
  MatrixXd P = MatrixXd::Zero(static_cast<Index>(mesh.nodes.size()), 1);
  for (const ElementFace face : surface.faces)
    visit_film_points(mesh, face, surface.cylinder, pieces, [&](const FilmPoint& point) {
      for (std::size_t a = 0; a < point.nodes.size(); ++a)
        P(point.nodes[a], 0) += std::abs(point.area) * point.N[static_cast<Index>(a)];
    });
  return P / P.sum();
}

/// Subtracts from a radial displacement in the surface's functions its rigid motion: across the axis and tilted against
/// it.
MatrixXd without_rigid_motion(const FilmSurface& surface, const Mesh& mesh, const MatrixXd& shapes) {
  const Pose& X = surface.cylinder.X;
  MatrixXd U(3 * static_cast<Index>(mesh.nodes.size()), 4);
  for (Index a = 0; a < U.rows() / 3; ++a)
    for (int axis = 0; axis < 2; ++axis) {
      const Vector3 e = X.R.col(axis);
      U.col(axis).segment<3>(3 * a) = e;
      U.col(2 + axis).segment<3>(3 * a) = e.cross(mesh.nodes[static_cast<std::size_t>(a)] - X.r) / surface.cylinder.L;
    }
  const MatrixXd rigid = surface.coefficients(U);
  const MatrixXd weighed = surface.G * rigid;
  return shapes - rigid * (rigid.transpose() * weighed).ldlt().solve(weighed.transpose() * shapes);
}

}  // namespace

std::vector<int> statically_determinate(const Mesh& mesh) {
  const auto farthest = [&](const auto& distance) {
    int best = 0;
    double most = -1;
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
      if (const double d = distance(mesh.nodes[a]); d > most) most = d, best = static_cast<int>(a);
    return best;
  };
  const Vector3 first = mesh.nodes.front();
  const int a = farthest([&](const Vector3& x) { return (x - first).norm(); });
  const Vector3 A = mesh.nodes[static_cast<std::size_t>(a)];
  const int b = farthest([&](const Vector3& x) { return (x - A).norm(); });
  const Vector3 along = (mesh.nodes[static_cast<std::size_t>(b)] - A).normalized();
  const int c = farthest([&](const Vector3& x) { return (x - A).cross(along).norm(); });
  const std::vector<int> dofs = dofs_of({a, b, c});
  // The six degrees of freedom that determine the rigid motions best.
  MatrixXd motions = rigid_motions(mesh, A);
  motions.leftCols<3>() /= (mesh.nodes[static_cast<std::size_t>(b)] - A).norm();
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(MatrixXd(motions(dofs, Eigen::all)).transpose());
  std::vector<int> fixed_dofs;
  fixed_dofs.reserve(6);
  for (int i = 0; i < 6; ++i) fixed_dofs.push_back(dofs[static_cast<std::size_t>(qr.colsPermutation().indices()[i])]);
  return fixed_dofs;
}

// All functions of a spline around have the same mean; as many equally spaced points, at any angle, give it exactly.
MatrixXd mean_around(const SurfaceFunctions& functions, const MatrixXd& shapes, const std::vector<double>& z) {
  HERSEY_REQUIRE(shapes.rows() == functions.count(), "shapes in the functions of this surface");
  MatrixXd mean = MatrixXd::Zero(static_cast<Index>(z.size()), shapes.cols());
  std::vector<SurfaceTerm> terms;
  for (std::size_t j = 0; j < z.size(); ++j)
    for (int i = 0; i < functions.around(); ++i) {
      functions.at(two_pi * i / functions.around(), z[j], terms);
      for (const SurfaceTerm& term : terms)
        mean.row(static_cast<Index>(j)) += term.value / functions.around() * shapes.row(term.index);
    }
  return mean;
}

HeatedSurface heated_surface(const ElasticBody& body, const std::vector<ThermalMaterial>& thermal,
                             const ThermalSurroundings& surroundings, const FilmSurface& surface,
                             const HeatedSurfaceOptions& options) {
  HERSEY_REQUIRE(options.angles.empty() || options.angles.size() >= 3, "angles around the film");
  HeatConduction conduction(body.mesh, thermal, surroundings, body.integration);
  if (const solver::FactorSummary summary = conduction.factorise(); !summary.solved())
    return no_answer<HeatedSurface>(summary.message);
  const MatrixXd P =
      options.angles.empty() ? even_heat(body.mesh, surface) : heat_of_angles(body.mesh, surface, options.angles);
  HeatedSurface result;
  result.set_solved(true);
  result.T_body0 = conduction.temperatures(VectorXd::Zero(P.rows()));
  result.rise_body = conduction.rises(P);
  result.T0 = P.transpose() * result.T_body0;
  result.rise = P.transpose() * result.rise_body;
  if (!options.expands) return result;
  MatrixXd rises(P.rows(), P.cols() + 2);
  rises << result.rise_body, result.T_body0.array() - options.T_reference, VectorXd::Ones(P.rows());
  const std::vector<int> fixed_dofs =
      options.fixed_dofs.empty() ? statically_determinate(body.mesh) : options.fixed_dofs;
  ConstrainedStiffness stiffness(body.K, body.m, fixed_dofs, tie_constraints(body.mesh, fixed_dofs).C);
  const solver::FactorSummary summary = stiffness.factorise();
  if (summary.status == solver::FactorStatus::singular)
    return no_answer<HeatedSurface>("the supports of the expanding body leave it a rigid motion");
  if (!summary.solved()) return no_answer<HeatedSurface>(summary.message);
  MatrixXd shapes(surface.functions.count(), rises.cols());
  for (Index first = 0; first < rises.cols(); first += sources_at_once) {
    const Index columns = std::min(sources_at_once, rises.cols() - first);
    shapes.middleCols(first, columns) =
        surface.coefficients(stiffness.solve(expansion_load(body, thermal, rises.middleCols(first, columns))));
  }
  shapes = without_rigid_motion(surface, body.mesh, shapes);
  result.shape_by_heat = shapes.leftCols(P.cols());
  result.shape0 = shapes.col(P.cols());
  result.shape_by_rise = shapes.col(P.cols() + 1);
  return result;
}

}  // namespace hersey::fem
