#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hersey/mbd/elastic_body.h"
#include "hersey/mbd/mechanism_spec.h"
#include "tree/assembly.h"

namespace hersey::mbd {

/// Derivatives of the amplitudes of a body's shapes by the columns of the tree and by the body's own coordinates:
/// virtually, and by one Newton increment (theory manual eq. (flexible-bodies.26)). The last amplitudes are the own
/// coordinates; the others move with the tree's columns alone.
struct ShapeColumns {
  std::vector<int> columns;                    ///< columns of the tree, then those of the own coordinates
  Eigen::MatrixXd virtual_value, value, rate;  ///< shape (shapes less own coordinates, columns of the tree)
  double own_value = 0, own_rate = 0;          ///< by which an increment of an own coordinate moves it

  [[nodiscard]] Eigen::Index shapes() const {
    return value.rows() + static_cast<Eigen::Index>(columns.size()) - value.cols();
  }

  /// by_value d value + by_rate d rate per column, both of shape (rows, shapes).
  [[nodiscard]] Eigen::MatrixXd moved(const Eigen::Ref<const Eigen::MatrixXd>& by_value,
                                      const Eigen::Ref<const Eigen::MatrixXd>& by_rate) const {
    const Eigen::Index inner = value.rows(), own = shapes() - inner;
    Eigen::MatrixXd change(by_value.rows(), value.cols() + own);
    change.leftCols(value.cols()).noalias() = by_value.leftCols(inner) * value;
    change.leftCols(value.cols()).noalias() += by_rate.leftCols(inner) * rate;
    change.rightCols(own) = own_value * by_value.rightCols(own) + own_rate * by_rate.rightCols(own);
    return change;
  }

  /// Returns the generalised forces on each column by forces on the shapes, for `forces` of shape (shapes, any).
  [[nodiscard]] Eigen::MatrixXd on_columns(const Eigen::Ref<const Eigen::MatrixXd>& forces) const {
    const Eigen::Index inner = value.rows(), own = shapes() - inner;
    Eigen::MatrixXd generalised(value.cols() + own, forces.cols());
    generalised.topRows(value.cols()).noalias() = virtual_value.transpose() * forces.topRows(inner);
    generalised.bottomRows(own) = forces.bottomRows(own);
    return generalised;
  }
};

/// Connection of an elastic body to the tree: the links of its frames, the columns that move them, the indices of its
/// own coordinates.
class ElasticAssembly {
 public:
  /// @param own_q, own_v  indices of the body's first own coordinate in q and v
  ElasticAssembly(const MechanismSpec::Elastic& spec, const Tree& tree, int own_q, int own_v);

  /// Reads the motion of the assembly's state and clears the forces on the body's shapes. Must be called before `add`.
  void prepare(const Assembly& assembly, const solver::State& state);
  /// Reads a motion of other velocities at the same positions; forces on the body's shapes are kept.
  void prepare_again(const Assembly& assembly, const solver::State& state);

  /// Adds the forces the body needs and their tangent (theory manual eq. (flexible-bodies.13)).
  void add(Assembly& assembly, const Vector3& gravity);

  /// Computes the amplitudes and their derivatives by the columns for forces that depend on the deformation; see
  /// ShapeColumns.
  void find_shapes(const Assembly& assembly);
  /// Computes the amplitudes at the motion last read, for observation.
  void find_shapes();
  [[nodiscard]] const ShapeMotion& shapes() const { return shapes_; }
  [[nodiscard]] const ShapeColumns& shape_columns() const { return shape_columns_; }
  void add_shape_forces(const Eigen::Ref<const Eigen::VectorXd>& Q);

  /// Reads the motion of the frames and own coordinates; with `accelerate` also accelerations, which TreeMotion must
  /// have computed.
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
  [[nodiscard]] const ElasticMotion& motion() const { return motion_; }  ///< last read
  [[nodiscard]] ElasticResponse& response() { return response_; }

 private:
  /// Coordinates of the free joint from frame 0 at rest to another frame.
  struct Freedom {
    int q = -1;    ///< index of its first translation; -1: the joint is not in the tree
    int ball = 0;  ///< index of its quaternion
    bool reversed = false;
    Matrix3 R_rest;
  };
  static Freedom freedom_of(JointId joint, const Pose& rest, const Tree& tree);
  [[nodiscard]] static std::optional<Vector6> deformation(const Freedom& freedom, const Eigen::VectorXd& q);
  void fill_directions(const Assembly& assembly);
  void add_tangent(Assembly& assembly);
  void add_rotation(Assembly& assembly);

  std::string name_;
  std::shared_ptr<ElasticBody> body_;
  std::vector<Attachment> frames_;
  std::vector<std::shared_ptr<const ScalarFunction>> loads_;
  std::vector<Freedom> freedoms_;         ///< of all frames but the first; empty where none are known
  std::vector<int> columns_;              ///< tree columns that move any frame, then own coordinates
  int tree_columns_ = 0;                  ///< number of columns of the tree among them
  std::vector<std::vector<char>> moves_;  ///< [frame][index in columns_]
  int own_q_ = 0, own_v_ = 0;

  ElasticMotion motion_;
  ElasticResponse response_;
  ShapeMotion shapes_;
  ShapeColumns shape_columns_;
  std::vector<Matrix6> to_frame_;  ///< Ad(X_WF)^-1
  /// Derivatives of the frames per column of the tree: velocity, and the change of position, velocity, ... by an
  /// increment.
  Eigen::MatrixXd J_, X_, V_, A_;
  Eigen::MatrixXd product_, by_own_, block_;
};

}  // namespace hersey::mbd
