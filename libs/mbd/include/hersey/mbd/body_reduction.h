#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "hersey/fem/elastic_body.h"
#include "hersey/mbd/modal_body.h"

namespace hersey::mbd {

/// How a frame holds a set of nodes.
enum class Connection {
  rigid,    ///< the set follows the frame as a rigid piece
  average,  ///< the frame follows the set's mean motion; a wrench on it spreads over the set, which deforms freely
};

/// A frame of an elastic body and the nodes it stands on.
struct InterfaceSpec {
  std::string name;
  Pose X_BF;               ///< in the mesh's axes, undeformed
  std::vector<int> nodes;  ///< places in the mesh; at least three that do not lie on a line
  Connection connection = Connection::rigid;
};

struct ReductionOptions {
  int modes = 10;                ///< motions with all frames held, those of lowest frequency
  double highest = 0;            ///< leave out modes above this frequency [Hz]; 0: no limit
  double damping_mass = 0;       ///< damping = damping_mass M + damping_stiffness K [1/s]
  double damping_stiffness = 0;  ///< [s]
};

/// A body in shapes. The body's axes are those of the mesh; they move with frame 0.
struct BodyReduction {
  ModalBodyData data;
  Eigen::MatrixXd shapes;           ///< displacements, node after node, shape (3 nodes, shapes)
  std::vector<double> frequencies;  ///< of the modes with all frames held [Hz]
};

/// Craig-Bampton shapes of `body`: the static answers to a unit rotation and displacement of each interface but the
/// first, the others held, and the lowest modes with all interfaces held (theory manual eq. (flexible-bodies.14) to
/// (flexible-bodies.16)). Modes are scaled to a largest displacement of 1 m, so that their coordinates are lengths.
/// @throws InputError if interfaces share nodes, stand on fewer than three nodes or on a line, or leave parts of the
///         mesh unheld; if the mesh does not fit into memory.
/// @cost one factorisation; solves as many as 3 times the shapes.
[[nodiscard]] BodyReduction reduce(const fem::ElasticBody& body, const std::vector<InterfaceSpec>& interfaces,
                                   const ReductionOptions& options);

/// Weights by which a frame takes the mean motion of its nodes: motion [theta; u] = C^T u, shape (3 nodes of the set,
/// 6). Least squares: of all motions of a rigid piece the one nearest to the nodes' displacements.
[[nodiscard]] Eigen::MatrixXd mean_motion(const fem::Mesh& mesh, const InterfaceSpec& interface);

/// Displacements of the set's nodes in the motions [theta; u] of the frame, shape (3 nodes of the set, 6).
[[nodiscard]] Eigen::MatrixXd rigid_piece(const fem::Mesh& mesh, const InterfaceSpec& interface);

}  // namespace hersey::mbd
