#pragma once

#include "check/vocabulary.h"
#include "hersey/film/restrictor.h"

namespace hersey::model {

/// Laws of restrictors: the only definition of their formats in the model file.
[[nodiscard]] const std::vector<Alternative<film::RestrictorLaw>>& restrictor_laws();

/// The key `restrictor` of whatever is fed.
[[nodiscard]] Key restrictor_key();

}  // namespace hersey::model
