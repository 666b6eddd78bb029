#pragma once

#include <Eigen/Dense>
#include <memory>

#include "hersey/core/archive.h"
#include "hersey/film/film_model.h"
#include "hersey/film/film_observables.h"
#include "hersey/film/heat_state.h"
#include "hersey/film/thermal_model.h"

namespace hersey::film {

/// Returns temperatures from which to begin the alternate solution of film and heat: `image`, found with the viscosity
/// at T_oil [K] everywhere, reduced as the oil thins while it warms (theory manual, thermal.29). This is exact in an
/// adiabatic film of constant thickness: there exp(beta rise) - 1 is beta times the rise at the viscosity of the
/// supply.
[[nodiscard]] HeatState first_guess(const FilmModel& model, const ThermalModel& thermal, double T_oil, HeatState image);

/// Energy equation of a film across and along its thickness (theory manual, chapter thermal): finite volumes, layers of
/// equal thickness at each node, implicit in time, with the walls and the mixed oil of grooves as parts of one linear
/// system. Viscosities follow its temperatures through viscosity(); pressure and flow are the film's own and given.
///
/// One object per film and thread.
class FilmHeat {
 public:
  /// Begins with everything at the temperature of the supply. @throws ContractError on invalid layers or walls
  FilmHeat(const FilmModel& model, const ThermalModel& thermal);
  ~FilmHeat();
  FilmHeat(FilmHeat&&) noexcept;
  FilmHeat& operator=(FilmHeat&&) noexcept;

  /// The thermal model.
  [[nodiscard]] const ThermalModel& thermal() const;
  /// Present temperatures.
  [[nodiscard]] const HeatState& state() const;
  /// Sets the present temperatures. @throws ContractError on a wrong shape
  void set_state(const HeatState& state);

  /// Viscosities by the present temperatures (thermal.4, thermal.5) and by the shear in the layers of the film last
  /// advanced (thermal.25).
  [[nodiscard]] LayeredViscosity viscosity() const;

  /// Advances the temperatures over a step of the film `u`, solved with `history` (its viscosities included), or to
  /// those of a steady film where history.dt = 0. The present temperatures are the start of the step; second
  /// differences and the heat of renewed oil are taken from them.
  void advance(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u);

  /// Flows over the ends of all patches in the film last advanced, the first before the last of each.
  [[nodiscard]] std::vector<EndFlow> end_flows() const;
  /// Temperature of the oil that sides draw in [K].
  [[nodiscard]] double edge_temperature() const;
  /// Sets the oil that these ends draw in from now on. @throws ContractError for another number of ends
  void set_ends(std::vector<EndOil> ends);

  /// Updates the layers' shear thinning to the film `u` at the present temperatures; no layers, no effect. @returns the
  /// largest change of a logarithm of viscosity [-]
  double thin(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u);

  /// Returns the heat that fixed walls (WallMotion::fixed) take up if they are nodes, as means over all steps since the
  /// last call; rings and journals of their own temperature follow. @throws ContractError without a step since then
  const WallHeatFlow& mean_heat_flow();
  /// Sets, after mean_heat_flow(), the nodes' temperatures in the order of heat_flow().T [K]. Rings and journals of
  /// their own temperature take that at which they would take up no heat, to better approximation with each call
  /// (theory manual, thermal.19). Returns how far off they were.
  WallCorrection settle_walls(const Eigen::VectorXd& T_nodes);

  /// Displacement of the shell of a body outwards from its cylinder by temperature [m], shape (grid.size())
  /// (thermal.36); empty: none.
  [[nodiscard]] Eigen::VectorXd shell_opening() const;
  /// Displacement of the shell in a simulation, where the body's temperatures change by settle_walls() only [m].
  [[nodiscard]] Eigen::VectorXd shell_opening_in_time() const;
  /// Temperatures of that body at the nodes of its mesh [K]; empty: there is none.
  [[nodiscard]] Eigen::VectorXd body_temperatures() const;
  /// Displacement of a journal in a body outwards from its cylinder by temperature, mean around [m], shape (n_z)
  /// (thermal.61); empty: none.
  [[nodiscard]] Eigen::VectorXd journal_growth() const;
  /// Displacement of the journal in a simulation [m].
  [[nodiscard]] Eigen::VectorXd journal_growth_in_time() const;
  /// Temperatures of the journal's body at the nodes of its mesh [K]; empty: there is none.
  [[nodiscard]] Eigen::VectorXd journal_body_temperatures() const;

  /// Heat into the nodes of a network after advance(), which kept their temperatures.
  [[nodiscard]] const WallHeatFlow& heat_flow() const;
  /// Corrects, after advance(), the nodes' temperatures at the end of the step, in the order of heat_flow().T [K]. The
  /// film follows, and the nodes take up heat_flow().heat + heat_flow().by_T (T - heat_flow().T).
  void move_walls(const Eigen::VectorXd& T);

  /// Fields of the film last advanced, or before advance() of one at the temperatures of its supply and walls.
  [[nodiscard]] TemperatureFields fields() const;
  /// Figures of the same film.
  [[nodiscard]] const HeatObservables& observables() const;

  /// Returns observe_film() of the film last advanced, from the flows that carried its heat, without computing them
  /// again. @param motion, u  those of advance()
  [[nodiscard]] FilmObservables film(const SurfaceMotion& motion, const Eigen::Vector2d& e, const Eigen::VectorXd& u,
                                     const Eigen::Vector2d& tilt) const;

  /// Saves or restores temperatures, and the means of fixed walls.
  void persist(Archive& archive);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hersey::film
