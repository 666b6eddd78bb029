#include "hersey/film/grid_transfer.h"

#include <algorithm>

#include "hersey/core/contract.h"
#include "hersey/core/two_pi.h"

namespace hersey::film {
namespace {

// Fewer nodes resolve no front (around) and no parabola (across).
constexpr int fewest_around = 24, fewest_across = 7;

}  // namespace

Grid half_of(const Grid& grid) {
  return resampled(grid, (grid.n_phi + 1) / 2, grid.n_z < fewest_across ? grid.n_z : grid.n_z / 2 + 1);
}

bool can_be_coarsened(const Grid& grid) { return grid.closes() && half_of(grid).n_phi >= fewest_around; }

GridTransfer::GridTransfer(const Grid& from, const Grid& to) : GridTransfer(from) {
  HERSEY_REQUIRE(from.closes() && to.closes(), "between rings");
  around_.reserve(static_cast<std::size_t>(to.n_phi));
  along_.reserve(static_cast<std::size_t>(to.n_z));
  for (int i = 0; i < to.n_phi; ++i) {
    const double at = static_cast<double>(i) * from.n_phi / to.n_phi;
    const int node = static_cast<int>(at);
    around_.push_back({node, (node + 1) % from.n_phi, at - node});
  }
  for (int j = 0; j < to.n_z; ++j) {
    const double at = static_cast<double>(j) * (from.n_z - 1) / (to.n_z - 1);
    const int node = std::min(static_cast<int>(at), from.n_z - 2);
    along_.push_back({node, node + 1, at - node});
  }
}

void GridTransfer::lay_around_ring(const Grid& from, const Grid& to) {
  const auto phi = [&](int k) { return from.phi(k % from.n_phi) + (k < from.n_phi ? 0 : two_pi); };
  for (int i = 0; i < to.n_phi; ++i) {
    const double at = to.phi(i) < phi(0) ? to.phi(i) + two_pi : to.phi(i);
    int k = 0;
    while (k + 1 < from.n_phi && phi(k + 1) <= at) ++k;
    around_.push_back({k, (k + 1) % from.n_phi, (at - phi(k)) / (phi(k + 1) - phi(k))});
  }
}

void GridTransfer::lay_around_patches(const Grid& from, const Grid& to) {
  for (int i = 0; i < to.n_phi; ++i) {
    int k = from.patches[static_cast<std::size_t>(to.patch_of(i))];
    while (from.next(k + 1) >= 0 && from.phi(k + 1) <= to.phi(i)) ++k;
    around_.push_back({k, k + 1, (to.phi(i) - from.phi(k)) / (from.phi(k + 1) - from.phi(k))});
  }
}

GridTransfer GridTransfer::by_position(const Grid& from, const Grid& to) {
  HERSEY_REQUIRE(from.patches.size() == to.patches.size(), "between rings, or between grids of the same patches");
  GridTransfer transfer(from);
  if (from.closes()) {
    transfer.lay_around_ring(from, to);
  } else {
    transfer.lay_around_patches(from, to);
  }
  for (int j = 0, k = 0; j < to.n_z; ++j) {
    const double at = to.z_over_L(j);
    while (k + 2 < from.n_z && from.z_over_L(k + 1) <= at) ++k;
    const double before = from.z_over_L(k), after = from.z_over_L(k + 1);
    transfer.along_.push_back({k, k + 1, (at - before) / (after - before)});
  }
  return transfer;
}

Eigen::VectorXd GridTransfer::operator()(const Eigen::VectorXd& field, int per_node) const {
  HERSEY_REQUIRE(field.size() == static_cast<Eigen::Index>(n_phi_) * n_z_ * per_node,
                 "a field of the grid it is taken from");
  Eigen::VectorXd result(static_cast<Eigen::Index>(around_.size() * along_.size()) * per_node);
  Eigen::Index index = 0;
  for (const Between& i : around_) {
    for (const Between& j : along_) {
      for (int k = 0; k < per_node; ++k) {
        const auto at = [&](int line, int row) { return field[(line * n_z_ + row) * per_node + k]; };
        const auto on_line = [&](int line) {
          return (1 - j.weight) * at(line, j.first) + j.weight * at(line, j.second);
        };
        result[index++] = (1 - i.weight) * on_line(i.first) + i.weight * on_line(i.second);
      }
    }
  }
  return result;
}

Eigen::MatrixXd GridTransfer::between(const std::vector<Between>& positions, const Eigen::MatrixXd& values) {
  Eigen::MatrixXd result(static_cast<Eigen::Index>(positions.size()), values.cols());
  Eigen::Index row = 0;
  for (const Between& at : positions)
    result.row(row++) = (1 - at.weight) * values.row(at.first) + at.weight * values.row(at.second);
  return result;
}

Eigen::MatrixXd GridTransfer::around(const Eigen::MatrixXd& values) const {
  HERSEY_REQUIRE(values.rows() == n_phi_, "one row for each angle of the grid it is taken from");
  return between(around_, values);
}

Eigen::MatrixXd GridTransfer::along(const Eigen::MatrixXd& values) const {
  HERSEY_REQUIRE(values.rows() == n_z_, "one row for each position along the axis of the grid it is taken from");
  return between(along_, values);
}

}  // namespace hersey::film
