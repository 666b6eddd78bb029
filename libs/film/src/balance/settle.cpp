#include <algorithm>
#include <cmath>

#include "balance/flow_balance.h"

// Oil over a whole step (film.15).
namespace hersey::film {
namespace {

// Share of a control volume that may be left at the end of a row in which nothing can take it.
constexpr double round_off = 1e-9;

}  // namespace

double FlowBalance::start_of(int i) const { return !knows_gap_ ? cells_[i].start : gap_start_[i]; }

void FlowBalance::subtract_defect(Eigen::VectorXd& rhs) const {
  for (int i = 0; i < size(); ++i) {
    if (is_given(i)) continue;
    rhs[i] -= balance_share(i) * area_[i] * content_start_[i] * (cells_[i].start - start_of(i)) / dt_;
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
  std::vector<char> takes_what_comes(static_cast<std::size_t>(size()), 0);
  for (int i = 0; i < size(); ++i) {
    const double start = area_[i] * content_start_[i] * (start_of(i) + cells_[i].depth_start);
    const double whole = area_[i] * oil_gap(i);
    double out = is_open(i) ? slack(i) + slack_u(i) * du[i] : 0;
    // Held rows take what their state needs; the others have what is left to them.
    const bool given = is_prescribed(i) || is_given(i) || !conserves;
    takes_what_comes[static_cast<std::size_t>(i)] = given ? 1 : 0;
    const double end = given ? nodes_[i].content * whole : start - dt_ * (leaving[i] + out);
    const double coming = (end - start) / dt_ + leaving[i];
    if (is_given(i)) out = blocks_inflow(i) ? 0 : -coming;
    const double land = over_land(i), fed = (is_prescribed(i) ? coming + out : 0) + land;
    add_flow_over_edge(oil, i, out + land);
    oil.flow_supply += fed;
    if (const int feature = feature_at(i); feature >= 0) oil.flow_features[feature] += fed;
    oil.content[i] = end / whole;
  }
  if (conserves) pass_on(takes_what_comes, oil);
  oil.volume = 0;
  for (int i = 0; i < size(); ++i) oil.volume += area_[i] * oil_shown(i, oil.content[i]);
}

// What a full control volume cannot hold, and what an empty one has not, goes on with the flow to the next that can: a
// film in which pressure carries oil knows no delay. Lines and features take what comes. A first round only finds what
// arrives where the rows begin, so that no place around the bearing is the first.
void FlowBalance::pass_on(const std::vector<char>& takes_what_comes, StepOilBalance& oil) const {
  for (int j = 0; j < model_.grid.n_z; ++j) {
    const bool closes = model_.grid.closes();
    const double arriving = closes ? pass_along(j, 0, takes_what_comes, oil, false) : 0;
    const double left = pass_along(j, arriving, takes_what_comes, oil, true) - arriving;
    const int last = closes || speed_phi_ < 0 ? 0 : model_.grid.n_phi - 1;
    leave(left, model_.grid.index(last, j), takes_what_comes, oil);
  }
}

// At a node from where no flow carries it on.
void FlowBalance::leave(double rest, int node, const std::vector<char>& takes_what_comes, StepOilBalance& oil) const {
  const double homeless = rest / (area_[node] * oil_gap(node));
  if (takes_what_comes[static_cast<std::size_t>(node)] == 0) oil.content[node] += homeless;
  if (std::abs(homeless) > round_off) oil.redistributed_overfill = 1;
}

// Once around with the flow; what is carried on at the end [m^3]. It is handed out where it is meant `for_good`.
double FlowBalance::pass_along(int j, double carry, const std::vector<char>& takes_what_comes, StepOilBalance& oil,
                               bool for_good) const {
  const Grid& grid = model_.grid;
  const bool forwards = speed_phi_ >= 0;
  for (int step = 0; step < grid.n_phi; ++step) {
    const int line = forwards ? step : grid.n_phi - 1 - step, i = grid.index(line, j);
    if ((forwards ? grid.before(line) : grid.next(line)) < 0) {
      // A patch begins: what another one before it had left stays there.
      if (step > 0) leave(carry, forwards ? i - grid.n_z : i + grid.n_z, takes_what_comes, oil);
      carry = 0;
    }
    if (takes_what_comes[static_cast<std::size_t>(i)] != 0) {
      const double flow = for_good ? carry / dt_ : 0;
      if (!is_prescribed(i)) flow_over_edge(oil, i) += flow;
      if (is_prescribed(i)) oil.flow_supply -= flow;
      if (const int feature = feature_at(i); is_prescribed(i) && feature >= 0) oil.flow_features[feature] -= flow;
      carry = 0;
      continue;
    }
    const double whole = area_[i] * oil_gap(i), full = nodes_[i].density * whole;
    const double there = oil.content[i] * whole + carry;
    const double holds = u_[i] >= 0 ? full : std::clamp(there, 0.0, full);
    carry = there - holds;
    if (!for_good) continue;
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
