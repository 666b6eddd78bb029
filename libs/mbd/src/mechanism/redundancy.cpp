#include "mechanism/redundancy.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <random>
#include <span>

#include "hersey/solver/sparse_lu.h"

namespace hersey::mbd {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

// Size relative to the row (a length of the mechanism, a radian) below which a constraint's own part is a rounding of
// the model's numbers: users give frames and axes to about seven digits.
constexpr double kGeometryTolerance = 1e-6;

/// A row after elimination: its pivot's entry is 1, the others are at most 1.
struct ReducedRow {
  int pivot = 0;
  std::vector<std::pair<int, double>> entries;
};

/// Rows that have been found independent, in echelon form.
class Echelon {
 public:
  explicit Echelon(Index columns)
      : row_of_pivot_(static_cast<std::size_t>(columns), -1),
        work_(VectorXd::Zero(columns)),
        is_touched_(static_cast<std::size_t>(columns), 0) {}

  /// Takes row `i` of G if what earlier rows leave of it exceeds `threshold` of its largest entry, and `smallest`.
  bool take(const RowMatrix& G, Index i, double threshold, double smallest) {
    double size = 0;
    for (RowMatrix::InnerIterator entry(G, i); entry; ++entry) size = std::max(size, std::abs(entry.value()));
    const double limit = std::max(threshold * size, smallest);
    if (size <= limit) return false;
    for (RowMatrix::InnerIterator entry(G, i); entry; ++entry) touch(static_cast<int>(entry.col()), entry.value());
    eliminate();
    std::sort(touched_.begin(), touched_.end());  // of equal entries the first is the pivot
    int pivot = -1;
    for (int column : touched_)
      if (std::abs(work_[column]) > (pivot < 0 ? limit : std::abs(work_[pivot]))) pivot = column;
    if (pivot >= 0) keep(pivot);
    for (int column : touched_) work_[column] = 0;
    for (int column : touched_) is_touched_[column] = 0;
    touched_.clear();
    return pivot >= 0;
  }

 private:
  void touch(int column, double value) {
    work_[column] += value;
    if (is_touched_[column] != 0) return;
    is_touched_[column] = 1;
    touched_.push_back(column);
    if (row_of_pivot_[column] >= 0) pending_.push(row_of_pivot_[column]);
  }

  /// Earlier rows first: each has zeros in the pivots of those before it.
  void eliminate() {
    while (!pending_.empty()) {
      const ReducedRow& row = rows_[static_cast<std::size_t>(pending_.top())];
      pending_.pop();
      const double factor = work_[row.pivot];
      if (factor == 0) continue;
      for (const auto& [column, value] : row.entries) touch(column, -factor * value);
      work_[row.pivot] = 0;
    }
  }

  void keep(int pivot) {
    ReducedRow row{pivot, {}};
    for (int column : touched_)
      if (work_[column] != 0) row.entries.emplace_back(column, work_[column] / work_[pivot]);
    row_of_pivot_[pivot] = static_cast<int>(rows_.size());
    rows_.push_back(std::move(row));
  }

  std::vector<ReducedRow> rows_;
  std::vector<int> row_of_pivot_;  ///< -1: not a pivot
  VectorXd work_;
  std::vector<int> touched_;  ///< columns of the row at hand
  std::vector<char> is_touched_;
  std::priority_queue<int, std::vector<int>, std::greater<>> pending_;  ///< reduced rows still to be subtracted
};

/// Closes the loops of a tree by themselves, drives apart.
class LoopCloser {
 public:
  LoopCloser(const Tree& tree, TreeMotion& motion) : tree_(tree), motion_(motion) {}

  /// Newton's method with the smallest weighted increment, which redundant rows do not disturb; false if the loops stay
  /// open by more than the tolerance of the geometry.
  bool close(solver::State& state, const VectorXd& weight) {
    constexpr int max_iterations = 60;
    constexpr double largest_increment = 0.5, solved = 1e-13;
    double open = 0;
    for (int iteration = 0; iteration < max_iterations; ++iteration) {
      evaluate(state);
      const double before = open;
      open = phi_.lpNorm<Eigen::Infinity>();
      if (!std::isfinite(open)) return false;
      if (open < solved || (iteration > 0 && open < kGeometryTolerance && open > 0.9 * before)) return true;
      VectorXd dx = increment(weight);
      if (dx.size() == 0) return false;
      if (const double largest = dx.lpNorm<Eigen::Infinity>(); largest > largest_increment)
        dx *= largest_increment / largest;
      move(state, dx);
    }
    return open < kGeometryTolerance;
  }

  /// Moves the state along the scaled increment dx: radians, and shares of the mechanism's size.
  void move(solver::State& state, const VectorXd& dx) const {
    for (const Link& link : tree_.links) {
      if (link.motion == Motion::ball) {
        Eigen::Map<Eigen::Vector4d> p(state.q.data() + link.first_q);
        const Eigen::Quaterniond R =
            (Eigen::Quaterniond(p[0], p[1], p[2], p[3]) * rotation_exp(dx.segment<3>(link.first_v))).normalized();
        p << R.w(), R.x(), R.y(), R.z();
      } else if (link.columns == 1) {
        state.q[link.first_q] += size_of(link) * dx[link.first_v];
      }
    }
  }

  /// Scaled rows at `state`: lengths relative to the mechanism's size.
  void evaluate(const solver::State& state) {
    motion_.update_positions(state);
    phi_.resize(tree_.nclosure);
    std::vector<Eigen::Triplet<double>> entries;
    for (const Closure& closure : tree_.closures) {
      const Pose X_WA = motion_.pose(closure.pair.a);
      const Pose X_AB = X_WA.inverse() * motion_.pose(closure.pair.b);
      for (std::size_t i = 0; i < closure.rows.size(); ++i) {
        const ConstraintRow& row = closure.rows[i];
        const int at = closure.first_row + static_cast<int>(i);
        const double scale = row.kind == ConstraintRow::Kind::position ? 1 / tree_.length : 1.0;
        const Vector6 w = scale * (force_transform(X_WA) * row.wrench(X_AB));
        phi_[at] = scale * row.value(X_AB);
        for (const SignedColumn& col : closure.pair.columns)
          entries.emplace_back(
              at, col.column,
              col.sign * size_of(tree_.links[tree_.columns[col.column].link]) * motion_.J(col.column).dot(w));
      }
    }
    G_.resize(tree_.nclosure, tree_.nv);
    G_.setFromTriplets(entries.begin(), entries.end());
  }

  [[nodiscard]] const RowMatrix& jacobian() const { return G_; }

 private:
  [[nodiscard]] double size_of(const Link& link) const { return link.motion == Motion::prismatic ? tree_.length : 1.0; }

  /// -W G^T (G W G^T + shift)^-1 phi, W the squared weights; the shift keeps dependent rows solvable.
  [[nodiscard]] VectorXd increment(const VectorXd& weight) const {
    constexpr double shift = 1e-11;
    const VectorXd W = weight.cwiseAbs2();
    const RowMatrix transposed = G_.transpose();
    Eigen::SparseMatrix<double> normal = G_ * W.asDiagonal() * transposed;
    double largest = 0;
    for (Index i = 0; i < normal.rows(); ++i) largest = std::max(largest, normal.coeff(i, i));
    for (Index i = 0; i < normal.rows(); ++i) normal.coeffRef(i, i) += shift * largest;
    normal.makeCompressed();
    solver::SparseLu lu;
    lu.analyse(normal);
    if (!lu.factorise({normal.valuePtr(), static_cast<std::size_t>(normal.nonZeros())})) return {};
    VectorXd x = phi_;
    lu.solve({x.data(), static_cast<std::size_t>(x.size())});
    return -(W.asDiagonal() * (transposed * x));
  }

  const Tree& tree_;
  TreeMotion& motion_;
  VectorXd phi_;
  RowMatrix G_;
};

}  // namespace

std::vector<int> dependent_rows(const RowMatrix& G, double tolerance) {
  std::vector<int> left(static_cast<std::size_t>(G.rows()));
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = static_cast<int>(i);
  Echelon echelon(G.cols());
  for (double threshold : {0.1, 1e-3, tolerance}) {
    std::vector<int> later;
    for (int i : left)
      if (!echelon.take(G, i, threshold, tolerance)) later.push_back(i);
    left = std::move(later);
  }
  return left;
}

std::vector<int> redundant_rows(const Tree& tree, TreeMotion& motion, const solver::State& guess,
                                const std::vector<Index>& fixed) {
  if (tree.nclosure == 0) return {};
  // Prescribed components have a thousandth of the mobility of the others.
  VectorXd weight = VectorXd::Ones(tree.nv);
  for (Index k : fixed) weight[k] = 1e-3;
  LoopCloser loops(tree, motion);
  std::mt19937 random(1);
  const auto moved_by = [&](double reach) {
    std::uniform_real_distribution<double> uniform(-reach, reach);
    VectorXd aside(tree.nv);
    for (double& x : aside) x = uniform(random);
    return aside;
  };
  solver::State state = guess;
  bool closed = loops.close(state, weight);
  // From a rough guess the iteration may end early; it is repeated from nearby guesses with prescribed values
  // unchanged.
  constexpr int attempts = 12;
  for (int i = 0; i < attempts && !closed; ++i) {
    state = guess;
    loops.move(state, (weight.array() < 1).select(0.0, moved_by(1)));
    closed = loops.close(state, weight);
  }
  if (!closed) return {};
  loops.evaluate(state);
  RowMatrix G = loops.jacobian();
  // In a singular position rows depend on each other for an instant; a step aside they do not.
  loops.move(state, moved_by(0.03));
  if (loops.close(state, VectorXd::Ones(tree.nv))) {
    loops.evaluate(state);
    G = loops.jacobian();
  }
  return dependent_rows(G, kGeometryTolerance);
}

void drop_rows(Tree& tree, const std::vector<int>& rows) {
  tree.nclosure = 0;
  for (Closure& closure : tree.closures) {
    std::vector<ConstraintRow> kept;
    for (std::size_t i = 0; i < closure.rows.size(); ++i) {
      const int row = closure.first_row + static_cast<int>(i);
      const bool drop = std::binary_search(rows.begin(), rows.end(), row);
      (drop ? closure.dropped : kept).push_back(closure.rows[i]);
    }
    closure.rows = std::move(kept);
    closure.first_row = tree.nclosure;
    tree.nclosure += static_cast<int>(closure.rows.size());
  }
}

}  // namespace hersey::mbd
