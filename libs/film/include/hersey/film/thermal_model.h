#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "hersey/film/body_journal.h"
#include "hersey/film/body_wall.h"

namespace hersey::film {

/// Largest number of layers across a film's thickness.
inline constexpr int most_layers = 64;

/// A surface that no heat passes.
struct InsulatedWall {};

/// A surface whose temperature is given.
struct WallAtTemperature {
  double T = 313.15;            ///< [K]
  Eigen::VectorXd around = {};  ///< of the shell at the grid's angles [K], shape (n_phi); empty: T everywhere
};

/// A node of a ThermalNetwork.
struct NetworkNode {
  double T = 293.15;      ///< at the start [K]
  std::size_t node = 0;   ///< index in the network
  std::string name = {};  ///< of that node
  /// Oil that flows back from the film into what it came through warms this node, as a node of an oil circuit; false:
  /// it goes to the drain.
  bool takes_back = false;
};

/// A shell that is a ring around the film: heat is conducted around it and through it to its surroundings
/// (theory manual, thermal.12). Behind a flat film each patch lies on a pad, or a washer on a ring, of even thickness
/// (thermal.72).
struct RingWall {
  double outer_radius = 0;       ///< [m], > R; of a flat film R and the thickness behind it
  double conductivity = 50;      ///< [W/(m K)], > 0
  double transfer = 80;          ///< coefficient from its outside and its ends to the surroundings [W/(m^2 K)], >= 0
  double T_ambient = 313.15;     ///< of these [K]
  double heat_capacity = 3.6e6;  ///< per volume [J/(m^3 K)], > 0; of no account to a steady film
  std::optional<double> T_start = {};            ///< with which a simulation begins [K]; unset: the supply's
  std::optional<NetworkNode> surroundings = {};  ///< node at T_ambient, which the heat warms
  bool closes = true;  ///< it runs on behind the grooves between patches; false: each patch lies on a pad of its own
};

/// A journal of one temperature that gives off heat only to the film: it rotates fast, and each of its points takes the
/// mean temperature (theory manual, thermal.13).
struct FreeJournal {
  double heat_capacity = 0;            ///< of the whole journal [J/K], > 0; of no account to a steady film
  std::optional<double> T_start = {};  ///< with which a simulation begins [K]; unset: the supply's
};

/// A wall that is a lumped body, node of a ThermalNetwork: it has one temperature, which moves with the network
/// (theory manual, thermal.45).
using NodeWall = NetworkNode;

/// Nodes that oil comes from, instead of prescribed temperatures, and goes to (theory manual, thermal.55).
struct OilNodes {
  std::optional<NetworkNode> line = {}, edges = {};
  std::vector<std::optional<NetworkNode>> features = {};  ///< empty: none of them
  std::optional<NetworkNode> drain = {};                  ///< node that is warmed by the oil that leaves the film
};

using ShellWall = std::variant<InsulatedWall, WallAtTemperature, RingWall, BodyWall, NodeWall>;
using JournalWall = std::variant<FreeJournal, WallAtTemperature, InsulatedWall, BodyJournal, NodeWall>;

/// Change of a bearing's clearance with the mean temperatures of its walls.
struct ThermalExpansion {
  double shell = 0, journal = 0;  ///< coefficients of linear expansion [1/K]
  double T_reference = 293.15;    ///< of both walls, at which the clearance is as given [K]
  /// What holds pads of the shell's material, which grow inwards from there.
  struct Carrier {
    double T = 313.15;     ///< [K]
    double thickness = 0;  ///< of the pads [m]
  };
  std::optional<Carrier> carrier = {};  ///< unset: the whole shell has the temperature of the wall

  /// Returns the increase of the radial clearance of a bearing of radius R [m] between walls at these temperatures [K]
  /// (theory manual, thermal.42, thermal.71) [m].
  [[nodiscard]] double growth(double R, double T_shell, double T_journal) const {
    const double inwards = carrier ? carrier->thickness * (carrier->T - T_shell) : 0;
    const double outwards = R * ((carrier ? carrier->T : T_shell) - T_reference);
    return shell * (outwards + inwards) - journal * R * (T_journal - T_reference);
  }
};

/// Material of a wall's surface; it decides about the fraction of the asperities' heat that the wall absorbs.
struct SurfaceMaterial {
  double conductivity = 50;      ///< k [W/(m K)], > 0
  double heat_capacity = 3.6e6;  ///< per volume, rho c [J/(m^3 K)], > 0

  /// sqrt(k rho c) [W s^(1/2)/(m^2 K)]: half-spaces of one surface temperature absorb heat in proportion to it.
  [[nodiscard]] double effusivity() const { return std::sqrt(conductivity * heat_capacity); }
};

/// Returns the fraction of the friction's heat that the first of two rubbing surfaces absorbs (theory manual,
/// thermal.54).
[[nodiscard]] inline double heat_partition(const SurfaceMaterial& first, const SurfaceMaterial& second) {
  return first.effusivity() / (first.effusivity() + second.effusivity());
}

/// Temperatures of rings and free journals in a simulation.
enum class WallMotion {
  by_their_heat,  ///< change with the heat they absorb, by their heat capacity
  fixed,          ///< keep their temperatures until FilmHeat::settle_walls()
};

/// Data of a film's heat beside the film itself (theory manual, chapter thermal).
struct ThermalModel {
  int layers = 5;                       ///< across the film, 1 to most_layers
  double T_supply = 313.15;             ///< of the oil that comes through line and features [K]
  std::optional<double> T_line = {};    ///< through the line instead [K]
  std::vector<double> T_features = {};  ///< through each feature instead [K]; empty: T_supply
  double T_edges = 313.15;              ///< of the oil that edges draw in [K]
  OilNodes oil = {};
  ShellWall shell = InsulatedWall{};
  JournalWall journal = FreeJournal{};
  WallMotion walls = WallMotion::by_their_heat;  ///< of no account to a steady film
  double carry_over = 1;  ///< fraction of the film's oil that passes a groove with it [-], 0 (all is renewed) to 1
  /// Ends of neighbouring patches lie on one groove, in which the oil of both mixes (theory manual, thermal.68); false:
  /// ends draw fresh oil, or what FilmHeat::set_ends() says.
  bool has_grooves = false;
  std::optional<ThermalExpansion> expansion = {};            ///< of the walls; unset: they keep their size
  SurfaceMaterial shell_surface = {}, journal_surface = {};  ///< share the asperities' heat; steel
  /// Heat sources in the oil beside friction, in its layers node by node [W/m^3], shape (grid.size() layers); empty:
  /// none (theory manual, thermal.66).
  Eigen::VectorXd source = {};
};

/// True if one of the walls is a node of a network.
[[nodiscard]] inline bool has_node_walls(const ThermalModel& thermal) {
  return std::holds_alternative<NodeWall>(thermal.shell) || std::holds_alternative<NodeWall>(thermal.journal);
}

}  // namespace hersey::film
