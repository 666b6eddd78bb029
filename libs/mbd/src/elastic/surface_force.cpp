#include "elastic/surface_force.h"

namespace hersey::mbd {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

/// Derivatives of the relative motion of the pair by the columns of the tree in A's axes, one matrix column each.
struct PairColumns {
  MatrixXd virtual_motion, position, velocity;  ///< (6, columns)
};

PairColumns columns_of(const Assembly& assembly, const Pair& pair) {
  const TreeMotion& motion = assembly.motion;
  const Matrix6 to_A = motion_transform(motion.pose(pair.a).inverse());
  const auto count = static_cast<Index>(pair.columns.size());
  PairColumns of{MatrixXd(6, count), MatrixXd(6, count), MatrixXd(6, count)};
  for (Index c = 0; c < count; ++c) {
    const SignedColumn& column = pair.columns[static_cast<std::size_t>(c)];
    const auto k = static_cast<std::size_t>(column.column);
    const Vector6& J = assembly.directions[k].J;
    const Link& link = assembly.tree.links[static_cast<std::size_t>(assembly.tree.columns[k].link)];
    // As in add_pair_force: how a column changes the relative velocity.
    const Vector6 dV =
        cross_motion(J, motion.V(pair.b.link) - motion.V(link.parent)) + assembly.stage.c * motion.J(column.column);
    of.virtual_motion.col(c) = column.sign * (to_A * motion.J(column.column));
    of.position.col(c) = column.sign * (to_A * J);
    of.velocity.col(c) = column.sign * (to_A * dV);
  }
  return of;
}

template <class RowOf, class ColumnOf>
void subtract(Assembly& assembly, const MatrixXd& block, RowOf row_of, ColumnOf column_of) {
  for (Index c = 0; c < block.cols(); ++c)
    for (Index r = 0; r < block.rows(); ++r)
      assembly.add_tangent(row_of(static_cast<std::size_t>(r)), column_of(static_cast<std::size_t>(c)), -block(r, c));
}

}  // namespace

void add_surface_tangent(Assembly& assembly, const Pair& pair, const std::vector<const ShapeColumns*>& surfaces,
                         const ForceResponse& response) {
  const PairColumns tree = columns_of(assembly, pair);
  const auto of_pair = [&](std::size_t i) { return pair.columns[i].column; };
  const MatrixXd forces_by_pair = response.dQ_dX * tree.position + response.dQ_dV * tree.velocity;
  Index row = 0;
  for (const ShapeColumns* moved : surfaces) {
    const Index rows = moved->shapes();
    const auto of_moved = [&](std::size_t i) { return moved->columns[i]; };
    subtract(assembly, moved->on_columns(forces_by_pair.middleRows(row, rows)), of_moved, of_pair);
    const MatrixXd wrench = moved->moved(response.dW_ds.middleCols(row, rows), response.dW_dr.middleCols(row, rows));
    subtract(assembly, tree.virtual_motion.transpose() * wrench, of_pair, of_moved);
    const MatrixXd forces = moved->moved(response.dQ_ds.middleCols(row, rows), response.dQ_dr.middleCols(row, rows));
    Index pushed_row = 0;
    for (const ShapeColumns* pushed : surfaces) {
      const auto of_pushed = [&](std::size_t i) { return pushed->columns[i]; };
      const Index count = pushed->shapes();
      subtract(assembly, pushed->on_columns(forces.middleRows(pushed_row, count)), of_pushed, of_moved);
      pushed_row += count;
    }
    row += rows;
  }
}

}  // namespace hersey::mbd
