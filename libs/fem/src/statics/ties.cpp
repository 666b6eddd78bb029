#include "hersey/fem/ties.h"

#include "mesh/tie_rows.h"

namespace hersey::fem {
namespace {

Eigen::SparseMatrix<double> matrix_of(const std::vector<TieRow>& rows, std::size_t dofs) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (const auto& [dof, coefficient] : rows[r]) entries.emplace_back(static_cast<int>(r), dof, coefficient);
  Eigen::SparseMatrix<double> matrix(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(dofs));
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

TieConstraints tie_constraints(const Mesh& mesh, const std::vector<int>& fixed_dofs) {
  const std::size_t dofs = 3 * mesh.nodes.size();
  std::vector<char> is_fixed(dofs, 0);
  for (const int dof : fixed_dofs) is_fixed[static_cast<std::size_t>(dof)] = 1;
  std::vector<TieRow> rows;
  rows.reserve(mesh.ties.size());
  for (const MeshTie& tie : mesh.ties) {
    TieRow& row = rows.emplace_back();
    for (const TieTerm& term : tie) row[3 * term.node + term.axis] += term.coefficient;
  }
  const EliminatedRows left =
      eliminated(std::move(rows), [&](int dof) { return is_fixed[static_cast<std::size_t>(dof)] == 0; });
  return {matrix_of(left.rows, dofs), left.pivots, matrix_of(left.rest, dofs)};
}

}  // namespace hersey::fem
