#pragma once

#include <string>

#include "hersey/results/writer.h"

namespace hersey::report {

/// The latest instant of a writer in memory that keeps all, as JSON of one run as the page reads it (web/src/data.ts):
/// attributes and datasets by path, numbers in base64, without descriptions of the datasets.
/// @param name  of the run
/// @verified_by instant_test.cpp
[[nodiscard]] std::string instant_json(const results::Writer& writer, const std::string& name);

}  // namespace hersey::report
