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

/// Course of a drilling in a body that rotates.
enum class Course { one_side, through_axis };

inline constexpr Vocabulary<Course, 2> course_words{{
    {Course::one_side, "one_side", "both ends lie on one side of the axis, or the bore does not pass it"},
    {Course::through_axis, "through_axis",
     "straight through the axis to the other side: `circuit/axis_pressure_<element>` says whether its oil holds "
     "together there"},
}};

}  // namespace hersey::model
