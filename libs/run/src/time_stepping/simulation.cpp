#include "hersey/run/simulation.h"

#include <fmt/format.h>

#include <Eigen/Dense>
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
#include "table/output_name.h"
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

/// The start of a model whose period, where it is to be found, becomes that of the motion.
PeriodicStart lead_in_of(model::Model& model, const Options& options) {
  PeriodicStart start = lead_in(model, options);
  take_period(model, start.period);
  return start;
}

/// Share of an input, or of what stands for it, by which the neighbours of an advance differ from it at first. Central
/// differences of them leave its square, 1e-8 of the response's curvature, and round-off over it; at a hundredth weak
/// responses as that of a film's peak pressure to the speed lose digits.
constexpr double kNeighbour = 1e-4;
/// Bend of the response over that of a straight one with which neighbours are near enough: its square, the error, is
/// 1e-6. A jump of a drive's speed against a film that cavitates needs them a thousand times nearer.
constexpr double kStraight = 1e-3;
constexpr double kSmallestCut = 1e-3;  // of neighbours that are moved nearer
constexpr int kMostPairs = 4;          // of neighbours; bends of a film whose nodes switch remain at any distance
constexpr double kResponds = 1e-9;     // of the largest output in its unit, by which one differs above round-off

/// Share of the largest output in an input's unit that stands for an input of 0.
constexpr double kOfTheMachine = 1e-2;

}  // namespace

std::string why_no_derivatives(const model::Model& model) {
  const model::Simulation& plan = model.simulation;
  if (plan.error_control) return "steps of fixed length: a number for `simulation.step`";
  if (plan.analysis != model::Analysis::dynamics) return "analysis `dynamics`";
  if (!model.fmus.empty()) return "a model without `fmus`, whose own derivatives are not known";
  if (plan.integrator != model::Integrator::generalized_alpha) return "`integrator: generalized_alpha`";
  for (const model::Bearing& bearing : model.bearings)
    if (bearing.coupling.scheme == model::CouplingScheme::partitioned)
      return "`coupling: monolithic` in bearing " + bearing.name + ": an exchange of forces has no exact tangent";
  return {};
}

struct Simulation::Impl {
  Impl(model::Model given, Options options_)
      : model(require_motion(std::move(given))),
        options(std::move(options_)),
        lock(std::in_place, options.results),
        inputs(model),
        run(model, options, {}, lead_in_of(model, options)),
        snapshot(model, run.machine(), run.state(), Options{}) {
    run.begin();
    for (const results::LatestRow& row : snapshot.latest()) {
      if (!is_row_of_steps(row.path)) continue;
      index_of[output_name(row.path)] = rows.size();
      rows.push_back(static_cast<std::size_t>(&row - snapshot.latest().data()));
      outputs.push_back({output_name(row.path), row.unit, row.text, row.shape, row.components});
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
    instants.push_back(run.state().t);
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

  void return_to(Archive::Content saved) {
    Archive archive(std::move(saved));
    persist(archive);
    failure.clear();
    is_shown = false;
  }

  void keep_start() {
    derivatives.clear();
    middles.clear();
    instants.clear();
    if (!keeps_starts) return;
    Archive archive;
    persist_machine(archive);
    begun = archive.content();
  }

  [[nodiscard]] std::vector<std::vector<double>> all_values() {
    std::vector<std::vector<double>> values;
    for (std::size_t i = 0; i < rows.size(); ++i) values.push_back(values_of(i));
    return values;
  }

  // What an input is compared with: itself, or what the machine has in its unit.
  [[nodiscard]] double size_of(const Inputs::Input& input, double value,
                               const std::vector<std::vector<double>>& at) const {
    double largest = 0;
    for (std::size_t i = 0; i < outputs.size(); ++i)
      if (outputs[i].unit == input.info.unit)
        for (const double one : at[i])
          if (std::isfinite(one)) largest = std::max(largest, std::abs(one));
    const double size = std::max(std::abs(value), kOfTheMachine * largest);
    return size > 0 ? size : 1;
  }

  // How far the responses of outputs are from straight lines: |above - 2 there + below| over |above - below|, the ninth
  // of ten of those that respond: by more than round-off of the largest output in their unit. Shares of a film that
  // count nodes do so in jumps, and are few.
  [[nodiscard]] double bend(const std::vector<std::vector<double>>& above,
                            const std::vector<std::vector<double>>& there,
                            const std::vector<std::vector<double>>& below) const {
    const auto vector = [](const std::vector<double>& row) {
      return Eigen::Map<const Eigen::VectorXd>(row.data(), static_cast<Eigen::Index>(row.size()));
    };
    std::map<std::string, double> sizes;
    for (std::size_t i = 0; i < there.size(); ++i)
      if (const double size = vector(there[i]).norm(); std::isfinite(size))
        sizes[outputs[i].unit] = std::max(sizes[outputs[i].unit], size);
    std::vector<double> bends;
    for (std::size_t i = 0; i < there.size(); ++i) {
      const auto up = vector(above[i]), middle = vector(there[i]), down = vector(below[i]);
      const double across = (up - down).norm();
      if (across > kResponds * sizes[outputs[i].unit]) bends.push_back((up - 2 * middle + down).norm() / across);
    }
    if (bends.empty()) return 0;
    const auto ninth = bends.begin() + static_cast<std::ptrdiff_t>(bends.size() * 9 / 10);
    std::nth_element(bends.begin(), ninth, bends.end());
    return *ninth;
  }

  // Central differences of neighbours that are near enough.
  std::vector<std::vector<double>> differences(Inputs::Input& input, const std::vector<std::vector<double>>& at) {
    double share = kNeighbour;
    if (!middles.contains(input.jump)) {
      double value = 0;
      middles[input.jump] = neighbour(input, 0, at, value);
    }
    std::vector<std::vector<double>> best;
    double least = std::numeric_limits<double>::infinity();
    for (int pair = 0; pair < kMostPairs; ++pair) {
      double above = 0, below = 0;
      const std::vector<std::vector<double>> upper = neighbour(input, share, at, above);
      std::vector<std::vector<double>> lower = neighbour(input, -share, at, below);
      const double bent = bend(upper, middles[input.jump], lower);
      // Round-off and nodes that switch bend no less nearer by: the farther neighbours have more digits then.
      if (pair > 0 && bent > least / 2) return best;
      for (std::size_t i = 0; i < lower.size(); ++i)
        for (std::size_t k = 0; k < lower[i].size(); ++k) lower[i][k] = (upper[i][k] - lower[i][k]) / (above - below);
      best = std::move(lower);
      least = bent;
      if (bent <= kStraight) break;
      share *= std::clamp(kStraight / (2 * bent), kSmallestCut, 0.5);
    }
    return best;
  }

  // Outputs at the end of the last advance, had the input been larger by a share of its size.
  std::vector<std::vector<double>> neighbour(Inputs::Input& input, double share,
                                             const std::vector<std::vector<double>>& at, double& value) {
    Archive start(*begun);
    persist_machine(start);
    failure.clear();
    const double there = Inputs::value_of(input, model.simulation, run.state().t);
    if (!std::isfinite(there)) throw std::runtime_error("it is a function of the motion until it is set");
    value = there + share * size_of(input, there, at);
    change(input, [&] { input.function->set(value); });
    const std::vector<double> ends = std::exchange(instants, {});
    for (const double t : ends)
      while (run.state().t < t - run.slack())
        if (const Advance step = take(t); step.status != Advance::Status::advanced)
          throw std::runtime_error(step.message);
    instants = ends;
    return all_values();
  }

  void persist(Archive& archive) {
    persist_outputs(archive);
    persist_machine(archive);
  }

  // What later steps depend on.
  void persist_machine(Archive& archive) {
    {
      const Archive::Group group(archive, "inputs");
      inputs.persist(archive);
      archive.io("jump", jump);
    }
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
  bool keeps_starts = false;
  std::optional<Archive::Content> begun;  // state at the start of the last advance
  std::map<Jump, std::vector<std::vector<double>>>
      middles;                   // its outputs to round-off, by the jump that it begins with
  std::vector<double> instants;  // ends of the solver's steps since then
  std::map<std::string, std::vector<std::vector<double>>> derivatives;  // of the last advance, by input
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

Advance Simulation::step() {
  impl_->keep_start();
  return impl_->take(std::numeric_limits<double>::infinity());
}

Advance Simulation::advance_to(double t, const std::function<double()>& until) {
  const double slack = impl_->run.slack();
  if (!(t >= time() - slack) || std::isinf(t))
    throw InputError(Fault{{},
                           "",
                           fmt::format("an advance to t = {:.9g} s", t),
                           fmt::format("an instant not before {:.9g} s", time()),
                           ""});
  if (time() < t - slack) impl_->keep_start();
  for (double end = t; time() < end - slack;) {
    const Advance step = impl_->take(end);
    if (step.status != Advance::Status::advanced) return step;
    if (until) end = std::min(t, until());
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
  impl_->return_to(std::move(saved));
  impl_->begun.reset();
  impl_->derivatives.clear();
}

void Simulation::keep_starts(bool is_on) {
  if (const std::string why = why_no_derivatives(impl_->model); is_on && !why.empty())
    throw InputError(Fault{impl_->model.position_of("simulation"), "", "derivatives of a step", why, ""});
  impl_->keeps_starts = is_on;
  if (!is_on) impl_->begun.reset();
}

// (integrator.46): neighbours of the advance by the same steps, each solved to round-off by the exact tangent.
const std::vector<std::vector<double>>& Simulation::derivative(const std::string& name) {
  Inputs::Input& input = impl_->inputs.find(name);
  if (const auto known = impl_->derivatives.find(name); known != impl_->derivatives.end()) return known->second;
  if (!impl_->begun)
    throw InputError(Fault{{}, name, "derivatives without an advance", "a step taken before, with its start kept", ""});
  const std::vector<std::vector<double>> outputs = impl_->all_values();
  Archive::Content end = save();
  const std::string failure = impl_->failure;
  const std::vector<double> instants = impl_->instants;
  std::vector<std::vector<double>> derivative;
  std::string why;
  impl_->run.solve_to_round_off(true);
  try {
    derivative = impl_->differences(input, outputs);
  } catch (const std::exception& error) {
    why = error_text(error);
  }
  impl_->run.solve_to_round_off(false);
  impl_->return_to(std::move(end));
  impl_->failure = failure;
  impl_->instants = instants;
  if (!why.empty()) throw std::runtime_error("no derivative with respect to " + name + ": " + why);
  return impl_->derivatives[name] = std::move(derivative);
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
