#pragma once

#include <Eigen/Dense>
#include <limits>

#include "hersey/bearing/film_force.h"
#include "hersey/core/archive.h"

namespace hersey::run {

/// An extreme value on the film, when and where.
struct FilmExtreme {
  double value = 0;
  double t = 0;           ///< [s]
  double phi = 0, z = 0;  ///< [rad, m]
};

/// Results of one bearing over one cycle, or over a whole run without cycles. Maps are over the nodes, shape (n_phi
/// n_z).
struct BearingCycle {
  double begin = 0, end = 0;       ///< [s]
  double energy_film = 0;          ///< viscous dissipation [J]
  double energy_asperity = 0;      ///< boundary friction [J]
  double way = 0;                  ///< of a skirt along its liner, from where it was at the begin [m]
  double lowest = 0, highest = 0;  ///< extremes of `way` [m]
  FilmExtreme moft, pofp;          ///< minimum oil film thickness [m], peak oil film pressure [Pa]
  FilmExtreme contact;             ///< largest contact pressure of a node [Pa]
  FilmExtreme hottest;             ///< hottest oil [K]; 0 K of a film without temperatures
  film::WallCorrection walls;      ///< error of quasi-steady walls in this cycle
  Eigen::VectorXd mean_contact;    ///< contact pressure p_a, mean over time [Pa]
  Eigen::VectorXd wear_load;       ///< p_a times sliding speed, mean over time [W/m^2]
  Eigen::VectorXd h_min, t_h_min;  ///< smallest film thickness [m] and when [s]
  Eigen::VectorXd p_max, t_p_max;  ///< largest film pressure [Pa] and when [s]
  [[nodiscard]] double duration() const { return end - begin; }
  [[nodiscard]] double stroke() const { return highest - lowest; }

  /// Friction mean effective pressure (skirt.11) of a skirt in a liner of radius R [Pa]; NaN of one that does not move.
  [[nodiscard]] double friction_mean_effective_pressure(double R) const;
};

/// Gathers a bearing's accepted states into cycles. Integrals over time are by the trapezoidal rule.
class CycleSums {
 public:
  explicit CycleSums(const film::FilmModel& model) : model_(model) {}

  /// The bearing at time `t`; the first call begins the first cycle.
  void take(double t, const bearing::BearingObservation& observation, const film::FilmFields& fields);

  /// Ends the cycle with the last state taken; the next cycle begins there.
  /// @pre a state was taken.
  [[nodiscard]] BearingCycle close();

  /// The cycle under way.
  void persist(Archive& archive);

  /// Time since the beginning of the cycle [s].
  [[nodiscard]] double duration() const { return is_begun_ ? cycle_.end - cycle_.begin : 0; }

 private:
  struct Sample {
    double power_film = 0, power_asperity = 0, sliding_speed = 0;
    double speed = 0;  // of a journal [rad/s], along a straight way [m/s]
    Eigen::VectorXd contact;
    FilmExtreme moft, pofp, hottest;
    film::WallCorrection walls;
    Eigen::VectorXd h, p;
  };

  void begin(double t);
  void integrate(double dt, const Sample& next);
  void compare(double t);

  const film::FilmModel& model_;
  BearingCycle cycle_;  // means as integrals
  Sample last_;
  bool is_begun_ = false;
};

}  // namespace hersey::run
