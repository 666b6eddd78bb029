#pragma once

#include <span>
#include <string>
#include <string_view>

namespace hersey::bearing {

/// A quantity that is reported of a bearing. Its id means the same, in the same unit, wherever it is printed: by a
/// steady solution (`hersey bearing`: table, JSON, CSV, sensitivities), over the time of a run (results file, summary,
/// FMU) and in Python. Those that compute a quantity take its unit and its words from here.
struct Quantity {
  std::string_view id;         ///< name in every table and file: "h_min"; <...> stands for a name
  std::string_view symbol;     ///< of the theory manual; empty: it has none
  std::string_view unit;       ///< SI, degC for temperatures, "1" for a pure number
  std::string_view title;      ///< in tables and beside axes: "minimum film thickness"
  std::string_view text = {};  ///< its definition, where the title does not say all

  /// Returns the definition, or the title where that says all.
  [[nodiscard]] std::string definition() const { return std::string(text.empty() ? title : text); }
};

/// Returns the quantities of every film.
[[nodiscard]] std::span<const Quantity> film_quantities();
/// Returns the quantities of films with a temperature.
[[nodiscard]] std::span<const Quantity> heat_quantities();
/// Returns the quantities of journal bearings only.
[[nodiscard]] std::span<const Quantity> journal_quantities();
/// Returns the quantities of plane sliders only.
[[nodiscard]] std::span<const Quantity> plane_slider_quantities();
/// Returns the quantities of thrust bearings only.
[[nodiscard]] std::span<const Quantity> thrust_quantities();
/// Returns the quantities of squeeze-film dampers only.
[[nodiscard]] std::span<const Quantity> squeeze_film_damper_quantities();
/// Returns the quantities of piston skirts only.
[[nodiscard]] std::span<const Quantity> skirt_quantities();

/// Quantities that belong together, and the heading that the reference page gives them.
struct QuantityList {
  std::string_view heading;
  std::span<const Quantity> quantities;
};

/// Returns every quantity of a bearing, once each. A new kind of bearing adds its list.
[[nodiscard]] std::span<const QuantityList> bearing_quantities();

/// Returns the quantity of an id.
/// @throws ContractError  if there is none
[[nodiscard]] const Quantity& quantity(std::string_view id);

}  // namespace hersey::bearing
