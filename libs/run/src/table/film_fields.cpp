#include "hersey/run/film_fields.h"

#include "hersey/film/temperature_law.h"

namespace hersey::run {

namespace {

/// A line for temperatures, which files and tables give in degC.
FilmField temperature(const char* name, const char* label, const char* text, Eigen::VectorXd film::FilmFields::*T,
                      const char* symbol) {
  const auto celsius = [T](const film::FilmFields& fields) -> Eigen::VectorXd {
    return (fields.*T).array() - film::zero_celsius;
  };
  return {name, "degC", text, label, "degC", 1, celsius, symbol, "of films with `thermal: {model: film}`"};
}

}  // namespace

const std::vector<FilmField>& film_fields() {
  using F = film::FilmFields;
  static const std::string of_elastic = "of surfaces of elastic bodies; against the surface's frame";
  static const std::string of_wear = "of bearings with `wear`";
  static const std::vector<FilmField> table{
      {"pressure", "Pa", "film pressure", "pressure", "MPa", 1e-6, &F::p, "p"},
      {"asperity_pressure", "Pa", "asperity contact pressure", "asperity pressure", "MPa", 1e-6, &F::p_asperity, "p_a"},
      {"thickness", "m", "film thickness, depth of features included", "film thickness", "um", 1e6, &F::thickness, "h"},
      {"fill", "1", "fill fraction", "fill fraction", "", 1, &F::theta, "theta"},
      {"reynolds_number", "1", "Reynolds number of the sliding, rho v h/mu", "Reynolds number", "", 1, &F::reynolds,
       "Re", "of films with a model of `turbulence`"},
      {"shell_displacement", "m", "radial displacement of the shell's surface, outward", "shell displacement", "um",
       1e6, &F::d_shell, "", of_elastic},
      {"journal_displacement", "m", "radial displacement of the journal's surface, outward", "journal displacement",
       "um", 1e6, &F::d_journal, "", of_elastic},
      {"fixed_wear", "m", "depth worn off the fixed surface", "wear of the fixed surface", "um", 1e6, &F::worn_fixed,
       "", of_wear},
      {"moving_wear", "m", "depth worn off the moving surface; of a journal with `around: local` in its own axes",
       "wear of the moving surface", "um", 1e6, &F::worn_moving, "", of_wear},
      {"roughness", "m", "composite rms roughness of the asperities", "roughness of the asperities", "um", 1e6,
       &F::roughness, "sigma", "of bearings with `wear.running_in`"},
      temperature("temperature", "oil temperature", "temperature of the oil, mean over the thickness", &F::T, "T"),
      temperature("shell_temperature", "shell temperature", "temperature of the shell's surface, or of pads' faces",
                  &F::T_shell, "T_S"),
      temperature("journal_temperature", "journal temperature",
                  "temperature of the journal's surface, or of the runner's", &F::T_journal, "T_J"),
      temperature("hottest_temperature", "hottest layer", "temperature of the hottest layer of oil", &F::T_hottest, ""),
  };
  return table;
}

}  // namespace hersey::run
