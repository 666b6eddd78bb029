#pragma once

#include <span>

#include "balance/node.h"
#include "hersey/film/film_model.h"

namespace hersey::film {

/// Turbulent mixing of momentum and heat across the film at one node (theory manual, turbulence.12 to turbulence.14).
/// Heights eta are fractions of the thickness, 0 at the shell and 1 at the journal.
class EddyMixing {
 public:
  /// Of a node of a solved film.
  EddyMixing(const FilmModel& model, const Node& node);

  /// False in a laminar film, which has no mixing.
  [[nodiscard]] bool mixes() const { return fraction_ > 0; }
  /// Viscosity over the oil's own between two heights: that of a layer in which the velocity changes as much under the
  /// same stress [-].
  [[nodiscard]] double viscosity_factor(double from, double to) const;
  /// Conductivity of heat across the film at a height [W/(m K)].
  [[nodiscard]] double conductivity(double eta) const;
  /// Integral of d eta over the conductivity between two heights: over the thickness it is the film's resistance per
  /// area [m K/W].
  [[nodiscard]] double resistance(double from, double to) const;
  /// Resistance between a wall and the mean temperature of a layer of this width beside it, over the thickness [m K/W],
  /// if the same heat flows at every height of the layer.
  [[nodiscard]] double resistance_to_wall(double width) const;

 private:
  [[nodiscard]] double eddies(double eta) const;

  double fraction_;    ///< of turbulence [-]
  double h_plus_;      ///< film thickness in wall units (turbulence.4) [-]
  double molecular_;   ///< conductivity [W/(m K)]
  double per_eddies_;  ///< conductivity by eddies per ratio of eddy viscosity [W/(m K)]
};

/// Multiplies the viscosities of a node's layers by their factors.
void add_eddies(const EddyMixing& mixing, std::span<double> mu);

}  // namespace hersey::film
