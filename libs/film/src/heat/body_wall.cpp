#include "hersey/film/body_wall.h"

#include <Eigen/SparseCore>
#include <algorithm>
#include <vector>

#include "hersey/core/turn.h"

namespace hersey::film {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Triplet;
using Eigen::VectorXd;
using Weights = Eigen::SparseMatrix<double>;

/// Straight lines between values at the angles of one grid, at those of another, (to, from).
Weights around(const Grid& from, const Grid& to) {
  std::vector<Triplet<double>> entries;
  const auto phi = [&](int k) { return from.phi(k % from.n_phi) + (k < from.n_phi ? 0 : turn); };
  for (int i = 0; i < to.n_phi; ++i) {
    const double at = to.phi(i) < phi(0) ? to.phi(i) + turn : to.phi(i);
    int k = 0;
    while (k + 1 < from.n_phi && phi(k + 1) <= at) ++k;
    const double share = (at - phi(k)) / (phi(k + 1) - phi(k));
    entries.emplace_back(i, k, 1 - share);
    entries.emplace_back(i, (k + 1) % from.n_phi, share);
  }
  Weights weights(to.n_phi, from.n_phi);
  weights.setFromTriplets(entries.begin(), entries.end());
  return weights;
}

/// The same at the nodes, (to, from).
Weights at_nodes(const Grid& from, const Grid& to) {
  std::vector<Triplet<double>> entries;
  const Weights by_angle = around(from, to);
  for (int j = 0; j < to.n_z; ++j) {
    int k = 0;
    while (k + 2 < from.n_z && from.z_over_L(k + 1) <= to.z_over_L(j)) ++k;
    const double share = (to.z_over_L(j) - from.z_over_L(k)) / (from.z_over_L(k + 1) - from.z_over_L(k));
    for (Index column = 0; column < by_angle.outerSize(); ++column)
      for (Weights::InnerIterator entry(by_angle, column); entry; ++entry) {
        const int i = static_cast<int>(entry.row()), i_from = static_cast<int>(column);
        entries.emplace_back(to.index(i, j), from.index(i_from, k), entry.value() * (1 - share));
        entries.emplace_back(to.index(i, j), from.index(i_from, k + 1), entry.value() * share);
      }
  }
  Weights weights(to.size(), from.size());
  weights.setFromTriplets(entries.begin(), entries.end());
  return weights;
}

/// Half of the distances to both neighbours.
VectorXd widths(const Grid& grid) {
  VectorXd width(grid.n_phi);
  for (int i = 0; i < grid.n_phi; ++i) {
    const double before = i > 0 ? grid.phi(i - 1) : grid.phi(grid.n_phi - 1) - turn;
    const double after = i + 1 < grid.n_phi ? grid.phi(i + 1) : grid.phi(0) + turn;
    width[i] = (after - before) / 2;
  }
  return width;
}

}  // namespace

WallConduction on_grid(const WallConduction& wall, const Grid& from, const Grid& to) {
  // An angle of the coarser grid is a mean of the finer ones, and its heat goes into them by the same weights.
  const Weights lines = around(to, from);
  MatrixXd means = MatrixXd(lines).transpose() * widths(from).asDiagonal();
  means = (means.rowwise().sum().cwiseInverse().asDiagonal() * means).eval();
  WallConduction result = wall;
  result.T0 = means * wall.T0;
  result.rise = means * wall.rise * means.transpose();
  if (wall.rise_body.size() > 0) result.rise_body = wall.rise_body * means.transpose();
  if (!wall.deforms()) return result;
  const Weights nodes = at_nodes(from, to);
  result.shape0 = nodes * wall.shape0;
  result.shape_by_heat = nodes * wall.shape_by_heat * means.transpose();
  result.shape_by_rise = nodes * wall.shape_by_rise;
  return result;
}

}  // namespace hersey::film
