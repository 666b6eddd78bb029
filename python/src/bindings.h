#pragma once

#include <pybind11/pybind11.h>

/// The parts of the extension module hersey._core, each bound in a source of its own. What is pythonic about the
/// package is in the .py files beside; here is only what they cannot do themselves.
namespace hersey::python {

void bind_errors(pybind11::module_& core);
void bind_model(pybind11::module_& core);
void bind_bearing(pybind11::module_& core);
void bind_functions(pybind11::module_& core);
void bind_fem(pybind11::module_& core);
void bind_run(pybind11::module_& core);
void bind_simulation(pybind11::module_& core);
void bind_report(pybind11::module_& core);

}  // namespace hersey::python
