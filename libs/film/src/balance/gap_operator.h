#pragma once

#include <Eigen/Dense>
#include <vector>

#include "balance/by_surfaces.h"
#include "gap/gap_interpolation.h"
#include "hersey/core/packed.h"

namespace hersey::film {

/// Columns of numbers at the nodes, or at whatever a row is, as many as are packed: those of a row follow one another.
using PackedColumns = Eigen::Matrix<double, Eigen::Dynamic, Packed::width, Eigen::RowMajor>;

/// How the residual of a film changes with the gap at the nodes and with the gap's rate at one state: two sparse
/// matrices dr/dg and dr/dg_rate, kept by what they are made of (film.39). Outputs by many changes of the gap need
/// their transposes only.
class GapOperator {
 public:
  /// @param prescribed_edges  nodes whose rows prescribe u
  GapOperator(const GapInterpolation& interpolation, const std::vector<int>& prescribed_edges)
      : interpolation_(interpolation), prescribed_edges_(prescribed_edges) {}

  /// Takes the derivatives at a state, those of prescribed rows and of leaks among them.
  void take(const BySurfaces& by) { by_ = by; }

  /// What apply_transposed() works in: a thread has its own.
  struct Scratch {
    PackedColumns row, excess, rate_excess, bend;
  };

  /// dr = dr/dg g + dr/dg_rate g_rate.
  void apply(const Eigen::VectorXd& g, const Eigen::VectorXd& g_rate, Eigen::VectorXd& dr);
  /// by_gap = (dr/dg)^T x and by_rate = (dr/dg_rate)^T x.
  void apply_transposed(const PackedColumns& x, PackedColumns& by_gap, PackedColumns& by_rate, Scratch& scratch) const;

 private:
  class Transposed;

  const GapInterpolation& interpolation_;
  const std::vector<int>& prescribed_edges_;
  BySurfaces by_;
  Eigen::VectorXd bends_, excesses_, rate_excesses_;
};

}  // namespace hersey::film
