#pragma once

#include <complex>
#include <vector>

#include "hersey/core/outcome.h"
#include "time_stepping/shooting.h"

namespace hersey::run {

/// Periods that the search for `count` multipliers takes at most.
[[nodiscard]] constexpr int most_periods_for_multipliers(int count) { return 5 + 4 * count; }

/// Factors by which small deviations from a periodic motion change over one period, the largest first; of a pair of
/// conjugates the one with a positive imaginary part. Deviations grow where one is beyond the unit circle.
struct [[nodiscard]] FloquetMultipliers : Outcome {
  /// A period from a motion near the periodic one.
  struct Trial {
    Motion start, end;
    double period = 0;  ///< its length [s]
  };
  std::vector<std::complex<double>> values;
  int periods = 0;            ///< run
  std::vector<Trial> trials;  ///< those periods, that of the periodic motion first
};

/// Finds the largest multipliers of a periodic motion by Arnoldi's method on the map over one period, whose product
/// with a deviation is the difference of two periods (theory manual, integrator.45): all that a machine remembers takes
/// part, oil in films and temperatures too.
/// @param count  of multipliers, conjugate pairs counting once
/// @param starts  number of motions near it, the last of found.near, whose deviations have to be followed: a motion
/// that
///        is the same from all sides has deviations of which no period ever makes others
[[nodiscard]] FloquetMultipliers floquet_multipliers(PeriodMap& map, const Shooting& found, int count,
                                                     std::size_t starts = 1);

}  // namespace hersey::run
