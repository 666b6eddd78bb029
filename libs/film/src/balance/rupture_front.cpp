#include <algorithm>
#include <vector>

#include "balance/flow_balance.h"
#include "hersey/film/active_set.h"

namespace hersey::film {
namespace {

/// What a node gives away if it is full at p = 0, and how that changes with its fill fraction [m^3/s].
struct Balance {
  double lack = 0;
  double slope = 0;
};

class Fronts {
 public:
  Fronts(const FlowBalance& balance, Eigen::VectorXd& u)
      : balance_(balance),
        grid_(balance.model().grid),
        fill_(fill_scale(balance.model())),
        u_(u),
        moved_(u.size(), 0) {}

  void sweep() {
    const bool ascending = balance_.speed_phi() >= 0;
    const int n = grid_.n_phi;
    // Twice around: a front may pass the line where the sweep began.
    for (int k = 0; k < 2 * n; ++k) {
      const int i = ascending ? k % n : n - 1 - k % n, upstream = ascending ? grid_.before(i) : grid_.next(i);
      for (int j = 0; j < grid_.n_z; ++j) {
        const int node = grid_.index(i, j);
        const bool emptied = u_[node] < 0 && balance_.nodes()[node].theta == 1;
        if (emptied || (upstream >= 0 && moved_[grid_.index(upstream, j)])) relax(i, j);
      }
    }
  }

 private:
  [[nodiscard]] double pressure(int node) const { return balance_.is_on_open_edge(node) ? 0 : std::max(u_[node], 0.0); }
  [[nodiscard]] double fill(int node) const { return 1 + std::min(u_[node], 0.0) / fill_; }

  void add_face(int node, std::size_t f, Balance& sum) const {
    const Face& face = balance_.faces()[f];
    const FaceFlow& flow = balance_.flows()[f];
    const int other = face.a == node ? face.b : face.a;
    const double leaving = face.a == node ? flow.couette : -flow.couette;
    const double coming = face.a == node ? -flow.carried(fill(other)).value : flow.carried(fill(other)).value;
    sum.lack += (leaving >= 0 ? leaving : -coming) - flow.K * pressure(other);
    sum.slope += std::max(leaving, 0.0);
  }

  void relax(int i, int j) {
    const int node = grid_.index(i, j);
    if (balance_.is_on_prescribed_edge(node) || balance_.is_on_supply(node)) return;
    if (balance_.is_on_open_edge(node) && (ambient_fill(balance_.model(), node) > 0 || balance_.given_flow(node) > 0))
      return;  // oil comes in there
    const double storage_slope = balance_.nodes()[node].density * balance_.storage_by_content(node);
    Balance sum{balance_.storage(node) + storage_slope * (1 - balance_.nodes()[node].theta), storage_slope};
    for (const int f : balance_.faces_around(node))
      if (f >= 0) add_face(node, static_cast<std::size_t>(f), sum);
    if (sum.lack <= 0 || sum.slope <= 0) return;
    u_[node] = -fill_ * std::min(1.0, sum.lack / sum.slope);
    moved_[node] = 1;
  }

  const FlowBalance& balance_;
  const Grid& grid_;
  double fill_;
  Eigen::VectorXd& u_;
  std::vector<char> moved_;  ///< nodes emptied, or followed
};

}  // namespace

void ActiveSet::advance_rupture_front(Eigen::VectorXd& u) const {
  const FlowBalance& balance = *balance_;
  if (cavitation_law(balance.model()).has_fill()) Fronts(balance, u).sweep();
}

}  // namespace hersey::film
