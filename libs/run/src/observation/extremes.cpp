#include "observation/extremes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hersey::run {

BearingExtremes::BearingExtremes(std::string name) {
  summary_.name = std::move(name);
  summary_.moft = std::numeric_limits<double>::infinity();
  summary_.pofp = -std::numeric_limits<double>::infinity();
}

void BearingExtremes::take(double t, double dt, const bearing::BearingObservation& observation) {
  const film::FilmObservables& film = observation.film;
  last_thickness_ = film.h_min;
  if (film.h_min < summary_.moft) {
    summary_.moft = film.h_min;
    summary_.moft_t = t;
    summary_.moft_phi = film.h_min_phi;
    summary_.moft_z = film.h_min_z;
  }
  if (film.p_max > summary_.pofp) {
    summary_.pofp = film.p_max;
    summary_.pofp_t = t;
    summary_.pofp_phi = film.p_max_phi;
    summary_.pofp_z = film.p_max_z;
  }
  summary_.max_force = std::max(summary_.max_force, observation.wrench_on_shell.tail<3>().norm());
  summary_.eccentricity_ratio = observation.position.ratio();
  if (observation.heat)
    // Fmax ignores the initial value, which is not a number
    summary_.T_max = std::fmax(summary_.T_max, observation.heat->T_max);
  summary_.reynolds_max = std::max(summary_.reynolds_max, film.reynolds_max);
  summary_.laminar_share = std::min(summary_.laminar_share, film.laminar_share);
  summary_.turned += dt * observation.position.speed, summary_.travelled += dt * std::abs(observation.position.speed);
  summary_.worst_mass_balance = std::max(summary_.worst_mass_balance, film.mass_balance_error);
  const double put_in = -observation.power_into_bodies, taken = film.power_taken();
  summary_.energy_put_in += 0.5 * dt * (last_put_in_ + put_in);
  summary_.energy_taken += 0.5 * dt * (last_taken_ + taken);
  last_put_in_ = put_in, last_taken_ = taken;
  time_ += dt;
  energy_ += dt * (film.power_film + film.power_asperity);
  energy_film_ += dt * film.power_film, energy_other_shear_ += dt * film.power_film_other_shear;
  volume_ += dt * film.flow_out();
}

BearingSummary BearingExtremes::summary() const {
  BearingSummary summary = summary_;
  if (energy_ > 0) summary.energy_error = (summary.energy_put_in - summary.energy_taken) / energy_;
  if (time_ > 0) {
    summary.mean_power = energy_ / time_;
    summary.mean_power_film = energy_film_ / time_, summary.mean_power_other_shear = energy_other_shear_ / time_;
    summary.mean_flow = volume_ / time_;
  }
  return summary;
}

void BearingExtremes::persist(Archive& archive) {
  BearingSummary& s = summary_;
  archive.io("moft", s.moft), archive.io("moft_t", s.moft_t);
  archive.io("moft_phi", s.moft_phi), archive.io("moft_z", s.moft_z);
  archive.io("pofp", s.pofp), archive.io("pofp_t", s.pofp_t);
  archive.io("pofp_phi", s.pofp_phi), archive.io("pofp_z", s.pofp_z);
  archive.io("max_force", s.max_force), archive.io("T_max", s.T_max);
  archive.io("eccentricity_ratio", s.eccentricity_ratio);
  archive.io("worst_mass_balance", s.worst_mass_balance);
  archive.io("reynolds_max", s.reynolds_max), archive.io("laminar_share", s.laminar_share);
  archive.io("turned", s.turned), archive.io("travelled", s.travelled);
  archive.io("energy_put_in", s.energy_put_in), archive.io("energy_taken", s.energy_taken);
  archive.io("last_put_in", last_put_in_), archive.io("last_taken", last_taken_);
  archive.io("time", time_), archive.io("energy", energy_);
  archive.io("energy_film", energy_film_), archive.io("energy_other_shear", energy_other_shear_);
  archive.io("volume", volume_);
}

}  // namespace hersey::run
