#pragma once

#include <string>
#include <vector>

#include "hersey/film/film_model.h"
#include "hersey/film/film_observables.h"

namespace hersey::bearing {

/// Figures of the features that are fed through restrictors, by the indices of these among the film's features.
/// @verified_by hydrostatic_test.cpp
class RestrictedFeeds {
 public:
  /// @param model  of the film, @param film  observed; both outlive this
  RestrictedFeeds(const film::FilmModel& model, const film::FilmObservables& film) : model_(model), film_(film) {}

  /// Names of the features behind restrictors, in the order of the model.
  [[nodiscard]] static std::vector<std::string> names(const film::FilmModel& model);
  /// Of them those whose supply has a pressure.
  [[nodiscard]] static std::vector<std::string> names_with_supply(const film::FilmModel& model);

  /// Returns the pressure in the k-th feature of names() [Pa].
  [[nodiscard]] double pressure(std::size_t k) const;
  /// Returns the pressure ratio beta of the k-th feature of names_with_supply(): its pressure over the supply's, both
  /// above the outlet's (hydrostatic.8) [-].
  [[nodiscard]] double pressure_ratio(std::size_t k) const;
  /// Returns the power of the pumps that feed all restrictors: flow times pressure above the outlet's, before a
  /// throttle, and in the feature for a pump of constant flow (hydrostatic.9) [W].
  [[nodiscard]] double pumping_power() const;
  /// Returns the lowest pressure of the edges that are not closed, to which the oil drains [Pa]; p_cav without one.
  [[nodiscard]] double outlet_pressure() const;

 private:
  const film::FilmModel& model_;
  const film::FilmObservables& film_;
};

}  // namespace hersey::bearing
