#include "hersey/model/study.h"

#include <filesystem>
#include <fstream>

#include "model_text.h"

namespace hersey::model {
namespace study_test {

/// A model file with a study, removed at the end.
class StudyFile {
 public:
  explicit StudyFile(const std::string& text)
      : path_((std::filesystem::temp_directory_path() / "hersey_study_test.yaml").string()) {
    std::ofstream(path_) << text;
  }
  StudyFile(const StudyFile&) = delete;
  StudyFile& operator=(const StudyFile&) = delete;
  ~StudyFile() { std::filesystem::remove(path_); }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

const std::string study = R"(study:
  parameters:
    load: [100 N, 1 kN]
    bearings.big_end.cavitation: [reynolds, guembel]
    bearings.big_end.radial_clearance: [34 um, 0.068 mm]
)";

TEST_CASE("ValuesOfOneSlug_GetFilesOfTheirOwn") {
  const StudyFile file(good_model + "study: {parameters: {load: [5 N, 5 µN, 6 N]}}\n");
  const std::vector<StudyRun> runs = expand_study(file.path());
  REQUIRE(runs.size() == 3);
  CHECK(runs[0].slug == "load_5_N");
  CHECK(runs[1].slug == "load_5_N-2");
  CHECK(runs[2].slug == "load_6_N");
}

TEST_CASE("Study_IsEveryCombination") {
  const StudyFile file(good_model + study);
  const std::vector<StudyRun> runs = expand_study(file.path(), {"speed=2000 rpm"});
  REQUIRE(runs.size() == 8);
  CHECK(runs[0].label ==
        "load = 100 N, bearings.big_end.cavitation = reynolds, bearings.big_end.radial_clearance = 34 um");
  CHECK(runs[0].slug == "load_100_N-bearings.big_end.cavitation_reynolds-bearings.big_end.radial_clearance_34_um");
  CHECK(runs[0].overrides == std::vector<std::string>{"speed=2000 rpm", "load=100 N",
                                                      "bearings.big_end.cavitation=reynolds",
                                                      "bearings.big_end.radial_clearance=34 um"});
  // The last parameter varies fastest.
  CHECK(runs[1].values[2].text == "0.068 mm");
  CHECK(runs[1].values[0].text == "100 N");
  CHECK(runs[7].values[0].text == "1 kN");
  // Numbers share the unit of the first value; words have none.
  // Round-off of units.
  CHECK(runs[7].values[0].number == doctest::Approx(1000).epsilon(1e-15));
  CHECK(runs[7].values[0].unit == "N");
  CHECK(runs[7].values[2].number == doctest::Approx(68).epsilon(1e-14));
  CHECK(runs[7].values[2].unit == "um");
  CHECK(runs[7].values[1].unit.empty());
  const Model model = read(file.path(), runs[7].overrides);
  CHECK(model.bearings[0].film.cavitation == film::Cavitation::guembel);
  CHECK(model.bearings[0].film.c == doctest::Approx(68e-6).epsilon(1e-14));  // round-off of units
  CHECK(model.forces[0].as<BodyLoad>()->functions[1].value->value({}) == -1000);
}

const std::string variants = R"(study:
  parameters:
    load: [100 N, 1 kN]
  variants:
    as_it_is: unchanged
    starved: [bearings.big_end.cavitation=reynolds, "bearings.big_end.supply={line: 30 deg, pressure: 2 bar}"]
)";

TEST_CASE("Variants_AreRunBesideEachOther") {
  const StudyFile file(good_model + variants);
  const std::vector<StudyRun> runs = expand_study(file.path());
  REQUIRE(runs.size() == 4);
  CHECK(runs[0].label == "load = 100 N, variant = as_it_is");
  CHECK(runs[3].slug == "load_1_kN-variant_starved");
  const Model plain = read(file.path()), same = read(file.path(), runs[2].overrides);
  CHECK(same.bearings[0].film.cavitation == plain.bearings[0].film.cavitation);
  const film::FilmModel starved = read(file.path(), runs[3].overrides).bearings[0].film;
  CHECK(starved.cavitation == film::Cavitation::reynolds);
  CHECK(starved.supply.pressure == doctest::Approx(2e5));
  CHECK(expand_study(file.path(), {"variant=starved"}).size() == 2);
}

TEST_CASE("FaultyVariants_AreLocated") {
  const std::string above = good_model + "study:\n  parameters:\n    load: [1 N]\n  variants:\n";
  CHECK(faults_of(above + "    dry: 3\n") == "m.yaml:38:10: study.variants.dry: '3'; expected unchanged");
  const StudyFile file(above + "    dry: [bearings.big_end.widht=3]\n    wet: [load]\n");
  CHECK_THROWS_WITH_AS((void)expand_study(file.path()), doctest::Contains(":38:11: "), InputError);
  CHECK_THROWS_WITH_AS((void)expand_study(file.path()), doctest::Contains("unknown key 'widht'"), InputError);
  CHECK_THROWS_WITH_AS((void)expand_study(file.path()), doctest::Contains("'load'; expected name=value"), InputError);
  CHECK_THROWS_WITH_AS((void)read(file.path(), {"variant=weet"}),
                       "--set: variant: unknown variant 'weet'; did you mean 'wet'? expected dry or wet", InputError);
}

TEST_CASE("FixedParameter_IsNoLongerVaried") {
  const StudyFile file(good_model + study);
  const std::vector<StudyRun> runs = expand_study(file.path(), {"load=7 N"});
  REQUIRE(runs.size() == 4);
  CHECK(runs[0].overrides.front() == "load=7 N");
  CHECK(runs[0].values.size() == 2);
}

TEST_CASE("ParameterWhoseUseAnOptionSets_IsNoLongerVaried") {
  const StudyFile file(good_model + study);
  const std::vector<StudyRun> runs = expand_study(file.path(), {"forces.push.components=[0 N, 7 N, 0 N]"});
  REQUIRE(runs.size() == 4);
  CHECK(runs[0].values.size() == 2);
  CHECK(expand_study(file.path(), {"forces.push.body=rod"}).size() == 8);  // sets something else
  CHECK(expand_study(file.path(),
                     {"load=7 N", "bearings.big_end.cavitation=reynolds", "bearings.big_end.radial_clearance=34 um"})
            .empty());
}

TEST_CASE("ModelWithoutStudy_HasNoRuns") {
  const StudyFile file(good_model);
  CHECK(expand_study(file.path()).empty());
}

TEST_CASE("StudySettings_AreRead") {
  const Model model = read_text(good_model + study + "  figures: [film_thickness]\n", "m.yaml");
  REQUIRE(model.study.has_value());
  REQUIRE(model.study->parameters.size() == 3);
  CHECK(model.study->parameters[0].name == "load");
  CHECK(model.study->parameters[0].values == std::vector<std::string>{"100 N", "1 kN"});
  CHECK(model.study->parameters[0].position.line == 36);
  CHECK(model.study->figures == std::vector<StudyFigure>{StudyFigure::film_thickness});
}

TEST_CASE("FaultyStudies_AreLocated") {
  CHECK(faults_of(good_model + "study:\n  parameters:\n    laod: [1 N]\n") ==
        "m.yaml:36:5: study.parameters.laod: unknown parameter 'laod'; did you mean 'load'? expected load or speed");
  CHECK(faults_of(good_model + "study:\n  parameters:\n    load: []\n") ==
        "m.yaml:36:11: study.parameters.load: a list of 0; expected a list of values, such as [100 N]");
  CHECK(faults_of(good_model + "study:\n  parameters:\n    load: 3 N\n") ==
        "m.yaml:36:11: study.parameters.load: '3 N'; expected a list of values, or {distribution, ...}");
  CHECK(faults_of(good_model + "study:\n  figures: [map]\n") ==
        "m.yaml:34:1: study: missing key 'parameters'; expected a mapping from parameters to lists of values or "
        "distributions\n"
        "m.yaml:35:13: study.figures.0: 'map'; expected midplane_pressure or film_thickness");
}

Distribution distribution_of(const std::string& text) {
  const Model model =
      read_text(good_model + "study:\n  plan: sobol\n  parameters:\n    load: " + text + "\n", "m.yaml");
  REQUIRE(model.study->parameters.at(0).distribution.has_value());
  return *model.study->parameters[0].distribution;
}

TEST_CASE("Distributions_AreReadInOneUnit") {
  const Distribution cut = distribution_of(
      "{distribution: truncated_normal, mean: 1 kN, standard_deviation: 50 N, low: 900 N, high: 1.2 kN}");
  const double round_off = 4 * std::numeric_limits<double>::epsilon();  // one factor of units, twice
  CHECK(cut.kind == Distribution::Kind::truncated_normal);
  CHECK(cut.unit == "kN");
  CHECK(cut.mean == 1);
  CHECK(cut.standard_deviation == doctest::Approx(0.05).epsilon(round_off));
  CHECK(cut.low == doctest::Approx(0.9).epsilon(round_off));
  CHECK(cut.highest() == doctest::Approx(1.2).epsilon(round_off));
  const Distribution free = distribution_of("{distribution: normal, mean: 100 N, standard_deviation: 2 N}");
  CHECK(free.lowest() == 90);
  CHECK(free.highest() == 110);
  CHECK(distribution_of("{distribution: triangular, low: 1 N, mode: 1 N, high: 2 N}").mode == 1);
}

TEST_CASE("FaultyDistributions_AreLocated") {
  const auto fault = [](const std::string& text) {
    return faults_of(good_model + "study:\n  plan: sobol\n  parameters:\n    load: " + text + "\n");
  };
  CHECK(fault("{distribution: uniform, low: 2 N, high: 1 N}") ==
        "m.yaml:37:51: study.parameters.load.high: '1 N'; expected a value above `low`");
  CHECK(fault("{distribution: normal, mean: 2 N, standard_deviation: -1 N}") ==
        "m.yaml:37:65: study.parameters.load.standard_deviation: '-1 N'; expected a standard deviation > 0");
  CHECK(fault("{distribution: triangular, low: 1 N, mode: 3 N, high: 2 N}") ==
        "m.yaml:37:54: study.parameters.load.mode: '3 N'; expected a value from `low` to `high`");
  CHECK(
      fault("{distribution: truncated_normal, mean: 1 N, standard_deviation: 1 N, low: 20 N, high: 21 N}") ==
      "m.yaml:37:85: study.parameters.load.low: '20 N'; expected a value at most 8 standard deviations above the mean");
  CHECK(fault("{distribution: truncated_normal, mean: 1 N, standard_deviation: 1 N, low: -21 N, high: -20 N}") ==
        "m.yaml:37:98: study.parameters.load.high: '-20 N'; expected a value at most 8 standard deviations below the "
        "mean");
  CHECK(fault("{distribution: uniform, low: 1 N, high: 3 mm}").find("study.parameters.load.high: a length (mm)") !=
        std::string::npos);
  CHECK(fault("{distribution: normall, mean: 1 N}").find("did you mean 'normal'?") != std::string::npos);
}

TEST_CASE("PlansAndTheirParameters_AreToFit") {
  const std::string range = "{distribution: uniform, low: 1 N, high: 2 N}";
  const auto fault = [](const std::string& text) { return faults_of(good_model + "study:\n" + text); };
  CHECK(fault("  parameters:\n    load: " + range + "\n").find("a distribution in the plan 'full_factorial'") !=
        std::string::npos);
  CHECK(fault("  plan: list\n  parameters:\n    load: [1 N, 2 N]\n    speed: [3 rpm]\n")
            .find("study.parameters.speed: 1 values; expected as many as 'load' has: 2") != std::string::npos);
  CHECK(fault("  plan: optimise\n  parameters:\n    load: [1 N]\n  minimise: bearings.big_end.moft\n")
            .find("study.parameters.load: a list of values; expected {distribution: uniform") != std::string::npos);
  CHECK(fault("  plan: optimise\n  parameters:\n    load: " + range + "\n").find("0 figures to minimise or maximise") !=
        std::string::npos);
  CHECK(fault("  diagram: run_up\n  parameters:\n    load: [1 N]\n").find("'run_up' without `spectrum_of`") !=
        std::string::npos);
}

TEST_CASE("PlansThatDraw_AreNotWrittenOut") {
  const StudyFile file(good_model +
                       "study:\n  plan: halton\n  parameters:\n    load: {distribution: uniform, low: 1 N, "
                       "high: 2 N}\n");
  CHECK_THROWS_WITH_AS((void)expand_study(file.path()), doctest::Contains("`hersey study` runs this one"), InputError);
  CHECK(check_study(file.path()).size() == 1);
  CHECK(check_study(file.path(), {"load=1 N"}).empty());
}

TEST_CASE("EndsOfADistribution_AreCheckedAsValues") {
  const std::string normal =
      "study:\n  plan: sobol\n  parameters:\n    bearings.big_end.radial_clearance:\n      "
      "{distribution: normal, mean: 34 um, standard_deviation: 10 um}\n";
  const StudyFile file(good_model + normal);
  CHECK_THROWS_WITH_AS((void)check_study(file.path()), doctest::Contains("5 standard deviations off the mean"),
                       InputError);
  CHECK_THROWS_WITH_AS((void)check_study(file.path()), doctest::Contains("truncated_normal"), InputError);
}

TEST_CASE("Fingerprint_IsThatOfInputsThatDetermineTheResult") {
  const auto of = [](const std::string& text) { return model_fingerprint(StudyFile(text).path()); };
  CHECK(of(good_model) == of("# a comment\n" + good_model + study));
  CHECK(of(good_model) != of(edited(good_model, "34 um", "35 um")));
}

TEST_CASE("FaultyValueOfAStudy_IsFoundBeforeTheFirstRun") {
  const StudyFile file(good_model + "study:\n  parameters:\n    bearings.big_end.diameter: [45 mm, 45 N]\n");
  CHECK_THROWS_WITH_AS((void)expand_study(file.path()),
                       (file.path() + ":36:5: bearings.big_end.diameter: a force (N); expected a length > 0, such as "
                                      "45 mm")
                           .c_str(),
                       InputError);
}

TEST_CASE("EndlessStudy_IsRefused") {
  std::string text = good_model + "study:\n  parameters:\n";
  for (const char* key : {"load", "speed", "title", "description", "simulation.start", "bearings.big_end.width"}) {
    text += std::string("    ") + key + ": [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]\n";
  }
  text = edited(edited(text, "    title:", "    bearings.big_end.diameter:"), "    description:", "    output.every:");
  const StudyFile file(text);
  CHECK_THROWS_WITH_AS((void)expand_study(file.path()), doctest::Contains("more than 100000 combinations"), InputError);
}

}  // namespace study_test
}  // namespace hersey::model
