#include "elastic/elastic_assembly.h"

#include <algorithm>

namespace hersey::mbd {

using Eigen::Index;

ElasticAssembly::ElasticAssembly(const MechanismSpec::Elastic& spec, const Tree& tree, int own_q, int own_v)
    : name_(spec.name), body_(spec.body), loads_(spec.loads), own_q_(own_q), own_v_(own_v) {
  std::vector<char> moves_any(tree.columns.size(), 0);
  for (const FrameId id : spec.frames) {
    frames_.push_back(tree.frames[static_cast<std::size_t>(id.index)]);
    for (int k : tree.path[static_cast<std::size_t>(frames_.back().link)]) moves_any[static_cast<std::size_t>(k)] = 1;
  }
  for (std::size_t i = 0; i < spec.freedoms.size(); ++i)
    freedoms_.push_back(freedom_of(spec.freedoms[i], body_->rest_pose(static_cast<int>(i) + 1), tree));
  for (std::size_t k = 0; k < moves_any.size(); ++k)
    if (moves_any[k] != 0) columns_.push_back(static_cast<int>(k));
  tree_columns_ = static_cast<int>(columns_.size());
  for (const Attachment& frame : frames_) {
    moves_.emplace_back();
    for (int k : columns_) moves_.back().push_back(tree.moves(k, frame.link) ? 1 : 0);
  }
  const int own = own_count();
  for (int i = 0; i < own; ++i) columns_.push_back(own_v + i);
  const Index outer = 6 * static_cast<Index>(frames_.size()), rows = outer + own;
  J_ = X_ = V_ = A_ = Eigen::MatrixXd::Zero(outer, tree_columns_);
  block_.resize(static_cast<Index>(columns_.size()), static_cast<Index>(columns_.size()));
  to_frame_.resize(frames_.size());
  motion_.frames.resize(frames_.size());
  motion_.loads = Eigen::VectorXd::Zero(static_cast<Index>(loads_.size()));
  shape_columns_.columns = columns_;
  response_.K = response_.C = response_.M = Eigen::MatrixXd::Zero(rows, rows);
  response_.force = response_.magnitude = Eigen::VectorXd::Zero(rows);
}

ElasticAssembly::Freedom ElasticAssembly::freedom_of(JointId joint, const Pose& rest, const Tree& tree) {
  const JointIndices& indices = tree.joints[static_cast<std::size_t>(joint.index)];
  if (indices.closure >= 0) return {};
  const auto q_of = [&](std::size_t value) {
    return tree.links[static_cast<std::size_t>(indices.values[value].link)].first_q;
  };
  // Reversed, the chain runs ball, z, y, x.
  return {std::min(q_of(0), q_of(2)), q_of(3), indices.reversed, rest.R};
}

/// A small coordinate has its full relative precision; a difference of poses has only the absolute precision of the
/// body's size.
std::optional<Vector6> ElasticAssembly::deformation(const Freedom& freedom, const Eigen::VectorXd& q) {
  if (freedom.q < 0) return std::nullopt;
  const Vector3 xyz = q.segment<3>(freedom.q), axis = q.segment<3>(freedom.ball + 1);
  const double sine = 2 * q[freedom.ball] * (freedom.reversed ? -1 : 1);
  Vector6 moved;
  moved << freedom.R_rest * (sine * axis), freedom.R_rest * (freedom.reversed ? Vector3(xyz.reverse()) : xyz);
  return moved;
}

const ElasticMotion& ElasticAssembly::read(const TreeMotion& motion, const solver::State& state,
                                           const solver::Stage& stage, bool accelerate) {
  motion_.t = state.t;
  motion_.stage = {
      .dt = stage.dt, .k = stage.k, .c = stage.c, .m = stage.m, .parameters = stage.parameters, .fresh = stage.fresh};
  for (std::size_t f = 0; f < frames_.size(); ++f) {
    ElasticFrame& frame = motion_.frames[f];
    frame.X_WF = motion.pose(frames_[f]);
    to_frame_[f] = motion_transform(frame.X_WF.inverse());
    frame.V = to_frame_[f] * motion.V(frames_[f].link);
    if (f > 0 && !freedoms_.empty()) frame.deformation = deformation(freedoms_[f - 1], state.q);
    if (accelerate) frame.A = to_frame_[f] * motion.A(frames_[f].link);
  }
  for (std::size_t i = 0; i < loads_.size(); ++i)
    motion_.loads[static_cast<Index>(i)] = loads_[i]->value({&state.t, 1});
  motion_.eta = state.q.segment(own_q_, own_count());
  motion_.eta_rate = state.v.segment(own_v_, own_count());
  motion_.eta_acceleration = state.vdot.segment(own_v_, own_count());
  motion_.shape_forces.resize(0);
  return motion_;
}

/// Columns in the frames' axes: dX = Ad^-1 J', dV = Ad^-1 H, dA = Ad^-1 (E + H x V).
void ElasticAssembly::fill_directions(const Assembly& assembly) {
  for (std::size_t f = 0; f < frames_.size(); ++f) {
    const Index row = 6 * static_cast<Index>(f);
    const Vector6& V = assembly.motion.V(frames_[f].link);
    for (int c = 0; c < tree_columns_; ++c) {
      if (moves_[f][static_cast<std::size_t>(c)] == 0) continue;
      const Direction& d = assembly.directions[static_cast<std::size_t>(columns_[static_cast<std::size_t>(c)])];
      X_.block<6, 1>(row, c) = to_frame_[f] * d.J;
      V_.block<6, 1>(row, c) = to_frame_[f] * d.H;
      A_.block<6, 1>(row, c) = to_frame_[f] * (d.E + cross_motion(d.H, V));
    }
  }
}

void ElasticAssembly::prepare(const Assembly& assembly, const solver::State& state) {
  read(assembly.motion, state, assembly.stage, true);
  for (std::size_t f = 0; f < frames_.size(); ++f)
    for (int c = 0; c < tree_columns_; ++c)
      if (moves_[f][static_cast<std::size_t>(c)] != 0)
        J_.block<6, 1>(6 * static_cast<Index>(f), c) =
            to_frame_[f] * assembly.motion.J(columns_[static_cast<std::size_t>(c)]);
  if (assembly.tangent != nullptr) fill_directions(assembly);
}

void ElasticAssembly::prepare_again(const Assembly& assembly, const solver::State& state) {
  const Eigen::VectorXd forces = motion_.shape_forces;
  prepare(assembly, state);
  motion_.shape_forces = forces;
}

void ElasticAssembly::find_shapes(const Assembly& assembly) {
  const bool want_tangent = assembly.tangent != nullptr;
  body_->find_shapes(motion_, want_tangent, shapes_);
  if (!want_tangent) return;
  shape_columns_.virtual_value.noalias() = shapes_.by_frames * J_;
  shape_columns_.value.noalias() = shapes_.by_frames * X_;
  shape_columns_.rate.noalias() = shapes_.by_frames * V_;
  shape_columns_.rate.noalias() += shapes_.rate_by_frames * X_;
  shape_columns_.own_value = assembly.stage.k;
  shape_columns_.own_rate = assembly.stage.c;
}

void ElasticAssembly::find_shapes() { body_->find_shapes(motion_, false, shapes_); }

void ElasticAssembly::add_shape_forces(const Eigen::Ref<const Eigen::VectorXd>& Q) {
  if (motion_.shape_forces.size() == 0) {
    motion_.shape_forces = motion_.shape_force_sizes = Eigen::VectorXd::Zero(Q.size());
  }
  motion_.shape_forces += Q;
  motion_.shape_force_sizes += Q.cwiseAbs();
}

void ElasticAssembly::add(Assembly& assembly, const Vector3& gravity) {
  body_->evaluate(motion_, assembly.tangent != nullptr, response_);
  // In free fall inertia and weight cancel, so the weight counts by itself.
  response_.magnitude.segment<3>(3).array() += body_->mass() * gravity.norm();
  const Index outer = J_.rows();
  for (Index c = 0; c < J_.cols(); ++c)
    assembly.add_residual(columns_[static_cast<std::size_t>(c)], J_.col(c).dot(response_.force.head(outer)),
                          J_.col(c).cwiseAbs().dot(response_.magnitude.head(outer)));
  for (int i = 0; i < own_count(); ++i)
    assembly.add_residual(own_v_ + i, response_.force[outer + i], response_.magnitude[outer + i]);
  if (assembly.tangent == nullptr) return;
  add_tangent(assembly);
  add_rotation(assembly);
}

/// The tree's columns move frames alone, an increment of an own coordinate that alone.
void ElasticAssembly::add_tangent(Assembly& assembly) {
  const Index outer = J_.rows(), own = own_count(), tree = tree_columns_;
  const solver::Stage& stage = assembly.stage;
  product_.noalias() = response_.K.leftCols(outer) * X_;
  product_.noalias() += response_.C.leftCols(outer) * V_;
  product_.noalias() += response_.M.leftCols(outer) * A_;
  by_own_ = stage.k * response_.K.rightCols(own) + stage.c * response_.C.rightCols(own) +
            stage.m * response_.M.rightCols(own);
  block_.topLeftCorner(tree, tree).noalias() = J_.transpose() * product_.topRows(outer);
  block_.bottomLeftCorner(own, tree) = product_.bottomRows(own);
  block_.topRightCorner(tree, own).noalias() = J_.transpose() * by_own_.topRows(outer);
  block_.bottomRightCorner(own, own) = by_own_.bottomRows(own);
  for (Index c = 0; c < block_.cols(); ++c)
    for (Index r = 0; r < block_.rows(); ++r)
      assembly.add_tangent(columns_[static_cast<std::size_t>(r)], columns_[static_cast<std::size_t>(c)], block_(r, c));
}

/// Adds the change of the wrench as it rotates with its frame. Columns beyond the moving joint rotate with it, so that
/// only the columns inboard of it contribute.
void ElasticAssembly::add_rotation(Assembly& assembly) {
  for (std::size_t f = 0; f < frames_.size(); ++f) {
    const Vector6 W = to_frame_[f].transpose() * wrench(f);
    for (int c = 0; c < tree_columns_; ++c) {
      if (moves_[f][static_cast<std::size_t>(c)] == 0) continue;
      const int column = columns_[static_cast<std::size_t>(c)];
      const Vector6 dW = cross_force(assembly.directions[static_cast<std::size_t>(column)].J, W);
      for (int r = 0; r < tree_columns_; ++r) {
        const int row = columns_[static_cast<std::size_t>(r)];
        const int link = assembly.tree.columns[static_cast<std::size_t>(row)].link;
        if (moves_[f][static_cast<std::size_t>(r)] == 0 || assembly.tree.moves(column, link)) continue;
        assembly.add_tangent(row, column, assembly.motion.J(row).dot(dW));
      }
    }
  }
}

}  // namespace hersey::mbd
