#pragma once

#include <Eigen/Dense>

#include "hersey/core/archive.h"
#include "hersey/mbd/two_body_force.h"
#include "hersey/solver/fixed_point_iteration.h"

namespace hersey::bearing {

/// Partitioned coupling of one film (theory manual, bearing.16): the wrench on the journal and the forces on shapes
/// that the bodies have been given, corrected by what the film answers. A step whose exchange does not converge is
/// taken monolithically, shortened, and so are the next ones.
class WrenchExchange {
 public:
  /// @param amplitudes  of the deforming surfaces
  /// @param radius  by which moments are divided, so that all exchanged entries are forces of comparable size [m]
  WrenchExchange(solver::Acceleration acceleration, double relaxation, Eigen::Index amplitudes, double radius);

  /// Starts a step from what the last accepted one exchanged.
  void begin_step();
  /// True if the steps that follow an exchange without convergence are still solved as one system.
  [[nodiscard]] bool is_suspended() const { return monolithic_steps_left_ > 0; }

  /// False for the first surfaces of a step: these are a prediction, no answer to any wrench yet.
  [[nodiscard]] bool has_response() const { return has_response_; }
  /// Counts one more exchange, before the film is asked.
  void begin_exchange() { ++exchanges_; }
  /// Corrects the wrench given last by the film's answer to it. @returns their relative difference [-]
  double correct(const mbd::ForceResponse& answer);
  /// Writes the wrench and forces that the bodies are given.
  void give(mbd::ForceResponse& response);
  /// Takes over forces that a monolithic evaluation found.
  void set(const mbd::ForceResponse& response);

  /// The bodies have converged.
  void end_exchange() { has_ended_ = true; }
  void accept_step();
  /// Wrenches exchanged in the current step.
  [[nodiscard]] int exchanges() const { return exchanges_; }

  /// Saves or restores what the next step starts from.
  void persist(Archive& archive);
  /// Saves or restores how far the exchange of the last step has come.
  void persist_step(Archive& archive);

 private:
  solver::FixedPointIteration iteration_;
  double radius_;
  Eigen::VectorXd wrench_, wrench_start_;  ///< [moment; force; forces on shapes]: now, at the start of the step
  bool has_response_ = false;
  bool has_ended_ = false;
  int exchanges_ = 0;
  int monolithic_steps_left_ = 0;  ///< before the exchange is tried again
};

}  // namespace hersey::bearing
