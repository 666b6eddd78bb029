#include "hersey/run/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "hersey/core/error_text.h"
#include "hersey/core/input_error.h"
#include "hersey/core/spelling.h"
#include "hersey/results/output_lock.h"
#include "record/recorder.h"
#include "time_stepping/inputs.h"
#include "time_stepping/lead_in.h"
#include "time_stepping/machine_run.h"

namespace hersey::run {
namespace {

model::Model require_motion(model::Model model) {
  const bool has_bodies = !model.is_of_bearings_alone();
  const model::Analysis analysis = model.simulation.analysis;
  if (has_bodies && (analysis == model::Analysis::dynamics || analysis == model::Analysis::kinematics)) return model;
  throw InputError(Fault{has_bodies ? model.position_of("simulation.analysis") : SourcePosition{model.file, 0, 0},
                         has_bodies ? "simulation.analysis" : "",
                         has_bodies ? "an analysis of one state" : "bearings alone",
                         "a motion over time to step through: analysis `dynamics` or `kinematics`", ""});
}

/// "/bearings/big_end/h_min" as "bearings.big_end.h_min".
std::string dotted(const std::string& path) {
  std::string name = path.substr(1);
  std::replace(name.begin(), name.end(), '/', '.');
  return name;
}

}  // namespace

struct Simulation::Impl {
  Impl(model::Model given, Options options_)
      : model(require_motion(std::move(given))),
        options(std::move(options_)),
        lock(std::in_place, options.results),
        inputs(model),
        run(model, options, {}, lead_in(model, options)),
        snapshot(model, run.machine(), run.state(), Options{}) {
    run.begin();
    for (const results::LatestRow& row : snapshot.latest()) {
      // Fields and cycles have instants of their own.
      if (row.path.find("/fields/") != std::string::npos || row.path.find("/cycles/") != std::string::npos) continue;
      index_of[dotted(row.path)] = rows.size();
      rows.push_back(static_cast<std::size_t>(&row - snapshot.latest().data()));
      outputs.push_back({dotted(row.path), row.unit, row.text, row.shape, row.components});
    }
  }

  // Takes steps one by one; a limit that is already passed is ignored.
  Advance take(double limit) {
    if (is_finished) return {{Advance::Status::ended, "the simulation is finished"}};
    if (!failure.empty()) return {{Advance::Status::failed, failure}};
    if (run.is_at_end()) return ended();
    is_shown = false;
    restored.clear();
    try {
      settle_jump();
      if (const Outcome step = run.step(limit); !step.solved()) failure = step.message;
    } catch (const std::exception& error) {
      failure = fmt::format("t = {:.6g} s: {}", run.state().t, error_text(error));
    }
    if (!failure.empty()) return {{Advance::Status::failed, failure}};
    return {{Advance::Status::advanced}};
  }

  [[nodiscard]] Advance ended() const {
    std::string message = run.ending();
    if (message.empty())
      message = fmt::format("simulation.duration ends at t = {:.6g} s: a longer one goes on",
                            model.simulation.start + model.simulation.duration);
    return {{Advance::Status::ended, std::move(message)}};
  }

  void settle_jump() {
    if (jump == Jump::none) return;
    run.take_jump(jump == Jump::of_speed);
    jump = Jump::none;
  }

  void change(Inputs::Input& input, const std::function<void()>& how) {
    if (!input.refusal.empty())
      throw InputError(Fault{{}, input.info.name, "an input that cannot be set", input.refusal, ""});
    how();
    jump = std::max(jump, input.jump);
    is_shown = false;
  }

  [[nodiscard]] const std::vector<double>& values_of(std::size_t index) {
    if (!restored.empty()) return restored.at(index);
    show();
    return snapshot.latest()[rows.at(index)].values;
  }

  // Outputs of a step are not all recomputed from the state: a restored state shows the outputs at the time it was
  // saved.
  void persist_outputs(Archive& archive) {
    std::vector<std::vector<double>> values;
    if (!archive.restores())
      for (std::size_t i = 0; i < rows.size(); ++i) values.push_back(values_of(i));
    archive.each("outputs", values, [](Archive& a, std::vector<double>& values) { a.io("values", values); });
    if (!archive.restores()) return;
    if (values.size() != rows.size()) throw ArchiveError("it has other outputs");
    restored = std::move(values);
  }

  void show() {
    if (!is_shown) snapshot.write_row(run.last_step(), run.energy());
    is_shown = true;
  }

  void persist(Archive& archive) {
    {
      const Archive::Group group(archive, "inputs");
      inputs.persist(archive);
      archive.io("jump", jump);
    }
    persist_outputs(archive);
    if (archive.restores())
      run.restore(archive);
    else
      run.persist(archive);
  }

  model::Model model;
  Options options;
  std::optional<results::OutputLock> lock;  // the results file is this run's alone
  Inputs inputs;
  MachineRun run;
  Recorder snapshot;
  std::vector<OutputInfo> outputs;
  std::vector<std::size_t> rows;  // indices of the outputs in the snapshot
  std::map<std::string, std::size_t> index_of;
  Jump jump = Jump::none;
  std::vector<std::vector<double>> restored;  // outputs at a state that was restored; empty behind a step
  bool is_shown = false, is_finished = false;
  std::string failure;
};

Simulation::Simulation(model::Model model, Options options)
    : impl_(std::make_unique<Impl>(std::move(model), std::move(options))) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

Simulation::~Simulation() {
  if (impl_ == nullptr || impl_->is_finished) return;
  try {
    (void)finish();
  } catch (const std::exception&) {
    // The results are those of the last good flush; a destructor cannot report an error.
  }
}

const model::Model& Simulation::model() const { return impl_->model; }
double Simulation::time() const { return impl_->run.state().t; }
double Simulation::start() const { return impl_->model.simulation.start; }
double Simulation::end() const { return start() + impl_->model.simulation.duration; }

Advance Simulation::step() { return impl_->take(std::numeric_limits<double>::infinity()); }

Advance Simulation::advance_to(double t) {
  const double slack = impl_->run.slack();
  if (!(t >= time() - slack) || std::isinf(t))
    throw InputError(Fault{{},
                           "",
                           fmt::format("an advance to t = {:.9g} s", t),
                           fmt::format("an instant not before {:.9g} s", time()),
                           ""});
  while (time() < t - slack) {
    const Advance step = impl_->take(t);
    if (step.status != Advance::Status::advanced) return step;
  }
  return {{Advance::Status::advanced}};
}

const std::vector<InputInfo>& Simulation::inputs() const { return impl_->inputs.infos(); }

void Simulation::set(const std::string& name, double value) {
  Inputs::Input& input = impl_->inputs.find(name);
  if (!std::isfinite(value))
    throw InputError(Fault{{}, name, fmt::format("the value {}", value), "a finite number in " + input.info.unit, ""});
  const bool is_constant = input.variables.empty() || input.function->is_set();
  if (is_constant && input.function->value({}) == value) return;
  impl_->change(input, [&] { input.function->set(value); });
}

void Simulation::release(const std::string& name) {
  Inputs::Input& input = impl_->inputs.find(name);
  if (input.function->is_set()) impl_->change(input, [&] { input.function->release(); });
}

double Simulation::input(const std::string& name) const {
  return Inputs::value_of(impl_->inputs.find(name), impl_->model.simulation, time());
}

const std::vector<OutputInfo>& Simulation::outputs() const { return impl_->outputs; }

const std::vector<double>& Simulation::output(const std::string& name) const {
  const auto found = impl_->index_of.find(name);
  if (found != impl_->index_of.end()) return output(found->second);
  std::vector<std::string> names;
  for (const OutputInfo& info : impl_->outputs) names.push_back(info.name);
  throw InputError(Fault{{}, "", "no output '" + name + "'", one_of(names), did_you_mean(name, names)});
}

const std::vector<double>& Simulation::output(std::size_t index) const { return impl_->values_of(index); }

Archive::Content Simulation::save() {
  Archive archive;
  save_identity(archive, impl_->model);
  impl_->persist(archive);
  return archive.content();
}

void Simulation::restore(Archive::Content saved) {
  if (!impl_->options.results.empty())
    throw ArchiveError("a simulation with a results file cannot be restored: the file only goes forward");
  std::string warning;
  require_identity(saved, impl_->model, "the state", warning);
  if (!warning.empty()) throw ArchiveError(warning);
  Archive archive(std::move(saved));
  impl_->persist(archive);
  impl_->failure.clear();
  impl_->is_shown = false;
}

Summary Simulation::summary() const {
  Summary summary = impl_->run.summary();
  const bool is_complete = impl_->run.is_at_end();
  summary.status = !impl_->failure.empty() ? Status::failed : is_complete ? Status::completed : Status::stopped;
  summary.message = !impl_->failure.empty() ? impl_->failure : is_complete ? impl_->run.ending() : "";
  if (!impl_->options.results.empty()) summary.t_results = time();
  return summary;
}

Summary Simulation::finish() {
  const Summary found = summary();
  if (std::exchange(impl_->is_finished, true) || impl_->options.results.empty()) return found;
  const Outcome written = impl_->run.finish(found.status, found.message, nullptr);
  impl_->lock.reset();
  if (!written.solved()) throw std::runtime_error(written.message);
  return summary();
}

}  // namespace hersey::run
