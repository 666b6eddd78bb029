#pragma once

#include <Eigen/Dense>
#include <optional>

#include "hersey/bearing/operating_point.h"
#include "hersey/film/film_heat.h"
#include "hersey/film/grid_transfer.h"
#include "hersey/solver/fixed_point_iteration.h"

namespace hersey::bearing {

/// Temperatures, and how far layers thin by shear, on the way to those of the film they make (thermal.16): accelerated,
/// nearer to the last ones that had a film where they have none, and step by step where acceleration goes round.
class TemperaturePath {
 public:
  /// Keeps references to `model` and `thermal`. @param start  unset: one temperature of all oil that is
  /// likely at `point` (thermal.30)
  TemperaturePath(const film::FilmModel& model, const film::ThermalModel& thermal, const OperatingPoint& point,
                  const std::optional<film::HeatState>& start);

  /// Begins instead with the temperatures of the layers of the same film on another grid, and with what the way there
  /// has shown of how film and temperatures follow each other. For walls whose heat moves nothing.
  void begin_at(const TemperaturePath& other, const film::GridTransfer& transfer);

  /// At the temperatures to be tried; once their film has been found, whoever found it advances it.
  [[nodiscard]] film::FilmHeat& heat() { return heat_; }
  [[nodiscard]] const film::FilmHeat& heat() const { return heat_; }
  /// Of the clearance, to be tried with them [m]; 0 where walls keep their size.
  [[nodiscard]] double growth() const { return growth_; }
  /// Largest change of the last iteration over the largest rise (plus 1 K).
  [[nodiscard]] double relative_distance() const { return relative_distance_; }

  /// True if a film has been found at one of the temperatures tried.
  [[nodiscard]] bool has_film() const { return last_.size() > 0; }
  /// heat() has been advanced with the film of the temperatures tried.
  void take();
  /// To the next temperatures, after `iteration` others.
  void step_on(int iteration);
  /// True if iterations that are no longer accelerated lead away from the nearest temperatures found.
  [[nodiscard]] bool leads_away() const;
  /// To be tried once more.
  void return_to_nearest() { try_next(nearest_.x); }
  /// relative_distance() of these.
  [[nodiscard]] double nearest() const { return nearest_.relative_distance; }
  /// No film has been found there: half-way back, at first to the supply's temperature. False where there is no way
  /// back.
  [[nodiscard]] bool step_back();

 private:
  [[nodiscard]] double called_for() const;
  [[nodiscard]] Eigen::VectorXd unknowns(double growth) const;
  [[nodiscard]] Eigen::Index shape_unknowns() const;
  [[nodiscard]] Eigen::Index journal_unknowns() const { return journal_per_watt_ > 0 ? 1 : 0; }
  [[nodiscard]] Eigen::Index growth_unknowns() const;
  void try_next(film::HeatState next, double growth);
  void try_next(const Eigen::VectorXd& x);
  void fill(double T_oil);

  const film::FilmModel& model_;
  const film::ThermalModel& thermal_;
  film::FilmHeat heat_;
  solver::FixedPointIteration mixing_;
  /// (thermal.38): heat into an angle of the shell's body as a temperature [K/W]; 0: that is of no account
  double per_watt_ = 0;
  double journal_per_watt_ = 0;  ///< likewise all of the heat into the journal's body
  double per_metre_ = 0;         ///< a growth of the clearance as a temperature [K/m]; 0: walls keep their size
  double growth_ = 0;
  /// Rises of temperature over the supply's [K]; what shear leaves of viscosities, heat that gives shell and journal
  /// their shapes and the growth of the clearance as if they were more of them [K]: being tried; those with which a
  /// film was found last; what that made.
  Eigen::VectorXd tried_, last_, image_;
  struct Iterate {
    Eigen::VectorXd x, image;
    double relative_distance = 1;
  };
  Iterate nearest_;              ///< of all iterations so far
  std::optional<double> T_oil_;  ///< one temperature that all oil has at first [K]
  int steps_back_ = 0;
  bool is_accelerated_ = true;
  double relative_distance_ = 1;
};

}  // namespace hersey::bearing
