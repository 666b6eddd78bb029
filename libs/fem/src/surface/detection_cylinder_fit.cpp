#include "surface/detection_cylinder_fit.h"

#include <Eigen/Dense>
#include <cmath>

namespace hersey::fem {
namespace {

constexpr int kMostSteps = 40;
constexpr double kSettled =
    1e-9;  // of the points' extent: near the end each step squares the error, so this was the last

using Eigen::Index;

/// Columns of two unit vectors square to `axis` and each other.
Eigen::Matrix<double, 3, 2> across(const Vector3& axis) {
  Index smallest = 0;
  axis.cwiseAbs().minCoeff(&smallest);
  const Vector3 first = axis.cross(Vector3::Unit(smallest)).normalized();
  Eigen::Matrix<double, 3, 2> columns;
  columns << first, axis.cross(first);
  return columns;
}

/// x^2 + y^2 = 2 a x + 2 b y + c in least squares (Kasa): begins the iteration.
CylinderFit circle_along(const std::vector<Vector3>& points, const Vector3& mean, const Vector3& axis) {
  const Eigen::Matrix<double, 3, 2> e = across(axis);
  Eigen::MatrixXd A(static_cast<Index>(points.size()), 3);
  Eigen::VectorXd b(A.rows());
  for (Index k = 0; k < A.rows(); ++k) {
    const Eigen::Vector2d x = e.transpose() * (points[static_cast<std::size_t>(k)] - mean);
    A.row(k) << 2 * x.x(), 2 * x.y(), 1;
    b[k] = x.squaredNorm();
  }
  const Eigen::Vector3d abc = A.colPivHouseholderQr().solve(b);
  return {mean + e * abc.head<2>(), axis, std::sqrt(abc[2] + abc.head<2>().squaredNorm())};
}

/// Moves and tilts the axis and changes the radius by one step. @returns its size [m]
double step(const std::vector<Vector3>& points, double extent, CylinderFit& fit) {
  const Eigen::Matrix<double, 3, 2> e = across(fit.axis);
  Eigen::MatrixXd J(static_cast<Index>(points.size()), 5);
  Eigen::VectorXd r(J.rows());
  for (Index k = 0; k < J.rows(); ++k) {
    const Vector3& x = points[static_cast<std::size_t>(k)];
    const Eigen::Vector2d out = e.transpose() * fit.from_axis(x);
    const double distance = out.norm(), along = fit.axis.dot(x - fit.point) / extent;
    const Eigen::Vector2d n = out / distance;
    // d distance by the axis' motion and by its tilt, an angle times the extent; d radius.
    J.row(k) << -n.x(), -n.y(), -n.x() * along, -n.y() * along, -1;
    r[k] = distance - fit.radius;
  }
  const Eigen::Matrix<double, 5, 1> change = -J.colPivHouseholderQr().solve(r);
  fit.point += e * change.head<2>();
  fit.axis = (fit.axis + e * change.segment<2>(2) / extent).normalized();
  fit.radius += change[4];
  return change.norm();
}

}  // namespace

std::optional<CylinderFit> fit_cylinder(const std::vector<Vector3>& points, const Vector3& axis,
                                        double largest_radius) {
  if (points.size() < 6) return std::nullopt;
  Vector3 mean = Vector3::Zero();
  for (const Vector3& x : points) mean += x / static_cast<double>(points.size());
  double extent = 0;
  for (const Vector3& x : points) extent = std::max(extent, (x - mean).norm());
  CylinderFit fit = circle_along(points, mean, axis);
  for (int k = 0; k < kMostSteps; ++k) {
    if (!(fit.radius > 0 && fit.radius <= largest_radius)) return std::nullopt;
    const double size = step(points, extent, fit);
    fit.point += fit.axis.dot(mean - fit.point) * fit.axis;
    if (!(size > kSettled * extent))  // also of a step that is not a number, which the radius shows
      return fit.radius > 0 && fit.radius <= largest_radius ? std::optional(fit) : std::nullopt;
  }
  return std::nullopt;
}

}  // namespace hersey::fem
