#include "heat_system.h"

#include <algorithm>

namespace hersey::film {

HeatSystem::HeatSystem(const Grid& grid, int layers, bool has_ring) : nodes_(grid.size()), layers_(layers) {
  const int n_phi = grid.n_phi, n_z = grid.n_z, film = nodes_ * layers, rows = film + (has_ring ? n_phi : 0);
  constexpr int none = -1;
  std::vector<std::array<int, 7>> wanted(static_cast<std::size_t>(film));
  std::vector<std::vector<int>> columns(static_cast<std::size_t>(rows));
  const auto next = [n_phi](int i) { return (i + 1) % n_phi; };
  const auto last = [n_phi](int i) { return (i + n_phi - 1) % n_phi; };
  for (int node = 0; node < nodes_; ++node) {
    const int i = node / n_z, j = node % n_z;
    for (int l = 0; l < layers; ++l) {
      const int at = row(node, l);
      wanted[at] = {row(grid.index(last(i), j), l), row(grid.index(next(i), j), l),
                    j > 0 ? row(node - 1, l) : none, j + 1 < n_z ? row(node + 1, l) : none,
                    l > 0 ? at - 1 : none, l + 1 < layers ? at + 1 : none, has_ring && l == 0 ? film + i : none};
      columns[at].push_back(at);
      for (const int column : wanted[at])
        if (column != none) columns[at].push_back(column);
    }
  }
  for (int i = 0; has_ring && i < n_phi; ++i) {
    columns[film + i] = {film + i, film + last(i), film + next(i)};
    for (int j = 0; j < n_z; ++j) columns[film + i].push_back(row(grid.index(i, j), 0));
  }
  row_start_.assign(1, 0);
  for (std::vector<int>& row : columns) {
    std::sort(row.begin(), row.end());
    column_.insert(column_.end(), row.begin(), row.end());
    row_start_.push_back(static_cast<int>(column_.size()));
  }
  const int nowhere = row_start_.back();
  const auto slot = [&](int in, int column) {
    if (column == none) return nowhere;
    const auto begin = column_.begin() + row_start_[in], end = column_.begin() + row_start_[in + 1];
    return static_cast<int>(std::lower_bound(begin, end, column) - column_.begin());
  };
  for (int at = 0; at < rows; ++at) diagonal_.push_back(slot(at, at));
  for (int at = 0; at < film; ++at) {
    layer_.emplace_back();
    for (int k = 0; k < 7; ++k) layer_.back()[k] = slot(at, wanted[at][k]);
  }
  for (int i = 0; has_ring && i < n_phi; ++i) {
    ring_.push_back({slot(film + i, film + last(i)), slot(film + i, film + next(i))});
    for (int j = 0; j < n_z; ++j) ring_.back().push_back(slot(film + i, row(grid.index(i, j), 0)));
  }
  values_.resize(column_.size() + 1);
}

void HeatSystem::set_zero() { std::fill(values_.begin(), values_.end(), 0.0); }

HeatSystem::Row HeatSystem::entries(int row) const {
  Row entries;
  for (int k = row_start_[row]; k < row_start_[row + 1]; ++k) entries.emplace_back(column_[k], values_[k]);
  return entries;
}

void HeatSystem::scale(int row, double factor) {
  for (int k = row_start_[row]; k < row_start_[row + 1]; ++k) values_[k] *= factor;
}

// Rows of this matrix are the columns of its transpose.
bool HeatSystem::factorise() {
  if (lu_.size() == 0) lu_.analyse(size(), row_start_, column_);
  return lu_.factorise({values_.data(), column_.size()});
}

void HeatSystem::solve(Eigen::MatrixXd& b) const {
  lu_.solve_transposed({b.data(), static_cast<std::size_t>(b.size())}, static_cast<int>(b.cols()));
}

}  // namespace hersey::film
