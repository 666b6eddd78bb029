#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "hersey/film/cavitation_law.h"
#include "hersey/film/density_law.h"
#include "hersey/film/film_surface.h"
#include "hersey/film/gap_profile.h"
#include "hersey/film/grid.h"
#include "hersey/film/roughness.h"
#include "hersey/film/shear_law.h"
#include "hersey/film/surface_feature.h"
#include "hersey/film/temperature_law.h"
#include "hersey/film/turbulence.h"
#include "hersey/film/viscosity_law.h"

namespace hersey::film {

/// Pressures in the laws' arguments are counted from the cavitation pressure.
struct Lubricant {
  double mu0 = 0.015;           ///< dynamic viscosity at the cavitation pressure [Pa s], > 0
  ViscosityLaw viscosity_law;   ///< mu(p)/mu0
  double density = 850;         ///< at the cavitation pressure [kg/m^3], > 0
  double rho15 = 850;           ///< the same at 15 degC, where it expands [kg/m^3], > 0
  double expansion = 0;         ///< of its volume, from 15 degC [1/K], >= 0
  DensityLaw density_law = {};  ///< rho(p)/rho0
  /// mu at the cavitation pressure over temperature; only a film with a temperature (FilmHeat) evaluates it.
  TemperatureLaw temperature_law = {};
  double specific_heat = 2000;  ///< [J/(kg K)], > 0
  double conductivity = 0.13;   ///< of heat [W/(m K)], >= 0
  ShearThinning shear_thinning = {};
};

/// Returns the oil at a temperature [K], if its viscosity or density depends on one; any other unchanged.
[[nodiscard]] inline Lubricant at_temperature(Lubricant oil, double T) {
  if (depends_on_temperature(oil.temperature_law)) oil.mu0 = viscosity_at(oil.temperature_law, T);
  if (oil.expansion > 0) oil.density = density_at(T, oil.rho15, oil.expansion);
  if (const auto* walther = std::get_if<WaltherViscosity>(&oil.temperature_law)) oil.density = walther->density(T);
  return oil;
}

/// Returns ln of the viscosity over that at the cavitation pressure, where it is `mu` [Pa s] by its temperature, and
/// its slope [1/Pa]; otherwise as below.
[[nodiscard]] inline ValueAndSlope log_viscosity_ratio(const Lubricant& oil, double p, double mu) {
  if (p < 0) return {};
  return saturated(std::visit([&](const auto& law) { return law.log_ratio(p, mu); }, oil.viscosity_law));
}

/// Returns ln(mu/mu0) and its slope [1/Pa] at a pressure above the cavitation pressure, saturated beyond the range of
/// the law; tension, which guembel cuts off, does not thin the oil.
[[nodiscard]] inline ValueAndSlope log_viscosity_ratio(const Lubricant& oil, double p) {
  return log_viscosity_ratio(oil, p, oil.mu0);
}

/// rho/rho0 and its slope [1/Pa] at a pressure above the cavitation pressure; tension does not thin the oil.
[[nodiscard]] inline ValueAndSlope density_ratio(const Lubricant& oil, double p) {
  if (p < 0) return {1, 0};
  return std::visit([&](const auto& law) { return law.ratio(p); }, oil.density_law);
}

/// Work per unit of volume at rho0 that brings oil from the cavitation pressure to one above it by p [Pa].
[[nodiscard]] inline double oil_work(const Lubricant& oil, double p) {
  if (p < 0) return p;
  return std::visit([&](const auto& law) { return law.work(p); }, oil.density_law);
}

enum class SupplyKind { none, fixed_angle, widest_gap };

/// A line along the whole width of the bearing that is full at a prescribed pressure.
struct SupplyLine {
  SupplyKind kind = SupplyKind::none;
  double phi = 0;       ///< angle of a fixed line [rad]
  double pressure = 0;  ///< [Pa], >= cavitation pressure
};

enum class AsperityModel { none, greenwood_tripp_fit, greenwood_tripp_exact };

/// p_a = K E F_{5/2}((h - delta)/sigma).
struct Asperities {
  AsperityModel model = AsperityModel::none;
  double sigma = 1e-6;            ///< composite rms summit roughness [m], > 0
  double elastic_factor = 3e-3;   ///< K [-], >= 0
  double composite_modulus = 0;   ///< E [Pa], >= 0
  double mu_friction = 0;         ///< boundary friction coefficient [-], >= 0
  double mean_summit_height = 0;  ///< delta, of the summits' mean plane above the surfaces' [m], in [0, 4 sigma]
};

enum class CavitatedShear { full, film_share };
/// What shear does to the bodies; friction torques and powers are reported whatever it is.
enum class ShearForce { full, torque_only, none };
enum class FilmSolver { newton, sor, multigrid };

/// Condition on an edge: oil at a prescribed pressure, a wall that no oil passes, or a seal through which pressure
/// drives oil out. Two walls make a bearing of infinite width, one a plane of symmetry or a cap.
enum class EdgeKind { pressure, closed, leaking };

/// An edge of the film, z = -L/2 or +L/2, or an end of a patch.
struct Edge {
  EdgeKind kind = EdgeKind::pressure;
  double pressure = 0;  ///< outside [Pa], >= p_cav; without meaning at a wall
  /// Fill fraction outside an edge at p_cav, from 0 (air) to 1 (oil); it counts only where oil is conserved [-].
  double ambient_fill = 0;
  double leakage = 0;  ///< kappa of a seal (damper.1), > 0; counts only where the edge leaks [-]
  /// All the oil that reaches the end of a patch at p_cav, of which the film takes what it can (film.64), in place of
  /// `ambient_fill`; counts only where oil is conserved [m^3/s], >= 0.
  std::optional<double> flow = {};
  /// Thickness of the oil that sticks to the journal's surface where it runs in over this edge z = -L/2 or +L/2 at
  /// p_cav: all the oil there is, of which the film takes what it can (film.65), in place of `ambient_fill`; counts
  /// only where oil is conserved [m], >= 0. Choose it where a surface has been wiped before, as a liner by an oil ring.
  std::optional<double> layer = {};
  /// True if the oil that comes is given, instead of what the film draws from its surroundings.
  [[nodiscard]] bool gives_oil() const { return flow || layer; }
};

/// The edges on the first and on the last line of a patch.
struct PatchEnds {
  Edge first, last;
};

/// Scale of all pressures: 0 is the atmosphere or a vacuum. The equations do not depend on it.
enum class PressureScale { gauge, absolute };

/// Constant data of one film. All its pressures are on one scale.
struct FilmModel {
  FilmSurface surface = Cylinder{};
  double R = 0.0225;  ///< bearing radius [m], > 0: the length per unit of phi at which speeds are meant
  double L = 0.0156;  ///< bearing width [m], > 0
  double c = 34e-6;   ///< radial clearance: scales unknowns and supply, the gap itself comes with the motion [m], > 0
  Grid grid;
  Lubricant lubricant;
  Cavitation cavitation = Cavitation::mass_conserving;
  PressureScale pressures = PressureScale::gauge;
  double p_cav = 0;  ///< cavitation pressure [Pa]
  Edge edge_left, edge_right;
  std::vector<PatchEnds> ends = {};  ///< of each patch of the grid
  SupplyLine supply;
  Asperities asperities;
  Roughness roughness;
  Turbulence turbulence;
  double compliance = 0;  ///< column compliance w/p = length / composite modulus [m/Pa], >= 0; 0: rigid
  CavitatedShear cavitated_shear = CavitatedShear::film_share;
  ShearForce shear_force = ShearForce::full;
  double fill_speed =
      1000;  ///< angular speed in P0 (film.6), > 0; one near the film's own keeps Newton's path short [rad/s]
  std::vector<SurfaceFeature> features;  ///< where several overlap, the one that covers more of a node counts
  std::vector<Profile> profiles;         ///< shapes of bore and journal; the surfaces' motion includes them (GapShape)
};

/// True if a restrictor feeds one of the film's features, whose pressure is then found with the film.
[[nodiscard]] inline bool has_restrictors(const FilmModel& model) {
  for (const SurfaceFeature& feature : model.features)
    if (feature.restrictor) return true;
  return false;
}

/// The edge on which the axial row j of the grid lies; null for those between.
[[nodiscard]] inline const Edge* edge_of_row(const FilmModel& model, int j) {
  if (j == 0) return &model.edge_left;
  return j == model.grid.n_z - 1 ? &model.edge_right : nullptr;
}

/// Fraction of oil in what a film draws in over an edge: 1 above the cavitation pressure; a wall counts less than air,
/// as does a seal, which only pressure passes; a given flow or layer counts between air and oil [-].
[[nodiscard]] inline double fill_outside(const FilmModel& model, const Edge& edge) {
  if (edge.kind == EdgeKind::closed) return -1;
  if (edge.kind == EdgeKind::leaking) return edge.pressure > model.p_cav ? 1 : -0.5;
  if (edge.pressure > model.p_cav) return 1;
  return edge.gives_oil() ? 0.5 : edge.ambient_fill;
}

/// The edge on which a node lies; null between them. Where two meet, one with a pressure counts before a seal and this
/// before a wall, then the one with more oil outside, which fills the corner, then that of the row.
[[nodiscard]] inline const Edge* edge_of_node(const FilmModel& model, int node) {
  const Grid& grid = model.grid;
  const Edge* of_row = edge_of_row(model, node % grid.n_z);
  const int line = node / grid.n_z;
  if (grid.closes() || !grid.is_end(line)) return of_row;
  const PatchEnds& ends = model.ends[static_cast<std::size_t>(grid.patch_of(line))];
  const Edge& of_line = grid.begins_patch(line) ? ends.first : ends.last;
  if (of_row == nullptr) return &of_line;
  if (of_row->kind == EdgeKind::leaking) return of_line.kind == EdgeKind::pressure ? &of_line : of_row;
  const bool is_wall = of_row->kind == EdgeKind::closed;
  return is_wall || fill_outside(model, of_line) > fill_outside(model, *of_row) ? &of_line : of_row;
}

/// The arcs that the bore of a film of patches consists of; null: it is none.
[[nodiscard]] inline const Arcs* arcs_of(const FilmModel& model) {
  for (const Profile& profile : model.profiles)
    if (const auto* arcs = std::get_if<Arcs>(&profile.shape)) return arcs;
  return nullptr;
}

/// True if walls close the film on both sides.
[[nodiscard]] inline bool is_closed(const FilmModel& model) {
  return model.edge_left.kind == EdgeKind::closed && model.edge_right.kind == EdgeKind::closed;
}

/// P0, the constant [Pa] that scales the fill fraction's unknown: theta = 1 + min(u, 0)/P0. It equals the pressure
/// scale 6 mu0 fill_speed (R/c)^2 dphi and has no influence on the solution (film.6).
[[nodiscard]] double fill_scale(const FilmModel& model);

/// The law of the model's cavitation.
[[nodiscard]] inline const CavitationLaw& cavitation_law(const FilmModel& model) {
  return cavitation_law(model.cavitation);
}

/// Gap and speeds of the film's two surfaces at one instant, in the frame of the grid. The depth of features is no part
/// of the gap: it comes with the model. The grid may rotate in any way: speeds are relative to it and `g_rate` is taken
/// at its fixed points, which makes the equations frame-invariant.
struct SurfaceMotion {
  Eigen::VectorXd g;       ///< gap of the undeformed surfaces at the nodes [m], shape (grid.size())
  Eigen::VectorXd g_rate;  ///< d g/dt at fixed grid points [m/s], same shape
  /// Displacement of the shell's surface outwards from its cylinder [m], same shape; empty: none. It is the shell's
  /// fraction of the difference of g from the gap of two cylinders; pressure on its slopes acts on the shell (film.52).
  Eigen::VectorXd shell_opening = {};
  double u_shell = 0;                     ///< speed of the shell surface (y = 0) along phi at R [m/s]
  double u_journal = 0;                   ///< speed of the journal surface (y = h) along phi at R [m/s]
  double w_shell = 0;                     ///< speed along z of the shell surface [m/s]
  double w_journal = 0;                   ///< speed along z of the journal surface [m/s]
  double phi_supply = 0;                  ///< where the supply line is now [rad]; ignored without one
  double phi_journal = 0;                 ///< rotation of the journal over the grid [rad]; moves the journal's features
  Eigen::VectorXd feature_pressure = {};  ///< pressure of each feature [Pa], at least p_cav counts; empty: the model's
  /// Roughness of both surfaces over that of the model, as they run in [-], > 0, shape (grid.size()); empty: 1.
  Eigen::VectorXd roughness_ratio = {};
  /// Returns that ratio at a node.
  [[nodiscard]] double roughness_at(Eigen::Index node) const {
    return roughness_ratio.size() == 0 ? 1 : roughness_ratio[node];
  }
};

/// Viscosities of an oil whose temperature varies over the film, at the cavitation pressure: integrals over the layers
/// that flow and shear depend on (theory manual, thermal.4, thermal.5). They are constant while the film is solved. An
/// oil that thins by shear does so by the shear of its layers where these include it; else by the film's sliding.
struct LayeredViscosity {
  Eigen::VectorXd fluidity;        ///< 12 F2/h^3, of flow along pressure [1/(Pa s)], shape (grid.size())
  Eigen::VectorXd shear_fluidity;  ///< F0/h, of sliding [1/(Pa s)], same shape
  Eigen::VectorXd skew;  ///< 2 F1/(F0 h) - 1, by which sliding carries more oil with the shell [-], same shape
  /// Viscosity of sliding without shear thinning [Pa s], same shape; empty: the others include no shear thinning.
  Eigen::VectorXd at_rest = {};
  Eigen::VectorXd axial_fluidity = {};  ///< of flow along the axis, `fluidity` that around it; empty: the same
};

/// The film at the start of the step being solved. dt = 0 leaves theta g_rate as the only storage: a steady film under
/// the given g_rate. The fill fraction is first order in time, a full film follows the exact g_rate (film.12).
struct FilmHistory {
  double dt = 0;            ///< [s]
  Eigen::VectorXd theta;    ///< fill fraction at the start [-], shape (grid.size()); unused for dt = 0
  Eigen::VectorXd w;        ///< compliance deformation at the start [m]; empty: it rests (w' = 0); unused for dt = 0
  Eigen::VectorXd density;  ///< rho/rho0 at the start [-]; empty: 1; unused for dt = 0
  /// Gap that contained the film's oil over each control volume at the start, pockets apart [m]; theta density
  /// (gap + pockets) is the oil that was there. Empty: the gap from which the rate leads to the present one.
  Eigen::VectorXd gap = {};
  bool by_gap = false;     ///< a full film follows the change of the gap over the step instead of the rate (film.15)
  double phi_journal = 0;  ///< rotation of the journal at the start [rad]; moves its pockets
  LayeredViscosity viscosity = {};  ///< empty: that of the model everywhere
};

}  // namespace hersey::film
