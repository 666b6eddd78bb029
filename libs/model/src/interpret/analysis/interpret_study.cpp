#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "hersey/core/spelling.h"
#include "hersey/core/units.h"
#include "interpret/context/interpret.h"
#include "schema/study_vocabulary.h"
#include "tree/overrides.h"

namespace hersey::model {
namespace {

std::string trimmed(const std::string& text) {
  const auto is_space = [](unsigned char c) { return std::isspace(c) != 0; };
  const auto from = std::find_if_not(text.begin(), text.end(), is_space);
  const auto to = std::find_if_not(text.rbegin(), std::make_reverse_iterator(from), is_space).base();
  return {from, to};
}

// The quantities of a distribution, in the unit of the first of them.
class DistributionReader {
 public:
  DistributionReader(Context& context, const Value& value) : context_(context), value_(value) {}

  Distribution read() {
    Distribution d;
    if (value_.broken) return d;
    const bool has_mean = value_.text == "normal" || value_.text == "truncated_normal";
    d.kind = value_.text == "normal"       ? Distribution::Kind::normal
             : value_.text == "uniform"    ? Distribution::Kind::uniform
             : value_.text == "triangular" ? Distribution::Kind::triangular
                                           : Distribution::Kind::truncated_normal;
    d.unit = unit_of(has_mean ? "mean" : "low");
    if (has_mean) {
      d.mean = number("mean", d.unit);
      d.standard_deviation = difference("standard_deviation", d.unit);
      require(d.standard_deviation > 0, "standard_deviation", "a standard deviation > 0");
    }
    if (d.kind == Distribution::Kind::normal) return d;
    d.low = number("low", d.unit), d.high = number("high", d.unit);
    require(d.low < d.high, "high", "a value above `low`");
    if (d.kind == Distribution::Kind::truncated_normal) require_some_of_it(d);
    if (d.kind != Distribution::Kind::triangular) return d;
    d.mode = number("mode", d.unit);
    require(d.low <= d.mode && d.mode <= d.high, "mode", "a value from `low` to `high`");
    return d;
  }

 private:
  // Further off, the share of the normal distribution between the ends is too small for a double.
  void require_some_of_it(const Distribution& d) {
    const double reach = 8 * d.standard_deviation;
    require(d.low <= d.mean + reach, "low", "a value at most 8 standard deviations above the mean");
    require(d.high >= d.mean - reach, "high", "a value at most 8 standard deviations below the mean");
  }

  void require(bool holds, const std::string& key, const std::string& expected) {
    const Value* value = value_.find(key);
    if (!holds && !failed_ && value != nullptr) context_.fault(*value, "'" + value->text + "'", expected);
  }

  std::string unit_of(const std::string& key) {
    const Value* value = value_.find(key);
    if (value == nullptr || value->broken) return {};
    try {
      return split_quantity(value->text).unit;
    } catch (const QuantityError& error) {
      fail(*value, error);
      return {};
    }
  }

  double number(const std::string& key, const std::string& unit) {
    const Value* value = value_.find(key);
    if (failed_ || value == nullptr || value->broken) return 0;
    try {
      return convert(split_quantity(value->text), unit);
    } catch (const QuantityError& error) {
      fail(*value, error);
      return 0;
    }
  }

  // 5 K are 5 degC where they are a difference, though not where they are a temperature.
  double difference(const std::string& key, const std::string& unit) {
    const Value* value = value_.find(key);
    if (failed_ || value == nullptr || value->broken) return 1;
    try {
      const Quantity given = split_quantity(value->text);
      return convert(given, unit) - convert({0, given.unit}, unit);
    } catch (const QuantityError& error) {
      fail(*value, error);
      return 1;
    }
  }

  void fail(const Value& value, const QuantityError& error) {
    failed_ = true;
    context_.fault(value, error.found, error.expected, error.suggestion);
  }

  Context& context_;
  const Value& value_;
  bool failed_ = false;
};

void read_parameters(Context& context, const Value& value, Study& study) {
  const std::vector<std::string> names = names_in(context.root, "parameters");
  for (const auto& [name, given] : section(value, "parameters")) {
    StudyParameter parameter{name, {}, given.key_position};
    if (!given.members.empty()) {
      const Value& choice = given.members.front().value;
      if (choice.type->kind == Type::Kind::list) {
        for (const auto& [index, item] : choice.members) parameter.values.push_back(item.text);
      } else {
        parameter.distribution = DistributionReader(context, choice).read();
      }
    }
    const bool is_path = name.find('.') != std::string::npos;
    if (!is_path && std::find(names.begin(), names.end(), name) == names.end()) {
      context.fault_at_key(given, "unknown parameter '" + name + "'",
                           names.empty() ? "a parameter, but the model has none" : one_of(names),
                           did_you_mean(name, names));
    }
    study.parameters.push_back(std::move(parameter));
  }
  if (const Value* variants = value.find("variants"); variants != nullptr && !variants->broken) {
    if (std::find(names.begin(), names.end(), kVariant) != names.end()) {
      context.fault_at_key(*variants, "variants beside a parameter called 'variant'", "another name for the parameter");
    }
    study.parameters.push_back({kVariant, names_in(value, "variants"), variants->key_position});
  }
}

// Texts of a key that holds one or a list.
std::vector<const Value*> texts_of(const Value& parent, const std::string& key) {
  std::vector<const Value*> texts;
  const Value* value = parent.find(key);
  if (value == nullptr || value->broken || value->members.empty()) return texts;
  const Value& choice = value->members.front().value;
  if (choice.type->kind != Type::Kind::list) return {&choice};
  for (const auto& [index, item] : choice.members) texts.push_back(&item);
  return texts;
}

// Figures go by the kind of thing, "bearings", and its name in a section of the model.
struct FigureOwner {
  const char* prefix;
  const char* section;
  const char* singular;
};
constexpr std::array<FigureOwner, 9> kOwners{{{"bearings.", "bearings", "bearing"},
                                              {"bodies.", "bodies", "body"},
                                              {"joints.", "joints", "joint"},
                                              {"drives.", "drives", "drive"},
                                              {"couplings.", "couplings", "coupling"},
                                              {"contacts.", "contacts", "contact"},
                                              {"fmus.", "fmus", "FMU"},
                                              {"forces.", "forces", "force"},
                                              {"surface_loads.", "forces", "force"}}};

// A figure names a thing that there is; what it is called is checked where figures are made.
void require_thing(Context& context, const Value& at, const std::string& name) {
  const auto kind = std::find_if(kOwners.begin(), kOwners.end(),
                                 [&](const FigureOwner& known) { return name.starts_with(known.prefix); });
  if (kind == kOwners.end()) return;
  const std::string prefix = kind->prefix;
  const std::string thing = name.substr(prefix.size(), name.find('.', prefix.size()) - prefix.size());
  const std::vector<std::string> names = names_in(context.root, kind->section);
  if (std::find(names.begin(), names.end(), thing) != names.end()) return;
  context.fault(
      at, std::string("a figure of an unknown ") + kind->singular + ", '" + name + "'",
      names.empty() ? std::string("another figure: the model has no ") + kind->singular : prefix + one_of(names),
      did_you_mean(thing, names));
}

void read_objectives(Context& context, const Value& value, const std::string& key, Study& study) {
  for (const Value* name : texts_of(value, key)) {
    require_thing(context, *name, trimmed(name->text));
    study.objectives.push_back({trimmed(name->text), key == "maximise", name->position});
  }
}

void read_constraints(Context& context, const Value& value, Study& study) {
  for (const Value* text : texts_of(value, "subject_to")) {
    const auto at = text->text.find_first_of("<>");
    StudyConstraint constraint{.text = trimmed(text->text), .name = {}, .bound = {}, .position = text->position};
    if (at != std::string::npos) {
      constraint.name = trimmed(text->text.substr(0, at));
      constraint.is_lower = text->text[at] == '>';
      const bool has_equals = at + 1 < text->text.size() && text->text[at + 1] == '=';
      constraint.bound = trimmed(text->text.substr(at + (has_equals ? 2 : 1)));
    }
    try {
      if (constraint.name.empty()) throw QuantityError("'" + constraint.text + "'", "");
      (void)split_quantity(constraint.bound);
    } catch (const QuantityError&) {
      context.fault(*text, "'" + constraint.text + "'",
                    "a figure, > or <, and a value, such as bearings.main.h_min > 1.5 um");
      continue;
    }
    require_thing(context, *text, constraint.name);
    study.constraints.push_back(std::move(constraint));
  }
}

void require_lists_of_one_length(Context& context, const Value& value, const Study& study) {
  const StudyParameter& first = study.parameters.front();
  for (const auto& [name, given] : section(value, "parameters")) {
    const auto same = [&, &called = name](const StudyParameter& other) { return other.name == called; };
    const auto parameter = std::find_if(study.parameters.begin(), study.parameters.end(), same);
    if (parameter->distribution || parameter->values.size() == first.values.size()) continue;
    context.fault_at_key(given, std::to_string(parameter->values.size()) + " values",
                         "as many as '" + first.name + "' has: " + std::to_string(first.values.size()));
  }
}

void check_plan(Context& context, const Value& value, const Study& study) {
  const Value& plan = *value.find("plan");
  if (plan.broken) return;
  for (const auto& [name, given] : section(value, "parameters")) {
    const auto same = [&, &called = name](const StudyParameter& other) { return other.name == called; };
    const auto parameter = std::find_if(study.parameters.begin(), study.parameters.end(), same);
    if (study.is_written_out() && parameter->distribution)
      context.fault_at_key(given, "a distribution in the plan '" + plan.text + "'",
                           "a list of values, or a plan that draws: latin_hypercube, sobol or halton");
    if (study.plan == StudyPlan::optimise && !(parameter->distribution && parameter->distribution->is_bounded()))
      context.fault_at_key(given, parameter->distribution ? "a parameter without bounds" : "a list of values",
                           "{distribution: uniform, low: ..., high: ...}: between these the best is looked for");
  }
  if (study.plan == StudyPlan::list && !study.parameters.empty()) require_lists_of_one_length(context, value, study);
  if (study.plan == StudyPlan::optimise && study.objectives.size() != 1)
    context.fault_at_key(plan, std::to_string(study.objectives.size()) + " figures to minimise or maximise",
                         "one; of several, a plan that draws tells the runs that none other beats in all");
  if (study.diagram == StudyDiagram::run_up && study.spectrum_of.empty())
    context.fault_at_key(*value.find("diagram"), "'run_up' without `spectrum_of`", "both");
}

}  // namespace

bool Study::is_written_out() const { return plan == StudyPlan::full_factorial || plan == StudyPlan::list; }

void interpret_study(Context& context) {
  const Value* value = context.root.find("study");
  if (value == nullptr || value->broken) return;
  Study study;
  study.position = value->key_position;
  read_parameters(context, *value, study);
  for (const auto& [index, figure] : section(*value, "figures")) {
    study.figures.push_back(meaning_of(figure, study_figure_words));
  }
  study.plan = meaning_of(*value, "plan", study_plan_words, StudyPlan::full_factorial);
  study.samples = integer_of(*value, "samples");
  study.seed = integer_of(*value, "seed");
  for (const auto& [index, output] : section(*value, "outputs")) {
    require_thing(context, output, trimmed(output.text));
    study.outputs.push_back({trimmed(output.text), output.position});
  }
  read_objectives(context, *value, "minimise", study);
  read_objectives(context, *value, "maximise", study);
  read_constraints(context, *value, study);
  study.search = meaning_of(*value, "search", study_search_words, StudySearch::local);
  study.analysis = meaning_of(*value, "analysis", study_analysis_words, StudyAnalysis::as_model);
  study.keep = meaning_of(*value, "keep", study_keep_words, StudyKeep::results);
  study.diagram = meaning_of(*value, "diagram", study_diagram_words, StudyDiagram::none);
  study.spectrum_of = text_of(*value, "spectrum_of");
  if (const Value* spectrum = value->find("spectrum_of"); spectrum != nullptr && !spectrum->broken)
    require_thing(context, *spectrum, trimmed(spectrum->text));
  check_plan(context, *value, study);
  context.model.study = std::move(study);
}

}  // namespace hersey::model
