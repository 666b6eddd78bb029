#pragma once

#include "hersey/film/density_law.h"
#include "hersey/film/viscosity_law.h"
#include "vocabulary.h"

namespace hersey::model {

/// Laws of viscosity against pressure: the one place where the model file's formats of them are read.
[[nodiscard]] const std::vector<Alternative<film::ViscosityLaw>>& viscosity_laws();

/// Laws of density against pressure.
[[nodiscard]] const std::vector<Alternative<film::DensityLaw>>& density_laws();

}  // namespace hersey::model
