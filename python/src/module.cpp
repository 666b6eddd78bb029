#include "bindings.h"
#include "hersey/core/blas_threads.h"
#include "hersey/core/version.h"

PYBIND11_MODULE(_core, core) {
  core.doc() = "The solver of hersey; use the package hersey, which is made of it.";
  // As the program does: results must not depend on how many threads BLAS finds.
  hersey::use_one_blas_thread();
  core.attr("__version__") = std::string(hersey::version());
  hersey::python::bind_errors(core);
  hersey::python::bind_model(core);
  hersey::python::bind_bearing(core);
  hersey::python::bind_functions(core);
  hersey::python::bind_fem(core);
  hersey::python::bind_run(core);
  hersey::python::bind_simulation(core);
  hersey::python::bind_report(core);
}
