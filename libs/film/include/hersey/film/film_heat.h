#pragma once

#include <Eigen/Dense>
#include <memory>

#include "hersey/core/archive.h"
#include "hersey/film/film_model.h"
#include "hersey/film/heat_state.h"
#include "hersey/film/thermal_model.h"

namespace hersey::film {

/// A start for film and heat in turn: what is left of temperatures `image`, found with the viscosity of the supply's
/// temperature, once the oil thins as it warms. Of an adiabatic film between walls a constant distance apart exactly:
/// there exp(beta rise) - 1 is beta times the rise at constant viscosity.
[[nodiscard]] HeatState first_guess(const FilmModel& model, const ThermalModel& thermal, HeatState image);

/// Energy equation of a film across and along its thickness (theory manual, chapter thermal): finite volumes, layers of
/// equal thickness at each node, implicit in time, with the walls and the stirred oil of grooves as parts of one linear
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

  /// Viscosities by the temperatures now (thermal.4, thermal.5).
  [[nodiscard]] LayeredViscosity viscosity() const;

  /// Temperatures at the end of a step of the film `u`, solved with `history` (its viscosities included); of a steady
  /// film where history.dt = 0. Those now are the start of the step, and where second differences and the heat of oil
  /// that is renewed are taken from.
  void advance(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u);

  /// After advance(), of walls that are nodes: those were held at the temperatures they had.
  [[nodiscard]] const WallExchange& exchange() const;
  /// After advance(): walls that are nodes had rather these temperatures, shell and journal [K], at the end of the
  /// step; the film follows, and the heat they take up is exchange().heat + exchange().by_T (T - exchange().T).
  void move_walls(const Eigen::Vector2d& T);

  /// After advance(): fields and numbers of that film; before, of one at the temperatures of its supply and walls.
  [[nodiscard]] TemperatureFields fields() const;
  /// Likewise.
  [[nodiscard]] const HeatObservables& observables() const;

  /// Temperatures.
  void persist(Archive& archive);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hersey::film
