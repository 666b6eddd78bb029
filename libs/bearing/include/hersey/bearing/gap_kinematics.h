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

/// A kind of bearing as its film sees it: the parameters through which two rigid surfaces, of frames A and B, act on
/// the gap, with their derivatives, and how they place the surfaces. A film between them is a FilmForce. One object per
/// bearing and thread; no allocation after the first call.
class GapKinematics {
 public:
  using Index = Eigen::Index;
  using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, 6>;

  virtual ~GapKinematics() = default;

  /// Both surfaces together have moved apart and move apart everywhere, as their bodies grow [m, m/s]; what is placed
  /// next has it, and positions are over the gap as it then is.
  void set_clearance_change(double growth, double rate) { growth_ = growth, growth_rate_ = rate; }

  /// A step begins at this motion: what it cannot follow within a step stays as it is here until the next call.
  virtual void begin_step(const mbd::RelativeMotion& /*start*/) {}
  /// And has ended at this one.
  virtual void end_step(const mbd::RelativeMotion& /*end*/) {}
  /// What both keep.
  virtual void persist(Archive& /*archive*/) {}

  /// Writes the surfaces at a motion of B relative to A into `surfaces`: gap, rate, speeds, angles. What follows refers
  /// to this motion. Not empty: why the surfaces are none, for the user; they are then not placed.
  [[nodiscard]] virtual std::string place(const mbd::RelativeMotion& motion, film::SurfaceMotion& surfaces) = 0;

  /// The parameters that act, constant in number.
  [[nodiscard]] const Eigen::VectorXd& parameters() const { return parameters_; }
  /// Their derivatives with the twist that moves B in A, and with V_AB_A, shape (parameters, 6).
  [[nodiscard]] const Jacobian& d_dX() const { return d_dX_; }
  /// See d_dX.
  [[nodiscard]] const Jacobian& d_dV() const { return d_dV_; }
  /// What a unit change of a parameter does to the surfaces.
  [[nodiscard]] virtual const film::MotionDirection& direction(Index parameter) const = 0;
  /// Whether a parameter is an angle, the same after a whole turn.
  [[nodiscard]] virtual bool is_angle(Index parameter) const = 0;
  /// Smallest gap of the rigid surfaces [m].
  [[nodiscard]] virtual double smallest_gap() const = 0;
  /// Says which surface touches which: "the journal touches the shell".
  [[nodiscard]] virtual std::string contact_text() const = 0;
  /// Where B's surface is, in words of this kind of bearing.
  [[nodiscard]] virtual std::string position_text() const = 0;

  /// How B's surface turns over the film's grid: by what angle [rad], how fast [rad/s], and which parameters these are,
  /// the speed's being that of a surface with this radius [m].
  struct Turning {
    double angle = 0, speed = 0, radius = 1;
    Index of_angle = 0, of_speed = 0;
  };
  /// Only where that surface deforms or has features or a shape of its own.
  [[nodiscard]] virtual Turning turning() const = 0;

  /// Of any motion, whatever was placed last.
  [[nodiscard]] virtual GapPosition position(const mbd::RelativeMotion& motion) const = 0;
  /// By how much of the clearance B is elsewhere in `after` than in `before` [-].
  [[nodiscard]] virtual Eigen::VectorXd relative_shift(const Pose& before, const Pose& after) const = 0;

 protected:
  Eigen::VectorXd parameters_;
  Jacobian d_dX_, d_dV_;
  double growth_ = 0, growth_rate_ = 0;  ///< as given to set_clearance_change()
};

}  // namespace hersey::bearing
