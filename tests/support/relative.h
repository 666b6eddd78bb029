#pragma once

#include <doctest/doctest.h>

namespace hersey {

/// What a value is compared with relative to its own size. doctest's Approx takes its epsilon of that size plus one: a
/// flow of 1e-6 m^3/s or a film of 15e-6 m would be approximately anything.
inline doctest::Approx relative(double value) { return doctest::Approx(value).scale(0); }

}  // namespace hersey
