#pragma once

#include <string>

#include "hersey/film/film_model.h"

namespace hersey::film {

/// The choice of how a cavitated film is sheared, and the beginning of what the other one gives: "the cavitated film is
/// sheared over ...; over ...". For every output that tells friction.
[[nodiscard]] std::string choice_in_words(CavitatedShear shear);

}  // namespace hersey::film
