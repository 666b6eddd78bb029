#include "hersey/mbd/restitution.h"

#include <cmath>

#include "hersey/core/contract.h"

namespace hersey::mbd {
namespace {

/// u - ln(1 + u) by its series where the difference would be round-off: what an impact's speed u = a v is worth.
double worth(double u) {
  if (std::abs(u) > 1e-2) return u - std::log1p(u);
  double sum = 0, power = u * u;
  for (int k = 2; k < 12; ++k, power *= -u) sum += power / k;
  return sum;
}

/// Coming in with d and leaving with -e d is worth the same.
double leaving(double d) {
  double low = 0, high = d < 1 ? d : 1.0;  // of e d
  for (int i = 0; i < 200 && high - low > 1e-16 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (worth(-middle) < worth(d) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double restitution(double damping, double speed) {
  HERSEY_REQUIRE(damping >= 0 && speed > 0, "something hits something");
  const double d = damping * speed;
  return d < 1e-12 ? 1.0 : leaving(d) / d;
}

double damping_of_restitution(double restitution, double speed) {
  HERSEY_REQUIRE(0 < restitution && restitution <= 1 && speed > 0, "what hits comes back, and no faster");
  if (restitution == 1) return 0;
  double low = std::log(1e-12), high = std::log(1e12);  // of d: e falls with it
  for (int i = 0; i < 200 && high - low > 1e-15; ++i) {
    const double middle = 0.5 * (low + high), d = std::exp(middle);
    (leaving(d) / d > restitution ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high)) / speed;
}

}  // namespace hersey::mbd
