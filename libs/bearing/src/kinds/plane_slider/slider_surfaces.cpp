#include "kinds/plane_slider/slider_surfaces.h"

#include <utility>

namespace hersey::bearing {

SliderSurfaces::SliderSurfaces(const film::FilmModel& model, Eigen::VectorXd opening)
    : y_(model.grid.size()), z_(model.grid.size()), opening_(std::move(opening)) {
  const film::Grid& grid = model.grid;
  for (int i = 0; i < grid.n_phi; ++i) {
    for (int j = 0; j < grid.n_z; ++j) {
      y_[grid.index(i, j)] = model.R * grid.phi(i);
      z_[grid.index(i, j)] = model.L * grid.z_over_L(j);
    }
  }
  directions_[kSliderE].g = directions_[kSliderERate].g_rate = Eigen::VectorXd::Constant(grid.size(), -1);
  directions_[kSliderTy].g = directions_[kSliderTyRate].g_rate = -y_;
  directions_[kSliderTz].g = directions_[kSliderTzRate].g_rate = -z_;
  directions_[kSliderSpeed].u_journal = 1;
  directions_[kSliderSideSpeed].w_journal = 1;
}

void SliderSurfaces::evaluate(const SliderParameters& p, double growth, double growth_rate,
                              film::SurfaceMotion& motion) {
  motion.g = opening_.array() + growth - p[kSliderE] - p[kSliderTy] * y_.array() - p[kSliderTz] * z_.array();
  motion.g_rate = growth_rate - p[kSliderERate] - p[kSliderTyRate] * y_.array() - p[kSliderTzRate] * z_.array();
  motion.shell_opening = opening_;
  motion.u_shell = motion.w_shell = 0;
  motion.u_journal = p[kSliderSpeed];
  motion.w_journal = p[kSliderSideSpeed];
  motion.phi_supply = motion.phi_journal = 0;
  smallest_gap_ = motion.g.minCoeff();
}

}  // namespace hersey::bearing
