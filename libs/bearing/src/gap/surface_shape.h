#pragma once

#include <Eigen/Dense>
#include <vector>

#include "hersey/bearing/gap_kinematics.h"
#include "hersey/core/archive.h"
#include "hersey/film/film_model.h"
#include "hersey/film/film_response.h"
#include "hersey/mbd/two_body_force.h"

namespace hersey::bearing {

/// A cause that moves the surfaces of a film in time beyond the rigid ones of its GapKinematics, as elastic bodies and
/// temperatures do. The gap is that of the rigid surfaces and the sum of all shapes: another cause, such as wear, is
/// one more class and one line where FilmForce lists its shapes.
class SurfaceShape {
 public:
  virtual ~SurfaceShape() = default;

  /// Begins a step of length dt [s] from the state accepted last; so does a step that is taken again, shorter.
  virtual void begin_step(double /*dt*/) {}
  /// Accepts the step of length dt [s] at the end of which the film has been accepted, or the start of a run.
  virtual void accept_step(double /*dt*/) {}

  /// Adds to gap and rate what the shape does to them.
  /// @param motion  of the bodies, with the amplitudes of their shapes
  /// @param turning  rotation of B's surface over the film's grid
  virtual void add_to(const mbd::RelativeMotion& motion, const GapKinematics::Turning& turning,
                      film::SurfaceMotion& surfaces) = 0;
  /// Adds to the directions of the gap's parameters that the shape rotates with the journal.
  virtual void add_turning(const GapKinematics::Turning& /*turning*/,
                           std::vector<film::MotionDirection>& /*of_parameters*/) const {}
  /// True if the gap at the nodes differs from that of the rigid surfaces: its smallest is then one at a node.
  [[nodiscard]] virtual bool changes_gap() const = 0;

  /// Returns the power of the film's forces at the nodes [N] on surfaces that move at a rate of their own, no body's
  /// amplitude [W] (theory manual, thermal.44).
  [[nodiscard]] virtual double power(const Eigen::VectorXd& /*normal_forces*/) const { return 0; }

  /// Saves or restores what the next step starts from.
  virtual void persist(Archive& /*archive*/) {}
};

/// Adds a field at the nodes to one of a direction, in which an empty one means zero.
inline void add_field(const Eigen::VectorXd& field, Eigen::VectorXd& to) {
  if (to.size() == 0)
    to = field;
  else
    to += field;
}

}  // namespace hersey::bearing
