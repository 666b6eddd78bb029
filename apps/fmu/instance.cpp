#include "instance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "hersey/core/blas_threads.h"
#include "hersey/core/error_text.h"
#include "hersey/core/input_file.h"
#include "hersey/core/unit_database.h"

namespace hersey::fmu {
namespace {

constexpr std::uintmax_t kLargestList = std::uintmax_t{1} << 28;
constexpr double kSameTime = 1e-9;  // relative, of communication points that importers add up

std::string text_of(const std::filesystem::path& path) {
  InputFile file = read_input_file(path.string(), kLargestList);
  if (!file.fault.empty()) throw std::runtime_error(fmt::format("{}: {}", path.string(), file.fault));
  return std::move(file.content);
}

}  // namespace

Instance::Instance(const char* name, const char* token, const char* token_word, const std::filesystem::path& resources,
                   bool logging, Log log)
    : log_(std::move(log)), is_logging_(logging) {
  if (name == nullptr || *name == '\0') throw std::runtime_error("an instance without a name");
  if (token == nullptr) throw std::runtime_error(fmt::format("an instance without {}", token_word));
  use_one_blas_thread();
  use_unit_database(resources / "udunits" / "udunits2.xml");
  variables_ = from_json(text_of(resources / "variables.json"));
  if (token != variables_.token)
    throw std::runtime_error(
        fmt::format("the model description is of another FMU: its token is '{}', that of the resources '{}'", token,
                    variables_.token));
  // All that the resources hold is read here and now: importers may take their folder away again.
  session_.emplace((resources / "model.yaml").string(), variables_.overrides);
  (void)reset();
}

CallStatus Instance::guarded(const std::function<CallStatus()>& action) {
  try {
    return action();
  } catch (const std::exception& failure) {
    return error(error_text(failure));
  }
}

void Instance::say(CallStatus outcome, const char* category, const std::string& message) const {
  const bool is_always_logged = outcome == CallStatus::error || outcome == CallStatus::discard;
  if (log_ && (is_logging_ || is_always_logged)) log_(outcome, category, message);
}

CallStatus Instance::error(const std::string& message) {
  say(CallStatus::error, "logStatusError", message);
  return CallStatus::error;
}

CallStatus Instance::set_up(double start_time, std::optional<double> stop_time) {
  if (phase_ != Phase::instantiated) return error("the experiment is set up before the initialisation");
  if (!std::isfinite(start_time) || (stop_time && !(*stop_time > start_time)))
    return error(
        fmt::format("an experiment from {} s to {} s: expected a later end", start_time, stop_time.value_or(0)));
  start_time_ = start_time;
  stop_time_ = stop_time;
  is_set_up_ = true;
  return CallStatus::ok;
}

// Builds the model with the parameters that the importer has set; all others keep the value of the file, to the last
// bit.
void Instance::build() {
  std::vector<std::string> overrides = variables_.overrides;
  for (std::size_t i = 0; i < variables_.list.size(); ++i) {
    const Variable& one = variables_.list[i];
    if (one.kind != Variable::Kind::parameter || !is_set_[i] || values_[i] == one.start) continue;
    overrides.push_back(fmt::format("{}={}{}", one.source, values_[i], one.unit == "1" ? "" : " " + one.unit));
  }
  const bool is_as_exported = overrides.size() == variables_.overrides.size();
  session::Session session = is_as_exported ? *session_ : session_->with(overrides);
  session.model().file = "model.yaml";  // the same wherever it has been unpacked
  model::Simulation& plan = session.model().simulation;
  if (is_set_up_) plan.start = start_time_;
  if (stop_time_ && !plan.cycle) plan.duration = std::max(plan.duration, *stop_time_ - plan.start);
  time_ = plan.start;
  simulation_.reset();
  simulation_ = std::make_unique<run::Simulation>(session.simulation());
  simulation_->keep_starts(run::why_no_derivatives(simulation_->model()).empty());
  has_stepped_ = false;
  std::map<std::string, std::size_t> index_of;
  for (std::size_t i = 0; i < simulation_->outputs().size(); ++i) index_of[simulation_->outputs()[i].name] = i;
  outputs_.assign(variables_.list.size(), 0);
  for (std::size_t i = 0; i < variables_.list.size(); ++i) {
    const Variable& one = variables_.list[i];
    if (one.kind == Variable::Kind::output) {
      const auto found = index_of.find(one.source);
      if (found == index_of.end()) throw std::runtime_error("with these parameters the model has no " + one.source);
      outputs_[i] = found->second;
    }
    if (one.kind == Variable::Kind::input && is_set_[i]) simulation_->set(one.source, values_[i]);
  }
}

CallStatus Instance::enter_initialisation() {
  if (phase_ != Phase::instantiated) return error("initialisation begins once, behind instantiation or reset");
  return guarded([&] {
    build();
    phase_ = Phase::initialisation;
    return CallStatus::ok;
  });
}

CallStatus Instance::exit_initialisation() {
  if (phase_ != Phase::initialisation) return error("initialisation is not under way");
  return guarded([&] {
    if (!simulation_) build();
    phase_ = Phase::stepping;
    return CallStatus::ok;
  });
}

const Variable& Instance::variable(unsigned reference) const {
  if (reference == 0 || reference > variables_.list.size())
    throw std::runtime_error(fmt::format("no variable has the value reference {}", reference));
  return variables_.list[reference - 1];
}

void Instance::get_one(unsigned reference, double* values) const {
  if (reference == 0) {
    *values = time_;
    return;
  }
  const Variable& one = variable(reference);
  const std::size_t i = reference - 1;
  if (one.kind == Variable::Kind::parameter || is_set_[i]) {
    *values = values_[i];
  } else if (one.kind == Variable::Kind::input) {
    const double now = simulation_ ? simulation_->input(one.source) : one.start;
    *values = std::isfinite(now) ? now : one.start;
  } else if (!simulation_) {
    throw std::runtime_error(one.name + " is known from the initialisation on");
  } else if (const std::vector<double>& row = simulation_->output(outputs_[i]); one.size > 0) {
    std::copy_n(row.begin(), one.size, values);
  } else {
    *values = row.at(one.column);
  }
}

std::size_t Instance::count_values(const unsigned* references, std::size_t count) const {
  std::size_t values = 0;
  for (std::size_t k = 0; k < count; ++k) values += references[k] == 0 ? 1 : size_of(variable(references[k]));
  return values;
}

CallStatus Instance::get(const unsigned* references, std::size_t count, double* values, std::size_t value_count) {
  if (count > 0 && (references == nullptr || values == nullptr)) return error("no room for values");
  return guarded([&] {
    // Parameters set in the initialisation make another machine.
    if (phase_ == Phase::initialisation && !simulation_) build();
    if (const std::size_t due = count_values(references, count); due != value_count)
      return error(fmt::format("room for {} values of variables that have {}", value_count, due));
    for (std::size_t k = 0; k < count; ++k) {
      get_one(references[k], values);
      values += count_values(references + k, 1);
    }
    return CallStatus::ok;
  });
}

CallStatus Instance::refuse_in_update() {
  return is_in_update_ ? error("in an intermediate update values are read, and nothing else") : CallStatus::ok;
}

void Instance::set_one(unsigned reference, double value) {
  const Variable& one = variable(reference);
  const std::size_t i = reference - 1;
  if (!std::isfinite(value))
    throw std::runtime_error(fmt::format("{}: found {}; expected a finite number{}", one.name, value,
                                         one.unit == "1" ? "" : " in " + one.unit));
  if (one.kind == Variable::Kind::output) throw std::runtime_error(one.name + " is an output");
  if (one.kind == Variable::Kind::parameter) {
    if (phase_ != Phase::instantiated && phase_ != Phase::initialisation)
      throw std::runtime_error(one.name + " is a parameter: it is set before the end of the initialisation");
    if (values_[i] != value) simulation_.reset();
  } else {
    // An importer that hands out start values leaves functions of the model as they are.
    if (!is_set_[i] && value == one.start) return;
    if (simulation_) simulation_->set(one.source, value);
  }
  values_[i] = value;
  is_set_[i] = true;
}

CallStatus Instance::set(const unsigned* references, std::size_t count, const double* values) {
  if (const CallStatus refused = refuse_in_update(); refused != CallStatus::ok) return refused;
  if (count > 0 && (references == nullptr || values == nullptr)) return error("no values are given");
  if (phase_ == Phase::terminated || phase_ == Phase::failed)
    return error("nothing can be set any more: reset, or restore a state");
  return guarded([&] {
    for (std::size_t k = 0; k < count; ++k) set_one(references[k], values[k]);
    return CallStatus::ok;
  });
}

// Where a communication step is to end from here on: `end`, or what the importer asks for in an intermediate update.
double Instance::after_solver_step(double end) {
  if (!update_) return end;
  const double before = std::exchange(time_, simulation_->time());
  is_in_update_ = true;
  const std::optional<double> asked = update_(time_);
  is_in_update_ = false;
  time_ = before;
  return asked && *asked < end ? std::max(*asked, simulation_->time()) : end;
}

CallStatus Instance::step(double time, double length) {
  if (const CallStatus refused = refuse_in_update(); refused != CallStatus::ok) return refused;
  last_successful_time_ = time_;
  has_ended_ = has_returned_early_ = false;
  if (phase_ != Phase::stepping) return error("steps are taken behind the initialisation, and not behind a failure");
  if (!std::isfinite(length) || length < 0) return error(fmt::format("a communication step of {} s", length));
  if (!(std::abs(time - time_) <= kSameTime * std::max({std::abs(time), std::abs(time_), length})))
    return error(fmt::format("a step from t = {:.12g} s, though the last one ended at t = {:.12g} s", time, time_));
  return guarded([&] {
    double end = time + length;
    const run::Advance advance = simulation_->advance_to(end, [&] { return end = after_solver_step(end); });
    has_stepped_ = true;
    if (advance.status == run::Advance::Status::advanced) {
      has_returned_early_ = end < time + length;
      last_successful_time_ = time_ = has_returned_early_ ? simulation_->time() : end;
      say(CallStatus::ok, "logAll", fmt::format("t = {:.9g} s", time_));
      return CallStatus::ok;
    }
    last_successful_time_ = time_ = simulation_->time();
    if (advance.status == run::Advance::Status::ended) {
      has_ended_ = has_returned_early_ = true;
      say(CallStatus::discard, "logStatusDiscard", advance.message);
      return CallStatus::discard;
    }
    phase_ = Phase::failed;
    return error(advance.message);
  });
}

CallStatus Instance::terminate() {
  if (const CallStatus refused = refuse_in_update(); refused != CallStatus::ok) return refused;
  if (phase_ != Phase::stepping && phase_ != Phase::failed) return error("there is nothing to terminate");
  phase_ = Phase::terminated;
  return CallStatus::ok;
}

CallStatus Instance::reset() {
  if (const CallStatus refused = refuse_in_update(); refused != CallStatus::ok) return refused;
  simulation_.reset();
  phase_ = Phase::instantiated;
  values_.clear();
  for (const Variable& one : variables_.list) values_.push_back(one.start);
  is_set_.assign(values_.size(), false);
  is_set_up_ = false;
  stop_time_.reset();
  start_time_ = time_ = last_successful_time_ = 0;
  has_ended_ = has_returned_early_ = has_stepped_ = false;
  return CallStatus::ok;
}

CallStatus Instance::set_logging(bool is_on) {
  is_logging_ = is_on;
  return CallStatus::ok;
}

CallStatus Instance::require_none(std::size_t count, const char* type) {
  return count == 0 ? CallStatus::ok : error(fmt::format("this FMU has no variables of type {}", type));
}

InstanceState Instance::state_now() {
  InstanceState state;
  state.phase = phase_;
  state.values = values_;
  state.is_set = is_set_;
  state.start_time = start_time_;
  state.is_set_up = is_set_up_;
  state.stop_time = stop_time_;
  state.time = time_;
  if (simulation_) state.simulation = simulation_->save();
  return state;
}

void Instance::take(const InstanceState& state) {
  if (state.values.size() != values_.size()) throw std::runtime_error("the state is of another FMU");
  bool is_same_machine = simulation_ != nullptr && state.is_set_up == is_set_up_ && state.start_time == start_time_ &&
                         state.stop_time == stop_time_;
  for (std::size_t i = 0; i < values_.size(); ++i)
    if (variables_.list[i].kind == Variable::Kind::parameter && values_[i] != state.values[i]) is_same_machine = false;
  values_ = state.values;
  is_set_ = state.is_set;
  start_time_ = state.start_time;
  is_set_up_ = state.is_set_up;
  stop_time_ = state.stop_time;
  if (!state.simulation) {
    simulation_.reset();
  } else {
    if (!is_same_machine) build();
    simulation_->restore(*state.simulation);
    has_stepped_ = simulation_->time() > simulation_->start();
  }
  time_ = state.time;
  phase_ = state.phase;
}

}  // namespace hersey::fmu
