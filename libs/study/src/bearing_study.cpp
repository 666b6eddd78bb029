#include "hersey/study/bearing_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>
#include <thread>
#include <utility>
#include <variant>

#include "hersey/bearing/clearance.h"
#include "hersey/bearing/phase_averaged_coefficients.h"
#include "hersey/bearing/total_coefficients.h"
#include "hersey/core/contract.h"
#include "hersey/core/error_text.h"
#include "hersey/core/input_error.h"
#include "hersey/core/recently_used.h"
#include "hersey/core/spelling.h"
#include "hersey/core/task_pool.h"
#include "hersey/core/units.h"
#include "hersey/model/plausibility.h"
#include "hersey/model/read.h"
#include "hersey/model/steady_elasticity.h"
#include "hersey/model/wall_conduction.h"
#include "pad_bearing.h"

namespace hersey::study {

// Compliance and heat conduction of the meshes used lately: they take long, and most sweeps leave the bodies unchanged.
class KnownBodies {
 public:
  [[nodiscard]] std::shared_ptr<const bearing::SteadyElasticity> elasticity(const model::Model& model,
                                                                            const model::Bearing& bearing) {
    if (!bearing.shell_surface && !bearing.journal_surface) return nullptr;
    const std::string fingerprint = model::fingerprint_of_elasticity(model, bearing);
    const std::lock_guard lock(mutex_);
    if (auto found = elastic_.find(fingerprint)) return found;
    return elastic_.keep(fingerprint, model::steady_elasticity(model, bearing));
  }

  [[nodiscard]] std::shared_ptr<const film::WallConduction> conduction(const model::Model& model,
                                                                       const model::Bearing& bearing) {
    const std::string fingerprint = model::fingerprint_of_wall(model, bearing);
    const std::lock_guard lock(mutex_);
    if (auto found = conducting_.find(fingerprint)) return found;
    return conducting_.keep(fingerprint, model::wall_conduction(model, bearing));
  }

  [[nodiscard]] std::shared_ptr<const film::JournalConduction> journal(const model::Model& model,
                                                                       const model::Bearing& bearing) {
    const std::string fingerprint = model::fingerprint_of_journal(model, bearing);
    const std::lock_guard lock(mutex_);
    if (auto found = journals_.find(fingerprint)) return found;
    return journals_.keep(fingerprint, model::journal_conduction(model, bearing));
  }

 private:
  static constexpr std::size_t kMost = 32;  // more than the bearings of an engine; each may be tens of megabytes

  std::mutex mutex_;
  RecentlyUsed<bearing::SteadyElasticity> elastic_{kMost};
  RecentlyUsed<film::WallConduction> conducting_{kMost};
  RecentlyUsed<film::JournalConduction> journals_{kMost};
};

namespace {

constexpr int kMostSweepValues = 10'000;

Eigen::Vector2d polar(double length, double angle) {
  return length * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

// Requires a path for the heat: a steady film whose oil stays in and whose walls are bodies that nothing cools has no
// temperature.
void require_way_out(const model::Model& model, const model::Bearing& bearing, const film::ThermalModel& heat) {
  if (heat.oil.drain && !film::reaches_surroundings(model.thermal.network, heat.oil.drain->node))
    throw InputError(Fault{
        bearing.position, "bearings." + bearing.name + ".thermal.drains_to",
        "oil that drains to '" + heat.oil.drain->name + "', whose heat reaches no surroundings: it has no steady state",
        "a path from there to a node with a `fixed` temperature", ""});
  if (!has_node_walls(heat) || !film::is_closed(bearing.film)) return;
  const film::FilmTerminals at = film::terminals_of(heat);
  const auto leads_out = [&](const std::optional<std::size_t>& node) {
    return node && film::reaches_surroundings(model.thermal.network, *node);
  };
  const bool takes = std::holds_alternative<film::RingWall>(heat.shell) ||
                     std::holds_alternative<film::WallAtTemperature>(heat.shell) ||
                     std::holds_alternative<film::WallAtTemperature>(heat.journal) ||
                     std::holds_alternative<film::BodyWall>(heat.shell) ||
                     std::holds_alternative<film::BodyJournal>(heat.journal);
  if (takes || leads_out(at.shell) || leads_out(at.journal)) return;
  throw InputError(Fault{bearing.position, "bearings." + bearing.name + ".thermal",
                         "closed edges, and walls that are bodies without a path to surroundings: in a steady state "
                         "the heat has no way out",
                         "a path from these bodies to a node that is `fixed`, or an open edge",
                         "`hersey run` follows how they warm"});
}

std::vector<std::string> warnings_of(const model::Bearing& bearing, const bearing::SteadyState& state) {
  double T = std::numeric_limits<double>::quiet_NaN();
  if (state.heat) T = state.heat->observed.T_max;
  if (state.effective) T = state.effective->T;
  std::vector<std::string> warnings = model::film_warnings(bearing.validity, T, state.film.p_max - bearing.film.p_cav);
  // What no film between real surfaces bears: tension below a vacuum.
  const double vacuum = bearing.film.pressures == film::PressureScale::absolute ? 0 : -101325;
  const double least = bearing.film.p_cav + state.u.minCoeff();
  if (film::cavitation_law(bearing.film).bears_tension() && least < vacuum)
    warnings.push_back(
        fmt::format("the oil bears tension, down to {:.3g} bar where a vacuum has {:.3g} bar: "
                    "`cavitation: full_film` is meant for films that do not cavitate",
                    1e-5 * least, 1e-5 * vacuum));
  for (std::string& warning : model::surface_warnings(bearing, state.film.p_max, state.film.h_min))
    warnings.push_back(std::move(warning));
  for (std::string& warning : model::regime_warnings(bearing, state.film.reynolds_max, state.film.laminar_share))
    warnings.push_back(std::move(warning));
  return warnings;
}

// Temperatures of a solution nearby, if it has as many.
std::optional<film::HeatState> temperatures_of(const bearing::SteadyState& from, const film::FilmModel& film,
                                               const film::ThermalModel& thermal) {
  if (!from.heat) return std::nullopt;
  const film::HeatState rest = film::FilmHeat(film, thermal).state(), &found = from.heat->state;
  const bool fits = rest.film.size() == found.film.size() && rest.shell.size() == found.shell.size() &&
                    rest.supplies.size() == found.supplies.size();
  if (!fits) return std::nullopt;
  film::HeatState start = rest;
  start.film = found.film;
  return start;
}

bearing::SteadySummary solve_at(film::FilmModel& film, const bearing::OperatingPoint& point, const model::Heat& heat,
                                const bearing::SteadyOptions& options, bearing::SteadyState& state) {
  if (const auto* global = std::get_if<bearing::GlobalHeat>(&heat))
    return bearing::solve_global(film, point, *global, options, state);
  return bearing::solve_steady(film, point, options, state);
}

[[noreturn]] void refuse_total(const model::Bearing& bearing, const std::string& found, const std::string& instead) {
  throw InputError(Fault{{"--thermal-coefficients", 0, 0},
                         "bearings." + bearing.name,
                         "'total' of " + found,
                         "'frozen', or " + instead,
                         ""});
}

// Computes stiffness and damping with temperatures that follow the motion, if this is requested; false if they are not
// found.
bool solve_heat(const model::Bearing& bearing, const BearingStudyOptions& options, const bearing::SteadyOptions& steady,
                BearingSolution& solution) {
  if (options.thermal_coefficients == ThermalCoefficients::frozen || !solution.has_temperatures()) return true;
  require_coefficients(bearing, options.thermal_coefficients);
  bearing::SteadyOptions nearby = steady;
  nearby.start_film = solution.state.u;
  if (solution.state.heat) nearby.start_heat = solution.state.heat->state;
  const auto beside = [&](const bearing::OperatingPoint& point, bearing::SteadyState& state) {
    film::FilmModel film = solution.model;
    return solve_at(film, point, bearing.heat, nearby, state);
  };
  const bearing::SteadySummary summary =
      bearing::find_total_coefficients(solution.model, solution.state, beside, solution.state.coefficients);
  solution.thermal_coefficients = ThermalCoefficients::total;
  if (summary.solved()) return true;
  solution.fail(
      fmt::format("bearing {}: no coefficients with temperatures that follow: {}", bearing.name, summary.message));
  return false;
}

void solve_composite(const model::Composite& composite, BearingSolution& solution) {
  if (composite.kind == "tilting_pad") return solve_pads(composite, solution);
  if (composite.kind == "tilting_pad_thrust") return solve_thrust_pads(composite, solution);
  HERSEY_REQUIRE(composite.kind == "floating_ring", "every kind of composite is solved by itself");
  solve_floating_ring(composite, solution);
}

// Solves from `start` if there is one.
void solve_one(const model::Model& model, const BearingStudyOptions& options, const bearing::SteadyState* start,
               KnownBodies& bodies, BearingSolution& solution) {
  const auto began = std::chrono::steady_clock::now();
  const model::Bearing& bearing = bearing_called(model, options.bearing);
  const bearing::OperatingPoint point = operating_point_of(bearing);
  for (const model::Composite& composite : model.composites)
    if (&composite.bearing == &bearing) return solve_composite(composite, solution);
  solution.expands = bearing.expansion.has_value();
  if (const auto* damper = std::get_if<model::DamperPoint>(&*bearing.operating_point))
    solution.whirl_speed = damper->whirl_speed;
  solution.model = bearing::scaled_for(bearing.film, point);
  solution.elasticity = bodies.elasticity(model, bearing);
  solution.solver = solution.elasticity ? film::FilmSolver::newton : bearing.solver;
  bearing::SteadyOptions steady{.kind = bearing.kind,
                                .solver = bearing.solver,
                                .elasticity = solution.elasticity,
                                .inertia_factor = model::momentum_factor(bearing.oil_inertia)};
  if (start != nullptr && start->kind && start->kind->name() != bearing.kind->name()) start = nullptr;
  if (start != nullptr) {
    steady.start = start->e;
    if (start->u.size() == bearing.film.grid.size()) steady.start_film = start->u;
    steady.start_deformation = start->s;
  }
  if (const auto* heat = std::get_if<film::ThermalModel>(&bearing.heat)) {
    require_way_out(model, bearing, *heat);
    steady.thermal = *heat;
    if (auto* body = std::get_if<film::BodyWall>(&steady.thermal->shell))
      body->conduction = bodies.conduction(model, bearing);
    if (auto* body = std::get_if<film::BodyJournal>(&steady.thermal->journal))
      body->conduction = bodies.journal(model, bearing);
    if (film::terminals_of(*heat).has_any()) {
      steady.network = model.thermal.network;
      for (const film::ThermalNode& node : model.thermal.network.nodes) solution.node_names.push_back(node.name);
    }
    if (start != nullptr) steady.start_heat = temperatures_of(*start, bearing.film, *steady.thermal);
  }
  solution.summary = solve_at(solution.model, point, bearing.heat, steady, solution.state);
  if (!solution.summary.solved()) {
    solution.fail(fmt::format("bearing {}: {}", bearing.name, solution.summary.message));
    return;
  }
  for (const std::string& warning : warnings_of(bearing, solution.state))
    solution.warnings.push_back("bearing " + bearing.name + ", " + warning);
  steady.start_film = {}, steady.start_heat = {};
  // Those at the temperatures as they are, whose grid error stands beside those with temperatures that follow, too.
  solution.tangent = solution.state.coefficients;
  const bearing::DynamicCoefficients frozen =
      options.phase_averages ? bearing::phase_averaged_coefficients(solution.model, solution.state, steady)
                             : solution.tangent;
  solution.state.coefficients = frozen;
  if (!solve_heat(bearing, options, steady, solution)) return;
  if (std::holds_alternative<model::JournalPoint>(*bearing.operating_point)) {
    solution.numbers = bearing::bearing_numbers(solution.model, solution.state);
    solution.coefficients = bearing::in_load_axes(solution.model, solution.state);
    solution.whirl =
        bearing::whirl_stability(solution.coefficients, bearing::clearance(solution.model, solution.state.point),
                                 solution.numbers.load, std::abs(point.entraining_speed()));
  }
  if (options.grid_error) {
    const bearing::DynamicCoefficients shown = std::exchange(solution.state.coefficients, frozen);
    solution.grid_error = bearing::estimate_grid_error(solution.model, solution.state, steady);
    solution.state.coefficients = shown;
  }
  solution.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  solution.set_solved(true);
}

[[noreturn]] void fault(const std::string& found, const std::string& suggestion = {}) {
  throw InputError(Fault{{"--sweep", 0, 0},
                         "",
                         found,
                         "name=first:last:count, name=first:last:count:log or name=value,value,...",
                         suggestion});
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t from = 0;
  for (std::size_t to = text.find(separator); to != std::string::npos; to = text.find(separator, from)) {
    parts.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  parts.push_back(text.substr(from));
  return parts;
}

// `count` values from first to last in the unit of `first`.
std::vector<std::string> spaced_values(const std::vector<std::string>& parts, const std::string& text) {
  int count = 0;
  double first = 0, last = 0;
  std::string unit;
  try {
    count = static_cast<int>(parse_quantity(parts[2], "1"));
    const Quantity from = split_quantity(parts[0]);
    unit = from.unit;
    first = from.number;
    last = convert(split_quantity(parts[1]), unit);
  } catch (const QuantityError& error) {
    fault("'" + text + "': " + error.found, error.suggestion);
  }
  const bool is_log = parts.size() == 4;
  if (count < 2 || count > kMostSweepValues) fault(fmt::format("'{}': {} values", text, count), "2 to 10000 values");
  if (is_log && (parts[3] != "log" || first <= 0 || last <= 0)) {
    fault("'" + text + "'", "a logarithmic sweep goes from one value > 0 to another");
  }
  std::vector<std::string> values;
  for (int i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / (count - 1);
    const double value = is_log ? first * std::pow(last / first, share) : first + share * (last - first);
    values.push_back(fmt::format("{:.6g}{}{}", value, unit.empty() ? "" : " ", unit));
  }
  return values;
}

bool is_stopped(const BearingStudyOptions& options) { return options.stop != nullptr && options.stop->load(); }

bool are_neighbours(const model::StudyRun& a, const model::StudyRun& b) {
  int different = 0;
  for (std::size_t k = 0; k < a.values.size(); ++k) different += a.values[k].text != b.values[k].text ? 1 : 0;
  return different == 1;
}

// The nearest solved run of those that differ in one value only; runs are listed in the order of their values.
const BearingSolution* solved_neighbour(const std::vector<BearingSolution>& solutions, std::size_t i) {
  for (std::size_t away = 1; away < solutions.size(); ++away) {
    for (const std::size_t k : {i - away, i + away}) {
      if (k >= solutions.size() || !solutions[k].solved()) continue;
      if (are_neighbours(solutions[i].run, solutions[k].run)) return &solutions[k];
    }
  }
  return nullptr;
}

// Runs without a solution start again from their neighbours' solutions, as long as that finds new ones.
void follow_neighbours(const ModelReader& read, const BearingStudyOptions& options, KnownBodies& bodies,
                       std::vector<BearingSolution>& solutions) {
  bool found = true;
  while (found) {
    found = false;
    for (std::size_t i = 0; i < solutions.size() && !is_stopped(options); ++i) {
      const BearingSolution* neighbour = solutions[i].solved() ? nullptr : solved_neighbour(solutions, i);
      if (neighbour == nullptr) continue;
      BearingSolution again;
      again.run = solutions[i].run;
      try {
        solve_one(read(again.run.overrides), options, &neighbour->state, bodies, again);
      } catch (const std::exception& error) {
        again.fail(error_text(error));
      }
      if (!again.solved()) continue;
      again.from_neighbour = true;
      solutions[i] = std::move(again);
      found = true;
    }
  }
}

}  // namespace

const model::Bearing& bearing_called(const model::Model& model, const std::string& name) {
  std::vector<const model::Bearing*> whole;  // films of a composite are called by their own names only
  for (const model::Composite& composite : model.composites) whole.push_back(&composite.bearing);
  const auto is_part = [&](const model::Bearing& bearing) {
    return std::any_of(model.composites.begin(), model.composites.end(), [&](const model::Composite& composite) {
      return std::find(composite.pads.begin(), composite.pads.end(), bearing.name) != composite.pads.end();
    });
  };
  std::vector<std::string> names;
  for (const model::Bearing& bearing : model.bearings) {
    if (bearing.name == name) return bearing;
    if (!is_part(bearing)) whole.push_back(&bearing);
  }
  for (const model::Bearing* bearing : whole) {
    if (bearing->name == name) return *bearing;
    names.push_back(bearing->name);
  }
  if (names.empty()) throw InputError(Fault{{model.file, 0, 0}, "", "no bearing", "a model with a bearing", ""});
  if (name.empty() && names.size() > 1) {
    throw InputError(Fault{{model.file, 0, 0}, "bearings", "several bearings", "--bearing " + one_of(names), ""});
  }
  if (!name.empty()) {
    throw InputError(
        Fault{{"--bearing", 0, 0}, "", "unknown bearing '" + name + "'", one_of(names), did_you_mean(name, names)});
  }
  return *whole.front();
}

film::FilmFields fields_of(const BearingSolution& solution) {
  return solution.pads ? solution.pads->fields : bearing::steady_fields(solution.model, solution.state);
}

namespace {

// Refuses deforming surfaces in motions that their compliance at rest does not describe.
void require_rest(const model::Bearing& bearing, const model::JournalPoint& point) {
  const std::string path = "bearings." + bearing.name + ".operating_point.";
  const std::string rigid = "`--set bearings." + bearing.name + ".";
  const bool is_elastic = bearing.shell_surface || bearing.journal_surface;
  if (is_elastic && point.radial_velocity != 0)
    throw InputError(
        Fault{point.position, path + "radial_velocity", "a velocity of the journal between surfaces that deform",
              "0: how fast the surfaces follow is part of a motion, which `hersey run` finds",
              rigid + (bearing.shell_surface ? "shell" : "journal") + "_surface=rigid` for rigid surfaces"});
  if (bearing.heated_shell && point.shell_speed != 0)
    throw InputError(Fault{point.position, path + "shell_speed",
                           "a rotating shell, whose temperatures are those of a body",
                           "0: the body rests under the film's heat, and the journal rotates",
                           "another wall: `ring`, `given`, `insulated`"});
  if (bearing.heated_journal && point.journal_speed == 0)
    throw InputError(Fault{point.position, path + "journal_speed",
                           "a journal at rest, whose temperatures are those of a body",
                           "a speed: heat enters a body evenly around because it rotates in its film",
                           "another wall: `free`, `given`, `insulated`, `node`; or let the shell rest and the journal "
                           "rotate: the film knows no difference between its surfaces"});
  if (bearing.shell_surface && point.shell_speed != 0)
    throw InputError(Fault{point.position, path + "shell_speed", "a shell that rotates and deforms",
                           "0: the shell's body is fixed, and the journal rotates",
                           rigid + "shell_surface=rigid` for a rigid shell"});
  const auto travels = [](const film::SurfaceFeature& feature) {
    return feature.surface == film::Surface::shell && !feature.is_fed && feature.depth > 0 &&
           feature.arc < 2 * std::numbers::pi;
  };
  const auto& features = bearing.film.features;
  if (point.shell_speed != 0 && std::any_of(features.begin(), features.end(), travels))
    throw InputError(Fault{point.position, path + "shell_speed", "a rotating shell with pockets that nothing feeds",
                           "0, or pockets of the journal, whose oil travels with them",
                           "the film knows no difference between its surfaces: exchange journal and shell, speeds "
                           "and features"});
}

bearing::OperatingPoint steady_point(const model::Bearing& bearing, const model::JournalPoint& given) {
  require_rest(bearing, given);
  bearing::OperatingPoint point{.journal_speed = given.journal_speed, .shell_speed = given.shell_speed};
  point.journal_angle = given.journal_angle;
  point.tilt = {std::tan(given.tilt_x), std::tan(given.tilt_y)};
  if (given.load) {
    point.load = polar(*given.load, given.load_angle);
  } else {
    point.e = polar(*given.eccentricity_ratio * bearing::clearance(bearing.film),
                    given.eccentricity_angle);  // of the given clearance
    point.e_rate = polar(given.radial_velocity, given.eccentricity_angle);
  }
  return with_growth(point, bearing.film, bearing.growth);
}

// An orbit begins on the axes' x-direction and takes them along. Small motions need no velocity: their film is that of
// the resting journal.
bearing::OperatingPoint steady_point(const model::Bearing& bearing, const model::DamperPoint& given) {
  const double c = bearing::clearance(bearing.film);
  bearing::OperatingPoint point;
  const bool orbits = given.orbit_ratio > 0;
  point.e = orbits ? polar(given.orbit_ratio * c, 0) : polar(given.eccentricity_ratio * c, given.eccentricity_angle);
  if (orbits) point.whirl_speed = given.whirl_speed;
  return with_growth(point, bearing.film, bearing.growth);
}

// A load presses the runner against the pad, a film thickness is the smallest gap of the undeformed surfaces.
bearing::OperatingPoint steady_point(const model::Bearing& bearing, const model::SliderPoint& given) {
  bearing::OperatingPoint point{.journal_speed = given.speed};
  point.tilt = {given.tilt_along, given.tilt_across};
  point.e = bearing::Coordinates::Zero(1);
  point.e_rate = bearing::Coordinates::Constant(1, given.approach_speed);
  if (given.load) {
    point.load = bearing::Coordinates::Constant(1, *given.load);
    return point;
  }
  const std::unique_ptr<bearing::SteadyCoordinates> coordinates = bearing.kind->steady_coordinates(bearing.film);
  const bearing::Coordinates widest = coordinates->widest();
  point.e =
      bearing::Coordinates::Constant(1, widest[0] + coordinates->smallest_gap(point, widest) - *given.film_thickness);
  return point;
}

// The load presses the runner against the stator, whose z points to the runner.
bearing::OperatingPoint steady_point(const model::Bearing& bearing, const model::ThrustPoint& given) {
  bearing::OperatingPoint point{.journal_speed = given.speed};
  point.tilt = {given.tilt_x, given.tilt_y};
  point.e = bearing::Coordinates::Zero(1);
  point.e_rate = bearing::Coordinates::Constant(1, -given.approach_speed);
  if (given.load) {
    point.load = bearing::Coordinates::Constant(1, -*given.load);
    return point;
  }
  const std::unique_ptr<bearing::SteadyCoordinates> coordinates = bearing.kind->steady_coordinates(bearing.film);
  const bearing::Coordinates widest = coordinates->widest();
  point.e =
      bearing::Coordinates::Constant(1, widest[0] - coordinates->smallest_gap(point, widest) + *given.film_thickness);
  return point;
}

// Both ends' offsets are one of the middle and a slope. Speeds are those of a surface with the skirt's radius.
bearing::OperatingPoint steady_point(const model::Bearing& bearing, const model::SkirtPoint& given) {
  bearing::OperatingPoint point{.journal_speed = given.speed / bearing.film.R};
  point.e = point.e_rate = bearing::Coordinates::Zero(1);
  if (given.side_force) {
    point.load = bearing::Coordinates::Constant(1, *given.side_force);
    point.tilt.x() = given.tilt;
    return point;
  }
  point.e[0] = 0.5 * (given.offset_top + given.offset_bottom);
  point.e_rate[0] = 0.5 * (given.velocity_top + given.velocity_bottom);
  point.tilt.x() = (given.offset_top - given.offset_bottom) / bearing.film.L;
  point.tilt_rate.x() = (given.velocity_top - given.velocity_bottom) / bearing.film.L;
  return point;
}

}  // namespace

void require_coefficients(const model::Bearing& bearing, ThermalCoefficients coefficients) {
  const auto* heat = std::get_if<film::ThermalModel>(&bearing.heat);
  const bool has_temperatures = heat != nullptr || std::holds_alternative<bearing::GlobalHeat>(bearing.heat);
  if (coefficients == ThermalCoefficients::frozen || !has_temperatures) return;
  const bool is_elastic = bearing.shell_surface || bearing.journal_surface;
  if (is_elastic || (heat != nullptr && std::holds_alternative<film::BodyWall>(heat->shell)) ||
      (heat != nullptr && std::holds_alternative<film::BodyJournal>(heat->journal)))
    refuse_total(bearing, "surfaces that deform", "rigid surfaces");
  if (bearing.expansion) refuse_total(bearing, "walls that expand", "a clearance without `expansion`");
  if (heat != nullptr && film::terminals_of(*heat).has_any())
    refuse_total(bearing, "nodes of a network", "walls and oil by themselves");
}

bearing::OperatingPoint operating_point_of(const model::Bearing& bearing) {
  if (!bearing.operating_point) {
    throw InputError(Fault{bearing.position, "bearings." + bearing.name, "no operating point",
                           bearing.kind->has_axis()
                               ? "an 'operating_point' in the file, or --speed with --load or --eccentricity-ratio"
                               : "an 'operating_point' in the file, or --speed with --load",
                           ""});
  }
  for (std::size_t f = 0; f < bearing.feature_pressures.size(); ++f) {
    const std::string path = "bearings." + bearing.name + ".features." + bearing.film.features[f].name;
    if (model::node_of_feature(bearing, f))
      throw InputError(Fault{
          bearing.position, path, "a feed of the circuit, which is solved with the whole machine",
          "`hersey run`, with `analysis: steady` for a steady motion, or a `pressure` in place of `circuit`", ""});
    const model::Function& pressure = bearing.feature_pressures[f];
    if (pressure.is_constant()) continue;
    throw InputError(Fault{pressure.position, pressure.path, "a pressure that varies",
                           "a constant one for a bearing by itself",
                           "--set bearings." + bearing.name + ".features." + bearing.film.features[f].name +
                               ".pressure='2 bar' takes its place"});
  }
  return std::visit([&](const auto& given) { return steady_point(bearing, given); }, *bearing.operating_point);
}

std::vector<BearingSolution> solve_bearings(const ModelReader& read, const std::vector<model::StudyRun>& runs,
                                            const BearingStudyOptions& options) {
  std::vector<BearingSolution> solutions(runs.size());
  if (runs.empty()) return solutions;
  // Faults of the model itself are reported once, from here, before any thread is started.
  const model::Model first = options.first != nullptr ? *options.first : read(runs.front().overrides);
  (void)operating_point_of(bearing_called(first, options.bearing));
  std::atomic<std::size_t> next{0};
  KnownBodies bodies;
  const auto work = [&] {
    const TaskPool::OwnThread one(TaskPool::shared());
    for (std::size_t i = next++; i < runs.size(); i = next++) {
      solutions[i].run = runs[i];
      if (is_stopped(options)) {
        solutions[i].fail(kNotBegun);
        continue;
      }
      try {
        if (i == 0) {
          solve_one(first, options, nullptr, bodies, solutions[i]);
        } else {
          solve_one(read(runs[i].overrides), options, nullptr, bodies, solutions[i]);
        }
      } catch (const std::exception& error) {
        solutions[i].fail(error_text(error));
      }
    }
  };
  const auto wanted = static_cast<std::size_t>(options.threads > 0 ? options.threads : TaskPool::shared().threads());
  std::vector<std::jthread> threads;
  for (std::size_t i = 1; i < std::min(std::max<std::size_t>(wanted, 1), runs.size()); ++i) threads.emplace_back(work);
  work();
  threads.clear();
  follow_neighbours(read, options, bodies, solutions);
  return solutions;
}

std::vector<BearingSolution> solve_bearings(const std::string& path, const std::vector<model::StudyRun>& runs,
                                            const BearingStudyOptions& options) {
  const model::ModelFile file(path);
  const auto read = [&](const std::vector<std::string>& overrides) { return file.read(overrides); };
  return solve_bearings(ModelReader(read), runs, options);
}

BearingSolver::BearingSolver() : bodies_(std::make_shared<KnownBodies>()) {}

BearingSolution BearingSolver::solve(const model::Model& model, const BearingStudyOptions& options) const {
  if (options.nearby != nullptr && options.nearby->solved()) {
    BearingSolution solution;
    solve_one(model, options, &options.nearby->state, *bodies_, solution);
    solution.from_neighbour = true;
    if (solution.solved()) return solution;
  }
  BearingSolution solution;
  solve_one(model, options, nullptr, *bodies_, solution);
  return solution;
}

struct RunSolver::Impl {
  std::string path;
  std::vector<std::string> given;
  KnownBodies bodies;
  std::map<std::string, std::optional<BearingSolution>> unchanged;  ///< by bearing; empty: has no solution
  std::optional<model::ModelFile> file;                             ///< once it was readable

  model::Model read(const std::vector<std::string>& overrides) {
    if (!file) file.emplace(path);
    return file->read(overrides);
  }

  BearingSolution attempt(const model::Model& model, const model::StudyRun& run, const std::string& bearing,
                          const bearing::SteadyState* start) {
    BearingSolution solution;
    solution.run = run;
    const BearingStudyOptions options{.bearing = bearing, .grid_error = false};
    solve_one(model, options, start, bodies, solution);
    return solution;
  }

  const BearingSolution* start_of(const std::string& bearing) {
    const auto known = unchanged.find(bearing);
    if (known != unchanged.end()) return known->second ? &*known->second : nullptr;
    std::optional<BearingSolution>& kept = unchanged[bearing];
    try {
      kept = attempt(read(given), {given, "", "", {}}, bearing, nullptr);
      if (!kept->solved()) kept.reset();
    } catch (const std::exception&) {
      kept.reset();  // the unchanged model has no solution: the run's own reason is reported
    }
    return kept ? &*kept : nullptr;
  }
};

RunSolver::RunSolver(std::string path, std::vector<std::string> given) : impl_(std::make_unique<Impl>()) {
  impl_->path = std::move(path);
  impl_->given = std::move(given);
}

RunSolver::~RunSolver() = default;

std::vector<std::pair<std::string, BearingSolution>> RunSolver::solve(const model::StudyRun& run,
                                                                      const std::vector<std::string>& bearings) {
  const model::Model model = impl_->read(run.overrides);
  std::vector<std::string> wanted = bearings;
  if (wanted.empty())
    for (const model::Bearing& bearing : model.bearings)
      if (bearing.operating_point) wanted.push_back(bearing.name);
  if (bearings.empty())
    for (const model::Composite& composite : model.composites)
      if (composite.bearing.operating_point) wanted.push_back(composite.bearing.name);
  if (wanted.empty()) (void)operating_point_of(bearing_called(model, ""));
  std::vector<std::pair<std::string, BearingSolution>> solutions;
  for (const std::string& name : wanted) {
    BearingSolution solution = impl_->attempt(model, run, name, nullptr);
    if (!solution.solved()) {
      if (const BearingSolution* start = impl_->start_of(name); start != nullptr) {
        BearingSolution again = impl_->attempt(model, run, name, &start->state);
        if (again.solved()) {
          again.from_neighbour = true;
          solution = std::move(again);
        }
      }
    }
    solutions.emplace_back(name, std::move(solution));
  }
  return solutions;
}

model::StudyParameter parse_sweep(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) fault("'" + text + "'");
  model::StudyParameter parameter{text.substr(0, equals), {}, {"--sweep", 0, 0}};
  const std::string values = text.substr(equals + 1);
  const std::vector<std::string> parts = split(values, ':');
  if (parts.size() == 1) {
    parameter.values = split(values, ',');
  } else if (parts.size() == 3 || parts.size() == 4) {
    parameter.values = spaced_values(parts, text);
  } else {
    fault("'" + text + "'");
  }
  for (const std::string& value : parameter.values) {
    if (value.empty()) fault("'" + text + "': an empty value");
  }
  return parameter;
}

}  // namespace hersey::study
