#include <algorithm>
#include <cmath>
#include <vector>

#include "hersey/mbd/mechanism.h"
#include "mechanism/mechanism_parts.h"

namespace hersey::mbd {
namespace {

/// Columns between each link that carries bodies and the nearest link towards ground that does.
struct Chains {
  explicit Chains(const Tree& tree)
      : body_on(tree.links.size(), -1), columns(tree.links.size()), from(tree.links.size(), 0) {
    for (std::size_t b = 0; b < tree.bodies.size(); ++b) {
      int& known = body_on[static_cast<std::size_t>(tree.bodies[b].link)];
      if (known < 0) known = static_cast<int>(b);
    }
    for (std::size_t l = 1; l < tree.links.size(); ++l) {
      if (body_on[l] < 0) continue;
      int at = static_cast<int>(l);
      do {
        const Link& link = tree.links[static_cast<std::size_t>(at)];
        for (int k = link.columns - 1; k >= 0; --k) columns[l].push_back(link.first_v + k);
        at = link.parent;
      } while (at > 0 && body_on[static_cast<std::size_t>(at)] < 0);
      std::reverse(columns[l].begin(), columns[l].end());
      from[l] = at;
    }
  }

  std::vector<int> body_on;               ///< per link: the first body on it, -1: none
  std::vector<std::vector<int>> columns;  ///< per link with bodies
  std::vector<int> from;                  ///< the link towards ground
};

}  // namespace

Eigen::VectorXd Mechanism::velocities_of(const Eigen::VectorXd& q,
                                         const Eigen::Matrix<double, 6, Eigen::Dynamic>& twists, double* misfit) {
  MechanismParts& m = *parts_;
  const Chains chains(m.tree);
  solver::State state;
  state.q = q;
  state.v.setZero(m.nv);
  state.vdot.setZero(m.nv);
  m.motion.update(state);
  Eigen::VectorXd v = Eigen::VectorXd::Zero(m.nv);
  double largest = 0, left = 0;
  for (std::size_t l = 1; l < m.tree.links.size(); ++l) {
    if (chains.body_on[l] < 0) continue;
    const int before = chains.body_on[static_cast<std::size_t>(chains.from[l])];
    const Vector6 own = twists.col(chains.body_on[l]);
    const Vector6 towards = before < 0 ? Vector6(Vector6::Zero()) : Vector6(twists.col(before));
    const auto count = static_cast<Eigen::Index>(chains.columns[l].size());
    // At the body's own origin, so that rotations and displacements are of one size.
    const Pose X = m.motion.pose(m.tree.bodies[static_cast<std::size_t>(chains.body_on[l])]);
    const auto at_body = [&](const Vector6& V) {
      Vector6 moved = V;
      moved.tail<3>() += moved.head<3>().cross(X.r);
      moved.tail<3>() /= m.tree.length;
      return moved;
    };
    const Vector6 wanted = at_body(own - towards);
    largest = std::max(largest, own.head<3>().norm());
    if (count == 0) {
      left = std::max(left, wanted.norm());
      continue;
    }
    Eigen::Matrix<double, 6, Eigen::Dynamic> J(6, count);
    for (Eigen::Index k = 0; k < count; ++k)
      J.col(k) = at_body(m.motion.J(chains.columns[l][static_cast<std::size_t>(k)]));
    const Eigen::VectorXd own_rates = J.completeOrthogonalDecomposition().solve(wanted);
    left = std::max(left, (J * own_rates - wanted).norm());
    for (Eigen::Index k = 0; k < count; ++k) v[chains.columns[l][static_cast<std::size_t>(k)]] = own_rates[k];
  }
  if (misfit != nullptr) *misfit = largest > 0 ? left / largest : 0;
  return v;
}

std::vector<std::vector<Mechanism::Index>> Mechanism::chains() const {
  std::vector<std::vector<Index>> all;
  for (const std::vector<int>& columns : Chains(parts_->tree).columns)
    if (!columns.empty()) all.emplace_back(columns.begin(), columns.end());
  return all;
}

std::vector<Mechanism::Index> Mechanism::rotations_in_space() const {
  std::vector<Index> first;
  for (const Link& link : parts_->tree.links)
    if (link.motion == Motion::ball) first.push_back(link.first_v);
  return first;
}

}  // namespace hersey::mbd
