#include "hersey/fem/face_pressures.h"

#include <array>
#include <cmath>

#include "hersey/core/contract.h"
#include "surface/face_quadrature.h"
#include "surface/film_quadrature.h"

namespace hersey::fem {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double most_for_the_axis = 0.01;  // change of a face's pressure for the sake of the wrench along the axis
constexpr int pieces_of_a_face = 4;         // along each of its edges: a film's grid may be finer than the mesh

}  // namespace

FacePressures::FacePressures(const Mesh& mesh, const std::vector<ElementFace>& faces, const FilmCylinder& cylinder)
    : R_(cylinder.R) {
  const auto count = static_cast<Index>(faces.size());
  areas_.setZero(count), within_.setZero(count), wrenches_.setZero(6, count);
  const Pose to_film = cylinder.X.inverse();
  for (Index f = 0; f < count; ++f) {
    const ElementFace& face = faces[static_cast<std::size_t>(f)];
    visit_face(mesh, face, [&](const std::vector<int>&, const FacePoint& point) {
      const Vector3 x = to_film * point.x, push = -point.area * (to_film.R * point.normal);
      areas_[f] += point.area;
      wrenches_.col(f).head<3>() += x.cross(push);
      wrenches_.col(f).tail<3>() += push;
    });
    visit_film_points(mesh, face, cylinder, pieces_of_a_face, [&](const FilmPoint& point) {
      points_.push_back({f, point.phi, point.z, std::abs(point.area)});
      within_[f] += std::abs(point.area);
    });
  }
  HERSEY_REQUIRE(count == 0 || areas_.minCoeff() > 0, "faces have an area");
}

VectorXd FacePressures::integrals(const FilmField& field) const {
  VectorXd sums = VectorXd::Zero(areas_.size());
  for (const Point& point : points_) sums[point.face] += point.area * field(point.phi, point.z);
  return sums;
}

VectorXd FacePressures::means(const FilmField& field) const { return integrals(field).cwiseQuotient(areas_); }

VectorXd FacePressures::means_within(const FilmField& field) const { return integrals(field).cwiseQuotient(within_); }

// Moments are taken over R, so that all rows are areas. Rows along and about the axis come last: even faces have none.
VectorXd FacePressures::with_wrench(const VectorXd& pressures, const Vector6& wrench) const {
  HERSEY_REQUIRE(pressures.size() == areas_.size(), "a pressure for each face");
  constexpr std::array<Index, 6> order{0, 1, 3, 4, 2, 5};
  const Vector6 missing = wrench - wrenches_ * pressures;
  Eigen::Matrix<double, 6, Eigen::Dynamic> W(6, areas_.size());
  Vector6 r;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const double lever = order[k] < 3 ? R_ : 1;
    W.row(static_cast<Index>(k)) = wrenches_.row(order[k]) / lever;
    r[static_cast<Index>(k)] = missing[order[k]] / lever;
  }
  const VectorXd weights = pressures.cwiseAbs().cwiseQuotient(areas_);
  const auto corrected = [&](Index rows, const VectorXd& r_of_rows) -> VectorXd {
    const Eigen::MatrixXd on = W.topRows(rows), S = on * weights.asDiagonal() * on.transpose();
    const VectorXd lambda = S.completeOrthogonalDecomposition().solve(r_of_rows);
    return pressures + weights.cwiseProduct(on.transpose() * lambda);
  };
  const VectorXd across = corrected(4, r.head<4>()), all = corrected(6, r);
  const double most = (most_for_the_axis * pressures.cwiseAbs() - (all - across).cwiseAbs()).minCoeff();
  return most >= 0 ? all : across;
}

}  // namespace hersey::fem
