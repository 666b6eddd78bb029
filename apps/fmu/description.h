#pragma once

#include <string>

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

/// Exponents of kg, m, s, A, K, mol, cd, rad in an SI unit, "N.m.s/rad".
/// @returns false if the text is not a unit
bool exponents_of(const std::string& unit, int (&exponents)[8]);

/// Returns documentation/index.html: the model, its variables, and the treatment of time.
[[nodiscard]] std::string documentation_html(const model::Model& model, const Variables& variables, int version);

}  // namespace hersey::fmu
