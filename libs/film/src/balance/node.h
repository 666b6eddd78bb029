#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "hersey/film/film_model.h"

namespace hersey::film {

/// Sliding of a film's surfaces against each other, by which alone an oil in one layer thins (thermal.24).
struct Sliding {
  double speed = 0;               ///< [m/s]
  double fraction_along_phi = 1;  ///< fraction of the motion along phi in its square [-]
};

/// Returns the sliding of surfaces with these relative speeds. At a tenth of a millimetre per second the direction is
/// blended.
[[nodiscard]] Sliding sliding_of(double slip_phi, double slip_z);

/// Change of a sliding: of the logarithm of its speed, and of its direction.
struct SlidingChange {
  double rate = 0, rotation = 0;  ///< [-]
};

/// Returns the change of a sliding with a change of the slip.
[[nodiscard]] SlidingChange change_of_sliding(const Eigen::Vector2d& slip, const Eigen::Vector2d& change);

/// A fluidity 1/mu [1/(Pa s)] with its derivatives.
struct Fluidity {
  double value = 0;
  double u = 0;                   ///< by u, at a fixed film thickness
  double h = 0;                   ///< with the film thickness
  double rate = 0, rotation = 0;  ///< with the two members of SlidingChange

  [[nodiscard]] double along(const SlidingChange& change) const {
    return rate * change.rate + rotation * change.rotation;
  }
};

/// State of the film at one node, with derivatives: x_u = dx/du, x_g = dx/dg (theory manual, film.3 to film.10).
struct Node {
  double p = 0, p_u = 0;                                ///< pressure above p_cav in the balance of flows [Pa]
  double wall = 0, wall_u = 0;                          ///< pressure on the walls, p_cav + max(u, 0) [Pa]
  double theta = 1, theta_u = 0;                        ///< fill fraction [-]
  double sheared_fraction = 1, sheared_fraction_u = 0;  ///< fraction of the gap that carries Couette shear [-]
  double other_sheared_fraction = 1;                    ///< `sheared_fraction` with the other CavitatedShear [-]
  std::array<Fluidity, 2> flow{};                       ///< 1/mu of flow along pressure, around and along the axis
  double mu = 0, mu_u = 0, mu_h = 0;                    ///< viscosity of sliding [Pa s], at fixed h and at fixed u
  double mu_rate = 0;                                   ///< with the logarithm of the sliding speed [Pa s]
  double mu_laminar = 0;                                ///< the oil's own part of `mu`, without turbulence [Pa s]
  double reynolds = 0;                                  ///< reynolds_number() at the speed of Sliding [-]
  double turbulent_fraction = 0;                        ///< TurbulentFriction::fraction [-]
  double density = 1, density_u = 0;                    ///< rho/rho0 [-]
  double content = 1, content_u = 0;                    ///< oil in the gap, density theta [-]
  double h = 0, h_u = 0, h_g = 1;                       ///< film thickness [m]
  double w = 0;                                         ///< column deformation [m]
  double asperity = 0, asperity_h = 0;                  ///< contact pressure [Pa] and its slope in h
};

/// Returns the scales of u < 0 in this film.
[[nodiscard]] CavitationScales cavitation_scales(const FilmModel& model);

/// True on an edge at the cavitation pressure of a film that conserves oil, which lies in air: oil may leave over it
/// but none comes in. There p = p_cav whatever u is; u >= 0 stands for the outflow, u < 0 for the fill fraction
/// (film.18).
[[nodiscard]] bool open_edge(const FilmModel& model, int node);

/// Returns the fill fraction outside an open edge; 0 at all other nodes. Where the film would be emptier than that, it
/// draws in the oil it lacks: u then stands for the inflow (film.19).
[[nodiscard]] double ambient_fill(const FilmModel& model, int node);

/// Viscosities at one node at the cavitation pressure, of flow along pressure and of sliding; LayeredViscosity.
struct NodeViscosity {
  double flow = 1, shear = 1;  ///< [Pa s]
  double axial = 1;            ///< fluidity of flow along the axis over that around it [-]
  double at_rest = 1;          ///< without shear thinning [Pa s]
  bool is_sheared = false;     ///< true if the others include shear thinning
};

/// Returns the Reynolds number of a node between surfaces that slide at a speed [m/s] (turbulence.1) [-].
[[nodiscard]] inline double reynolds_number(const FilmModel& model, const Node& node, double speed) {
  return model.lubricant.density * node.density * speed * node.h / node.mu_laminar;
}

/// Returns the viscosities of one node of a film.
[[nodiscard]] NodeViscosity node_viscosity(const LayeredViscosity& viscosity, int node);

/// Laws that apply to every node of one film.
class NodeLaw {
 public:
  explicit NodeLaw(const FilmModel& model);

  /// Evaluates a node at rest with undeformed gap g [m] and unknown u [Pa]. The caller handles h <= 0.
  /// @param roughness  over the model's [-]: SurfaceMotion::roughness_at
  [[nodiscard]] Node state(double g, double u, int node, double roughness) const {
    Node state;
    evaluate(g, u, node, {}, roughness, state);
    return state;
  }
  /// Evaluates a node that slides.
  void evaluate(double g, double u, int node, const Sliding& sliding, double roughness, Node& state) const {
    evaluate(g, u, node, sliding, roughness, uniform_, state);
  }
  /// Evaluates a node whose oil has a viscosity of its own.
  void evaluate(double g, double u, int node, const Sliding& sliding, double roughness, const NodeViscosity& viscosity,
                Node& state) const;

 private:
  void pressure_and_fill(double u, int at, Node& node) const;
  void rheology(const NodeViscosity& viscosity, const Sliding& sliding, Node& node) const;
  void thin(const Sliding& sliding, double log_slope, Node& node) const;
  void add_turbulence(const Sliding& sliding, double log_slope, Node& node) const;
  static void set_flow(const Sliding& sliding, const Fluidity& along, const Fluidity& across, Node& node);
  void film_thickness(double g, double roughness, Node& node) const;
  void contact(double h, double roughness, Node& node) const;

  const FilmModel& model_;
  const CavitationLaw& cavitation_;
  CavitationScales scales_;
  double contact_scale_;
  NodeViscosity uniform_;      ///< the model's
  std::vector<char> is_open_;  ///< open_edge() of every node
};

}  // namespace hersey::film
