#pragma once

#include <string>

#include "hersey/fem/elastic_body.h"

namespace hersey::fem {

/// Builds a body from stiffness and mass matrices that another program assembled on the nodes of `mesh`, in SI, three
/// degrees of freedom x, y, z for each node in the mesh's order. `reduce` and `natural_modes` accept it like an
/// assembled body.
/// @param M consistent or lumped: (3 n, 3 n) that is m (x) I3, or m itself (n, n).
/// @param name source of the matrices, for messages.
/// @throws InputError unless both are symmetric and of the mesh's size, M is the same in all three directions with a
/// positive sum, and no rigid motion strains the body (supports that were left in K do).
[[nodiscard]] ElasticBody import_body(Mesh mesh, const Eigen::SparseMatrix<double>& K,
                                      const Eigen::SparseMatrix<double>& M, const std::string& name);

}  // namespace hersey::fem
