#include "solve/grid_lu.h"

namespace hersey::film {
namespace {

// Parts of so many nodes are eliminated at once.
constexpr int few_nodes = 16;

/// Lines and rows of nodes, the ends not included.
struct Part {
  int first_line = 0, end_line = 0, first_row = 0, end_row = 0;
  [[nodiscard]] int lines() const { return end_line - first_line; }
  [[nodiscard]] int rows() const { return end_row - first_row; }
};

void append(const Grid& grid, const Part& part, std::vector<int>& group) {
  for (int i = part.first_line; i < part.end_line; ++i)
    for (int j = part.first_row; j < part.end_row; ++j) group.push_back(grid.index(i, j));
}

void dissect(const Grid& grid, const Part& part, std::vector<std::vector<int>>& groups) {
  if (part.lines() <= 0 || part.rows() <= 0) return;
  Part first = part, between = part, second = part;
  if (part.lines() * part.rows() <= few_nodes) {
    first = second = {};
  } else if (part.lines() >= part.rows()) {
    first.end_line = between.first_line = (part.first_line + part.end_line) / 2;
    second.first_line = between.end_line = first.end_line + 1;
  } else {
    first.end_row = between.first_row = (part.first_row + part.end_row) / 2;
    second.first_row = between.end_row = first.end_row + 1;
  }
  dissect(grid, first, groups);
  dissect(grid, second, groups);
  append(grid, between, groups.emplace_back());
}

}  // namespace

std::vector<std::vector<int>> nested_dissection(const Grid& grid) {
  std::vector<std::vector<int>> groups;
  const int n = grid.n_phi;
  if (!grid.closes()) {
    dissect(grid, {0, n, 0, grid.n_z}, groups);
    return groups;
  }
  // Two lines part a ring.
  const int opposite = n / 2;
  dissect(grid, {1, opposite, 0, grid.n_z}, groups);
  dissect(grid, {opposite + 1, n, 0, grid.n_z}, groups);
  std::vector<int>& last = groups.emplace_back();
  append(grid, {0, 1, 0, grid.n_z}, last);
  append(grid, {opposite, opposite + 1, 0, grid.n_z}, last);
  return groups;
}

void GridLu::analyse(std::span<const int> column_start, std::span<const int> row_index) {
  column_start_ = column_start, row_index_ = row_index;
  fronts_.analyse(grid_.size(), column_start, row_index, nested_dissection(grid_));
}

bool GridLu::factorise(std::span<const double> values) {
  pivots_in_groups_ = fronts_.factorise(values);
  if (pivots_in_groups_) return true;
  if (pivoting_.size() == 0) pivoting_.analyse(grid_.size(), column_start_, row_index_);
  return pivoting_.factorise(values);
}

void GridLu::solve(std::span<double> b, int columns) {
  if (pivots_in_groups_)
    fronts_.solve(b, columns);
  else
    pivoting_.solve(b, columns);
}

void GridLu::solve_transposed(std::span<double> b, int columns) {
  if (pivots_in_groups_)
    fronts_.solve_transposed(b, columns);
  else
    pivoting_.solve_transposed(b, columns);
}

}  // namespace hersey::film
