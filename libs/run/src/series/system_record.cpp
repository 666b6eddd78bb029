#include "series/system_record.h"

namespace hersey::run {
namespace {

using Observed = mbd::Observation;

template <class Member>
auto of_step(Member member) {
  return [member](const SystemRow& row) { return std::invoke(member, row.step); };
}

template <class Member>
auto of_mechanism(Member member) {
  return [member](const SystemRow& row) { return std::invoke(member, row.step.mechanism); };
}

template <class Member>
auto of_power(Member member) {
  return [member](const SystemRow& row) { return std::invoke(member, row.step.power); };
}

template <class Member>
auto of_energy(Member member) {
  return [member](const SystemRow& row) { return std::invoke(member, row.energy); };
}

/// Sum over all films.
auto sum_over_films(double film::FilmObservables::*power) {
  return [power](const SystemRow& row) {
    double sum = 0;
    for (const bearing::BearingObservation& bearing : row.step.bearings) sum += bearing.film.*power;
    return sum;
  };
}

double strain_energy(const SystemRow& row) {
  double strain = 0;
  for (const mbd::ElasticObservation& body : row.step.mechanism.elastics) strain += body.energy.strain;
  return strain;
}

double crank_angle(const SystemRow& row) {
  const model::Simulation& simulation = row.model.simulation;
  return simulation.crank->initial_angle + simulation.crank->speed * (row.step.mechanism.t - simulation.start);
}

bool has_crank(const model::Model& model) { return model.simulation.crank.has_value(); }
bool controls_error(const model::Model& model) { return model.simulation.error_control.has_value(); }
bool integrates(const model::Model& model) { return model.simulation.analysis == model::Analysis::dynamics; }

const QuantityTable<SystemRow, model::Model>& system_quantities() {
  using E = EnergySummary;
  using P = PowerBalance;
  using S = StepRecord;
  static const QuantityTable<SystemRow, model::Model> table{
      {"time", "s", "time", of_mechanism(&Observed::t), {.symbol = "t"}},
      {"crank_angle",
       "rad",
       "rotation of joint <crank>",
       crank_angle,
       {.note = "only where the model names a crank; continues over many revolutions",
        .only = has_crank,
        .each = [](const model::Model& model) { return std::vector{model.simulation.crank->joint}; }}},
      {"solver/dt",
       "s",
       "step length",
       of_step(&S::dt),
       {.symbol = "dt", .note = "of the step that led to this instant; the first row is the start"}},
      {"solver/newton_iterations", "1", "Newton iterations of the step", of_step(&S::newton_iterations)},
      {"solver/residual", "1", "largest row residual over its tolerance", of_step(&S::newton_residual)},
      {"solver/rejected_steps", "1", "steps rejected since the start of the run", of_step(&S::rejected_steps)},
      {"solver/constraint_drift", "1",
       "largest violation of a joint or drive, lengths over the machine's size, angles in rad",
       of_step(&S::constraint_drift)},
      {"solver/error",
       "1",
       "estimated local error of the step over its tolerance",
       of_step(&S::error),
       {.note = "with an error control", .only = controls_error}},
      {"solver/step_error",
       "1",
       "estimated local error of the step: angles in rad, lengths over the machine's size, positions of journals over "
       "their clearance, deflections of gears' teeth over a hundredth of their pitch",
       of_step(&S::step_error),
       {.note = "analysis `dynamics`; with a fixed step of no coordinate more than its way in the step",
        .only = integrates,
        .summary_entries = {{.statistic = SummaryEntry::Statistic::largest,
                             .name = "largest estimated error of one step"}}}},
      {"energy/kinetic", "J", "kinetic energy", of_mechanism(&Observed::kinetic_energy)},
      {"energy/potential", "J", "potential energy of gravity", of_mechanism(&Observed::potential_energy)},
      {"energy/springs", "J", "energy stored in springs and contacts", of_mechanism(&Observed::spring_energy)},
      {"energy/strain", "J", "strain energy of flexible bodies", strain_energy},
      {"energy/since_start/put_in",
       "J",
       "put in by drives, motors, loads and pressures",
       of_energy(&E::put_in),
       {.note = "sums over all accepted steps: where the energy put in has gone, beside what `energy/...` has gained"}},
      {"energy/since_start/film_dissipation", "J", "dissipated by shear and flow in the films", of_energy(&E::films)},
      {"energy/since_start/boundary_friction", "J", "dissipated by asperities in the films",
       of_energy(&E::boundary_friction)},
      {"energy/since_start/contacts", "J", "lost in contacts", of_energy(&E::contacts)},
      {"energy/since_start/dampers", "J", "lost in dampers, joint friction and the material of flexible bodies",
       of_energy(&E::dampers)},
      {"energy/since_start/oil", "J", "taken along by oil that leaves the films less what feeds bring",
       of_energy(&E::oil)},
      {"energy/since_start/film_storage", "J", "stored in liners, asperities and compressed oil",
       of_energy(&E::film_storage)},
      {"energy/since_start/unexplained", "J", "put in, and neither lost nor stored nor taken along",
       of_energy(&E::unexplained)},
      {"energy/since_start/available",
       "J",
       "energy at the start, and the most that each source has put in or each store released since",
       of_energy(&E::available),
       {.note = "energies that are reported as shares are shares of this"}},
      {"energy/since_start/from_nowhere",
       "J",
       "gained in steps beyond what acted in them and beyond the uncertainty of their balance, less what was lost "
       "again",
       of_energy(&E::from_nowhere),
       {.note = "a run whose share of `available` reaches 20 % ends as failed"}},
      {"power/drives", "W", "put in by drives", of_power(&P::drives)},
      {"power/loads", "W", "put in by applied forces and torques", of_power(&P::loads)},
      {"power/gravity", "W", "put in by gravity", of_power(&P::gravity)},
      {"power/springs", "W", "given to the bodies by springs and dampers", of_power(&P::springs)},
      {"power/contacts", "W", "given to the bodies by contacts", of_power(&P::contacts)},
      {"power/bearings", "W", "given to the bodies by the films (negative: taken)", of_power(&P::bearings)},
      {"power/elastic", "W", "given back by flexible bodies (negative: stored or dissipated)", of_power(&P::elastic)},
      {"power/kinetic_rate", "W", "rate of change of the kinetic energy", of_power(&P::kinetic_rate)},
      {"power/balance_error",
       "W",
       "sum of all powers less the kinetic rate: residual of the equations of motion",
       of_power(&P::error),
       {.summary_entries = {{SummaryEntry::Statistic::largest_in_size,
                             "largest residual power of the equations of motion", "W"}}}},
      {"power/unexplained",
       "W",
       "the same with what the films take by integrals of their own in place of bearings",
       of_power(&P::unexplained),
       {.note = "`power_film`, `power_asperity`, `power_stored` and `power_oil` of all bearings"}},
      {"power/film_friction", "W", "viscous dissipation in all films",
       sum_over_films(&film::FilmObservables::power_film)},
      {"power/asperity_friction", "W", "boundary friction in all films",
       sum_over_films(&film::FilmObservables::power_asperity)},
  };
  return table;
}

}  // namespace

SystemRecord::SystemRecord(const model::Model& model, results::Writer& writer)
    : rows_(system_quantities(), "/", model, writer) {}

QuantityGroup SystemRecord::describe() {
  QuantityGroup group{.path = "/", .heading = "of the machine as a whole", .quantities = {}};
  run::describe(system_quantities(), "n", group);
  return group;
}

// A group called fields counts its own rows, because cycles are not instants.
const QuantityTable<CycleRecord::Row, model::Model>& CycleRecord::table() {
  static const QuantityTable<Row, model::Model> table{
      {"fields/time", "s", "end of the cycle", &Row::t},
      {"fields/change",
       "1",
       "largest difference from the cycle before of a bearing's smallest film thickness, peak pressure and mean "
       "friction loss, over the larger",
       &Row::change,
       {.note = "NaN in the first cycle"}},
      {"fields/friction_energy",
       "J",
       "lost in all films, their contact, and piston rings",
       part(&Row::friction, &EngineFriction::energy),
       {.note = "this and the following: where a bearing is a `skirt`", .only = displaces}},
      {"fields/displaced_volume",
       "m^3",
       "between the extreme places of all skirts in their liners",
       part(&Row::friction, &EngineFriction::volume),
       {.only = displaces}},
      {"fields/friction_mean_effective_pressure",
       "Pa",
       "the former over the latter",
       [](const Row& row) { return row.friction.mean_effective_pressure(); },
       {.only = displaces}},
  };
  return table;
}

namespace {

const std::vector<Attribute<model::Model>>& cycle_attributes() {
  static const std::vector<Attribute<model::Model>> table{
      {"period", "s", "of the cycles", [](const model::Model& model) { return model.simulation.cycle->period; }},
      {"tolerance", "1", "of their change",
       [](const model::Model& model) { return model.simulation.cycle->tolerance; }},
  };
  return table;
}

}  // namespace

CycleRecord::CycleRecord(const model::Model& model, results::Writer& writer)
    : rows_(table(), "/cycles/", model, writer) {
  write_once(cycle_attributes(), "/cycles/", model, writer);
}

QuantityGroup CycleRecord::describe() {
  QuantityGroup group{.path = "/cycles/", .heading = "of a run by cycles", .quantities = {}};
  run::describe(cycle_attributes(), "c", group);
  run::describe(table(), "c", group);
  return group;
}

}  // namespace hersey::run
