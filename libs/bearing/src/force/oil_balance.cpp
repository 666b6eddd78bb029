#include "force/oil_balance.h"

#include <algorithm>
#include <cmath>

#include "hersey/film/observables.h"

namespace hersey::bearing {

void OilBalance::initialise(const film::FilmModel& model, const film::SurfaceMotion& motion,
                            const film::FilmHistory& history, const Eigen::VectorXd& u) {
  step_ = film::oil_at_start(model, motion, history, u);
  run_ = {};
  run_.volume = step_.volume;
}

void OilBalance::close_step(film::Reynolds& reynolds, const film::SurfaceMotion& motion,
                            const film::FilmHistory& history, const Eigen::VectorXd& u) {
  reynolds.settle(motion, history, u, step_);
}

void OilBalance::close_step(film::Reynolds& reynolds) { reynolds.settle(step_); }

void OilBalance::accumulate(double dt) {
  const double in = step_.flow_supply, out = step_.flow_out();
  run_.step_error = step_.volume - run_.volume - dt * (in - out);
  run_.unexplained += run_.step_error;
  run_.through_flow += dt * std::max(std::abs(in), std::abs(out));
  run_.volume = step_.volume;
}

void OilBalance::report_flows(double dt, double sliding_flow, film::FilmObservables& film) const {
  if (step_.flow_features.size() != film.flow_features.size() || dt == 0) return;
  film.flow_left = step_.flow_left, film.flow_right = step_.flow_right, film.flow_first = step_.flow_first,
  film.flow_last = step_.flow_last;
  film.flow_supply = step_.flow_supply, film.flow_features = step_.flow_features;
  film.storage_rate = step_.flow_supply - step_.flow_out() + run_.step_error / dt;
  double scale =
      std::max({std::abs(step_.flow_left), std::abs(step_.flow_right), std::abs(step_.flow_first),
                std::abs(step_.flow_last), std::abs(step_.flow_supply), std::abs(film.storage_rate), sliding_flow});
  if (step_.flow_features.size() > 0) scale = std::max(scale, step_.flow_features.cwiseAbs().maxCoeff());
  film.mass_balance_error = scale > 0 ? std::abs(run_.step_error) / (scale * dt) : 0;
}

void OilBalance::persist(Archive& archive) {
  archive.io("oil_volume", run_.volume);
  archive.io("oil_through_flow", run_.through_flow);
  archive.io("oil_unexplained", run_.unexplained);
}

}  // namespace hersey::bearing
