#include <pybind11/stl.h>

#include <utility>
#include <variant>

#include "bindings.h"
#include "hersey/session/session.h"
#include "user_function.h"

namespace hersey::python {
namespace {

namespace py = pybind11;

// Every function of the model that depends on time, coordinates or rates.
template <class Do>
void for_each_function(model::Model& model, Do act) {
  const auto maybe = [&](std::optional<model::Function>& function) {
    if (function) act(*function);
  };
  for (model::Drive& drive : model.drives) act(drive.motion);
  for (model::Force& force : model.forces) {
    for (const auto& followed : functions_of(force)) act(*followed.function);
    if (auto* spring = std::get_if<model::SpringDamper>(&force.data)) maybe(spring->tension);
    if (auto* spring = std::get_if<model::CoordinateSpring>(&force.data)) maybe(spring->restoring);
  }
  for (model::CoordinateCoupling& coupling : model.couplings)
    for (model::CoordinateCoupling::Term& term : coupling.terms) maybe(term.function);
  for (model::Bearing& bearing : model.bearings)
    for (model::Function& function : bearing.feature_pressures) act(function);
}

// path, function, derivative, variables
using Given = std::tuple<std::string, py::object, py::object, std::size_t>;

// The model with Python's functions where expressions stand for them: "1 + 0*t" in the function's unit, which is so
// worth one unit in SI. What they cost is counted in the calls returned, in the same order.
std::pair<std::shared_ptr<session::Session>, std::vector<std::shared_ptr<UserCalls>>> with_functions(
    const session::Session& session, const std::vector<Given>& functions) {
  auto result = std::make_shared<session::Session>(session);
  std::vector<std::shared_ptr<UserCalls>> all;
  for (const auto& [path, function, derivative, variables] : functions) {
    auto calls = std::make_shared<UserCalls>();
    calls->name = path;
    bool found = false;
    for_each_function(result->model(), [&, &path = path, &function = function, &derivative = derivative,
                                        count = variables](model::Function& place) {
      if (place.path != path || !place.value || place.variables.size() != count) return;
      const std::vector<double> zeros(place.variables.size());
      const double unit = place.value->value(zeros);
      place.value = std::make_shared<UserFunction>(function, derivative, unit, calls);
      found = true;
    });
    if (!found)
      throw InputError(Fault{result->model().position_of(path), path,
                             "a Python function where the model has no function",
                             "a force, drive, pressure, tension, coupling or speed that may be an expression", ""});
    all.push_back(std::move(calls));
  }
  return {std::move(result), std::move(all)};
}

}  // namespace

void bind_functions(py::module_& core) {
  py::class_<UserCalls, std::shared_ptr<UserCalls>>(core, "UserCalls")
      .def_readonly("name", &UserCalls::name)
      .def_property_readonly("calls", [](const UserCalls& c) { return c.calls.load(); })
      .def_property_readonly("seconds", [](const UserCalls& c) { return c.seconds.load(); })
      .def_property_readonly("fault", [](const UserCalls& c) { return c.fault; })
      .def_property_readonly("exception",
                             [](const UserCalls& c) { return c.exception ? c.exception : py::object(py::none()); });
  core.def("with_functions", &with_functions);
}

}  // namespace hersey::python
