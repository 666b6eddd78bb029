#pragma once

namespace hersey::solver {

/// Parameters of generalized-alpha for the spectral radius `rho` of the highest frequencies, 0..1 (Chung and Hulbert
/// 1993; theory manual eq. (integrator.4)).
struct AlphaParameters {
  /// @param rho  spectral radius at infinite frequency, 0..1
  explicit AlphaParameters(double rho = 0.8)
      : alpha_m((2 * rho - 1) / (rho + 1)),
        alpha_f(rho / (rho + 1)),
        gamma(0.5 + alpha_f - alpha_m),
        beta(0.25 * (gamma + 0.5) * (gamma + 0.5)) {}
  double alpha_m, alpha_f, gamma, beta;
};

}  // namespace hersey::solver
