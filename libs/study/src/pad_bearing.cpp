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
#include "hersey/core/two_pi.h"
#include "hersey/model/plausibility.h"
#include "hersey/run/steady_motion.h"
#include "hersey/solver/reduced_coefficients.h"

namespace hersey::study {
namespace {

constexpr const char* journal_joint = "journal";

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
  void observe(const run::SteadyMotion& motion) {
    film.h_min = film.h_min_centre = std::numeric_limits<double>::infinity();
    film.h_min_features = film.rupture_angle = film.reformation_angle = std::numeric_limits<double>::quiet_NaN();
    film.force_pressure.setZero(), film.force_shear.setZero(), film.force_asperity.setZero();
    for (const std::size_t k : order_) {
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

  void add_figures(const film::FilmObservables& pad, const film::Grid& grid) {
    if (pad.h_min < film.h_min) film.h_min = pad.h_min, film.h_min_phi = pad.h_min_phi, film.h_min_z = pad.h_min_z;
    film.h_min_centre = std::min(film.h_min_centre, pad.h_min_centre);
    if (pad.p_max > film.p_max) film.p_max = pad.p_max, film.p_max_phi = pad.p_max_phi, film.p_max_z = pad.p_max_z;
    film.p_max_node = std::max(film.p_max_node, pad.p_max_node);
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
    film.cavitated_share += pad.cavitated_share * (grid.phi(grid.n_phi - 1) - grid.phi(0)) / angle_of_pads();
  }

  void add_fields(const film::FilmFields& pad) {
    for (const auto field :
         {&film::FilmFields::p, &film::FilmFields::theta, &film::FilmFields::density, &film::FilmFields::h,
          &film::FilmFields::depth, &film::FilmFields::w, &film::FilmFields::p_asperity, &film::FilmFields::T,
          &film::FilmFields::T_shell, &film::FilmFields::T_journal, &film::FilmFields::T_hottest})
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

/// Rotation of a pad about the axis along the bearing, whatever its pivot allows.
double tilt_of(const mbd::JointObservation& pivot) { return pivot.position[pivot.position.size() - 1]; }

PadState pad_state(const model::Composite& composite, std::size_t k, const run::SteadyMotion& motion) {
  const model::Model& alone = *composite.alone;
  PadState pad{.name = fmt::format("{}", k + 1), .pivot_angle = composite.pivot_angles[k]};
  pad.tilt = tilt_of(joint_of(alone, motion, composite.pads[k] + "_pivot"));
  if (const std::string travel = composite.pads[k] + "_travel"; has_joint(alone, travel))
    pad.pivot_travel = joint_of(alone, motion, travel).position[0];
  const Eigen::Rotation2Dd turned(pad.tilt);
  pad.force = turned * Eigen::Vector2d(motion.bearings[k].wrench_on_shell.segment<2>(3));
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

/// Names of the coordinates of the journal's centre.
std::vector<std::string> journal_axes() {
  return {fmt::format("joint {}, x", journal_joint), fmt::format("joint {}, y", journal_joint)};
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
  const auto began = std::chrono::steady_clock::now();
  const auto& point = std::get<model::JournalPoint>(*composite.bearing.operating_point);
  const run::SteadyMotion motion =
      run::find_steady_motion(*composite.alone, point.load ? std::vector<std::string>{} : journal_axes());
  solution.summary.iterations = motion.iterations;
  WholeFilm whole(composite.alone->bearings);
  solution.model = whole.model;
  if (!motion.solved()) return solution.fail(fmt::format("bearing {}: {}", composite.bearing.name, motion.message));
  whole.observe(motion);
  auto pads = std::make_shared<PadBearingSolution>();
  for (const std::size_t k : whole.order()) pads->pads.push_back(pad_state(composite, k, motion));
  pads->fields = std::move(whole.fields);
  pads->whirl_ratio = composite.whirl_ratio;
  fill_state(composite, motion, whole, *pads, solution.state);
  const double omega = composite.whirl_ratio * std::abs(point.journal_speed);
  const solver::ReducedCoefficients reduced = reduce(motion.small_motions, journal_coordinates(motion), omega);
  solution.state.coefficients = {reduced.K, reduced.C};
  pads->coordinates = motion.coordinates;
  const Eigen::MatrixXd& Z = motion.small_motions.Z;
  pads->stiffness = Z * motion.small_motions.K * Z.transpose();
  pads->damping = Z * motion.small_motions.C * Z.transpose();
  pads->mass = Z * motion.small_motions.M * Z.transpose();
  solution.numbers = bearing::bearing_numbers(solution.model, solution.state);
  solution.coefficients = bearing::in_load_axes(solution.model, solution.state);
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
