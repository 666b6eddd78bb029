#include <pybind11/stl.h>

#include <memory>

#include "bindings.h"
#include "hersey/core/units.h"
#include "hersey/model/bare_numbers.h"
#include "hersey/model/schema.h"
#include "hersey/model/short_names.h"
#include "hersey/model/written.h"
#include "hersey/run/simulate.h"
#include "hersey/session/session.h"

namespace hersey::python {
namespace {

namespace py = pybind11;
using session::Session;
using Texts = std::vector<std::string>;

std::shared_ptr<Session> read_file(const std::string& path, const Texts& overrides) {
  return std::make_shared<Session>(path, overrides);
}

std::shared_ptr<Session> read_text(const std::string& text, const std::string& file, const Texts& overrides) {
  return std::make_shared<Session>(text, file, overrides);
}

Texts texts_of(const std::vector<Fault>& faults) {
  Texts texts;
  for (const Fault& fault : faults) texts.push_back(fault.text());
  return texts;
}

Texts bearings_of(const Session& session) {
  Texts names;
  for (const model::Composite& composite : session.model().composites) names.push_back(composite.bearing.name);
  for (const model::Bearing& bearing : session.model().bearings) names.push_back(bearing.name);
  return names;
}

std::vector<std::pair<std::string, Texts>> study_of(const Session& session) {
  std::vector<std::pair<std::string, Texts>> parameters;
  if (!session.model().study) return parameters;
  for (const model::StudyParameter& parameter : session.model().study->parameters)
    parameters.emplace_back(parameter.name, parameter.values);
  return parameters;
}

// The overrides of each run that the study writes out.
std::vector<Texts> runs_of(const Session& session) {
  std::vector<Texts> runs;
  for (model::StudyRun& run : session.runs()) runs.push_back(std::move(run.overrides));
  return runs;
}

py::tuple position_of(const Session& session, const std::string& path) {
  const SourcePosition position = session.model().position_of(path);
  return py::make_tuple(position.file, position.line, position.column);
}

// path, SI unit, parameter
py::list bare_numbers(const std::string& text, const std::string& file, const Texts& overrides) {
  py::list found;
  for (const model::BareNumber& each : model::bare_numbers(text, file, overrides))
    found.append(py::make_tuple(each.path, each.unit, each.parameter));
  return found;
}

/// Names of the kind of a bearing that is there, with the paths that its short names have in this model.
model::BearingKindNames names_of(const Session& session, const std::string& bearing) {
  for (const model::Composite& composite : session.model().composites) {
    const model::Bearing& candidate = composite.bearing;
    if (candidate.name != bearing) continue;
    model::BearingKindNames names = model::names_of_kind(composite.kind, bearing, candidate.lubricant).value();
    names.short_names = model::short_names(session.model(), candidate);
    return names;
  }
  for (const model::Bearing& candidate : session.model().bearings) {
    if (candidate.name != bearing) continue;
    model::BearingKindNames names = model::names_of_kind(candidate.kind->name(), bearing, candidate.lubricant).value();
    names.short_names = model::short_names(session.model(), candidate);
    return names;
  }
  throw py::key_error(bearing);
}

/// {short name: key path}, in their order.
py::dict paths_of(const model::BearingKindNames& names) {
  py::dict paths;
  for (const auto& [name, path] : names.short_names.paths) paths[py::str(name)] = path;
  return paths;
}

}  // namespace

void bind_model(py::module_& core) {
  using Guard = py::call_guard<py::gil_scoped_release>;
  py::class_<model::BearingKindNames>(core, "BearingKindNames")
      .def_readonly("kind", &model::BearingKindNames::kind)
      .def_readonly("title", &model::BearingKindNames::title)
      .def_readonly("point_keys", &model::BearingKindNames::point_keys)
      .def_property_readonly("paths", &paths_of)
      .def_property_readonly("load_or_position",
                             [](const model::BearingKindNames& n) { return n.short_names.load_or_position; });
  py::class_<Session, std::shared_ptr<Session>>(core, "Session")
      .def_property_readonly("text", &Session::text)
      .def_property_readonly("file", &Session::file)
      .def_property_readonly("overrides", &Session::overrides)
      .def_property_readonly("title", [](const Session& s) { return s.model().title; })
      .def_property_readonly("description", [](const Session& s) { return s.model().description; })
      .def_property_readonly("warnings", [](const Session& s) { return texts_of(s.model().warnings); })
      .def_property_readonly("resolved_text", [](const Session& s) { return s.model().resolved_text; })
      .def_property_readonly("is_of_bearings_alone", [](const Session& s) { return s.model().is_of_bearings_alone(); })
      .def_property_readonly("bearings", &bearings_of)
      .def_property_readonly("study", &study_of)
      .def("names_of", &names_of)
      .def("position_of", &position_of)
      .def("runs", &runs_of, Guard())
      .def(
          "check", [](const Session& s) { return texts_of(run::check(s.model())); }, Guard());
  core.def("model_name", &session::model_name);
  core.def("names_of_kind", &model::names_of_kind);
  core.def("read_file", &read_file, Guard());
  core.def("read_text", &read_text, Guard());
  core.def("bare_numbers", &bare_numbers);
  core.def("written_json", &model::written_json, Guard());
  core.def("schema_json", &model::schema_json);
  core.def("parse_quantity",
           [](const std::string& text, const std::string& unit) { return parse_quantity(text, unit); });
}

}  // namespace hersey::python
