#include "hersey/fem/finite_strain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "block_pattern.h"
#include "hersey/core/contract.h"

namespace hersey::fem {
namespace {

constexpr double smallest_part = 1e-3;  // of the load

double size_of(const Mesh& mesh) {
  double size = 0;
  for (const Vector3& x : mesh.nodes) size = std::max(size, (x - mesh.nodes[0]).norm());
  return size;
}

/// Newton's method at one share of the load.
class Equilibrium {
 public:
  Equilibrium(const ElasticBody& body, const std::vector<Support>& supports, const Eigen::VectorXd& f,
              const LargeDisplacementOptions& options)
      : body_(body),
        supports_(supports),
        f_(f),
        options_(options),
        size_(size_of(body.mesh)),
        stiffness_(body.K, body.m, dofs(supports)) {}

  /// Moves `u` to the equilibrium at `share`; false if there is none to be found.
  bool reach(double share, Eigen::VectorXd& u, int& iterations) {
    Eigen::VectorXd prescribed = Eigen::VectorXd::Zero(u.size());
    for (const Support& s : supports_) prescribed[s.dof] = share * s.displacement - u[s.dof];
    for (int i = 0; i < options_.most_iterations; ++i) {
      ++iterations;
      finite_strain(body_, u, inner_);
      stiffness_.replace(inner_.tangent);
      if (!stiffness_.factorise().ok()) return false;
      const Eigen::VectorXd residual = inner_.force - share * f_ + inner_.tangent * prescribed;
      const Eigen::VectorXd correction = prescribed - stiffness_.solve(residual);
      const double moved = correction.cwiseAbs().maxCoeff();
      if (!(moved < size_)) return false;
      u += correction;
      prescribed.setZero();
      if (moved < options_.tolerance * size_) return true;
    }
    return false;
  }

 private:
  static std::vector<int> dofs(const std::vector<Support>& supports) {
    std::vector<int> held;
    held.reserve(supports.size());
    for (const Support& s : supports) held.push_back(s.dof);
    return held;
  }

  const ElasticBody& body_;
  const std::vector<Support>& supports_;
  const Eigen::VectorXd& f_;
  const LargeDisplacementOptions& options_;
  double size_;
  HeldStiffness stiffness_;
  FiniteStrain inner_;
};

}  // namespace

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

LargeDisplacement solve_large_displacement(const ElasticBody& body, const std::vector<Support>& supports,
                                           const Eigen::VectorXd& f, const LargeDisplacementOptions& options) {
  HERSEY_REQUIRE(f.size() == body.size() && options.steps > 0, "one force per degree of freedom");
  Equilibrium equilibrium(body, supports, f, options);
  LargeDisplacement result{.u = Eigen::VectorXd::Zero(body.size())};
  double part = 1.0 / options.steps;
  while (result.load < 1) {
    // The last part ends on the whole load, not on a sum of parts.
    const double next = result.load + part > 1 - 1e-9 ? 1 : result.load + part;
    Eigen::VectorXd u = result.u;
    if (equilibrium.reach(next, u, result.iterations)) {
      result.u = std::move(u);
      result.load = next;
    } else if ((part /= 2) < smallest_part) {
      result.message = fmt::format(
          "no equilibrium beyond {:.4g} of the load: the body is not held, it buckles, or it is compressed too far for "
          "its material",
          result.load);
      return result;
    }
  }
  result.ok = true;
  return result;
}

}  // namespace hersey::fem
