#pragma once

#include <string>

#include "hersey/film/film_model.h"

namespace hersey::film {

/// Returns the choice of how a cavitated film is sheared, and the beginning of the result of the other choice: "the
/// cavitated film is sheared over ...; over ...". Every output that states friction uses it.
[[nodiscard]] std::string choice_in_words(CavitatedShear shear);

}  // namespace hersey::film
