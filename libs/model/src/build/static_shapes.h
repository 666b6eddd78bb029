#pragma once

#include <Eigen/Dense>
#include <memory>
#include <vector>

#include "hersey/bearing/elastic_surface.h"
#include "hersey/model/model.h"

namespace hersey::model {

/// A flexible body at rest: its amplitudes are [rotation; displacement] of every frame but the first against the body's
/// axes, then internal ones. Elastically frames and internal amplitudes are independent of each other.
struct StaticShapes {
  std::vector<Vector3> at;      ///< of each frame, where its wrench acts and its displacement is taken [m]
  Eigen::MatrixXd stiffness;    ///< of the frames, (6 (frames - 1))^2
  Eigen::MatrixXd flexibility;  ///< internal amplitudes by forces on them
  std::shared_ptr<const bearing::ElasticSurface> surface;  ///< by all amplitudes
  Eigen::VectorXd spin_on_frames;  ///< [tau; f] on each frame of turning at 1 rad/s, body's axes, (6 frames)
  Eigen::VectorXd spin;            ///< internal amplitudes by the same
};

/// The shapes that the body has in a run, with those a surface's pressures need; a nodal body answers every pressure.
/// @param surface  of a bearing on the body's frame `frame`, whose z-axis it turns about
/// @throws InputError as build_flexible
[[nodiscard]] StaticShapes static_shapes(const Model& model, const Body& body, const DeformingSurface& surface,
                                         const std::string& frame);

}  // namespace hersey::model
