#include "hersey/bearing/rigid_surfaces.h"

#include <algorithm>
#include <cmath>

#include "hersey/bearing/clearance.h"

namespace hersey::bearing {

RigidSurfaces::RigidSurfaces(const film::FilmModel& model) : model_(model), shape_(model) {
  const film::Grid& grid = model_.grid;
  cosine_.resize(grid.size()), sine_.resize(grid.size()), z_.resize(grid.size());
  for (int i = 0; i < grid.n_phi; ++i) {
    for (int j = 0; j < grid.n_z; ++j) {
      const int k = grid.index(i, j);
      cosine_[k] = std::cos(grid.phi(i)), sine_[k] = std::sin(grid.phi(i));
      z_[k] = model_.L * grid.z_over_L(j);
    }
  }
  lay_directions();
}

void RigidSurfaces::lay_directions() {
  const Eigen::VectorXd tilted_x = -z_.cwiseProduct(cosine_), tilted_y = -z_.cwiseProduct(sine_);
  for (const bool is_rate : {false, true}) {
    const auto field = [is_rate](film::MotionDirection& d) -> Eigen::VectorXd& { return is_rate ? d.g_rate : d.g; };
    field(directions_[is_rate ? kExRate : kEx]) = -cosine_;
    field(directions_[is_rate ? kEyRate : kEy]) = -sine_;
    field(directions_[is_rate ? kTxRate : kTx]) = tilted_x;
    field(directions_[is_rate ? kTyRate : kTy]) = tilted_y;
  }
  directions_[kJournalSpeed].u_journal = 1;
  directions_[kAxialSpeed].w_journal = 1;
  directions_[kSupplyAngle].phi_supply = model_.supply.kind == film::SupplyKind::widest_gap ? 1 : 0;
  directions_[kRotation].phi_journal = 1;
}

void RigidSurfaces::evaluate(const ParameterVector& p, film::SurfaceMotion& motion) {
  const double c = clearance(model_, growth_);
  motion.g = shape_.still().array() + c - (p[kEx] + p[kTx] * z_.array()) * cosine_.array() -
             (p[kEy] + p[kTy] * z_.array()) * sine_.array();
  motion.g_rate = growth_rate_ - (p[kExRate] + p[kTxRate] * z_.array()) * cosine_.array() -
                  (p[kEyRate] + p[kTyRate] * z_.array()) * sine_.array();
  motion.shell_opening = shape_.of_shell();
  motion.u_shell = 0;
  motion.u_journal = p[kJournalSpeed];
  motion.w_shell = 0;
  motion.w_journal = p[kAxialSpeed];
  motion.phi_supply = model_.supply.kind == film::SupplyKind::fixed_angle ? model_.supply.phi : p[kSupplyAngle];
  motion.phi_journal = p[kRotation];
  add_turning(p[kRotation], p[kJournalSpeed] / model_.R, motion);
  if (shape_.is_round() && model_.grid.closes()) {
    const auto offset = [&](double z) { return (p.segment<2>(kEx) + p.segment<2>(kTx) * z).norm(); };
    smallest_gap_ = c - std::max(offset(-0.5 * model_.L), offset(0.5 * model_.L));
  } else {
    smallest_gap_ = motion.g.minCoeff();
  }
}

// The journal's own shape: the gap at a fixed point changes as it passes there (film.25).
void RigidSurfaces::add_turning(double phi_journal, double omega, film::SurfaceMotion& motion) {
  if (!shape_.profiles_rotate()) return;
  film::MotionDirection &turn = directions_[kRotation], &speed = directions_[kJournalSpeed];
  shape_.rotate_profiles(phi_journal, opening_, first_, second_);
  motion.g += opening_;
  motion.g_rate += omega * first_;
  turn.g = first_;
  turn.g_rate = omega * second_;
  speed.g_rate = first_ / model_.R;
}

void evaluate_surfaces(const film::FilmModel& model, const ParameterVector& parameters, film::SurfaceMotion& motion,
                       double growth) {
  RigidSurfaces surfaces(model);
  surfaces.set_clearance_change(growth, 0);
  surfaces.evaluate(parameters, motion);
}

double smallest_gap(const film::FilmModel& model, const ParameterVector& parameters, double growth) {
  RigidSurfaces surfaces(model);
  surfaces.set_clearance_change(growth, 0);
  film::SurfaceMotion motion;
  surfaces.evaluate(parameters, motion);
  return surfaces.smallest_gap();
}

film::MotionDirection surface_direction(const film::FilmModel& model, int parameter) {
  return RigidSurfaces(model).direction(parameter);
}

}  // namespace hersey::bearing
