#pragma once

#include "schema_type.h"

namespace hersey::model {

/// The format of the model file.
[[nodiscard]] const Type& model_format();

// Its parts, one per file.
[[nodiscard]] TypePtr bodies_format();
[[nodiscard]] TypePtr shapes_format();
[[nodiscard]] TypePtr joints_format();
[[nodiscard]] TypePtr drives_format();
[[nodiscard]] TypePtr forces_format();
[[nodiscard]] TypePtr lubricants_format();
[[nodiscard]] TypePtr bearings_format();
[[nodiscard]] TypePtr features_format();
[[nodiscard]] TypePtr shape_format();
[[nodiscard]] TypePtr grid_format();
[[nodiscard]] TypePtr simulation_format();
[[nodiscard]] TypePtr output_format();
[[nodiscard]] TypePtr study_format();

/// A constant, an expression or a table whose value is in one of `si_units`.
[[nodiscard]] TypePtr function_format(const std::vector<std::string>& si_units, const std::string& example);

}  // namespace hersey::model
