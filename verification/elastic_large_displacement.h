#pragma once

#include <algorithm>
#include <vector>

#include "hersey/fem/constrained_stiffness.h"
#include "hersey/fem/finite_strain.h"

/// A whole mesh in equilibrium under large displacements: what bodies of nodes, and bars pulled and bent far, are
/// compared with.
namespace hersey::verification {

struct LargeDisplacement {
  double load = 0;    ///< share of the load reached: 1 if all goes well
  Eigen::VectorXd u;  ///< there (3 n) [m]
};

/// Newton's method at one share of the load, from `u` on; false: no equilibrium was found, `u` is of no use.
inline bool reach(double share, const fem::ElasticBody& body, const std::vector<fem::Support>& supports,
                  const Eigen::VectorXd& f, Eigen::VectorXd& u) {
  double size = 0;
  for (const Vector3& x : body.mesh.nodes) size = std::max(size, (x - body.mesh.nodes[0]).norm());
  std::vector<int> fixed;
  Eigen::VectorXd prescribed = Eigen::VectorXd::Zero(u.size());
  for (const fem::Support& s : supports) {
    fixed.push_back(s.dof);
    prescribed[s.dof] = share * s.displacement - u[s.dof];
  }
  fem::ConstrainedStiffness stiffness(body.K, body.m, fixed);
  for (int i = 0; i < 25; ++i) {
    fem::FiniteStrain inner;
    fem::finite_strain(body, u, inner);
    stiffness.replace(inner.tangent);
    if (!stiffness.factorise().solved()) return false;
    const Eigen::VectorXd residual = inner.force - share * f + inner.tangent * prescribed;
    const Eigen::VectorXd correction = prescribed - stiffness.solve(residual);
    const double moved = correction.cwiseAbs().maxCoeff();
    if (!(moved < size)) return false;
    u += correction;
    prescribed.setZero();
    if (moved < 1e-10 * size) return true;
  }
  return false;
}

/// Equilibrium with forces `f` (3 n) that keep their directions, displacements as large as they like, strains moderate:
/// beyond some ten percent of compression the material itself gives way. Load and prescribed displacements grow in
/// `steps` equal parts, halved where Newton's method fails.
[[nodiscard]] inline LargeDisplacement solve_large_displacement(const fem::ElasticBody& body,
                                                                const std::vector<fem::Support>& supports,
                                                                const Eigen::VectorXd& f, int steps = 5) {
  LargeDisplacement result{.u = Eigen::VectorXd::Zero(body.size())};
  double part = 1.0 / steps;
  while (result.load < 1) {
    // The last part ends on the whole load, not on a sum of parts.
    const double next = result.load + part > 1 - 1e-9 ? 1 : result.load + part;
    Eigen::VectorXd u = result.u;
    if (reach(next, body, supports, f, u)) {
      result = {next, u};
    } else if ((part /= 2) < 1e-3) {
      return result;
    }
  }
  return result;
}

}  // namespace hersey::verification
