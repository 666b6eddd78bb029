#pragma once

#include <Eigen/Dense>
#include <vector>

#include "hersey/core/outcome.h"
#include "hersey/fem/elastic_body.h"
#include "hersey/fem/film_surface.h"
#include "hersey/fem/heat_conduction.h"

/// Temperatures and deformation that the heat of a film causes in the body on whose mesh it lies (theory manual,
/// thermal.35, thermal.36, thermal.59).
namespace hersey::fem {

struct HeatedSurfaceOptions {
  /// Angles of the film's nodes around, ascending within one revolution [rad], at least 3; none: heat is spread evenly
  /// over all of the surface, as on a journal that rotates in its film.
  std::vector<double> angles;
  double T_reference = 293.15;  ///< temperature at which the body has the shape of its mesh [K]
  std::vector<int> fixed_dofs;  ///< degrees of freedom that do not move; none: the body expands freely
  bool expands = true;          ///< false: no shape is computed
};

/// Response of a body that is linear in the heat into each angle: the heat at angle phi_i has the weight w_i(phi), 1 at
/// phi_i and 0 at both neighbours, and is spread evenly over the film's width. Even heat has one column, that of the
/// total heat.
struct [[nodiscard]] HeatedSurface : Outcome {
  Eigen::VectorXd T0;    ///< mean temperatures with the same weights, no heat from the film, shape (angles) [K]
  Eigen::MatrixXd rise;  ///< rise of these means by the heat into each angle, shape (angles, angles) [K/W], symmetric
  Eigen::VectorXd T_body0;    ///< temperatures at the nodes of the mesh, no heat [K]
  Eigen::MatrixXd rise_body;  ///< rise of these temperatures by the heat, shape (nodes, angles) [K/W]
  /// Radial displacement outward in the functions of the surface, less the nearest rigid motion of the surface: without
  /// heat [m], by the heat [m/W], by a rise of all temperatures [m/K]; shape (functions, ...).
  Eigen::VectorXd shape0;
  Eigen::MatrixXd shape_by_heat;
  Eigen::VectorXd shape_by_rise;
};

/// Computes the response of `body` to the heat of a film on `surface`.
/// @param thermal materials of the elements, by Element::material (an element without one takes the first)
/// @cost a factorisation and one solution per angle, of temperatures and, where it expands, of displacements
/// @verified_by heated_surface_test.cpp
[[nodiscard]] HeatedSurface heated_surface(const ElasticBody& body, const std::vector<ThermalMaterial>& thermal,
                                           const ThermalSurroundings& surroundings, const FilmSurface& surface,
                                           const HeatedSurfaceOptions& options);

/// Returns the mean over the angle, as a function of z, of shapes in the functions of a surface (theory manual,
/// thermal.61): the shape that acts on the film of a rotating journal. @param shapes  (functions, ...) @param z  [m]
/// @returns (z.size(), ...)
[[nodiscard]] Eigen::MatrixXd mean_around(const SurfaceFunctions& functions, const Eigen::MatrixXd& shapes,
                                          const std::vector<double>& z);

/// Returns six degrees of freedom that support a body without hindering its deformation, as supports for loads in
/// equilibrium.
[[nodiscard]] std::vector<int> statically_determinate(const Mesh& mesh);

}  // namespace hersey::fem
