#include "hersey/fem/film_radii.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hersey/core/two_pi.h"
#include "surface/film_coordinates.h"
#include "surface/film_quadrature.h"

namespace hersey::fem {
namespace {

using Eigen::Index;

Index column_of(double phi) {
  const auto i = static_cast<Index>(std::floor(phi / two_pi * SurfaceRadii::around));
  return (i % SurfaceRadii::around + SurfaceRadii::around) % SurfaceRadii::around;
}

Index row_of(double z, double width) {
  const double share = std::clamp(z / width + 0.5, 0.0, 1.0);
  return std::min(static_cast<Index>(share * SurfaceRadii::along), Index{SurfaceRadii::along - 1});
}

/// Pieces of each edge, so that every field under a face gets a point.
int parts_of(const Mesh& mesh, ElementFace face, const FilmCylinder& cylinder) {
  const CylinderBox box = cylinder_box(mesh, face, cylinder.X.inverse());
  const double fields = std::max((box.phi_high - box.phi_low) / two_pi * SurfaceRadii::around,
                                 (box.z_high - box.z_low) / cylinder.L * SurfaceRadii::along);
  return std::clamp(static_cast<int>(std::ceil(fields)), 2, 24);
}

/// Fills fields without a point (an oil hole) with the value of the nearest field around, or zero if there is none.
void fill_holes(Eigen::MatrixXd& deviation) {
  const Eigen::MatrixXd found = deviation;
  for (Index k = 0; k < found.cols(); ++k)
    for (Index i = 0; i < found.rows(); ++i) {
      if (!std::isnan(found(i, k))) continue;
      deviation(i, k) = 0;
      for (Index away = 1; away <= found.rows() / 2; ++away) {
        const double ahead = found((i + away) % found.rows(), k);
        const double behind = found((i - away + found.rows()) % found.rows(), k);
        if (std::isnan(ahead) && std::isnan(behind)) continue;
        deviation(i, k) = std::isnan(ahead) ? behind : ahead;
        break;
      }
    }
}

}  // namespace

double SurfaceRadii::phi_of(int i) { return (i + 0.5) * two_pi / around; }

double SurfaceRadii::at(double phi, double z) const { return deviation(column_of(phi), row_of(z, width)); }

SurfaceRadii surface_radii(const Mesh& mesh, const FilmSurface& surface) {
  const FilmCylinder& cylinder = surface.cylinder;
  const Pose to_cylinder = cylinder.X.inverse();
  SurfaceRadii radii;
  radii.width = cylinder.L;
  radii.deviation.setConstant(SurfaceRadii::around, SurfaceRadii::along, std::numeric_limits<double>::quiet_NaN());
  double area = 0, sum = 0;
  for (const ElementFace face : surface.faces)
    visit_film_points(mesh, face, cylinder, parts_of(mesh, face, cylinder), [&](const FilmPoint& point) {
      double deviation = 0;
      for (std::size_t a = 0; a < point.nodes.size(); ++a) {
        const Vector3& node = mesh.nodes[static_cast<std::size_t>(point.nodes[a])];
        deviation += point.N[static_cast<Index>(a)] * (cylinder_point(to_cylinder * node).radius - cylinder.R);
      }
      area += std::abs(point.area);
      sum += std::abs(point.area) * deviation;
      double& field = radii.deviation(column_of(point.phi), row_of(point.z, cylinder.L));
      const bool is_worse = cylinder.is_bore ? deviation < field : deviation > field;
      if (std::isnan(field) || is_worse) field = deviation;
    });
  radii.mean = area > 0 ? sum / area : 0;
  fill_holes(radii.deviation);
  return radii;
}

}  // namespace hersey::fem
