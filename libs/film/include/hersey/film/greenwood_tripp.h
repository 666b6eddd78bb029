#pragma once

#include "hersey/film/value_and_slope.h"

namespace hersey::film {

/// F_{5/2}(H) = 1/sqrt(2 pi) int_H^inf (s - H)^{5/2} exp(-s^2/2) ds, the pressure integral of Greenwood and Tripp
/// (film.40), and its derivative -5/2 F_{3/2}(H). Relative error below 1e-12 for -4 <= H <= 8; zero beyond H = 8, where
/// F < 1e-17.
/// @see Greenwood & Tripp (1970), Proc. IMechE 185, 625-633.
[[nodiscard]] ValueAndSlope greenwood_tripp_exact(double H);

/// The customary fit of F_{5/2}: 4.4086e-5 (4 - H)^6.804 below H = 4, zero above. It is 4 to 11 % low for H <= 2 and
/// 74 % low at H = 3.
[[nodiscard]] ValueAndSlope greenwood_tripp_fit(double H);

}  // namespace hersey::film
