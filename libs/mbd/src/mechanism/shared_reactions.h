#pragma once

#include <array>
#include <vector>

#include "hersey/solver/sparse_lu.h"
#include "tree/tree_motion.h"

namespace hersey::mbd {

/// Shares the reactions of redundantly joined bodies among their joints: of all reactions that keep every body in the
/// balance, the one with the smallest sum of squares, torques counted per `tree.length` (theory manual eq.
/// (mechanisms.18)).
///
/// Joints are shared together with all that bodies other than ground connect to them; the others have one set of
/// reactions only. What depends on the topology is found once.
/// @cost O(bodies) per call in chains and ladders of loops
/// @verified_by redundancy_test.cpp: TwoHinges_ShareTheDoorsWeight, ReactionsOfALadder_AreTheSmallest
class SharedReactions {
 public:
  /// @param redundant  joints with constraints left out as redundant
  SharedReactions(const MechanismSpec& spec, const Tree& tree, const std::vector<int>& redundant);

  /// @param wrenches  per joint, of the inboard on the outboard body, at ground's origin and in ground's axes; one
  ///                  possible set on entry, the one of smallest norm on return
  void share(const MechanismSpec& spec, const Tree& tree, const TreeMotion& motion, std::vector<Vector6>& wrenches);

  /// Returns the number of joints among which reactions are shared.
  [[nodiscard]] std::size_t size() const { return joints_.size(); }

 private:
  /// Joint of the loops, and the indices of its bodies among the equations; -1: ground.
  struct Joint {
    int index = 0, inboard = -1, outboard = -1;
    std::array<int, 4> blocks{-1, -1, -1, -1};  ///< in `starts_`: (in, in), (out, out), (in, out), (out, in)
    Matrix6 P;                        ///< onto what it can transmit, [tau / length; f] about its inboard frame
    Matrix6 to_inboard, to_outboard;  ///< from there to the bodies' origins
  };

  void lay_out_blocks();
  void update_geometry(const MechanismSpec& spec, const Tree& tree, const TreeMotion& motion);
  void add_block(const Joint& joint, int block, const Matrix6& value);
  [[nodiscard]] bool factorise();
  /// Returns the resultants on the bodies of the joints' wrenches W (scaled, about their inboard frames).
  [[nodiscard]] Eigen::VectorXd sum(const std::vector<Vector6>& W) const;
  /// Returns the wrenches A^T y.
  [[nodiscard]] Vector6 spread(const Joint& joint, const Eigen::VectorXd& y) const;

  std::vector<Joint> joints_;
  std::vector<int> bodies_;  ///< ids' indices, one block row each
  Eigen::SparseMatrix<double> normal_;
  std::vector<std::array<int, 6>> starts_;  ///< per block: where each of its columns begins among normal_'s values
  solver::SparseLu lu_;
};

}  // namespace hersey::mbd
