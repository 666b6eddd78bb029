#pragma once

#include <optional>
#include <string>

#include "hersey/fmi/description.h"
#include "hersey/model/model.h"
#include "variables.h"

namespace hersey::fmu {

/// The library of an FMU, without its suffix.
inline constexpr const char* kModelIdentifier = "hersey_fmu";

/// modelDescription.xml of FMI 2.0 or 3.0.
/// @param version  2 or 3
[[nodiscard]] std::string description_xml(const model::Model& model, const Variables& variables, int version);

/// Text of an attribute of XML: quotes and brackets are escaped, line ends are spaces.
[[nodiscard]] std::string escaped(const std::string& text);

/// What a unit of a variable is made of: an SI unit, "N.m.s/rad", or degC, in which results have temperatures.
/// @returns nothing if the text is not a unit
[[nodiscard]] std::optional<fmi::Unit> definition_of(const std::string& unit);

/// Attributes of the element BaseUnit that defines a unit, in FMI and in SSP.
[[nodiscard]] std::string base_unit_attributes(const fmi::Unit& unit);

/// Returns documentation/index.html: the model, its variables, and the treatment of time.
[[nodiscard]] std::string documentation_html(const model::Model& model, const Variables& variables, int version);

}  // namespace hersey::fmu
