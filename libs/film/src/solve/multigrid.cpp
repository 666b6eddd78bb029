#include "solve/multigrid.h"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace hersey::film {
namespace {

// A ring of fewer lines is solved directly.
constexpr int fewest_lines_to_coarsen = 8;

/// A coarse line and the interpolation of a fine line's nodes from it.
struct Parent {
  int line = 0;
  const Real* p = nullptr;
  const Real* r = nullptr;
};

}  // namespace

Multigrid::Multigrid(int lines, int nodes_per_line) {
  for (int n = lines;; n = (n + 1) / 2) {
    const int size = n * nodes_per_line;
    Level& level = levels_.emplace_back();
    level.A = LineOperator(n, nodes_per_line);
    level.active.assign(static_cast<std::size_t>(size), 1);
    if (n < fewest_lines_to_coarsen) break;
    for (LineVector* v : {&level.p_before, &level.p_after, &level.r_before, &level.r_after}) *v = LineVector(size);
  }
  scratch_ = LineVector(nodes_per_line);

  // Pattern of the coarsest matrix by columns; it is structurally symmetric, so that the neighbours of a column are its
  // rows.
  const LineOperator& A = levels_.back().A;
  const int n = nodes_per_line;
  std::vector<int> column_start{0}, row_index;
  for (int column = 0; column < A.size(); ++column) {
    const int line = column / n, j = column % n;
    std::vector<std::array<int, 2>> rows;  // row and the entry in it that belongs to this column
    // The line after has this one to its west.
    for (const auto& [other, block] : {std::pair{line, LineOperator::centre},
                                       {A.after(line), LineOperator::west},
                                       {A.before(line), LineOperator::east}}) {
      for (int d = -1; d <= 1; ++d) {
        if (j + d >= 0 && j + d < n) rows.push_back({other * n + j + d, block + 1 - d});
      }
    }
    std::sort(rows.begin(), rows.end());
    for (const auto& row : rows) {
      row_index.push_back(row[0]);
      slot_node_.push_back(row[0]);
      slot_entry_.push_back(row[1]);
    }
    column_start.push_back(static_cast<int>(row_index.size()));
  }
  values_.resize(row_index.size());
  rhs_.resize(static_cast<std::size_t>(A.size()));
  lu_.analyse(A.size(), column_start, row_index);
}

// A line that is left out follows its neighbours by T p = -(block towards the neighbour) 1, with T its own block; the
// restriction of its residual follows from the transposed blocks. Without variation along the line this is exact
// elimination (Schaffer 1998).
void Multigrid::weigh(Level& fine, LineVector& scratch) {
  const LineOperator& A = fine.A;
  const int n = A.nodes_per_line();
  const auto keep = [&](int line) {
    for (int j = 0; j < n; ++j) {
      const int node = line * n + j;
      fine.p_before[node] = fine.r_before[node] = fine.active[node] ? 1 : 0;
      fine.p_after[node] = fine.r_after[node] = 0;
    }
  };
  const auto is_active = [&](int line, int j) { return j >= 0 && j < n && fine.active[line * n + j]; };
  const auto interpolate = [&](int line, int neighbour, int block, LineVector& p) {
    Real* x = scratch.data();
    for (int j = 0; j < n; ++j) {
      x[j] = 0;
      for (int d = -1; d <= 1; ++d) {
        if (is_active(neighbour, j + d)) x[j] -= A.row(line * n + j)[block + 1 + d];
      }
    }
    A.solve_line(line, x);
    for (int j = 0; j < n; ++j) p[line * n + j] = is_active(line, j) ? x[j] : 0;
  };
  const auto restrict_to = [&](int line, int neighbour, int block, LineVector& r) {
    Real* x = scratch.data();
    for (int j = 0; j < n; ++j) {
      x[j] = 0;
      for (int d = -1; d <= 1; ++d) {
        if (is_active(neighbour, j + d)) x[j] -= A.row(neighbour * n + j + d)[block + 1 - d];
      }
    }
    A.solve_line_transposed(line, x);
    for (int j = 0; j < n; ++j) r[line * n + j] = is_active(line, j) ? x[j] : 0;
  };
  for (int line = 0; line < A.lines(); ++line) {
    if (line % 2 == 0) {
      keep(line);
      continue;
    }
    interpolate(line, A.before(line), LineOperator::west, fine.p_before);
    interpolate(line, A.after(line), LineOperator::east, fine.p_after);
    restrict_to(line, A.before(line), LineOperator::east, fine.r_before);
    restrict_to(line, A.after(line), LineOperator::west, fine.r_after);
  }
}

void Multigrid::coarsen(const Level& fine, Level& coarse) {
  const LineOperator& A = fine.A;
  LineOperator& B = coarse.A;
  const int n = A.nodes_per_line();
  B.set_zero();
  const auto parents = [&](int line) {
    const int at = line * n, I = line / 2;
    return std::array<Parent, 2>{{{I, fine.p_before.data() + at, fine.r_before.data() + at},
                                  {B.after(I), fine.p_after.data() + at, fine.r_after.data() + at}}};
  };
  for (int line = 0; line < A.lines(); ++line) {
    const auto rows = parents(line);
    for (const auto& [neighbour, block] : {std::pair{A.before(line), LineOperator::west},
                                           {line, LineOperator::centre},
                                           {A.after(line), LineOperator::east}}) {
      const auto columns = parents(neighbour);
      for (int a = 0; a < (line % 2 == 0 ? 1 : 2); ++a) {
        for (int b = 0; b < (neighbour % 2 == 0 ? 1 : 2); ++b) {
          const int I = rows[a].line, K = columns[b].line;
          const int slot = K == I ? LineOperator::centre : K == B.after(I) ? LineOperator::east : LineOperator::west;
          const Real *r = rows[a].r, *p = columns[b].p;
          for (int j = 0; j < n; ++j) {
            const LineOperator::Row& from = A.row(line * n + j);
            LineOperator::Row& to = B.row(I * n + j);
            to[slot] += r[j] * from[block] * p[j - 1];
            to[slot + 1] += r[j] * from[block + 1] * p[j];
            to[slot + 2] += r[j] * from[block + 2] * p[j + 1];
          }
        }
      }
    }
  }
  for (int I = 0; I < B.lines(); ++I) {
    for (int j = 0; j < n; ++j) {
      coarse.active[I * n + j] = fine.active[2 * I * n + j];
      if (!coarse.active[I * n + j]) B.row(I * n + j)[LineOperator::centre + 1] = 1;
    }
  }
}

bool Multigrid::factorise_coarsest() {
  const LineOperator& A = levels_.back().A;
  for (std::size_t k = 0; k < values_.size(); ++k) values_[k] = A.row(slot_node_[k])[slot_entry_[k]];
  return lu_.factorise(values_);
}

bool Multigrid::setup(const std::vector<char>& active, bool ascending) {
  ascending_ = ascending;
  levels_.front().active = active;
  for (std::size_t l = 0; l + 1 < levels_.size(); ++l) {
    if (!levels_[l].A.factorise_lines()) return false;
    weigh(levels_[l], scratch_);
    coarsen(levels_[l], levels_[l + 1]);
  }
  return factorise_coarsest();
}

template <class Value>
std::vector<Multigrid::Scratch<Value>>& Multigrid::scratch_of() {
  if constexpr (std::is_same_v<Value, Real>)
    return single_;
  else
    return abreast_;
}

template <class Value>
void Multigrid::cycle(const LineVectorOf<Value>& b, LineVectorOf<Value>& x) {
  std::vector<Scratch<Value>>& scratch = scratch_of<Value>();
  if (scratch.empty()) {
    scratch.resize(levels_.size());
    for (std::size_t l = 0; l < levels_.size(); ++l) {
      const int size = levels_[l].A.size();
      if (l + 1 < levels_.size()) scratch[l].residual = LineVectorOf<Value>(size);
      if (l > 0) scratch[l].x = scratch[l].b = LineVectorOf<Value>(size);
    }
  }
  descend(0, b, x);
}

template <class Value>
void Multigrid::solve_coarsest(const LineVectorOf<Value>& b, LineVectorOf<Value>& x) {
  constexpr int columns = std::is_same_v<Value, Pack> ? kAbreast : 1;
  const int n = levels_.back().A.size();
  rhs_.resize(static_cast<std::size_t>(n) * columns);
  for (int c = 0; c < columns; ++c)
    for (int i = 0; i < n; ++i) rhs_[static_cast<std::size_t>(c) * n + i] = lane(b[i], c);
  lu_.solve(rhs_, columns);
  for (int c = 0; c < columns; ++c)
    for (int i = 0; i < n; ++i) set_lane(x[i], c, static_cast<Real>(rhs_[static_cast<std::size_t>(c) * n + i]));
}

template <class Value>
void Multigrid::descend(std::size_t l, const LineVectorOf<Value>& b, LineVectorOf<Value>& x) {
  if (l + 1 == levels_.size()) return solve_coarsest(b, x);
  const Level& fine = levels_[l];
  LineVectorOf<Value>& residual = scratch_of<Value>()[l].residual;
  LineVectorOf<Value>&coarse_b = scratch_of<Value>()[l + 1].b, &coarse_x = scratch_of<Value>()[l + 1].x;
  const LineOperator &A = fine.A, &B = levels_[l + 1].A;
  const int n = A.nodes_per_line();
  A.relax_from_zero(b, ascending_, x, residual);
  coarse_b.set_zero();
  for (int line = 0; line < A.lines(); ++line) {
    const int at = line * n, here = line / 2 * n, next = B.after(line / 2) * n;
    for (int j = 0; j < n; ++j) coarse_b[here + j] += fine.r_before[at + j] * residual[at + j];
    if (line % 2 == 0) continue;
    for (int j = 0; j < n; ++j) coarse_b[next + j] += fine.r_after[at + j] * residual[at + j];
  }
  descend(l + 1, coarse_b, coarse_x);
  for (int line = 0; line < A.lines(); ++line) {
    const int at = line * n, here = line / 2 * n, next = B.after(line / 2) * n;
    for (int j = 0; j < n; ++j) x[at + j] += fine.p_before[at + j] * coarse_x[here + j];
    if (line % 2 == 0) continue;
    for (int j = 0; j < n; ++j) x[at + j] += fine.p_after[at + j] * coarse_x[next + j];
  }
  A.relax(b, ascending_, x);
}

template void Multigrid::cycle(const LineVectorOf<Real>&, LineVectorOf<Real>&);
template void Multigrid::cycle(const LineVectorOf<Pack>&, LineVectorOf<Pack>&);

}  // namespace hersey::film
