#include "element/block_pattern.h"

#include <algorithm>
#include <span>

namespace hersey::fem {
namespace {

/// The elements around each node: `elements[start[a] .. start[a + 1])`.
struct Stars {
  std::vector<int> start, elements;
};

Stars stars(const Mesh& mesh) {
  Stars s;
  s.start.assign(mesh.nodes.size() + 1, 0);
  for (const Element& e : mesh.elements)
    for (int k = 0; k < node_count(e.type); ++k) ++s.start[static_cast<std::size_t>(mesh.nodes_of(e)[k]) + 1];
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) s.start[a + 1] += s.start[a];
  s.elements.resize(static_cast<std::size_t>(s.start.back()));
  std::vector<int> next(s.start.begin(), s.start.end() - 1);
  for (std::size_t i = 0; i < mesh.elements.size(); ++i) {
    const Element& e = mesh.elements[i];
    for (int k = 0; k < node_count(e.type); ++k)
      s.elements[static_cast<std::size_t>(next[static_cast<std::size_t>(mesh.nodes_of(e)[k])]++)] = static_cast<int>(i);
  }
  return s;
}

}  // namespace

BlockPattern::BlockPattern(const Mesh& mesh) {
  const Stars star = stars(mesh);
  std::vector<int> around;
  start_.assign(1, 0);
  start_.reserve(mesh.nodes.size() + 1);
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
    around.clear();
    for (int i = star.start[a]; i < star.start[a + 1]; ++i) {
      const Element& e = mesh.elements[static_cast<std::size_t>(star.elements[static_cast<std::size_t>(i)])];
      around.insert(around.end(), mesh.nodes_of(e), mesh.nodes_of(e) + node_count(e.type));
    }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    neighbour_.insert(neighbour_.end(), around.begin(), around.end());
    start_.push_back(static_cast<int>(neighbour_.size()));
  }
}

Eigen::SparseMatrix<double> BlockPattern::scalar_matrix() const {
  const auto n = static_cast<Eigen::Index>(start_.size()) - 1;
  Eigen::SparseMatrix<double> A(n, n);
  A.resizeNonZeros(static_cast<Eigen::Index>(neighbour_.size()));
  std::copy(start_.begin(), start_.end(), A.outerIndexPtr());
  std::copy(neighbour_.begin(), neighbour_.end(), A.innerIndexPtr());
  std::fill_n(A.valuePtr(), A.nonZeros(), 0.0);
  return A;
}

Eigen::SparseMatrix<double> BlockPattern::vector_matrix() const {
  const auto n = static_cast<int>(start_.size()) - 1;
  Eigen::SparseMatrix<double> A(3 * n, 3 * n);
  A.resizeNonZeros(9 * static_cast<Eigen::Index>(neighbour_.size()));
  int* row = A.innerIndexPtr();
  int end = 0;
  for (int b = 0; b < n; ++b) {
    const std::span<const int> rows(neighbour_.data() + start_[static_cast<std::size_t>(b)],
                                    neighbour_.data() + start_[static_cast<std::size_t>(b) + 1]);
    for (int j = 0; j < 3; ++j) {
      A.outerIndexPtr()[3 * b + j] = end;
      for (const int a : rows)
        for (int i = 0; i < 3; ++i) row[end++] = 3 * a + i;
    }
  }
  A.outerIndexPtr()[3 * n] = end;
  std::fill_n(A.valuePtr(), A.nonZeros(), 0.0);
  return A;
}

int BlockPattern::block_index(int row, int column) const {
  const auto first = neighbour_.begin() + start_[static_cast<std::size_t>(column)];
  const auto last = neighbour_.begin() + start_[static_cast<std::size_t>(column) + 1];
  return static_cast<int>(std::lower_bound(first, last, row) - first);
}

void BlockPattern::add_scalar(const Mesh& mesh, const Element& element, const ElementMatrix& matrix,
                              Eigen::SparseMatrix<double>& sum) const {
  const int* node = mesh.nodes_of(element);
  const int n = node_count(element.type);
  for (int b = 0; b < n; ++b) {
    double* column = sum.valuePtr() + start_[static_cast<std::size_t>(node[b])];
    for (int a = 0; a < n; ++a) column[block_index(node[a], node[b])] += matrix(a, b);
  }
}

void BlockPattern::add_vector(const Mesh& mesh, const Element& element, const ElementMatrix& matrix,
                              Eigen::SparseMatrix<double>& sum) const {
  const int* node = mesh.nodes_of(element);
  const int n = node_count(element.type);
  for (int b = 0; b < n; ++b) {
    const auto column = static_cast<std::size_t>(node[b]);
    const int height = 3 * (start_[column + 1] - start_[column]);
    double* block = sum.valuePtr() + 9 * static_cast<Eigen::Index>(start_[column]);
    for (int a = 0; a < n; ++a) {
      double* at = block + 3 * block_index(node[a], node[b]);
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) at[j * height + i] += matrix(3 * a + i, 3 * b + j);
    }
  }
}

}  // namespace hersey::fem
