#pragma once

#include <Eigen/Dense>
#include <array>

#include "hersey/bearing/journal_kinematics.h"
#include "hersey/film/film_model.h"
#include "hersey/film/reynolds.h"

namespace hersey::bearing {

/// Parameters of a journal that act on a skirt's film, with the liner in place of the journal: all but the supply's
/// angle and the rotation.
inline constexpr int kSkirtParameterCount = kSupplyAngle;

/// The gap between a rigid skirt and the liner around it (skirt.2), and its derivatives by where the liner's axis is in
/// the skirt's frame. One object per bearing and thread.
class SkirtSurfaces {
 public:
  /// @param opening  of the skirt's shapes at the nodes [m]
  SkirtSurfaces(const film::FilmModel& model, Eigen::VectorXd opening);

  /// Writes the surfaces with the liner's axis at `p`. @param growth, growth_rate  of the clearance [m, m/s]
  void evaluate(const ParameterVector& p, double growth, double growth_rate, film::SurfaceMotion& motion);
  /// Change of the surfaces with a unit of one Parameter below kSkirtParameterCount.
  [[nodiscard]] const film::MotionDirection& direction(Eigen::Index parameter) const {
    return directions_[static_cast<std::size_t>(parameter)];
  }
  /// Smallest gap at the nodes, as last evaluated [m].
  [[nodiscard]] double smallest_gap() const { return smallest_gap_; }

 private:
  double c_;
  Eigen::VectorXd cosine_, sine_, z_;  // of every node
  Eigen::VectorXd opening_;
  std::array<film::MotionDirection, kSkirtParameterCount> directions_;
  double smallest_gap_ = 0;
};

}  // namespace hersey::bearing
