#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cstring>
#include <memory>

#include "bindings.h"
#include "hersey/run/summary_json.h"
#include "hersey/session/session.h"

// Stepping: what hersey.Simulation is made of. Steps hold no lock of the interpreter; functions of Python's in the
// model take it themselves.
namespace hersey::python {
namespace {

namespace py = pybind11;
using Unlocked = py::call_guard<py::gil_scoped_release>;

/// What Simulation::save() gives; Python only hands it back.
struct SavedState {
  Archive::Content content;
};

// A state as plain data: {name: (shape, bytes of the numbers)}, {name: bytes of the text}.
py::tuple parts_of(const SavedState& state) {
  py::dict numbers, texts;
  for (const auto& [name, kept] : state.content.numbers)
    numbers[py::str(name)] = py::make_tuple(
        kept.shape, py::bytes(reinterpret_cast<const char*>(kept.values.data()), kept.values.size() * sizeof(double)));
  for (const auto& [name, text] : state.content.texts) texts[py::str(name)] = py::bytes(text);
  return py::make_tuple(numbers, texts);
}

SavedState state_of(const py::tuple& parts) {
  SavedState state;
  for (const auto& [name, kept] : parts[0].cast<py::dict>()) {
    const auto pair = kept.cast<py::tuple>();
    Archive::Numbers& numbers = state.content.numbers[name.cast<std::string>()];
    numbers.shape = pair[0].cast<decltype(numbers.shape)>();
    const auto bytes = pair[1].cast<std::string>();
    numbers.values.resize(bytes.size() / sizeof(double));
    std::memcpy(numbers.values.data(), bytes.data(), numbers.values.size() * sizeof(double));
  }
  for (const auto& [name, text] : parts[1].cast<py::dict>())
    state.content.texts[name.cast<std::string>()] = text.cast<std::string>();
  return state;
}

std::unique_ptr<run::Simulation> make(const session::Session& session, const std::string& results, bool overwrite) {
  return std::make_unique<run::Simulation>(session.simulation(results, overwrite));
}

py::tuple as_tuple(const run::Advance& advance) {
  static constexpr const char* names[]{"failed", "advanced", "ended"};
  return py::make_tuple(names[static_cast<int>(advance.status)], advance.message);
}

py::tuple advance_to(run::Simulation& simulation, double t) {
  run::Advance advance;
  {
    const py::gil_scoped_release open;
    advance = simulation.advance_to(t);
  }
  return as_tuple(advance);
}

py::tuple step(run::Simulation& simulation) {
  run::Advance advance;
  {
    const py::gil_scoped_release open;
    advance = simulation.step();
  }
  return as_tuple(advance);
}

py::list inputs(const run::Simulation& simulation) {
  py::list list;
  for (const run::InputInfo& port : simulation.inputs())
    list.append(py::make_tuple(port.name, port.unit, port.text, port.start));
  return list;
}

py::list outputs(const run::Simulation& simulation) {
  py::list list;
  for (const run::OutputInfo& port : simulation.outputs())
    list.append(py::make_tuple(port.name, port.unit, port.text, port.shape, port.components));
  return list;
}

py::array_t<double> output(const run::Simulation& simulation, std::size_t place) {
  const std::vector<double>& values = simulation.output(place);
  const std::vector<std::size_t>& shape = simulation.outputs().at(place).shape;
  py::array_t<double> array(std::vector<py::ssize_t>(shape.begin(), shape.end()));
  std::copy(values.begin(), values.end(), array.mutable_data());
  return array;
}

}  // namespace

void bind_simulation(py::module_& core) {
  py::class_<SavedState>(core, "SavedState").def(py::pickle(&parts_of, &state_of));
  py::class_<run::Simulation>(core, "Simulation")
      .def(py::init(&make), Unlocked())
      .def_property_readonly("time", &run::Simulation::time)
      .def_property_readonly("start", &run::Simulation::start)
      .def_property_readonly("end", &run::Simulation::end)
      .def("step", &step)
      .def("advance_to", &advance_to)
      .def("inputs", &inputs)
      .def("outputs", &outputs)
      .def("set", &run::Simulation::set, Unlocked())
      .def("release", &run::Simulation::release, Unlocked())
      .def("input", &run::Simulation::input, Unlocked())
      .def("output", &output)
      .def(
          "save", [](run::Simulation& simulation) { return SavedState{simulation.save()}; }, Unlocked())
      .def(
          "restore", [](run::Simulation& simulation, const SavedState& state) { simulation.restore(state.content); },
          Unlocked())
      .def(
          "summary_json", [](const run::Simulation& s) { return run::summary_json(s.summary()); }, Unlocked())
      .def(
          "finish_json", [](run::Simulation& s) { return run::summary_json(s.finish()); }, Unlocked());
}

}  // namespace hersey::python
