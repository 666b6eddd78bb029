#include "schema/format.h"
#include "schema/study_vocabulary.h"

namespace hersey::model {
namespace {

TypePtr value_of_key() { return scalar("a number or quantity in a unit of the parameter", "40 um"); }

/// How a parameter scatters.
TypePtr distribution_format() {
  const Key mean = required("mean", value_of_key(), "Mean; of `truncated_normal`, before it is cut.");
  const Key deviation = required("standard_deviation", value_of_key(), "Standard deviation, > 0; likewise.");
  const Key low = required("low", value_of_key(), "Smallest value.");
  const Key high = required("high", value_of_key(), "Largest value.");
  const Key mode = required("mode", value_of_key(), "Most likely value, from `low` to `high`.");
  return variant(
      "a distribution", "distribution", {},
      {{"normal", "normal; the key must take what lies 5 standard deviations off the mean", {mean, deviation}},
       {"uniform", "every value between two as likely as the others", {low, high}},
       {"triangular", "most likely at one value, impossible beyond two others", {low, mode, high}},
       {"truncated_normal", "normal, cut off at two values", {mean, deviation, low, high}}});
}

TypePtr figure_name(const std::string& example) { return text("the name of a figure", example); }

TypePtr one_or_several(const std::string& title, const TypePtr& item) {
  return any_of(title, {item, list("a list of these", item)});
}

}  // namespace

TypePtr study_format() {
  const TypePtr values = list("a list of values", scalar("a number, quantity or word", "100 N"));
  auto parameters = std::make_shared<Type>(
      *named("a mapping from parameters to lists of values or distributions",
             any_of("a list of values, or {distribution, ...}", {values, distribution_format()})));
  parameters->free_names = true;
  const TypePtr variant = any_of(
      "overrides of a variant",
      {choice({{"unchanged", "the unchanged model"}}),
       list("a list of overrides", text("a parameter or key path and its value", "bearings.big_end.width=20mm"))});
  const TypePtr figures = list("a list of figures", choice(study_figure_words));
  const TypePtr objective =
      one_or_several("the name of a figure, or a list of names", figure_name("bearings.main.p_max"));
  const TypePtr constraint = one_or_several("a bound, or a list of bounds",
                                            text("a figure, > or <, and a value", "bearings.main.h_min > 1.5 um"));
  return object(
      "a study",
      {
          required("parameters", parameters,
                   "Values of each parameter or key path (`bearings.big_end.width`), or how it scatters."),
          optional("variants", named("a mapping from names to lists of overrides", variant),
                   "Models beside each other: each combination of parameters is run with the "
                   "overrides of every variant, written as after `--set`. `--set variant=NAME` "
                   "picks one.",
                   "one, the unchanged model"),
          defaulted("figures", figures, "[midplane_pressure, film_thickness]",
                    "Figures of the report; curves are drawn over the first parameter."),
          defaulted("plan", choice(study_plan_words), "full_factorial",
                    "Which runs there are; all but the first two need `hersey study`."),
          defaulted("samples", integer(128, {.low = 1, .high = 100000}), "128", "Runs of a plan that draws them."),
          defaulted("seed", integer(1, Range::not_negative()), "1", "Of what is drawn: the same seed, the same runs."),
          optional("outputs", list("a list of figures", figure_name("bearings.main.h_min")),
                   "Figures reported by a study ([names](studies.md)).",
                   "those of `minimise`, `maximise` and `subject_to`; "
                   "without them a few of each bearing"),
          optional("minimise", objective, "What is to be small. Of several, the runs that none other beats in all.",
                   "nothing"),
          optional("maximise", objective, "What is to be large; likewise.", "nothing"),
          optional("subject_to", constraint, "What a good run keeps to.", "nothing"),
          defaulted("search", choice(study_search_words), "local", "How `optimise` looks for the best."),
          defaulted("analysis", choice(study_analysis_words), "as_model", "What a run of `hersey study` is."),
          defaulted("keep", choice(study_keep_words), "results", "What stays of a simulation in the study's folder."),
          optional("diagram", choice(study_diagram_words), "What the report draws over the first parameter.", "none"),
          optional("spectrum_of", text("a series of the results file", "bearings.main.eccentricity.x"),
                   "Series whose spectra `run_up` shows.", "**required** with it"),
      });
}

}  // namespace hersey::model
