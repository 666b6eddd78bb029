#include "solve/multigrid_solver.h"

#include <algorithm>
#include <cmath>

#include "hersey/core/contract.h"

namespace hersey::film {
namespace {

constexpr int centre = 0, west = 1, east = 2, south = 3, north = 4;

}  // namespace

MultigridSolver::MultigridSolver(int n_phi, int n_z, std::span<const int> column_start, std::span<const int> row_index)
    : n_phi_(n_phi), n_z_(n_z), multigrid_(n_phi, n_z), rhs_(n_phi * n_z), answer_(n_phi * n_z) {
  const int n = n_phi * n_z;
  slot_.reserve(row_index.size());
  for (int column = 0; column < n; ++column) {
    for (int k = column_start[column]; k < column_start[column + 1]; ++k) {
      const int row = row_index[k], lines = (column / n_z - row / n_z + n_phi) % n_phi;
      const int entry = column == row       ? centre
                        : column == row - 1 ? south
                        : column == row + 1 ? north
                        : lines == 1        ? east
                                            : west;
      HERSEY_REQUIRE(entry != west || lines == n_phi - 1, "a five-point pattern");
      slot_.push_back(5 * row + entry);
    }
  }
  rows_.assign(static_cast<std::size_t>(n), {});
  active_.resize(static_cast<std::size_t>(n));
  matrix_ = [this](const Eigen::VectorXd& x, Eigen::VectorXd& y) { multiply(x, y); };
  preconditioner_ = [this](const Eigen::VectorXd& b, Eigen::VectorXd& x) { precondition(b, x); };
}

// Rows that contain only their own unknown are solved by the first relaxation: coarser grids leave them out.
bool MultigridSolver::setup(std::span<const double> values, bool ascending) {
  for (std::size_t k = 0; k < slot_.size(); ++k) rows_[slot_[k] / 5][slot_[k] % 5] = values[k];
  // In its own unit the matrix fits the single precision of multigrid; a factor of the preconditioner has no effect.
  double largest = 0;
  for (const Row& row : rows_) largest = std::max(largest, std::abs(row[centre]));
  const auto entry = [largest](double value) { return static_cast<Real>(value / largest); };
  LineOperator& A = multigrid_.finest();
  for (int node = 0; node < A.size(); ++node) {
    const Row& row = rows_[node];
    const Real none = 0;
    A.row(node) = {none, entry(row[west]), none, entry(row[south]), entry(row[centre]), entry(row[north]),
                   none, entry(row[east]), none};
    active_[node] = row[west] != 0 || row[east] != 0 || row[south] != 0 || row[north] != 0;
  }
  return multigrid_.setup(active_, ascending);
}

void MultigridSolver::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  y.resize(x.size());
  const double* along = x.data();
  for (int i = 0; i < n_phi_; ++i) {
    const int at = i * n_z_, last = at + n_z_ - 1;
    const int before = (i == 0 ? n_phi_ - 1 : i - 1) * n_z_ - at, after = (i + 1 == n_phi_ ? 0 : i + 1) * n_z_ - at;
    const auto around = [&](int k) {
      return rows_[k][centre] * along[k] + rows_[k][west] * along[k + before] + rows_[k][east] * along[k + after];
    };
    y[at] = around(at) + rows_[at][north] * along[at + 1];
    for (int k = at + 1; k < last; ++k) {
      y[k] = around(k) + rows_[k][south] * along[k - 1] + rows_[k][north] * along[k + 1];
    }
    y[last] = around(last) + rows_[last][south] * along[last - 1];
  }
}

void MultigridSolver::precondition(const Eigen::VectorXd& b, Eigen::VectorXd& x) {
  std::transform(b.begin(), b.end(), rhs_.data(), [](double value) { return static_cast<Real>(value); });
  multigrid_.cycle(rhs_, answer_);
  x.resize(b.size());
  std::copy(answer_.data(), answer_.data() + b.size(), x.begin());
}

solver::GmresSummary MultigridSolver::solve(const Eigen::VectorXd& b, const solver::GmresOptions& options,
                                            Eigen::VectorXd& x) {
  return gmres_.solve(matrix_, preconditioner_, b, options, x);
}

}  // namespace hersey::film
