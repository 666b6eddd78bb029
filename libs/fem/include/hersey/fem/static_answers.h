#pragma once

#include <Eigen/Dense>
#include <vector>

#include "hersey/core/outcome.h"
#include "hersey/fem/elastic_body.h"
#include "hersey/fem/film_surface.h"
#include "hersey/fem/reduction.h"

namespace hersey::fem {

/// What a mesh answers at rest to motions of its frames, to every pressure on one film surface and to spin: the static
/// condensation of all its degrees of freedom to frames and surface (theory manual, bearing.23). Unsolved, the message
/// names the frame where one is to blame.
struct [[nodiscard]] StaticAnswers : Outcome {
  Eigen::MatrixXd shapes;      ///< displacements for unit [rotation; displacement] of each frame, (3 n, 6 frames)
  Eigen::MatrixXd stiffness;   ///< of the frames, (6 frames, 6 frames)
  Eigen::MatrixXd compliance;  ///< G^-1 T^T K^-1 T G^-1, frames at rest: displacement by forces on the functions [m/N]
  Eigen::VectorXd spin_on_frames;  ///< forces on the frames of turning at 1 rad/s, (6 frames) [N s^2, N m s^2]
  Eigen::VectorXd spin;            ///< displacement of the surface by the same, frames at rest, (functions) [m s^2]
};

/// @param axis    unit vector about which the body turns, through `centre`, in the mesh's axes
/// @cost one factorisation, and one solution per function of the surface and frame's coordinate
/// @verified_by static_answers_test.cpp
[[nodiscard]] StaticAnswers static_answers(const ElasticBody& body, const std::vector<InterfaceFrame>& frames,
                                           const SurfaceMap& surface, const Vector3& centre, const Vector3& axis);

}  // namespace hersey::fem
