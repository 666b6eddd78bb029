#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <chrono>

#include "bindings.h"
#include "hersey/run/summary_json.h"
#include "hersey/session/session.h"
#include "interruption.h"

namespace hersey::python {
namespace {

namespace py = pybind11;
using Clock = std::chrono::steady_clock;

// How often a run looks whether Python has something to say: Ctrl-C.
constexpr std::chrono::milliseconds kPatience{50};

/// Between a run, which holds no lock of the interpreter, and Python: progress one way, Ctrl-C and exceptions the
/// other.
class RunListener : public session::Listener {
 public:
  explicit RunListener(py::object on_progress) : on_progress_(std::move(on_progress)) {}

  void stepped(std::size_t /*run*/, const run::Progress& progress) override {
    const Clock::time_point now = Clock::now();
    t_ = progress.t;
    const bool is_asked_for = !on_progress_.is_none();
    if (interruption_.stop() || (!is_asked_for && now - last_ < kPatience)) return;
    last_ = now;
    const py::gil_scoped_acquire lock;
    interruption_.listen([&] {
      if (is_asked_for) on_progress_(progress);
    });
  }

  [[nodiscard]] const Interruption& interruption() const { return interruption_; }
  /// The time the run had come to [s].
  [[nodiscard]] double t() const { return t_; }

 private:
  py::object on_progress_;
  Interruption interruption_;
  Clock::time_point last_ = Clock::now();
  double t_ = 0;
};

// The summary as JSON, the exception that ended the run, or None, and the time it had come to. A run that could not
// begin gives no summary where a function of Python's is why; Python looks after that.
py::tuple simulate(const session::Session& session, const std::string& results, bool overwrite, bool resume,
                   bool step_error, py::object on_progress, const std::function<bool()>& has_fault) {
  RunListener listener(std::move(on_progress));
  session::RunOptions options{.step_error = step_error, .stop = &listener.interruption().stop()};
  if (overwrite) options.existing = session::Existing::replace;
  if (resume) options.existing = session::Existing::resume;
  std::string json;
  {
    const py::gil_scoped_release open;
    try {
      json = run::summary_json(session.run(results, options, listener));
    } catch (const std::exception&) {
      const py::gil_scoped_acquire lock;
      if (!has_fault()) throw;
    }
  }
  return py::make_tuple(json, listener.interruption().raised(), listener.t());
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
}

}  // namespace hersey::python
