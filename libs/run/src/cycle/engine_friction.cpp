#include "cycle/engine_friction.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <variant>

#include "hersey/film/film_surface.h"

namespace hersey::run {
namespace {

bool is_of_piston(const film::FilmModel& film) { return std::holds_alternative<film::Skirt>(film.surface); }

}  // namespace

double EngineFriction::mean_effective_pressure() const {
  return volume > 0 ? energy / volume : std::numeric_limits<double>::quiet_NaN();
}

double ring_power(const model::BuiltRing& ring, const mbd::Observation& observation) {
  return -observation.force_powers[static_cast<std::size_t>(ring.force.index)];
}

bool displaces(const model::Model& model) {
  return std::any_of(model.bearings.begin(), model.bearings.end(),
                     [](const model::Bearing& bearing) { return is_of_piston(bearing.film); });
}

void EngineFrictionSums::take(const mbd::Observation& observation) {
  double power = 0;
  for (const model::BuiltRing& ring : machine_.rings) power += ring_power(ring, observation);
  if (is_begun_) energy_ += 0.5 * (observation.t - t_) * (power_ + power);
  is_begun_ = true;
  t_ = observation.t, power_ = power;
}

EngineFriction EngineFrictionSums::close(const std::vector<BearingCycle>& bearings) {
  EngineFriction sum{.energy = energy_};
  energy_ = 0;
  for (std::size_t i = 0; i < bearings.size(); ++i) {
    const film::FilmModel& film = machine_.bearings[i].bearing->model();
    sum.energy += bearings[i].energy_film + bearings[i].energy_asperity;
    if (is_of_piston(film)) sum.volume += std::numbers::pi * film.R * film.R * bearings[i].stroke();
  }
  return sum;
}

void EngineFrictionSums::persist(Archive& archive) {
  if (machine_.rings.empty()) return;
  archive.io("begun", is_begun_), archive.io("t", t_);
  archive.io("power", power_), archive.io("energy", energy_);
}

}  // namespace hersey::run
