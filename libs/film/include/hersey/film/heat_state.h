#pragma once

#include <Eigen/Dense>
#include <vector>

#include "hersey/film/film_observables.h"

namespace hersey::film {

/// Oil that a film draws in over an end of a patch.
struct EndOil {
  double rise = 0;         ///< of its temperature over that of the oil that sides draw in [K]
  double carried = 0;      ///< fraction of it that has left a film over an end, the rest is fresh [-]
  double drawn_again = 0;  ///< of the oil that leaves over the end, the fraction that films draw in again [-]
};

/// Oil that passes an end of a patch, both ways.
struct EndFlow {
  double drawn = 0;    ///< into the film [m^3/s]
  double leaving = 0;  ///< out of it [m^3/s]
  double T = 0;        ///< of what leaves [K]; 0: nothing does
};

/// Temperatures of a film and of its surroundings [K], and the state that is kept with them from step to step.
struct HeatState {
  Eigen::VectorXd film;   ///< of the layers, shape (grid.size() layers): node by node, from the shell to the journal
  Eigen::VectorXd shell;  ///< of ring or node, or as given, shape (n_phi); of an insulated shell nothing
  double journal = 0;     ///< of a journal that is not insulated
  Eigen::VectorXd wall_heat = {};  ///< into each angle of a shell in a body [W], shape (n_phi); else nothing
  double journal_heat = 0;         ///< into a journal in a body [W]; else 0
  Eigen::VectorXd outside = {};    ///< of nodes of a network that are no walls (FilmTerminals), or empty
  Eigen::VectorXd supplies;        ///< of the oil that leaves the supply line, and then each feature, for the film
  /// Ratios of the layers' sheared viscosities to those at rest [-], shaped as `film`, then the factors by which flow
  /// along pressure exceeds that of these viscosities, around and along the axis [-], node by node; empty: there is one
  /// layer, or the oil does not thin.
  Eigen::VectorXd thinning = {};
  std::vector<EndOil> ends = {};  ///< of each patch, the first before the last; a ring has none
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

/// Correction of walls that keep their temperature over a cycle.
struct WallCorrection {
  double largest = 0;  ///< change of temperature [K]
  double rise = 0;     ///< largest temperature over that of the supply, after it [K]
};

/// Balance of a film's heat (theory manual, thermal.17), powers in W.
struct HeatBalance {
  double power = 0;       ///< dissipated in the film, and by asperities
  double source = 0;      ///< made in the oil by anything else
  double to_oil = 0;      ///< carried away by the oil that leaves, over that of the oil that comes
  double to_shell = 0;    ///< into the shell
  double to_journal = 0;  ///< into the journal
  double stored = 0;      ///< rate of change of the heat in the film's oil
  /// Imbalance over the largest of these powers [-].
  [[nodiscard]] double error() const;
};

/// Figures of a film's temperatures [K, rad, m].
struct HeatObservables {
  double T_max = 0, T_max_phi = 0, T_max_z = 0;  ///< of the hottest layer
  double T_shell_max = 0, T_shell_max_phi = 0;   ///< on the shell's surface
  double T_shell_mean = 0;                       ///< over the area
  double T_body_max = 0;                         ///< of the body that the shell is in; else 0
  double T_journal = 0;                          ///< mean of the surface
  double T_journal_body_max = 0;                 ///< of the body that the journal is in; else 0
  double T_film_mean = 0;                        ///< over the volume of the oil
  double T_side = 0;                             ///< of the oil that leaves over the edges; NaN where none does
  double leaving = 0;                            ///< that oil [m^3/s]
  /// Mean temperatures of the walls themselves, by which they expand; a wall without heat has that of its surface.
  double T_shell_wall = 0, T_journal_wall = 0;
  Eigen::VectorXd T_supplies;  ///< of line and features, mixed; the line first if there is one
  HeatBalance balance;
};

/// Heat that nodes of a network have absorbed, and its derivatives by their temperatures (theory manual, thermal.46):
/// shell, journal, zero for a wall that is no node, and the others in the order of FilmTerminals.
struct WallHeatFlow {
  Eigen::VectorXd T = Eigen::Vector2d::Zero();     ///< of these [K]
  Eigen::VectorXd heat = Eigen::Vector2d::Zero();  ///< into them at these temperatures [W]
  Eigen::MatrixXd by_T = Eigen::Matrix2d::Zero();  ///< its change with them, the film following [W/K]
};

}  // namespace hersey::film
