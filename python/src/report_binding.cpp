#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bindings.h"
#include "hersey/core/hdf5_lock.h"
#include "hersey/report/order_tracking.h"
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

py::dict track_orders(const std::vector<double>& time, const std::vector<double>& angle,
                      const std::vector<double>& series, const std::vector<double>& orders, int revolutions,
                      std::size_t windows) {
  report::OrderTracks tracks;
  {
    const py::gil_scoped_release others_may_run;
    tracks =
        report::track_orders(time, angle, series, {.orders = orders, .revolutions = revolutions, .windows = windows});
  }
  const auto array = [](const auto& values) {
    return py::array(static_cast<py::ssize_t>(values.size()), values.data());
  };
  py::dict found;
  found["time"] = array(tracks.time), found["angle"] = array(tracks.angle), found["speed"] = array(tracks.speed);
  found["mean"] = array(tracks.mean), found["peak_to_peak"] = array(tracks.peak_to_peak);
  found["amplitude"] = array(tracks.amplitude);
  return found;
}

}  // namespace

void bind_report(py::module_& core) {
  using Guard = py::call_guard<py::gil_scoped_release>;
  core.def("write_report", &write_report, Guard());
  core.def(
      "summary_table_json", [](const Paths& results) { return report::summary_json(results); }, Guard());
  core.def("track_orders", &track_orders);
  // h5py keeps a lock of its own; who reads with it while a run writes in another thread takes the solver's too.
  core.def(
      "lock_hdf5", [] { hdf5_lock().lock(); }, Guard());
  core.def("unlock_hdf5", [] { hdf5_lock().unlock(); });
}

}  // namespace hersey::python
