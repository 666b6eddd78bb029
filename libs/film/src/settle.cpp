#include <algorithm>

#include "flow_balance.h"

// Oil over a whole step (film.59).
namespace hersey::film {

double FlowBalance::start_of(int i) const { return gap_start_.size() == 0 ? cells_[i].start : gap_start_[i]; }

void FlowBalance::subtract_defect(Eigen::VectorXd& rhs) const {
  for (int i = 0; i < size(); ++i) {
    if (edge_row(i % model_.grid.n_z)) continue;
    rhs[i] -= balance_share(i) * area_[i] * content_start_[i] * (cells_[i].start - start_of(i)) / dt_;
  }
}

void FlowBalance::settle(const Eigen::VectorXd& du, OilOfStep& oil) const {
  const Grid& grid = model_.grid;
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
  take_stock(oil);
  const bool conserves = model_.cavitation == Cavitation::mass_conserving;
  oil.volume = 0;
  for (int i = 0; i < size(); ++i) {
    const int j = i % grid.n_z;
    const double start = area_[i] * content_start_[i] * (start_of(i) + cells_[i].depth_start);
    const double whole = area_[i] * oil_gap(i);
    double out = open_row(j) ? slack(i) + slack_u(i) * du[i] : 0;
    // Held rows take what their state needs; the others have what is left to them.
    const bool given = is_held(i) || edge_row(j) || !conserves;
    const double end = given ? nodes_[i].content * whole : start - dt_ * (leaving[i] + out);
    const double coming = (end - start) / dt_ + leaving[i];
    if (edge_row(j)) out = lets_nothing_in(i) ? 0 : -coming;
    (j == 0 ? oil.flow_left : oil.flow_right) += out;
    if (is_held(i)) oil.flow_supply += coming + out;
    if (const int feature = feature_at(i); feature >= 0) oil.flow_features[feature] += coming + out;
    oil.content[i] = end / whole;
    oil.volume += area_[i] * oil_shown(i, oil.content[i]);
  }
}

void FlowBalance::take_stock(OilOfStep& oil) const {
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
