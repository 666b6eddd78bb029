#include "hersey/study/sensitivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <exception>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "hersey/bearing/phase_averaged_coefficients.h"
#include "hersey/bearing/steady_derivative.h"
#include "hersey/core/error_text.h"
#include "hersey/core/input_error.h"
#include "hersey/core/quantity_formula.h"
#include "hersey/core/units.h"
#include "hersey/model/read.h"
#include "hersey/model/written.h"

namespace hersey::study {
namespace {

// Steps of a parameter over its value. To one side on a tangent the step itself counts against the round-off of the
// figures, to both sides, about a value of 0, its square; solutions with heat are good to 1e-8 only, and want a longer
// one, but none on which fronts of the film pass nodes of the grid.
constexpr double kTangentStep = 1e-8, kStepAboutZero = 1e-5, kSolutionStep = 2e-4;

/// A model file that is read once.
struct Source {
  std::string text, file;
};

/// Values at key paths of a file with overrides applied.
class Written {
 public:
  Written(const Source& source, const std::vector<std::string>& overrides)
      : whole_(nlohmann::json::parse(model::written_json(source.text, source.file, overrides, ""))) {}

  /// Returns a number with or without unit; none if there is no such key, or a word.
  [[nodiscard]] std::optional<Quantity> number_at(const std::string& key) const {
    const nlohmann::json* here = &whole_;
    for (std::size_t from = 0; from <= key.size();) {
      const std::size_t dot = std::min(key.find('.', from), key.size());
      const auto found = here->is_object() ? here->find(key.substr(from, dot - from)) : here->end();
      if (!here->is_object() || found == here->end()) return std::nullopt;
      here = &*found;
      from = dot + 1;
    }
    if (!here->is_string()) return std::nullopt;
    try {
      return evaluate_formula(here->get<std::string>());
    } catch (const QuantityError&) {
      return std::nullopt;
    }
  }

 private:
  nlohmann::json whole_;
};

/// A unit in SI and its size there: a difference of 1 unit is `size` of `name`.
struct SiUnit {
  std::string name;
  double size = 1;
};

SiUnit si_of(const std::string& unit) {
  if (unit.empty()) return {"", 1};
  for (const Dimension& dimension : dimensions()) {
    try {
      const double zero = convert_to_si({0, unit}, dimension.si_unit);
      return {dimension.si_unit, convert_to_si({1, unit}, dimension.si_unit) - zero};
    } catch (const QuantityError&) {  // measures something else
    }
  }
  return {unit, 1};
}

/// A parameter of the file and its value on both sides.
struct Varied {
  std::string key;
  Quantity middle;
  double step = 0;  ///< in its unit

  [[nodiscard]] std::vector<std::string> overrides(const std::vector<std::string>& others, double sign) const {
    std::vector<std::string> all = others;
    const std::string unit = middle.unit.empty() ? "" : " " + middle.unit;
    all.push_back(fmt::format("{}={:.17g}{}", key, middle.number + sign * step, unit));
    return all;
  }
};

Varied varied(const std::string& key, const Quantity& middle, double share) {
  return {key, middle, share * (middle.number != 0 ? std::abs(middle.number) : 1.0)};
}

/// Two solutions that differ in one parameter.
struct Sides {
  BearingSolution below, above;
  double distance = 0;  ///< in the parameter's unit
};

/// Compares figures by their keys: a figure that only one side has is left out.
std::vector<double> slopes_between(const BearingSolution& here, const Sides& sides, double unit) {
  const std::array figures{figures_of(sides.below), figures_of(sides.above)};
  const auto value = [&](std::size_t side, const BearingFigure& wanted) {
    const auto found = std::find_if(figures[side].begin(), figures[side].end(),
                                    [&](const BearingFigure& f) { return f.key == wanted.key; });
    const bool is_number = found != figures[side].end() && found->words.empty();
    return is_number ? found->si * found->value : std::numeric_limits<double>::quiet_NaN();
  };
  std::vector<double> slopes;
  for (const BearingFigure& figure : figures_of(here))
    slopes.push_back((value(1, figure) - value(0, figure)) / (sides.distance * unit));
  return slopes;
}

/// Computes everything that follows from a state.
void complete(BearingSolution& solution) {
  const double omega = std::abs(solution.state.point.entraining_speed());
  solution.numbers = bearing::bearing_numbers(solution.model, solution.state);
  solution.coefficients = bearing::in_load_axes(solution.model, solution.state);
  solution.whirl = bearing::whirl_stability(
      solution.coefficients, bearing::clearance(solution.model, solution.state.point), solution.numbers.load, omega);
}

/// Stiffness and damping at a solution, as their mean over the possible positions of the grid's lines: each of these
/// films has a tangent of its own.
class MeanCoefficients {
 public:
  explicit MeanCoefficients(const BearingSolution& solution)
      : films_(bearing::turned_films(solution.model, solution.state, {})) {
    for (const bearing::TurnedFilm& film : films_) derivatives_.emplace_back(film.model, film.state);
  }

  /// Replaces the coefficients of `state`, which are those of its own grid.
  void complete_here(bearing::SteadyState& state) {
    std::vector<bearing::TurnedFilm> films = films_;
    for (std::size_t k = 0; k < films.size(); ++k) films[k].state = derivatives_[k].here();
    state.coefficients = bearing::phase_averaged_coefficients(state, films);
  }

  /// Does the same for a state on the tangent.
  /// @returns true if all films have one
  [[nodiscard]] bool complete_beside(const bearing::BearingBeside& side, bearing::SteadyState& state) {
    std::vector<bearing::TurnedFilm> films = films_;
    for (std::size_t k = 0; k < films.size(); ++k) {
      bearing::BearingBeside fixed_film = side;
      fixed_film.model.grid = films[k].model.grid;
      fixed_film.point.load.reset();
      fixed_film.point.e = state.e;
      std::optional<bearing::SteadyState> found = derivatives_[k].beside(fixed_film);
      if (!found) return false;
      films[k].state = std::move(*found);
    }
    state.coefficients = bearing::phase_averaged_coefficients(state, films);
    return true;
  }

 private:
  std::vector<bearing::TurnedFilm> films_;
  std::deque<bearing::SteadyDerivative> derivatives_;
};

/// Solutions near a given one, on its tangent.
class Tangent {
 public:
  Tangent(const Source& source, const BearingSolution& solution, const std::string& bearing)
      : file_(source.text, source.file),
        here_(solution),
        bearing_(bearing),
        derivative_(solution.model, solution.state),
        coefficients_(solution) {
    here_.state = derivative_.here();
    coefficients_.complete_here(here_.state);
    complete(here_);
  }

  /// None if the film has no tangent, or the parameter changes the grid.
  [[nodiscard]] std::optional<Sides> sides(const std::string& key, const Quantity& middle) {
    const bool about_zero = middle.number == 0;
    const Varied parameter = varied(key, middle, about_zero ? kStepAboutZero : kTangentStep);
    std::optional<BearingSolution> below = about_zero ? beside(parameter, -1) : here_;
    if (!below) return std::nullopt;
    std::optional<BearingSolution> above = beside(parameter, 1);
    if (!above) return std::nullopt;
    return Sides{std::move(*below), std::move(*above), (about_zero ? 2 : 1) * parameter.step};
  }

 private:
  [[nodiscard]] std::optional<BearingSolution> beside(const Varied& parameter, double sign) {
    const model::Model model = file_.read(parameter.overrides(here_.run.overrides, sign));
    const model::Bearing& bearing = bearing_called(model, bearing_);
    bearing::BearingBeside side{bearing.film, operating_point_of(bearing)};
    // The scale of its unknowns is the state's: only their meaning counts.
    side.model.fill_speed = here_.model.fill_speed;
    if (bearing.film.grid.size() != here_.model.grid.size()) return std::nullopt;
    std::optional<bearing::SteadyState> state = derivative_.beside(side);
    if (!state || !coefficients_.complete_beside(side, *state)) return std::nullopt;
    BearingSolution solution = here_;
    solution.state = std::move(*state);
    solution.model = std::move(side.model);
    complete(solution);
    return solution;
  }

  model::ModelFile file_;
  BearingSolution here_;
  const std::string& bearing_;
  bearing::SteadyDerivative derivative_;
  MeanCoefficients coefficients_;
};

Sides solved_anew(const Source& source, const BearingSolution& solution, const BearingStudyOptions& options,
                  const Varied& parameter) {
  BearingStudyOptions alone = options;
  alone.grid_error = false;
  alone.first = nullptr;
  std::vector<model::StudyRun> runs(2);
  for (const std::size_t side : {0, 1})
    runs[side].overrides = parameter.overrides(solution.run.overrides, side == 0 ? -1 : 1);
  const model::ModelFile file(source.text, source.file);
  const auto read = [&](const std::vector<std::string>& overrides) { return file.read(overrides); };
  std::vector<BearingSolution> found = solve_bearings(ModelReader(read), runs, alone);
  for (const BearingSolution& side : found)
    if (!side.solved()) throw std::runtime_error(side.message);
  return {std::move(found[0]), std::move(found[1]), 2 * parameter.step};
}

}  // namespace

std::vector<std::string> usual_parameters(const std::string& path, const std::vector<std::string>& overrides,
                                          const std::string& bearing) {
  return usual_parameters(model::file_text(path), path, overrides, bearing);
}

std::vector<std::string> usual_parameters(const std::string& text, const std::string& file,
                                          const std::vector<std::string>& overrides, const std::string& bearing) {
  const model::Model model = model::read_text(text, file, overrides);
  const model::Bearing& here = bearing_called(model, bearing);
  const std::string own = "bearings." + here.name + ".", point = own + "operating_point.",
                    oil = "lubricants." + here.lubricant + ".";
  std::vector<std::string> keys{point + "load",
                                point + "eccentricity_ratio",
                                point + "journal_speed",
                                point + "speed",
                                point + "film_thickness",
                                own + "length",
                                own + "temperature",
                                own + "diameter",
                                own + "width",
                                own + "radial_clearance",
                                own + "diametral_clearance",
                                oil + "viscosity",
                                oil + "temperature",
                                own + "thermal.supply_temperature",
                                own + "supply.pressure",
                                own + "asperities.roughness"};
  for (const film::SurfaceFeature& feature : here.film.features)
    keys.push_back(own + "features." + feature.name + ".pressure");
  const Written written({text, file}, overrides);
  std::erase_if(keys, [&](const std::string& key) { return !written.number_at(key); });
  return keys;
}

bool are_sensitivities_exact(const BearingSolution& solution) {
  return bearing::SteadyDerivative::is_of_film_alone(solution.state) && !solution.elasticity && !solution.pads;
}

std::vector<Sensitivity> sensitivities(const std::string& path, const BearingSolution& solution,
                                       const BearingStudyOptions& options, const std::vector<std::string>& parameters) {
  return sensitivities(model::file_text(path), path, solution, options, parameters);
}

std::vector<Sensitivity> sensitivities(const std::string& text, const std::string& file,
                                       const BearingSolution& solution, const BearingStudyOptions& options,
                                       const std::vector<std::string>& parameters) {
  std::vector<Sensitivity> all;
  if (!solution.solved()) return all;
  const Source source{text, file};
  const Written written(source, solution.run.overrides);
  std::optional<Tangent> tangent;
  const bool may_be_exact = are_sensitivities_exact(solution);
  for (const std::string& key : parameters) {
    const std::optional<Quantity> middle = written.number_at(key);
    if (!middle)
      throw InputError(Fault{{"--sensitivity-to", 0, 0},
                             "",
                             "'" + key + "'",
                             "a key path of the model whose value is a number, or a parameter as parameters.NAME",
                             ""});
    const SiUnit si = si_of(middle->unit);
    Sensitivity& found = all.emplace_back();
    found.parameter = key, found.unit = si.name, found.size = si.size;
    found.value = middle->unit.empty() ? middle->number : convert_to_si(*middle, si.name);
    try {
      std::optional<Sides> sides;
      if (may_be_exact) {
        if (!tangent) tangent.emplace(source, solution, options.bearing);
        sides = tangent->sides(key, *middle);
      }
      found.exact = sides.has_value();
      if (!sides) sides = solved_anew(source, solution, options, varied(key, *middle, kSolutionStep));
      found.slopes = slopes_between(solution, *sides, si.size);
      found.set_solved(true);
    } catch (const InputError& error) {
      found.fail(fmt::format("it has no values on both sides: {}", error_text(error)));
    } catch (const std::exception& error) {
      found.fail(error_text(error));
    }
  }
  return all;
}

}  // namespace hersey::study
