#include "hersey/fem/finite_strain.h"

#include <optional>

#include "element/block_pattern.h"
#include "hersey/core/contract.h"

namespace hersey::fem {
void finite_strain(const ElasticBody& body, const Eigen::VectorXd& u, FiniteStrain& out, bool want_tangent,
                   const Eigen::VectorXd* u_rate) {
  HERSEY_REQUIRE(u.size() == body.size(), "one displacement per degree of freedom");
  std::optional<BlockPattern> pattern;
  if (want_tangent) out.tangent = pattern.emplace(body.mesh).vector_matrix();
  out.energy = 0;
  out.force.setZero(body.size());
  out.rate.setZero(body.size());
  NodeColumns displacement, velocity;
  const auto gather = [&](const Eigen::VectorXd& from, const int* nodes, int count, NodeColumns& to) {
    to.resize(3, count);
    for (Eigen::Index a = 0; a < count; ++a) to.col(a) = from.segment<3>(3 * nodes[a]);
  };
  for (const Element& e : body.mesh.elements) {
    const int* nodes = body.mesh.nodes_of(e);
    gather(u, nodes, fem::node_count(e.type), displacement);
    if (u_rate != nullptr) gather(*u_rate, nodes, fem::node_count(e.type), velocity);
    const FiniteStrainElement element =
        finite_strain_element(e.type, body.positions_of(e), body.material_of(e), displacement, body.integration,
                              want_tangent, u_rate != nullptr ? &velocity : nullptr);
    out.energy += element.energy;
    for (Eigen::Index a = 0; a < displacement.cols(); ++a) {
      out.force.segment<3>(3 * nodes[a]) += element.force.segment<3>(3 * a);
      if (u_rate != nullptr) out.rate.segment<3>(3 * nodes[a]) += element.rate.segment<3>(3 * a);
    }
    if (want_tangent) pattern->add_vector(body.mesh, e, element.tangent, out.tangent);
  }
}

}  // namespace hersey::fem
