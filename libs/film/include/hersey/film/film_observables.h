#pragma once

#include <Eigen/Dense>
#include <vector>

#include "hersey/core/spatial.h"

namespace hersey::film {

/// Fields of a solved film at the nodes, shape (n_phi n_z) each.
struct FilmFields {
  Eigen::VectorXd p;        ///< film pressure [Pa]
  Eigen::VectorXd theta;    ///< fill fraction [-]
  Eigen::VectorXd density;  ///< rho/rho0 [-]
  Eigen::VectorXd h;        ///< film thickness, deformation included, depth of features apart [m]
  Eigen::VectorXd depth;    ///< mean depth of features over the node's control volume [m]; empty: none counted
  /// Film thickness with the depth of features [m].
  [[nodiscard]] Eigen::VectorXd thickness() const { return depth.size() == 0 ? h : Eigen::VectorXd(h + depth); }
  Eigen::VectorXd w;           ///< column deformation [m]
  Eigen::VectorXd p_asperity;  ///< asperity contact pressure [Pa]
  Eigen::VectorXd reynolds;    ///< rho v h/mu of the sliding (turbulence.1) [-]; empty: of a film without Turbulence
  /// Radial displacement of the surfaces of elastic bodies against their frames, away from the bearing's axis [m];
  /// empty where a surface is rigid. The bearing fills them in.
  Eigen::VectorXd d_shell, d_journal;
  /// Depth worn off both surfaces [m]; empty where they do not wear. The bearing fills them in.
  Eigen::VectorXd worn_fixed, worn_moving;
  /// Composite rms roughness of asperities that run in [m]; empty where it stays. The bearing fills it in.
  Eigen::VectorXd roughness;
  /// Temperatures: mean over the thickness, of both surfaces, of the hottest layer [K]; empty without. FilmHeat fills
  /// them in (TemperatureFields).
  Eigen::VectorXd T, T_shell, T_journal, T_hottest;
};

/// Figures of one patch of a film.
struct PatchObservables {
  double h_min = 0, p_max = 0;           ///< least thickness and largest pressure of its nodes [m, Pa]
  double flow_left = 0, flow_right = 0;  ///< oil leaving over its sides z = -L/2, +L/2 [m^3/s]
  double flow_first = 0, flow_last = 0;  ///< oil leaving over its first and last end [m^3/s]
};

/// Figures of a solved film, as the theory manual's chapter film defines them. Flows and volumes of oil are those at
/// the density rho0: masses over rho0.
struct FilmObservables {
  double h_min = 0, h_min_phi = 0,
         h_min_z = 0;  ///< smallest film thickness beside features with depth, edges included, and where [m, rad, m]
  double h_min_features = 0;  ///< smallest thickness over features with depth, that included [m]; NaN without any
  double h_min_centre = 0;    ///< smallest film thickness at z = 0 [m]
  double p_max = 0, p_max_phi = 0, p_max_z = 0;  ///< interpolated peak of the film pressure and where [Pa, rad, m]
  double p_max_node = 0;                         ///< largest nodal pressure [Pa]
  Vector6 wrench_on_shell =
      Vector6::Zero();  ///< [moment about the grid's origin; force], grid axes; the journal takes its negative
  Eigen::VectorXd normal_forces;  ///< by which film and contact push the surfaces apart at the nodes [N]
  Vector3 force_pressure, force_shear, force_asperity;  ///< parts of the force on the shell [N], grid axes
  double torque_journal = 0;                            ///< friction torque on the journal about its own axis [N m]
  double torque_shell = 0;                              ///< friction torque on the shell about its own axis [N m]
  double sliding_speed = 0;                             ///< of the surfaces against each other [m/s], >= 0
  double power_film = 0;                                ///< viscous dissipation: Couette and Poiseuille [W]
  /// Figures torque_journal and power_film of the same film with the other CavitatedShear: `full` where the model has
  /// `film_share`, and the other way round [N m, W].
  double torque_journal_other_shear = 0, power_film_other_shear = 0;
  double power_asperity = 0;  ///< boundary friction [W]
  double power_stored = 0;  ///< rate of the energy in liner, asperities and compressed oil, and work against p_cav [W]
  double power_oil = 0;     ///< taken along by oil that leaves over the edges less what feeds bring [W]
  /// All of the power that the bodies put into the film, by integrals over its fields (theory manual, film.54) [W].
  [[nodiscard]] double power_taken() const { return power_film + power_asperity + power_stored + power_oil; }
  double flow_left = 0, flow_right = 0;  ///< oil leaving over the edges z = -L/2, +L/2 [m^3/s]
  double flow_first = 0, flow_last = 0;  ///< oil leaving over the first and the last ends of patches [m^3/s]
  [[nodiscard]] double flow_sides() const { return flow_left + flow_right; }              ///< [m^3/s]
  [[nodiscard]] double flow_ends() const { return flow_first + flow_last; }               ///< [m^3/s]
  [[nodiscard]] double flow_out() const { return flow_left + flow_right + flow_ends(); }  ///< [m^3/s]
  std::vector<PatchObservables> patches = {};  ///< of each patch of the grid; empty: a ring
  double flow_supply = 0;                      ///< oil entering through supply line and features [m^3/s]
  Eigen::VectorXd flow_features;               ///< oil entering through each feature [m^3/s]
  /// Pressure in each feature that is fed, and of its supply, which differ by the drop over its restrictor [Pa]; of one
  /// that is not fed, and of the supply of a pump without limit, not a number.
  Eigen::VectorXd pressure_features, pressure_supplies;
  double storage_rate = 0;        ///< rate of change of the oil volume in the film [m^3/s]
  double oil_volume = 0;          ///< integral of theta h [m^3]
  double mass_balance_error = 0;  ///< |supply - out - storage| over the largest of the flows and U c L [-]
  /// Angles at which the widest cavity at mid-width begins and ends along the flow [rad]; NaN without a cavity.
  double rupture_angle = 0, reformation_angle = 0;
  /// Largest Reynolds number rho v h/mu of the sliding, and of journals the largest Taylor number Re sqrt(h/R); of
  /// others not a number [-].
  double reynolds_max = 0, taylor_max = 0;
  /// Parts of the film's area that are laminar, in the band of transition, and fully turbulent by Turbulence's numbers,
  /// whether the film's friction follows them or not [-].
  double laminar_share = 1, transition_share = 0, turbulent_share = 0;
  double cavitated_share =
      0;  ///< fraction of the area with theta < 1 or (other models) p <= p_cav without film action [-]
  /// Fraction of the area between the edges z = -L/2 and +L/2 over which a layer of oil comes in and where the film is
  /// full for the first time behind them (film.66): what the film lacks because too little oil comes [-].
  double starved_share = 0;
  double flow_scraped = 0;  ///< oil of layers that finds no room below the edge where it comes in [m^3/s] (film.66)
};

}  // namespace hersey::film
