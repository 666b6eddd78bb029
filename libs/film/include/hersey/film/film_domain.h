#pragma once

#include <Eigen/Dense>
#include <string>

#include "hersey/film/film_model.h"

namespace hersey::film {

/// Whether the film's equations mean anything at a trial (film.32). A trial outside is an outcome, not an error:
/// whoever made it takes a shorter step.
struct FilmDomain {
  enum class Violation {
    none,
    closed,      ///< the film thickness is not positive
    pressure,    ///< a pressure beyond any that a law of viscosity means
    not_finite,  ///< an unknown, a gap or what follows from them is no finite number
  };
  Violation violation = Violation::none;
  int node = -1;  ///< where; -1: nowhere, or everywhere

  /// Whether the trial is a film.
  [[nodiscard]] bool is_inside() const { return violation == Violation::none; }
};

/// No film has such a pressure above that of cavitation [Pa]; steel does not bear a tenth of it.
inline constexpr double largest_pressure = 1e11;

/// Whether `u` is finite everywhere and its pressures are such that the laws still say something about them: below
/// `largest_pressure`, and no viscosity above exp(largest_log_viscosity) times that at p_cav.
[[nodiscard]] FilmDomain check_unknowns(const FilmModel& model, const Eigen::VectorXd& u);

/// What a user needs to know of a trial outside the domain: what happens, and where in the bearing.
[[nodiscard]] std::string text(const FilmModel& model, const FilmDomain& domain);

/// "33.7 deg, z = 2.1 mm": where a node lies in the bearing.
[[nodiscard]] std::string place_of_node(const FilmModel& model, int node);

}  // namespace hersey::film
