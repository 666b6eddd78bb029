#include "model_binding.h"

#include <pybind11/stl.h>

#include "bindings.h"
#include "hersey/core/units.h"
#include "hersey/model/bare_numbers.h"
#include "hersey/model/read.h"
#include "hersey/model/schema.h"
#include "hersey/model/short_names.h"
#include "hersey/model/written.h"
#include "hersey/run/simulate.h"

namespace hersey::python {
namespace {

namespace py = pybind11;
using Texts = std::vector<std::string>;

std::shared_ptr<CheckedModel> read_file(const std::string& path, const Texts& overrides) {
  // The text is what stands in the file: overrides are put into it again with every change.
  model::Model plain = model::read(path, overrides);
  std::string text = plain.resolved_text;
  for (std::size_t k = 0; k < overrides.size(); ++k) text.erase(0, text.find('\n') + 1);
  return std::make_shared<CheckedModel>(CheckedModel{std::move(text), path, overrides, std::move(plain)});
}

std::shared_ptr<CheckedModel> read_text(const std::string& text, const std::string& file, const Texts& overrides) {
  return std::make_shared<CheckedModel>(CheckedModel{text, file, overrides, model::read_text(text, file, overrides)});
}

Texts texts_of(const std::vector<Fault>& faults) {
  Texts texts;
  for (const Fault& fault : faults) texts.push_back(fault.text());
  return texts;
}

Texts bearings_of(const CheckedModel& checked) {
  Texts names;
  for (const model::Bearing& bearing : checked.model.bearings) names.push_back(bearing.name);
  return names;
}

std::vector<std::pair<std::string, Texts>> study_of(const CheckedModel& checked) {
  std::vector<std::pair<std::string, Texts>> parameters;
  if (!checked.model.study) return parameters;
  for (const model::StudyParameter& parameter : checked.model.study->parameters)
    parameters.emplace_back(parameter.name, parameter.values);
  return parameters;
}

py::tuple position_of(const CheckedModel& checked, const std::string& path) {
  const SourcePosition position = checked.model.position_of(path);
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
model::BearingKindNames names_of(const CheckedModel& checked, const std::string& bearing) {
  for (const model::Bearing& candidate : checked.model.bearings) {
    if (candidate.name != bearing) continue;
    model::BearingKindNames names = model::names_of_kind(candidate.kind->name(), bearing, candidate.lubricant).value();
    names.short_names = model::short_names(checked.model, candidate);
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
  py::class_<CheckedModel, std::shared_ptr<CheckedModel>>(core, "CheckedModel")
      .def_readonly("text", &CheckedModel::text)
      .def_readonly("file", &CheckedModel::file)
      .def_readonly("overrides", &CheckedModel::overrides)
      .def_property_readonly("title", [](const CheckedModel& c) { return c.model.title; })
      .def_property_readonly("description", [](const CheckedModel& c) { return c.model.description; })
      .def_property_readonly("warnings", [](const CheckedModel& c) { return texts_of(c.model.warnings); })
      .def_property_readonly("resolved_text", [](const CheckedModel& c) { return c.model.resolved_text; })
      .def_property_readonly("is_of_bearings_alone",
                             [](const CheckedModel& c) { return c.model.is_of_bearings_alone(); })
      .def_property_readonly("bearings", &bearings_of)
      .def_property_readonly("study", &study_of)
      .def("names_of", &names_of)
      .def("position_of", &position_of)
      .def(
          "check", [](const CheckedModel& c) { return texts_of(run::check(c.model)); }, Guard());
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
