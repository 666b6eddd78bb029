#include "hersey/film/body_wall.h"

#include "hersey/core/two_pi.h"
#include "hersey/film/grid_transfer.h"

namespace hersey::film {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd at_nodes(const GridTransfer& transfer, const MatrixXd& fields) {
  MatrixXd result;
  for (Index k = 0; k < fields.cols(); ++k) {
    const VectorXd field = transfer(fields.col(k));
    if (k == 0) result.resize(field.size(), fields.cols());
    result.col(k) = field;
  }
  return result;
}

/// Returns half of the distances to both neighbours.
VectorXd widths(const Grid& grid) {
  VectorXd width(grid.n_phi);
  for (int i = 0; i < grid.n_phi; ++i) {
    const double before = i > 0 ? grid.phi(i - 1) : grid.phi(grid.n_phi - 1) - two_pi;
    const double after = i + 1 < grid.n_phi ? grid.phi(i + 1) : grid.phi(0) + two_pi;
    width[i] = (after - before) / 2;
  }
  return width;
}

}  // namespace

WallConduction on_grid(const WallConduction& wall, const Grid& from, const Grid& to) {
  // An angle of the coarser grid is a mean of the finer ones, and its heat is distributed to them by the same weights.
  const MatrixXd lines = GridTransfer::by_position(to, from).around(MatrixXd::Identity(to.n_phi, to.n_phi));
  MatrixXd means = lines.transpose() * widths(from).asDiagonal();
  means = (means.rowwise().sum().cwiseInverse().asDiagonal() * means).eval();
  WallConduction result = wall;
  result.T0 = means * wall.T0;
  result.rise = means * wall.rise * means.transpose();
  if (wall.rise_body.size() > 0) result.rise_body = wall.rise_body * means.transpose();
  if (!wall.deforms()) return result;
  const GridTransfer transfer = GridTransfer::by_position(from, to);
  result.shape0 = transfer(wall.shape0);
  result.shape_by_heat = at_nodes(transfer, wall.shape_by_heat * means.transpose());
  result.shape_by_rise = transfer(wall.shape_by_rise);
  return result;
}

}  // namespace hersey::film
