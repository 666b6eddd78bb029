#pragma once

#include <Eigen/Dense>
#include <string>

#include "hersey/bearing/coordinates.h"
#include "hersey/core/archive.h"
#include "hersey/film/film_model.h"
#include "hersey/film/reynolds.h"
#include "hersey/mbd/two_body_force.h"

namespace hersey::bearing {

/// Position of a bearing's moving surface in the measures of its kind, for records and comparisons.
struct GapPosition {
  Coordinates e = Eigen::Vector2d::Zero();         ///< of a journal its axis at z = 0 in the bearing frame [m]
  Eigen::Vector2d tilt = Eigen::Vector2d::Zero();  ///< slope of a journal's axis, of a slider's runner [-]
  double speed = 0;  ///< of a journal about the bearing's axis, relative to the shell [rad/s]; of a runner [m/s]
  /// Distance from the position with the widest film over the clearance, of length 1 where the surfaces touch [-].
  Eigen::VectorXd relative;

  /// Length of `relative`: for a journal the eccentricity ratio [-].
  [[nodiscard]] double ratio() const { return relative.norm(); }
};

/// Kinematics of the gap of one kind of bearing: the parameters through which two rigid surfaces, of frames A and B,
/// act on the gap, their derivatives by the relative motion, and the surfaces at these parameters. A film between
/// them is a FilmForce. One object per bearing and thread; no allocation after the first call.
class GapKinematics {
 public:
  using Index = Eigen::Index;
  using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, 6>;

  virtual ~GapKinematics() = default;

  /// Sets by how much, and how fast, both surfaces together move apart everywhere as their bodies grow [m, m/s]. Later
  /// evaluations include it, and positions are relative to the gap as it then is.
  void set_clearance_change(double growth, double rate) { growth_ = growth, growth_rate_ = rate; }

  /// Begins a step at this motion. What a step cannot follow stays as it is here until the next call.
  virtual void begin_step(const mbd::RelativeMotion& /*start*/) {}
  /// Ends the step at this motion.
  virtual void end_step(const mbd::RelativeMotion& /*end*/) {}
  /// Saves or restores what begin_step() and end_step() keep.
  virtual void persist(Archive& /*archive*/) {}

  /// Writes the surfaces at a motion of B relative to A into `surfaces`: gap, rate, speeds, angles. The members below
  /// refer to this motion.
  /// @return empty, or for the user why the bodies do not face each other; `surfaces` then stays as it was
  [[nodiscard]] virtual std::string evaluate(const mbd::RelativeMotion& motion, film::SurfaceMotion& surfaces) = 0;

  /// Parameters that act on the gap, constant in number.
  [[nodiscard]] const Eigen::VectorXd& parameters() const { return parameters_; }
  /// Derivatives of the parameters with the twist that moves B in A, shape (parameters, 6).
  [[nodiscard]] const Jacobian& d_dX() const { return d_dX_; }
  /// Derivatives of the parameters with V_AB_A, same shape.
  [[nodiscard]] const Jacobian& d_dV() const { return d_dV_; }
  /// Change of the surfaces with a unit of a parameter.
  [[nodiscard]] virtual const film::MotionDirection& direction(Index parameter) const = 0;
  /// True if a parameter is an angle, the same after a revolution.
  [[nodiscard]] virtual bool is_angle(Index parameter) const = 0;
  /// Smallest gap of the rigid surfaces [m].
  [[nodiscard]] virtual double smallest_gap() const = 0;
  /// Says which surface touches which: "the journal touches the shell".
  [[nodiscard]] virtual std::string contact_text() const = 0;
  /// Says where B's surface is, in the measures of this kind of bearing.
  [[nodiscard]] virtual std::string position_text() const = 0;

  /// Rotation of B's surface over the film's grid: angle [rad], speed [rad/s], and the indices of the parameters that
  /// these are; the speed's parameter is that of a surface with this radius [m].
  struct Turning {
    double angle = 0, speed = 0, radius = 1;
    Index of_angle = 0, of_speed = 0;
  };
  /// Returns that rotation. Only surfaces that deform, or have features or a shape of their own, need it.
  [[nodiscard]] virtual Turning turning() const = 0;

  /// Returns the position at any motion, independent of the motion evaluated last.
  [[nodiscard]] virtual GapPosition position(const mbd::RelativeMotion& motion) const = 0;
  /// Returns the displacement of B from `before` to `after` over the clearance [-].
  [[nodiscard]] virtual Eigen::VectorXd relative_shift(const Pose& before, const Pose& after) const = 0;

 protected:
  Eigen::VectorXd parameters_;
  Jacobian d_dX_, d_dV_;
  double growth_ = 0, growth_rate_ = 0;  ///< as given to set_clearance_change()
};

}  // namespace hersey::bearing
