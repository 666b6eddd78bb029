#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "hersey/model/model.h"
#include "hersey/report/curve_page.h"
#include "hersey/study/rotor_study.h"

namespace hersey::cli {

/// Everything that `hersey rotor` has found.
struct RotorFindings {
  std::vector<study::RotorAtSpeed> rotor;
  std::vector<study::DampedCriticalSpeed> criticals;
  std::vector<study::ResponsePeak> peaks;
  std::optional<study::OperatingRange> operating;
  std::optional<study::StabilityScreening> screening;
  std::string screened_at;    ///< station of the cross-coupled stiffness
  double screened_speed = 0;  ///< [rad/s]
  std::optional<study::CriticalSpeedMap> map;
};

/// What the sweep does not tell of peaks, a sentence or two for each that its speeds are too far apart for.
[[nodiscard]] std::vector<std::string> remarks_on_peaks(const RotorFindings& found);
/// The bearing of that name at a speed; null where it has none.
[[nodiscard]] const run::RotorBearing* bearing_called(const study::RotorAtSpeed& at, const std::string& name);
/// As JSON, speeds in rpm, all else in SI units.
[[nodiscard]] nlohmann::json rotor_json(const RotorFindings& found, const std::string& file);
/// As tables for a terminal.
[[nodiscard]] std::string rotor_text(const RotorFindings& found);
/// As a page of diagrams and tables.
[[nodiscard]] report::CurvePage rotor_page(const RotorFindings& found, const model::Model& model,
                                           const std::string& file);

}  // namespace hersey::cli
