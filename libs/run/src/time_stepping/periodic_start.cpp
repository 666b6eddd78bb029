#include "time_stepping/periodic_start.h"

#include <exception>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "hersey/core/error_text.h"
#include "hersey/solver/initialise.h"
#include "start/start.h"

namespace hersey::run {
namespace {

void move_to(const PeriodicStart& start, model::Machine& machine, solver::State& state) {
  mbd::Mechanism& mechanism = *machine.mechanism;
  if (start.state.q.size() != mechanism.nq() || start.state.v.size() != mechanism.nv())
    throw std::runtime_error("its bodies have other coordinates");
  solver::State first = start.state;
  first.t = state.t;
  for (std::size_t i = 0; i < start.films.size(); ++i) machine.bearings[i].bearing->begin_from(start.films[i]);
  if (machine.network) {
    Archive network(start.network);
    machine.network->persist(network);
  }
  solver::InitialiseOptions options;
  options.fixed.resize(static_cast<std::size_t>(mechanism.nv()));
  std::iota(options.fixed.begin(), options.fixed.end(), 0);
  options.fixed_rates = mechanism.given_rates();
  const solver::InitialiseSummary found = solver::initialise(mechanism, first, options);
  if (!found.solved()) throw std::runtime_error("its last state is none of the machine's: " + found.message);
  state = first;
}

}  // namespace

void take_period(model::Model& model, double period) {
  if (period == 0) return;
  model::Simulation& plan = model.simulation;
  const double ratio = period / plan.cycle->period;
  plan.cycle->period = period;
  plan.step *= ratio;
  plan.duration *= ratio;
}

PeriodicStart begin_in(PeriodicStart start, const model::Model& model, model::Machine& machine, solver::State& state) {
  if (start.cycles == 0 || start.motion) return start;
  try {
    move_to(start, machine, state);
  } catch (const std::exception& error) {
    start.cycles = 0;
    start.message = "the lead-in was given up: " + error_text(error);
    machine = model::build(model);
    state = starting_state(model, machine);
  }
  return start;
}

}  // namespace hersey::run
