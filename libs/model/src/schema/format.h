#pragma once

#include "check/schema_type.h"

namespace hersey::model {

/// The format of the model file.
[[nodiscard]] const Type& model_format();

// Its parts, one per file.
[[nodiscard]] TypePtr bodies_format();
[[nodiscard]] TypePtr flexible_format();
[[nodiscard]] TypePtr beam_format();
[[nodiscard]] TypePtr shapes_format();
[[nodiscard]] TypePtr joints_format();
[[nodiscard]] TypePtr fmus_format();
[[nodiscard]] TypePtr drives_format();
[[nodiscard]] TypePtr forces_format();
[[nodiscard]] TypePtr couplings_format();
[[nodiscard]] TypePtr contacts_format();
[[nodiscard]] TypePtr lubricants_format();
[[nodiscard]] TypePtr circuit_format();
/// Key of a feature that a node of the circuit feeds.
[[nodiscard]] Key circuit_node_key();
[[nodiscard]] TypePtr bearings_format();
[[nodiscard]] TypePtr thermal_format();
[[nodiscard]] TypePtr thermal_network_format();
[[nodiscard]] TypePtr features_format();
[[nodiscard]] TypePtr shape_format();
[[nodiscard]] TypePtr grid_format();
[[nodiscard]] TypePtr simulation_format();
[[nodiscard]] TypePtr output_format();
[[nodiscard]] TypePtr study_format();

/// Format of the use of a template.
[[nodiscard]] TypePtr template_format();
/// See template_format().
[[nodiscard]] TypePtr use_format();

/// A rotation of axes: about an axis by an angle.
[[nodiscard]] TypePtr rotation_format();

/// A direction: a frame's x, y or z, or three numbers.
[[nodiscard]] TypePtr axis_format();

/// A constant, an expression, a table or the output of an FMU whose value is in one of `si_units`.
[[nodiscard]] TypePtr function_format(const std::vector<std::string>& si_units, const std::string& example);

/// What an input of an FMU is given: the name of a quantity or a number, an expression in time or a table over it.
[[nodiscard]] TypePtr fmu_input_format();

/// A function of one thing called `argument`: a constant, an expression in it or a table over it.
[[nodiscard]] TypePtr law_format(const std::string& si_unit, const std::string& argument,
                                 const std::string& argument_unit, const std::string& example);

/// A coordinate as a function of another, called `input`.
[[nodiscard]] TypePtr relation_format();

}  // namespace hersey::model
