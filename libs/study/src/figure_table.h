#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "hersey/bearing/clearance.h"
#include "hersey/bearing/quantities.h"
#include "hersey/core/contract.h"
#include "hersey/study/bearing_study.h"

// The vocabulary in which tables of a bearing's figures are written: one table for each kind of bearing.
namespace hersey::study {

/// The unit that people use, its name in SI and its size there.
struct Unit {
  const char* name;
  const char* si;
  double size;
};
inline constexpr Unit kNone{"", "", 1}, kNewton{"N", "N", 1}, kNewtonMetre{"N.m", "N.m", 1}, kWatt{"W", "W", 1};
inline constexpr Unit kKilogram{"kg", "kg", 1}, kStiffness{"N/m", "N/m", 1}, kDamping{"N.s/m", "N.s/m", 1};
inline constexpr Unit kDegree{"deg", "rad", std::numbers::pi / 180}, kRpm{"rpm", "rad/s", std::numbers::pi / 30};
inline constexpr Unit kMillimetrePerSecond{"mm/s", "m/s", 1e-3};
inline constexpr Unit kMicrometre{"um", "m", 1e-6}, kMillimetre{"mm", "m", 1e-3}, kMegapascal{"MPa", "Pa", 1e6};
inline constexpr Unit kMicrometrePerMetre{"um/m", "1", 1e-6}, kMicroradian{"urad", "rad", 1e-6};
inline constexpr Unit kCelsius{"degC", "degC", 1};
inline constexpr Unit kFlow{"mm^3/s", "m^3/s", 1e-9}, kVolume{"mm^3", "m^3", 1e-9};

using Solution = BearingSolution;

/// Properties that only some figures have.
struct More {
  /// Estimated error of the grid; negative: none. Empty: the figure has none.
  std::function<double(const Solution&)> grid_error = {};
  /// True if a solution has the figure; empty: every one has it.
  std::function<bool(const Solution&)> only = {};
  /// Text in place of a value that is not a number.
  std::function<std::string(const Solution&)> words = {};
  /// Replacements of <...> in key and name, for a family.
  std::function<std::vector<std::string>(const Solution&)> each = {};
  /// Of a family: the grid's error of each.
  std::function<double(const Solution&, std::size_t)> grid_error_of = {};
};

/// A line of the table: a figure, or a family of them. Its words are those of bearing::quantity(key).
struct Line {
  /// @param label  in place of the quantity's title, in a table where the line before explains it
  /// @pre the unit is one of the quantity's in SI
  template <class Get>
  Line(std::string_view key, std::string_view label_, Unit unit_, Get get, More more_ = {})
      : quantity(bearing::quantity(key)), label(label_), unit(unit_), more(std::move(more_)) {
    HERSEY_REQUIRE(quantity.unit == (*unit.si == 0 ? "1" : unit.si), "one unit for " + std::string(key));
    value = [get](const Solution& s, [[maybe_unused]] std::size_t k) -> double {
      if constexpr (std::is_invocable_v<Get, const Solution&, std::size_t>)
        return std::invoke(get, s, k);
      else
        return std::invoke(get, s);
    };
  }
  template <class Get>
  Line(std::string_view key, Unit unit_, Get get, More more_ = {})
      : Line(key, bearing::quantity(key).title, unit_, get, std::move(more_)) {}

  const bearing::Quantity& quantity;
  std::string_view label;
  Unit unit;
  std::function<double(const Solution&, std::size_t)> value;  ///< in SI
  More more;
};

/// Figures that stand together.
struct Group {
  std::string name;
  std::vector<Line> lines;
};

template <class Member>
auto film(Member member) {
  return [member](const Solution& s) -> double { return std::invoke(member, s.state.film); };
}

template <class Member>
auto numbers(Member member) {
  return [member](const Solution& s) -> double { return std::invoke(member, s.numbers); };
}

template <class Member>
auto point(Member member) {
  return [member](const Solution& s) -> double { return std::invoke(member, s.state.point); };
}

template <class Member>
auto whirl(Member member) {
  return [member](const Solution& s) -> double { return std::invoke(member, s.whirl); };
}

inline auto error_of(double bearing::GridError::*member) {
  return [member](const Solution& s) { return s.grid_error.*member; };
}

// A quantity that is zero by symmetry comes out as the round-off of its parts, which is meaningless.
inline double without_round_off(double value, double parts) { return std::abs(value) < 1e-12 * parts ? 0.0 : value; }

inline bool is_load_given(const Solution& s) { return s.state.point.load.has_value(); }
inline bool squeezes(const Solution& s) { return s.state.point.e_rate.norm() > 0; }

/// @param axis  of the moment on the shell; what is round-off beside the load over the width is zero
inline auto moment(int axis) {
  return [axis](const Solution& s) {
    return without_round_off(s.state.film.wrench_on_shell[axis], s.numbers.load * s.model.L);
  };
}

inline auto height(double film::FilmObservables::*z) {
  return [z](const Solution& s) { return without_round_off(s.state.film.*z, s.model.L); };
}

/// False of Reynolds' condition, which loses oil where the film ruptures and creates it where it re-forms: that
/// imbalance is no error of the solution.
[[nodiscard]] bool conserves_oil(const Solution& s);
/// True if the film is cavitated somewhere, so that it matters over how much of the gap it is sheared there.
[[nodiscard]] bool shears_differ(const Solution& s);

/// True if the film is cavitated at mid-width.
[[nodiscard]] bool ruptures(const Solution& s);
/// Returns the grid's error of the load, which has none where it is given.
[[nodiscard]] double load_error(const Solution& s);

// Lines that films of every kind have.
[[nodiscard]] Line minimum_thickness_over_features();
/// @param put_in  power that the moving surface and the load bring [W]
[[nodiscard]] Line power_not_explained(double (*put_in)(const Solution&));
[[nodiscard]] Line flow_through_features();
[[nodiscard]] Line mass_balance_error();
/// Pressures, pressure ratios and pumping power of features behind restrictors.
[[nodiscard]] std::vector<Line> restricted_feeds();
/// Numbers that say where the flow is laminar, in transition or turbulent.
[[nodiscard]] std::vector<Line> regime_of_flow();
/// The group with more lines at its end.
[[nodiscard]] Group with(Group group, const std::vector<Line>& more);

/// True if the film has temperatures.
[[nodiscard]] bool has_film_heat(const Solution& s);
/// Temperature of the film's heat [degC].
[[nodiscard]] std::function<double(const Solution&)> celsius_of(double film::HeatObservables::*T);
/// Term of the film's balance of heat [W].
[[nodiscard]] std::function<double(const Solution&)> heat_term(double film::HeatBalance::*term);
/// Temperatures and heat of a film between pads and a runner. @param oil, face  lines that say where the hottest oil
/// and the hottest place of the faces lie
[[nodiscard]] Group flat_heat(const std::vector<Line>& oil, const std::vector<Line>& face);

/// Figures of each arc of a bore that consists of arcs.
[[nodiscard]] Group arc_figures();
/// True if the bore consists of arcs.
[[nodiscard]] bool has_arcs(const Solution& s);

/// Figures of each pad of a bearing of tilting pads.
[[nodiscard]] Group pad_figures();
/// The same of pads below a collar, whose loads stand among those of the film.
[[nodiscard]] Group pad_pivot_figures();

/// The table of a floating ring but for its stiffness and damping.
[[nodiscard]] std::vector<Group> ring_figures();

/// The table of a plane slider's figures, in the order in which they are reported.
[[nodiscard]] std::vector<Group> plane_slider_figures();
/// The table of a thrust bearing's figures, likewise.
[[nodiscard]] std::vector<Group> thrust_figures();
/// The table of a thrust bearing of pads on pivots.
[[nodiscard]] std::vector<Group> thrust_pad_figures();
/// The table of a squeeze-film damper.
[[nodiscard]] std::vector<Group> squeeze_film_damper_figures();
/// The table of a piston's skirt.
[[nodiscard]] std::vector<Group> skirt_figures();

}  // namespace hersey::study
