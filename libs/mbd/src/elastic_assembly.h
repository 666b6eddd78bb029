#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assembly.h"
#include "hersey/mbd/elastic_body.h"
#include "hersey/mbd/mechanism_builder.h"

namespace hersey::mbd {

/// An elastic body as the tree sees it: where its frames hang, which columns move them, where its own coordinates lie.
class ElasticAssembly {
 public:
  /// @param own_q, own_v  places of the body's first own coordinate in q and v
  ElasticAssembly(const MechanismSpec::Elastic& spec, const Tree& tree, int own_q, int own_v);

  /// Adds the forces the body needs and their tangent (theory manual eq. (flexible-bodies.13)).
  void add(Assembly& assembly, const solver::State& state, const Vector3& gravity);

  /// The motion of the frames and own coordinates; `accelerate`: accelerations too, which TreeMotion must hold.
  const ElasticMotion& read(const TreeMotion& motion, const solver::State& state, const solver::Stage& stage,
                            bool accelerate);

  /// Calls visit(row, column) for each tangent entry.
  template <class Visit>
  void visit_pattern(Visit visit) const {
    for (int row : columns_)
      for (int column : columns_) visit(row, column);
  }

  [[nodiscard]] ElasticBody& body() const { return *body_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] int own_v() const { return own_v_; }
  [[nodiscard]] int own_count() const { return body_->coordinate_count(); }
  [[nodiscard]] const Attachment& frame(std::size_t i) const { return frames_[i]; }
  /// Wrench on frame i's body at the last assembly that equals what the body needs there: at the frame, in its axes.
  [[nodiscard]] Vector6 wrench(std::size_t i) const { return response_.force.segment<6>(6 * static_cast<int>(i)); }
  [[nodiscard]] ElasticResponse& response() { return response_; }

 private:
  /// Coordinates of the free joint from frame 0 at rest to another frame.
  struct Freedom {
    int q = -1;    ///< of its first translation; -1: the joint is not in the tree
    int ball = 0;  ///< of its quaternion
    bool reversed = false;
    Matrix3 R_rest;
  };
  static Freedom freedom_of(JointId joint, const Pose& rest, const Tree& tree);
  [[nodiscard]] static std::optional<Vector6> deformation(const Freedom& freedom, const Eigen::VectorXd& q);
  void fill_directions(const Assembly& assembly);
  void add_tangent(Assembly& assembly);
  void add_turning(Assembly& assembly);

  std::string name_;
  std::shared_ptr<ElasticBody> body_;
  std::vector<Attachment> frames_;
  std::vector<std::shared_ptr<const ScalarFunction>> loads_;
  std::vector<Freedom> freedoms_;         ///< of all frames but the first; empty where none are known
  std::vector<int> columns_;              ///< tree columns that move any frame, then own coordinates
  int tree_columns_ = 0;                  ///< how many of them are the tree's
  std::vector<std::vector<char>> moves_;  ///< [frame][place in columns_]
  int own_q_ = 0, own_v_ = 0;

  ElasticMotion motion_;
  ElasticResponse response_;
  std::vector<Matrix6> to_frame_;  ///< Ad(X_WF)^-1
  Eigen::MatrixXd J_, X_, V_, A_;  ///< per column: velocity, and what an increment does to position, velocity, ...
  Eigen::MatrixXd product_, block_;
};

}  // namespace hersey::mbd
