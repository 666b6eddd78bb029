#include "solve/line_operator.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hersey::film {
namespace {

/// Three entries of a row times the three nearest nodes of a line.
template <class Value>
Value times(const Real* entries, const Value* x, int j) {
  return entries[0] * x[j - 1] + entries[1] * x[j] + entries[2] * x[j + 1];
}

}  // namespace

LineOperator::LineOperator(int lines, int n)
    : lines_(lines), n_(n), rows_(static_cast<std::size_t>(lines) * n), pivots_(rows_.size()) {
  set_zero();
}

void LineOperator::set_zero() {
  for (Row& row : rows_) row.fill(0);
}

bool LineOperator::factorise_lines() {
  bool sound = true;
  for (int line = 0; line < lines_; ++line) {
    const Row* row = &rows_[static_cast<std::size_t>(line) * n_];
    Pivot* pivot = &pivots_[static_cast<std::size_t>(line) * n_];
    Real above = 0;  // entry to the right in the row before, over its pivot
    for (int j = 0; j < n_; ++j) {
      const Real below = row[j][centre], d = row[j][centre + 1] - below * above;
      sound = sound && std::abs(d) > 10 * std::numeric_limits<Real>::epsilon() * std::abs(row[j][centre + 1]);
      pivot[j] = {j == 0 ? 0 : below * pivot[j - 1].inverse, 1 / d, 0};
      above = pivot[j].above = j + 1 == n_ ? 0 : row[j][centre + 2] / d;
    }
  }
  return sound;
}

template <class Value>
void LineOperator::solve_line(int line, Value* x) const {
  const Pivot* pivot = &pivots_[static_cast<std::size_t>(line) * n_];
  for (int j = 1; j < n_; ++j) x[j] -= pivot[j].below * x[j - 1];
  x[n_ - 1] *= pivot[n_ - 1].inverse;
  for (int j = n_ - 2; j >= 0; --j) x[j] = x[j] * pivot[j].inverse - pivot[j].above * x[j + 1];
}

// (L U)^T x = b: the entry to the right of pivot j is above_j / inverse_j.
void LineOperator::solve_line_transposed(int line, Real* x) const {
  const Pivot* pivot = &pivots_[static_cast<std::size_t>(line) * n_];
  x[0] *= pivot[0].inverse;
  for (int j = 1; j < n_; ++j) {
    const Real entry = pivot[j - 1].above / pivot[j - 1].inverse;
    x[j] = (x[j] - entry * x[j - 1]) * pivot[j].inverse;
  }
  for (int j = n_ - 2; j >= 0; --j) x[j] -= pivot[j + 1].below * x[j + 1];
}

template <class Value>
void LineOperator::relax(const LineVectorOf<Value>& b, bool ascending, LineVectorOf<Value>& x) const {
  for (int k = 0; k < lines_; ++k) {
    const int line = ascending ? k : lines_ - 1 - k;
    const Row* row = &rows_[static_cast<std::size_t>(line) * n_];
    const Value *xw = x.data() + before(line) * n_, *xe = x.data() + after(line) * n_, *rhs = b.data() + line * n_;
    Value* here = x.data() + line * n_;
    for (int j = 0; j < n_; ++j) here[j] = rhs[j] - times(&row[j][west], xw, j) - times(&row[j][east], xe, j);
    solve_line(line, here);
  }
}

template <class Value>
void LineOperator::relax_from_zero(const LineVectorOf<Value>& b, bool ascending, LineVectorOf<Value>& x,
                                   LineVectorOf<Value>& residual) const {
  const int upstream = ascending ? west : east, downstream = ascending ? east : west;
  const auto line_at = [&](int k) { return ascending ? k : lines_ - 1 - k; };
  const auto rows_at = [&](int k) { return &rows_[static_cast<std::size_t>(line_at(k)) * n_]; };
  const auto x_at = [&](int k) { return x.data() + line_at(k) * n_; };
  const auto residual_at = [&](int k) { return residual.data() + line_at(k) * n_; };
  const int last = lines_ - 1;
  for (int k = 0; k <= last; ++k) {
    const Row* row = rows_at(k);
    const Value* rhs = b.data() + line_at(k) * n_;
    Value* here = x_at(k);
    std::copy(rhs, rhs + n_, here);
    const auto subtract = [&](int block, const Value* other) {
      for (int j = 0; j < n_; ++j) here[j] -= times(&row[j][block], other, j);
    };
    if (k > 0) subtract(upstream, x_at(k - 1));
    if (k == last) subtract(downstream, x_at(0));
    solve_line(line_at(k), here);
    // The line before, the downstream neighbour of this one, has changed since it was solved.
    if (k == 0) continue;
    const Row* row_before = rows_at(k - 1);
    Value* r = residual_at(k - 1);
    for (int j = 0; j < n_; ++j) r[j] = -times(&row_before[j][downstream], here, j);
  }
  // The last line was solved with both of its neighbours known, the first one without the last.
  std::fill(residual_at(last), residual_at(last) + n_, Value{});
  const Row* first = rows_at(0);
  for (int j = 0; j < n_; ++j) residual_at(0)[j] -= times(&first[j][upstream], x_at(last), j);
}

template void LineOperator::solve_line(int, Real*) const;
template void LineOperator::relax(const LineVectorOf<Real>&, bool, LineVectorOf<Real>&) const;
template void LineOperator::relax(const LineVectorOf<Pack>&, bool, LineVectorOf<Pack>&) const;
template void LineOperator::relax_from_zero(const LineVectorOf<Real>&, bool, LineVectorOf<Real>&,
                                            LineVectorOf<Real>&) const;
template void LineOperator::relax_from_zero(const LineVectorOf<Pack>&, bool, LineVectorOf<Pack>&,
                                            LineVectorOf<Pack>&) const;

}  // namespace hersey::film
