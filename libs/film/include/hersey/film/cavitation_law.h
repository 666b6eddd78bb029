#pragma once

#include <string_view>

#include "hersey/film/value_and_slope.h"

namespace hersey::film {

/// State of the film where it would be under tension; cavitation_law() gives the equations.
enum class Cavitation {
  guembel,          ///< full film solved, negative pressures dropped from the forces (half Sommerfeld)
  reynolds,         ///< p >= p_cav with dp/dn = 0 at rupture; mass is lost where the film re-forms
  mass_conserving,  ///< pressure or fill fraction in each node (Jakobsson-Floberg-Olsson)
  full_film,        ///< no cavitation: tension acts on the surfaces as pressure does (Sommerfeld)
};

/// Scales of u where u < 0 is not a pressure [Pa], > 0 each.
struct CavitationScales {
  double fill = 1;   ///< P0: -u of an empty gap (film.6)
  double slack = 1;  ///< -u where the film lacks all the oil that a gap widening by c in a radian takes (film.20)
};

/// Pressure and fill fraction by a node's unknown u (film.3 to film.6), with derivatives by u.
struct FilmPhase {
  ValueAndSlope p;         ///< pressure above p_cav in the balance of flows [Pa]
  ValueAndSlope theta{1};  ///< fill fraction [-]
};

/// Terms of a row of the balance at u <= 0 with all unknowns but its own known; they add up to 0.
struct CavitatedRow {
  double full = 0;       ///< flow out of a full gap at p_cav [m^3/s]
  double transport = 0;  ///< its part in proportion to the fill fraction [m^3/s]
  double slack = 0;      ///< coefficient of the slack [m^3/(Pa s)]
  double drawn = 0;      ///< coefficient of u: flow drawn from a supply at the node [m^3/(Pa s)]
};

/// A cavitation model: the meaning of the film's one unknown u [Pa] per node. The pressure on the walls is p_cav +
/// max(u, 0), but p_cav + u in a film that bears tension. A new model is a class like those in
/// cavitation_law.cpp, its name in Cavitation and its word in the model file's format.
class CavitationLaw {
 public:
  virtual ~CavitationLaw() = default;

  /// Name in the model file, with its meaning in brackets.
  [[nodiscard]] virtual std::string_view text() const = 0;
  /// Returns pressure and fill fraction.
  [[nodiscard]] virtual FilmPhase phase(double u, const CavitationScales& scales) const = 0;
  /// Returns the term that a row has beside the balance of oil, over the slack's conductance [Pa] (film.20).
  [[nodiscard]] virtual ValueAndSlope slack(double u) const;
  /// Returns the u <= 0 that solves a row of a cavitated film [Pa].
  [[nodiscard]] virtual double cavitated_unknown(const CavitatedRow& row, const CavitationScales& scales) const = 0;

  /// True if the gap may be filled in part, so that oil is conserved in cavities, too.
  [[nodiscard]] virtual bool has_fill() const { return false; }
  /// True if the balance of flows includes tension, which forces leave out unless bears_tension().
  [[nodiscard]] virtual bool has_tension() const { return false; }
  /// True if tension acts on the surfaces, too: no film is ever cavitated.
  [[nodiscard]] virtual bool bears_tension() const { return false; }
  /// True if oil is lost in a cavitated film, so that flows over the edges and from the supply do not balance.
  [[nodiscard]] bool loses_oil() const { return !has_fill() && !has_tension(); }
};

/// Returns the model of that name, which exists as long as the program.
[[nodiscard]] const CavitationLaw& cavitation_law(Cavitation cavitation);

}  // namespace hersey::film
