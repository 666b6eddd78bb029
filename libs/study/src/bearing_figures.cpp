#include <cmath>
#include <numbers>

#include "hersey/study/bearing_study.h"

namespace hersey::study {
namespace {

constexpr double kDegree = std::numbers::pi / 180, kMicro = 1e-6, kMega = 1e6;
constexpr double kRpm = std::numbers::pi / 30, kCubicMillimetrePerSecond = 1e-9;

// Collects figures in users' units.
class Figures {
 public:
  explicit Figures(bool has_errors) : has_errors_(has_errors) {}
  /// What is added from here on belongs to `name`.
  void group(std::string name) { group_ = std::move(name); }
  /// A negative error is none.
  void add(std::string key, std::string name, std::string unit, double value, double scale = 1) {
    list_.push_back({std::move(key), std::move(name), std::move(unit), value / scale, -1, group_});
  }
  void add_with_error(std::string key, std::string name, std::string unit, double value, double error,
                      double scale = 1) {
    add(std::move(key), std::move(name), std::move(unit), value, scale);
    if (has_errors_ && error >= 0) list_.back().grid_error = error / scale;
  }
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
  figures.add("journal_speed", "journal speed", "rpm", s.state.point.journal_speed, kRpm);
  figures.add("shell_speed", "shell speed", "rpm", s.state.point.shell_speed, kRpm);
  // What is given has no error.
  const bool is_load_given = s.state.point.load.has_value();
  figures.add_with_error("load", "load", "N", n.load, is_load_given ? -1 : error.load);
  figures.add("load_angle", "direction of the load", "deg", n.load_angle, kDegree);
  figures.add_with_error("eccentricity_ratio", "eccentricity ratio", "", n.eccentricity_ratio,
                         is_load_given ? error.eccentricity_ratio : -1);
  figures.add("eccentricity_angle", "direction of the eccentricity", "deg", n.eccentricity_angle, kDegree);
  const bool squeezes = s.state.point.e_rate.norm() > 0;
  if (squeezes)
    figures.add("radial_velocity", "velocity along the eccentricity", "mm/s", s.numbers.radial_velocity, 1e-3);
  figures.add_with_error("attitude", "attitude angle", "deg", n.attitude, error.attitude, kDegree);
  figures.group("film");
  figures.add_with_error("h_min", "minimum film thickness", "um", film.h_min, error.h_min, kMicro);
  figures.add("h_min_angle", "  at the angle", "deg", film.h_min_phi, kDegree);
  figures.add("h_min_z", "  at z", "mm", without_round_off(film.h_min_z, s.model.L), 1e-3);
  figures.add("h_min_centre", "minimum film thickness at mid-width", "um", film.h_min_centre, kMicro);
  if (std::isfinite(film.h_min_features))
    figures.add("h_min_features", "minimum thickness over features with depth", "um", film.h_min_features, kMicro);
  figures.add_with_error("p_max", "peak film pressure", "MPa", film.p_max, error.p_max, kMega);
  figures.add("p_max_angle", "  at the angle", "deg", film.p_max_phi, kDegree);
  figures.add("p_max_z", "  at z", "mm", without_round_off(film.p_max_z, s.model.L), 1e-3);
  const double moment = n.load * s.model.L;
  figures.add("moment_x", "moment on the shell, x", "N.m", without_round_off(film.wrench_on_shell[0], moment));
  figures.add("moment_y", "moment on the shell, y", "N.m", without_round_off(film.wrench_on_shell[1], moment));
}

void add_oil_and_friction(const BearingSolution& s, Figures& figures) {
  const bearing::BearingNumbers& n = s.numbers;
  const film::FilmObservables& film = s.state.film;
  figures.group("numbers");
  figures.add("sommerfeld_S", "Sommerfeld number S = mu N (R/c)^2 L D/W", "", n.sommerfeld_S);
  figures.add("sommerfeld_So", "Sommerfeld number So = W (c/R)^2/(L D mu omega)", "", n.sommerfeld_So);
  if (n.radial_velocity != 0)
    figures.add("sommerfeld_squeeze", "Sommerfeld number of squeeze W (c/R)^2/(L D mu d(eps)/dt)", "",
                n.sommerfeld_squeeze);
  figures.add("hersey", "Hersey number mu N L D/W", "", n.hersey);
  figures.group("friction");
  figures.add_with_error("friction_journal", "friction coefficient, journal", "", n.friction_journal,
                         s.grid_error.friction_journal);
  figures.add("friction_shell", "friction coefficient, shell", "", n.friction_shell);
  figures.add("torque_journal", "friction torque on the journal", "N.m", film.torque_journal);
  figures.add("torque_shell", "friction torque on the shell", "N.m", film.torque_shell);
  figures.add("power_film", "friction power, film", "W", film.power_film);
  figures.add("power_asperity", "friction power, asperities", "W", film.power_asperity);
  // The bearing's axes rest: power comes through the torques, and through the load where the journal gives way to it.
  const double put_in = -film.torque_journal * s.state.point.journal_speed -
                        film.torque_shell * s.state.point.shell_speed + s.state.load.dot(s.state.point.e_rate);
  figures.add("power_put_in", "power put in by torques and load", "W", put_in);
  if (film.power_taken() > 0)
    figures.add("power_error", "  of it not explained by the film's integrals", "", put_in / film.power_taken() - 1);
  figures.add("asperity_share", "share of the load on asperities", "", n.asperity_share);
  figures.add("film_ratio", "film ratio h_min/sigma", "", n.film_ratio);
  figures.group("oil");
  figures.add_with_error("side_flow", "side flow", "mm^3/s", film.flow_left + film.flow_right, s.grid_error.side_flow,
                         kCubicMillimetrePerSecond);
  figures.add("flow_left", "flow over the edge z < 0", "mm^3/s", film.flow_left, kCubicMillimetrePerSecond);
  figures.add("flow_right", "flow over the edge z > 0", "mm^3/s", film.flow_right, kCubicMillimetrePerSecond);
  figures.add("flow_supply", "flow through the supply", "mm^3/s", film.flow_supply, kCubicMillimetrePerSecond);
  for (Eigen::Index f = 0; f < film.flow_features.size(); ++f) {
    const std::string& name = s.model.features[static_cast<std::size_t>(f)].name;
    figures.add("flow_feature_" + name, "  through " + name, "mm^3/s", film.flow_features[f],
                kCubicMillimetrePerSecond);
  }
  figures.add("oil_volume", "oil in the bearing", "mm^3", film.oil_volume, 1e-9);
  figures.add("mass_balance_error", "mass balance error", "", film.mass_balance_error);
  figures.add("cavitated_share", "cavitated share of the area", "", film.cavitated_share);
  if (std::isfinite(film.rupture_angle)) {
    figures.add("rupture_angle", "the film ruptures at mid-width at", "deg", film.rupture_angle, kDegree);
    figures.add("reformation_angle", "  and re-forms at", "deg", film.reformation_angle, kDegree);
  }
}

void add_matrix(const std::string& key, const std::string& name, const std::string& unit, const Eigen::Matrix2d& M,
                Figures& figures) {
  const char* axes = "xy";
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      const std::string index{axes[i], axes[j]};
      figures.add(key + "_" + index, name + " " + index, unit, M(i, j));
    }
  }
}

void add_dynamics(const BearingSolution& s, Figures& figures) {
  const bearing::DynamicCoefficients& all = s.state.coefficients;
  figures.group("stiffness and damping");
  add_matrix("stiffness", "stiffness, bearing axes,", "N/m", all.stiffness.topLeftCorner<2, 2>(), figures);
  add_matrix("damping", "damping, bearing axes,", "N.s/m", all.damping.topLeftCorner<2, 2>(), figures);
  add_matrix("K", "K = k c/W, x along the load,", "", s.coefficients.K, figures);
  add_matrix("C", "C = b c omega/W, x along the load,", "", s.coefficients.C, figures);
  figures.group("stability");
  figures.add("critical_mass", "critical mass of a rigid rotor", "kg", s.whirl.critical_mass);
  figures.add("whirl_ratio", "whirl frequency ratio", "", s.whirl.whirl_ratio);
  figures.add("stability_number", "omega sqrt(c/g) at the threshold", "", s.whirl.stability_number);
  figures.add("threshold_speed", "threshold speed under the load's own weight", "rpm", s.whirl.threshold_speed, kRpm);
}

}  // namespace

std::vector<BearingFigure> figures_of(const BearingSolution& solution) {
  Figures figures(solution.grid_error.known);
  add_state(solution, figures);
  add_oil_and_friction(solution, figures);
  add_dynamics(solution, figures);
  return figures.take();
}

}  // namespace hersey::study
