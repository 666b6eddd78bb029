#include "hersey/solver/frontal_lu.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "dense_front.h"
#include "elimination.h"
#include "hersey/core/contract.h"
#include "product_tiles.h"

namespace hersey::solver {
namespace {

// Elements that grow by more may have lost half their digits.
constexpr double smallest_growth_ratio = 1e-6;
constexpr double smallest_reciprocal = 1e-15;

}  // namespace

struct FrontalLu::Impl {
  /// Where a front's blocks stand among the factors.
  struct Place {
    std::size_t upper = 0, lower = 0, end = 0;
  };

  Elimination plan;
  std::vector<int> column_start;
  std::vector<Place> places;
  std::vector<double> factors, complements;
  std::vector<int> pivots;                     // of every position, within its group
  std::vector<double> largest_given, largest;  // |A| and |U| in the columns of all positions
  std::vector<double> known_diagonal, known_values;
  std::vector<double> rows, border;  // right-hand sides side by side, in order of elimination
  std::size_t widest_border = 0;
  bool factorised = false;
  int n = 0;

  [[nodiscard]] DenseFront dense(std::size_t f);
  void assemble(std::size_t f, std::span<const double> values);
  void add_complement(const Elimination::Front& child, const DenseFront& into);
  void find_largest(const Elimination::Front& front, const DenseFront& dense);
  void find_largest_given(std::span<const double> values);
  void solve_vector(std::span<double> b);
  void take_sides(std::span<const double> b, int columns, int width);
  void give_sides(std::span<double> b, int columns, int width) const;
  [[nodiscard]] FrontSides gather(std::size_t f, int width);
  void scatter(std::size_t f, int width);
};

FrontalLu::FrontalLu() : impl_(std::make_unique<Impl>()) {}
FrontalLu::~FrontalLu() = default;
FrontalLu::FrontalLu(FrontalLu&&) noexcept = default;
FrontalLu& FrontalLu::operator=(FrontalLu&&) noexcept = default;

void FrontalLu::analyse(int n, std::span<const int> column_start, std::span<const int> row_index,
                        std::span<const std::vector<int>> groups) {
  Impl& m = *impl_;
  m.n = n;
  m.plan = Elimination(n, column_start, row_index, groups);
  m.column_start.assign(column_start.begin(), column_start.end());
  m.factorised = false;
  m.places.clear();
  std::size_t room = 0;
  m.widest_border = 0;
  for (const Elimination::Front& front : m.plan.fronts) {
    const auto own = static_cast<std::size_t>(front.own), outside = static_cast<std::size_t>(front.outside());
    const auto own_columns = static_cast<std::size_t>(padded(front.own));
    const std::size_t upper = own * (own_columns + static_cast<std::size_t>(padded(front.outside())));
    m.places.push_back({room, room + upper, room + upper + outside * own_columns});
    room = m.places.back().end;
    m.widest_border = std::max(m.widest_border, outside);
  }
  m.factors.assign(room, 0);
  m.complements.assign(m.plan.complement_room, 0);
  const auto eliminated = static_cast<std::size_t>(m.plan.eliminated());
  m.pivots.assign(eliminated, 0);
  m.largest_given.assign(eliminated, 0), m.largest.assign(eliminated, 0);
  m.known_diagonal.assign(m.plan.known.size(), 0);
  m.known_values.assign(m.plan.from_known.size(), 0);
  m.rows.assign(eliminated * pack_width, 0);
  m.border.assign(m.widest_border * pack_width, 0);
}

DenseFront FrontalLu::Impl::dense(std::size_t f) {
  const Elimination::Front& front = plan.fronts[f];
  return {front.own,
          front.outside(),
          factors.data() + places[f].upper,
          factors.data() + places[f].lower,
          complements.data() + front.complement,
          pivots.data() + front.first()};
}

void FrontalLu::Impl::assemble(std::size_t f, std::span<const double> values) {
  const Elimination::Front& front = plan.fronts[f];
  const DenseFront into = dense(f);
  std::fill(into.upper, factors.data() + places[f].end, 0.0);
  std::fill_n(into.complement, front.complement_length, 0.0);
  for (const auto& [slot, at] : front.upper) into.upper[at] += values[static_cast<std::size_t>(slot)];
  for (const auto& [slot, at] : front.lower) into.lower[at] += values[static_cast<std::size_t>(slot)];
  for (const int child : front.children) add_complement(plan.fronts[static_cast<std::size_t>(child)], into);
}

void FrontalLu::Impl::add_complement(const Elimination::Front& child, const DenseFront& into) {
  const int width = child.outside(), in_group = child.in_parents_group;
  const int own_columns = into.own_columns(), columns = into.columns(), outside_columns = into.outside_columns();
  const int* place = child.place_in_parent.data();
  const double* from = complements.data() + child.complement;
  for (int i = 0; i < width; ++i, from += padded(width)) {
    if (i < in_group) {
      double* row = into.upper + static_cast<std::ptrdiff_t>(place[i]) * columns;
      for (int k = 0; k < width; ++k) row[place[k]] += from[k];
      continue;
    }
    const std::ptrdiff_t outside = place[i] - own_columns;
    double *row = into.lower + outside * own_columns, *beyond = into.complement + outside * outside_columns;
    for (int k = 0; k < in_group; ++k) row[place[k]] += from[k];
    for (int k = in_group; k < width; ++k) beyond[place[k] - own_columns] += from[k];
  }
}

void FrontalLu::Impl::find_largest(const Elimination::Front& front, const DenseFront& dense) {
  const int columns = dense.columns(), own_columns = dense.own_columns(), outside = front.outside();
  double* own = largest.data() + front.first();
  std::fill_n(border.begin(), outside, 0.0);
  for (int i = 0; i < front.own; ++i) {
    const double* row = dense.upper + static_cast<std::ptrdiff_t>(i) * columns;
    for (int j = i; j < front.own; ++j) own[j] = std::max(own[j], std::abs(row[j]));
    row += own_columns;
    for (int j = 0; j < outside; ++j) border[j] = std::max(border[j], std::abs(row[j]));
  }
  for (int j = 0; j < outside; ++j) {
    double& column = largest[static_cast<std::size_t>(front.positions[static_cast<std::size_t>(front.own + j)])];
    column = std::max(column, border[j]);
  }
}

void FrontalLu::Impl::find_largest_given(std::span<const double> values) {
  for (std::size_t at = 0; at < largest_given.size(); ++at) {
    const auto column = static_cast<std::size_t>(plan.unknown_at[at]);
    double most = 0;
    for (int k = column_start[column]; k < column_start[column + 1]; ++k)
      most = std::max(most, std::abs(values[static_cast<std::size_t>(k)]));
    largest_given[at] = most;
  }
}

bool FrontalLu::factorise(std::span<const double> values) {
  Impl& m = *impl_;
  HERSEY_REQUIRE(static_cast<int>(values.size()) == m.plan.entries, "one value per entry of the pattern");
  m.factorised = false;
  m.find_largest_given(values);
  std::fill(m.largest.begin(), m.largest.end(), 0.0);
  double least = std::numeric_limits<double>::infinity(), most = 0;
  const auto take_pivot = [&](double pivot) {
    least = std::min(least, std::abs(pivot)), most = std::max(most, std::abs(pivot));
    return std::isfinite(pivot) && pivot != 0;
  };
  for (std::size_t k = 0; k < m.plan.known.size(); ++k) {
    m.known_diagonal[k] = values[m.plan.known[k].slot];
    if (!take_pivot(m.known_diagonal[k])) return false;
  }
  for (std::size_t k = 0; k < m.plan.from_known.size(); ++k) m.known_values[k] = values[m.plan.from_known[k].slot];
  for (std::size_t f = 0; f < m.plan.fronts.size(); ++f) {
    m.assemble(f, values);
    const DenseFront dense = m.dense(f);
    if (!dense.eliminate()) return false;
    for (int i = 0; i < dense.own; ++i)
      if (!take_pivot(dense.upper[static_cast<std::ptrdiff_t>(i) * dense.columns() + i])) return false;
    m.find_largest(m.plan.fronts[f], dense);
  }
  for (std::size_t k = 0; k < m.largest.size(); ++k)
    if (!(m.largest_given[k] > smallest_growth_ratio * m.largest[k])) return false;
  return m.factorised = m.n == 0 || least > smallest_reciprocal * most;
}

void FrontalLu::Impl::take_sides(std::span<const double> b, int columns, int width) {
  const std::size_t eliminated = plan.unknown_at.size();
  if (rows.size() < eliminated * static_cast<std::size_t>(width)) {
    border.resize(widest_border * static_cast<std::size_t>(width));
    rows.resize(eliminated * static_cast<std::size_t>(width));
  }
  for (std::size_t at = 0; at < eliminated; ++at) {
    const double* from = b.data() + plan.unknown_at[at];
    double* row = rows.data() + at * static_cast<std::size_t>(width);
    for (int k = 0; k < columns; ++k) row[k] = from[static_cast<std::ptrdiff_t>(k) * n];
    std::fill(row + columns, row + width, 0.0);
  }
}

void FrontalLu::Impl::give_sides(std::span<double> b, int columns, int width) const {
  for (std::size_t at = 0; at < plan.unknown_at.size(); ++at) {
    double* to = b.data() + plan.unknown_at[at];
    const double* row = rows.data() + at * static_cast<std::size_t>(width);
    for (int k = 0; k < columns; ++k) to[static_cast<std::ptrdiff_t>(k) * n] = row[k];
  }
}

FrontSides FrontalLu::Impl::gather(std::size_t f, int width) {
  const Elimination::Front& front = plan.fronts[f];
  for (int j = 0; j < front.outside(); ++j) {
    const std::ptrdiff_t position = front.positions[static_cast<std::size_t>(front.own + j)];
    copy_packs(rows.data() + position * width, width, border.data() + static_cast<std::ptrdiff_t>(j) * width);
  }
  return {rows.data() + static_cast<std::ptrdiff_t>(front.first()) * width, border.data(), width};
}

void FrontalLu::Impl::scatter(std::size_t f, int width) {
  const Elimination::Front& front = plan.fronts[f];
  for (int j = 0; j < front.outside(); ++j) {
    const std::ptrdiff_t position = front.positions[static_cast<std::size_t>(front.own + j)];
    copy_packs(border.data() + static_cast<std::ptrdiff_t>(j) * width, width, rows.data() + position * width);
  }
}

// A single right-hand side in order of elimination, by itself.
void FrontalLu::Impl::solve_vector(std::span<double> b) {
  const std::size_t eliminated = plan.unknown_at.size();
  if (rows.size() < eliminated + pack_width) rows.resize(eliminated + pack_width);
  if (border.size() < widest_border + pack_width) border.resize(widest_border + pack_width);
  for (std::size_t at = 0; at < eliminated; ++at) rows[at] = b[static_cast<std::size_t>(plan.unknown_at[at])];
  std::fill_n(rows.begin() + static_cast<std::ptrdiff_t>(eliminated), pack_width, 0.0);
  const auto vector_of = [&](const Elimination::Front& front) {
    for (int j = 0; j < front.outside(); ++j)
      border[static_cast<std::size_t>(j)] =
          rows[static_cast<std::size_t>(front.positions[static_cast<std::size_t>(front.own + j)])];
    std::fill_n(border.begin() + front.outside(), pack_width, 0.0);
    return FrontVector{rows.data() + front.first(), border.data()};
  };
  for (std::size_t f = 0; f < plan.fronts.size(); ++f) {
    const Elimination::Front& front = plan.fronts[f];
    solve_down(dense(f), vector_of(front));
    for (int j = 0; j < front.outside(); ++j)
      rows[static_cast<std::size_t>(front.positions[static_cast<std::size_t>(front.own + j)])] =
          border[static_cast<std::size_t>(j)];
  }
  for (std::size_t f = plan.fronts.size(); f-- > 0;) solve_up(dense(f), vector_of(plan.fronts[f]));
  for (std::size_t at = 0; at < eliminated; ++at) b[static_cast<std::size_t>(plan.unknown_at[at])] = rows[at];
}

void FrontalLu::solve(std::span<double> b, int columns) {
  Impl& m = *impl_;
  HERSEY_REQUIRE(m.factorised, "no factorisation to solve with");
  HERSEY_REQUIRE(b.size() == static_cast<std::size_t>(m.n) * static_cast<std::size_t>(columns), "shape (n, columns)");
  for (int c = 0; c < columns; ++c) {
    double* column = b.data() + static_cast<std::ptrdiff_t>(c) * m.n;
    for (std::size_t k = 0; k < m.plan.known.size(); ++k) column[m.plan.known[k].unknown] /= m.known_diagonal[k];
    for (std::size_t k = 0; k < m.plan.from_known.size(); ++k)
      column[m.plan.from_known[k].row] -= m.known_values[k] * column[m.plan.from_known[k].known];
  }
  if (columns == 1) return m.solve_vector(b);
  const int width = padded(columns);
  m.take_sides(b, columns, width);
  for (std::size_t f = 0; f < m.plan.fronts.size(); ++f) {
    solve_down(m.dense(f), m.gather(f, width));
    m.scatter(f, width);
  }
  for (std::size_t f = m.plan.fronts.size(); f-- > 0;) solve_up(m.dense(f), m.gather(f, width));
  m.give_sides(b, columns, width);
}

void FrontalLu::solve_transposed(std::span<double> b, int columns) {
  Impl& m = *impl_;
  HERSEY_REQUIRE(m.factorised, "no factorisation to solve with");
  HERSEY_REQUIRE(b.size() == static_cast<std::size_t>(m.n) * static_cast<std::size_t>(columns), "shape (n, columns)");
  const int width = padded(columns);
  m.take_sides(b, columns, width);
  for (std::size_t f = 0; f < m.plan.fronts.size(); ++f) {
    solve_down_transposed(m.dense(f), m.gather(f, width));
    m.scatter(f, width);
  }
  for (std::size_t f = m.plan.fronts.size(); f-- > 0;) solve_up_transposed(m.dense(f), m.gather(f, width));
  m.give_sides(b, columns, width);
  for (int c = 0; c < columns; ++c) {
    double* column = b.data() + static_cast<std::ptrdiff_t>(c) * m.n;
    for (std::size_t k = 0; k < m.plan.from_known.size(); ++k)
      column[m.plan.from_known[k].known] -= m.known_values[k] * column[m.plan.from_known[k].row];
    for (std::size_t k = 0; k < m.plan.known.size(); ++k) column[m.plan.known[k].unknown] /= m.known_diagonal[k];
  }
}

int FrontalLu::size() const { return impl_->n; }

// Of the group's block, of its border by rows and by columns, and of the complement.
double FrontalLu::operations() const {
  double sum = 0;
  for (const Elimination::Front& front : impl_->plan.fronts) {
    const double own = front.own, outside = front.outside();
    sum += 2.0 / 3 * own * own * own + 2 * own * own * outside + 2 * own * outside * outside;
  }
  return sum;
}

}  // namespace hersey::solver
