#pragma once

#include <Eigen/Dense>
#include <memory>

#include "hersey/core/archive.h"
#include "hersey/film/film_model.h"
#include "hersey/film/film_observables.h"
#include "hersey/film/thermal_model.h"

namespace hersey::film {

/// Temperatures of a film and of what it touches [K].
struct HeatState {
  Eigen::VectorXd film;      ///< of the layers, shape (grid.size() layers): node by node, from the shell to the journal
  Eigen::VectorXd shell;     ///< of the ring, or as given, shape (n_phi); of an insulated shell nothing
  double journal = 0;        ///< of a journal that is not insulated
  Eigen::VectorXd supplies;  ///< of the supply line and then of each feature: what leaves them for the film
};

/// Fields at the nodes, shape (grid.size()) each [K].
struct TemperatureFields {
  Eigen::VectorXd middle;   ///< mean over the film's thickness
  Eigen::VectorXd shell;    ///< on the shell's surface
  Eigen::VectorXd journal;  ///< on the journal's surface
  Eigen::VectorXd hottest;  ///< largest of all layers

  /// Puts them beside the film's other fields.
  void show_in(FilmFields& fields) const {
    fields.T = middle, fields.T_shell = shell, fields.T_journal = journal, fields.T_hottest = hottest;
  }
};

/// Where a film's heat comes from and goes (theory manual, thermal.17), powers in W.
struct HeatBalance {
  double power = 0;       ///< dissipated in the film, and by asperities
  double to_oil = 0;      ///< carried away by the oil that leaves, over that of the oil that comes
  double to_shell = 0;    ///< into the shell
  double to_journal = 0;  ///< into the journal
  double stored = 0;      ///< rate of change of the heat in the film's oil
  /// What is missing, over the largest of these [-].
  [[nodiscard]] double error() const;
};

/// What an engineer asks of a film's temperature [K, rad, m].
struct HeatObservables {
  double T_max = 0, T_max_phi = 0, T_max_z = 0;  ///< of the hottest layer
  double T_shell_max = 0, T_shell_max_phi = 0;   ///< on the shell's surface
  double T_shell_mean = 0;                       ///< over the area
  double T_journal = 0;                          ///< mean of the surface
  double T_film_mean = 0;                        ///< over the volume of the oil
  double T_side = 0;                             ///< of the oil that leaves over the edges; NaN where none does
  Eigen::VectorXd T_supplies;                    ///< of line and features, stirred; the line first if there is one
  HeatBalance balance;
};

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
