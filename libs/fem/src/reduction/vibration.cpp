#include "hersey/fem/vibration.h"

#include <cmath>

#include "hersey/core/contract.h"
#include "hersey/fem/ties.h"
#include "reduction/block_lanczos.h"

namespace hersey::fem {
namespace {

constexpr double shift_share = 0.1;  // of the estimated lowest eigenvalue: well conditioned, and still close to zero
constexpr double coincident = 1e-9;
constexpr double strains_nothing = 1e-6;  // a squared frequency below this share of the estimate is a rigid motion's

/// All displacements quadratic in the position, (3 n, 18), of the order of one.
Eigen::MatrixXd quadratic_fields(const ElasticBody& body) {
  const double size = std::sqrt(std::max(body.inertia.trace() / body.mass, 1e-300));
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(body.size(), 18);
  for (Eigen::Index a = 0; a < body.node_count(); ++a) {
    const Vector3 x = (body.mesh.nodes[static_cast<std::size_t>(a)] - body.centre) / size;
    const Vector6 quadratic = (Vector6() << x.cwiseAbs2(), x.x() * x.y(), x.y() * x.z(), x.x() * x.z()).finished();
    for (int i = 0; i < 3; ++i) u.block<1, 6>(3 * a + i, 6 * i) = quadratic.transpose();
  }
  return u;
}

/// Estimate, from above, of the lowest elastic omega^2 of the free body: Rayleigh-Ritz with quadratic displacements,
/// rigid motions taken out. Fields that coincide on the nodes (a box of one element) count once.
double lowest_estimate(const ElasticBody& body) {
  Eigen::MatrixXd u = quadratic_fields(body);
  const Eigen::MatrixXd rigid = rigid_motions(body.mesh, body.centre), M_rigid = mass_times(body.m, rigid);
  u -= rigid * (rigid.transpose() * M_rigid).ldlt().solve(M_rigid.transpose() * u);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> gram(Eigen::MatrixXd(u.transpose() * mass_times(body.m, u)));
  const Eigen::VectorXd& d = gram.eigenvalues();
  const Eigen::Index kept = (d.array() > coincident * d[d.size() - 1]).count();
  u = u * gram.eigenvectors().rightCols(kept) * d.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(Eigen::MatrixXd(u.transpose() * (body.K * u))).eigenvalues()[0];
}

void point_upward(Eigen::MatrixXd& shapes) {
  for (Eigen::Index k = 0; k < shapes.cols(); ++k) {
    Eigen::Index at = 0;
    shapes.col(k).cwiseAbs().maxCoeff(&at);
    if (shapes(at, k) < 0) shapes.col(k) *= -1;
  }
}

}  // namespace

Vibration natural_modes(const ElasticBody& body, const std::vector<int>& fixed_dofs, const VibrationOptions& options,
                        const Eigen::SparseMatrix<double>& constraints) {
  HERSEY_REQUIRE(options.count > 0 && options.rtol > 0, "some modes are wanted");
  if (!(body.mass > 0)) return no_answer<Vibration>("the body has no mass: give its material a density");
  const bool are_given = constraints.cols() > 0;
  const Eigen::SparseMatrix<double> C = are_given ? constraints : tie_constraints(body.mesh, fixed_dofs).C;
  ConstrainedStiffness stiffness(body.K, body.m, fixed_dofs, C);
  const double estimate = lowest_estimate(body);
  const double shift = -shift_share * estimate;
  const solver::FactorSummary summary = stiffness.factorise(shift);
  if (!summary.solved()) return no_answer<Vibration>(summary.message);

  const LanczosProblem problem{.size = body.size(),
                               .rank = stiffness.freedom(),
                               .A = [&](const Eigen::MatrixXd& x) { return stiffness.solve(mass_times(body.m, x)); },
                               .B = [&](const Eigen::MatrixXd& x) { return mass_times(body.m, x); }};
  if (problem.rank <= 0) return no_answer<Vibration>("no degree of freedom is free");
  const double smallest = 1 / (options.highest * options.highest - shift);
  const LanczosResult lanczos = block_lanczos(problem, options.count, smallest, options.rtol);
  if (!lanczos.solved()) return no_answer<Vibration>(lanczos.message);

  Vibration modes;
  modes.set_solved(true);
  modes.shapes = lanczos.vectors;
  modes.solves = lanczos.solves;
  modes.omega.resize(lanczos.theta.size());
  for (Eigen::Index k = 0; k < modes.omega.size(); ++k) {
    const double omega_squared = shift + 1 / lanczos.theta[k];
    const bool is_rigid = std::abs(omega_squared) < strains_nothing * estimate;
    modes.rigid += is_rigid;
    modes.omega[k] = is_rigid ? 0 : std::sqrt(std::max(omega_squared, 0.0));
  }
  point_upward(modes.shapes);
  return modes;
}

}  // namespace hersey::fem
