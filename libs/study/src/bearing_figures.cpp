#include <cmath>
#include <limits>
#include <numbers>

#include "hersey/study/bearing_study.h"

namespace hersey::study {
namespace {

/// The unit that people use, its name in SI and its size there.
struct Unit {
  const char* name;
  const char* si;
  double size;
};
constexpr Unit kNone{"", "", 1}, kNewton{"N", "N", 1}, kNewtonMetre{"N.m", "N.m", 1}, kWatt{"W", "W", 1};
constexpr Unit kKilogram{"kg", "kg", 1}, kStiffness{"N/m", "N/m", 1}, kDamping{"N.s/m", "N.s/m", 1};
constexpr Unit kDegree{"deg", "rad", std::numbers::pi / 180}, kRpm{"rpm", "rad/s", std::numbers::pi / 30};
constexpr Unit kMillimetrePerSecond{"mm/s", "m/s", 1e-3};
constexpr Unit kMicrometre{"um", "m", 1e-6}, kMillimetre{"mm", "m", 1e-3}, kMegapascal{"MPa", "Pa", 1e6};
constexpr Unit kMicrometrePerMetre{"um/m", "1", 1e-6};
constexpr Unit kFlow{"mm^3/s", "m^3/s", 1e-9}, kVolume{"mm^3", "m^3", 1e-9};

// Collects figures in users' units.
class Figures {
 public:
  explicit Figures(bool has_errors) : has_errors_(has_errors) {}
  /// What is added from here on belongs to `name`.
  void group(std::string name) { group_ = std::move(name); }
  /// A value in SI.
  void add(std::string key, std::string name, const Unit& unit, double value) {
    list_.push_back({.key = std::move(key),
                     .name = std::move(name),
                     .unit = unit.name,
                     .si_unit = unit.si,
                     .si = unit.size,
                     .value = value / unit.size,
                     .grid_error = -1,
                     .words = {},
                     .group = group_});
  }
  /// A negative error is none.
  void add_with_error(std::string key, std::string name, const Unit& unit, double value, double error) {
    add(std::move(key), std::move(name), unit, value);
    if (has_errors_ && error >= 0) list_.back().grid_error = error / unit.size;
  }
  /// What there is no number of: words in its place, if any, and a value that is infinite or none.
  void say(const std::string& words) { list_.back().words = words; }
  [[nodiscard]] std::vector<BearingFigure> take() { return std::move(list_); }

 private:
  bool has_errors_;
  std::string group_;
  std::vector<BearingFigure> list_;
};

// What is zero by symmetry comes out as the round-off of its parts, which tells nothing.
double without_round_off(double value, double parts) { return std::abs(value) < 1e-12 * parts ? 0.0 : value; }

void add_state(const BearingSolution& s, Figures& figures) {
  const bearing::BearingNumbers& n = s.numbers;
  const bearing::GridError& error = s.grid_error;
  const film::FilmObservables& film = s.state.film;
  figures.group("operating point");
  figures.add("journal_speed", "journal speed", kRpm, s.state.point.journal_speed);
  figures.add("shell_speed", "shell speed", kRpm, s.state.point.shell_speed);
  // What is given has no error.
  const bool is_load_given = s.state.point.load.has_value();
  figures.add_with_error("load", "load", kNewton, n.load, is_load_given ? -1 : error.load);
  figures.add("load_angle", "direction of the load", kDegree, n.load_angle);
  figures.add_with_error("eccentricity_ratio", "eccentricity ratio", kNone, n.eccentricity_ratio,
                         is_load_given ? error.eccentricity_ratio : -1);
  figures.add("eccentricity_angle", "direction of the eccentricity", kDegree, n.eccentricity_angle);
  const bool squeezes = s.state.point.e_rate.norm() > 0;
  if (squeezes)
    figures.add("radial_velocity", "velocity along the eccentricity", kMillimetrePerSecond, s.numbers.radial_velocity);
  figures.add_with_error("attitude", "attitude angle", kDegree, n.attitude, error.attitude);
  figures.group("film");
  figures.add_with_error("h_min", "minimum film thickness", kMicrometre, film.h_min, error.h_min);
  figures.add("h_min_angle", "  at the angle", kDegree, film.h_min_phi);
  figures.add("h_min_z", "  at z", kMillimetre, without_round_off(film.h_min_z, s.model.L));
  figures.add("h_min_centre", "minimum film thickness at mid-width", kMicrometre, film.h_min_centre);
  if (std::isfinite(film.h_min_features))
    figures.add("h_min_features", "minimum thickness over features with depth", kMicrometre, film.h_min_features);
  figures.add_with_error("p_max", "peak film pressure", kMegapascal, film.p_max, error.p_max);
  figures.add("p_max_angle", "  at the angle", kDegree, film.p_max_phi);
  figures.add("p_max_z", "  at z", kMillimetre, without_round_off(film.p_max_z, s.model.L));
  const double moment = n.load * s.model.L;
  figures.add("moment_x", "moment on the shell, x", kNewtonMetre, without_round_off(film.wrench_on_shell[0], moment));
  figures.add("moment_y", "moment on the shell, y", kNewtonMetre, without_round_off(film.wrench_on_shell[1], moment));
}

/// Where a surface lies furthest off its rest, away from the axis (> 0) or towards it.
double largest_of(const Eigen::VectorXd& displacement) {
  Eigen::Index node = 0;
  displacement.cwiseAbs().maxCoeff(&node);
  return displacement[node];
}

void add_deformation(const BearingSolution& s, Figures& figures) {
  if (!s.elasticity) return;
  const bearing::SteadyState& state = s.state;
  figures.group("deformation");
  if (state.d_shell.size() > 0)
    figures.add("deformation_shell", "largest displacement of the shell, outward", kMicrometre,
                largest_of(state.d_shell));
  if (state.d_journal.size() > 0)
    figures.add("deformation_journal", "largest displacement of the journal, outward", kMicrometre,
                largest_of(state.d_journal));
  figures.add("tilt_x", "slope of the journal against the shell under load, x", kMicrometrePerMetre, state.tilt.x());
  figures.add("tilt_y", "slope of the journal against the shell under load, y", kMicrometrePerMetre, state.tilt.y());
  if (state.d_shell.size() > 0) figures.add("shell_turn", "turn of the bearing's axes under load", kDegree, state.turn);
}

void add_oil_and_friction(const BearingSolution& s, Figures& figures) {
  const bearing::BearingNumbers& n = s.numbers;
  const film::FilmObservables& film = s.state.film;
  figures.group("numbers");
  figures.add("sommerfeld_S", "Sommerfeld number S = mu N (R/c)^2 L D/W", kNone, n.sommerfeld_S);
  figures.add("sommerfeld_So", "Sommerfeld number So = W (c/R)^2/(L D mu omega)", kNone, n.sommerfeld_So);
  if (n.radial_velocity != 0)
    figures.add("sommerfeld_squeeze", "Sommerfeld number of squeeze W (c/R)^2/(L D mu d(eps)/dt)", kNone,
                n.sommerfeld_squeeze);
  figures.add("hersey", "Hersey number mu N L D/W", kNone, n.hersey);
  figures.group("friction");
  figures.add_with_error("friction_journal", "friction coefficient, journal", kNone, n.friction_journal,
                         s.grid_error.friction_journal);
  figures.add("friction_shell", "friction coefficient, shell", kNone, n.friction_shell);
  figures.add("torque_journal", "friction torque on the journal", kNewtonMetre, film.torque_journal);
  figures.add("torque_shell", "friction torque on the shell", kNewtonMetre, film.torque_shell);
  figures.add("power_film", "friction power, film", kWatt, film.power_film);
  figures.add("power_asperity", "friction power, asperities", kWatt, film.power_asperity);
  // The bearing's axes rest: power comes through the torques, and through the load where the journal gives way to it.
  const double put_in = -film.torque_journal * s.state.point.journal_speed -
                        film.torque_shell * s.state.point.shell_speed + s.state.load.dot(s.state.point.e_rate);
  figures.add("power_put_in", "power put in by torques and load", kWatt, put_in);
  if (film.power_taken() > 0)
    figures.add("power_error", "  of it not explained by the film's integrals", kNone, put_in / film.power_taken() - 1);
  figures.add("asperity_share", "share of the load on asperities", kNone, n.asperity_share);
  figures.add("film_ratio", "film ratio h_min/sigma", kNone, n.film_ratio);
  figures.group("oil");
  figures.add_with_error("side_flow", "side flow", kFlow, film.flow_left + film.flow_right, s.grid_error.side_flow);
  figures.add("flow_left", "flow over the edge z < 0", kFlow, film.flow_left);
  figures.add("flow_right", "flow over the edge z > 0", kFlow, film.flow_right);
  figures.add("flow_supply", "flow through the supply", kFlow, film.flow_supply);
  for (Eigen::Index f = 0; f < film.flow_features.size(); ++f) {
    const std::string& name = s.model.features[static_cast<std::size_t>(f)].name;
    figures.add("flow_feature_" + name, "  through " + name, kFlow, film.flow_features[f]);
  }
  figures.add("oil_volume", "oil in the bearing", kVolume, film.oil_volume);
  // Reynolds' condition lets oil vanish where the film breaks and appear where it forms again: what is missing there is
  // no error of the solution.
  const bool conserves = !film::cavitation_law(s.model).loses_oil();
  figures.add("mass_balance_error", "mass balance error", kNone,
              conserves ? film.mass_balance_error : std::numeric_limits<double>::quiet_NaN());
  if (!conserves) figures.say("oil is not conserved by reynolds");
  figures.add("cavitated_share", "cavitated share of the area", kNone, film.cavitated_share);
  if (std::isfinite(film.rupture_angle)) {
    figures.add("rupture_angle", "the film ruptures at mid-width at", kDegree, film.rupture_angle);
    figures.add("reformation_angle", "  and re-forms at", kDegree, film.reformation_angle);
  }
}

void add_matrix(const std::string& key, const std::string& name, const Unit& unit, const Eigen::Matrix2d& M,
                Figures& figures) {
  const char* axes = "xy";
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      const std::string index{axes[i], axes[j]};
      figures.add(key + "_" + index, name + " " + index, unit, M(i, j));
    }
  }
}

// Numbers of a threshold that is not there are words.
void add_stability(const bearing::WhirlStability& whirl, Figures& figures) {
  figures.group("stability");
  figures.add("critical_mass", "critical mass of a rigid rotor", kKilogram, whirl.critical_mass);
  if (whirl.always_stable) figures.say("none: stable at every mass");
  if (whirl.never_stable) figures.say("none: unstable at every mass");
  figures.add("whirl_ratio", "whirl frequency ratio", kNone, whirl.whirl_ratio);
  if (whirl.always_stable) figures.say("no whirl");
  figures.add("stability_number", "omega sqrt(c/g) at the threshold", kNone, whirl.stability_number);
  if (whirl.always_stable) figures.say("no threshold");
  figures.add("threshold_speed", "threshold speed under the load's own weight", kRpm, whirl.threshold_speed);
  if (whirl.always_stable) figures.say("none: stable at every speed");
}

void add_dynamics(const BearingSolution& s, Figures& figures) {
  const bearing::DynamicCoefficients& all = s.state.coefficients;
  figures.group("stiffness and damping");
  add_matrix("stiffness", "stiffness, bearing axes,", kStiffness, all.stiffness.topLeftCorner<2, 2>(), figures);
  add_matrix("damping", "damping, bearing axes,", kDamping, all.damping.topLeftCorner<2, 2>(), figures);
  add_matrix("K", "K = k c/W, x along the load,", kNone, s.coefficients.K, figures);
  add_matrix("C", "C = b c omega/W, x along the load,", kNone, s.coefficients.C, figures);
  add_stability(s.whirl, figures);
}

}  // namespace

std::vector<BearingFigure> figures_of(const BearingSolution& solution) {
  Figures figures(solution.grid_error.known);
  add_state(solution, figures);
  add_deformation(solution, figures);
  add_oil_and_friction(solution, figures);
  add_dynamics(solution, figures);
  return figures.take();
}

}  // namespace hersey::study
