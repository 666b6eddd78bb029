#include "time_stepping/floquet.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace hersey::run {
namespace {

constexpr double kSize = 3e-4;      // of deviations, in shares of a swing
constexpr double kAccuracy = 1e-3;  // of a multiplier that is found
constexpr double kSmallest = 0.1;   // multiplier below which the accuracy is one of this

// Share of a deviation that a period adds to those before, below which it is what Newton's method leaves.
constexpr double kNothingNew = 2e-3;

constexpr double kOwnShare = 0.1;  // of a first deviation that is none of those before

using Complex = std::complex<double>;

struct Found {
  Complex value;
  double error = 0;  // estimated
};

// Eigenvalues of the map in the space of the deviations, largest first, each with the norm of its residual.
std::vector<Found> ritz_values(const Eigen::MatrixXd& H, double next) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(H);
  const Eigen::MatrixXcd vectors = solver.eigenvectors();
  std::vector<Found> found;
  const Eigen::Index last = H.rows() - 1;
  for (Eigen::Index i = 0; i < H.rows(); ++i) {
    const Complex value = solver.eigenvalues()[i];
    if (value.imag() < 0) continue;
    const auto vector = vectors.col(i);
    found.push_back({value, next * std::abs(vector[last]) / vector.norm()});
  }
  std::ranges::sort(found, [](const Found& a, const Found& b) { return std::abs(a.value) > std::abs(b.value); });
  return found;
}

// Number of the largest values that have a small residual and, unless the deviations are complete, did not move with
// the last of them.
std::size_t count_of_found(const std::vector<Found>& values, const std::vector<Found>& before, bool are_complete) {
  const auto is_found = [&](std::size_t i) {
    const double enough = kAccuracy * std::max(std::abs(values[i].value), kSmallest);
    if (are_complete) return values[i].error <= kNothingNew;
    return i < before.size() && values[i].error <= enough && std::abs(values[i].value - before[i].value) <= enough;
  };
  std::size_t count = 0;
  while (count < values.size() && is_found(count)) ++count;
  return count;
}

// Orthonormal deviations d_k from a motion x, each as the motion x + kSize d_k.
class Deviations {
 public:
  Deviations(PeriodMap& map, const Motion& motion) : map_(map), motion_(motion) {}

  // Adds the part of `to - from` that is independent of those before.
  // @returns its shares along each, and its own size behind them, in units of kSize
  Eigen::VectorXd add(const Motion& from, const Motion& to) {
    const Eigen::VectorXd way = map_.way(from, to) / kSize;
    const auto count = static_cast<Eigen::Index>(directions_.size());
    Eigen::VectorXd shares = Eigen::VectorXd::Zero(count + 1), rest = way;
    for (int repeat = 0; repeat < 2; ++repeat)
      for (Eigen::Index k = 0; k < count; ++k) {
        const double along = directions_[static_cast<std::size_t>(k)].dot(rest);
        shares[k] += along;
        rest -= along * directions_[static_cast<std::size_t>(k)];
      }
    const double size = shares[count] = rest.norm();
    if (size == 0) return shares;
    directions_.emplace_back(rest / size);
    // x + (to - from - sum_k shares_k (x_k - x)) / size
    std::vector<Motion> of{motion_, to, from};
    Eigen::VectorXd weights(count + 3);
    weights << 1 + shares.head(count).sum() / size, 1 / size, -1 / size, -shares.head(count) / size;
    of.insert(of.end(), moved_.begin(), moved_.end());
    moved_.push_back(combine(map_.mechanism(), of, weights));
    return shares;
  }
  [[nodiscard]] const Motion& newest() const { return moved_.back(); }
  // Takes back the last one, of which little was new.
  void drop_newest() {
    directions_.pop_back();
    moved_.pop_back();
  }

 private:
  PeriodMap& map_;
  const Motion& motion_;
  std::vector<Eigen::VectorXd> directions_;
  std::vector<Motion> moved_;
};

}  // namespace

FloquetMultipliers floquet_multipliers(PeriodMap& map, const Shooting& found, int count, std::size_t starts) {
  FloquetMultipliers multipliers;
  if (const Outcome period = map.take_from(found.motion); !period.solved())
    return no_answer<FloquetMultipliers>(period.message);
  const Motion end = map.motion();
  multipliers.trials.push_back({found.motion, end, map.period()});
  Deviations deviations(map, found.motion);
  std::vector<Motion> near = found.near;  // to begin with, the last first
  const auto begins = [&] {
    for (; !near.empty(); near.pop_back()) {
      const Eigen::VectorXd shares = deviations.add(found.motion, near.back());
      const double own = shares.tail(1)[0];
      if (own > kOwnShare * shares.norm()) return near.pop_back(), true;
      if (own > 0) deviations.drop_newest();
    }
    return false;
  };
  if (!begins())
    return no_answer<FloquetMultipliers>("all trials have led to the same motion: there is no deviation to begin with");
  const int most = most_periods_for_multipliers(count) - 1;
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(most + 1, most);
  std::vector<Found> before;
  for (int k = 0; k < most; ++k) {
    if (const Outcome period = map.take_from(deviations.newest()); !period.solved())
      return no_answer<FloquetMultipliers>(period.message);
    Motion moved = map.motion();
    multipliers.trials.push_back({deviations.newest(), moved, map.period()});
    H.col(k).head(k + 2) = deviations.add(end, moved);
    multipliers.periods = k + 2;
    if (H(k + 1, k) <= kNothingNew && starts > 1) {
      if (H(k + 1, k) > 0) deviations.drop_newest();
      H(k + 1, k) = 0;
      if (k + 1 < map.dimension() && begins()) {
        --starts;
        continue;
      }
      starts = 1;
    }
    std::vector<Found> values = ritz_values(H.topLeftCorner(k + 1, k + 1), H(k + 1, k));
    const bool are_complete = H(k + 1, k) <= kNothingNew;
    // As many deviations as the motion has: what is left of a further one is of the second order of their size.
    const bool are_all = k + 1 >= map.dimension();
    const std::size_t found_so_far = are_all ? values.size() : count_of_found(values, before, are_complete);
    const bool is_enough = found_so_far >= static_cast<std::size_t>(count) && starts <= 1;
    if (!is_enough && !are_complete && !are_all && k + 1 < most) {
      before = std::move(values);
      continue;
    }
    values.resize(std::min(found_so_far, static_cast<std::size_t>(count)));
    for (const Found& value : values) multipliers.values.push_back(value.value);
    break;
  }
  multipliers.set_solved(!multipliers.values.empty());
  if (!multipliers.solved()) multipliers.fail("no multiplier has been found");
  return multipliers;
}

}  // namespace hersey::run
