#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "hersey/model/model.h"
#include "hersey/report/curve_page.h"
#include "hersey/run/orbits.h"

namespace hersey::cli {

/// A branch, and the parameter along which it was followed.
struct OrbitFindings {
  run::Branch branch;
  std::string parameter, unit;
};

/// As JSON: the parameter in its own unit, all else in SI units.
[[nodiscard]] nlohmann::json orbits_json(const OrbitFindings& found, const std::string& file);
/// As tables for a terminal.
[[nodiscard]] std::string orbits_text(const OrbitFindings& found);
/// As a page of diagrams and tables.
[[nodiscard]] report::CurvePage orbits_page(const OrbitFindings& found, const model::Model& model,
                                            const std::string& file);

}  // namespace hersey::cli
