#pragma once

#include <vector>

#include "hersey/fem/elastic_body.h"
#include "hersey/fem/thermal_material.h"

/// Thermal expansion of an elastic body (theory manual, elastic.27, elastic.28).
namespace hersey::fem {

/// Returns the nodal forces (3 nodes, nodes) [N/K] of an element by the rise of temperature at its nodes, int B^T D m
/// alpha N_b dV with m = (1, 1, 1, 0, 0, 0); for hex8 with its incompatible modes condensed out, (elastic.28).
/// @verified_by thermal_expansion_test.cpp
[[nodiscard]] Eigen::MatrixXd element_expansion(ElementType type, const NodeColumns& x, const SolidMaterial& material,
                                                double expansion, Integration rule = Integration::full);

/// Returns the nodal forces (3 n, columns) [N] that cause the thermal displacements, K u = f, for rises (n, columns)
/// [K] above the temperature at which the body has its shape. They are in equilibrium: an unconstrained body under an
/// even rise expands without stress.
/// @param thermal materials of the elements, by Element::material (an element without one takes the first)
[[nodiscard]] Eigen::MatrixXd expansion_load(const ElasticBody& body, const std::vector<ThermalMaterial>& thermal,
                                             const Eigen::MatrixXd& rise);

}  // namespace hersey::fem
