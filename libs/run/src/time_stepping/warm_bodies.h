#pragma once

#include <string>

#include "hersey/model/machine.h"

namespace hersey::run {

/// After a step of length dt [s] has been accepted: the lumped bodies of the thermal network take up what all films
/// give them over it, and the films' walls have their temperatures (theory manual, thermal.47). Nothing where there is
/// no network.
void warm_bodies(model::Machine& machine, double dt);

/// After the last step of a cycle: walls that are held, bodies of the network among them, take the temperatures at
/// which the cycle's mean heat would pass them by (theory manual, thermal.19).
void settle_walls(model::Machine& machine);

/// What temperatures have done to a film that cannot go on from there: "bearing main: a seizure ..."; else empty.
/// @param has_failed  the next step has found no end: a clearance that has all but closed is then why
[[nodiscard]] std::string thermal_failure(const model::Machine& machine, bool has_failed = false);

}  // namespace hersey::run
