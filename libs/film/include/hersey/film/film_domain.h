#pragma once

#include <Eigen/Dense>
#include <string>

#include "hersey/film/film_model.h"

namespace hersey::film {

/// Validity of the film's equations at trial unknowns (film.32). A trial outside of their domain is an outcome, not an
/// error: the caller takes a shorter step.
struct FilmDomain {
  enum class Violation {
    none,
    closed,      ///< the film thickness is not positive
    pressure,    ///< a pressure beyond the range of every viscosity law
    not_finite,  ///< an unknown, a gap or a quantity derived from them is not finite
  };
  Violation violation = Violation::none;
  int node = -1;  ///< where; -1: nowhere, or everywhere

  /// True if the trial is a film.
  [[nodiscard]] bool is_inside() const { return violation == Violation::none; }
};

/// Pressure above that of cavitation that no film has [Pa]; steel does not bear a tenth of it.
inline constexpr double largest_pressure = 1e11;

/// Checks that `u` is finite everywhere, that its pressures lie below `largest_pressure`, and that no viscosity exceeds
/// exp(largest_log_viscosity) times that at p_cav: there the laws are valid.
[[nodiscard]] FilmDomain check_unknowns(const FilmModel& model, const Eigen::VectorXd& u);

/// Describes a trial outside the domain for the user: what happens, and where in the bearing.
[[nodiscard]] std::string text(const FilmModel& model, const FilmDomain& domain);

/// Says where a node lies in the bearing: "33.7 deg, z = 2.1 mm".
[[nodiscard]] std::string position_of_node(const FilmModel& model, int node);

}  // namespace hersey::film
