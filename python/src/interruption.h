#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <optional>
#include <utility>

namespace hersey::python {

/// What Python raises while the solver works without the interpreter's lock: Ctrl-C, or an exception of a function that
/// it calls. The first ends the work.
class Interruption {
 public:
  /// Calls `tell`, which may raise, and looks whether Ctrl-C was pressed. The caller holds the interpreter's lock.
  template <class Tell>
  void listen(const Tell& tell) {
    if (stop_) return;
    try {
      tell();
      if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
    } catch (pybind11::error_already_set& error) {
      raised_.emplace(std::move(error));
      stop_ = true;
    }
  }
  void listen() {
    listen([] {});
  }

  /// Becomes true when something was raised.
  [[nodiscard]] const std::atomic<bool>& stop() const { return stop_; }
  /// What was raised, or None.
  [[nodiscard]] pybind11::object raised() const {
    return raised_ ? pybind11::object(raised_->value()) : pybind11::none();
  }

 private:
  std::optional<pybind11::error_already_set> raised_;
  std::atomic<bool> stop_{false};
};

}  // namespace hersey::python
