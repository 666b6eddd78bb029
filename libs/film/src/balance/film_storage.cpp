#include <algorithm>

#include "balance/flow_balance.h"

// Oil in the control volumes and its rate of change (film.12, film.44, film.14).
namespace hersey::film {
namespace {

// Smallest fraction of a node's gap that interpolation leaves to its control volume: surfaces that bend from node to
// node do not cross between them.
constexpr double least_fraction = 0.25;

// Smallest fraction of the initial gap from which a step starts whose gap opens faster than its rate.
constexpr double least_start = 0.5;

}  // namespace

void FlowBalance::evaluate_cell(int i, const SurfaceMotion& motion) {
  Cell& cell = cells_[i];
  cell = {};
  const double mean = rough_[i].mean, mean_h = rough_[i].mean_h;
  const bool limited = excesses_[i] < (least_fraction - 1) * mean;
  cell.gap = limited ? least_fraction * mean : mean + excesses_[i];
  cell.gap_h = limited ? least_fraction * mean_h : mean_h;
  cell.gap_excess = limited ? 0 : 1;
  if (relief_.has_pockets()) {
    cell.depth = relief_.depth()[i];
    cell.depth_start = relief_.depth_start()[i];
    cell.turning = relief_.turning_depth()[i];
  }
  if (dt_ == 0) return;
  if (uses_gap_difference_) {
    cell.start = gap_start_[i], cell.start_slope = cell.start_excess = 0;
    return;
  }
  const double h = motion.g[i] - dt_ * motion.g_rate[i] + w_start_[i];
  const ValueAndSlope from = rough_law_.mean(h, motion.roughness_at(i));
  cell.start = from.value + excesses_[i] - dt_ * rate_excesses_[i];
  cell.start_slope = from.slope;
  const double least = !has_start_gap_ ? 0 : least_start * gap_start_[i];
  if (cell.start < least) cell.start = least, cell.start_slope = cell.start_excess = 0;
}

double FlowBalance::storage(int i) const {
  const Cell& cell = cells_[i];
  if (dt_ == 0) return nodes_[i].content * storage_by_content(i);
  return area_[i] *
         (nodes_[i].content * (cell.gap + cell.depth) - content_start_[i] * (cell.start + cell.depth_start)) / dt_;
}

double FlowBalance::pocket_rate(int i) const {
  return relief_.has_pockets() ? relief_.depth_by_journal()[i] * speeds_.u_journal / model_.R : 0;
}

double FlowBalance::storage_by_content(int i) const {
  if (dt_ > 0) return area_[i] * oil_gap(i) / dt_;
  return area_[i] * ((g_rate_[i] + rate_excesses_[i]) * rough_[i].mean_h + pocket_rate(i));
}

double FlowBalance::storage_u(int i) const {
  const Node& node = nodes_[i];
  return node.content_u * storage_by_content(i) + storage_h(i) * node.h_u;
}

// Derivative by the film thickness at a given content; a liner at rest changes the gap of the start, too.
double FlowBalance::storage_h(int i) const {
  const Cell& cell = cells_[i];
  if (dt_ > 0) {
    return area_[i] *
           (nodes_[i].content * cell.gap_h - (freezes_deformation_ ? content_start_[i] * cell.start_slope : 0)) / dt_;
  }
  return area_[i] * nodes_[i].content * (g_rate_[i] + rate_excesses_[i]) * rough_[i].mean_hh;
}

double FlowBalance::storage_g(int i) const {
  const double now = storage_h(i) * nodes_[i].h_g;
  return dt_ == 0 || freezes_deformation_ ? now : now - area_[i] * content_start_[i] * cells_[i].start_slope / dt_;
}

double FlowBalance::storage_excess(int i) const {
  if (dt_ == 0) return 0;
  const Cell& cell = cells_[i];
  return area_[i] * (nodes_[i].content * cell.gap_excess - content_start_[i] * cell.start_excess) / dt_;
}

double FlowBalance::storage_g_rate(int i) const {
  if (dt_ > 0) return area_[i] * content_start_[i] * cells_[i].start_slope;
  return area_[i] * nodes_[i].content * rough_[i].mean_h;
}

double FlowBalance::storage_excess_rate(int i) const {
  return dt_ > 0 ? area_[i] * content_start_[i] * cells_[i].start_excess : storage_g_rate(i);
}

// Adds the change of storage by rotating pockets of the journal.
void FlowBalance::add_turning_pockets(const MotionDirection& direction, Eigen::VectorXd& dr) const {
  const double rotation_rate = dt_ > 0 ? direction.phi_journal / dt_ : direction.u_journal / model_.R;
  if (rotation_rate == 0) return;
  for (int i = 0; i < size(); ++i)
    dr[i] += area_[i] * nodes_[i].content * relief_.depth_by_journal()[i] * rotation_rate;
}

}  // namespace hersey::film
