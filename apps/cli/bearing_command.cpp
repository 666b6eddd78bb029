#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bearing_page.h"
#include "bearing_table.h"
#include "coefficient_table.h"
#include "commands.h"
#include "exit_code.h"
#include "hersey/core/input_error.h"
#include "hersey/core/write_file.h"
#include "hersey/fem/vtu_file.h"
#include "hersey/model/short_names.h"
#include "hersey/results/error.h"
#include "hersey/session/output_file.h"
#include "hersey/session/session.h"
#include "standard_streams.h"
#include "timing_table.h"

namespace hersey::cli {
namespace {

// Short names of the parameters that are varied most, with the key paths of the present bearing.
class ShortNames {
 public:
  ShortNames(const model::Model& model, const model::Bearing& bearing)
      : model_(model), bearing_(bearing), names_(model::short_names(model, bearing)) {}

  // A parameter of the model comes before a short name, but not before one of the operating point where the file gives
  // none: a machine's parameter `speed` is then that of its motor. Any other name is a key path already.
  [[nodiscard]] std::string path_of(const std::string& name) const {
    const bool is_of_point = key_path(name).find(".operating_point.") != std::string::npos;
    if (is_of_point && !bearing_.operating_point) return key_path(name);
    const bool is_parameter = std::any_of(model_.parameters.begin(), model_.parameters.end(),
                                          [&](const model::Parameter& parameter) { return parameter.name == name; });
    return is_parameter ? name : key_path(name);
  }

  [[nodiscard]] std::string key_path(const std::string& name) const {
    const auto& paths = names_.paths;
    const auto found = std::find_if(paths.begin(), paths.end(), [&](const auto& pair) { return pair.first == name; });
    return found == paths.end() ? name : found->second;
  }

  // The two names of which one is given.
  [[nodiscard]] const std::pair<std::string, std::string>& load_or_position() const { return names_.load_or_position; }

 private:
  const model::Model& model_;
  const model::Bearing& bearing_;
  model::ShortNames names_;
};

// Operating points to be solved, from the command line and the file.
struct Plan {
  std::vector<std::string> overrides;
  std::vector<model::StudyParameter> sweeps;
};

// A load on the command line replaces a position in the file, and vice versa.
void replace_other(const ShortNames& names, const model::Bearing& bearing, Plan& plan) {
  if (!bearing.operating_point) return;
  const auto is_set = [&](const std::string& name) {
    const std::string path = names.key_path(name);
    const bool by_option = std::any_of(plan.overrides.begin(), plan.overrides.end(),
                                       [&](const std::string& text) { return text.starts_with(path + "="); });
    return by_option || std::any_of(plan.sweeps.begin(), plan.sweeps.end(),
                                    [&](const model::StudyParameter& sweep) { return sweep.name == path; });
  };
  const auto& [load, position] = names.load_or_position();
  if (load.empty()) return;  // a kind that is given no load
  const bool has_load = std::visit(
      [](const auto& point) {
        if constexpr (requires { point.load; })
          return point.load.has_value();
        else
          return false;
      },
      *bearing.operating_point);
  if (is_set(position) && !is_set(load) && has_load) plan.overrides.push_back(names.key_path(load) + "=none");
  if (is_set(load) && !is_set(position) && !has_load) plan.overrides.push_back(names.key_path(position) + "=none");
}

Plan plan_of(const BearingArguments& arguments, const model::Model& model) {
  const model::Bearing& bearing = study::bearing_called(model, arguments.bearing);
  const ShortNames names(model, bearing);
  Plan plan{arguments.overrides, {}};
  const std::array<std::pair<const char*, const std::string*>, 6> options{
      {{"speed", &arguments.speed},
       {"shell_speed", &arguments.shell_speed},
       {"load", &arguments.load},
       {"load_angle", &arguments.load_angle},
       {"eccentricity_ratio", &arguments.eccentricity_ratio},
       {"eccentricity_angle", &arguments.eccentricity_angle}}};
  for (const auto& [name, text] : options) {
    if (!text->empty()) plan.overrides.push_back(names.key_path(name) + "=" + *text);
  }
  for (const std::string& text : arguments.sweeps) {
    plan.sweeps.push_back(study::parse_sweep(text));
    plan.sweeps.back().name = names.path_of(plan.sweeps.back().name);
  }
  if (!arguments.whirl_ratios.empty()) {
    const std::string path = names.path_of("whirl_ratio");
    if (path == "whirl_ratio")
      throw InputError(Fault{{"--whirl-ratio", 0, 0},
                             "bearings." + bearing.name,
                             "a bearing without parts that follow its journal",
                             "a bearing of `kind: tilting_pad`, `tilting_pad_thrust` or `floating_ring`; the "
                             "coefficients of others hold at every "
                             "frequency",
                             ""});
    plan.sweeps.push_back(study::parse_sweep("whirl_ratio=" + arguments.whirl_ratios));
    plan.sweeps.back().name = path;
  }
  replace_other(names, bearing, plan);
  // Each value is checked with the others at their first, so that a sweep may complete what the file leaves open.
  for (const model::StudyParameter& sweep : plan.sweeps) {
    plan.overrides.push_back(sweep.name + "=" + sweep.values.front());
  }
  return plan;
}

std::vector<model::StudyRun> runs_of(const session::Session& session, const Plan& plan) {
  std::vector<model::StudyRun> runs = session.runs(plan.overrides, plan.sweeps);
  if (runs.empty()) runs.push_back({plan.overrides, "", "", {}});
  // The last part of a key path suffices in a table.
  for (model::StudyRun& run : runs) {
    run.label.clear();
    for (const model::StudyValue& value : run.values) {
      const std::string name = value.name.substr(value.name.find_last_of('.') + 1);
      run.label += (run.label.empty() ? "" : ", ") + name + " = " + value.text;
    }
  }
  return runs;
}

void write(const std::filesystem::path& path, const std::string& text) {
  try {
    write_file(path, {text});
  } catch (const std::runtime_error& error) {
    throw results::WriteError(path, std::string("the file cannot be written: ") + error.what());
  }
}

// Reports files that a study or another kind of shell has no content for.
void require_one(const BearingArguments& arguments, const model::Model& model, std::size_t runs) {
  for (const auto& [option, file] : {std::pair("--fields", arguments.fields), std::pair("--vtu", arguments.vtu)})
    if (!file.empty() && runs > 1)
      throw InputError(Fault{{option, 0, 0}, "", fmt::format("{} solutions", runs), "a single one", ""});
  if (arguments.coefficients.empty() && arguments.coefficients_for != "hersey")
    throw InputError(Fault{{"--coefficients-for", 0, 0}, "", "no file for it", "--coefficients FILE as well", ""});
  const model::Bearing& bearing = study::bearing_called(model, arguments.bearing);
  if (arguments.vtu.empty() || bearing.heated_shell || bearing.heated_journal) return;
  throw InputError(Fault{{"--vtu", 0, 0},
                         "",
                         "a bearing whose walls are in no body that conducts heat",
                         "a bearing with `thermal: {model: film, shell: {wall: body}}`, or such a journal",
                         ""});
}

// Temperatures of a body that a wall is in, on its mesh.
void write_body(const std::filesystem::path& file, const model::Model& model, const std::string& name,
                const Eigen::VectorXd& T) {
  const auto body = std::find_if(model.bodies.begin(), model.bodies.end(),
                                 [&](const model::Body& candidate) { return candidate.name == name; });
  fem::VtuFrame frame;
  frame.node_fields.push_back({"temperature", T.transpose()});
  fem::write_vtu(file, *body->flexible->mesh, frame);
}

// Of shell and journal; where both are bodies the journal's has a file beside the shell's.
void write_bodies(const BearingArguments& arguments, const model::Model& model,
                  const study::BearingSolution& solution) {
  const model::Bearing& bearing = study::bearing_called(model, arguments.bearing);
  const std::filesystem::path given = arguments.vtu;
  if (bearing.heated_shell) write_body(given, model, bearing.shell.body, solution.state.heat->T_body);
  if (!bearing.heated_journal) return;
  std::filesystem::path beside = given;
  if (bearing.heated_shell) beside.replace_filename(given.stem().string() + "_journal" + given.extension().string());
  write_body(beside, model, bearing.journal.body, solution.state.heat->T_journal_body);
}

// One list per solution.
std::vector<std::vector<study::Sensitivity>> sensitivities_of(const BearingArguments& arguments,
                                                              const session::Session& session,
                                                              const study::BearingStudyOptions& options,
                                                              const std::vector<study::BearingSolution>& solutions) {
  std::vector<std::vector<study::Sensitivity>> all(solutions.size());
  if (!arguments.sensitivity && arguments.sensitivity_to.empty()) return all;
  for (std::size_t k = 0; k < solutions.size(); ++k)
    all[k] = session.sensitivities(solutions[k], options, arguments.sensitivity_to, arguments.sensitivity);
  return all;
}

void print(const BearingArguments& arguments, const std::vector<study::BearingSolution>& solutions,
           const std::vector<std::vector<study::Sensitivity>>& sensitivities) {
  if (arguments.json) {
    nlohmann::json document{{"model", arguments.model}, {"solutions", nlohmann::json::array()}};
    for (std::size_t k = 0; k < solutions.size(); ++k)
      document["solutions"].push_back(bearing_json(solutions[k], sensitivities[k]));
    fmt::print("{}\n", document.dump(2));
  } else if (solutions.size() > 1) {
    fmt::print("{}", bearing_comparison_text(solutions));
  } else if (solutions.front().solved()) {
    fmt::print("{}", bearing_text(solutions.front()));
  }
  if (arguments.json) return;
  for (std::size_t k = 0; k < solutions.size(); ++k) {
    if (sensitivities[k].empty()) continue;
    if (solutions.size() > 1) fmt::print("\n{}:", solutions[k].run.label);
    fmt::print("{}", sensitivity_text(solutions[k], sensitivities[k]));
  }
}

session::Session session_of(const BearingArguments& arguments) {
  if (arguments.text.empty()) return session::Session(arguments.model, arguments.overrides);
  std::ifstream file(arguments.text, std::ios::binary);
  if (!file) throw std::runtime_error(arguments.text + ": cannot be read");
  return {std::string{std::istreambuf_iterator<char>(file), {}}, arguments.model, arguments.overrides};
}

}  // namespace

int bearing_command(const BearingArguments& arguments) {
  const session::Session given = session_of(arguments);
  const std::vector<model::StudyRun> runs = runs_of(given, plan_of(arguments, given.model()));
  const session::Session session = given.with(runs.front().overrides);
  const model::Model& model = session.model();
  session::require_separate({{"--csv", arguments.csv},
                             {"--coefficients", arguments.coefficients},
                             {"--fields", arguments.fields},
                             {"--vtu", arguments.vtu},
                             {"--report", arguments.report}},
                            session.files());
  session::require_writable({{"--csv", arguments.csv},
                             {"--coefficients", arguments.coefficients},
                             {"--fields", arguments.fields},
                             {"--vtu", arguments.vtu},
                             {"--report", arguments.report}});
  warn(model.warnings);
  require_one(arguments, model, runs.size());
  const auto coefficients = arguments.thermal_coefficients == "total" ? study::ThermalCoefficients::total
                                                                      : study::ThermalCoefficients::frozen;
  study::require_coefficients(study::bearing_called(model, arguments.bearing), coefficients);
  const study::BearingStudyOptions options{.bearing = arguments.bearing,
                                           .grid_error = !arguments.no_grid_error,
                                           .thermal_coefficients = coefficients,
                                           .threads = arguments.jobs};
  const std::vector<study::BearingSolution> solutions = session.solve_bearings(runs, options);
  print(arguments, solutions, sensitivities_of(arguments, session, options, solutions));
  if (arguments.timing && solutions.size() == 1) say("{}", timing_text(solutions.front()));
  bool all_solved = true;
  for (const study::BearingSolution& solution : solutions) {
    for (const std::string& warning : solution.warnings)
      say("warning: {}{}{}\n", solution.run.label, solution.run.label.empty() ? "" : ": ", warning);
    if (solution.solved()) continue;
    all_solved = false;
    say("hersey: {}{}{}\n", solution.run.label, solution.run.label.empty() ? "" : ": ", solution.message);
  }
  if (!arguments.csv.empty()) write(arguments.csv, bearing_csv(solutions));
  if (!arguments.coefficients.empty() && all_solved) {
    const TableReader reader = arguments.coefficients_for == "ross"    ? TableReader::ross
                               : arguments.coefficients_for == "ansys" ? TableReader::ansys
                                                                       : TableReader::hersey;
    write(arguments.coefficients,
          coefficient_table(solutions, study::bearing_called(model, arguments.bearing).name,
                            std::filesystem::path(arguments.model).filename().string(), reader));
  }
  if (!arguments.fields.empty() && all_solved) write(arguments.fields, bearing_fields_csv(solutions.front()));
  if (!arguments.vtu.empty() && all_solved) write_bodies(arguments, model, solutions.front());
  if (!arguments.report.empty()) {
    report::write_html(bearing_page(arguments, model, solutions), arguments.report);
    if (!arguments.json) fmt::print("report: {}\n", arguments.report.string());
  }
  return all_solved ? kOk : kFailed;
}

}  // namespace hersey::cli
