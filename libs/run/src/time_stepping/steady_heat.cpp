#include "time_stepping/steady_heat.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "hersey/solver/fixed_point_iteration.h"
#include "time_stepping/warm_bodies.h"

namespace hersey::run {
namespace {

// Changes of temperatures over the largest rise (plus 1 K) at which the search ends, and iterations after which it is
// given up.
constexpr double kNearTemperatures = 1e-8;
constexpr int kMostAlternations = 150;

// Changes of the iteration that are remembered; films are solved far nearer than temperatures have to come.
constexpr solver::ChangesKept kAlternationsKept{.most = 60, .noise = 1e-11};

// After so many iterations what none of them resembles goes this fraction of its way only.
struct Restraint {
  int iteration;
  double relaxation;
};
constexpr std::array kRestraints{Restraint{15, 0.3}, Restraint{30, 0.1}, Restraint{60, 0.03}};

// Times that temperatures at which no motion is found are halved towards the last ones at which one was.
constexpr int kMostHalvings = 12;

// Between which the circuit's oil stays on the way to a solution [K]: laws of viscosity mean nothing far beyond.
constexpr double kColdestNode = 200, kHottestNode = 600;

class WarmSearch {
 public:
  WarmSearch(solver::Equations& equations, model::Machine& machine, solver::State& state,
             const solver::EquilibriumOptions& options)
      : equations_(equations),
        machine_(machine),
        state_(state),
        options_(options),
        mixing_(solver::Acceleration::quasi_newton, 1, kAlternationsKept) {
    for (const model::BuiltBearing& built : machine.bearings)
      if (built.bearing->heat() != nullptr) films_.push_back(built.bearing.get());
    if (machine.circuit && machine.circuit->heat() != nullptr) circuit_ = machine.circuit.get();
  }

  solver::EquilibriumSummary run() {
    if (films_.empty() && circuit_ == nullptr) return solver::find_equilibrium(equations_, state_, options_);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(temperatures().size()), last;
    int iterations = 0, halvings = 0;
    for (int k = 0; k < kMostAlternations; ++k) {
      set_temperatures(x);
      solver::EquilibriumSummary found = solver::find_equilibrium(equations_, state_, options_);
      found.iterations = iterations += found.iterations;
      if (!found.solved()) {
        if (last.size() == 0 || ++halvings > kMostHalvings) return found;
        x = 0.5 * (x + last);
        mixing_.begin_step();
        continue;
      }
      warm_bodies(machine_, 0);
      mix_grooves(machine_);
      const Eigen::VectorXd image = temperatures();
      if ((image - x).cwiseAbs().maxCoeff() <= kNearTemperatures * (1 + image.cwiseAbs().maxCoeff())) return found;
      last = x;
      for (const Restraint& restraint : kRestraints)
        if (restraint.iteration == k) mixing_.set_relaxation_of_unknown(restraint.relaxation);
      x = k == 0 ? guess() : mixing_.next(x, image);
    }
    solver::EquilibriumSummary none;
    none.iterations = iterations;
    none.message =
        fmt::format("motion and temperatures do not converge in {} iterations; the hottest oil has {:.0f} degC",
                    kMostAlternations, hottest() - film::zero_celsius);
    return none;
  }

 private:
  /// Of all films, one after the other, and of the circuit.
  [[nodiscard]] Eigen::VectorXd temperatures() const {
    Eigen::VectorXd all;
    for (const bearing::FilmForce* film : films_) {
      const Eigen::VectorXd own = film->temperatures();
      all.conservativeResize(all.size() + own.size());
      all.tail(own.size()) = own;
    }
    if (circuit_ != nullptr) {
      const Eigen::VectorXd rise = circuit_->observation().temperatures - circuit_->heat()->T;
      all.conservativeResize(all.size() + rise.size());
      all.tail(rise.size()) = rise;
    }
    return all;
  }

  void set_temperatures(const Eigen::VectorXd& x) {
    Eigen::Index first = 0;
    for (bearing::FilmForce* film : films_) {
      const Eigen::Index count = film->temperatures().size();
      film->set_temperatures(x.segment(first, count));
      first += count;
    }
    if (circuit_ == nullptr) return;
    const auto within_trials = [](double T) { return std::clamp(T, kColdestNode, kHottestNode); };
    circuit_->set_temperatures((circuit_->heat()->T + x.tail(circuit_->circuit().size())).unaryExpr(within_trials));
  }

  /// What cold films have made, reduced as their oil thins.
  Eigen::VectorXd guess() {
    for (bearing::FilmForce* film : films_) film->guess_temperatures();
    return temperatures();
  }

  [[nodiscard]] double hottest() const {
    double T = 0;
    for (const bearing::FilmForce* film : films_) T = std::max(T, film->heat()->observables().T_max);
    return T;
  }

  solver::Equations& equations_;
  model::Machine& machine_;
  solver::State& state_;
  solver::EquilibriumOptions options_;
  std::vector<bearing::FilmForce*> films_;
  bearing::OilCircuit* circuit_ = nullptr;  // with temperatures
  solver::FixedPointIteration mixing_;
};

}  // namespace

solver::EquilibriumSummary find_warm_steady_motion(model::Machine& machine, solver::State& state,
                                                   const solver::EquilibriumOptions& options) {
  return find_warm_steady_motion(*machine.mechanism, machine, state, options);
}

solver::EquilibriumSummary find_warm_steady_motion(solver::Equations& equations, model::Machine& machine,
                                                   solver::State& state, const solver::EquilibriumOptions& options) {
  return WarmSearch(equations, machine, state, options).run();
}

}  // namespace hersey::run
