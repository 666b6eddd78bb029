#include "kinds/thrust/thrust_surfaces.h"

#include <cmath>
#include <utility>

namespace hersey::bearing {

ThrustSurfaces::ThrustSurfaces(const film::FilmModel& model, Eigen::VectorXd opening)
    : R_(model.R), x_(model.grid.size()), y_(model.grid.size()), opening_(std::move(opening)) {
  const film::Grid& grid = model.grid;
  for (int i = 0; i < grid.n_phi; ++i) {
    for (int j = 0; j < grid.n_z; ++j) {
      const double r = model.R + model.L * grid.z_over_L(j);
      x_[grid.index(i, j)] = r * std::cos(grid.phi(i));
      y_[grid.index(i, j)] = r * std::sin(grid.phi(i));
    }
  }
  directions_[kThrustZ].g = directions_[kThrustZRate].g_rate = Eigen::VectorXd::Ones(grid.size());
  directions_[kThrustAx].g = directions_[kThrustAxRate].g_rate = -x_;
  directions_[kThrustAy].g = directions_[kThrustAyRate].g_rate = -y_;
  directions_[kThrustSpeed].u_journal = R_;
}

void ThrustSurfaces::evaluate(const ThrustParameters& p, double growth, double growth_rate,
                              film::SurfaceMotion& motion) {
  // (thrust.4)
  motion.g = opening_.array() + growth + p[kThrustZ] - p[kThrustAx] * x_.array() - p[kThrustAy] * y_.array();
  motion.g_rate = growth_rate + p[kThrustZRate] - p[kThrustAxRate] * x_.array() - p[kThrustAyRate] * y_.array();
  motion.shell_opening = opening_;
  motion.u_shell = motion.w_shell = motion.w_journal = 0;
  motion.u_journal = R_ * p[kThrustSpeed];
  motion.phi_supply = motion.phi_journal = 0;
  smallest_gap_ = motion.g.minCoeff();
}

}  // namespace hersey::bearing
