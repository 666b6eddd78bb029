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

/// What keeps a mesh still while no frame moves: degrees of freedom that rigid frames hold, and constraints C u = 0 of
/// the averages and of the mesh's ties, (6 average frames and ties, 3 n).
struct FrameSupports {
  std::vector<int> held;
  Eigen::SparseMatrix<double> C;
};
/// Of these frames on this mesh.
[[nodiscard]] FrameSupports frame_supports(const Mesh& mesh, const std::vector<InterfaceFrame>& frames);

/// An elastic body in few coordinates: u = Phi q, (elastic.14).
///
/// q holds six coordinates [theta; d] for each frame, in turn, then the internal ones. Coordinates of frames are
/// displacements from the undeformed body, in the mesh's axes; a rigid motion of all frames is one of the whole body,
/// exactly.
struct ReducedBody {
  std::vector<InterfaceFrame> frames;
  std::vector<Vector3> nodes;      ///< of the mesh, undeformed [m]
  Eigen::SparseMatrix<double> m;   ///< consistent mass of the mesh, M = m (x) I3 [kg]
  Eigen::MatrixXd Phi;             ///< (3 n, r)
  Eigen::MatrixXd K;               ///< (r, r); between frames and internal coordinates zero
  Eigen::MatrixXd M;               ///< (r, r); internal coordinates have the unit matrix
  Eigen::VectorXd internal_omega;  ///< of the internal coordinates alone, all frames at rest, ascending [rad/s]
  /// For each load of the options: the share of its static strain energy, all frames at rest, that the fixed-interface
  /// modes alone would miss. Near 1: that many modes say nothing about this load.
  Eigen::VectorXd energy_missed;

  std::vector<StaticError> static_errors;  ///< of the surfaces of the options
  std::vector<FilmModes> film_modes;       ///< of film surfaces, then of contact faces; files do not keep them
  /// Elements, sets and surfaces, as far as they are known; its nodes are `nodes`.
  Mesh mesh;
  std::vector<SolidMaterial> materials;  ///< of the elements; none: unknown

  /// Coordinates, r.
  [[nodiscard]] Eigen::Index size() const { return Phi.cols(); }
  /// Place of the first internal coordinate in q.
  [[nodiscard]] Eigen::Index internal_first() const { return 6 * static_cast<Eigen::Index>(frames.size()); }
};

/// A reduced body; unsolved, the message names the frame where one is to blame.
struct [[nodiscard]] Reduction : Outcome {
  ReducedBody body;
};

/// Craig-Bampton reduction: static displacements for unit motions of each frame, fixed-interface modes, static
/// displacements for loads and film modes, all but the first orthonormalised together. Costs two factorisations, and
/// one solution per column of Phi.
/// @see Craig, Bampton (1968), AIAA J. 6, 1313; Cardona (2000) for `average`. @verified_by reduction_test.cpp
[[nodiscard]] Reduction reduce(const ElasticBody& body, const std::vector<InterfaceFrame>& frames,
                               const ReductionOptions& options = {});

}  // namespace hersey::fem
