#pragma once

#include "check/vocabulary.h"
#include "hersey/circuit/laws.h"

// Words of the oil circuit.
namespace hersey::model {

inline constexpr Vocabulary<circuit::Friction, 2> friction_words{{
    {circuit::Friction::churchill, "churchill", "laminar, transitional or turbulent by the Reynolds number"},
    {circuit::Friction::laminar, "laminar",
     "as in laminar flow at every Reynolds number: to compare with closed forms"},
}};

}  // namespace hersey::model
