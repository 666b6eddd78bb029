#pragma once

#include <string>

#include "hersey/model/machine.h"

namespace hersey::run {

/// Advances, after an accepted step of length dt [s], the lumped bodies of the thermal network by the heat that all
/// films gave them over it, and by the oil of a circuit, and sets the films' walls and the circuit's nodes to their
/// temperatures (theory manual, thermal.47). Does nothing without a network.
void warm_bodies(model::Machine& machine, double dt);

/// Adds the oil between nodes of a circuit with temperatures in a step of `dt` [s] to the means of a cycle.
void average_streams(model::Machine& machine, double dt);

/// Mixes the oil in grooves between films, by their flows at the state last accepted, and gives it to the films that
/// draw it (theory manual, thermal.68). Does nothing without grooves.
void mix_grooves(model::Machine& machine);

/// Sets, after the last step of a cycle, quasi-steady walls, bodies of the network among them, to the temperatures at
/// which the cycle's mean heat would flow through them (theory manual, thermal.19).
void settle_walls(model::Machine& machine);

/// Describes a thermal failure of a film that cannot continue: "bearing main: a seizure ..."; else empty.
/// @param has_failed  the next step did not converge: an almost closed clearance is then the reason
[[nodiscard]] std::string thermal_failure(const model::Machine& machine, bool has_failed = false);

/// Names a bearing one of whose linings has been worn off; empty where there is none.
[[nodiscard]] std::string wear_failure(const model::Machine& machine);

}  // namespace hersey::run
