#pragma once

#include <Eigen/Dense>

namespace hersey::film {

class FlowBalance;

/// Which nodes of a film are full and which are not, and what a Newton step from there does about nodes that change
/// sides. A solution stays as it is.
class ActiveSet {
 public:
  /// @param balance  evaluated at the state from which the step goes; kept by reference
  explicit ActiveSet(const FlowBalance& balance) : balance_(&balance) {}

  /// In `reynolds` D0 u is the oil that a cavitated node lacks. Where a step `du` from `u`, the state of the last
  /// evaluation, finds more than enough, the node is full in the next, and its u the pressure that presses the excess
  /// out: over conductances that are many thousand times D0 in a deep pocket. By D0, laws of viscosity would see
  /// pressures that are none, and Newton's method would cycle (film.31). Where all laws are constant the next step does
  /// not depend on it. Comes before the step is taken.
  void press_filled_nodes(const Eigen::VectorXd& u, Eigen::VectorXd& du) const;

  /// A Newton step takes every full node to pass on a full gap. Where the step to `u` has emptied one, all those
  /// downstream that live on its oil would follow only one per iteration: they are emptied here in one sweep with the
  /// flow (film.33). Nodes whose neighbours hold them full stay as they are. For `mass_conserving`; comes after the
  /// step.
  void advance_rupture_front(Eigen::VectorXd& u) const;

 private:
  const FlowBalance* balance_;
};

}  // namespace hersey::film
