#pragma once

#include <Eigen/Dense>
#include <limits>

#include "balance/flow_balance.h"

namespace hersey::film {

/// Angles at which the film at mid-width ruptures and re-forms: the ends of its widest cavity, in the order in which
/// the flow passes them [rad], from 0 to 2 pi; NaN where the film is full everywhere or cavitated everywhere (theory
/// manual, film.56).
struct Cavity {
  double rupture = std::numeric_limits<double>::quiet_NaN(), reformation = rupture;
};

/// @param u  the film's unknowns, below 0 in a cavity
/// @param backwards  the flow goes towards smaller angles
[[nodiscard]] Cavity widest_cavity(const FlowBalance& balance, const Eigen::VectorXd& u, bool backwards);

}  // namespace hersey::film
