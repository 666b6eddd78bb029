#pragma once

#include <Eigen/Dense>

#include "hersey/bearing/film_observation.h"
#include "hersey/core/archive.h"
#include "hersey/film/film_observables.h"
#include "hersey/film/reynolds.h"

namespace hersey::bearing {

/// Oil of one film, step by step and over a run (theory manual, film.15): what the film holds, what has passed, and
/// what remains unexplained.
class OilBalance {
 public:
  /// Initial oil content of the film at `u`; flows are undefined.
  void initialise(const film::FilmModel& model, const film::SurfaceMotion& motion, const film::FilmHistory& history,
                  const Eigen::VectorXd& u);
  /// Flows of the step that ends at `u`, as means over it. Uses up the linearisation of `reynolds`.
  void close_step(film::Reynolds& reynolds, const film::SurfaceMotion& motion, const film::FilmHistory& history,
                  const Eigen::VectorXd& u);
  /// The same of a step that ends at the state which `reynolds` has evaluated last.
  void close_step(film::Reynolds& reynolds);
  /// Adds the step closed last, of length dt [s], to the run.
  void accumulate(double dt);

  /// Balance of the step closed last.
  [[nodiscard]] const film::StepOilBalance& of_step() const { return step_; }
  /// Balance since the start.
  [[nodiscard]] const CumulativeOilBalance& of_run() const { return run_; }

  /// Replaces the flows at the end of a step of length dt [s] by means over it; leaves them at dt = 0.
  /// @param sliding_flow  scale of the flow that surfaces carry [m^3/s]
  void report_flows(double dt, double sliding_flow, film::FilmObservables& film) const;

  /// Saves or restores the balance of the run.
  void persist(Archive& archive);

 private:
  film::StepOilBalance step_;
  CumulativeOilBalance run_;
};

}  // namespace hersey::bearing
