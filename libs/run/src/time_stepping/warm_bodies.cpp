#include "time_stepping/warm_bodies.h"

#include <utility>
#include <vector>

#include "hersey/bearing/global_heat.h"
#include "hersey/film/groove_mixing.h"

namespace hersey::run {

void warm_bodies(model::Machine& machine, double dt) {
  if (!machine.network) return;
  std::vector<film::FilmAtNodes> films;
  std::vector<bearing::FilmForce*> warmed;
  for (const model::BuiltBearing& built : machine.bearings) {
    const film::FilmHeat* heat = built.bearing->heat();
    if (heat == nullptr || !film::terminals_of(heat->thermal()).has_any()) continue;
    films.push_back({film::terminals_of(heat->thermal()), heat->heat_flow()});
    warmed.push_back(built.bearing.get());
  }
  const bool has_warm_circuit = machine.circuit && machine.circuit->heat() != nullptr;
  machine.network->advance(dt, films, has_warm_circuit ? machine.circuit->streams() : std::vector<film::OilStream>{});
  for (std::size_t i = 0; i < films.size(); ++i)
    warmed[i]->move_walls(machine.network->walls(films[i].at, films[i].heat_flow.T));
  if (has_warm_circuit) machine.circuit->follow_temperatures(machine.network->temperatures());
}

void average_streams(model::Machine& machine, double dt) {
  if (machine.circuit && machine.circuit->heat() != nullptr) machine.circuit->add_streams_to_mean(dt);
}

void mix_grooves(model::Machine& machine) {
  std::vector<std::vector<film::EndOil>> ends(machine.bearings.size());
  for (const model::Groove& groove : machine.grooves) {
    const film::FilmHeat &before = *machine.bearings[groove.before].bearing->heat(),
                         &after = *machine.bearings[groove.after].bearing->heat();
    const double T_fresh = groove.T_fresh.value_or(after.edge_temperature());
    std::vector<film::EndOil> mixed =
        film::mixed_in_groove({before.end_flows().back(), after.end_flows().front()}, groove.carry_over, T_fresh);
    mixed.front().rise += T_fresh - before.edge_temperature();
    mixed.back().rise += T_fresh - after.edge_temperature();
    for (const std::size_t k : {groove.before, groove.after})
      if (ends[k].empty()) ends[k] = machine.bearings[k].bearing->heat()->state().ends;
    ends[groove.before].back() = mixed.front(), ends[groove.after].front() = mixed.back();
  }
  for (std::size_t k = 0; k < ends.size(); ++k)
    if (!ends[k].empty()) machine.bearings[k].bearing->set_ends(std::move(ends[k]));
}

void settle_walls(model::Machine& machine) {
  std::vector<film::FilmAtNodes> films;
  std::vector<bearing::FilmForce*> warm;
  for (const model::BuiltBearing& built : machine.bearings) {
    const film::FilmHeat* heat = built.bearing->heat();
    if (heat == nullptr) continue;
    films.push_back({film::terminals_of(heat->thermal()), built.bearing->mean_heat_flow()});
    warm.push_back(built.bearing.get());
  }
  const bool has_warm_circuit = machine.circuit && machine.circuit->heat() != nullptr;
  if (machine.network)
    machine.network->advance(0, films,
                             has_warm_circuit ? machine.circuit->mean_streams() : std::vector<film::OilStream>{});
  if (has_warm_circuit) machine.circuit->follow_temperatures(machine.network->temperatures());
  for (std::size_t i = 0; i < films.size(); ++i) {
    const Eigen::VectorXd& T = films[i].heat_flow.T;
    warm[i]->settle_walls(machine.network ? machine.network->walls(films[i].at, T) : T);
  }
}

std::string thermal_failure(const model::Machine& machine, bool has_failed) {
  constexpr double all_but_closed = 0.3;  // of the clearance as given
  for (const model::BuiltBearing& built : machine.bearings)
    if (const std::string why = built.bearing->thermal_failure(has_failed ? all_but_closed : bearing::seized);
        !why.empty())
      return "bearing " + built.bearing->name() + ": " + why;
  return {};
}

std::string wear_failure(const model::Machine& machine) {
  for (const model::BuiltBearing& built : machine.bearings)
    if (const std::string why = built.bearing->wear_failure(); !why.empty())
      return "bearing " + built.bearing->name() + ": " + why;
  return {};
}

}  // namespace hersey::run
