#pragma once

#include <optional>
#include <string>
#include <vector>

#include "check/check.h"
#include "interpret/composites/composite_parts.h"

// Composites by themselves: their operating points, and what is around their parts then.
namespace hersey::model {

/// Reads the operating point of a journal in a composite, and the whirl ratio. Reports what is wrong with it; empty if
/// none is given.
void read_journal_of_composite(const Value& bearing, CompositeParts& parts, std::vector<Fault>& faults);

/// The same of a collar.
void read_collar_of_composite(const Value& bearing, CompositeParts& parts, std::vector<Fault>& faults);

/// A model file with a body `journal` that rotates at its speed, loaded or where it is said to be, and nothing else.
/// @param parts  their point's speed is 1 rad/s where none is given
[[nodiscard]] std::string journal_alone(const CompositeParts& parts);

/// A model file with a body `collar` that rotates at its speed, loaded along z or where it is said to be. It moves
/// along z, then leans, then rotates: joints `distance`, `tilts` and `rotation`. Its mass leans, but does not rotate.
[[nodiscard]] std::string collar_alone(const CompositeParts& parts);

}  // namespace hersey::model
