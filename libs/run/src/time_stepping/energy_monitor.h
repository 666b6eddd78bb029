#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "hersey/core/archive.h"
#include "hersey/mbd/energy_view.h"
#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "hersey/solver/equations.h"

namespace hersey::run {

/// Finds steps that gain energy without a source (theory manual, section "Energy that comes from nowhere"): the energy
/// stored in the machine grows by more than the work of the acting forces and the uncertainty of the step's balance. A
/// loss is the method's own damping and is allowed.
class EnergyMonitor {
 public:
  EnergyMonitor(const model::Model& model, model::Machine& machine);

  /// Starts a step in `state` that was not reached by a checked step: at the start of a run, and after impulses.
  void begin(const solver::State& state);

  /// Starts all sums anew in a motion that takes the place of the machine's own.
  void begin_anew(const solver::State& state);

  /// Starts a trial step; none has been refused yet.
  void begin_trial() { has_refused_ = false; }

  /// True if a step to `end`, solved but not yet accepted, is allowed.
  /// @pre `begin` or `accept` was called before
  [[nodiscard]] bool allows(const solver::State& end);

  /// Enters the work of a step to `end` whose motion is prescribed, without a check.
  void follow(const solver::State& end);

  /// Accepts the step checked last.
  void accept();

  /// True if the step checked last was not allowed.
  [[nodiscard]] bool has_refused() const { return has_refused_; }
  /// Reason of the refusal: the gained energy and its location.
  [[nodiscard]] std::string reason() const;

  /// Resets the loss to zero.
  void count_loss_anew() { lost_ = 0; }
  /// True if, since the last reset, a fifth of the available energy was lost without a sink. Always false with
  /// contacts, films and elastic bodies, whose losses are not known step by step.
  [[nodiscard]] bool has_lost_much() const;
  [[nodiscard]] std::string reason_of_loss() const;

  /// Energy at the start and energy put in or released since (integrator.32) [J].
  [[nodiscard]] double available() const { return books_.available(); }
  /// Energy that accepted steps gained without a source and did not lose again (integrator.33) [J].
  [[nodiscard]] double gained() const { return std::max(0.0, balance_); }

  void persist(Archive& archive);

 private:
  /// The sums of integrator.32, separately for each source and store.
  struct Books {
    double at_start = 0;                     ///< of motion and strain [J]
    std::vector<double> put_in, most_in;     ///< work of each source since the start, and its largest value so far
    std::vector<double> in_store, least_in;  ///< energy in each store at the start, and its least value since
    double noise = 0;                        ///< energy below which nothing is checked
    [[nodiscard]] double available() const;
  };

  [[nodiscard]] std::vector<double> stores(const mbd::EnergyView& view) const;
  void enter(const mbd::WorkBetween& work);
  [[nodiscard]] double smallest_monitored(const mbd::EnergyView& view) const;

  model::Machine& machine_;
  std::vector<char> is_film_;  ///< true for two-body forces that store no energy of their own
  double potential_at_start_ = 0;
  mbd::EnergyView from_, to_;
  Books books_, trial_;
  bool is_begun_ = false, has_refused_ = false, knows_losses_ = false;
  double balance_ = 0;          ///< gained by the accepted steps; negative: lost of late
  double gain_ = 0, loss_ = 0;  ///< gain and loss of the step checked last, beyond the uncertainty of its balance
  double lost_ = 0;             ///< since count_loss_anew
};

}  // namespace hersey::run
