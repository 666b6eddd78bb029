#include "hersey/circuit/friction_factor.h"

#include <cmath>

namespace hersey::circuit {

// (circuit.4), with 64/Re taken out: nothing overflows as the flow comes to rest, where B outgrows every number and the
// ratio is 1.
FrictionRatio friction_ratio(double Re, double roughness) {
  if (Re <= 0) return {};
  const double smooth = std::pow(7 / Re, 0.9);
  const double a = smooth + 0.27 * roughness;
  const double y = -2.457 * std::log(a), y_slope = 2.457 * 0.9 * smooth / a;
  const double A = std::pow(y, 16), A_slope = 16 * std::pow(y, 15) * y_slope;
  const double B = std::pow(37530 / Re, 16), B_slope = -16 * B;
  const double sum = A + B;
  if (!std::isfinite(sum)) return {};
  const double turbulent = std::pow(Re / 8, 12) * std::pow(sum, -1.5);
  const double turbulent_slope = turbulent * (12 - 1.5 * (A_slope + B_slope) / sum);
  return {std::pow(1 + turbulent, 1.0 / 12), turbulent_slope / (12 * (1 + turbulent))};
}

double friction_factor(double Re, double roughness) { return 64 / Re * friction_ratio(Re, roughness).value; }

}  // namespace hersey::circuit
