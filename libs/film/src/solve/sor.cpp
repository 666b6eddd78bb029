#include "solve/sor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "balance/flow_balance.h"

namespace hersey::film {
namespace {

constexpr int sweeps_per_update = 20;

// Number of updates without a halving of the residual after which sweeps are given up: they cycle.
constexpr int most_without_progress = 50;

// Largest number of Newton iterations for the fill fraction of one node, and the change of it with which they end: the
// remaining error is of the order of its square.
constexpr int most_of_a_node = 10;
constexpr double near_enough = 1e-7;

// Halvings after which the sweeps are back at their start: 2^-30.
constexpr int most_shortenings = 30;

constexpr std::size_t most_faces = 4;  // of a node

/// A node's row with everything known but its own unknown: K p + outflow at its fill fraction + known = 0 [m^3/s].
class NodeRow {
 public:
  double K = 0;      ///< [m^3/(Pa s)]
  double known = 0;  ///< [m^3/s]

  explicit NodeRow(double storage) : storage_(storage) {}
  /// Outflow over a face: `of_full` times the fraction of its flow at a fill fraction.
  void add_leaving(double of_full, const FaceFlow& flow) {
    leaving_[static_cast<std::size_t>(count_++)] = {of_full, &flow};
  }
  /// Outflow that is independent of the faces, per fill fraction.
  void add_storage(double storage) { storage_ += storage; }

  /// Outflow of a full gap.
  [[nodiscard]] double full() const {
    double sum = storage_;
    for (const Leaving& l : leaving()) sum += l.of_full;
    return sum;
  }

  /// Outflow at `theta`, with its slope.
  [[nodiscard]] ValueAndSlope at(double theta) const {
    ValueAndSlope sum{storage_ * theta, storage_};
    for (const Leaving& l : leaving()) {
      const EntrainedFlow carried = l.flow->carried(theta);
      sum.value += l.of_full * carried.value / l.flow->couette;
      sum.slope += l.of_full * carried.theta / l.flow->couette;
    }
    return sum;
  }

 private:
  struct Leaving {
    double of_full = 0;
    const FaceFlow* flow = nullptr;
  };
  [[nodiscard]] std::span<const Leaving> leaving() const { return {leaving_.data(), static_cast<std::size_t>(count_)}; }

  double storage_ = 0;
  std::array<Leaving, most_faces> leaving_;
  int count_ = 0;
};

class Sor {
 public:
  Sor(const FilmModel& model, const SurfaceMotion& motion, const FilmHistory& history)
      : balance_(model),
        motion_(motion),
        history_(history),
        cavitation_(cavitation_law(model)),
        scales_(cavitation_scales(model)),
        around_(balance_.size()) {
    if (cavitation_.has_fill()) balance_.always_evaluate_starved_flow();
    for (std::size_t f = 0; f < balance_.faces().size(); ++f) {
      around_[balance_.faces()[f].a].push_back(static_cast<int>(f));
      around_[balance_.faces()[f].b].push_back(static_cast<int>(f));
    }
  }

  FilmSolveSummary solve(const FilmSolveOptions& options, Eigen::VectorXd& u);

 private:
  void start(const Eigen::VectorXd& u);
  void set_unknown(int node, double u);
  [[nodiscard]] FilmDomain update_coefficients(const Eigen::VectorXd& u);
  [[nodiscard]] FilmDomain enter_domain(const Eigen::VectorXd& inside, Eigen::VectorXd& u);
  void sweep();
  void relax(int i, int j);
  [[nodiscard]] NodeRow row(int node) const;
  [[nodiscard]] double over_relaxation() const;
  [[nodiscard]] double following() const;

  FlowBalance balance_;
  const SurfaceMotion& motion_;
  const FilmHistory& history_;
  const CavitationLaw& cavitation_;
  CavitationScales scales_;
  double omega_ = 1;
  std::vector<std::vector<int>> around_;  ///< the faces of every node
  Eigen::VectorXd u_, p_, theta_;         ///< latest unknown, pressure above p_cav and fill fraction
  Eigen::VectorXd storage_known_, storage_theta_;
};

// Young's factor for the five-point operator between two edges at given pressure. A bearing with one wall is half of
// one of twice the width; with two walls only the periodic direction bounds the factor.
double Sor::over_relaxation() const {
  const Grid& grid = balance_.model().grid;
  const double dphi = mean_step(grid);
  const double across = std::pow(balance_.model().R * dphi * (grid.n_z - 1) / balance_.model().L, 2);
  const FilmModel& model = balance_.model();
  const bool one_wall = (model.edge_left.kind == EdgeKind::pressure) != (model.edge_right.kind == EdgeKind::pressure);
  const double wave = std::numbers::pi / (grid.n_z - 1) * (one_wall ? 0.5 : 1);
  const double rho = is_closed(model) ? std::cos(0.5 * dphi) : (1 + across * std::cos(wave)) / (1 + across);
  return 2 / (1 + std::sqrt(1 - rho * rho));
}

// Fraction of a change of pressure that thickness and viscosity follow at once: the gain of that loop at a node is 3
// dh/h
// + alpha dp, and changes of neighbours double it.
double Sor::following() const {
  const FilmModel& model = balance_.model();
  double gain = 0;
  for (const Node& node : balance_.nodes()) {
    const double pressure = std::abs(node.p);
    gain = std::max(gain, 3 * model.compliance * node.wall / node.h +
                              log_viscosity_ratio(model.lubricant, node.p).slope * pressure);
  }
  return 1 / (1 + 2 * gain);
}

void Sor::start(const Eigen::VectorXd& u) {
  u_ = p_ = theta_ = u;
  for (int node = 0; node < balance_.size(); ++node) set_unknown(node, u[node]);
}

void Sor::set_unknown(int node, double u) {
  u_[node] = u;
  const bool open = balance_.is_on_open_edge(node);
  const FilmPhase phase = cavitation_.phase(open ? std::max(u, balance_.ambient_unknown(node)) : u, scales_);
  p_[node] = open ? 0 : phase.p.value;
  theta_[node] = phase.theta.value;
}

FilmDomain Sor::update_coefficients(const Eigen::VectorXd& u) {
  if (const FilmDomain domain = balance_.evaluate(motion_, history_, u); !domain.is_inside()) return domain;
  storage_theta_.resize(u.size());
  storage_known_.resize(u.size());
  for (int i = 0; i < balance_.size(); ++i) {
    const Node& node = balance_.nodes()[i];
    storage_theta_[i] = node.density * balance_.storage_by_content(i);
    storage_known_[i] = balance_.storage(i) - storage_theta_[i] * node.theta;
  }
  return {};
}

// Sweeps with the coefficients of one film may end outside the domain: the step is halved as often as needed.
FilmDomain Sor::enter_domain(const Eigen::VectorXd& inside, Eigen::VectorXd& u) {
  FilmDomain domain = update_coefficients(u);
  for (int halvings = 0; !domain.is_inside() && halvings < most_shortenings; ++halvings) {
    u = 0.5 * (inside + u);
    start(u);
    domain = update_coefficients(u);
  }
  return domain;
}

NodeRow Sor::row(int node) const {
  NodeRow r(storage_theta_[node]);
  r.known = storage_known_[node] - balance_.given_flow(node);
  if (balance_.is_on_leaking_edge(node)) {
    const double seal = balance_.seal_conductance(node);
    r.K += seal;
    r.known -= seal * balance_.edge_unknown(node);
  }
  for (int f : around_[node]) {
    const Face& face = balance_.faces()[f];
    const FaceFlow& flow = balance_.flows()[f];
    const bool is_a = face.a == node;
    const int other = is_a ? face.b : face.a;
    const double couette = is_a ? flow.couette : -flow.couette;  // out of this node
    r.K += flow.K;
    r.known -= flow.K * p_[other];
    if (balance_.is_cut(static_cast<std::size_t>(f))) {
      const FlowBalance::TowardsLine line = balance_.towards_line(node);
      if (line.counts) {
        r.known -= line.strip;
        if (!line.from_node)
          r.known += line.full;
        else if (couette > 0)
          r.add_leaving(line.full, flow);
        else
          r.add_storage(line.full);
        continue;
      }
    }
    if (couette > 0)
      r.add_leaving(couette, flow);
    else  // the law's value for a full gap, without its roots
      r.known += (is_a ? 1 : -1) * (theta_[other] == 1 ? flow.couette : flow.carried(theta_[other]).value);
  }
  return r;
}

void Sor::relax(int i, int j) {
  const int node = balance_.model().grid.index(i, j);
  if (balance_.is_on_prescribed_edge(node)) return set_unknown(node, balance_.edge_unknown(node));

  // Beside line and features the row is a blend with u = u_supply; full, u >= 0, it reads  conductance u + full = 0.
  const NodeRow r = row(node);
  const bool open = balance_.is_on_open_edge(node);
  const double own = balance_.balance_weight(node), tie = balance_.supply_conductance(node);
  const double supplied = tie * balance_.supply_unknown(node);
  const double full = own * (r.known + r.full()) - supplied;
  const double conductance = own * (open ? balance_.conductance_scale() : r.K) + (balance_.only_fills(node) ? 0 : tie);
  const double target = -full / conductance;
  const double u = open ? target : p_[node] + omega_ * (target - p_[node]);
  if (u >= 0 || cavitation_.has_tension()) return set_unknown(node, u);

  const auto cavitated = [&](double theta) {
    const ValueAndSlope leaves = r.at(theta);
    return CavitatedRow{.full = own * (r.known + leaves.value + leaves.slope * (1 - theta)) - supplied,
                        .transport = own * leaves.slope,
                        .slack = own * balance_.conductance_scale(),
                        .drawn = tie * balance_.draws(node)};
  };
  // Newton's method for the fill fraction, from that of the last sweep (film.28).
  double theta = theta_[node], filling = 0;
  for (int k = 0; k < most_of_a_node; ++k) {
    filling = cavitation_.cavitated_unknown(cavitated(theta), scales_);
    const double last = std::exchange(theta, std::max(0.0, cavitation_.phase(filling, scales_).theta.value));
    if (std::abs(theta - last) <= near_enough) break;
  }
  const double ambient = balance_.ambient_unknown(node);
  if (!open || filling >= ambient) return set_unknown(node, filling);
  // The film is less full than the surroundings: u is the inflow that keeps it as full as these (film.19).
  const CavitatedRow drawing = cavitated(cavitation_.phase(ambient, scales_).theta.value);
  const double lack = drawing.full + (drawing.transport / scales_.fill + drawing.drawn) * ambient;
  set_unknown(node, std::min(ambient, ambient - lack / (drawing.slack + drawing.drawn)));
}

// Sweeps run with the flow, so that the fill fraction is carried around in one sweep.
void Sor::sweep() {
  const Grid& grid = balance_.model().grid;
  const bool forwards = balance_.speed_phi() >= 0;
  for (int k = 0; k < grid.n_phi; ++k) {
    const int i = forwards ? k : grid.n_phi - 1 - k;
    for (int j = 0; j < grid.n_z; ++j) relax(i, j);
  }
}

FilmSolveSummary Sor::solve(const FilmSolveOptions& options, Eigen::VectorXd& u) {
  FilmSolveSummary summary;
  const int most = 1000 * options.max_iterations;
  omega_ = over_relaxation();
  Eigen::VectorXd followed = u;  // unknowns at which thickness and viscosity are evaluated
  start(u);
  double least = std::numeric_limits<double>::infinity();
  int since = 0;
  for (;; summary.iterations += sweeps_per_update) {
    summary.domain = enter_domain(followed, u);
    if (!summary.domain.is_inside()) return summary;
    summary.relative_residual = balance_.relative_residual();
    summary.worst_node = balance_.worst_node();
    summary.set_solved(summary.relative_residual <= options.rtol);
    since = summary.relative_residual < 0.5 * least ? 0 : since + 1;
    if (since == 0) least = summary.relative_residual;
    if (summary.solved() || summary.iterations >= most || since > most_without_progress) return summary;
    followed += following() * (u - followed);
    if (followed != u) summary.domain = update_coefficients(followed);
    if (!summary.domain.is_inside()) return summary;
    for (int s = 0; s < sweeps_per_update; ++s) sweep();
    u = u_;
  }
}

}  // namespace

FilmSolveSummary solve_by_sor(Reynolds& reynolds, const SurfaceMotion& motion, const FilmHistory& history,
                              const FilmSolveOptions& options, Eigen::VectorXd& u) {
  Sor sor(reynolds.model(), motion, history);
  FilmSolveSummary summary = sor.solve(options, u);
  // Leaves the object at the solution, as Newton's method does.
  if (summary.domain.is_inside()) summary.domain = reynolds.linearise(motion, history, u);
  return summary;
}

}  // namespace hersey::film
