#include "time_stepping/fmu_exchange.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "hersey/core/input_error.h"

namespace hersey::run {
namespace {

/// Runs what calls an FMU, and puts its name before what it complains of.
template <class Action>
void ask(const model::Fmu& fmu, const Action& action) {
  try {
    action();
  } catch (const fmi::FmuError& error) {
    throw std::runtime_error(fmt::format("FMU {}: {}", fmu.name, error.what()));
  }
}

/// Bytes four at a time: numbers of an archive have eight bytes each.
std::vector<std::uint32_t> packed(const std::vector<unsigned char>& bytes) {
  std::vector<std::uint32_t> words((bytes.size() + 3) / 4);
  for (std::size_t i = 0; i < bytes.size(); ++i) words[i / 4] |= static_cast<std::uint32_t>(bytes[i]) << (8 * (i % 4));
  return words;
}

std::vector<unsigned char> unpacked(const std::vector<std::uint32_t>& words, std::size_t size) {
  std::vector<unsigned char> bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<unsigned char>(words.at(i / 4) >> (8 * (i % 4)));
  return bytes;
}

void persist_state(Archive& archive, fmi::Instance& instance) {
  std::vector<unsigned char> bytes;
  if (!archive.restores()) bytes = instance.save();
  std::size_t size = bytes.size();
  std::vector<std::uint32_t> words = packed(bytes);
  archive.io("size", size), archive.io("state", words);
  if (archive.restores()) instance.restore(unpacked(words, size));
}

}  // namespace

std::string why_not_saved(const model::Model& model) {
  for (const model::Fmu& fmu : model.fmus)
    if (!fmu.description.saves_state)
      return fmt::format("FMU {} cannot save its state (canGetAndSetFMUState and canSerializeFMUState)", fmu.name);
  return {};
}

FmuExchange::FmuExchange(const model::Model& given) : model_(given) {
  for (const model::Fmu& fmu : model_.fmus) {
    try {
      start(fmu);
    } catch (const std::runtime_error& error) {
      throw InputError(Fault{model_.position_of("fmus." + fmu.name + ".file"), "fmus." + fmu.name, error.what(),
                             "an FMU that can be started", ""});
    }
  }
  for (model::Drive& drive : model_.drives) {
    const bool is_speed = drive.prescribes == model::Drive::Prescribes::speed;
    follow(drive.motion, is_speed ? Jump::of_speed : Jump::of_force, is_speed ? Jump::of_force : Jump::none);
  }
  for (model::Force& force : model_.forces)
    for (const auto& followed : functions_of(force)) follow(*followed.function, Jump::of_force, Jump::none);
}

void FmuExchange::start(const model::Fmu& fmu) {
  Unit unit{.instance = fmi::instantiate(fmi::FmuFile(fmu.file), fmu.description, fmu.name)};
  for (const model::FmuParameter& parameter : fmu.parameters)
    std::visit([&](const auto& value) { unit.instance->set_start(parameter.variable, value); }, parameter.value);
  for (const model::FmuInput& input : fmu.inputs) unit.inputs.push_back(input.variable.reference);
  for (const model::FmuOutputVariable& output : fmu.outputs) unit.outputs.push_back(output.variable.reference);
  unit.instance->enter_initialisation(model_.simulation.start, model_.simulation.start + model_.simulation.duration);
  units_.push_back(std::move(unit));
  signals_.push_back({std::vector<double>(fmu.inputs.size()), std::vector<double>(fmu.outputs.size())});
  get_outputs(units_.size() - 1, false);
  note_warnings(units_.back(), model_.simulation.start);
}

void FmuExchange::follow(model::Function& function, Jump of_value, Jump of_slope) {
  if (!function.signal) return;
  const model::FmuSignal& signal = *function.signal;
  auto own = std::make_shared<FmuFunction>();
  own->begin_at(model_.simulation.start, signal.scale * signals_[signal.fmu].outputs[signal.output], 0);
  function.value = own;
  followers_.push_back({std::move(own), signal, of_value, of_slope});
}

double FmuExchange::instant(std::size_t f, std::size_t n) const {
  return model_.simulation.start + static_cast<double>(n) * model_.fmus[f].step;
}

double FmuExchange::next() const {
  double earliest = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < units_.size(); ++f) earliest = std::min(earliest, instant(f, units_[f].exchanges + 1));
  return earliest;
}

void FmuExchange::note_warnings(Unit& unit, double t) {
  fmi::Warnings more = unit.instance->take_warnings();
  if (more.count == 0) return;
  if (unit.warnings.count == 0) unit.warnings.first = std::move(more.first), unit.warned_at = t;
  unit.warnings.count += more.count;
}

std::string FmuExchange::warnings() const {
  std::string text;
  for (std::size_t f = 0; f < units_.size(); ++f) {
    const Unit& unit = units_[f];
    if (unit.warnings.count == 0) continue;
    text += fmt::format("{}FMU {}: {} warning{}, the first at t = {:.6g} s: {}", text.empty() ? "" : "; ",
                        model_.fmus[f].name, unit.warnings.count, unit.warnings.count == 1 ? "" : "s", unit.warned_at,
                        unit.warnings.first);
  }
  return text;
}

void FmuExchange::give_inputs(std::size_t f) {
  const model::Fmu& fmu = model_.fmus[f];
  signals_[f].inputs = pending_.at(f);
  std::vector<double> values;
  for (std::size_t i = 0; i < fmu.inputs.size(); ++i) {
    values.push_back(model::from_si(fmu.inputs[i].variable, signals_[f].inputs[i]));
    if (!std::isfinite(values.back()))
      throw fmi::FmuError(fmt::format("input {} would be given {}", fmu.inputs[i].variable.name, values.back()));
  }
  units_[f].instance->set(units_[f].inputs, values);
}

void FmuExchange::get_outputs(std::size_t f, bool is_given) {
  const model::Fmu& fmu = model_.fmus[f];
  std::vector<double> values(fmu.outputs.size());
  units_[f].instance->get(units_[f].outputs, values);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = model::to_si(fmu.outputs[i].variable, values[i]);
    if (std::isfinite(values[i])) continue;
    if (is_given) throw fmi::FmuError(fmt::format("output {} is {}", fmu.outputs[i].variable.name, values[i]));
    values[i] = 0;
  }
  units_[f].before = std::exchange(signals_[f].outputs, std::move(values));
}

Jump FmuExchange::begin() {
  Jump jump = Jump::none;
  for (std::size_t f = 0; f < units_.size(); ++f) {
    ask(model_.fmus[f], [&] {
      give_inputs(f);
      units_[f].instance->exit_initialisation();
      get_outputs(f);
      units_[f].before = signals_[f].outputs;  // nothing has been exchanged earlier
    });
    note_warnings(units_[f], model_.simulation.start);
    jump = std::max(jump, go_on_from(f, model_.simulation.start));
  }
  return jump;
}

Jump FmuExchange::exchange(double t, double slack) {
  Jump jump = Jump::none;
  for (std::size_t f = 0; f < units_.size(); ++f) {
    Unit& unit = units_[f];
    const double from = instant(f, unit.exchanges), to = instant(f, unit.exchanges + 1);
    if (to > t + slack) continue;
    ask(model_.fmus[f], [&] {
      unit.instance->step(from, model_.fmus[f].step);
      get_outputs(f);
      give_inputs(f);
    });
    ++unit.exchanges;
    note_warnings(unit, to);
    jump = std::max(jump, go_on_from(f, to));
  }
  return jump;
}

Jump FmuExchange::go_on_from(std::size_t f, double t) {
  Jump jump = Jump::none;
  for (Follower& follower : followers_) {
    const model::FmuSignal& signal = follower.signal;
    if (signal.fmu != f) continue;
    const double now = signal.scale * signals_[f].outputs[signal.output];
    const double before = signal.scale * units_[f].before[signal.output];
    const double slope = signal.hold == model::FmuHold::constant ? 0 : (now - before) / model_.fmus[f].step;
    const double value = signal.hold == model::FmuHold::ramp ? before : now;
    FmuFunction& function = *follower.function;
    // A ramp begins where the last one has ended, but for round-off.
    const bool is_continuous = signal.hold == model::FmuHold::ramp && units_[f].exchanges > 0;
    if (!is_continuous && function.value({&t, 1}) != value) jump = std::max(jump, follower.of_value);
    if (function.slope() != slope) jump = std::max(jump, follower.of_slope);
    function.begin_at(t, value, slope);
  }
  return jump;
}

void FmuExchange::persist(Archive& archive) {
  if (const std::string why = why_not_saved(model_); !why.empty()) throw ArchiveError(why);
  for (std::size_t f = 0; f < units_.size(); ++f) {
    const Archive::Group group(archive, model_.fmus[f].name);
    archive.io("exchanges", units_[f].exchanges);
    archive.io("inputs", signals_[f].inputs), archive.io("outputs", signals_[f].outputs);
    archive.io("before", units_[f].before);
    archive.io("warnings", units_[f].warnings.count), archive.io("warning", units_[f].warnings.first);
    archive.io("warned_at", units_[f].warned_at);
    pending_.resize(units_.size());
    archive.io("pending", pending_[f]);
    ask(model_.fmus[f], [&] { persist_state(archive, *units_[f].instance); });
    if (archive.restores()) (void)units_[f].instance->take_warnings();  // of what is undone
  }
  archive.each("functions", followers_, [](Archive& inside, Follower& one) { one.function->persist(inside); });
}

}  // namespace hersey::run
