#pragma once

#include <Eigen/Dense>
#include <memory>
#include <string>
#include <vector>

#include "hersey/bearing/elastic_surface.h"

namespace hersey::bearing {

/// Response of a surface that deforms to the film at rest: its body is supported at some of its frames, in static
/// equilibrium. The amplitudes of the body's shapes are
///
///     s = C Q + C_W W + s_omega omega^2,
///
/// Q the film's forces on them, W the wrench [tau; f] of the film on the surface's frame, in the frame's axes at its
/// origin, omega the speed at which the body turns about the frame's z-axis (theory manual, bearing.25).
struct SurfaceFlexibility {
  std::shared_ptr<const ElasticSurface> surface;  ///< radial displacement by the amplitudes; never null
  Eigen::MatrixXd by_forces;                      ///< C, shape (amplitudes, amplitudes)
  Eigen::MatrixXd by_wrench;                      ///< C_W, shape (amplitudes, 6)
  Eigen::VectorXd by_spin;                        ///< s_omega, shape (amplitudes)
  /// Rotation of the surface's frame against the supported frame, and against the body's axes, by the amplitudes, in
  /// its own axes, shape (3, amplitudes) [rad].
  Eigen::MatrixXd turn, turn_in_body;
  /// A force through the surface's frame and its reaction on the supported frame act at the displaced positions of
  /// both: the displacement between the two by the amplitudes, (3, amplitudes) [m], and the amplitudes by the moment
  /// that the force has over it, (amplitudes, 3), in the frame's axes.
  Eigen::MatrixXd offset, by_offset_moment;
  std::string body;                       ///< its name
  std::vector<std::string> supported_at;  ///< frames of the body at which it is supported
};

/// Both surfaces of a bearing by itself; a null one is rigid.
struct SteadyElasticity {
  std::shared_ptr<const SurfaceFlexibility> shell, journal;
};

}  // namespace hersey::bearing
