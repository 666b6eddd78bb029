#include "time_stepping/period_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "hersey/core/contract.h"

namespace hersey::run {
namespace {

constexpr double kNearlyReturns = 0.3;  // of a swing, over a period: a section across this motion is across its cycle
constexpr int kGrowing = 4;             // periods, after which a motion is compared with that of as many before
constexpr double kGrows = 1.02;  // of it: growth that is left to shooting, which finds what grows or decays slowly
constexpr double kSoonest = 0.6, kLatest = 1.7;  // of the expected period: returns to a section

// Weights of four motions, a step apart, for one between the second and the third. @param share  of the way, 0 to 1
Eigen::Vector4d cubic_weights(double share) {
  const double u = share;
  return {-u * (u - 1) * (u - 2) / 6, (u + 1) * (u - 1) * (u - 2) / 2, -(u + 1) * u * (u - 2) / 2,
          (u + 1) * u * (u - 1) / 6};
}

// The last four motions, a step apart, and how far each is beyond a section.
struct LastMotions {
  std::vector<Motion> motions;
  Eigen::Vector4d beyond = Eigen::Vector4d::Zero();

  void add(Motion motion, double how_far) {
    if (motions.size() == 4) motions.erase(motions.begin());
    motions.push_back(std::move(motion));
    beyond.head<3>() = beyond.tail<3>().eval();
    beyond[3] = how_far;
  }
  [[nodiscard]] bool pass_between_the_middle_ones() const {
    return motions.size() == 4 && beyond[1] < 0 && beyond[2] >= 0;
  }
  // Where the cubic through the four passes the section, between the middle ones.
  [[nodiscard]] double share_of_passage() const {
    double low = 0, high = 1;
    for (int halvings = 0; halvings < 50; ++halvings) {
      const double middle = (low + high) / 2;
      (cubic_weights(middle).dot(beyond) < 0 ? low : high) = middle;
    }
    return (low + high) / 2;
  }
};

}  // namespace

PeriodMap::PeriodMap(MachineRun& run, double period, const std::atomic<bool>* stop)
    : run_(run), period_(period), stop_(stop), swing_(run.mechanism(), period), end_(run.state().t) {}

Motion PeriodMap::motion() {
  Motion motion = returned_ ? *returned_ : run_.motion();
  motion.swinging = swing_.swinging();
  return motion;
}

Outcome PeriodMap::take() {
  if (section_) return take_to_section();
  end_ += period_;
  swing_.begin(run_.state());
  if (steps_ == 0) return take_steps(end_);
  const double start = end_ - period_;
  for (int k = 1; k <= steps_; ++k)
    if (Outcome steps = take_steps(start + k * period_ / steps_); !steps.solved()) return steps;
  return {Ending::solved};
}

Outcome PeriodMap::take_steps(double end) {
  while (run_.state().t < end - run_.slack()) {
    if (stop_ != nullptr && stop_->load()) return no_answer<Outcome>("it was stopped");
    if (Outcome step = run_.step(end); !step.solved()) return step;
    swing_.take(run_.state());
  }
  return {Ending::solved};
}

// (integrator.47)
Outcome PeriodMap::take_to_section() {
  if (returned_) run_.move_to(with_rings_of_the_machine(*returned_));
  returned_.reset();
  const double start = run_.state().t, step = period_ / steps_;
  swing_.begin(run_.state());
  first_ = run_.motion();
  LastMotions last;
  for (int k = 1; k <= kLatest * steps_; ++k) {
    if (Outcome steps = take_steps(start + k * step); !steps.solved()) return steps;
    end_ = run_.state().t;
    if (k == 1) second_ = run_.motion();
    if (k < kSoonest * steps_) continue;
    Motion now = run_.motion();
    const double beyond = beyond_section(now);
    last.add(std::move(now), beyond);
    if (!last.pass_between_the_middle_ones()) continue;
    const double share = last.share_of_passage();
    period_ = (k - 2 + share) * step;
    returned_ = combine(mechanism(), last.motions, cubic_weights(share));
    returned_->swinging = swing_.swinging();
    return {Ending::solved};
  }
  return no_answer<Outcome>(fmt::format("the motion does not return within {:.3g} s", kLatest * period_));
}

void PeriodMap::lay_section_at_start() {
  section_ = Section{first_, second_, swing_.sizes(), way(first_, second_).head(coordinates())};
}

Motion PeriodMap::onto_section(const Motion& motion) const {
  const double beyond = beyond_section(motion);
  return combine(mechanism(), {motion, section_->next, section_->at}, Eigen::Vector3d(1, -beyond, beyond));
}

// Over periods that are not quite those of the motion how far it goes depends on where they begin: the farthest of a
// few counts.
Outcome PeriodMap::wait_while_it_grows(int most) {
  HERSEY_REQUIRE(steps_ > 0 && !section_, "the period is divided into steps, and there is no section yet");
  const Eigen::VectorXd scales = mechanism().position_scales();
  double before = 0;
  for (int periods = 0; periods < most; periods += kGrowing) {
    double farthest = 0;
    for (int k = 0; k < kGrowing; ++k) {
      if (Outcome period = take(); !period.solved()) return period;
      farthest = std::max(farthest, swing_.ways().cwiseQuotient(scales).norm());
    }
    if (farthest < kGrows * before) break;
    before = farthest;
  }
  return {Ending::solved};
}

Outcome PeriodMap::lay_section(int most, const std::function<void()>& on_period) {
  HERSEY_REQUIRE(steps_ > 0, "the period is divided into steps");
  for (int periods = 0; periods < most; ++periods) {
    const Motion start = run_.motion();
    if (Outcome period = take(); !period.solved() && !section_) return period;
    if (on_period) on_period();
    Motion end = run_.motion();
    end.swinging = swing_.swinging();
    if (swing_.is_rest()) return no_answer<Outcome>("the machine comes to rest: it does not oscillate");
    const bool nearly_returns = section_ && returned_ && way(start, end).head(coordinates()).norm() < kNearlyReturns;
    section_.reset();
    returned_.reset();
    const double step = period_ / steps_, here = run_.state().t;
    if (Outcome steps = take_steps(here + step); !steps.solved()) return steps;
    end_ = run_.state().t;
    const Motion next = run_.motion();
    section_ = Section{end, next, swing_.sizes(), way(end, next).head(coordinates())};
    run_.move_to(with_rings_of_the_machine(end));
    if (nearly_returns) return {Ending::solved};
  }
  return no_answer<Outcome>(fmt::format("no motion that nearly repeats has been found within {} periods", most));
}

// In steps there.
double PeriodMap::beyond_section(const Motion& motion) const {
  Eigen::VectorXd way = way_between(mechanism(), section_->at, motion).head(coordinates());
  way.array() /= section_->sizes.array();
  return way.dot(section_->direction) / section_->direction.squaredNorm();
}

Motion PeriodMap::with_rings_of_the_machine(const Motion& motion) const {
  return with_rings_at(mechanism(), run_.state().q, section_->sizes, motion);
}

Outcome PeriodMap::take_from(const Motion& start) {
  Archive before;
  run_.persist(before);
  const std::optional<Motion> returned = std::exchange(returned_, std::nullopt);
  const double period_before = period_;
  run_.move_to(section_ ? with_rings_of_the_machine(start) : start);
  const double begun = end_;
  Outcome period = take();
  if (period.solved()) return period;
  Archive archive(before.content());
  run_.restore(archive);
  returned_ = returned;
  period_ = period_before;
  end_ = section_ ? run_.state().t : begun;
  return period;
}

Eigen::Index PeriodMap::dimension() {
  const Motion here = run_.motion();
  if (way_between(mechanism(), here, here).size() > coordinates()) return std::numeric_limits<Eigen::Index>::max();
  const Eigen::VectorXd ways = swing_.ways();
  return 2 * (ways.array() > 0).count() - (section_ ? 1 : 0);
}

Eigen::VectorXd PeriodMap::way(const Motion& from, const Motion& to) const {
  Eigen::VectorXd way = way_between(mechanism(), from, to);
  compare_by_swing(way);
  return way;
}

void PeriodMap::compare_by_swing(Eigen::VectorXd& way) const {
  way.head(coordinates()).array() /= swing_.sizes().array();
}

}  // namespace hersey::run
