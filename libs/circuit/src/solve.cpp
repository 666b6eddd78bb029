// Pressures and fills at which every node of a circuit gives what is drawn from it.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "hersey/circuit/circuit.h"

namespace hersey::circuit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Imbalance over the largest flow with which a solution ends: round-off of a sum of a few flows.
constexpr double kBalanced = 1e-13;
// Imbalance that still passes for a solution where an increment no longer lessens it, over what it ends with otherwise:
// valves at the point of opening.
constexpr double kNearlyBalanced = 1e3;
constexpr int kMostIterations = 100;      // monotone laws take about ten; valves that open add one each
constexpr double kNoAnswer = 1e-9;        // change of the imbalance, over itself, that counts as none
constexpr int kMostHalvings = 60;         // from the largest step down to one of 1e-9 Pa
constexpr double kLargestPressure = 1e9;  // Pa: beyond all pressures, where nothing yet leads away from a node
// Below this part of an increment slower ones are tried, too: where nodes empty or fill, flows bend.
constexpr double kSmallPart = 1.0 / 64;
// Slower increments have the Jacobian with its diagonal so many times larger, each ten times slower than the last.
constexpr double kFirstSlower = 1e-3, kSlowest = 1e9;

/// Newton's method for the imbalances of the nodes, between empty ones and the largest pressure.
///
/// Laws are monotone, so that a part of Newton's increment that is small enough brings nodes nearer to balance. Where
/// flows bend it may not; but what leaves a node arrives at others, so that increments along the surplus alone, the
/// limit of slower ones, always lessen the sum of imbalances. A node without oil gives none: what a linear film still
/// draws there does not count.
class Balancing {
 public:
  Balancing(const Circuit& circuit, const Conditions& conditions, const Drawn& drawn, const VectorXd& p)
      : circuit_(circuit), conditions_(conditions), drawn_(drawn), empty_(circuit.size()) {
    VectorXd start = p;
    for (Index i = 0; i < circuit.size(); ++i) {
      if (is_given(i)) start[i] = conditions.given[i];
      empty_[i] = is_given(i) ? start[i] : node(i).p_cav - circuit.fill_scale(static_cast<std::size_t>(i));
    }
    move_to(start);
  }

  [[nodiscard]] bool is_balanced() const { return surplus_.norm() <= tolerance_; }

  /// Takes one increment; returns false if none lessens the imbalances.
  bool improve() {
    const VectorXd from = p_, surplus = surplus_;
    const double before = imbalance();
    MatrixXd by_p = slopes();
    const double part = search_along(by_p.partialPivLu().solve(-surplus), from, before);
    if (part < kSmallPart) try_slower(by_p, from, surplus);
    if (imbalance() < before) return true;
    move_to(from);
    return false;
  }

  [[nodiscard]] const VectorXd& p() const { return p_; }

  /// What is left.
  void describe(CircuitSummary& summary) const {
    Index worst = 0;
    const double largest = surplus_.size() > 0 ? surplus_.cwiseAbs().maxCoeff(&worst) : 0;
    summary.residual = largest_flow_ > 0 ? largest / largest_flow_ : 0;
    summary.set_solved(largest <= kNearlyBalanced * tolerance_);
    if (summary.solved()) return;
    const double pressure = circuit_.state(static_cast<std::size_t>(worst), p_[worst]).p;
    summary.message = fmt::format("no balance of oil at node {}: {:.3g} mm3/s too much at {:.4g} bar", node(worst).name,
                                  1e9 * surplus_[worst], 1e-5 * pressure);
  }

 private:
  [[nodiscard]] const Node& node(Index i) const { return circuit_.network().nodes[static_cast<std::size_t>(i)]; }
  [[nodiscard]] bool is_given(Index i) const { return node(i).is_given; }
  [[nodiscard]] bool is_empty(Index i) const { return p_[i] <= empty_[i]; }
  [[nodiscard]] double imbalance() const { return surplus_.lpNorm<1>(); }

  /// Goes to pressures that are possible and computes the surplus of each node there.
  void move_to(const VectorXd& p) {
    p_ = p.cwiseMin(kLargestPressure).cwiseMax(empty_);
    circuit_.evaluate(p_, conditions_, balance_);
    const VectorXd taken = drawn_.flow + drawn_.by_p * (p_ - drawn_.p);
    largest_flow_ = std::max(balance_.largest_flow, taken.lpNorm<Eigen::Infinity>());
    tolerance_ = kBalanced * largest_flow_ + balance_.round_off;
    surplus_ = balance_.surplus - taken;
    for (Index i = 0; i < surplus_.size(); ++i)
      if (is_given(i) || (is_empty(i) && surplus_[i] < 0)) surplus_[i] = 0;
  }

  /// d surplus/dp, regular; an empty node that nothing fills stays so.
  [[nodiscard]] MatrixXd slopes() const {
    MatrixXd by_p = balance_.by_p - drawn_.by_p;
    circuit_.fix_given(by_p);
    for (Index i = 0; i < surplus_.size(); ++i)
      if (is_empty(i) && surplus_[i] == 0) by_p.row(i) = by_p(i, i) * Eigen::RowVectorXd::Unit(by_p.cols(), i);
    return by_p;
  }

  /// Goes the largest part of an increment that lessens the imbalances, and returns it. Where nodes without oil part
  /// others, nothing answers at first: the part is then sought beyond that.
  double search_along(const VectorXd& increment, const VectorXd& from, double before) {
    double part = 1, too_far = 1, not_yet = 0;
    move_to(from + increment);
    for (int k = 0; k < kMostHalvings && !(imbalance() < before); ++k) {
      (k > 0 && imbalance() < (1 + kNoAnswer) * before ? not_yet : too_far) = part;
      part = 0.5 * (not_yet + too_far);
      move_to(from + part * increment);
    }
    return part;
  }

  /// Goes the best of slower increments, if one is better than where we are.
  void try_slower(MatrixXd& by_p, const VectorXd& from, const VectorXd& surplus) {
    const VectorXd diagonal = by_p.diagonal();
    VectorXd best = p_;
    double least = imbalance();
    for (double slower = kFirstSlower; slower <= kSlowest; slower *= 10) {
      by_p.diagonal() = (1 + slower) * diagonal;
      move_to(from + by_p.partialPivLu().solve(-surplus));
      if (imbalance() < least) best = p_, least = imbalance();
    }
    move_to(best);
  }

  const Circuit& circuit_;
  const Conditions& conditions_;
  const Drawn& drawn_;
  VectorXd empty_;  // entries of pressures of empty nodes
  VectorXd p_, surplus_;
  Circuit::Balance balance_;
  double largest_flow_ = 0, tolerance_ = 0;
};

}  // namespace

// (circuit.9)
CircuitSummary Circuit::solve(const Conditions& conditions, const Drawn& drawn, Eigen::VectorXd& p) const {
  CircuitSummary summary;
  Balancing balancing(*this, conditions, drawn, p);
  while (summary.iterations < kMostIterations && !balancing.is_balanced() && balancing.improve()) ++summary.iterations;
  p = balancing.p();
  balancing.describe(summary);
  return summary;
}

}  // namespace hersey::circuit
