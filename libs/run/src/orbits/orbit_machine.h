#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hersey/model/model.h"
#include "hersey/run/orbits.h"
#include "record/recorder.h"
#include "time_stepping/machine_run.h"
#include "time_stepping/period_map.h"

namespace hersey::run {

/// A machine whose periods are trials of its periodic motion, and what is observed of them.
class OrbitMachine {
 public:
  /// @param steps  of one length in each period; 0: as many as the model's step suggests
  /// @param period  about that of a machine that oscillates by itself; 0: the model's
  OrbitMachine(model::Model model, int steps, double period, const std::atomic<bool>* stop);
  OrbitMachine(const OrbitMachine&) = delete;
  OrbitMachine& operator=(const OrbitMachine&) = delete;
  OrbitMachine(OrbitMachine&&) = delete;
  OrbitMachine& operator=(OrbitMachine&&) = delete;
  ~OrbitMachine() = default;

  [[nodiscard]] PeriodMap& map() { return map_; }
  [[nodiscard]] int steps() const { return steps_; }

  /// Names of what can be observed: numbers of the results' rows, "bearings.main.eccentricity.x".
  [[nodiscard]] std::vector<ObservedQuantity> quantities() const;
  /// Observes these from here on, extremes anew. @throws InputError naming the nearest if there is none of a name
  void observe(const std::vector<ObservedQuantity>& wanted);
  [[nodiscard]] const std::vector<Excursion>& excursions() const { return excursions_; }

 private:
  // A number of the results' rows.
  struct Number {
    ObservedQuantity quantity;
    std::size_t row, index;
  };
  [[nodiscard]] std::vector<Number> numbers() const;
  void take_excursions();

  int steps_;
  model::Model model_;
  Options options_;
  MachineRun run_;
  Recorder snapshot_;
  PeriodMap map_;
  std::vector<Number> observed_;
  std::vector<Excursion> excursions_;
};

}  // namespace hersey::run
