#pragma once

#include <string>

#include "hersey/model/machine.h"

namespace hersey::run {

/// After a step of length dt [s] has been accepted: the lumped bodies of the thermal network take up what all films
/// give them over it, and the films' walls have their temperatures (theory manual, thermal.37). Nothing where there is
/// no network.
void warm_bodies(model::Machine& machine, double dt);

/// What temperatures have done to a film that cannot go on from there: "bearing main: a seizure ..."; else empty.
/// @param has_failed  the next step has found no end: a clearance that has all but closed is then why
[[nodiscard]] std::string thermal_trouble(const model::Machine& machine, bool has_failed = false);

}  // namespace hersey::run
