#include <algorithm>
#include <cmath>

#include "balance/flow_balance.h"

// Oil over a whole step (film.15).
namespace hersey::film {
namespace {

// Fraction of a control volume that may be left at the end of a row in which nothing can take it.
constexpr double round_off = 1e-9;

}  // namespace

double FlowBalance::start_of(int i) const { return !has_start_gap_ ? cells_[i].start : gap_start_[i]; }

void FlowBalance::subtract_squeeze_defect(Eigen::VectorXd& rhs) const {
  for (int i = 0; i < size(); ++i) {
    if (is_on_prescribed_edge(i)) continue;
    rhs[i] -= balance_weight(i) * area_[i] * content_start_[i] * (cells_[i].start - start_of(i)) / dt_;
  }
  for (const RestrictedPort& port : restricted_) {
    for (const PrescribedNode& prescribed : prescribed_) {
      const int i = prescribed.node;
      if (prescribed.feature == port.feature)
        rhs[port.node] -= area_[i] * content_start_[i] * (cells_[i].start - start_of(i)) / dt_;
    }
  }
}

void FlowBalance::settle(const Eigen::VectorXd& du, StepOilBalance& oil) const {
  Eigen::VectorXd leaving = Eigen::VectorXd::Zero(size());
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const Face& face = faces_[f];
    const FaceFlow& flow = flows_[f];
    const auto [by_a, by_b] = flow_by_u(f);
    const double q = flow.K * (nodes_[face.a].p - nodes_[face.b].p) + flow.carried(upstream(f).theta).value +
                     by_a * du[face.a] + by_b * du[face.b];
    leaving[face.a] += q;
    leaving[face.b] -= q;
  }
  initialise_oil_balance(oil);
  const bool conserves = cavitation_.has_fill();
  std::vector<char> accepts_surplus(static_cast<std::size_t>(size()), 0);
  for (int i = 0; i < size(); ++i) {
    const double start = area_[i] * content_start_[i] * (start_of(i) + cells_[i].depth_start);
    const double whole = area_[i] * oil_gap(i);
    double out = is_on_open_edge(i) ? slack(i) + slack_u(i) * du[i] : 0;
    if (is_on_leaking_edge(i)) {
      const SealFlow leaks = seal_flow(i);
      out = leaks.value + leaks.u * du[i];
    }
    // A prescribed row takes the oil that its state needs; the others keep what their flows leave.
    const bool prescribed = is_on_supply(i) || is_on_prescribed_edge(i) || !conserves;
    accepts_surplus[static_cast<std::size_t>(i)] = prescribed ? 1 : 0;
    const double end = prescribed ? nodes_[i].content * whole : start - dt_ * (leaving[i] + out);
    const double coming = (end - start) / dt_ + leaving[i];
    if (is_on_prescribed_edge(i)) out = blocks_inflow(i) ? 0 : -coming;
    if (is_on_supply(i) && is_on_open_edge(i)) out = std::max(out, -coming);  // as returns_to_edge()
    const double land = over_land(i), fed = (is_on_supply(i) ? coming + out : 0) + land;
    add_flow_over_edge(oil, i, out + land);
    oil.flow_supply += fed;
    if (const int feature = feature_at(i); feature >= 0) oil.flow_features[feature] += fed;
    oil.content[i] = end / whole;
  }
  if (conserves) redistribute_surplus(accepts_surplus, oil);
  oil.volume = 0;
  for (int i = 0; i < size(); ++i) oil.volume += area_[i] * oil_shown(i, oil.content[i]);
}

// Oil that a full control volume cannot hold, or that an empty one lacks, moves on with the flow to the next volume
// that can take it: pressure carries oil without delay. Supply lines and features accept any amount. A first sweep only
// finds what arrives at the first column, so that the result does not depend on which column is the first.
void FlowBalance::redistribute_surplus(const std::vector<char>& accepts_surplus, StepOilBalance& oil) const {
  for (int j = 0; j < model_.grid.n_z; ++j) {
    const bool closes = model_.grid.closes();
    const double arriving = closes ? sweep_surplus(j, 0, accepts_surplus, oil, false) : 0;
    const double left = sweep_surplus(j, arriving, accepts_surplus, oil, true) - arriving;
    const int last = closes || speed_phi_ < 0 ? 0 : model_.grid.n_phi - 1;
    discharge_surplus(left, model_.grid.index(last, j), accepts_surplus, oil);
  }
}

// Leaves the surplus at a node from which no flow carries it on.
void FlowBalance::discharge_surplus(double rest, int node, const std::vector<char>& accepts_surplus,
                                    StepOilBalance& oil) const {
  const double left_over = rest / (area_[node] * oil_gap(node));
  if (accepts_surplus[static_cast<std::size_t>(node)] == 0) oil.content[node] += left_over;
  if (std::abs(left_over) > round_off) oil.redistributed_overfill = 1;
}

// Sweeps once around with the flow and returns the surplus at the end [m^3]. Contents change in the final sweep only.
double FlowBalance::sweep_surplus(int j, double carry, const std::vector<char>& accepts_surplus, StepOilBalance& oil,
                                  bool is_final_sweep) const {
  const Grid& grid = model_.grid;
  const bool forwards = speed_phi_ >= 0;
  for (int step = 0; step < grid.n_phi; ++step) {
    const int line = forwards ? step : grid.n_phi - 1 - step, i = grid.index(line, j);
    if ((forwards ? grid.before(line) : grid.next(line)) < 0) {
      // At the beginning of a patch the surplus of the patch before stays in that.
      if (step > 0) discharge_surplus(carry, forwards ? i - grid.n_z : i + grid.n_z, accepts_surplus, oil);
      carry = 0;
    }
    if (accepts_surplus[static_cast<std::size_t>(i)] != 0) {
      const double flow = is_final_sweep ? carry / dt_ : 0;
      if (!is_on_supply(i)) flow_over_edge(oil, i) += flow;
      if (is_on_supply(i)) oil.flow_supply -= flow;
      if (const int feature = feature_at(i); is_on_supply(i) && feature >= 0) oil.flow_features[feature] -= flow;
      carry = 0;
      continue;
    }
    const double whole = area_[i] * oil_gap(i), full = nodes_[i].density * whole;
    const double there = oil.content[i] * whole + carry;
    const double holds = u_[i] >= 0 ? full : std::clamp(there, 0.0, full);
    carry = there - holds;
    if (!is_final_sweep) continue;
    oil.content[i] = holds / whole;
    oil.redistributed_overfill = std::max(oil.redistributed_overfill, std::abs(carry) / whole);
  }
  return carry;
}

void FlowBalance::initialise_oil_balance(StepOilBalance& oil) const {
  oil = {};
  oil.content.resize(size()), oil.gap.resize(size());
  oil.flow_features.setZero(static_cast<Eigen::Index>(model_.features.size()));
  for (int i = 0; i < size(); ++i) {
    oil.content[i] = nodes_[i].content;
    oil.gap[i] = cells_[i].gap;
    oil.volume += area_[i] * oil_shown(i, oil.content[i]);
  }
}

double FlowBalance::oil_shown(int i, double content) const {
  return std::clamp(content, 0.0, nodes_[i].density) * oil_gap(i);
}

}  // namespace hersey::film
