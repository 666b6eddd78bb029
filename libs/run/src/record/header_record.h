#pragma once

#include <vector>

#include "hersey/model/build.h"
#include "hersey/run/options.h"
#include "hersey/run/summary.h"
#include "record/quantity.h"

namespace hersey::run {

/// Writes what a results file says of its run: program, model, parameters, what decides the results.
void write_header(const model::Model& model, const model::Machine& machine, const solver::State& start,
                  const Options& options, results::Writer& writer);

/// What that is, and what the writer of the file says by itself.
[[nodiscard]] std::vector<QuantityGroup> describe_header();

/// Writes what the steps have done to the figures of one bearing.
void write_step_errors(const std::string& bearing, const StepErrors& errors, results::Writer& writer);

[[nodiscard]] QuantityGroup describe_step_errors();

}  // namespace hersey::run
