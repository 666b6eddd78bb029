#pragma once

#include "hersey/film/film_model.h"

namespace hersey::film {

/// Everything the film is at one node, with derivatives: x_u = dx/du, x_g = dx/dg (theory manual, film.3 to film.10).
struct Node {
  double p = 0, p_u = 0;                ///< pressure above p_cav in the balance of flows [Pa]
  double wall = 0, wall_u = 0;          ///< pressure the walls feel, p_cav + max(u, 0) [Pa]
  double theta = 1, theta_u = 0;        ///< fill fraction [-]
  double share = 1, share_u = 0;        ///< share of the gap that carries Couette shear [-]
  double fluidity = 0, fluidity_u = 0;  ///< 1/mu, as flow along pressure sees it [1/(Pa s)]
  double shear_viscosity = 1;           ///< mu as sliding sees it, over 1/fluidity [-]
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
[[nodiscard]] bool open_edge(const FilmModel& model, int j);

/// Fill fraction of what an open edge lets in; 0 in all other rows. Where the film would be emptier than that, it draws
/// in what it lacks: u then stands for the inflow (film.19).
[[nodiscard]] double ambient_fill(const FilmModel& model, int j);

/// Viscosities at one node at the cavitation pressure, of flow along pressure and of sliding; LayeredViscosity.
struct NodeViscosity {
  double flow = 1, shear = 1;  ///< [Pa s]
};

/// The laws that hold at every node of one film.
class NodeLaw {
 public:
  explicit NodeLaw(const FilmModel& model);

  /// State of a node in axial row j with undeformed gap g [m] and unknown u [Pa]. h <= 0 is left to the caller to
  /// judge.
  [[nodiscard]] Node state(double g, double u, int j) const { return state(g, u, j, uniform_); }
  /// The same where the oil has a viscosity of its own.
  [[nodiscard]] Node state(double g, double u, int j, const NodeViscosity& viscosity) const;

 private:
  void pressure_and_fill(double u, int j, Node& node) const;
  void rheology(const NodeViscosity& viscosity, Node& node) const;
  void film_thickness(double g, Node& node) const;
  void contact(double h, Node& node) const;

  const FilmModel& model_;
  const CavitationLaw& cavitation_;
  CavitationScales scales_;
  double contact_scale_;
  NodeViscosity uniform_;  ///< the model's
};

}  // namespace hersey::film
