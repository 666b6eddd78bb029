#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <string>
#include <vector>

#include "hersey/fem/constrained_stiffness.h"
#include "hersey/fem/elastic_body.h"
#include "hersey/fem/interface_frame.h"

namespace hersey::fem {

/// What the frames do to the mesh: nodes that follow a rigid frame, constraints that tie average ones.
struct Interface {
  std::vector<int> fixed_dofs;    ///< degrees of freedom of rigid frames' nodes
  Eigen::MatrixXd prescribed;     ///< (3 n, 6 frames): their displacement for unit motions of the frames
  Eigen::SparseMatrix<double> C;  ///< (6 average frames and ties of the mesh, 3 n)
  Eigen::MatrixXd motion;         ///< (rows of C, 6 frames): C u for unit motions of the frames; of ties zero
  Eigen::MatrixXd
      tie_residual;  ///< (rows, 6 frames): what unit motions leave of ties between fixed_dofs nodes, (elastic.31)
};

/// Empty if the frames can be used; otherwise what is wrong with which.
[[nodiscard]] std::string fault_of(const Mesh& mesh, const std::vector<InterfaceFrame>& frames);

[[nodiscard]] Interface interface_of(const Mesh& mesh, const std::vector<InterfaceFrame>& frames);

/// Displacements for unit motions of the frames, (3 n, 6 frames). @pre `stiffness` is factorised
[[nodiscard]] Eigen::MatrixXd constraint_modes(const ElasticBody& body, const Interface& interface,
                                               const ConstrainedStiffness& stiffness);

}  // namespace hersey::fem
