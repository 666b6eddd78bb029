#include "record/run_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hersey/bearing/clearance.h"
#include "hersey/film/cavitated_shear.h"
#include "hersey/model/plausibility.h"
#include "record/coarser_run.h"

namespace hersey::run {
namespace {

std::vector<std::string> names_of_meshes(const model::Machine& machine) {
  std::vector<std::string> names;
  for (const model::BuiltMesh& mesh : machine.gear_meshes) names.push_back(mesh.name);
  return names;
}

}  // namespace

RunRecord::RunRecord(const model::Model& model, const model::Machine& machine, const solver::State& start,
                     const Options& options, bool resumes)
    : model_(model),
      options_(options),
      recorder_(model, machine, start, options, resumes),
      deformed_(model, machine, options.results),
      settling_(model),
      cycles_(model),
      parted_(names_of_meshes(machine)),
      energy_(machine.mechanism->spec()) {
  for (const model::Bearing& bearing : model.bearings) extremes_.emplace_back(bearing.name);
}

void RunRecord::take(const StepRecord& step) {
  const double t = step.mechanism.t;
  if (step.dt > 0) ++steps_;
  newton_iterations_ += step.newton_iterations;
  step_error_ = std::max(step_error_, step.step_error);
  constraint_drift_ = std::max(constraint_drift_, step.constraint_drift);
  largest_power_ = std::max(largest_power_, step.power.largest());
  largest_error_ = std::max(largest_error_, std::abs(step.power.error()));
  for (std::size_t i = 0; i < extremes_.size(); ++i) extremes_[i].take(t, step.dt, step.bearings[i]);
  if (model_.circuit) take_starvation(step);
  parted_.take(step.meshes, step.dt);
  energy_.take(step);
  settled_ = settling_.settled(step);
  recorder_.gather(step);
  if (cycles_.ends(t)) end_cycle(t);
  write(step);
}

// An instant by itself, such as a steady motion, counts as all of the time.
void RunRecord::take_starvation(const StepRecord& step) {
  const bearing::CircuitObservation& circuit = step.circuit;
  if (starved_time_.size() == 0 || (circuit_time_ == 0 && step.dt > 0)) {
    starved_time_.setZero(circuit.fills.size());
    lowest_fill_ = circuit.fills, lowest_at_axis_ = circuit.axis_pressures;
  }
  lowest_fill_ = lowest_fill_.cwiseMin(circuit.fills);
  lowest_at_axis_ = lowest_at_axis_.cwiseMin(circuit.axis_pressures);
  const Eigen::VectorXd starved = (circuit.fills.array() < 1).cast<double>();
  if (step.dt > 0)
    starved_time_ += step.dt * starved, circuit_time_ += step.dt;
  else if (circuit_time_ == 0)
    starved_time_ = starved;
}

std::vector<std::string> RunRecord::starvation_warnings(const model::Bearing& bearing) const {
  std::vector<std::string> warnings;
  if (!model_.circuit || starved_time_.size() == 0) return warnings;
  const circuit::Network& network = model_.circuit->network;
  for (const model::CircuitPort& port : bearing.circuit_ports) {
    const auto node = static_cast<Eigen::Index>(port.node);
    const double time = circuit_time_ > 0 ? starved_time_[node] / circuit_time_ : starved_time_[node];
    if (time > 0)
      warnings.push_back(fmt::format(
          "feed '{}': node '{}' of the circuit gets less oil {:.3g} % of the time than films and elements would take: "
          "it lies at the cavitation pressure, filled down to {:.3g} %",
          bearing.film.features[port.feature].name, network.nodes[port.node].name, 100 * time,
          100 * lowest_fill_[node]));
    Eigen::Index passing = 0;
    for (const circuit::Element& element : network.elements) {
      if (!element.passes_axis) continue;
      const double lowest = lowest_at_axis_[passing++];
      if (element.to != port.node || lowest >= bearing.film.p_cav) continue;
      warnings.push_back(
          fmt::format("feed '{}': in drilling '{}' the pressure at the axis falls to {:.3g} bar, below the cavitation "
                      "pressure: its "
                      "oil does not hold together there, and what it is said to carry is too much",
                      bearing.film.features[port.feature].name, element.name, 1e-5 * lowest));
    }
  }
  return warnings;
}

void RunRecord::end_cycle(double t) {
  last_cycle_ = cycles_.take(recorder_.close_cycle());
  recorder_.write_cycle(t, last_cycle_.value);
  if (options_.on_cycle)
    options_.on_cycle({.number = last_cycle_.number, .change = last_cycle_.value, .largest = last_cycle_.largest});
  repeats_ = cycles_.converged(last_cycle_);
}

std::string RunRecord::ending(double t) const {
  if (settled_) return fmt::format("settled at t = {:.6g} s", t);
  const double change = 100 * last_cycle_.value;
  if (repeats_)
    return fmt::format("converged in cycle {}: {:.2g} % ({})", last_cycle_.number, change, last_cycle_.largest);
  const auto& plan = model_.simulation.cycle;
  if (!plan || plan->tolerance == 0) return {};
  if (last_cycle_.number < 2) return "fewer than two cycles, of which none can repeat";
  return fmt::format("not converged after {} cycles: {:.2g} %", last_cycle_.number, change);
}

double RunRecord::moft() const {
  double moft = std::numeric_limits<double>::infinity();
  for (const BearingExtremes& bearing : extremes_) moft = std::min(moft, bearing.summary().moft);
  return moft;
}

std::string RunRecord::thin_films() const {
  constexpr double thin = 0.05;  // of the clearance
  std::string text;
  for (std::size_t i = 0; i < extremes_.size(); ++i) {
    const film::FilmModel& film = model_.bearings[i].film;
    const double h = extremes_[i].last_thickness();
    if (h > thin * bearing::clearance(film) || film.asperities.model != film::AsperityModel::none) continue;
    text += fmt::format(
        "; the film of bearing {} is {:.3g} um at its thinnest{}, and nothing else parts its smooth surfaces: "
        "`asperities` let them touch{}",
        model_.bearings[i].name, 1e6 * h,
        model_.bearings[i].kind->has_axis()
            ? fmt::format(" (eccentricity ratio {:.3f})", extremes_[i].summary().eccentricity_ratio)
            : "",
        film.compliance > 0 ? "" : ", a `compliance` spreads the pressure");
  }
  return text;
}

void RunRecord::write(const StepRecord& step) {
  const double t = step.mechanism.t, slack = 1e-9 * model_.simulation.step;
  deformed_.write(t, t - model_.simulation.start, slack, step);
  if (is_row_due(t, slack)) {
    recorder_.write_row(step, energy_.sums());
    last_row_ = t;
  }
  if (are_fields_due(t, slack)) recorder_.write_fields(step);
  recorder_.flush_if_due();
}

// Rows by steps, or at the multiples of an interval and at the end of the run.
bool RunRecord::is_row_due(double t, double slack) {
  const model::Output& output = model_.output;
  if (output.interval <= 0) return steps_ % output.every == 0;
  const double since_start = t - model_.simulation.start;
  const bool is_due = since_start >= next_row_ * output.interval - slack;
  if (is_due) next_row_ = std::floor((since_start + slack) / output.interval) + 1;
  return is_due || ends_run() || since_start >= model_.simulation.duration - slack;
}

bool RunRecord::are_fields_due(double t, double slack) {
  if (t < next_fields_ - slack && !ends_run()) return false;
  const double every = model_.output.fields_every;
  // Counted from here at the start, and after a step longer than the interval.
  next_fields_ = (next_fields_ < t - every ? t : std::max(next_fields_, model_.simulation.start)) + every;
  return true;
}

namespace {

/// States over how much of the gap the cavitated film is sheared, with the result of the other choice; empty if both
/// give the same.
std::string cavitated_shear(const film::FilmModel& film, const BearingSummary& bearing) {
  const double change = bearing.mean_power_other_shear - bearing.mean_power_film;
  if (!(bearing.mean_power_film > 0) || change == 0) return "";
  return fmt::format("{} the mean power loss in the film would be {:.4g} W instead of {:.4g} ({:+.3g} %)",
                     film::choice_in_words(film.cavitated_shear), bearing.mean_power_other_shear,
                     bearing.mean_power_film, 100 * change / bearing.mean_power_film);
}

}  // namespace

void RunRecord::summarise(Summary& summary) const {
  summary.steps = steps_;
  summary.newton_iterations += newton_iterations_;
  summary.cycles = last_cycle_.number;
  summary.cycle_change = last_cycle_.value;
  summary.worst_constraint_drift = constraint_drift_;
  summary.worst_step_error = step_error_;
  summary.worst_power_balance = largest_power_ > 0 ? largest_error_ / largest_power_ : 0;
  summary.energy = energy_.sums();
  for (std::size_t i = 0; i < extremes_.size(); ++i) {
    BearingSummary bearing = extremes_[i].summary();
    const model::Bearing& plan = model_.bearings[i];
    bearing.warnings = model::film_warnings(plan.validity, bearing.T_max, bearing.pofp - plan.film.p_cav);
    for (std::string& warning : model::surface_warnings(plan, bearing.pofp, bearing.moft))
      bearing.warnings.push_back(std::move(warning));
    for (std::string& warning : model::regime_warnings(plan, bearing.reynolds_max, bearing.laminar_share))
      bearing.warnings.push_back(std::move(warning));
    for (std::string& warning : model::rotation_warnings(plan, bearing.turned, bearing.travelled))
      bearing.warnings.push_back(std::move(warning));
    for (std::string& warning : starvation_warnings(plan)) bearing.warnings.push_back(std::move(warning));
    bearing.cavitated_shear = cavitated_shear(plan.film, bearing);
    summary.bearings.push_back(std::move(bearing));
  }
  for (std::size_t i = 0; i < step_errors_.size(); ++i) summary.bearings[i].step_error = step_errors_[i];
}

void RunRecord::declare_cost(const Work& work) {
  if (options_.step_error)
    for (const BearingExtremes& bearing : extremes_) recorder_.write_step_errors(bearing.name(), {});
  recorder_.declare_cost(work);
}

void RunRecord::write_step_errors(const Summary& coarse) {
  for (std::size_t i = 0; i < extremes_.size(); ++i) {
    step_errors_.push_back(step_errors(extremes_[i].summary(), coarse.bearings[i]));
    recorder_.write_step_errors(extremes_[i].name(), step_errors_.back());
  }
}

void RunRecord::finish(results::Status status, const std::string& message, double wall_time, const Work& work) {
  recorder_.finish(status, message, wall_time, work, steps_);
}

void RunRecord::persist(Archive& archive) {
  archive.io("steps", steps_), archive.io("newton_iterations", newton_iterations_);
  archive.io("constraint_drift", constraint_drift_), archive.io("step_error", step_error_);
  archive.io("largest_power", largest_power_), archive.io("largest_error", largest_error_);
  archive.io("next_fields", next_fields_), archive.io("next_row", next_row_);
  for (BearingExtremes& extremes : extremes_) {
    const Archive::Group group(archive, "extremes of " + extremes.name());
    extremes.persist(archive);
  }
  if (model_.circuit) {
    const Archive::Group circuit(archive, "circuit");
    archive.io("starved_time", starved_time_), archive.io("lowest_fill", lowest_fill_);
    archive.io("lowest_at_axis", lowest_at_axis_), archive.io("time", circuit_time_);
  }
  {
    const Archive::Group meshes(archive, "parted_teeth");
    parted_.persist(archive);
  }
  {
    const Archive::Group energy(archive, "energy");
    energy_.persist(archive);
  }
  archive.io("settled", settled_), archive.io("repeats", repeats_);
  settling_.persist(archive);
  {
    const Archive::Group cycle(archive, "cycle");
    archive.io("number", last_cycle_.number), archive.io("change", last_cycle_.value);
    archive.io("largest", last_cycle_.largest);
    cycles_.persist(archive);
  }
  {
    const Archive::Group meshes(archive, "deformed_meshes");
    deformed_.persist(archive);
  }
  recorder_.persist(archive, options_.results);
}

}  // namespace hersey::run
