#pragma once

#include <atomic>
#include <functional>
#include <optional>

#include "hersey/core/outcome.h"
#include "time_stepping/machine_run.h"

namespace hersey::run {

/// Map of a machine over one of its periods, from the motion at its start to that at its end. Time goes on from period
/// to period.
///
/// The period of a machine that oscillates by itself is not given: its map leads from a section across the motion back
/// to it, and finds how long that takes (theory manual, integrator.47). Angles that go round are no part of such a
/// motion.
class PeriodMap {
 public:
  /// @param run  begun; outlives this
  /// @param period  [s], > 0
  /// @param stop  set from outside: a period ends with its step; null: none does
  PeriodMap(MachineRun& run, double period, const std::atomic<bool>* stop);

  /// Divides each period into `count` steps of equal length, which differ little from those of the model.
  void divide(int count) { steps_ = count; }

  /// Runs periods one after the other until the motion grows no more.
  /// @param most  periods
  /// @pre divided, without a section
  [[nodiscard]] Outcome wait_while_it_grows(int most);
  /// Lays a section across the motion of a machine whose period is about period(), where it is after some periods.
  /// @param most  periods to wait for a motion that nearly returns
  /// @param on_period  called at the end of each; may be empty
  /// @pre divided
  [[nodiscard]] Outcome lay_section(int most, const std::function<void()>& on_period = {});
  /// Lays the section of another map of the same machine.
  void lay_section_of(const PeriodMap& other) { section_ = other.section_; }
  /// Lays the section across the start of the last period.
  void lay_section_at_start();
  /// Returns `motion`, which is near the section, moved onto it in the direction in which motions pass it.
  [[nodiscard]] Motion onto_section(const Motion& motion) const;

  /// Runs one period on from where the machine is.
  [[nodiscard]] Outcome take();
  /// Runs one period on from `start`. If it fails, the machine is where it was.
  [[nodiscard]] Outcome take_from(const Motion& start);

  /// Motion at the end of the last period; with a section, on it.
  [[nodiscard]] Motion motion();
  [[nodiscard]] const mbd::Mechanism& mechanism() const { return run_.mechanism(); }
  /// Length of the last period, or the one that is expected [s].
  [[nodiscard]] double period() const { return period_; }
  void expect_period(double period) { period_ = period; }

  /// Returns way_between() two motions, positions and velocities in shares of how far they went in the last period.
  [[nodiscard]] Eigen::VectorXd way(const Motion& from, const Motion& to) const;
  /// Number of positions and velocities, which come first in a way.
  [[nodiscard]] Eigen::Index coordinates() const { return 2 * mechanism().nv(); }
  /// Takes positions and velocities of a way in shares of how far they went in the last period.
  void compare_by_swing(Eigen::VectorXd& way) const;
  /// Number of independent deviations of a motion without films: of the coordinates that move, and their velocities,
  /// less one on a section. With films more than any number that is asked for.
  [[nodiscard]] Eigen::Index dimension();
  /// How far positions and velocities went in the last period.
  [[nodiscard]] const Swing& swing() const { return swing_; }

 private:
  // Plane through a motion, across the direction in which it goes on.
  struct Section {
    Motion at, next;            // a step later
    Eigen::VectorXd sizes;      // swing with which positions and velocities are compared
    Eigen::VectorXd direction;  // way of that step
  };

  [[nodiscard]] Outcome take_steps(double end);
  [[nodiscard]] Outcome take_to_section();
  [[nodiscard]] double beyond_section(const Motion& motion) const;
  [[nodiscard]] Motion with_rings_of_the_machine(const Motion& motion) const;

  MachineRun& run_;
  double period_;
  const std::atomic<bool>* stop_;
  Swing swing_;
  double end_;
  int steps_ = 0;  // 0: those of the model
  std::optional<Section> section_;
  std::optional<Motion> returned_;
  Motion first_, second_;  // of the last period that began at a section: its start, and a step later
};

}  // namespace hersey::run
