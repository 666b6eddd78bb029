#include "hersey/fem/imported_body.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "hersey/core/input_error.h"

namespace hersey::fem {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

constexpr double kEqual = 1e-6;  // of the norm: other programs write six figures or more
constexpr double kRigid = 1e-5;  // force of a rigid motion by that of one node moved alone

[[noreturn]] void fail(const std::string& name, std::string found, std::string expected, std::string suggestion = {}) {
  throw InputError(Fault{{name, 0, 0}, "", std::move(found), std::move(expected), std::move(suggestion)});
}

void require_symmetric(const Sparse& matrix, Eigen::Index size, const char* what, const std::string& name) {
  if (matrix.rows() != size || matrix.cols() != size)
    fail(name, fmt::format("a {} matrix of {} x {}", what, matrix.rows(), matrix.cols()),
         fmt::format("{0} x {0} for the mesh's nodes", size), "no degrees of freedom removed, every node of the mesh");
  const Sparse transposed = matrix.transpose();
  if (!((matrix - transposed).norm() <= kEqual * matrix.norm()))
    fail(name, fmt::format("a {} matrix that is not symmetric", what), "a symmetric matrix",
         "a file of one triangle says 'symmetric' in its first line");
}

// m of M = m (x) I3: the part of every third row and column, equal for x, y and z and alone.
Sparse scalar_mass(const Sparse& M, Eigen::Index nodes, const std::string& name) {
  std::vector<Eigen::Triplet<double>> entries;
  double off = 0, largest = 0;
  for (Eigen::Index column = 0; column < M.outerSize(); ++column)
    for (Sparse::InnerIterator entry(M, column); entry; ++entry) {
      if (entry.row() % 3 != column % 3) {
        off = std::max(off, std::abs(entry.value()));
        continue;
      }
      largest = std::max(largest, std::abs(entry.value()));
      entries.emplace_back(static_cast<int>(entry.row() / 3), static_cast<int>(column / 3), entry.value() / 3);
    }
  Sparse m(nodes, nodes);
  m.setFromTriplets(entries.begin(), entries.end());
  for (Eigen::Index column = 0; column < M.outerSize(); ++column)
    for (Sparse::InnerIterator entry(M, column); entry; ++entry)
      if (entry.row() % 3 == column % 3)
        off = std::max(off, std::abs(entry.value() - m.coeff(entry.row() / 3, column / 3)));
  if (off > kEqual * largest)
    fail(name, "a mass matrix that differs between x, y and z", "the same mass in all three directions",
         "solid elements only, degrees of freedom ordered x, y, z of one node after the other");
  return m;
}

void require_free(const ElasticBody& body, const std::string& name) {
  const Eigen::MatrixXd motions = rigid_motions(body.mesh, body.centre);
  const Eigen::VectorXd stiffness = body.K.diagonal();
  for (Eigen::Index c = 0; c < motions.cols(); ++c) {
    const double force = (body.K * motions.col(c)).norm();
    const double alone = stiffness.cwiseProduct(motions.col(c)).norm();
    if (force <= kRigid * alone) continue;
    fail(name,
         fmt::format("a stiffness that resists {} {} rigidly", c < 3 ? "turning about" : "moving along", "xyz"[c % 3]),
         "the stiffness of the free body on the mesh's nodes in metres",
         "export it without supports, with the nodes in the mesh's order");
  }
}

}  // namespace

ElasticBody import_body(Mesh mesh, const Sparse& K, const Sparse& M, const std::string& name) {
  const auto nodes = static_cast<Eigen::Index>(mesh.nodes.size());
  require_symmetric(K, 3 * nodes, "stiffness", name);
  const bool is_scalar = M.rows() == nodes;
  require_symmetric(M, is_scalar ? nodes : 3 * nodes, "mass", name);
  ElasticBody body;
  body.mesh = std::move(mesh);
  body.K = K;
  body.m = is_scalar ? M : scalar_mass(M, nodes, name);
  if (!(body.m.sum() > 0)) fail(name, "a mass that adds up to nothing", "a mass > 0", "give the material a density");
  find_inertia(body);
  require_free(body, name);
  return body;
}

}  // namespace hersey::fem
