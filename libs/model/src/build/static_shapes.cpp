#include "build/static_shapes.h"

#include <algorithm>

#include "build/build_flexible.h"
#include "hersey/core/input_error.h"
#include "hersey/fem/static_answers.h"
#include "hersey/mbd/modal_body.h"

namespace hersey::model {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Pose pose_of(const Body& body, const std::string& frame) {
  for (const Frame& candidate : body.frames)
    if (candidate.name == frame) return candidate.X_BF;
  return {};
}

/// Forces on all frames and on the internal amplitudes of a modal body that rotates at 1 rad/s.
VectorXd spin_forces(const mbd::ModalBodyData& data, const Vector3& centre, const Vector3& axis) {
  mbd::ModalBody body(data);
  mbd::ElasticMotion turning;
  for (const Pose& rest : data.rest) {
    mbd::ElasticFrame frame{.X_WF = rest};
    frame.V << axis, axis.cross(rest.r - centre);
    frame.deformation = Vector6::Zero();
    turning.frames.push_back(frame);
  }
  turning.eta = turning.eta_rate = turning.eta_acceleration = VectorXd::Zero(body.coordinate_count());
  mbd::ElasticResponse needed;
  body.evaluate(turning, false, needed);
  return -needed.force;  // what the motion needs pulls the other way where nothing gives it
}

StaticShapes of_modal_body(const Model& model, const Body& body, const DeformingSurface& surface,
                           const std::string& frame) {
  const mbd::ModalBodyData data = modal_shapes(body, surfaces_on(model, body));
  const Index frames = 6 * (static_cast<Index>(data.rest.size()) - 1), internal = data.shapes() - frames;
  const Pose X = pose_of(body, frame);
  const VectorXd spin = spin_forces(data, X.r, X.R.col(2));
  StaticShapes shapes;
  for (const Pose& rest : data.rest) shapes.at.push_back(rest.r);
  shapes.stiffness = data.stiffness.topLeftCorner(frames, frames);
  shapes.flexibility =
      data.stiffness.bottomRightCorner(internal, internal).ldlt().solve(MatrixXd::Identity(internal, internal));
  shapes.surface = elastic_surface(surface, body, frame, data.displacements);
  shapes.spin_on_frames = spin.head(frames + 6);
  shapes.spin = shapes.flexibility * spin.tail(internal);
  return shapes;
}

StaticShapes of_nodal_body(const Body& body, const DeformingSurface& surface, const std::string& frame) {
  const Pose X = pose_of(body, frame);
  const fem::ElasticBody mesh = assembled(body);
  const fem::StaticAnswers answers =
      fem::static_answers(mesh, interface_frames(body), *surface.surface, X.r, X.R.col(2));
  if (!answers.solved()) throw insufficient_supports(body, answers.message);
  StaticShapes shapes;
  for (const Frame& each : body.frames) shapes.at.push_back(each.X_BF.r);
  const Index frames = answers.stiffness.rows() - 6;
  // No shape moves the first frame.
  shapes.stiffness = answers.stiffness.bottomRightCorner(frames, frames);
  shapes.flexibility = answers.compliance;
  const auto of_frames = elastic_surface(surface, body, frame, answers.shapes.rightCols(frames));
  const Index functions = of_frames->functions.count();
  MatrixXd D(functions, frames + functions);
  D << of_frames->D, MatrixXd::Identity(functions, functions);
  shapes.surface = std::make_shared<const bearing::ElasticSurface>(bearing::ElasticSurface{of_frames->functions, D});
  shapes.spin_on_frames = answers.spin_on_frames;
  shapes.spin = answers.spin;
  return shapes;
}

}  // namespace

StaticShapes static_shapes(const Model& model, const Body& body, const DeformingSurface& surface,
                           const std::string& frame) {
  return body.flexible->nodal ? of_nodal_body(body, surface, frame) : of_modal_body(model, body, surface, frame);
}

}  // namespace hersey::model
