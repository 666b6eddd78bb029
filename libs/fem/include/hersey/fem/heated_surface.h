#pragma once

#include <Eigen/Dense>
#include <vector>

#include "hersey/core/outcome.h"
#include "hersey/fem/elastic_body.h"
#include "hersey/fem/film_surface.h"
#include "hersey/fem/heat_conduction.h"

/// What the heat of a film does to the body on whose mesh it lies (theory manual, thermal.35, thermal.36, thermal.59).
namespace hersey::fem {

struct HeatedSurfaceOptions {
  /// Of the film's nodes around, ascending within one turn [rad], at least 3; none: heat comes evenly to all of the
  /// surface, as to that of a journal which turns in its film.
  std::vector<double> angles;
  double T_reference = 293.15;  ///< at which the body has the shape of its mesh [K]
  std::vector<int> held;        ///< degrees of freedom that do not move; none: the body grows freely
  bool expands = true;          ///< false: no shape is asked for
};

/// Linear in the heat into each angle: at angle phi_i it has the weight w_i(phi), 1 there and 0 at both neighbours, and
/// is spread evenly over the film's width. Of even heat there is one column, that of all of it.
struct [[nodiscard]] HeatedSurface : Outcome {
  Eigen::VectorXd T0;         ///< mean temperatures with the same weights, no heat from the film, shape (angles) [K]
  Eigen::MatrixXd rise;       ///< by the heat into each angle, shape (angles, angles) [K/W], symmetric
  Eigen::VectorXd T_body0;    ///< at the nodes of the mesh, no heat [K]
  Eigen::MatrixXd rise_body;  ///< by the heat, shape (nodes, angles) [K/W]
  /// Radial displacement outward in the functions of the surface, less the rigid motion of the surface nearest to it:
  /// without heat [m], by the heat [m/W], by a rise of all temperatures [m/K]; shape (functions, ...).
  Eigen::VectorXd shape0;
  Eigen::MatrixXd shape_by_heat;
  Eigen::VectorXd shape_by_rise;
};

/// @param thermal of the elements, by Element::material (none given: the first)
/// @cost a factorisation and one solution per angle, of temperatures and, where it expands, of displacements
/// @verified_by heated_surface_test.cpp
[[nodiscard]] HeatedSurface heated_surface(const ElasticBody& body, const std::vector<ThermalMaterial>& thermal,
                                           const ThermalSurroundings& surroundings, const FilmSurface& surface,
                                           const HeatedSurfaceOptions& options);

/// The mean around, along the axis, of shapes in the functions of a surface (theory manual, thermal.61): what the film
/// of a journal that turns sees of them. @param shapes  (functions, ...) @param z  [m] @returns (z.size(), ...)
[[nodiscard]] Eigen::MatrixXd mean_around(const SurfaceFunctions& functions, const Eigen::MatrixXd& shapes,
                                          const std::vector<double>& z);

/// Six degrees of freedom that hold a body and hinder no deformation: as supports of loads in balance.
[[nodiscard]] std::vector<int> statically_determinate(const Mesh& mesh);

}  // namespace hersey::fem
