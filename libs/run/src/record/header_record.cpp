#include "record/header_record.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <utility>

#include "hersey/core/version.h"
#include "hersey/run/assumptions.h"
#include "start/film_surface_rows.h"
#include "start/redundancies.h"
#include "start/start_changes.h"

namespace hersey::run {
namespace {

struct HeaderPlan {
  const model::Model& model;
  const Options& options;
};

std::string time_now() {
  const auto time = std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(time));
}

std::vector<std::string> study_parameters(const HeaderPlan& plan) {
  std::vector<std::string> names;
  for (const StudyParameterValue& value : plan.options.study_parameters) names.push_back(value.name);
  return names;
}

/// Path from the folder of the results, so that both can be moved together; absolute where there is none.
std::string model_file(const HeaderPlan& plan) {
  const std::filesystem::path file = std::filesystem::absolute(plan.model.file);
  if (plan.options.results.empty()) return file.lexically_normal().string();
  return file.lexically_proximate(std::filesystem::absolute(plan.options.results).parent_path()).string();
}

const std::vector<Attribute<HeaderPlan>>& header_attributes() {
  static const std::vector<Attribute<HeaderPlan>> table{
      {"hersey_version", "", "of the program", [](const HeaderPlan& /*plan*/) { return std::string(version()); }},
      {"title", "", "of the model", [](const HeaderPlan& plan) { return plan.model.title; }},
      {"description", "", "of the model", [](const HeaderPlan& plan) { return plan.model.description; }},
      {"model_file", "", "the model file, from the folder of these results: meshes and tables are sought beside it",
       model_file},
      {"created", "", "time of the run (ISO 8601, UTC)", [](const HeaderPlan& /*plan*/) { return time_now(); }},
      {"study_parameters",
       "",
       "names of the parameters a study varies, the first is the abscissa",
       study_parameters,
       {.note = "absent outside studies",
        .only = [](const HeaderPlan& plan) { return !study_parameters(plan).empty(); }}},
  };
  return table;
}

std::vector<std::pair<std::string, std::string>> all_parameters(const HeaderPlan& plan) {
  std::vector<std::pair<std::string, std::string>> all;
  for (const model::Parameter& parameter : plan.model.parameters) all.emplace_back(parameter.name, parameter.text);
  for (const StudyParameterValue& value : plan.options.study_parameters) all.emplace_back(value.name, value.text);
  return all;
}

const std::vector<Attribute<HeaderPlan>>& parameter_attributes() {
  static const std::vector<Attribute<HeaderPlan>> table{
      {"<parameter>",
       "",
       "of the model, as text with unit",
       [](const HeaderPlan& plan, std::size_t k) { return all_parameters(plan)[k].second; },
       {.each = [](const HeaderPlan& plan) {
         std::vector<std::string> names;
         for (auto& [name, text] : all_parameters(plan)) names.push_back(std::move(name));
         return names;
       }}}};
  return table;
}

const char* const text_of_model = "model file of this run, overrides noted";
const char* const text_of_assumptions = "what decides the results: name, text";

const std::vector<Attribute<StepErrors>>& step_error_attributes() {
  using E = StepErrors;
  const auto with_summary_entry = [](const char* name, const char* unit) {
    return More<E>{
        .summary_entries = {{SummaryEntry::Statistic::at_end, std::string("error by the step: ") + name, unit}}};
  };
  static const std::vector<Attribute<E>> table{
      {"moft", "m", "size of the error of the smallest film thickness, estimated", &E::moft,
       with_summary_entry("minimum film thickness (MOFT)", "µm")},
      {"pofp", "Pa", "the same of the peak film pressure", &E::pofp,
       with_summary_entry("peak film pressure (POFP)", "MPa")},
      {"max_force", "N", "of the largest film force", &E::max_force, with_summary_entry("largest film force", "N")},
      {"mean_power", "W", "of the mean power loss", &E::mean_power, with_summary_entry("mean power loss", "W")},
      {"mean_flow", "m^3/s", "of the mean side flow, both sides", &E::mean_flow,
       with_summary_entry("mean side flow, both sides", "mm³/s")},
  };
  return table;
}

}  // namespace

void write_header(const model::Model& model, const model::Machine& machine, const solver::State& start,
                  const Options& options, results::Writer& writer) {
  const HeaderPlan plan{model, options};
  write_once(header_attributes(), "/", plan, writer);
  write_once(parameter_attributes(), "/parameters/", plan, writer);
  writer.text("/model", model.resolved_text, text_of_model);
  std::vector<std::pair<std::string, std::string>> texts = assumptions(model);
  for (auto& text : film_surface_rows(model, machine)) texts.push_back(std::move(text));
  for (auto& text : start_rows(model, *machine.mechanism, start)) texts.push_back(std::move(text));
  for (auto& text : redundancies(*machine.mechanism)) texts.push_back(std::move(text));
  writer.text_table("/assumptions", texts, text_of_assumptions);
}

std::vector<QuantityGroup> describe_header() {
  using Kind = QuantityInfo::Kind;
  QuantityGroup root{.path = "/", .heading = "of the run", .quantities = {}};
  const auto add = [&](const char* name, const char* text, const char* note, Kind kind, const char* shape = "") {
    const char* unit = kind == Kind::attribute ? "" : "1";
    root.quantities.push_back({.name = name, .unit = unit, .text = text, .shape = shape, .note = note, .kind = kind});
  };
  // The writer's own.
  add("format", "`hersey-results`", "", Kind::attribute);
  add("format_version", "1", "", Kind::attribute);
  add("status", "state of the run, see below", "", Kind::attribute);
  add("message", "reason of this state", "", Kind::attribute);
  describe(header_attributes(), "n", root);
  add("model", text_of_model, "", Kind::constant, "text");
  add("assumptions", text_of_assumptions, "cavitation, edges, supply, clearance, grid, integrator", Kind::constant,
      "[k, 2] text");
  root.quantities.back().dimensions = {"assumptions_row", "assumptions_column"};
  add("xy", "components of vectors", "dimension", Kind::constant, "[2] text");
  add("xyz", "components of vectors", "dimension", Kind::constant, "[3] text");
  add("wxyz", "components of vectors", "dimension: of quaternions", Kind::constant, "[4] text");
  QuantityGroup of_parameters{.path = "/parameters/", .heading = "of the parameters", .quantities = {}};
  describe(parameter_attributes(), "n", of_parameters);
  return {root, of_parameters};
}

void write_step_errors(const std::string& bearing, const StepErrors& errors, results::Writer& writer) {
  write_once(step_error_attributes(), "/step_errors/" + bearing + "/", errors, writer);
}

QuantityGroup describe_step_errors() {
  QuantityGroup group{.path = "/step_errors/<bearing>/",
                      .heading =
                          "of a run with `--step-error`: what the length of the steps has done to a bearing's "
                          "figures; NaN where the run did not end",
                      .quantities = {}};
  describe(step_error_attributes(), "n", group);
  return group;
}

}  // namespace hersey::run
