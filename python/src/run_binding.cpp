#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <optional>

#include "bindings.h"
#include "hersey/results/output_lock.h"
#include "hersey/run/simulate.h"
#include "hersey/run/summary_json.h"
#include "model_binding.h"

namespace hersey::python {
namespace {

namespace py = pybind11;
using Clock = std::chrono::steady_clock;

// How often a run looks whether Python has something to say: Ctrl-C.
constexpr std::chrono::milliseconds kPatience{50};

/// Between a run, which holds no lock of the interpreter, and Python: progress one way, Ctrl-C and exceptions the
/// other.
class Listener {
 public:
  explicit Listener(py::object on_progress) : on_progress_(std::move(on_progress)) {}

  void tell(const run::Progress& progress) {
    const Clock::time_point now = Clock::now();
    t_ = progress.t;
    const bool is_asked_for = !on_progress_.is_none();
    if (stop_ || (!is_asked_for && now - last_ < kPatience)) return;
    last_ = now;
    const py::gil_scoped_acquire lock;
    try {
      if (is_asked_for) on_progress_(progress);
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    } catch (py::error_already_set& error) {
      raised_.emplace(std::move(error));
      stop_ = true;
    }
  }

  [[nodiscard]] const std::atomic<bool>& stop() const { return stop_; }
  /// The time the run had come to [s].
  [[nodiscard]] double t() const { return t_; }
  /// What Python raised meanwhile, or None.
  [[nodiscard]] py::object raised() const { return raised_ ? py::object(raised_->value()) : py::none(); }

 private:
  py::object on_progress_;
  std::optional<py::error_already_set> raised_;
  std::atomic<bool> stop_{false};
  Clock::time_point last_ = Clock::now();
  double t_ = 0;
};

// The summary as JSON, the exception that ended the run, or None, and the time it had come to. A run that could not
// begin gives no summary where a function of Python's is why; Python looks after that.
py::tuple simulate(const CheckedModel& checked, const std::string& results, bool overwrite, bool resume,
                   bool step_error, py::object on_progress, const std::function<bool()>& has_fault) {
  Listener listener(std::move(on_progress));
  run::Options options;
  options.results = results;
  options.overwrite = overwrite;
  options.resume = resume;
  options.step_error = step_error;
  options.stop = &listener.stop();
  options.on_progress = [&](const run::Progress& progress) { listener.tell(progress); };
  std::string json;
  {
    const py::gil_scoped_release open;
    try {
      json = run::summary_json(run::simulate(checked.model, options));
    } catch (const std::exception&) {
      const py::gil_scoped_acquire lock;
      if (!has_fault()) throw;
    }
  }
  return py::make_tuple(json, listener.raised(), listener.t());
}

}  // namespace

void bind_run(py::module_& core) {
  py::class_<run::Progress>(core, "Progress", "How far a run has come; times in s, moft in m.")
      .def_readonly("t", &run::Progress::t)
      .def_readonly("t_start", &run::Progress::t_start)
      .def_readonly("t_end", &run::Progress::t_end)
      .def_readonly("dt", &run::Progress::dt)
      .def_readonly("newton_iterations", &run::Progress::newton_iterations)
      .def_readonly("moft", &run::Progress::moft)
      .def_readonly("elapsed", &run::Progress::elapsed);
  core.def("simulate", &simulate);
  core.def("require_idle", [](const std::string& results) { results::require_idle(results); });
}

}  // namespace hersey::python
