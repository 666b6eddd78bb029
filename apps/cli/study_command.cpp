#include "study_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>

#include "commands.h"
#include "exit_code.h"
#include "hersey/core/input_error.h"
#include "hersey/core/spelling.h"
#include "hersey/core/units.h"
#include "hersey/core/version.h"
#include "hersey/model/study.h"
#include "hersey/report/study_page.h"
#include "hersey/session/session.h"
#include "hersey/study/run_figures.h"
#include "standard_streams.h"

namespace hersey::cli {
namespace {

using nlohmann::json;

const char* word(model::StudyPlan plan) {
  constexpr std::array<const char*, 7> words{"full_factorial", "list",    "latin_hypercube", "sobol",
                                             "halton",         "corners", "optimise"};
  return words.at(static_cast<std::size_t>(plan));
}

const char* word(model::Distribution::Kind kind) {
  constexpr std::array<const char*, 4> words{"normal", "uniform", "triangular", "truncated_normal"};
  return words.at(static_cast<std::size_t>(kind));
}

const char* word(model::StudyKeep keep) {
  constexpr std::array<const char*, 3> words{"figures", "results", "report"};
  return words.at(static_cast<std::size_t>(keep));
}

const char* word(model::StudyDiagram diagram) {
  constexpr std::array<const char*, 3> words{"", "campbell", "run_up"};
  return words.at(static_cast<std::size_t>(diagram));
}

// The value in `unit`, null where it is no number.
json number_in(const std::string& text, const std::string& unit) {
  try {
    return convert(split_quantity(text), unit);
  } catch (const QuantityError&) {
    return nullptr;
  }
}

std::string unit_of(const std::string& text) {
  try {
    return split_quantity(text).unit;
  } catch (const QuantityError&) {
    return {};
  }
}

json json_of(const model::StudyParameter& parameter, const model::Model& model) {
  json entry{{"name", parameter.name}, {"values", parameter.values}, {"nominal", nullptr}};
  const std::string unit = parameter.distribution     ? parameter.distribution->unit
                           : parameter.values.empty() ? ""
                                                      : unit_of(parameter.values.front());
  entry["unit"] = unit;
  entry["numbers"] = json::array();
  for (const std::string& text : parameter.values) entry["numbers"].push_back(number_in(text, unit));
  if (const auto& d = parameter.distribution)
    entry["distribution"] = {{"kind", word(d->kind)}, {"mean", d->mean}, {"standard_deviation", d->standard_deviation},
                             {"low", d->low},         {"mode", d->mode}, {"high", d->high}};
  entry["key"] = parameter.name;
  for (const model::Parameter& own : model.parameters)
    if (own.name == parameter.name) {
      entry["nominal"] = number_in(own.text, unit);
      entry["key"] = "parameters." + parameter.name;
    }
  return entry;
}

// A bound in every unit that measures what it does: which one counts depends on the figure.
json bounds_of(const std::string& bound) {
  json bounds = json::object();
  const Quantity given = split_quantity(bound);
  std::set<std::string> units{"degC", "N.m", "J", "W", "kg", "rad", "1"};
  for (const Dimension& dimension : dimensions()) units.insert(dimension.si_unit);
  for (const std::string& unit : units) {
    try {
      bounds[unit] = convert(given, unit == "1" ? "" : unit);
    } catch (const QuantityError&) {
      continue;  // measures something else
    }
  }
  return bounds;
}

bool is_simulated(const model::Model& model) {
  if (!model.study || model.study->analysis == model::StudyAnalysis::as_model) return !model.is_of_bearings_alone();
  return model.study->analysis == model::StudyAnalysis::simulation;
}

void check_figures(const model::Model& model) {
  const bool simulated = is_simulated(model);
  const std::vector<std::string> known = simulated ? study::run_figure_keys() : study::steady_figure_keys(model);
  std::vector<Fault> faults;
  const auto check = [&](const std::string& name, const SourcePosition& position, const std::string& key) {
    if (study::is_among(name, known) || (simulated && study::is_of_a_series(name))) return;
    // Names of the same thing are near; the rest of the list is long.
    std::vector<std::string> near;
    const std::string thing = name.substr(0, name.find('.', name.find('.') + 1) + 1);
    for (const std::string& pattern : known) {
      const std::size_t open = pattern.find('<');
      near.push_back(thing.starts_with("bearings.") && open != std::string::npos && pattern.starts_with("bearings.<b>.")
                         ? thing + pattern.substr(13)
                         : pattern);
    }
    if (simulated)
      for (std::string& series : study::series_like(name)) near.push_back(std::move(series));
    faults.push_back(
        {position, key, "unknown figure '" + name + "'",
         "one of the names in docs/studies.md, such as " + (near.empty() ? std::string("-") : near.front()),
         did_you_mean(name, near)});
  };
  for (const model::StudyOutput& output : model.study->outputs) check(output.name, output.position, "study.outputs");
  for (const model::StudyObjective& objective : model.study->objectives)
    check(objective.name, objective.position, objective.is_maximised ? "study.maximise" : "study.minimise");
  for (const model::StudyConstraint& constraint : model.study->constraints)
    check(constraint.name, constraint.position, "study.subject_to");
  const std::string& series = model.study->spectrum_of;
  const std::string ending = ".max";  // any way to sum a series up
  if (!series.empty() && !study::is_of_a_series(series + ending)) {
    std::vector<std::string> near = study::series_like(series + ending);
    for (std::string& name : near) name.resize(name.size() - ending.size());
    faults.push_back({model.position_of("study.spectrum_of"), "study.spectrum_of", "unknown series '" + series + "'",
                      "one of docs/results-file.md, such as bearings.main.eccentricity.x", did_you_mean(series, near)});
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

// Where the Python module lies: beside an installed program, or in the sources of one that was built.
std::filesystem::path module_folder(const std::filesystem::path& program) {
  const std::filesystem::path bin = program.parent_path();
  for (const std::filesystem::path& folder :
       {bin / ".." / "share" / "hersey" / "python", bin / ".." / ".." / "python"}) {
    if (std::filesystem::exists(folder / "hersey_study" / "__main__.py"))
      return std::filesystem::weakly_canonical(folder);
  }
  return {};
}

std::filesystem::path own_path(const std::string& fallback) {
  std::error_code error;
  const std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? std::filesystem::absolute(fallback) : path;
}

session::Session session_of(const StudyPlanArguments& arguments) {
  if (arguments.text.empty()) return session::Session(arguments.model, arguments.overrides);
  std::ifstream file(arguments.text, std::ios::binary);
  if (!file) throw std::runtime_error(arguments.text + ": cannot be read");
  return {std::string{std::istreambuf_iterator<char>(file), {}}, arguments.model, arguments.overrides};
}

}  // namespace

int study_plan_command(const StudyPlanArguments& arguments) {
  const session::Session session = session_of(arguments);
  const model::Model& model = session.model();
  if (!model.study)
    throw InputError(Fault{{arguments.model, 0, 0}, "study", "no study", "a section `study` in the model file", ""});
  warn(model.warnings);
  const std::vector<model::StudyParameter> parameters = session.study_parameters();
  if (!arguments.any_figure) check_figures(model);
  const model::Study& study = *model.study;
  json document{{"model", std::filesystem::absolute(arguments.model).lexically_normal().string()},
                {"title", model.title},
                {"version", version()},
                {"fingerprint", arguments.text.empty() ? model::model_fingerprint(arguments.model) : ""},
                {"analysis", is_simulated(model) ? "simulation" : "steady"},
                {"set", arguments.overrides},
                {"plan", word(study.plan)},
                {"samples", study.samples},
                {"seed", study.seed},
                {"search", study.search == model::StudySearch::local ? "local" : "global"},
                {"keep", word(study.keep)},
                {"diagram", word(study.diagram)},
                {"spectrum_of", study.spectrum_of},
                {"bearings", json::array()},
                {"parameters", json::array()},
                {"outputs", json::array()},
                {"objectives", json::array()},
                {"constraints", json::array()}};
  for (const model::Bearing& bearing : model.bearings) document["bearings"].push_back(bearing.name);
  for (const model::StudyParameter& parameter : parameters) document["parameters"].push_back(json_of(parameter, model));
  for (const model::StudyOutput& output : study.outputs) document["outputs"].push_back(output.name);
  for (const model::StudyObjective& objective : study.objectives)
    document["objectives"].push_back({{"name", objective.name}, {"maximise", objective.is_maximised}});
  for (const model::StudyConstraint& constraint : study.constraints)
    document["constraints"].push_back({{"text", constraint.text},
                                       {"name", constraint.name},
                                       {"lower", constraint.is_lower},
                                       {"bounds", bounds_of(constraint.bound)}});
  fmt::print("{}\n", document.dump(1));
  return kOk;
}

int study_command(const StudyArguments& arguments) {
  const std::filesystem::path program = own_path(arguments.program);
  const std::filesystem::path folder = module_folder(program);
  if (folder.empty()) {
    say("hersey: the Python module of studies, hersey_study, is not beside the program; expected in "
        "<prefix>/share/hersey/python or in the sources\n");
    return kFailed;
  }
  const char* given = std::getenv("PYTHONPATH");
  const std::string path = folder.string() + (given != nullptr && *given != '\0' ? ":" + std::string(given) : "");
  ::setenv("PYTHONPATH", path.c_str(), 1);
  std::vector<std::string> words{"python3", "-m", "hersey_study", arguments.model, "--program", program.string()};
  const auto add = [&](const std::string& option, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {option, value});
  };
  for (const std::string& change : arguments.overrides) words.push_back("--set=" + change);
  add("--out", arguments.output.string());
  add("--on", arguments.on);
  add("--runner", arguments.runner);
  add("--partition", arguments.partition);
  if (arguments.jobs > 0) add("--jobs", std::to_string(arguments.jobs));
  if (arguments.chunk > 0) add("--chunk", std::to_string(arguments.chunk));
  if (arguments.again) words.emplace_back("--again");
  if (arguments.json) words.emplace_back("--json");
  add("--plan", arguments.plan);
  if (!arguments.plan.empty()) add("--text", arguments.text);
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& text : words) argv.push_back(text.data());
  argv.push_back(nullptr);
  // Debian's own interpreter has Debian's packages; another one on the path may not.
  const char* chosen = std::getenv("HERSEY_PYTHON");
  if (chosen != nullptr) ::execvp(chosen, argv.data());
  // An interpreter looks for its modules where its own name leads to: `python3` would be the first on the path.
  std::string debian = "/usr/bin/python3";
  argv.front() = debian.data();
  ::execv(debian.c_str(), argv.data());
  argv.front() = words.front().data();
  ::execvp("python3", argv.data());
  say("hersey: studies need Python: python3 cannot be started ({}); `scripts/setup study` installs what they use\n",
      std::strerror(errno));
  return kFailed;
}

int study_page_command(const std::filesystem::path& data, const std::filesystem::path& page) {
  std::ifstream file(data);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  report::write_study_page(text, page);
  return kOk;
}

}  // namespace hersey::cli
