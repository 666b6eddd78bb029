#include "time_stepping/period_map.h"

#include <utility>

namespace hersey::run {

PeriodMap::PeriodMap(MachineRun& run, double period, const std::atomic<bool>* stop)
    : run_(run), period_(period), stop_(stop), swing_(run.mechanism(), period), end_(run.state().t) {}

Outcome PeriodMap::take() {
  end_ += period_;
  swing_.begin(run_.state());
  while (run_.state().t < end_ - run_.slack()) {
    if (stop_ != nullptr && stop_->load()) return no_answer<Outcome>("it was stopped");
    if (Outcome step = run_.step(end_); !step.solved()) return step;
    swing_.take(run_.state());
  }
  return {Ending::solved};
}

Outcome PeriodMap::take_from(const Motion& start) {
  Archive before;
  run_.persist(before);
  run_.move_to(start);
  Outcome period = take();
  if (period.solved()) return period;
  Archive archive(before.content());
  run_.restore(archive);
  end_ -= period_;
  return period;
}

Eigen::VectorXd PeriodMap::way(const Motion& from, const Motion& to) {
  Eigen::VectorXd way = way_between(mechanism(), from, to);
  compare_by_swing(way);
  return way;
}

void PeriodMap::compare_by_swing(Eigen::VectorXd& way) { way.head(coordinates()).array() /= swing_.sizes().array(); }

}  // namespace hersey::run
