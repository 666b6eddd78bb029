#include "steady/temperature_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include "gap/oil_temperatures.h"
#include "heat/film_temperatures.h"
#include "kinds/journal/short_bearing.h"

namespace hersey::bearing {
namespace {

// Number of iterations that are remembered: of axial waves of temperature in a long film there are many, and each makes
// the next iteration's ten times as large as long as it is not known. Films are solved far nearer than temperatures
// have to come.
constexpr solver::ChangesKept kTurnsKept{.most = 60, .noise = 1e-11};

// After so many iterations what none of them resembles goes this fraction of its way only.
struct Caution {
  int iteration;
  double relaxation;
};
constexpr std::array kCaution{Caution{15, 0.3}, Caution{30, 0.1}, Caution{60, 0.03}};

// Where the answer has a kink, what iterations on either side of it have shown leads astray: after so many this
// fraction of all of the way, from the nearest that was found.
constexpr int kAcceleratedIterations = 120;
constexpr double kSlowRelaxation = 0.3;

// These lead away where they end so many times further from what they make.
constexpr double kAway = 10;

constexpr int kMostStepsBack = 12;

}  // namespace

TemperaturePath::TemperaturePath(const film::FilmModel& model, const film::ThermalModel& thermal,
                                 const OperatingPoint& point, const std::optional<film::HeatState>& start)
    : model_(model),
      thermal_(thermal),
      heat_(model, thermal),
      mixing_(solver::Acceleration::quasi_newton, 1, kTurnsKept) {
  if (const auto* body = std::get_if<film::BodyWall>(&thermal.shell); body != nullptr && body->conduction->deforms())
    per_watt_ = body->conduction->rise.rowwise().sum().mean();
  if (const auto* body = std::get_if<film::BodyJournal>(&thermal.journal);
      body != nullptr && body->conduction->deforms())
    journal_per_watt_ = body->conduction->rise;
  if (thermal.expansion) {
    const double largest = std::max(std::abs(thermal.expansion->shell), std::abs(thermal.expansion->journal));
    if (largest > 0) per_metre_ = 1 / (model.R * largest);
  }
  growth_ = called_for();
  if (start) {
    heat_.set_state(*start);
    growth_ = called_for();
    tried_ = unknowns(growth_);
  } else {
    // Flat films begin with oil as it is supplied: their heat follows from the film thickness that is sought.
    const bool is_bore = std::holds_alternative<film::Cylinder>(model.surface);
    fill(is_bore ? likely_temperature(model, thermal.T_supply, point) : thermal.T_supply);
  }
}

// By the walls as they are now (thermal.42).
double TemperaturePath::called_for() const {
  if (per_metre_ == 0) return 0;
  const film::HeatObservables& observed = heat_.observables();
  return thermal_.expansion->growth(model_.R, observed.T_shell_wall, observed.T_journal_wall);
}

void TemperaturePath::fill(double T_oil) {
  T_oil_ = T_oil;
  film::HeatState state = heat_.state();
  state.film.setConstant(T_oil);
  try_next(std::move(state), growth_);
}

Eigen::VectorXd TemperaturePath::unknowns(double growth) const {
  const film::HeatState& now = heat_.state();
  const Eigen::VectorXd film = film_temperatures(heat_);
  Eigen::VectorXd x(film.size() + shape_unknowns() + journal_unknowns() + growth_unknowns());
  x << film, per_watt_ * now.wall_heat.head(shape_unknowns()),
      Eigen::VectorXd::Constant(journal_unknowns(), journal_per_watt_ * now.journal_heat),
      Eigen::VectorXd::Constant(growth_unknowns(), per_metre_ * growth);
  return x;
}

Eigen::Index TemperaturePath::shape_unknowns() const { return per_watt_ > 0 ? heat_.state().wall_heat.size() : 0; }

Eigen::Index TemperaturePath::growth_unknowns() const { return per_metre_ > 0 ? 1 : 0; }

void TemperaturePath::try_next(const Eigen::VectorXd& x) {
  const Eigen::Index film = x.size() - shape_unknowns() - journal_unknowns() - growth_unknowns();
  set_film_temperatures(x.head(film), heat_);
  film::HeatState next = heat_.state();
  if (per_watt_ > 0) next.wall_heat = x.segment(film, shape_unknowns()) / per_watt_;
  if (journal_per_watt_ > 0) next.journal_heat = x[film + shape_unknowns()] / journal_per_watt_;
  try_next(std::move(next), per_metre_ > 0 ? x[x.size() - 1] / per_metre_ : 0);
}

void TemperaturePath::begin_at(const TemperaturePath& other, const film::GridTransfer& transfer) {
  T_oil_.reset();
  film::HeatState state = heat_.state();
  state.film = transfer(other.heat_.state().film, thermal_.layers);
  state.ends = other.heat_.state().ends;
  const auto ends = static_cast<Eigen::Index>(state.ends.size());
  const Eigen::Index film = layer_temperatures(heat_), thinning = shear_temperatures(heat_);
  const Eigen::Index film_there = layer_temperatures(other.heat_), thinning_there = shear_temperatures(other.heat_);
  try_next(std::move(state), growth_);
  mixing_.learn_from(other.mixing_, [&](const Eigen::VectorXd& x) {
    Eigen::VectorXd here(film + thinning + ends);
    here.head(film) = transfer(x.head(film_there), thermal_.layers);
    here.tail(ends) = x.tail(ends);
    if (thinning == 0) return here;
    // Of the layers' viscosities, then of each node's two factors of flow.
    here.segment(film, film) = transfer(x.segment(film_there, film_there), thermal_.layers);
    here.segment(2 * film, thinning - film) = transfer(x.segment(2 * film_there, thinning_there - film_there), 2);
    return here;
  });
}

void TemperaturePath::try_next(film::HeatState next, double growth) {
  next.film = next.film.cwiseMax(coldest_trial).cwiseMin(hottest_trial);
  heat_.set_state(next);
  growth_ = growth;
  tried_ = unknowns(growth);
}

void TemperaturePath::take() {
  last_ = tried_;
  image_ = unknowns(called_for());
  relative_distance_ = std::min(1.0, (image_ - last_).cwiseAbs().maxCoeff() / (1 + image_.cwiseAbs().maxCoeff()));
  if (nearest_.x.size() == 0 || relative_distance_ <= nearest_.relative_distance)
    nearest_ = {last_, image_, relative_distance_};
}

void TemperaturePath::step_on(int iteration) {
  for (const Caution& caution : kCaution) {
    if (iteration == caution.iteration) mixing_.set_relaxation_of_unknown(caution.relaxation);
  }
  if (T_oil_) {
    try_next(film::first_guess(model_, thermal_, *T_oil_, heat_.state()), called_for());
    nearest_ = {};
  } else if (iteration == kAcceleratedIterations) {
    mixing_ = solver::FixedPointIteration(solver::Acceleration::constant, kSlowRelaxation);
    is_accelerated_ = false;
    try_next(mixing_.next(nearest_.x, nearest_.image));
  } else {
    try_next(mixing_.next(last_, image_));
  }
  T_oil_.reset();
}

bool TemperaturePath::leads_away() const {
  return !is_accelerated_ && relative_distance_ > kAway * nearest_.relative_distance;
}

bool TemperaturePath::step_back() {
  if (last_.size() == 0) {
    if (!T_oil_ || *T_oil_ == thermal_.T_supply) return false;
    fill(thermal_.T_supply);
    return true;
  }
  if (++steps_back_ > kMostStepsBack) return false;
  const Eigen::VectorXd half = 0.5 * (tried_ + last_);
  mixing_.begin_step();
  try_next(half);
  return true;
}

}  // namespace hersey::bearing
