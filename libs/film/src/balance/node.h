#pragma once

#include <Eigen/Dense>
#include <array>

#include "hersey/film/film_model.h"

namespace hersey::film {

/// How the surfaces of a film slide past each other, of which alone an oil in one layer thins (thermal.24).
struct Sliding {
  double speed = 0;      ///< [m/s]
  double share_phi = 1;  ///< of its square, what goes around [-]
};

/// Of the speeds of these surfaces. A speed of a tenth of a millimetre per second stands for rest, where the direction
/// turns.
[[nodiscard]] Sliding sliding_of(double slip_phi, double slip_z);

/// Change of a sliding: of the logarithm of its speed, and of its direction.
struct SlidingChange {
  double rate = 0, rotation = 0;  ///< [-]
};

/// With changes of the slip.
[[nodiscard]] SlidingChange change_of_sliding(const Eigen::Vector2d& slip, const Eigen::Vector2d& change);

/// A fluidity 1/mu [1/(Pa s)] with its derivatives.
struct Fluidity {
  double value = 0;
  double u = 0;                   ///< with u, at a fixed film thickness
  double h = 0;                   ///< with the film thickness
  double rate = 0, rotation = 0;  ///< with what SlidingChange tells

  [[nodiscard]] double along(const SlidingChange& change) const {
    return rate * change.rate + rotation * change.rotation;
  }
};

/// Everything the film is at one node, with derivatives: x_u = dx/du, x_g = dx/dg (theory manual, film.3 to film.10).
struct Node {
  double p = 0, p_u = 0;                ///< pressure above p_cav in the balance of flows [Pa]
  double wall = 0, wall_u = 0;          ///< pressure the walls feel, p_cav + max(u, 0) [Pa]
  double theta = 1, theta_u = 0;        ///< fill fraction [-]
  double share = 1, share_u = 0;        ///< share of the gap that carries Couette shear [-]
  double other_share = 1;               ///< what it would be with the other CavitatedShear [-]
  std::array<Fluidity, 2> flow{};       ///< 1/mu, as flow along pressure sees it, around and along the axis
  double mu = 0, mu_u = 0, mu_h = 0;    ///< as sliding sees it [Pa s], at fixed h and at fixed u
  double mu_rate = 0;                   ///< with the logarithm of the sliding speed [Pa s]
  double density = 1, density_u = 0;    ///< rho/rho0 [-]
  double content = 1, content_u = 0;    ///< oil in the gap, density theta [-]
  double h = 0, h_u = 0, h_g = 1;       ///< film thickness [m]
  double w = 0;                         ///< column deformation [m]
  double asperity = 0, asperity_h = 0;  ///< contact pressure [Pa] and its slope in h
};

/// Scales of what u < 0 tells in this film.
[[nodiscard]] CavitationScales cavitation_scales(const FilmModel& model);

/// An edge at the cavitation pressure of a film that conserves oil lies in air: oil may leave over it but none comes
/// in. There p = p_cav whatever u is; u >= 0 stands for the outflow, u < 0 for the fill fraction (film.18).
[[nodiscard]] bool open_edge(const FilmModel& model, int node);

/// Fill fraction of what an open edge lets in; 0 at all other nodes. Where the film would be emptier than that, it
/// draws in what it lacks: u then stands for the inflow (film.19).
[[nodiscard]] double ambient_fill(const FilmModel& model, int node);

/// Viscosities at one node at the cavitation pressure, of flow along pressure and of sliding; LayeredViscosity.
struct NodeViscosity {
  double flow = 1, shear = 1;  ///< [Pa s]
  double axial = 1;            ///< fluidity of flow along the axis over that around it [-]
  double at_rest = 1;          ///< without what shear has taken from these [Pa s]
  bool is_sheared = false;     ///< whether it has
};

/// The laws that hold at every node of one film.
class NodeLaw {
 public:
  explicit NodeLaw(const FilmModel& model);

  /// State of a node at rest with undeformed gap g [m] and unknown u [Pa]. h <= 0 is left to the caller to judge.
  [[nodiscard]] Node state(double g, double u, int node) const {
    Node state;
    evaluate(g, u, node, {}, state);
    return state;
  }
  /// The same of one that slides.
  void evaluate(double g, double u, int node, const Sliding& sliding, Node& state) const {
    evaluate(g, u, node, sliding, uniform_, state);
  }
  /// The same where the oil has a viscosity of its own.
  void evaluate(double g, double u, int node, const Sliding& sliding, const NodeViscosity& viscosity,
                Node& state) const;

 private:
  void pressure_and_fill(double u, int at, Node& node) const;
  void rheology(const NodeViscosity& viscosity, const Sliding& sliding, Node& node) const;
  void thin(const Sliding& sliding, double log_slope, Node& node) const;
  void film_thickness(double g, Node& node) const;
  void contact(double h, Node& node) const;

  const FilmModel& model_;
  const CavitationLaw& cavitation_;
  CavitationScales scales_;
  double contact_scale_;
  NodeViscosity uniform_;  ///< the model's
};

}  // namespace hersey::film
