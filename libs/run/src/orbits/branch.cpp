#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "hersey/run/orbits.h"
#include "orbits/bifurcations.h"
#include "orbits/orbit_search.h"

namespace hersey::run {
namespace {

constexpr double kFirstStep = 0.2, kSmallestStep = 1e-3;  // of the largest
constexpr double kGrowthOfSteps = 1.4, kCutOfSteps = 0.5;
constexpr int kEasy = 4;               // periods of a search, up to which the next step may be longer
constexpr double kOnTheCircle = 2e-3;  // distance of a multiplier from the unit circle at which it is located
constexpr int kMostRefinements = 10;   // of a bifurcation
constexpr double kNarrow = 2e-3;       // of the largest step: orbits between which nothing is refined
constexpr double kStraight = 0.85;     // cosine of the angle by which a branch may turn in a step
constexpr double kTurningStep = 0.05;  // of the largest: steps that may turn by more
constexpr double kNotBack = 0.3;       // cosine for those
constexpr double kMargin = 0.05;       // of the way between two orbits that those between them keep
constexpr double kSlack = 1e-6;        // of the range
constexpr double kVanishing = 0.02;    // of the largest oscillation: one that is about to end
constexpr double kClosed = 0.5;        // of a step from the first orbit: the branch is closed
constexpr std::size_t kFewestOfClosed = 6;
// In a narrow range motions change so little that a fold is a corner, which no step gets round. Their changes count
// more there, up to this share of the first step: half of it leaves folds twice as sharp, twice of it takes twice as
// many orbits round them. The most they count more keeps round-off of motions that do not change out.
constexpr double kLeastOfMotion = 0.1, kMostScale = 20;

class BranchFollower {
 public:
  BranchFollower(const std::function<model::Model(double)>& model_at, const BranchOptions& options)
      : options_(options), search_(model_at, options), range_(std::abs(options.to - options.from)) {}

  Branch follow() {
    FoundOrbit first = search_.first(options_.from);
    if (!first.solved()) return no_answer<Branch>(first.message);
    if (first.point.is_rest) return no_answer<Branch>("nothing oscillates: the machine comes to rest");
    add(std::move(first.point));
    while (branch_.message.empty()) go_on();
    branch_.observed = search_.observed();
    for (BranchPoint& point : points_) branch_.orbits.push_back(std::move(point.orbit));
    branch_.bifurcations = bifurcations_of(branch_.orbits);
    branch_.set_solved(true);
    return std::move(branch_);
  }

 private:
  void add(BranchPoint point) {
    farthest_ = farthest_.size() == 0 ? point.ways : farthest_.cwiseMax(point.ways).eval();
    if (options_.on_orbit) options_.on_orbit(point.orbit);
    points_.push_back(std::move(point));
    if (points_.size() == 2) scale_motions();
  }

  // By the first step, which is one of the value alone.
  void scale_motions() {
    const MotionAtValue before = search_.onto_section(points_.front().at);
    const double share = motion_over_value(metric().way(search_.mechanism(), before, points_.back().at));
    if (share > 0 && share < kLeastOfMotion) motion_scale_ = std::min(kLeastOfMotion / share, kMostScale);
  }

  // Its largest share of how far a coordinate that oscillates has gone in any orbit.
  [[nodiscard]] double oscillation_of(const BranchPoint& point) const {
    double share = 0;
    for (Eigen::Index i = 0; i < farthest_.size(); ++i)
      if (farthest_[i] > 0) share = std::max(share, point.ways[i] / farthest_[i]);
    return share;
  }

  [[nodiscard]] BranchMetric metric() { return {points_.back(), range_, search_.mechanism(), motion_scale_}; }

  // The plane at a step along the branch, by the last two orbits; from the first one to the next value.
  AcrossBranch plane_at(double step) {
    const BranchPoint& last = points_.back();
    const BranchMetric measure = metric();
    if (points_.size() < 2) {
      MotionAtValue predicted = last.at;
      const double way = options_.to > options_.from ? step : -step;
      predicted.value += way * range_;
      return {predicted, along_the_value(measure), measure, true};
    }
    const MotionAtValue before = search_.onto_section(points_[points_.size() - 2].at);
    Eigen::VectorXd direction = measure.way(search_.mechanism(), before, last.at);
    const double length = direction.norm();
    direction /= length;
    const double ratio = step / length;
    return {combine(search_.mechanism(), {last.at, before}, Eigen::Vector2d(1 + ratio, -ratio)), direction, measure};
  }

  Eigen::VectorXd along_the_value(const BranchMetric& measure) {
    const BranchPoint& last = points_.back();
    Eigen::VectorXd direction = Eigen::VectorXd::Zero(measure.way(search_.mechanism(), last.at, last.at).size());
    direction[direction.size() - 1] = 1;
    return direction;
  }

  [[nodiscard]] std::vector<PeriodTrial> trials_near() const {
    std::vector<PeriodTrial> trials = points_.back().trials;
    if (points_.size() > 1) trials.push_back(points_[points_.size() - 2].trials.front());
    return trials;
  }

  void go_on() {
    if (points_.size() >= static_cast<std::size_t>(options_.most)) {
      end(fmt::format("ended after {} orbits", points_.size()));
      return;
    }
    AcrossBranch plane = plane_at(step_);
    const auto [low, high] = std::minmax(options_.from, options_.to);
    const double bound = std::clamp(plane.predicted.value, low, high);
    const bool leaves = bound != plane.predicted.value || plane.predicted.value == high || plane.predicted.value == low;
    if (leaves) move_to_bound(plane, bound);
    FoundOrbit found = search_.next(plane, trials_near());
    if (search_.is_stopped()) return end("stopped on request");
    if (!found.solved()) return cut_step(found.message);
    if (found.point.is_rest || (search_.finds_period() && oscillation_of(found.point) < kVanishing)) {
      return end(fmt::format("ended near {:.6g}, where the oscillation vanishes", found.point.at.value));
    }
    const bool is_inside =
        found.point.at.value >= low - kSlack * range_ && found.point.at.value <= high + kSlack * range_;
    if (!is_inside) return cut_step("it left the range");
    if (!plane.keeps_value && turns_sharply(plane, found.point)) return cut_step("it turns too sharply");
    const int periods = found.point.orbit.periods;
    add(std::move(found.point));
    refine();
    if (leaves) return end("");
    if (is_closed()) return end("closed: it came back to the first orbit");
    if (periods - static_cast<int>(points_.back().trials.size()) - 1 <= kEasy)
      step_ = std::min(options_.step, step_ * kGrowthOfSteps);
  }

  // Steps that are too long for it miss what is between them, or go back on the branch.
  bool turns_sharply(const AcrossBranch& plane, const BranchPoint& point) {
    const Eigen::VectorXd way = plane.metric.way(search_.mechanism(), points_.back().at, point.at);
    const double least = step_ > kTurningStep * options_.step ? kStraight : kNotBack;
    return way.dot(plane.direction) < least * way.norm();
  }

  // The last orbit is that at the end of the range.
  void move_to_bound(AcrossBranch& plane, double bound) {
    if (points_.size() > 1) {
      const MotionAtValue &last = points_.back().at, before = search_.onto_section(points_[points_.size() - 2].at);
      const double ratio = (bound - last.value) / (last.value - before.value);
      plane.predicted = combine(search_.mechanism(), {last, before}, Eigen::Vector2d(1 + ratio, -ratio));
    }
    plane.predicted.value = bound;
    plane.direction = along_the_value(plane.metric);
    plane.keeps_value = true;
  }

  void cut_step(const std::string& why) {
    step_ *= kCutOfSteps;
    if (step_ < kSmallestStep * options_.step)
      end(fmt::format("could not be followed beyond {:.6g}: {}", points_.back().at.value, why));
  }

  // Orbits nearer and nearer to where a multiplier crosses the unit circle between the last two.
  void refine() {
    if (points_.size() < 2) return;
    std::vector<BranchPoint> behind;  // the crossing, the nearest last
    behind.push_back(std::move(points_.back()));
    points_.pop_back();
    for (int k = 0; k < kMostRefinements; ++k) {
      // Multipliers that meet on the real axis make its share of the way a poor guess: every other one is the middle.
      std::optional<BranchPoint> between = point_at_crossing(points_.back(), behind.back(), k % 2 == 1);
      if (!between && k % 2 == 1) break;
      if (!between) continue;
      if (options_.on_orbit) options_.on_orbit(between->orbit);
      const bool is_behind = crossing_between(points_.back().orbit, between->orbit).has_value();
      (is_behind ? behind : points_).push_back(std::move(*between));
    }
    for (; !behind.empty(); behind.pop_back()) points_.push_back(std::move(behind.back()));
  }

  // Nothing if there is no crossing between them, or if one of them is near enough to it.
  std::optional<BranchPoint> point_at_crossing(const BranchPoint& a, const BranchPoint& b, bool in_the_middle) {
    const std::optional<Crossing> crossing = crossing_between(a.orbit, b.orbit);
    if (!crossing) return std::nullopt;
    const double distance = std::min(distance_from_circle(a, *crossing), distance_from_circle(b, *crossing));
    const BranchMetric measure(b, range_, search_.mechanism(), motion_scale_);
    const MotionAtValue start = search_.onto_section(a.at), end = search_.onto_section(b.at);
    const Eigen::VectorXd way = measure.way(search_.mechanism(), start, end);
    if (distance < kOnTheCircle || way.norm() < kNarrow * options_.step) return std::nullopt;
    const double share = in_the_middle ? 0.5 : std::clamp(crossing->share, kMargin, 1 - kMargin);
    std::vector<PeriodTrial> trials = b.trials;
    trials.push_back(a.trials.front());
    FoundOrbit found = search_.next(
        {combine(search_.mechanism(), {start, end}, Eigen::Vector2d(1 - share, share)), way.normalized(), measure},
        std::move(trials));
    if (!found.solved() || found.point.is_rest) return std::nullopt;
    return std::move(found.point);
  }

  static double distance_from_circle(const BranchPoint& point, const Crossing& crossing) {
    double nearest = 1;
    for (const std::complex<double>& multiplier : point.orbit.multipliers)
      if (std::abs(multiplier - crossing.multiplier) < 0.5)
        nearest = std::min(nearest, std::abs(std::abs(multiplier) - 1));
    return nearest;
  }

  bool is_closed() {
    if (points_.size() < kFewestOfClosed) return false;
    const Eigen::VectorXd way = metric().way(search_.mechanism(), points_.front().at, points_.back().at);
    return way.norm() < kClosed * step_;
  }

  void end(std::string why) { branch_.message = why.empty() ? "ended at the end of the range" : std::move(why); }

  const BranchOptions& options_;
  OrbitSearch search_;
  double range_;
  double step_ = kFirstStep * options_.step;
  double motion_scale_ = 1;
  Eigen::VectorXd farthest_;  // ways of all positions in a period, of all orbits
  std::vector<BranchPoint> points_;
  Branch branch_;
};

}  // namespace

Branch follow_branch(const std::function<model::Model(double)>& model_at, const BranchOptions& options) {
  return BranchFollower(model_at, options).follow();
}

}  // namespace hersey::run
