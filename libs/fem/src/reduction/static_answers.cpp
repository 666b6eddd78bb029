#include "hersey/fem/static_answers.h"

#include "hersey/fem/constrained_stiffness.h"
#include "reduction/frame_interface.h"

namespace hersey::fem {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// G^-1 T^T K^-1 T G^-1.
MatrixXd compliance_of(const ConstrainedStiffness& stiffness, const SurfaceMap& surface) {
  const Eigen::LDLT<MatrixXd> G(surface.G);
  MatrixXd C = G.solve(surface.compliance(stiffness));
  C = G.solve(C.transpose()).eval();
  return 0.5 * (C + C.transpose());
}

/// Centrifugal forces -M a of a rotation at 1 rad/s.
VectorXd centrifugal(const ElasticBody& body, const Vector3& centre, const Vector3& axis) {
  VectorXd a(body.size());
  for (Index n = 0; n < body.node_count(); ++n)
    a.segment<3>(3 * n) = axis.cross(axis.cross(body.mesh.nodes[static_cast<std::size_t>(n)] - centre));
  return -mass_times(body.m, a);
}

}  // namespace

StaticAnswers static_answers(const ElasticBody& body, const std::vector<InterfaceFrame>& frames,
                             const SurfaceMap& surface, const Vector3& centre, const Vector3& axis) {
  StaticAnswers answers;
  answers.message = fault_of(body.mesh, frames);
  if (!answers.message.empty()) return answers;
  const Interface interface = interface_of(body.mesh, frames);
  ConstrainedStiffness stiffness(body.K, body.m, interface.fixed_dofs, interface.C);
  if (const solver::FactorSummary summary = stiffness.factorise(); !summary.solved()) {
    answers.message = summary.status == solver::FactorStatus::singular
                          ? "a part of the body is not connected to the frames"
                          : summary.message;
    return answers;
  }
  answers.set_solved(true);
  answers.shapes = constraint_modes(body, interface, stiffness);
  answers.stiffness = answers.shapes.transpose() * (body.K * answers.shapes);
  answers.stiffness = (0.5 * (answers.stiffness + answers.stiffness.transpose())).eval();
  answers.compliance = compliance_of(stiffness, surface);
  const VectorXd pull = centrifugal(body, centre, axis);
  answers.spin_on_frames = answers.shapes.transpose() * pull;
  answers.spin = surface.coefficients(stiffness.solve(pull));
  return answers;
}

}  // namespace hersey::fem
