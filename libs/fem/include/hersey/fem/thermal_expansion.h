#pragma once

#include <vector>

#include "hersey/fem/elastic_body.h"
#include "hersey/fem/thermal_material.h"

/// What temperature does to an elastic body (theory manual, elastic.27, elastic.28).
namespace hersey::fem {

/// Nodal forces (3 nodes, nodes) [N/K] of an element by the rise of temperature at its nodes, int B^T D m alpha N_b dV
/// with m = (1, 1, 1, 0, 0, 0); those of hex8 with its incompatible modes condensed out, (elastic.28).
/// @verified_by thermal_expansion_test.cpp
[[nodiscard]] Eigen::MatrixXd element_expansion(ElementType type, const NodeColumns& x, const SolidMaterial& material,
                                                double expansion, Integration rule = Integration::full);

/// Nodal forces (3 n, columns) [N] that displace `body` as the temperatures do, rise (n, columns) [K] over that at
/// which it has its shape: K u = f. They are in balance: a body that nothing holds back grows without stress.
/// @param thermal of the elements, by Element::material (none given: the first)
[[nodiscard]] Eigen::MatrixXd expansion_load(const ElasticBody& body, const std::vector<ThermalMaterial>& thermal,
                                             const Eigen::MatrixXd& rise);

}  // namespace hersey::fem
