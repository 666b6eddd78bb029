#include "hersey/film/grid_transfer.h"

#include <algorithm>

namespace hersey::film {
namespace {

// Fewer nodes show no front (around) and no parabola (across).
constexpr int fewest_around = 24, fewest_across = 7;

}  // namespace

Grid half_of(const Grid& grid) {
  return resampled(grid, (grid.n_phi + 1) / 2, grid.n_z < fewest_across ? grid.n_z : grid.n_z / 2 + 1);
}

bool can_be_coarsened(const Grid& grid) { return half_of(grid).n_phi >= fewest_around; }

GridTransfer::GridTransfer(const Grid& from, const Grid& to) : n_z_(from.n_z) {
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

Eigen::VectorXd GridTransfer::operator()(const Eigen::VectorXd& field, int per_node) const {
  Eigen::VectorXd result(static_cast<Eigen::Index>(around_.size() * along_.size()) * per_node);
  Eigen::Index place = 0;
  for (const Between& i : around_) {
    for (const Between& j : along_) {
      for (int k = 0; k < per_node; ++k) {
        const auto at = [&](int line, int row) { return field[(line * n_z_ + row) * per_node + k]; };
        const auto on_line = [&](int line) { return (1 - j.share) * at(line, j.first) + j.share * at(line, j.second); };
        result[place++] = (1 - i.share) * on_line(i.first) + i.share * on_line(i.second);
      }
    }
  }
  return result;
}

Eigen::VectorXd GridTransfer::around(const Eigen::VectorXd& values) const {
  Eigen::VectorXd result(static_cast<Eigen::Index>(around_.size()));
  Eigen::Index place = 0;
  for (const Between& i : around_) result[place++] = (1 - i.share) * values[i.first] + i.share * values[i.second];
  return result;
}

}  // namespace hersey::film
