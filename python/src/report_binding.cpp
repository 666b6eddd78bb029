#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bindings.h"
#include "hersey/core/hdf5_lock.h"
#include "hersey/report/report.h"

namespace hersey::python {
namespace {

namespace py = pybind11;
using Paths = std::vector<std::filesystem::path>;

void write_report(const Paths& results, const std::filesystem::path& out, const std::string& title,
                  const std::vector<std::string>& names) {
  report::ReportOptions options;
  options.title = title;
  options.names = names;
  report::write_html(results, out, options);
}

}  // namespace

void bind_report(py::module_& core) {
  using Guard = py::call_guard<py::gil_scoped_release>;
  core.def("write_report", &write_report, Guard());
  core.def(
      "summary_table_json", [](const Paths& results) { return report::summary_json(results); }, Guard());
  // h5py keeps a lock of its own; who reads with it while a run writes in another thread takes the solver's too.
  core.def(
      "lock_hdf5", [] { hdf5_lock().lock(); }, Guard());
  core.def("unlock_hdf5", [] { hdf5_lock().unlock(); });
}

}  // namespace hersey::python
