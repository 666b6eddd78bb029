#include "kinds/skirt/skirt_surfaces.h"

#include <cmath>
#include <utility>

#include "hersey/bearing/clearance.h"

namespace hersey::bearing {

SkirtSurfaces::SkirtSurfaces(const film::FilmModel& model, Eigen::VectorXd opening, std::optional<LinerBore> liner)
    : c_(clearance(model)),
      liner_(std::move(liner)),
      phi_(model.grid.size()),
      cosine_(model.grid.size()),
      sine_(model.grid.size()),
      z_(model.grid.size()),
      opening_(std::move(opening)) {
  const film::Grid& grid = model.grid;
  for (int i = 0; i < grid.n_phi; ++i) {
    for (int j = 0; j < grid.n_z; ++j) {
      const int k = grid.index(i, j);
      phi_[k] = grid.phi(i);
      cosine_[k] = std::cos(grid.phi(i)), sine_[k] = std::sin(grid.phi(i));
      z_[k] = model.L * grid.z_over_L(j);
    }
  }
  directions_[kEx].g = directions_[kExRate].g_rate = cosine_;
  directions_[kEy].g = directions_[kEyRate].g_rate = sine_;
  directions_[kTx].g = directions_[kTxRate].g_rate = z_.cwiseProduct(cosine_);
  directions_[kTy].g = directions_[kTyRate].g_rate = z_.cwiseProduct(sine_);
  directions_[kJournalSpeed].u_journal = 1;
  directions_[kAxialSpeed].w_journal = 1;
}

void SkirtSurfaces::evaluate(const ParameterVector& p, double growth, double growth_rate, double sense,
                             film::SurfaceMotion& motion) {
  motion.g = opening_.array() + c_ + growth + (p[kEx] + p[kTx] * z_.array()) * cosine_.array() +
             (p[kEy] + p[kTy] * z_.array()) * sine_.array();
  motion.g_rate = growth_rate + (p[kExRate] + p[kTxRate] * z_.array()) * cosine_.array() +
                  (p[kEyRate] + p[kTyRate] * z_.array()) * sine_.array();
  motion.shell_opening = opening_;
  motion.u_shell = motion.w_shell = 0;
  motion.u_journal = p[kJournalSpeed];
  motion.w_journal = p[kAxialSpeed];
  motion.phi_supply = motion.phi_journal = 0;
  if (liner_) add_bore(p, sense, motion);
  smallest_gap_ = motion.g.minCoeff();
}

// The liner's bore at the place where the skirt's node now is, which it passes with the skirt's speed (skirt.10).
void SkirtSurfaces::add_bore(const ParameterVector& p, double sense, film::SurfaceMotion& motion) {
  film::MotionDirection &height = directions_[kSkirtHeight], &speed = directions_[kAxialSpeed];
  height.g.resize(z_.size());
  for (Eigen::Index k = 0; k < z_.size(); ++k) {
    const film::ValueAndSlope bore = liner_->at(sense * (phi_[k] - p[kRotation]), p[kSkirtHeight] + sense * z_[k]);
    motion.g[k] += bore.value;
    height.g[k] = bore.slope;
  }
  speed.g_rate = -sense * height.g;
  motion.g_rate += p[kAxialSpeed] * speed.g_rate;
}

}  // namespace hersey::bearing
