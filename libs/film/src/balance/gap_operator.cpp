#include "balance/gap_operator.h"

// Kernels return packed numbers only to functions into which they are inlined.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

namespace hersey::film {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Calls act(node, next) for every face of one kind. The last nodes' next ones are the first: so they are around a
/// whole bearing, and elsewhere these flows are zero.
template <class Act>
HERSEY_KERNEL void for_each_face(Index n, Index next, const Act& act) {
  for (Index i = 0; i + next < n; ++i) act(i, i + next);
  for (Index i = n - next; i < n; ++i) act(i, i + next - n);
}

}  // namespace

void GapOperator::apply(const VectorXd& g, const VectorXd& g_rate, VectorXd& dr) {
  const Index n = g.size();
  interpolation_.bends(g, bends_);
  interpolation_.excesses(g, excesses_);
  interpolation_.excesses(g_rate, rate_excesses_);
  dr = by_.storage_gap.cwiseProduct(g) + by_.storage_excess.cwiseProduct(excesses_) +
       by_.storage_rate.cwiseProduct(g_rate) + by_.storage_excess_rate.cwiseProduct(rate_excesses_);
  const auto add_flow = [&](const FlowsBySurfaces& by, Index i, Index next, double by_bend) {
    const double q = by.gap[i] * g[i] + by.gap_next[i] * g[next] + by.excess[i] * excesses_[i] +
                     by.excess_next[i] * excesses_[next] + by_bend;
    dr[i] += by.leaves[i] * q;
    dr[next] -= by.enters[i] * q;
  };
  for_each_face(n, interpolation_.line_size(),
                [&](Index i, Index next) { add_flow(by_.around, i, next, by_.around.bend[i] * bends_[i]); });
  for_each_face(n, 1, [&](Index i, Index next) { add_flow(by_.axial, i, next, 0); });
  for (const LeakByGap& leak : by_.leaks) dr[leak.node] += leak.by_gap * g[leak.node];
  for (const RowByGap& row : by_.prescribed) {
    double& at = dr[row.node];
    at = row.weight * at + row.by_node * g[row.node];
    if (row.other >= 0)
      at += row.by_other * g[row.other] + row.by_bend * bends_[row.face] + row.by_excess * excesses_[row.upstream] +
            row.by_rate * g_rate[row.node];
  }
  for (const int node : prescribed_edges_) dr[node] = 0;
}

/// The same steps backwards.
class GapOperator::Transposed {
 public:
  Transposed(const GapOperator& op, const PackedColumns& x, PackedColumns& by_gap, PackedColumns& by_rate,
             Scratch& scratch)
      : op_(op), n_(x.rows()) {
    scratch.row = x;
    for (PackedColumns* columns : {&scratch.excess, &scratch.bend, &by_gap, &by_rate})
      columns->setZero(n_, Packed::width);
    scratch.rate_excess.resize(n_, Packed::width);
    row_ = scratch.row.data(), excess_ = scratch.excess.data(), bend_ = scratch.bend.data();
    rate_excess_ = scratch.rate_excess.data(), gap_ = by_gap.data(), rate_ = by_rate.data();
  }

  HERSEY_FUSED void find_fused() { find(); }
  void find_plain() { find(); }

 private:
  HERSEY_KERNEL void find() {
    const BySurfaces& by = op_.by_;
    for (const int node : op_.prescribed_edges_) put(0.0, row_, node);
    for (const RowByGap& of : by.prescribed) add_prescribed(of);
    add_storage();
    for_each_face(n_, op_.interpolation_.line_size(), [&](Index i, Index next) HERSEY_INLINED {
      add(by.around.bend[i] * along_face(by.around, i, next), bend_, i);
    });
    for_each_face(n_, 1, [&](Index i, Index next) HERSEY_INLINED { (void)along_face(by.axial, i, next); });
    for (const LeakByGap& leak : by.leaks) add(leak.by_gap * get(row_, leak.node), gap_, leak.node);
    op_.interpolation_.add_transposed_bends(bend_, gap_);
    op_.interpolation_.add_transposed_excesses(excess_, gap_);
    op_.interpolation_.add_transposed_excesses(rate_excess_, rate_);
  }

  HERSEY_KERNEL void add_prescribed(const RowByGap& of) {
    const Packed x = get(row_, of.node);
    add(of.by_node * x, gap_, of.node);
    put(of.weight * x, row_, of.node);
    if (of.other < 0) return;
    add(of.by_other * x, gap_, of.other);
    add(of.by_bend * x, bend_, of.face);
    add(of.by_excess * x, excess_, of.upstream);
    add(of.by_rate * x, rate_, of.node);
  }

  HERSEY_KERNEL void add_storage() {
    const BySurfaces& by = op_.by_;
    for (Index i = 0; i < n_; ++i) {
      const Packed x = get(row_, i);
      add(by.storage_gap[i] * x, gap_, i);
      add(by.storage_excess[i] * x, excess_, i);
      add(by.storage_rate[i] * x, rate_, i);
      put(by.storage_excess_rate[i] * x, rate_excess_, i);
    }
  }

  /// Returns what a unit of the flow over a face changes.
  HERSEY_KERNEL Packed along_face(const FlowsBySurfaces& by, Index i, Index next) {
    const Packed flow = by.leaves[i] * get(row_, i) - by.enters[i] * get(row_, next);
    add(by.gap[i] * flow, gap_, i);
    add(by.gap_next[i] * flow, gap_, next);
    add(by.excess[i] * flow, excess_, i);
    add(by.excess_next[i] * flow, excess_, next);
    return flow;
  }

  HERSEY_KERNEL static Packed get(const double* from, Index node) { return Packed::load(from + node * Packed::width); }
  HERSEY_KERNEL static void put(const Packed& numbers, double* to, Index node) {
    numbers.store(to + node * Packed::width);
  }
  HERSEY_KERNEL static void add(const Packed& numbers, double* to, Index node) {
    put(get(to, node) + numbers, to, node);
  }

  const GapOperator& op_;
  Index n_;
  double *row_, *excess_, *bend_, *rate_excess_, *gap_, *rate_;  ///< a pack a node
};

void GapOperator::apply_transposed(const PackedColumns& x, PackedColumns& by_gap, PackedColumns& by_rate,
                                   Scratch& scratch) const {
  Transposed transposed(*this, x, by_gap, by_rate, scratch);
  has_fused_instructions() ? transposed.find_fused() : transposed.find_plain();
}

}  // namespace hersey::film

#pragma GCC diagnostic pop
