#include "observation/energy_balance.h"

#include <algorithm>

namespace hersey::run {

EnergyBalance::Instant EnergyBalance::instant_of(const StepRecord& step) const {
  const mbd::Observation& machine = step.mechanism;
  Instant now{.put_in = step.power.drives + step.power.loads, .dampers = machine.damper_power};
  // Sources among the forces on coordinates count as drives, stores as springs; the energy that the others absorb is
  // lost.
  for (std::size_t i = 0; i < machine.coordinate_force_powers.size(); ++i)
    if (const mbd::CoordinateForce& force = *spec_.coordinate_forces[i].force; !force.is_source() && !force.is_store())
      now.dampers -= machine.coordinate_force_powers[i];
  for (const bearing::BearingObservation& bearing : step.bearings) {
    now.films += bearing.film.power_film;
    now.boundary_friction += bearing.film.power_asperity;
    now.oil += bearing.film.power_oil;
    now.film_storage += bearing.film.power_stored;
  }
  for (const mbd::ContactObservation& contact : step.contacts)
    now.contacts += contact.damping_power + contact.friction_power;
  now.kinetic = machine.kinetic_energy, now.potential = machine.potential_energy, now.springs = machine.spring_energy;
  for (const mbd::ElasticObservation& body : machine.elastics) {
    now.dampers += body.energy.dissipation;
    now.strain += body.energy.strain;
  }
  return now;
}

void EnergyBalance::take(const StepRecord& step) {
  const Instant now = instant_of(step);
  if (!is_begun_) start_ = last_ = now, is_begun_ = true;
  const auto add = [&](double& sum, double Instant::*power) { sum += 0.5 * step.dt * (last_.*power + now.*power); };
  add(sums_.put_in, &Instant::put_in);
  add(sums_.films, &Instant::films);
  add(sums_.boundary_friction, &Instant::boundary_friction);
  add(sums_.oil, &Instant::oil);
  add(sums_.film_storage, &Instant::film_storage);
  add(sums_.contacts, &Instant::contacts);
  add(sums_.dampers, &Instant::dampers);
  sums_.stored = now.stored() - start_.stored();
  // Energy that oil brings under pressure is put in, too; the energy monitor of the steps counts the part of it that
  // reaches the bodies.
  brought_by_oil_ = std::max(brought_by_oil_, -sums_.oil);
  sums_.available = step.energy_available + brought_by_oil_;
  sums_.from_nowhere = step.energy_from_nowhere;
  last_ = now;
}

void EnergyBalance::go_on_from(const StepRecord& step) {
  if (!is_begun_) return;
  const Instant now = instant_of(step);
  sums_.put_in += now.stored() - last_.stored();
  last_ = now;
}

void EnergyBalance::persist(Archive& archive) {
  archive.io("is_begun", is_begun_);
  archive.io("kinetic_at_start", start_.kinetic), archive.io("potential_at_start", start_.potential);
  archive.io("springs_at_start", start_.springs), archive.io("strain_at_start", start_.strain);
  const auto io = [&](const char* name, double& sum, double& last) {
    const Archive::Group group(archive, name);
    archive.io("sum", sum), archive.io("last", last);
  };
  io("put_in", sums_.put_in, last_.put_in), io("films", sums_.films, last_.films);
  io("boundary_friction", sums_.boundary_friction, last_.boundary_friction), io("oil", sums_.oil, last_.oil);
  io("film_storage", sums_.film_storage, last_.film_storage), io("contacts", sums_.contacts, last_.contacts);
  io("dampers", sums_.dampers, last_.dampers);
  archive.io("stored", sums_.stored);
  archive.io("available", sums_.available), archive.io("brought_by_oil", brought_by_oil_),
      archive.io("from_nowhere", sums_.from_nowhere);
}

}  // namespace hersey::run
