#include "pad_bearing.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "hersey/bearing/clearance.h"
#include "hersey/bearing/journal_bearing.h"
#include "hersey/core/contract.h"
#include "hersey/core/error_text.h"
#include "hersey/core/input_error.h"
#include "hersey/core/scalar_function.h"
#include "hersey/core/two_pi.h"
#include "hersey/model/plausibility.h"
#include "hersey/run/steady_motion.h"
#include "hersey/solver/reduced_coefficients.h"

namespace hersey::study {
namespace {

constexpr const char* journal_joint = "journal";

/// After which a search counts as one without an answer: those with one need ten.
constexpr int most_iterations = 100;

/// Numbers of the pads in the order of their angles, from which each film's lines are counted on.
std::vector<std::size_t> around(const std::vector<model::Bearing>& films) {
  std::vector<std::size_t> order(films.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto begin = [&](std::size_t k) {
    const double angle = films[k].film.grid.phi(0);
    return angle - two_pi * std::floor((angle + std::numbers::pi) / two_pi);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return begin(a) < begin(b); });
  return order;
}

void append(Eigen::VectorXd& all, const Eigen::VectorXd& more) {
  const Eigen::Index before = all.size();
  all.conservativeResize(before + more.size());
  all.tail(more.size()) = more;
}

/// Film of all pads together: arcs of one bore.
class WholeFilm {
 public:
  explicit WholeFilm(const std::vector<model::Bearing>& films) : films_(films), order_(around(films)) {
    model = films.front().film;
    model.grid = {.n_phi = 0,
                  .n_z = films.front().film.grid.n_z,
                  .angles = {},
                  .heights = films.front().film.grid.heights,
                  .patches = {}};
    model.ends.clear();
    film::Arcs bore;
    for (const std::size_t k : order_) add_model(films_[k], k, bore);
    model.profiles = {{std::move(bore), film::Surface::shell}};
  }

  /// Adds what the pads' films show.
  /// @param fixed_tilts  of pads that stand aside, whose films are not what they are in the bearing
  void observe(const run::SteadyMotion& motion, const std::vector<double>& fixed_tilts) {
    film.h_min = film.h_min_centre = std::numeric_limits<double>::infinity();
    film.h_min_features = film.rupture_angle = film.reformation_angle = std::numeric_limits<double>::quiet_NaN();
    film.laminar_share = 0;
    film.force_pressure.setZero(), film.force_shear.setZero(), film.force_asperity.setZero();
    for (const std::size_t k : order_) {
      if (std::isnan(fixed_tilts[k])) add_extremes(motion.bearings[k].film);
      add_figures(motion.bearings[k].film, films_[k].film.grid);
      add_fields(motion.fields[k]);
    }
  }

  [[nodiscard]] const std::vector<std::size_t>& order() const { return order_; }

  film::FilmModel model;
  film::FilmObservables film;
  film::FilmFields fields;

 private:
  void add_model(const model::Bearing& pad, std::size_t number, film::Arcs& bore) {
    film::Grid& grid = model.grid;
    const film::Grid& own = pad.film.grid;
    grid.patches.push_back(grid.n_phi);
    const double last = grid.angles.empty() ? -std::numbers::pi : grid.angles.back();
    const double shift = two_pi * std::ceil((last - own.phi(0)) / two_pi);
    for (int i = 0; i < own.n_phi; ++i) grid.angles.push_back(own.phi(i) + shift);
    grid.n_phi += own.n_phi;
    model.ends.push_back(pad.film.ends.front());
    const film::Arcs* arcs = film::arcs_of(pad.film);
    HERSEY_REQUIRE(arcs != nullptr, "a pad's film lies on an arc");
    bore.arcs.push_back(arcs->arcs.front());
    bore.arcs.back().name = fmt::format("{}", number + 1);
    bore.arcs.back().from += shift, bore.arcs.back().to += shift;
  }

  void add_extremes(const film::FilmObservables& pad) {
    if (pad.h_min < film.h_min) film.h_min = pad.h_min, film.h_min_phi = pad.h_min_phi, film.h_min_z = pad.h_min_z;
    film.h_min_centre = std::min(film.h_min_centre, pad.h_min_centre);
    if (pad.p_max > film.p_max) film.p_max = pad.p_max, film.p_max_phi = pad.p_max_phi, film.p_max_z = pad.p_max_z;
    film.p_max_node = std::max(film.p_max_node, pad.p_max_node);
  }

  void add_figures(const film::FilmObservables& pad, const film::Grid& grid) {
    film.wrench_on_shell += pad.wrench_on_shell;
    append(film.normal_forces, pad.normal_forces);
    film.force_pressure += pad.force_pressure, film.force_shear += pad.force_shear;
    film.force_asperity += pad.force_asperity;
    film.sliding_speed = pad.sliding_speed;
    for (const auto sum :
         {&film::FilmObservables::torque_journal, &film::FilmObservables::torque_shell,
          &film::FilmObservables::power_film, &film::FilmObservables::torque_journal_other_shear,
          &film::FilmObservables::power_film_other_shear, &film::FilmObservables::power_asperity,
          &film::FilmObservables::power_stored, &film::FilmObservables::power_oil, &film::FilmObservables::flow_left,
          &film::FilmObservables::flow_right, &film::FilmObservables::flow_first, &film::FilmObservables::flow_last,
          &film::FilmObservables::flow_supply, &film::FilmObservables::storage_rate,
          &film::FilmObservables::oil_volume})
      film.*sum += pad.*sum;
    film.patches.push_back(pad.patches.front());
    film.mass_balance_error = std::max(film.mass_balance_error, pad.mass_balance_error);
    film.reynolds_max = std::max(film.reynolds_max, pad.reynolds_max);
    film.taylor_max = std::max(film.taylor_max, pad.taylor_max);
    const double part = (grid.phi(grid.n_phi - 1) - grid.phi(0)) / angle_of_pads();
    film.laminar_share += part * pad.laminar_share, film.transition_share += part * pad.transition_share;
    film.turbulent_share += part * pad.turbulent_share;
    film.cavitated_share += part * pad.cavitated_share;
  }

  void add_fields(const film::FilmFields& pad) {
    for (const auto field :
         {&film::FilmFields::p, &film::FilmFields::theta, &film::FilmFields::density, &film::FilmFields::h,
          &film::FilmFields::depth, &film::FilmFields::w, &film::FilmFields::p_asperity, &film::FilmFields::reynolds,
          &film::FilmFields::T, &film::FilmFields::T_shell, &film::FilmFields::T_journal, &film::FilmFields::T_hottest})
      append(fields.*field, pad.*field);
  }

  [[nodiscard]] double angle_of_pads() const {
    double sum = 0;
    for (const model::Bearing& pad : films_) sum += pad.film.grid.phi(pad.film.grid.n_phi - 1) - pad.film.grid.phi(0);
    return sum;
  }

  const std::vector<model::Bearing>& films_;
  std::vector<std::size_t> order_;
};

/// Motion of the joint called `name`.
const mbd::JointObservation& joint_of(const model::Model& model, const run::SteadyMotion& motion,
                                      const std::string& name) {
  const auto found =
      std::find_if(model.joints.begin(), model.joints.end(), [&](const model::Joint& j) { return j.name == name; });
  HERSEY_REQUIRE(found != model.joints.end(), "a bearing by itself has its parts' names");
  return motion.joints[static_cast<std::size_t>(found - model.joints.begin())];
}

bool has_joint(const model::Model& model, const std::string& name) {
  return std::any_of(model.joints.begin(), model.joints.end(), [&](const model::Joint& j) { return j.name == name; });
}

/// Names of the coordinates of the journal's centre.
std::vector<std::string> journal_axes() {
  return {fmt::format("joint {}, x", journal_joint), fmt::format("joint {}, y", journal_joint)};
}

/// Rotation of a pad about the axis along the bearing, whatever its pivot allows.
double tilt_of(const mbd::JointObservation& pivot) { return pivot.position[pivot.position.size() - 1]; }

/// A steady motion of journal and pads, and the pads that have none and stand aside in it.
struct PadMotion {
  model::Model alone;                    ///< with those pads fixed
  std::vector<double> fixed_tilts = {};  ///< of each pad; not a number of one that is free
  run::SteadyMotion motion = {};
};

/// Force of the film on a pad, bearing axes [N].
Eigen::Vector2d force_on_pad(const model::Composite& composite, std::size_t k, const run::SteadyMotion& motion) {
  const mbd::JointObservation& pivot = joint_of(*composite.alone, motion, composite.pads[k] + "_pivot");
  const double tilt = pivot.position.size() > 0 ? tilt_of(pivot) : 0;  // a fixed pad carries nothing to speak of
  return Eigen::Rotation2Dd(tilt) * Eigen::Vector2d(motion.bearings[k].wrench_on_shell.segment<2>(3));
}

PadState pad_state(const model::Composite& composite, std::size_t k, const PadMotion& found) {
  const model::Model& alone = *composite.alone;
  const run::SteadyMotion& motion = found.motion;
  PadState pad{.name = fmt::format("{}", k + 1), .pivot_angle = composite.pivot_angles[k]};
  pad.is_aside = !std::isnan(found.fixed_tilts[k]);
  pad.tilt = pad.is_aside ? found.fixed_tilts[k] : tilt_of(joint_of(alone, motion, composite.pads[k] + "_pivot"));
  if (const std::string travel = composite.pads[k] + "_travel"; has_joint(alone, travel))
    pad.pivot_travel = joint_of(alone, motion, travel).position[0];
  pad.force = force_on_pad(composite, k, motion);
  // The gap is smooth over a pad: the film at the pivot lies between two lines.
  const film::Grid& grid = alone.bearings[k].film.grid;
  const Eigen::VectorXd& h = motion.fields[k].h;
  const int row = grid.n_z / 2;
  double angle = pad.pivot_angle - grid.phi(0);
  angle -= two_pi * std::floor(angle / two_pi);
  int i = 0;
  while (i + 2 < grid.n_phi && grid.phi(i + 1) - grid.phi(0) < angle) ++i;
  const double step = grid.phi(i + 1) - grid.phi(i), part = (angle - (grid.phi(i) - grid.phi(0))) / step;
  pad.h_pivot = (1 - part) * h[grid.index(i, row)] + part * h[grid.index(i + 1, row)];
  return pad;
}

/// Fixes a pad at a tilt: its pivot carries what the film does, and nothing of it moves.
void fix_pad(model::Model& alone, const std::string& pad, double tilt) {
  const std::string pivot = pad + "_pivot";
  std::erase_if(alone.forces, [&](const model::Force& force) { return force.name == pad + "_friction"; });
  for (model::Joint& joint : alone.joints) {
    if (joint.name != pivot) continue;
    joint.type = model::JointType::fixed;
    joint.initial.clear();
  }
  for (model::Body& body : alone.bodies) {
    if (body.name != pad) continue;
    for (model::Frame& frame : body.frames)
      if (frame.name == "pivot") frame.X_BF.R = Eigen::AngleAxisd(-tilt, Vector3::UnitZ()).toRotationMatrix();
  }
}

/// Tilt at which the film of a pad only widens along the sliding direction and carries nothing [rad].
double unloaded_tilt(const model::Composite& composite, std::size_t k, double speed) {
  const model::Bearing& pad = composite.alone->bearings[k];
  const film::Arc& arc = film::arcs_of(pad.film)->arcs.front();
  const double pivot = composite.pivot_angles[k];
  const double to_leading_end = std::abs(std::remainder(speed > 0 ? pivot - arc.from : arc.to - pivot, two_pi));
  return -std::copysign(0.5, speed) * bearing::clearance(pad.film) /
         (pad.film.R * std::sin(std::min(to_leading_end, 0.25 * two_pi)));
}

/// The pads that are least loaded, of those that are free: the ones farthest from the direction of the load; none if
/// only pads are left that the journal needs.
std::vector<std::size_t> least_loaded(const model::Composite& composite, const std::vector<double>& fixed_tilts,
                                      double load_angle) {
  constexpr double same = 1e-9;  // of cosines: pads on both sides of the load's line differ by round-off
  std::vector<std::size_t> least;
  double smallest = -same;
  for (std::size_t k = 0; k < fixed_tilts.size(); ++k) {
    const double part = std::cos(composite.pivot_angles[k] - load_angle);
    if (!std::isnan(fixed_tilts[k]) || part > smallest + same) continue;
    if (part < smallest - same) least.clear();
    smallest = std::min(smallest, part);
    least.push_back(k);
  }
  return least;
}

/// The bearing with all joints starting where a motion has them.
model::Model starting_at(model::Model alone, const run::SteadyMotion& motion) {
  for (std::size_t k = 0; k < alone.joints.size(); ++k) {
    const mbd::JointValues& position = motion.joints[k].position;
    for (model::InitialValue& initial : alone.joints[k].initial)
      if (static_cast<Eigen::Index>(initial.value.size()) == position.size())
        initial.value.assign(position.begin(), position.end());
  }
  return alone;
}

/// The bearing with its journal held at `e` [m].
model::Model with_journal_at(model::Model alone, const Eigen::Vector2d& e) {
  std::erase_if(alone.forces, [](const model::Force& force) { return force.name == "load"; });
  std::erase_if(alone.drives, [](const model::Drive& drive) { return drive.coordinate != "rotation"; });
  for (const auto& [axis, at] : {std::pair{"x", e.x()}, std::pair{"y", e.y()}})
    alone.drives.push_back({.name = axis,
                            .joint = journal_joint,
                            .coordinate = axis,
                            .motion = {.value = std::make_shared<ConstantFunction>(at)}});
  return alone;
}

/// Velocity components of the journal's centre.
std::vector<solver::Equations::Index> journal_coordinates(const run::SteadyMotion& motion) {
  std::vector<solver::Equations::Index> found;
  for (const std::string& name : journal_axes()) {
    const auto at = std::find(motion.coordinates.begin(), motion.coordinates.end(), name);
    HERSEY_REQUIRE(at != motion.coordinates.end(), "the journal moves in a plane");
    found.push_back(at - motion.coordinates.begin());
  }
  return found;
}

/// The motions of coordinates that a linearisation's directions give.
Eigen::MatrixXd over_coordinates(const solver::Linearisation& linear, const Eigen::MatrixXd& A) {
  const Eigen::MatrixXd along = linear.Z.completeOrthogonalDecomposition().pseudoInverse();
  return along.transpose() * A * along;
}

/// True if pads return to where a motion has them while the journal is held: no motion of theirs, which films resist by
/// C y', grows by -K y.
bool pads_return(const run::SteadyMotion& motion) {
  std::vector<Eigen::Index> of_pads;
  for (std::size_t row = 0; row < motion.coordinates.size(); ++row)
    if (!motion.coordinates[row].starts_with(fmt::format("joint {},", journal_joint)))
      of_pads.push_back(static_cast<Eigen::Index>(row));
  if (of_pads.empty()) return true;
  const solver::Linearisation& linear = motion.small_motions;
  const Eigen::MatrixXd K = over_coordinates(linear, linear.K)(of_pads, of_pads),
                        C = over_coordinates(linear, linear.C)(of_pads, of_pads);
  const Eigen::VectorXcd rates = C.fullPivLu().solve(K).eigenvalues();
  return rates.real().minCoeff() > 0;
}

/// The motion with the journal held at `e`, reached from the middle of the bearing in steps that pads can follow; a
/// last one unsolved tells why there is none.
run::SteadyMotion motion_held_at(const model::Model& alone, const Eigen::Vector2d& e) {
  constexpr double shortest = 1.0 / 64;
  model::Model from = alone;
  run::SteadyMotion motion;
  double reached = 0, step = 1;
  while (reached < 1) {
    try {
      motion = run::find_steady_motion(with_journal_at(from, (reached + step) * e), journal_axes(), most_iterations);
      if (motion.solved() && !pads_return(motion)) motion.fail("pads that would tilt away from where they stand");
    } catch (const InputError& error) {  // pads that stand as they began touch the journal there
      motion.fail(error_text(error));
    }
    if (motion.solved()) {
      from = starting_at(std::move(from), motion);
      reached += step;
    } else if (step /= 2; step < shortest) {
      return motion;
    }
  }
  return motion;
}

/// Force of the films on the pads [N].
Eigen::Vector2d carried_by(const model::Composite& composite, const run::SteadyMotion& motion) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < composite.pads.size(); ++k) sum += force_on_pad(composite, k, motion);
  return sum;
}

/// The motion under the load, sought with journal and pads at once, and if that fails by Newton's method over the
/// journal's place alone, the pads in balance at each.
run::SteadyMotion motion_under_load(const model::Composite& composite, const model::Model& alone,
                                    const model::JournalPoint& point) {
  const run::SteadyMotion direct = run::find_steady_motion(alone, {}, most_iterations);
  if (direct.solved() && pads_return(direct)) return direct;
  const Eigen::Vector2d load = *point.load * Eigen::Vector2d(std::cos(point.load_angle), std::sin(point.load_angle));
  const double longest = 0.15 * bearing::clearance(alone.bearings.front().film);
  constexpr int most = 25;
  constexpr double near = 1e-3;  // of the load, from where journal and pads are found at once
  model::Model from = alone;
  Eigen::Vector2d e = Eigen::Vector2d::Zero();
  for (int i = 0; i < most; ++i) {
    const run::SteadyMotion held = motion_held_at(from, e);
    if (!held.solved()) break;
    from = starting_at(std::move(from), held);
    const Eigen::Vector2d missing = load - carried_by(composite, held);
    if (missing.norm() < near * load.norm()) {
      for (model::Joint& joint : from.joints)
        if (joint.name == journal_joint) joint.initial = {{"x", {e.x()}, {}}, {"y", {e.y()}, {}}};
      run::SteadyMotion motion = run::find_steady_motion(from, {}, most_iterations);
      if (motion.solved()) return motion;
      break;
    }
    const Eigen::Vector2d step = reduce(held.small_motions, journal_coordinates(held), 0).K.fullPivLu().solve(missing);
    e += std::min(1.0, longest / step.norm()) * step;
  }
  return direct;
}

/// Finds the motion; pads opposite to the load that shear or the shape of their films turns over, so that nothing
/// balances them, are fixed where they carry nothing, the most remote from the load first.
PadMotion find_motion(const model::Composite& composite, const model::JournalPoint& point) {
  const double direction = point.load ? point.load_angle : point.eccentricity_angle;
  const Eigen::Vector2d e =
      point.load ? Eigen::Vector2d::Zero()
                 : Eigen::Vector2d(*point.eccentricity_ratio * bearing::clearance(composite.bearing.film) *
                                   Eigen::Vector2d(std::cos(direction), std::sin(direction)));
  const auto sought = [&](const model::Model& alone) {
    return point.load ? motion_under_load(composite, alone, point) : motion_held_at(alone, e);
  };
  PadMotion found{.alone = *composite.alone};
  found.fixed_tilts.assign(composite.pads.size(), std::numeric_limits<double>::quiet_NaN());
  found.motion = sought(found.alone);
  const std::string why = found.motion.message;
  while (!found.motion.solved()) {
    const std::vector<std::size_t> unloaded = least_loaded(composite, found.fixed_tilts, direction);
    for (const std::size_t k : unloaded) {
      found.fixed_tilts[k] = unloaded_tilt(composite, k, point.journal_speed);
      fix_pad(found.alone, composite.pads[k], found.fixed_tilts[k]);
    }
    if (unloaded.empty()) {
      found.motion.message = why;
      break;
    }
    found.motion = sought(found.alone);
  }
  return found;
}

/// Small motions about the motion, their stiffness and damping the means over four positions of the grids' lines in
/// their cells, the journal at one place: the fronts of films jump from line to line, theory manual eq. (bearing.38).
solver::Linearisation mean_small_motions(const PadMotion& found) {
  constexpr int positions = 4;
  const Eigen::Vector2d e = joint_of(found.alone, found.motion, journal_joint).position.head<2>();
  const model::Model held = with_journal_at(starting_at(found.alone, found.motion), e);
  solver::Linearisation mean = found.motion.small_motions;
  int count = 1;
  for (int m = 1; m < positions; ++m) {
    model::Model turned = held;
    for (model::Bearing& pad : turned.bearings)
      pad.film.grid = film::turned(pad.film.grid, static_cast<double>(m) / positions);
    const run::SteadyMotion motion = run::find_steady_motion(turned, journal_axes(), most_iterations);
    if (!motion.solved()) continue;
    const solver::Linearisation& other = motion.small_motions;
    mean.K += mean.Z.transpose() * over_coordinates(other, other.K) * mean.Z;
    mean.C += mean.Z.transpose() * over_coordinates(other, other.C) * mean.Z;
    ++count;
  }
  mean.K /= count, mean.C /= count;
  return mean;
}

void fill_state(const model::Composite& composite, const run::SteadyMotion& motion, const WholeFilm& whole,
                const PadBearingSolution& pads, bearing::SteadyState& state) {
  const auto& point = std::get<model::JournalPoint>(*composite.bearing.operating_point);
  state.kind = composite.bearing.kind;
  state.point.journal_speed = point.journal_speed;
  state.e = Eigen::Vector2d(joint_of(*composite.alone, motion, journal_joint).position.head<2>());
  state.film = whole.film;
  Eigen::Vector2d carried = Eigen::Vector2d::Zero();
  for (const PadState& pad : pads.pads) carried += pad.force;
  state.load = carried;
  if (point.load) {
    state.load = *point.load * Eigen::Vector2d(std::cos(point.load_angle), std::sin(point.load_angle));
    state.point.load = state.load;
  } else {
    state.point.e = state.e;
  }
}

}  // namespace

void solve_pads(const model::Composite& composite, BearingSolution& solution) {
  if (!composite.alone) throw InputError(composite.alone_faults);
  const auto began = std::chrono::steady_clock::now();
  const auto& point = std::get<model::JournalPoint>(*composite.bearing.operating_point);
  const PadMotion found = find_motion(composite, point);
  const run::SteadyMotion& motion = found.motion;
  solution.summary.iterations = motion.iterations;
  WholeFilm whole(composite.alone->bearings);
  solution.model = whole.model;
  if (!motion.solved()) return solution.fail(fmt::format("bearing {}: {}", composite.bearing.name, motion.message));
  whole.observe(motion, found.fixed_tilts);
  auto pads = std::make_shared<PadBearingSolution>();
  for (const std::size_t k : whole.order()) pads->pads.push_back(pad_state(composite, k, found));
  pads->fields = std::move(whole.fields);
  pads->whirl_ratio = composite.whirl_ratio;
  fill_state(composite, motion, whole, *pads, solution.state);
  const double omega = composite.whirl_ratio * std::abs(point.journal_speed);
  const solver::Linearisation small_motions = mean_small_motions(found);
  const solver::ReducedCoefficients reduced = reduce(small_motions, journal_coordinates(motion), omega);
  solution.state.coefficients = {reduced.K, reduced.C};
  pads->coordinates = motion.coordinates;
  pads->stiffness = over_coordinates(small_motions, small_motions.K);
  pads->damping = over_coordinates(small_motions, small_motions.C);
  pads->mass = over_coordinates(small_motions, small_motions.M);
  solution.numbers = bearing::bearing_numbers(solution.model, solution.state);
  solution.coefficients = bearing::in_load_axes(solution.model, solution.state);
  for (const PadState& pad : pads->pads)
    if (pad.is_aside)
      solution.warnings.push_back(
          fmt::format("bearing {}: nothing balances pad {}, which would rub or flutter (spragging): it stands aside, "
                      "tilted so that it carries {:.3g} N; preload, an offset pivot or a spring keeps it in place",
                      composite.bearing.name, pad.name, pad.force.norm()));
  for (std::size_t k = 0; k < composite.alone->bearings.size(); ++k) {
    const model::Bearing& pad = composite.alone->bearings[k];
    for (const std::string& warning :
         model::surface_warnings(pad, motion.bearings[k].film.p_max, motion.bearings[k].film.h_min))
      solution.warnings.push_back("bearing " + pad.name + ", " + warning);
  }
  solution.pads = std::move(pads);
  solution.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  solution.set_solved(true);
}

}  // namespace hersey::study
