#include "time_stepping/motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

namespace hersey::run {
namespace {

constexpr double kLeastSwing = 1e-9;  // of the machine's size, and of a radian: coordinates that stand still
constexpr double kRest = 1e-7;        // of the machine's size, and of a radian
constexpr double kConstant = 1e-5;    // share of a velocity below which its changes are round-off
constexpr double kTemperatures = 10;  // K, of films, that count as much as a coordinate's swing

std::string_view last_part(std::string_view name) { return name.substr(name.rfind('/') + 1); }

bool is_fill(std::string_view name) { return last_part(name) == "theta"; }
bool is_temperature(std::string_view name) { return last_part(name).starts_with("T_"); }
bool is_angle(std::string_view name) {
  return last_part(name) == "phi_journal" || name.ends_with("/held_supply/value");
}
// A matrix that has been factorised fixes an order of elimination.
bool is_of_a_factor(std::string_view name) { return last_part(name) == "pivoted_matrix"; }

bool is_whole(const Archive::Numbers& numbers) {
  return std::ranges::all_of(numbers.values, [](double value) { return std::floor(value) == value; });
}

using Same = std::vector<const Archive::Numbers*>;  // numbers of one name in all motions, none if one has others

Same same_numbers(const std::vector<Motion>& motions, const std::string& name) {
  Same same;
  for (const Motion& motion : motions) {
    const auto found = motion.memory.numbers.find(name);
    if (found == motion.memory.numbers.end()) return {};
    if (!same.empty() && found->second.shape != same.front()->shape) return {};
    same.push_back(&found->second);
  }
  return std::ranges::all_of(same, [](const Archive::Numbers* of) { return is_whole(*of); }) ? Same{} : same;
}

double nearest(double angle, double to) { return to + std::remainder(angle - to, 2 * std::numbers::pi); }

}  // namespace

Motion combine(const mbd::Mechanism& mechanism, const std::vector<Motion>& motions, const Eigen::VectorXd& weights) {
  Motion combined = motions.front();
  Eigen::VectorXd dq = Eigen::VectorXd::Zero(mechanism.nv());
  for (std::size_t k = 1; k < motions.size(); ++k)
    dq += weights[static_cast<Eigen::Index>(k)] *
          mechanism.difference(motions.front().q, motions[k].q, combined.swinging);
  mechanism.retract(motions.front().q, dq, combined.q);
  for (auto& [name, numbers] : combined.memory.numbers) {
    if (is_of_a_factor(name)) continue;
    const Same same = same_numbers(motions, name);
    if (same.empty()) continue;
    for (std::size_t i = 0; i < numbers.values.size(); ++i) {
      double& value = numbers.values[i];
      const double first = value;
      for (std::size_t k = 1; k < same.size(); ++k) {
        const double other = is_angle(name) ? nearest(same[k]->values[i], first) : same[k]->values[i];
        value += weights[static_cast<Eigen::Index>(k)] * (other - first);
      }
      if (is_fill(name)) value = std::max(0.0, value);
    }
  }
  return combined;
}

Swing::Swing(const mbd::Mechanism& mechanism, double period) : mechanism_(mechanism), period_(period) {}

void Swing::begin(const solver::State& state) {
  last_ = state.q;
  way_ = Eigen::VectorXd::Zero(mechanism_.nv());
  lowest_.resize(2 * mechanism_.nv());
  lowest_ << Eigen::VectorXd::Zero(mechanism_.nv()), state.v;
  highest_ = lowest_;
}

void Swing::take(const solver::State& state) {
  Eigen::VectorXd now(2 * mechanism_.nv());
  way_ += mechanism_.difference(last_, state.q);
  last_ = state.q;
  now << way_, state.v;
  lowest_ = lowest_.cwiseMin(now);
  highest_ = highest_.cwiseMax(now);
}

Eigen::VectorXd Swing::sizes() const {
  Eigen::VectorXd least(2 * mechanism_.nv());
  least << mechanism_.position_scales(), mechanism_.position_scales() * 2 * std::numbers::pi / period_;
  Eigen::VectorXd sizes = (highest_ - lowest_).cwiseMax(kLeastSwing * least);
  const Eigen::VectorXd fastest = highest_.cwiseAbs().cwiseMax(lowest_.cwiseAbs()).tail(mechanism_.nv());
  for (const Eigen::Index i : mechanism_.revolutions())
    if (goes_round(i)) sizes[i] = std::numeric_limits<double>::infinity();
  for (const Eigen::Index i : mechanism_.driven_coordinates())
    sizes[mechanism_.nv() + i] = std::numeric_limits<double>::infinity();
  sizes.tail(mechanism_.nv()) = sizes.tail(mechanism_.nv()).cwiseMax(kConstant * fastest);
  return sizes;
}

Eigen::VectorXd Swing::ways() const {
  Eigen::VectorXd ways = (highest_ - lowest_).head(mechanism_.nv());
  for (const Eigen::Index i : mechanism_.revolutions())
    if (goes_round(i)) ways[i] = 0;
  const Eigen::VectorXd least = kRest * mechanism_.position_scales();
  return (ways.array() > least.array()).select(ways, 0);
}

// It ends a period at least half a revolution from where it began; one that swings comes back.
bool Swing::goes_round(Eigen::Index i) const { return std::abs(way_[i]) > std::numbers::pi; }

std::vector<mbd::Mechanism::Index> Swing::swinging() const {
  std::vector<mbd::Mechanism::Index> angles;
  if (way_.size() == 0) return angles;
  for (const Eigen::Index i : mechanism_.revolutions())
    if (!goes_round(i)) angles.push_back(i);
  return angles;
}

bool Swing::is_rest() const { return ways().isZero(0); }

Motion with_rings_at(const mbd::Mechanism& mechanism, const Eigen::VectorXd& here, const Eigen::VectorXd& sizes,
                     Motion motion) {
  Eigen::VectorXd way = mechanism.difference(here, motion.q, motion.swinging);
  for (Eigen::Index i = 0; i < way.size(); ++i)
    if (std::isinf(sizes[i])) way[i] = 0;
  mechanism.retract(here, way, motion.q);
  return motion;
}

Eigen::VectorXd way_between(const mbd::Mechanism& mechanism, const Motion& from, const Motion& to) {
  std::vector<double> way;
  const Eigen::VectorXd dq = mechanism.difference(from.q, to.q, to.swinging);
  const std::vector<double>&v0 = from.memory.numbers.at("v").values, &v = to.memory.numbers.at("v").values;
  for (Eigen::Index i = 0; i < dq.size(); ++i) way.push_back(dq[i]);
  for (std::size_t i = 0; i < v.size(); ++i) way.push_back(v[i] - v0[i]);
  for (const auto& [name, numbers] : to.memory.numbers) {
    const bool counts = (is_fill(name) || is_temperature(name)) && name.find("/last_step/") == std::string::npos;
    const auto before = from.memory.numbers.find(name);
    if (!counts || before == from.memory.numbers.end() || before->second.shape != numbers.shape) continue;
    const double size =
        std::sqrt(static_cast<double>(numbers.values.size())) * (is_temperature(name) ? kTemperatures : 1);
    for (std::size_t i = 0; i < numbers.values.size(); ++i)
      way.push_back((numbers.values[i] - before->second.values[i]) / size);
  }
  return Eigen::Map<const Eigen::VectorXd>(way.data(), static_cast<Eigen::Index>(way.size()));
}

}  // namespace hersey::run
