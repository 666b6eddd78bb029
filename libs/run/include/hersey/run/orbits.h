#pragma once

#include <atomic>
#include <complex>
#include <functional>
#include <string>
#include <vector>

#include "hersey/core/outcome.h"
#include "hersey/model/model.h"

/// Branches of periodic motions: a machine's orbits over one of its parameters, stable or not (theory manual,
/// integrator.48).
namespace hersey::run {

/// Extremes of a quantity of the results over a period.
struct Excursion {
  double lowest = 0, highest = 0;
  /// Returns the difference of the two.
  [[nodiscard]] double peak_to_peak() const { return highest - lowest; }
};

/// A periodic motion at one value of the parameter.
struct OrbitAtValue {
  double value = 0;                               ///< of the parameter
  double period = 0;                              ///< [s]
  std::vector<std::complex<double>> multipliers;  ///< the largest first, of a conjugate pair one
  std::vector<Excursion> excursions;              ///< of each observed quantity
  int periods = 0;                                ///< run to find it and its multipliers
  /// True if no small deviation grows.
  [[nodiscard]] bool is_stable() const { return multipliers.empty() || std::abs(multipliers.front()) <= 1; }
};

/// Change of a branch where a multiplier crosses the unit circle.
enum class Bifurcation {
  fold,             ///< +1, and the branch turns back: a machine that comes along it jumps
  branching,        ///< +1, and it goes on: other branches cross it
  period_doubling,  ///< -1: a motion of twice the period branches off
  torus,            ///< a conjugate pair (Neimark and Sacker): a second frequency sets in, such as oil whirl
};

struct BifurcationAt {
  Bifurcation kind = Bifurcation::fold;
  std::size_t behind = 0;  ///< index of the orbit before it
  double value = 0;        ///< of the parameter
  double frequency = 0;    ///< of a torus, that which sets in; of the two that alias the slower one [Hz]
};

/// A quantity that is observed along a branch.
struct ObservedQuantity {
  std::string name, unit;  ///< "bearings.main.eccentricity.x", SI
};

/// Orbits in the order in which they follow each other; the message tells where and why the branch ends.
struct [[nodiscard]] Branch : Outcome {
  std::vector<ObservedQuantity> observed;
  std::vector<OrbitAtValue> orbits;
  std::vector<BifurcationAt> bifurcations;
};

struct BranchOptions {
  double from = 0, to = 0;  ///< range of the parameter; the branch begins at `from` and ends where it leaves the range
  double step = 0.05;       ///< largest, as a share of the range
  int most = 200;           ///< orbits
  double tolerance = 1e-4;  ///< of the distance from the periodic motion, in shares of every coordinate's swing
  int multipliers = 2;      ///< of each orbit, >= 1
  std::vector<std::string> observed;        ///< quantities, "joints.slide.coordinates"; empty: eccentricity, smallest
                                            ///< thickness and largest pressure of all films, else all joints
  const std::atomic<bool>* stop = nullptr;  ///< set from outside: it ends with the orbit before
  std::function<void(const OrbitAtValue&)> on_orbit;  ///< called with each that has been found
};

/// Follows the periodic motions of a machine over a parameter, through folds, where orbits turn unstable, and past
/// bifurcations, which it locates. The first orbit is found from the model's start, as by `lead_in: shooting`.
/// @param model_at  the model at a value of the parameter, with cycles that are found by shooting
/// @returns unsolved, with the reason, if there is no first orbit
/// @throws InputError as model_at; where an observed quantity is none of the results
/// @verified_by orbits_test.cpp, tests/cli/orbits_test.py
[[nodiscard]] Branch follow_branch(const std::function<model::Model(double)>& model_at, const BranchOptions& options);

}  // namespace hersey::run
