#pragma once

#include <string>
#include <vector>

#include "hersey/core/outcome.h"
#include "hersey/fem/elastic_body.h"
#include "hersey/fem/film_modes.h"
#include "hersey/fem/frame_motion.h"
#include "hersey/fem/interface_frame.h"
#include "hersey/fem/reduction_options.h"

namespace hersey::fem {

/// Constraints of a mesh while no frame moves: degrees of freedom fixed by rigid frames, and constraints C u = 0 of the
/// average frames and of the mesh's ties, (6 average frames and ties, 3 n).
struct FrameSupports {
  std::vector<int> fixed_dofs;
  Eigen::SparseMatrix<double> C;
};
/// Returns the constraints of `frames` on `mesh`.
[[nodiscard]] FrameSupports frame_supports(const Mesh& mesh, const std::vector<InterfaceFrame>& frames);

/// Elastic body in few coordinates: u = Phi q, (elastic.14).
///
/// q holds six coordinates [theta; d] for each frame, frame after frame, then the internal coordinates. Coordinates of
/// frames are displacements from the undeformed body, in the mesh's axes; a rigid motion of all frames is exactly a
/// rigid motion of the whole body.
struct ReducedBody {
  std::vector<InterfaceFrame> frames;
  std::vector<Vector3> nodes;     ///< undeformed positions of the mesh's nodes [m]
  Eigen::SparseMatrix<double> m;  ///< consistent mass of the mesh, M = m (x) I3 [kg]
  Eigen::MatrixXd Phi;            ///< (3 n, r)
  Eigen::MatrixXd K;              ///< reduced stiffness (r, r); zero between frames and internal coordinates
  Eigen::MatrixXd M;              ///< reduced mass (r, r); the unit matrix on internal coordinates
  Eigen::VectorXd
      internal_omega;  ///< angular frequencies of the internal coordinates alone, all frames at rest, ascending [rad/s]
  /// For each load of the options: the share of its static strain energy, all frames at rest, that the fixed-interface
  /// modes alone would miss. Near 1, these modes do not represent the load.
  Eigen::VectorXd energy_missed;

  std::vector<StaticError> static_errors;  ///< errors on the surfaces of the options
  std::vector<FilmModes> film_modes;       ///< modes of film surfaces, then of contact faces; not stored in files
  /// Elements, sets and surfaces, as far as they are known; the mesh's nodes are `nodes`.
  Mesh mesh;
  std::vector<SolidMaterial> materials;  ///< materials of the elements; none: unknown

  /// Number of coordinates, r.
  [[nodiscard]] Eigen::Index size() const { return Phi.cols(); }
  /// Index of the first internal coordinate in q.
  [[nodiscard]] Eigen::Index internal_first() const { return 6 * static_cast<Eigen::Index>(frames.size()); }
};

/// A reduced body. Where it is not solved the message names the frame that causes the failure, if there is one.
struct [[nodiscard]] Reduction : Outcome {
  ReducedBody body;
};

/// Reduces a body after Craig and Bampton: static displacements for unit motions of each frame, fixed-interface modes,
/// static displacements for loads, and film modes. All but the first group are orthonormalised together. The cost is
/// two factorisations and one solution per column of Phi.
/// @see Craig, Bampton (1968), AIAA J. 6, 1313; Cardona (2000) for `average`. @verified_by reduction_test.cpp
[[nodiscard]] Reduction reduce(const ElasticBody& body, const std::vector<InterfaceFrame>& frames,
                               const ReductionOptions& options = {});

}  // namespace hersey::fem
