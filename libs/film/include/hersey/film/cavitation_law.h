#pragma once

#include <string_view>

#include "hersey/film/value_and_slope.h"

namespace hersey::film {

/// What becomes of the film where it would have to bear tension; see cavitation_law.
enum class Cavitation {
  guembel,          ///< full film solved, negative pressures dropped from the forces (half Sommerfeld)
  reynolds,         ///< p >= p_cav with dp/dn = 0 at rupture; mass is lost where the film re-forms
  mass_conserving,  ///< pressure or fill fraction in each node (Jakobsson-Floberg-Olsson)
};

/// Where u < 0 tells something else than a pressure, by how much of it [Pa], > 0 each.
struct CavitationScales {
  double fill = 1;   ///< P0: -u of an empty gap (film.6)
  double slack = 1;  ///< -u where the film misses all that a gap widening by c in a radian asks for (film.20)
};

/// What a node's unknown u means for the film (film.3 to film.6), derivatives by u.
struct FilmPhase {
  ValueAndSlope p;         ///< pressure above p_cav in the balance of flows [Pa]
  ValueAndSlope theta{1};  ///< fill fraction [-]
};

/// A row of the balance at u <= 0, everything but its own unknown known: full + what u gives = 0.
struct CavitatedRow {
  double full = 0;       ///< what leaves with the gap full and at p_cav [m^3/s]
  double transport = 0;  ///< with the fill fraction, of it [m^3/s]
  double slack = 0;      ///< with the slack [m^3/(Pa s)]
  double drawn = 0;      ///< with u, out of what holds the node [m^3/(Pa s)]
};

/// A cavitation model: what the film's one unknown u [Pa] per node stands for. The pressure on the walls is p_cav +
/// max(u, 0) in all of them. A new model is a class like those in cavitation_law.cpp, its name in Cavitation and its
/// word in the model file's format.
class CavitationLaw {
 public:
  virtual ~CavitationLaw() = default;

  /// Its name in the model file and, in brackets, what it says.
  [[nodiscard]] virtual std::string_view text() const = 0;
  /// Pressure and fill fraction.
  [[nodiscard]] virtual FilmPhase phase(double u, const CavitationScales& scales) const = 0;
  /// What the row carries beside the balance of oil, over the slack's conductance [Pa] (film.20).
  [[nodiscard]] virtual ValueAndSlope slack(double u) const;
  /// The u <= 0 that solves a row of a cavitated film [Pa].
  [[nodiscard]] virtual double cavitated_unknown(const CavitatedRow& row, const CavitationScales& scales) const = 0;

  /// Whether the gap may be filled in part, so that oil is conserved in cavities too.
  [[nodiscard]] virtual bool has_fill() const { return false; }
  /// Whether the balance of flows knows tension, which forces then leave out.
  [[nodiscard]] virtual bool has_tension() const { return false; }
  /// Whether a cavitated film simply lacks oil: then flows over the edges and from the supply do not balance.
  [[nodiscard]] bool loses_oil() const { return !has_fill() && !has_tension(); }
};

/// The model of that name; it lives as long as the program.
[[nodiscard]] const CavitationLaw& cavitation_law(Cavitation cavitation);

}  // namespace hersey::film
