#pragma once

#include <Eigen/Dense>
#include <vector>

#include "hersey/core/outcome.h"
#include "hersey/fem/elastic_body.h"
#include "hersey/fem/film_surface.h"
#include "hersey/fem/reduction.h"

namespace hersey::fem {

/// Static condensation of all degrees of freedom of a mesh to its frames and one film surface: displacements and forces
/// under motions of the frames, pressures on the surface, and spin (theory manual, bearing.23). Where it is not solved
/// the message names the frame that causes the failure, if there is one.
struct [[nodiscard]] StaticAnswers : Outcome {
  Eigen::MatrixXd shapes;      ///< displacements for unit [rotation; displacement] of each frame, (3 n, 6 frames)
  Eigen::MatrixXd stiffness;   ///< stiffness of the frames, (6 frames, 6 frames)
  Eigen::MatrixXd compliance;  ///< G^-1 T^T K^-1 T G^-1, frames at rest: displacement by forces on the functions [m/N]
  Eigen::VectorXd spin_on_frames;  ///< forces on the frames under rotation at 1 rad/s, (6 frames) [N s^2, N m s^2]
  Eigen::VectorXd spin;  ///< displacement of the surface under that rotation, frames at rest, (functions) [m s^2]
};

/// Computes the static condensation of `body`.
/// @param axis    unit vector about which the body rotates, through `centre`, in the mesh's axes
/// @cost one factorisation, and one solution per function of the surface and frame's coordinate
/// @verified_by static_answers_test.cpp
[[nodiscard]] StaticAnswers static_answers(const ElasticBody& body, const std::vector<InterfaceFrame>& frames,
                                           const SurfaceMap& surface, const Vector3& centre, const Vector3& axis);

}  // namespace hersey::fem
