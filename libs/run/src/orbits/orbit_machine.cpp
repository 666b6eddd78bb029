#include "orbits/orbit_machine.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hersey/core/input_error.h"
#include "hersey/core/spelling.h"

namespace hersey::run {
namespace {

constexpr double kLongestStep = 1.5;  // of those into which a period is divided: no planned instant comes between
constexpr double kManyPeriods = 1e4;  // none of a branch ends a run

model::Model without_end(model::Model model, int steps, double period) {
  model::Cycle& cycle = *model.simulation.cycle;
  if (period > 0) cycle.period = period;
  model.simulation.step = kLongestStep * cycle.period / steps;
  model.simulation.duration = kManyPeriods * cycle.period;
  cycle.lead_in = model::LeadIn::none;
  cycle.tolerance = 0;
  model.output.meshes_at.clear();  // files besides the results
  model.output.fields_every = model.simulation.duration;
  return model;
}

int steps_of(const model::Model& model) {
  return std::max(1, static_cast<int>(std::lround(model.simulation.cycle->period / model.simulation.step)));
}

// Of joints with translations and rotations each column has its own.
std::string unit_of(const results::LatestRow& row, const std::string& component) {
  if (row.unit != "SI") return row.unit;
  const std::string unit = component.find("rotation") != std::string::npos ? "rad" : "m";
  return row.path.ends_with("/rates") ? unit + "/s" : unit;
}

std::string dotted_path(const std::string& path) {
  std::string name = path.substr(1);
  std::ranges::replace(name, '/', '.');
  return name;
}

}  // namespace

OrbitMachine::OrbitMachine(model::Model model, int steps, double period, const std::atomic<bool>* stop)
    : steps_(steps > 0 ? steps : steps_of(model)),
      model_(without_end(std::move(model), steps_, period)),
      run_(model_, options_),
      snapshot_(model_, run_.machine(), run_.state(), Options{}),
      map_(run_, model_.simulation.cycle->period, stop) {
  run_.begin();
  map_.divide(steps_);
  options_.on_progress = [this](const Progress&) { take_excursions(); };
}

std::vector<OrbitMachine::Number> OrbitMachine::numbers() const {
  std::vector<Number> numbers;
  for (std::size_t k = 0; k < snapshot_.latest().size(); ++k) {
    const results::LatestRow& row = snapshot_.latest()[k];
    // Fields and cycles have instants of their own.
    const bool is_of_steps = row.path.find("/fields/") == std::string::npos &&
                             row.path.find("/cycles/") == std::string::npos && row.path != "/time";
    if (!is_of_steps) continue;
    const std::string path = dotted_path(row.path);
    if (row.shape.empty()) numbers.push_back({{path, row.unit}, k, 0});
    for (std::size_t i = 0; i < row.components.size(); ++i)
      numbers.push_back({{path + "." + row.components[i], unit_of(row, row.components[i])}, k, i});
  }
  return numbers;
}

std::vector<ObservedQuantity> OrbitMachine::quantities() const {
  std::vector<ObservedQuantity> quantities;
  for (const Number& number : numbers()) quantities.push_back(number.quantity);
  return quantities;
}

void OrbitMachine::observe(const std::vector<ObservedQuantity>& wanted) {
  observed_.clear();
  excursions_.clear();
  const std::vector<Number> known = numbers();
  for (const ObservedQuantity& quantity : wanted) {
    const auto number =
        std::ranges::find_if(known, [&](const Number& one) { return one.quantity.name == quantity.name; });
    if (number != known.end()) {
      observed_.push_back(*number);
      continue;
    }
    std::vector<std::string> names;
    for (const Number& one : known) names.push_back(one.quantity.name);
    throw InputError(Fault{{"--observe", 0, 0},
                           "",
                           "no quantity '" + quantity.name + "'",
                           "a number of the results' rows, such as " + names.back(),
                           did_you_mean(quantity.name, names)});
  }
}

void OrbitMachine::take_excursions() {
  if (observed_.empty()) return;
  snapshot_.write_row(run_.last_step(), run_.energy());
  const bool is_first = excursions_.empty();
  excursions_.resize(observed_.size());
  for (std::size_t k = 0; k < observed_.size(); ++k) {
    const double value = snapshot_.latest()[observed_[k].row].values[observed_[k].index];
    Excursion& excursion = excursions_[k];
    excursion = is_first ? Excursion{value, value}
                         : Excursion{std::min(excursion.lowest, value), std::max(excursion.highest, value)};
  }
}

}  // namespace hersey::run
