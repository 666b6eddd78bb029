#include "force/thermal_surfaces.h"

#include "hersey/bearing/shapes_at_rest.h"
#include "hersey/film/body_journal.h"

namespace hersey::bearing {

using Eigen::VectorXd;

ThermalSurfaces::ThermalSurfaces(const film::FilmModel& model, const film::FilmHeat* heat, double growth)
    : model_(model), heat_(heat), given_growth_(growth) {
  if (heat_ != nullptr) {
    shell_.start_at(shell_target());
    journal_.start_at(journal_target());
  }
  growth_.start_at(growth_by_temperature());
}

// By the walls' mean temperatures (thermal.42).
double ThermalSurfaces::growth_by_temperature() const {
  if (heat_ == nullptr) return given_growth_;
  const std::optional<film::ThermalExpansion>& walls = heat_->thermal().expansion;
  const film::HeatObservables& observed = heat_->observables();
  return walls ? walls->growth(model_.R, observed.T_shell_wall, observed.T_journal_wall) : 0;
}

VectorXd ThermalSurfaces::shell_target() const {
  return heat_ != nullptr ? heat_->shell_opening_in_time() : VectorXd();
}

// Of a journal in a body, even around it (thermal.61, thermal.62).
VectorXd ThermalSurfaces::journal_target() const {
  return heat_ != nullptr ? film::around(model_.grid, heat_->journal_growth_in_time()) : VectorXd();
}

void ThermalSurfaces::begin_step(double dt) {
  growth_.begin_step(dt);
  shell_.begin_step(dt);
  journal_.begin_step(dt);
}

void ThermalSurfaces::accept_step(double dt) {
  growth_.accept_step(growth_by_temperature(), dt);
  shell_.accept_step(dt);
  journal_.accept_step(dt);
}

void ThermalSurfaces::change_target() { growth_.change_target(growth_by_temperature()); }

void ThermalSurfaces::settle() {
  growth_.settle(growth_by_temperature());
  shell_.settle(shell_target());
  journal_.settle(journal_target());
}

void ThermalSurfaces::add_to(const mbd::RelativeMotion& /*motion*/, const GapKinematics::Turning& /*turning*/,
                             film::SurfaceMotion& surfaces) {
  add_to_shell(shell_.now(), surfaces);
  if (shell_.moves()) surfaces.g_rate += shell_.rate();
  add_to_journal(journal_.now(), surfaces);
  if (journal_.moves()) surfaces.g_rate -= journal_.rate();
}

// Walls that grow apart are pushed on as shapes that open the gap everywhere are (thermal.44).
double ThermalSurfaces::power(const VectorXd& normal_forces) const {
  double power = growth_.rate() * normal_forces.sum();
  if (shell_.moves()) power += shell_.rate().dot(normal_forces);
  if (journal_.moves()) power -= journal_.rate().dot(normal_forces);
  return power;
}

void ThermalSurfaces::persist(Archive& archive) {
  if (heat_ == nullptr) return;
  const Archive::Group group(archive, "thermal");
  growth_.persist(archive);
  shell_.persist(archive);
  const Archive::Group journal(archive, "journal");
  journal_.persist(archive);
}

}  // namespace hersey::bearing
