#pragma once

#include <vector>

#include "hersey/model/build.h"
#include "hersey/run/options.h"
#include "hersey/run/summary.h"
#include "table/quantity.h"

namespace hersey::run {

/// Writes the header of a results file: program, model, parameters, assumptions.
void write_header(const model::Model& model, const model::Machine& machine, const solver::State& start,
                  const Options& options, results::Writer& writer);

/// Describes the header, and the attributes that the writer of the file adds.
[[nodiscard]] std::vector<QuantityGroup> describe_header();

/// Writes the errors that the steps cause in the figures of one bearing.
void write_step_errors(const std::string& bearing, const StepErrors& errors, results::Writer& writer);

[[nodiscard]] QuantityGroup describe_step_errors();

}  // namespace hersey::run
