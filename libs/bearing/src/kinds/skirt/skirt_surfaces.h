#pragma once

#include <Eigen/Dense>
#include <array>
#include <optional>

#include "hersey/bearing/journal_kinematics.h"
#include "hersey/bearing/skirt.h"
#include "hersey/film/film_model.h"
#include "hersey/film/reynolds.h"

namespace hersey::bearing {

/// The height of the skirt's frame above that of the liner, along the liner's axis [m]; it stands where a journal has
/// the angle of its supply. The other parameters of a skirt's film are those of a journal, with the liner in the
/// journal's place.
inline constexpr int kSkirtHeight = kSupplyAngle;

/// The gap between a rigid skirt and the liner around it (skirt.2), and its derivatives by where the liner's axis is in
/// the skirt's frame. One object per bearing and thread.
class SkirtSurfaces {
 public:
  /// @param opening  of the skirt's shapes at the nodes [m]
  SkirtSurfaces(const film::FilmModel& model, Eigen::VectorXd opening, std::optional<LinerBore> liner);

  /// How many parameters act: a liner that is a cylinder is the same at every height.
  [[nodiscard]] int parameter_count() const { return liner_ ? kSkirtHeight + 1 : kSkirtHeight; }
  /// Writes the surfaces with the liner's axis at `p`.
  /// @param growth, growth_rate  of the clearance [m, m/s]
  /// @param sense  1: the liner's z-axis points towards the crown; -1: away from it
  void evaluate(const ParameterVector& p, double growth, double growth_rate, double sense, film::SurfaceMotion& motion);
  /// Change of the surfaces with a unit of one of the parameters that act.
  [[nodiscard]] const film::MotionDirection& direction(Eigen::Index parameter) const {
    return directions_[static_cast<std::size_t>(parameter)];
  }
  /// Smallest gap at the nodes, as last evaluated [m].
  [[nodiscard]] double smallest_gap() const { return smallest_gap_; }

 private:
  void add_bore(const ParameterVector& p, double sense, film::SurfaceMotion& motion);

  double c_;
  std::optional<LinerBore> liner_;
  Eigen::VectorXd phi_;
  Eigen::VectorXd cosine_, sine_, z_;  // of every node
  Eigen::VectorXd opening_;
  std::array<film::MotionDirection, kSkirtHeight + 1> directions_;
  double smallest_gap_ = 0;
};

}  // namespace hersey::bearing
