#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <string>
#include <vector>

#include "hersey/fem/constrained_stiffness.h"
#include "hersey/fem/elastic_body.h"
#include "hersey/fem/interface_frame.h"

namespace hersey::fem {

/// Constraints of the mesh by its frames: nodes that follow a rigid frame, constraints that tie average ones.
struct Interface {
  std::vector<int> fixed_dofs;    ///< degrees of freedom of rigid frames' nodes
  Eigen::MatrixXd prescribed;     ///< (3 n, 6 frames): displacement of these nodes for unit motions of the frames
  Eigen::SparseMatrix<double> C;  ///< (6 average frames and ties of the mesh, 3 n)
  Eigen::MatrixXd motion;         ///< (rows of C, 6 frames): C u for unit motions of the frames; of ties zero
  Eigen::MatrixXd tie_residual;   ///< (rows, 6 frames): violation of ties between fixed nodes by unit motions of the
                                  ///< frames, (elastic.31)
};

/// Returns an empty text if the frames can be used; otherwise the faulty frame and its fault.
[[nodiscard]] std::string fault_of(const Mesh& mesh, const std::vector<InterfaceFrame>& frames);

[[nodiscard]] Interface interface_of(const Mesh& mesh, const std::vector<InterfaceFrame>& frames);

/// Returns the displacements for unit motions of the frames, (3 n, 6 frames). @pre `stiffness` is factorised
[[nodiscard]] Eigen::MatrixXd constraint_modes(const ElasticBody& body, const Interface& interface,
                                               const ConstrainedStiffness& stiffness);

}  // namespace hersey::fem
