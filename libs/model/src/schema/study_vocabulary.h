#pragma once

#include "check/vocabulary.h"
#include "hersey/model/study_settings.h"

namespace hersey::model {

inline constexpr Vocabulary<StudyFigure, 2> study_figure_words{{
    {StudyFigure::midplane_pressure, "midplane_pressure", "pressure around the middle of the bearing"},
    {StudyFigure::film_thickness, "film_thickness", "least film thickness against the first parameter"},
}};

inline constexpr Vocabulary<StudyPlan, 7> study_plan_words{{
    {StudyPlan::full_factorial, "full_factorial", "every combination of the values"},
    {StudyPlan::list, "list", "the first values of all parameters, then the second ones, and so on"},
    {StudyPlan::latin_hypercube, "latin_hypercube", "drawn, each parameter once in each of `samples` equal parts"},
    {StudyPlan::sobol, "sobol", "Sobol's sequence, scrambled"},
    {StudyPlan::halton, "halton", "Halton's sequence, scrambled"},
    {StudyPlan::corners, "corners",
     "every combination of the smallest and largest values; of `normal`, 3 standard deviations off the mean"},
    {StudyPlan::optimise, "optimise", "looks for the best, from the middle or the parameter's own value"},
}};

inline constexpr Vocabulary<StudySearch, 2> study_search_words{{
    {StudySearch::local, "local", "downhill, by derivatives where they are exact (SLSQP), else without (COBYLA)"},
    {StudySearch::global, "global", "everywhere, by an evolution strategy (ISRES), then downhill"},
}};

inline constexpr Vocabulary<StudyAnalysis, 3> study_analysis_words{{
    {StudyAnalysis::as_model, "as_model", "a simulation where the file has bodies, else the steady bearings"},
    {StudyAnalysis::simulation, "simulation", "as `hersey run`"},
    {StudyAnalysis::steady, "steady", "each bearing with an `operating_point`, as `hersey bearing`"},
}};

inline constexpr Vocabulary<StudyKeep, 3> study_keep_words{{
    {StudyKeep::figures, "figures", "its figures alone"},
    {StudyKeep::results, "results", "its results file too"},
    {StudyKeep::report, "report", "results file and report page"},
}};

inline constexpr Vocabulary<StudyDiagram, 2> study_diagram_words{{
    {StudyDiagram::campbell, "campbell", "natural frequencies over the speed; `analysis: modes` of `simulation`"},
    {StudyDiagram::run_up, "run_up", "a waterfall: the spectrum of `spectrum_of` at each speed"},
}};

}  // namespace hersey::model
