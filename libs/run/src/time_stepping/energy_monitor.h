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

/// Finds steps that gain energy from nowhere (theory manual, section "Energy that comes from nowhere"): what is stored
/// in the machine grows by more than the forces that act have put in, beyond what the balance of one step is in doubt.
/// Loss is the method's own damping and is let pass.
class EnergyMonitor {
 public:
  EnergyMonitor(const model::Model& model, model::Machine& machine);

  /// The next step begins in `state`, to which no judged step has led: at the start of a run, and after impulses.
  void begin(const solver::State& state);

  /// A step is tried: none has been refused yet.
  void begin_trial() { has_refused_ = false; }

  /// Whether a step to `end`, solved but not accepted, may stand. Asks for `begin` or `accept` before.
  [[nodiscard]] bool allows(const solver::State& end);

  /// A step to `end` whose motion is prescribed: its work is entered, not judged.
  void follow(const solver::State& end);

  /// The step judged last has been accepted.
  void accept();

  /// Whether the step judged last was not allowed.
  [[nodiscard]] bool has_refused() const { return has_refused_; }
  /// What it gained, and where.
  [[nodiscard]] std::string reason() const;

  /// Forgets what has been lost up to here.
  void count_loss_anew() { lost_ = 0; }
  /// Whether a fifth of the energy available has gone since then that nothing has taken. Not known of contacts, films
  /// and elastic bodies, whose losses are not reckoned step by step: never then.
  [[nodiscard]] bool has_lost_much() const;
  [[nodiscard]] std::string reason_of_loss() const;

  /// Energy at the start, and what has been put in or released since (integrator.32) [J].
  [[nodiscard]] double available() const { return books_.available(); }
  /// What the accepted steps have gained from nowhere and not lost again (integrator.33) [J].
  [[nodiscard]] double gained() const { return std::max(0.0, balance_); }

  void persist(Archive& archive);

 private:
  /// The sums of integrator.32, kept for each source and store by itself.
  struct Books {
    double at_start = 0;                     ///< of motion and strain [J]
    std::vector<double> put_in, most_in;     ///< by each source since the start, and the most it has been
    std::vector<double> in_store, least_in;  ///< held by each store at the start, and the least since
    double noise = 0;                        ///< energy too small to be judged
    [[nodiscard]] double available() const;
  };

  [[nodiscard]] std::vector<double> stores(const mbd::EnergyView& view) const;
  void enter(const mbd::WorkBetween& work);
  [[nodiscard]] double smallest_monitored(const mbd::EnergyView& view) const;

  model::Machine& machine_;
  std::vector<char> is_film_;  ///< of the two-body forces: those that store nothing of their own
  double potential_at_start_ = 0;
  mbd::EnergyView from_, to_;
  Books books_, trial_;
  bool is_begun_ = false, has_refused_ = false, knows_losses_ = false;
  double balance_ = 0;          ///< gained by the accepted steps; negative: lost of late
  double gain_ = 0, loss_ = 0;  ///< of the step judged last, beyond its doubt
  double lost_ = 0;             ///< since count_loss_anew
};

}  // namespace hersey::run
