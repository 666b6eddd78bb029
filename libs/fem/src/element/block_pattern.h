#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "hersey/fem/mesh.h"
#include "hersey/fem/solid_element.h"

namespace hersey::fem {

/// Pattern of nodes that share an element, and the positions of their 3 x 3 blocks in a compressed matrix of 3 n
/// columns.
class BlockPattern {
 public:
  explicit BlockPattern(const Mesh& mesh);

  [[nodiscard]] Eigen::SparseMatrix<double> scalar_matrix() const;  ///< (n, n), zeros stored
  [[nodiscard]] Eigen::SparseMatrix<double> vector_matrix() const;  ///< (3 n, 3 n), zeros stored

  /// Adds an element's matrix (nodes, nodes) or (3 nodes, 3 nodes) to one made here.
  void add_scalar(const Mesh& mesh, const Element& element, const ElementMatrix& matrix,
                  Eigen::SparseMatrix<double>& sum) const;
  void add_vector(const Mesh& mesh, const Element& element, const ElementMatrix& matrix,
                  Eigen::SparseMatrix<double>& sum) const;

 private:
  [[nodiscard]] int block_index(int row, int column) const;  ///< index of `row` among the neighbours of `column`

  std::vector<int> start_;      ///< (n + 1)
  std::vector<int> neighbour_;  ///< ascending for each node, itself included
};

}  // namespace hersey::fem
