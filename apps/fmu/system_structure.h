#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hersey/model/model.h"
#include "variables.h"

namespace hersey::fmu {

/// The changes by which a model with FMUs becomes that of its machine alone, an FMU among others: no `fmus`, and a
/// force or speed of 0, which is an input, where an output was followed.
[[nodiscard]] std::vector<std::string> changes_to_machine(const model::Model& model);

/// What the model says of outputs between exchanges and a system cannot, "forces.motor.magnitude.hold: ramp".
[[nodiscard]] std::vector<std::string> lost_holds(const model::Model& model);

/// Name of the machine among its FMUs: "machine", or one that none of them has.
[[nodiscard]] std::string machine_name(const model::Model& model);

/// The text of a SystemStructure.ssd (SSP 1.0, chapter 4): the machine and the FMUs of the model as components in
/// `resources/`, what they exchange as connections, and start values as parameter sets.
/// @param model    with its FMUs
/// @param machine  variables of the FMU of its machine
/// @throws InputError where an input of an FMU is a function of time or an expression, which is no connection
/// @verified_by tests/fmu/ssp_test.py
[[nodiscard]] std::string system_structure_xml(const model::Model& model, const Variables& machine);

}  // namespace hersey::fmu
