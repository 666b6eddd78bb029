#pragma once

#include <string>

#include "hersey/fem/elastic_body.h"

namespace hersey::fem {

/// The body whose stiffness and mass matrices another program assembled on the nodes of `mesh`, in SI, three degrees of
/// freedom x, y, z for each node in the mesh's order. `reduce` and `natural_modes` take it as one of ours.
/// @param M consistent or lumped: (3 n, 3 n) that is m (x) I3, or m itself (n, n).
/// @param name of the matrices' source, for messages.
/// @throws InputError unless both are symmetric and of the mesh's size, M is the same in all three directions with a
///   positive sum, and no rigid motion strains the body (supports left in K do).
[[nodiscard]] ElasticBody import_body(Mesh mesh, const Eigen::SparseMatrix<double>& K,
                                      const Eigen::SparseMatrix<double>& M, const std::string& name);

}  // namespace hersey::fem
