#include "hersey/model/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "hersey/core/units.h"
#include "hersey/model/read.h"
#include "interpret/read/reader.h"
#include "tree/tree_digest.h"

namespace hersey::model {
namespace {

constexpr std::size_t most_runs = 100'000;

bool is_fixed_by(const std::vector<std::string>& overrides, const std::string& name) {
  return std::any_of(overrides.begin(), overrides.end(),
                     [&](const std::string& text) { return text.starts_with(name + "="); });
}

/// The value for plotting: in the unit of the parameter's first value, so that "500 N" and "1 kN" share an axis.
StudyValue value_of(const StudyParameter& parameter, const std::string& text) {
  StudyValue value{parameter.name, text, 0, ""};
  try {
    const std::string unit = split_quantity(parameter.values.front()).unit;
    value.number = convert(split_quantity(text), unit);
    value.unit = unit;
  } catch (const QuantityError&) {
    // A word, such as the name of a cavitation model: it labels its run and has no position on an axis.
    value.number = 0;
  }
  return value;
}

/// Letters, digits, dots and signs stay; the rest becomes _.
std::string slug_of(const std::string& label) {
  std::string slug;
  for (const char c : label) {
    const bool stays = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '+';
    if (stays) {
      slug += c;
    } else if (!slug.empty() && slug.back() != '_') {
      slug += '_';
    }
  }
  return slug;
}

StudyRun run_of(const std::vector<StudyParameter>& parameters, std::size_t index,
                const std::vector<std::string>& overrides) {
  StudyRun run{overrides, "", "", {}};
  for (std::size_t k = parameters.size(); k-- > 0;) {  // the last parameter varies fastest
    const StudyParameter& parameter = parameters[k];
    const std::string& text = parameter.values[index % parameter.values.size()];
    index /= parameter.values.size();
    run.values.insert(run.values.begin(), value_of(parameter, text));
  }
  for (const StudyValue& value : run.values) {
    run.overrides.push_back(value.name + "=" + value.text);
    run.label += (run.label.empty() ? "" : ", ") + value.name + " = " + value.text;
    run.slug += (run.slug.empty() ? "" : "-") + slug_of(value.name + " " + value.text);
  }
  return run;
}

/// "5 m" and "5 µm" have one slug, and results must not: later ones get a number.
void make_slugs_unique(std::vector<StudyRun>& runs) {
  std::set<std::string> taken;
  for (StudyRun& run : runs) {
    const std::string slug = run.slug;
    for (int number = 2; !taken.insert(run.slug).second; ++number) run.slug = slug + "-" + std::to_string(number);
  }
}

/// All values, or the ends of the distribution.
std::vector<std::string> values_to_check(const StudyParameter& parameter) {
  if (!parameter.distribution) return parameter.values;
  const Distribution& d = *parameter.distribution;
  std::vector<std::string> ends;
  for (const double end : {d.lowest(), d.highest()})
    ends.push_back(fmt::format("{:.10g}{}{}", end, d.unit.empty() ? "" : " ", d.unit));
  return ends;
}

void explain_reach(std::vector<Fault>& faults, std::size_t from) {
  for (std::size_t i = from; i < faults.size(); ++i) {
    faults[i].found += fmt::format(", {:g} standard deviations off the mean,", Distribution::reach);
    if (faults[i].suggestion.empty()) faults[i].suggestion = "`truncated_normal` ends at `low` and `high`";
  }
}

/// Reads the model once with each single value of the study; its faults point at the study's lines.
void check_values(const ModelFile& file, const std::vector<std::string>& overrides,
                  const std::vector<StudyParameter>& parameters) {
  std::vector<Fault> faults;
  const std::vector<Override> given = parse_overrides(overrides, faults);
  const Node root = parse_yaml(file.text(), file.file(), faults).value_or(Node{});
  for (const StudyParameter& parameter : parameters) {
    const std::size_t before = faults.size();
    for (const std::string& text : values_to_check(parameter)) {
      std::vector<Override> changes = given;
      changes.push_back({parameter.name, parse_yaml(text, file.file(), faults).value_or(Node{}), parameter.position});
      move_to(changes.back().value, parameter.position);
      (void)read_tree(root, file.file(), changes, faults);
    }
    if (parameter.distribution && !parameter.distribution->is_bounded()) explain_reach(faults, before);
  }
  if (faults.empty()) return;
  tidy(faults);
  throw InputError(std::move(faults));
}

}  // namespace

std::vector<StudyRun> expand_parameters(const ModelFile& file, const std::vector<std::string>& overrides,
                                        const std::vector<StudyParameter>& parameters) {
  std::size_t count = 1;
  for (const StudyParameter& parameter : parameters) {
    count *= parameter.values.size();
    if (count <= most_runs) continue;
    throw InputError(Fault{parameter.position, "study.parameters", "more than 100000 combinations",
                           "at most 100000 runs in a study", "leave out values"});
  }
  check_values(file, overrides, parameters);
  std::vector<StudyRun> runs;
  for (std::size_t i = 0; i < count; ++i) runs.push_back(run_of(parameters, i, overrides));
  make_slugs_unique(runs);
  return runs;
}

std::vector<StudyRun> expand_parameters(const std::string& path, const std::vector<std::string>& overrides,
                                        const std::vector<StudyParameter>& parameters) {
  return expand_parameters(ModelFile(path), overrides, parameters);
}

namespace {

/// Finds the parameters of a study that still change its model after options have set values: `--load` over a study of
/// loads leaves one bearing, not seven equal ones.
class Varying {
 public:
  Varying(const ModelFile& file, const std::vector<std::string>& overrides)
      : path_(file.file()), overrides_(parse_overrides(overrides, faults_)) {
    root_ = parse_yaml(file.text(), path_, faults_).value_or(Node{});
  }

  /// True if an option has set everything that the parameter sets: its values make a difference only without options.
  [[nodiscard]] bool is_set_by_option(const StudyParameter& parameter) {
    return !overrides_.empty() && !changes_model(parameter, overrides_) && changes_model(parameter, {});
  }

 private:
  [[nodiscard]] bool changes_model(const StudyParameter& parameter, const std::vector<Override>& overrides) {
    const std::vector<std::string> values = values_to_check(parameter);
    const std::string first = digest_at(parameter, values.front(), overrides);
    return std::any_of(values.begin() + 1, values.end(),
                       [&](const std::string& text) { return digest_at(parameter, text, overrides) != first; });
  }

  /// Of the model with the parameter's value put in, without the sections that hold the value itself.
  [[nodiscard]] std::string digest_at(const StudyParameter& parameter, const std::string& text,
                                      std::vector<Override> overrides) {
    overrides.push_back({parameter.name, parse_yaml(text, path_, faults_).value_or(Node{}), parameter.position});
    Node tree = root_;
    (void)complete_tree(tree, overrides, faults_);
    Digest digest;
    for (const Entry& entry : tree.entries) {
      if (entry.key == "parameters" || entry.key == "study") continue;
      digest.add(entry.key);
      digest.add(entry.value);
    }
    return digest.text();
  }

  const std::string path_;
  std::vector<Fault> faults_;  // whoever reads the model reports them
  std::vector<Override> overrides_;
  Node root_;
};

/// Parameters that no option has set, by their own name or by setting the keys they set.
std::vector<StudyParameter> varied_by(const Study& study, const ModelFile& file,
                                      const std::vector<std::string>& overrides) {
  Varying varying(file, overrides);
  std::vector<StudyParameter> varied;
  for (const StudyParameter& parameter : study.parameters) {
    if (is_fixed_by(overrides, parameter.name)) continue;
    if (varying.is_set_by_option(parameter)) continue;
    varied.push_back(parameter);
  }
  return varied;
}

/// Values side by side.
std::vector<StudyRun> expand_list(const std::vector<StudyParameter>& parameters,
                                  const std::vector<std::string>& overrides) {
  std::vector<StudyRun> runs;
  const std::size_t count = parameters.empty() ? 0 : parameters.front().values.size();
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<StudyParameter> one = parameters;
    for (StudyParameter& parameter : one) parameter.values = {parameter.values[i]};
    runs.push_back(run_of(one, 0, overrides));
    for (std::size_t k = 0; k < parameters.size(); ++k)
      runs.back().values[k] = value_of(parameters[k], parameters[k].values[i]);
  }
  make_slugs_unique(runs);
  return runs;
}

}  // namespace

std::vector<StudyParameter> check_study(const ModelFile& file, const std::vector<std::string>& overrides) {
  const Model model = file.read(overrides);
  if (!model.study) return {};
  const std::vector<StudyParameter> varied = varied_by(*model.study, file, overrides);
  check_values(file, overrides, varied);
  return varied;
}

std::vector<StudyParameter> check_study(const std::string& path, const std::vector<std::string>& overrides) {
  return check_study(ModelFile(path), overrides);
}

std::vector<StudyRun> expand_study(const ModelFile& file, const std::vector<std::string>& overrides) {
  const Model model = file.read(overrides);
  if (!model.study) return {};
  const std::vector<StudyParameter> varied = varied_by(*model.study, file, overrides);
  if (varied.empty()) return {};
  if (!model.study->is_written_out())
    throw InputError(Fault{model.position_of("study.plan"), "study.plan", "a plan that draws or looks for its runs",
                           "`full_factorial` or `list`, whose runs are written out",
                           "`hersey study` runs this one; --set PARAMETER=VALUE for each gives a single run"});
  if (model.study->plan == StudyPlan::full_factorial) return expand_parameters(file, overrides, varied);
  check_values(file, overrides, varied);
  return expand_list(varied, overrides);
}

std::vector<StudyRun> expand_study(const std::string& path, const std::vector<std::string>& overrides) {
  return expand_study(ModelFile(path), overrides);
}

}  // namespace hersey::model
