#pragma once

#include <Eigen/Dense>

#include "hersey/film/film_model.h"
#include "hersey/mbd/two_body_force.h"

namespace hersey::bearing {

/// Inertia of the oil of a film that is the same all around its bore, as a journal that orbits in it feels it: forces
/// that follow from the kinetic energy of the flow without inertia, with an added mass that depends on the eccentricity
/// (theory manual eq. (damper.12) to (damper.15)). Choose it for dampers whose film is mostly full: oil of a cavity
/// counts as if the gap were full there.
/// Source: Crandall and El-Shafei (1993), J. Appl. Mech. 60, 728: the approximation by kinetic coenergy.
/// @verified_by film_inertia_test.cpp
class FilmInertia {
 public:
  /// Added mass of the journal at an eccentricity: radially and along the orbit [kg].
  struct Masses {
    double radial = 0, tangential = 0;
  };

  /// Computes the added mass of the full film at several eccentricities.
  /// @param momentum_factor  of the velocity profile (damper.7), > 0
  /// @pre the film is the same all around its bore
  /// @cost eight steady films
  FilmInertia(const film::FilmModel& film, double momentum_factor);

  /// Returns the added mass at an eccentricity below the clearance [m].
  [[nodiscard]] Masses masses(double eccentricity) const;

  /// Adds the force on the journal, which acts at the origin of its frame, its derivative by acceleration, and the
  /// others if wanted.
  void add(const mbd::RelativeMotion& motion, bool want_tangent, mbd::ForceResponse& response) const;

  /// Returns that force alone, as a wrench on the journal at the shell's origin.
  [[nodiscard]] Vector6 wrench(const mbd::RelativeMotion& motion) const;

  /// Returns the kinetic energy of the oil [J].
  [[nodiscard]] double energy(const mbd::RelativeMotion& motion) const;

 private:
  double clearance_ = 0;
  Eigen::VectorXd tangential_, difference_;  ///< g_t and Q of (damper.13): coefficients of powers of 1 - s [kg]
};

}  // namespace hersey::bearing
