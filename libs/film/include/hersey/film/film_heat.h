#pragma once

#include <Eigen/Dense>
#include <memory>

#include "hersey/core/archive.h"
#include "hersey/film/film_model.h"
#include "hersey/film/film_observables.h"
#include "hersey/film/heat_state.h"
#include "hersey/film/thermal_model.h"

namespace hersey::film {

/// Start of the alternate solution of film and heat: what is left of temperatures `image`, found with the viscosity at
/// T_oil [K] everywhere, once the oil thins as it warms (theory manual, thermal.29). Of an adiabatic film between walls
/// a constant distance apart exactly: there exp(beta rise) - 1 is beta times the rise at the viscosity of the supply.
[[nodiscard]] HeatState first_guess(const FilmModel& model, const ThermalModel& thermal, double T_oil, HeatState image);

/// Energy equation of a film across and along its thickness (theory manual, chapter thermal): finite volumes, layers of
/// equal thickness at each node, implicit in time, with the walls and the mixed oil of grooves as parts of one linear
/// system. Viscosities follow its temperatures through viscosity(); pressure and flow are the film's own and given.
///
/// One object per film and thread.
class FilmHeat {
 public:
  /// Everything at the temperature of the supply. @throws ContractError on layers or walls that make no sense
  FilmHeat(const FilmModel& model, const ThermalModel& thermal);
  ~FilmHeat();
  FilmHeat(FilmHeat&&) noexcept;
  FilmHeat& operator=(FilmHeat&&) noexcept;

  /// As given.
  [[nodiscard]] const ThermalModel& thermal() const;
  /// Temperatures now.
  [[nodiscard]] const HeatState& state() const;
  /// Takes these for the temperatures now. @throws ContractError on a wrong shape
  void set_state(const HeatState& state);

  /// Viscosities by the temperatures now (thermal.4, thermal.5), and by the shear in the layers of the film that has
  /// last advanced (thermal.25).
  [[nodiscard]] LayeredViscosity viscosity() const;

  /// Temperatures at the end of a step of the film `u`, solved with `history` (its viscosities included); of a steady
  /// film where history.dt = 0. Those now are the start of the step, and where second differences and the heat of oil
  /// that is renewed are taken from.
  void advance(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u);

  /// Layers as thin as they are sheared in the film `u`, temperatures as they are; nothing where no layers thin by
  /// shear. @returns the largest change of a logarithm of viscosity [-]
  double thin(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u);

  /// Of walls that are held (WallMotion::held), by the means over all steps since the last call: what those that are
  /// nodes take up, rings and journals of their own temperature following. @throws ContractError without a step since
  /// then
  const WallExchange& mean_exchange();
  /// After mean_exchange(): nodes have these temperatures, as exchange().T [K]; rings and journals of their own
  /// temperature take those at which they would take up no heat; call after call ever better (theory manual,
  /// thermal.19). Returns how far off they were.
  WallCorrection settle_walls(const Eigen::VectorXd& T_nodes);

  /// How far the shell of a body lies outside its cylinder by temperature [m], shape (grid.size()) (thermal.36); empty:
  /// it does not.
  [[nodiscard]] Eigen::VectorXd shell_opening() const;
  /// The same in a simulation, in which a body keeps its temperatures, settle_walls() apart.
  [[nodiscard]] Eigen::VectorXd shell_opening_in_time() const;
  /// Temperatures of that body at the nodes of its mesh [K]; empty: there is none.
  [[nodiscard]] Eigen::VectorXd body_temperatures() const;
  /// How far a journal in a body lies outside its cylinder by temperature, the mean around [m], shape (n_z)
  /// (thermal.61); empty: it does not.
  [[nodiscard]] Eigen::VectorXd journal_growth() const;
  /// Likewise in a simulation.
  [[nodiscard]] Eigen::VectorXd journal_growth_in_time() const;
  /// And temperatures of the journal's body at the nodes of its mesh [K]; empty: there is none.
  [[nodiscard]] Eigen::VectorXd journal_body_temperatures() const;

  /// After advance(), of nodes of a network: those were held at the temperatures they had.
  [[nodiscard]] const WallExchange& exchange() const;
  /// After advance(): nodes had rather these temperatures, as exchange().T [K], at the end of the
  /// step; the film follows, and the heat they take up is exchange().heat + exchange().by_T (T - exchange().T).
  void move_walls(const Eigen::VectorXd& T);

  /// After advance(): fields and numbers of that film; before, of one at the temperatures of its supply and walls.
  [[nodiscard]] TemperatureFields fields() const;
  /// Likewise.
  [[nodiscard]] const HeatObservables& observables() const;

  /// What observe_film() tells of the film last advanced, from the flows that carried its heat: they are not worked out
  /// anew. @param motion, u  those of advance()
  [[nodiscard]] FilmObservables film(const SurfaceMotion& motion, const Eigen::Vector2d& e, const Eigen::VectorXd& u,
                                     const Eigen::Vector2d& tilt) const;

  /// Temperatures, and means of walls that are held.
  void persist(Archive& archive);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hersey::film
