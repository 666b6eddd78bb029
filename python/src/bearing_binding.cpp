#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <chrono>
#include <future>

#include "bindings.h"
#include "hersey/bearing/film_coordinates.h"
#include "hersey/bearing/steady_bearing.h"
#include "hersey/run/film_fields.h"
#include "hersey/session/session.h"
#include "interruption.h"

namespace hersey::python {
namespace {

namespace py = pybind11;
using study::BearingSolution;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// How often a sweep looks whether Python has something to say.
constexpr std::chrono::milliseconds kPause{50};

study::BearingStudyOptions options_of(const std::string& bearing, bool grid_error, const std::string& coefficients) {
  study::BearingStudyOptions options{.bearing = bearing, .grid_error = grid_error};
  if (coefficients == "total") options.thermal_coefficients = study::ThermalCoefficients::total;
  return options;
}

BearingSolution solve(const study::BearingSolver& solver, const session::Session& session, const std::string& bearing,
                      bool grid_error, const std::string& coefficients) {
  return session.solve_bearing(solver, options_of(bearing, grid_error, coefficients));
}

// One combination of a sweep: label, overrides, and the values that tell neighbours.
using Combination = std::tuple<std::string, std::vector<std::string>, std::vector<std::string>>;

/// Waits for `work`, which holds no lock of the interpreter, and asks meanwhile whether Python has something to say.
void wait_for(const std::future<std::vector<BearingSolution>>& work, Interruption& interruption) {
  for (bool is_done = false; !is_done; interruption.listen()) {
    const py::gil_scoped_release open;
    is_done = work.wait_for(kPause) == std::future_status::ready;
  }
}

// The solutions, and what Python raised meanwhile, or None: then runs that were not begun have none.
py::tuple solve_all(const session::Session& session, const std::vector<Combination>& combinations,
                    const std::string& bearing, bool grid_error, const std::string& coefficients, int threads) {
  std::vector<model::StudyRun> runs;
  for (const auto& [label, overrides, values] : combinations) {
    model::StudyRun& run = runs.emplace_back();
    run.label = label;
    run.overrides = overrides;
    for (const std::string& value : values) run.values.push_back({"", value, 0, ""});
  }
  study::BearingStudyOptions options = options_of(bearing, grid_error, coefficients);
  options.threads = threads;
  Interruption interruption;
  options.stop = &interruption.stop();
  std::future<std::vector<BearingSolution>> work =
      std::async(std::launch::async, [&] { return session.solve_bearings(runs, options); });
  wait_for(work, interruption);
  return py::make_tuple(work.get(), interruption.raised());
}

// key path, value, unit, whether exact, why there is none, derivative of each figure; `usual`: those to the keys that
// decide about a bearing, too.
py::list sensitivities(const session::Session& session, const BearingSolution& solution, const std::string& bearing,
                       const std::string& coefficients, bool usual, const std::vector<std::string>& keys) {
  std::vector<study::Sensitivity> found;
  {
    const py::gil_scoped_release open;
    found = session.sensitivities(solution, options_of(bearing, false, coefficients), keys, usual);
  }
  py::list list;
  for (const study::Sensitivity& each : found)
    list.append(py::make_tuple(each.parameter, each.value, each.unit, each.exact, each.message, each.slopes));
  return list;
}

// key, name, group, unit, SI unit, size of the unit, value in the unit, grid error in the unit, words
py::list figures_of(const BearingSolution& solution) {
  py::list figures;
  if (!solution.solved()) return figures;
  for (const study::BearingFigure& f : study::figures_of(solution))
    figures.append(py::make_tuple(f.key, f.name, f.group, f.unit, f.si_unit, f.si, f.value, f.grid_error, f.words));
  return figures;
}

py::array_t<double> on_grid(const film::FilmModel& model, const Eigen::VectorXd& values) {
  py::array_t<double> grid({model.grid.n_phi, model.grid.n_z});
  auto view = grid.mutable_unchecked<2>();
  for (int i = 0; i < model.grid.n_phi; ++i)
    for (int j = 0; j < model.grid.n_z; ++j) view(i, j) = values[model.grid.index(i, j)];
  return grid;
}

// {name: (unit, text, values over both dimensions)}
py::dict fields_of(const BearingSolution& solution) {
  py::dict fields;
  const film::FilmFields found = study::fields_of(solution);
  for (const run::FilmField& field : run::film_fields())
    if (const Eigen::VectorXd values = field.values(found); values.size() > 0)
      fields[py::str(field.name)] = py::make_tuple(field.unit, field.text, on_grid(solution.model, values));
  return fields;
}

// Dimensions of the fields: [(name, SI unit, text, positions of the nodes)], as results files name them.
py::list dimensions_of(const BearingSolution& solution) {
  py::list dimensions;
  for (const bearing::FilmCoordinate& c :
       {bearing::coordinate_along(solution.model), bearing::coordinate_across(solution.model)})
    dimensions.append(py::make_tuple(c.name, c.unit, c.text, c.values));
  return dimensions;
}

bool has_axis(const BearingSolution& solution) { return !solution.state.kind || solution.state.kind->has_axis(); }

}  // namespace

void bind_bearing(py::module_& core) {
  using Guard = py::call_guard<py::gil_scoped_release>;
  py::class_<BearingSolution>(core, "BearingSolution")
      .def_property_readonly("error", [](const BearingSolution& s) { return s.message; })
      .def_property_readonly("label", [](const BearingSolution& s) { return s.run.label; })
      .def_property_readonly("warnings", [](const BearingSolution& s) { return s.warnings; })
      .def_property_readonly("linearisations", [](const BearingSolution& s) { return s.summary.iterations; })
      .def_property_readonly("wall_time", [](const BearingSolution& s) { return s.wall_time; })
      .def_property_readonly("kind", &study::kind_of)
      .def_property_readonly("has_axis", &has_axis)
      .def_property_readonly("position", [](const BearingSolution& s) { return s.state.e; })
      .def_property_readonly("load", [](const BearingSolution& s) { return s.state.load; })
      .def_property_readonly("clearance",
                             [](const BearingSolution& s) { return bearing::clearance(s.model, s.state.point); })
      .def_property_readonly("stiffness",
                             [](const BearingSolution& s) -> RowMajor { return s.state.coefficients.stiffness; })
      .def_property_readonly("damping",
                             [](const BearingSolution& s) -> RowMajor { return s.state.coefficients.damping; })
      .def("dimensions", &dimensions_of)
      .def("figures", &figures_of)
      .def("fields", &fields_of);
  py::class_<study::BearingSolver>(core, "BearingSolver").def(py::init<>()).def("solve", &solve, Guard());
  core.def("solve_all", &solve_all);
  core.def("figure_keys", &study::figure_keys);
  core.attr("not_begun") = study::kNotBegun;
  core.def("sensitivities", &sensitivities);
}

}  // namespace hersey::python
