#include "hersey/fem/constrained_stiffness.h"

#include <fmt/format.h>

#include "hersey/core/contract.h"
#include "hersey/fem/ties.h"

namespace hersey::fem {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Lower triangle of A on the unknowns with free_index[i] >= 0; `size` counts them and the multipliers, which come
/// last.
SparseMatrix lower_part(const SparseMatrix& A, const std::vector<int>& free_index, Eigen::Index size) {
  SparseMatrix part(size, size);
  part.reserve(A.nonZeros() / 2 + A.cols());
  for (Eigen::Index j = 0; j < A.outerSize(); ++j) {
    const int column = free_index[static_cast<std::size_t>(j)];
    if (column < 0) continue;
    part.startVec(column);
    for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry) {
      const int row = free_index[static_cast<std::size_t>(entry.row())];
      if (row >= column) part.insertBack(row, column) = entry.value();
    }
  }
  part.finalize();
  part.makeCompressed();
  return part;
}

/// C on the free degrees of freedom, in the rows of the multipliers.
SparseMatrix constraint_rows(const SparseMatrix& C, const std::vector<int>& free_index, Eigen::Index size) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(C.nonZeros()));
  for (Eigen::Index j = 0; j < C.outerSize(); ++j)
    for (SparseMatrix::InnerIterator entry(C, j); entry; ++entry)
      if (const int column = free_index[static_cast<std::size_t>(j)]; column >= 0)
        entries.emplace_back(static_cast<int>(size - C.rows() + entry.row()), column, entry.value());
  SparseMatrix rows(size, size);
  rows.setFromTriplets(entries.begin(), entries.end());
  return rows;
}

/// Describes the motions that a singular stiffness leaves free: rigid ones that no support resists, or else those of a
/// part.
std::string unsupported_motions(const ElasticBody& body, const std::vector<int>& fixed_dofs) {
  Eigen::MatrixXd blocked_motions = rigid_motions(body.mesh, body.centre);
  blocked_motions = (blocked_motions * blocked_motions.colwise().norm().cwiseInverse().asDiagonal()).eval();
  blocked_motions = Eigen::MatrixXd(blocked_motions(fixed_dofs, Eigen::all));
  Eigen::FullPivLU<Eigen::MatrixXd> lu(Eigen::MatrixXd(blocked_motions.transpose() * blocked_motions));
  lu.setThreshold(1e-9);
  const Eigen::Index blocked = fixed_dofs.empty() ? 0 : lu.rank();
  if (blocked == 6) return "a part of the body is not connected to the fixed nodes";
  return fmt::format("the body is not supported: {} of its 6 rigid motions meet no resistance", 6 - blocked);
}

/// Forces on the supports among the forces that K u - f leaves. The forces of ties are computed from their pivots, on
/// which no support and no other tie acts.
Eigen::MatrixXd without_ties(const TieConstraints& ties, Eigen::MatrixXd unbalanced) {
  if (ties.C.rows() == 0) return unbalanced;
  Eigen::MatrixXd force(ties.C.rows(), unbalanced.cols());
  for (Eigen::Index k = 0; k < force.rows(); ++k) {
    const int pivot = ties.pivots[static_cast<std::size_t>(k)];
    force.row(k) = unbalanced.row(pivot) / ties.C.coeff(k, pivot);
  }
  return unbalanced - ties.C.transpose() * force;
}

}  // namespace

std::vector<int> dofs_of(const std::vector<int>& nodes, const std::array<bool, 3>& axes) {
  std::vector<int> dofs;
  dofs.reserve(3 * nodes.size());
  for (const int node : nodes)
    for (int i = 0; i < 3; ++i)
      if (axes[static_cast<std::size_t>(i)]) dofs.push_back(3 * node + i);
  return dofs;
}

SparseMatrix mass_matrix(const SparseMatrix& m) {
  SparseMatrix M(3 * m.rows(), 3 * m.cols());
  M.reserve(3 * m.nonZeros());
  for (Eigen::Index b = 0; b < m.outerSize(); ++b)
    for (int i = 0; i < 3; ++i) {
      M.startVec(3 * b + i);
      for (SparseMatrix::InnerIterator entry(m, b); entry; ++entry)
        M.insertBack(3 * entry.row() + i, 3 * b + i) = entry.value();
    }
  M.finalize();
  return M;
}

ConstrainedStiffness::ConstrainedStiffness(const SparseMatrix& K, const SparseMatrix& m,
                                           const std::vector<int>& fixed_dofs, const SparseMatrix& C)
    : free_index_(static_cast<std::size_t>(K.rows()), 0), constraints_(C.rows()) {
  HERSEY_REQUIRE(K.rows() == 3 * m.rows(), "three degrees of freedom per node");
  HERSEY_REQUIRE(C.rows() == 0 || C.cols() == K.cols(), "constraints are on the degrees of freedom");
  for (const int dof : fixed_dofs) {
    HERSEY_REQUIRE(0 <= dof && dof < K.rows(), "supports are among the degrees of freedom");
    free_index_[static_cast<std::size_t>(dof)] = -1;
  }
  for (std::size_t i = 0; i < free_index_.size(); ++i)
    if (free_index_[i] == 0) {
      free_index_[i] = static_cast<int>(free_.size());
      free_.push_back(static_cast<int>(i));
    }
  const auto total = static_cast<Eigen::Index>(free_.size()) + constraints_;
  M_free_ = lower_part(mass_matrix(m), free_index_, total);
  C_free_ = constraint_rows(C, free_index_, total);
  replace(K);
}

void ConstrainedStiffness::replace(const SparseMatrix& K) {
  HERSEY_REQUIRE(K.rows() == size(), "one row per degree of freedom");
  K_free_ = lower_part(K, free_index_, M_free_.rows());
}

SparseMatrix ConstrainedStiffness::shifted(double shift) const {
  // Zeros are stored: one pattern for every shift.
  SparseMatrix A = K_free_ - shift * M_free_;
  if (constraints_ > 0) A = (A + C_free_).eval();
  return A;
}

void ConstrainedStiffness::analyse() {
  if (analysed_) return;
  factor_.analyse(shifted(0));
  analysed_ = true;
}

double ConstrainedStiffness::memory_estimate() {
  if (free_.empty()) return 0;
  analyse();
  return factor_.memory_estimate();
}

solver::FactorSummary ConstrainedStiffness::factorise(double shift) {
  if (free_.empty()) return {{solver::FactorStatus::factorised}};
  analyse();
  return factor_.factorise(shifted(shift));
}

Eigen::MatrixXd ConstrainedStiffness::solve(const Eigen::MatrixXd& f) const {
  return solve(f, Eigen::MatrixXd::Zero(constraints_, f.cols()));
}

Eigen::MatrixXd ConstrainedStiffness::solve(const Eigen::MatrixXd& f, const Eigen::MatrixXd& d) const {
  HERSEY_REQUIRE(f.rows() == size(), "one row per degree of freedom");
  HERSEY_REQUIRE(d.rows() == constraints_ && d.cols() == f.cols(), "one row per constraint");
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(size(), f.cols());
  if (free_.empty()) return u;
  const auto free = static_cast<Eigen::Index>(free_.size());
  Eigen::MatrixXd x(free + constraints_, f.cols());
  x.topRows(free) = f(free_, Eigen::all);
  x.bottomRows(constraints_) = d;
  factor_.solve(x);
  u(free_, Eigen::all) = x.topRows(free);
  return u;
}

StaticSolution solve_static(const ElasticBody& body, const std::vector<Support>& supports, const Eigen::MatrixXd& f) {
  HERSEY_REQUIRE(f.rows() == body.size(), "one force per degree of freedom");
  std::vector<int> fixed_dofs;
  Eigen::VectorXd prescribed = Eigen::VectorXd::Zero(body.size());
  fixed_dofs.reserve(supports.size());
  for (const Support& support : supports) {
    fixed_dofs.push_back(support.dof);
    prescribed[support.dof] = support.displacement;
  }
  const TieConstraints ties = tie_constraints(body.mesh, fixed_dofs);
  ConstrainedStiffness stiffness(body.K, body.m, fixed_dofs, ties.C);
  const solver::FactorSummary summary = stiffness.factorise();
  if (summary.status == solver::FactorStatus::singular) {
    auto loose = no_answer<StaticSolution>(unsupported_motions(body, fixed_dofs));
    loose.is_supported = false;
    return loose;
  }
  if (!summary.solved()) return no_answer<StaticSolution>(summary.message);
  StaticSolution solution;
  solution.set_solved(true);
  const Eigen::VectorXd forces_of_supports = body.K * prescribed;
  const Eigen::VectorXd of_supports = ties.C * prescribed;
  const Eigen::MatrixXd d = (-of_supports).replicate(1, f.cols());
  solution.u = stiffness.solve(f.colwise() - forces_of_supports, d).colwise() + prescribed;
  const Eigen::MatrixXd unbalanced = without_ties(ties, body.K * solution.u - f);
  solution.reaction = Eigen::MatrixXd::Zero(f.rows(), f.cols());
  for (const int dof : fixed_dofs) solution.reaction.row(dof) = unbalanced.row(dof);
  return solution;
}

}  // namespace hersey::fem
