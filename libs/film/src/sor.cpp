#include "sor.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "flow_balance.h"

namespace hersey::film {
namespace {

constexpr int sweeps_per_update = 20;

/// A node's row with everything but its own unknown known: K p + transport theta + known = 0 [m^3/s].
struct NodeRow {
  double K = 0;
  double transport = 0;
  double known = 0;
};

class Sor {
 public:
  Sor(const FilmModel& model, const SurfaceMotion& motion, const FilmHistory& history)
      : balance_(model), motion_(motion), history_(history), fill_(fill_scale(model)), around_(balance_.size()) {
    for (std::size_t f = 0; f < balance_.faces().size(); ++f) {
      around_[balance_.faces()[f].a].push_back(static_cast<int>(f));
      around_[balance_.faces()[f].b].push_back(static_cast<int>(f));
    }
  }

  FilmSolveSummary solve(const FilmSolveOptions& options, Eigen::VectorXd& u);

 private:
  void start(const Eigen::VectorXd& u);
  void update_coefficients(const Eigen::VectorXd& u);
  void sweep();
  void relax(int i, int j);
  [[nodiscard]] NodeRow row(int node) const;
  [[nodiscard]] double over_relaxation() const;
  [[nodiscard]] double following() const;
  [[nodiscard]] Eigen::VectorXd unknown() const;

  FlowBalance balance_;
  const SurfaceMotion& motion_;
  const FilmHistory& history_;
  double fill_;
  double omega_ = 1;
  std::vector<std::vector<int>> around_;  ///< the faces of every node
  Eigen::VectorXd p_, theta_;             ///< latest pressure above p_cav and fill fraction
  Eigen::VectorXd storage_known_, storage_theta_;
};

// Young's factor for the five-point operator between two edges at given pressure; a closed bearing has only its
// periodic direction to bound it.
double Sor::over_relaxation() const {
  const Grid& grid = balance_.model().grid;
  const double dphi = 2 * std::numbers::pi / grid.n_phi;
  const double across = std::pow(balance_.model().R * dphi * (grid.n_z - 1) / balance_.model().L, 2);
  const bool closed = balance_.model().edges == EdgeKind::closed;
  const double rho =
      closed ? std::cos(0.5 * dphi) : (1 + across * std::cos(std::numbers::pi / (grid.n_z - 1))) / (1 + across);
  return 2 / (1 + std::sqrt(1 - rho * rho));
}

// Share of a change of pressure that thickness and viscosity follow at once: the gain of that loop is 3 dh/h + alpha
// dp.
double Sor::following() const {
  const FilmModel& model = balance_.model();
  double gain = 0;
  for (const Node& node : balance_.nodes()) {
    gain = std::max(gain, 3 * model.compliance * node.wall / node.h + model.lubricant.alpha * node.p);
  }
  return 1 / (1 + gain);
}

void Sor::start(const Eigen::VectorXd& u) {
  const bool fills = balance_.model().cavitation == Cavitation::mass_conserving;
  const bool signed_pressure = balance_.model().cavitation == Cavitation::guembel;
  p_ = signed_pressure ? u : u.cwiseMax(0.0);
  theta_.setOnes(u.size());
  if (fills) theta_ += u.cwiseMin(0.0) / fill_;
}

void Sor::update_coefficients(const Eigen::VectorXd& u) {
  balance_.evaluate(motion_, history_, u);
  const int n_z = balance_.model().grid.n_z;
  storage_theta_.resize(u.size());
  storage_known_.resize(u.size());
  for (int i = 0; i < balance_.size(); ++i) {
    const double area = balance_.area(i % n_z);
    const Node& node = balance_.nodes()[i];
    storage_theta_[i] = area * (history_.dt == 0 ? motion_.g_rate[i] : node.h / history_.dt);
    storage_known_[i] = balance_.storage(i) - storage_theta_[i] * node.theta;
  }
}

NodeRow Sor::row(int node) const {
  NodeRow r{0, storage_theta_[node], storage_known_[node]};
  for (int f : around_[node]) {
    const Face& face = balance_.faces()[f];
    const FaceFlow& flow = balance_.flows()[f];
    const bool is_a = face.a == node;
    const int other = is_a ? face.b : face.a;
    const double couette = is_a ? flow.couette : -flow.couette;  // out of this node
    r.K += flow.K;
    r.known -= flow.K * p_[other];
    if (couette >= 0) {
      r.transport += couette;
    } else {
      r.known += couette * theta_[other];
    }
  }
  return r;
}

void Sor::relax(int i, int j) {
  const FilmModel& model = balance_.model();
  const int node = model.grid.index(i, j);
  if (balance_.edge_row(j)) {
    p_[node] = balance_.edge_unknown(j);
    return;
  }
  NodeRow r = row(node);
  // Beside the supply line the row is a blend with u = u_supply, where u = p or (theta - 1) P0.
  const double chi = balance_.supply_share(i, j), tie = chi * balance_.supply_conductance();
  const double K = (1 - chi) * r.K + tie;
  const double full = (1 - chi) * (r.known + r.transport) - tie * balance_.supply_unknown();
  const double p = p_[node] + omega_ * (-full / K - p_[node]);
  if (model.cavitation == Cavitation::guembel || p >= 0) {
    p_[node] = p;
    theta_[node] = 1;
    return;
  }
  p_[node] = 0;
  if (model.cavitation == Cavitation::reynolds) return;
  const double transport = (1 - chi) * r.transport + tie * fill_;
  const double known = (1 - chi) * r.known - tie * (fill_ + balance_.supply_unknown());
  theta_[node] = transport > 0 ? std::min(1.0, -known / transport) : 1;
}

// With the flow, so that the fill fraction is carried around in one sweep.
void Sor::sweep() {
  const Grid& grid = balance_.model().grid;
  const bool forwards = balance_.speed_phi() >= 0;
  for (int k = 0; k < grid.n_phi; ++k) {
    const int i = forwards ? k : grid.n_phi - 1 - k;
    for (int j = 0; j < grid.n_z; ++j) relax(i, j);
  }
}

// The slack of the model reynolds is what its row leaves: balance + D0 u = 0 (film.12).
Eigen::VectorXd Sor::unknown() const {
  const FilmModel& model = balance_.model();
  Eigen::VectorXd u = p_;
  for (int node = 0; node < balance_.size(); ++node) {
    if (p_[node] != 0) continue;
    const int i = node / model.grid.n_z, j = node % model.grid.n_z;
    if (model.cavitation == Cavitation::mass_conserving) u[node] = fill_ * (theta_[node] - 1);
    if (model.cavitation != Cavitation::reynolds || balance_.edge_row(j)) continue;
    const NodeRow r = row(node);
    const double chi = balance_.supply_share(i, j), tie = chi * balance_.supply_conductance();
    const double left = (1 - chi) * (r.known + r.transport) - tie * balance_.supply_unknown();
    u[node] = std::min(0.0, -left / ((1 - chi) * balance_.conductance_scale() + tie));
  }
  return u;
}

FilmSolveSummary Sor::solve(const FilmSolveOptions& options, Eigen::VectorXd& u) {
  FilmSolveSummary summary;
  const int most = 1000 * options.max_iterations;
  omega_ = over_relaxation();
  Eigen::VectorXd followed = u;  // where thickness and viscosity are taken
  start(u);
  for (;; summary.iterations += sweeps_per_update) {
    update_coefficients(u);
    summary.relative_residual = balance_.relative_residual();
    summary.worst_node = balance_.worst_node();
    summary.converged = summary.relative_residual <= options.rtol;
    if (summary.converged || summary.iterations >= most) return summary;
    followed += following() * (u - followed);
    if (followed != u) update_coefficients(followed);
    for (int s = 0; s < sweeps_per_update; ++s) sweep();
    u = unknown();
  }
}

}  // namespace

FilmSolveSummary solve_by_sor(Reynolds& reynolds, const SurfaceMotion& motion, const FilmHistory& history,
                              const FilmSolveOptions& options, Eigen::VectorXd& u) {
  Sor sor(reynolds.model(), motion, history);
  const FilmSolveSummary summary = sor.solve(options, u);
  reynolds.linearise(motion, history, u);  // leaves the object at the answer, as Newton does
  return summary;
}

}  // namespace hersey::film
