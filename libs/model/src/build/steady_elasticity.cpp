#include "hersey/model/steady_elasticity.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

#include "build/build_flexible.h"
#include "build/fingerprint.h"
#include "build/static_shapes.h"
#include "hersey/core/contract.h"

namespace hersey::model {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const Body& body_called(const Model& model, const std::string& name) {
  const auto found =
      std::find_if(model.bodies.begin(), model.bodies.end(), [&](const Body& body) { return body.name == name; });
  HERSEY_REQUIRE(found != model.bodies.end(), "the reader checks bodies");
  return *found;
}

/// Index of a frame among those of its body; the body's own axes move with the first.
std::size_t frame_index(const Body& body, const std::string& frame) {
  const auto found =
      std::find_if(body.frames.begin(), body.frames.end(), [&](const Frame& f) { return f.name == frame; });
  return found == body.frames.end() ? 0 : static_cast<std::size_t>(found - body.frames.begin());
}

/// Frames that something of a kind attaches to, each once.
class Attached {
 public:
  explicit Attached(const Body& body) : body_(body) {}
  void add(const FrameName& frame) {
    if (frame.body == body_.name) indices_.insert(frame_index(body_, frame.frame));
  }
  [[nodiscard]] std::vector<std::size_t> indices() const { return {indices_.begin(), indices_.end()}; }

 private:
  const Body& body_;
  std::set<std::size_t> indices_;
};

std::vector<std::size_t> frames_with_joints(const Model& model, const Body& body) {
  Attached attached(body);
  for (const Joint& joint : model.joints) {
    if (joint.type == JointType::free) continue;  // gives coordinates and holds nothing
    attached.add(joint.inboard);
    attached.add(joint.outboard);
  }
  return attached.indices();
}

/// Frames of forces, and of bearings besides `bearing`; not its own frame, which they do not support.
std::vector<std::size_t> frames_with_forces(const Model& model, const Bearing& bearing, const Body& body,
                                            std::size_t own) {
  Attached attached(body);
  for (const Force& force : model.forces)
    for (const FrameName& frame : frames_of(force)) attached.add(frame);
  for (const Bearing& other : model.bearings) {
    if (other.name == bearing.name) continue;
    attached.add(other.shell);
    attached.add(other.journal);
  }
  std::vector<std::size_t> indices = attached.indices();
  std::erase(indices, own);
  return indices;
}

/// Supports of a surface's body, as indices of its frames.
std::vector<std::size_t> supporting_frames(const Model& model, const Bearing& bearing, const Body& body,
                                           std::size_t own) {
  if (std::vector<std::size_t> joints = frames_with_joints(model, body); !joints.empty()) return joints;
  if (std::vector<std::size_t> forces = frames_with_forces(model, bearing, body, own); !forces.empty()) return forces;
  return {own};
}

/// A body by its shapes, supported at some of its frames: displacements of its frames and loads on its amplitudes.
class SupportedBody {
 public:
  SupportedBody(StaticShapes shapes, const std::vector<std::size_t>& supports)
      : shapes_(std::move(shapes)), frames_(shapes_.stiffness.rows()), count_(frames_ + shapes_.flexibility.rows()) {
    rigid_ = -carried(shapes_.at[supports.front()]).inverse() * relative(supports.front());
    MatrixXd rows(6 * static_cast<Index>(supports.size()) - 6, frames_);
    for (std::size_t k = 1; k < supports.size(); ++k)
      rows.middleRows<6>(6 * static_cast<Index>(k - 1)) =
          motion(supports[k], shapes_.at[supports[k]]).leftCols(frames_);
    solve(rows);
  }

  [[nodiscard]] const std::shared_ptr<const bearing::ElasticSurface>& surface() const { return shapes_.surface; }

  /// Where a frame moves against the body's axes: not at all with the first, by its six amplitudes with the others.
  [[nodiscard]] MatrixXd relative(std::size_t index) const {
    MatrixXd E = MatrixXd::Zero(6, count_);
    if (index > 0) E.middleCols<6>(6 * (static_cast<Index>(index) - 1)).setIdentity();
    return E;
  }

  /// [rotation; displacement] of a point at `r` on a frame by the amplitudes, the first of those that hold at rest,
  /// body's axes, (6, amplitudes).
  [[nodiscard]] MatrixXd motion(std::size_t index, const Vector3& r) const {
    return relative(index) + carried(r) * rigid_;
  }

  /// Amplitudes for unit forces on each of them, and by a wrench at `r` on frame `index`, in the body's axes.
  [[nodiscard]] const MatrixXd& by_forces() const { return answers_; }
  [[nodiscard]] MatrixXd by_wrench(std::size_t index, const Vector3& r) const {
    return answers_ * motion(index, r).transpose();
  }

  /// Amplitudes by the forces of turning at 1 rad/s.
  [[nodiscard]] VectorXd by_spin() const {
    VectorXd s = VectorXd::Zero(count_);
    for (std::size_t i = 0; i < shapes_.at.size(); ++i)
      s += by_wrench(i, shapes_.at[i]) * shapes_.spin_on_frames.segment<6>(6 * static_cast<Index>(i));
    s.tail(count_ - frames_) += shapes_.spin;
    return s;
  }

 private:
  /// [rotation; displacement] at `r` of a rigid motion of the body's axes.
  static Matrix6 carried(const Vector3& r) {
    Matrix6 T = Matrix6::Identity();
    T.bottomLeftCorner<3, 3>() = -skew(r);
    return T;
  }

  /// The amplitudes' part of [K rows^T; rows 0]^-1; internal ones answer for themselves.
  void solve(const MatrixXd& rows) {
    answers_ = MatrixXd::Zero(count_, count_);
    answers_.bottomRightCorner(count_ - frames_, count_ - frames_) = shapes_.flexibility;
    if (frames_ == 0) return;
    const Index n = frames_, m = rows.rows();
    // Rows of lengths and angles beside forces: all of the size of the stiffness.
    const double size = shapes_.stiffness.diagonal().cwiseAbs().maxCoeff();
    MatrixXd A = MatrixXd::Zero(n + m, n + m);
    A.topLeftCorner(n, n) = shapes_.stiffness;
    A.topRightCorner(n, m) = size * rows.transpose();
    A.bottomLeftCorner(m, n) = size * rows;
    const MatrixXd inverse = A.partialPivLu().inverse().topLeftCorner(n, n);
    answers_.topLeftCorner(n, n) = 0.5 * (inverse + inverse.transpose());
  }

  StaticShapes shapes_;
  Index frames_, count_;  ///< amplitudes of frames, and all of them
  MatrixXd rigid_;        ///< motion of the body's axes by the amplitudes
  MatrixXd answers_;
};

std::shared_ptr<const bearing::SurfaceFlexibility> flexibility(const Model& model, const Bearing& bearing,
                                                               const DeformingSurface& surface, const FrameName& on) {
  const Body& body = body_called(model, on.body);
  const std::size_t own = frame_index(body, on.frame);
  const std::vector<std::size_t> supports = supporting_frames(model, bearing, body, own);
  const SupportedBody rest(static_shapes(model, body, surface, on.frame), supports);
  const bool has_frame =
      std::any_of(body.frames.begin(), body.frames.end(), [&](const Frame& frame) { return frame.name == on.frame; });
  HERSEY_REQUIRE(has_frame || on.frame.empty(), "the reader checks frames");
  const Pose X = has_frame ? body.frames[own].X_BF : Pose{};
  Matrix6 turned = Matrix6::Zero();
  turned.topLeftCorner<3, 3>() = turned.bottomRightCorner<3, 3>() = X.R;
  bearing::SurfaceFlexibility result;
  result.surface = rest.surface();
  result.by_forces = rest.by_forces();
  result.by_wrench = rest.by_wrench(own, X.r) * turned;
  result.turn = X.R.transpose() * rest.motion(own, X.r).topRows<3>();
  result.turn_in_body = X.R.transpose() * rest.relative(own).topRows<3>();
  result.offset = X.R.transpose() * (rest.relative(supports.front()) - rest.relative(own)).bottomRows<3>();
  result.by_offset_moment = rest.by_forces() * rest.relative(supports.front()).topRows<3>().transpose() * X.R;
  result.by_spin = rest.by_spin();
  result.body = body.name;
  for (const std::size_t index : supports) result.supported_at.push_back(body.frames[index].name);
  return std::make_shared<const bearing::SurfaceFlexibility>(std::move(result));
}

void add_body(const Model& model, const Bearing& bearing, const FrameName& on, Fingerprint& print) {
  const Body& body = body_called(model, on.body);
  print.add(body.name);
  add_reduction(body, surfaces_on(model, body), print);
  const std::size_t own = frame_index(body, on.frame);
  print.add(static_cast<int>(own));
  for (const std::size_t index : supporting_frames(model, bearing, body, own)) print.add(static_cast<int>(index));
}

}  // namespace

std::shared_ptr<const bearing::SteadyElasticity> steady_elasticity(const Model& model, const Bearing& bearing) {
  if (!bearing.shell_surface && !bearing.journal_surface) return nullptr;
  auto both = std::make_shared<bearing::SteadyElasticity>();
  if (bearing.shell_surface) both->shell = flexibility(model, bearing, *bearing.shell_surface, bearing.shell);
  if (bearing.journal_surface) both->journal = flexibility(model, bearing, *bearing.journal_surface, bearing.journal);
  return both;
}

std::string fingerprint_of_elasticity(const Model& model, const Bearing& bearing) {
  Fingerprint print;
  if (bearing.shell_surface) print.add("shell"), add_body(model, bearing, bearing.shell, print);
  if (bearing.journal_surface) print.add("journal"), add_body(model, bearing, bearing.journal, print);
  return print.take();
}

}  // namespace hersey::model
