#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "figure_table.h"
#include "hersey/bearing/clearance.h"
#include "hersey/study/bearing_study.h"
#include "hersey/study/shear_remarks.h"

namespace hersey::study {
namespace {

Group operating_point() {
  using Number = bearing::BearingNumbers;
  using Error = bearing::GridError;
  // What is given has no error.
  const auto ratio_error = [](const Solution& s) { return is_load_given(s) ? s.grid_error.eccentricity_ratio : -1; };
  return {"operating point",
          {{"journal_speed", kRpm, point(&bearing::OperatingPoint::journal_speed)},
           {"shell_speed", kRpm, point(&bearing::OperatingPoint::shell_speed)},
           {"load", kNewton, numbers(&Number::load), {.grid_error = load_error}},
           {"load_angle", kDegree, numbers(&Number::load_angle)},
           {"eccentricity_ratio", kNone, numbers(&Number::eccentricity_ratio), {.grid_error = ratio_error}},
           {"eccentricity_angle", kDegree, numbers(&Number::eccentricity_angle)},
           {"clearance_cold",
            kMicrometre,
            [](const Solution& s) { return bearing::clearance(s.model); },
            {.only = [](const Solution& s) { return s.expands; }}},
           {"clearance_hot",
            kMicrometre,
            [](const Solution& s) { return bearing::clearance(s.model, s.state.point); },
            {.only = [](const Solution& s) { return s.expands; }}},
           {"radial_velocity", kMillimetrePerSecond, numbers(&Number::radial_velocity), {.only = squeezes}},
           {"attitude", kDegree, numbers(&Number::attitude), {.grid_error = error_of(&Error::attitude)}}}};
}

Group film_figures() {
  using Film = film::FilmObservables;
  using Error = bearing::GridError;
  return {"film",
          {{"h_min", kMicrometre, film(&Film::h_min), {.grid_error = error_of(&Error::h_min)}},
           {"h_min_angle", "  at the angle", kDegree, film(&Film::h_min_phi)},
           {"h_min_z", "  at z", kMillimetre, height(&Film::h_min_z)},
           {"h_min_centre", kMicrometre, film(&Film::h_min_centre)},
           minimum_thickness_over_features(),
           {"p_max", kMegapascal, film(&Film::p_max), {.grid_error = error_of(&Error::p_max)}},
           {"p_max_angle", "  at the angle", kDegree, film(&Film::p_max_phi)},
           {"p_max_z", "  at z", kMillimetre, height(&Film::p_max_z)},
           {"moment_x", kNewtonMetre, moment(0)},
           {"moment_y", kNewtonMetre, moment(1)}}};
}

/// Where a surface lies furthest off its rest, away from the axis (> 0) or towards it.
double largest_of(const Eigen::VectorXd& displacement) {
  Eigen::Index node = 0;
  displacement.cwiseAbs().maxCoeff(&node);
  return displacement[node];
}

Group deformation() {
  const auto is_elastic = [](const Solution& s) { return s.elasticity != nullptr; };
  const auto shell = [](const Solution& s) { return s.elasticity != nullptr && s.state.d_shell.size() > 0; };
  const auto journal = [](const Solution& s) { return s.elasticity != nullptr && s.state.d_journal.size() > 0; };
  return {"deformation",
          {{"deformation_shell",
            kMicrometre,
            [](const Solution& s) { return largest_of(s.state.d_shell); },
            {.only = shell}},
           {"deformation_journal",
            kMicrometre,
            [](const Solution& s) { return largest_of(s.state.d_journal); },
            {.only = journal}},
           {"tilt_x", kMicrometrePerMetre, [](const Solution& s) { return s.state.tilt.x(); }, {.only = is_elastic}},
           {"tilt_y", kMicrometrePerMetre, [](const Solution& s) { return s.state.tilt.y(); }, {.only = is_elastic}},
           {"shell_turn", kDegree, [](const Solution& s) { return s.state.turn; }, {.only = shell}}}};
}

Group dimensionless() {
  using Number = bearing::BearingNumbers;
  return {"numbers",
          {{"sommerfeld_S", kNone, numbers(&Number::sommerfeld_S)},
           {"sommerfeld_So", kNone, numbers(&Number::sommerfeld_So)},
           {"sommerfeld_squeeze",
            kNone,
            numbers(&Number::sommerfeld_squeeze),
            {.only = [](const Solution& s) { return s.numbers.radial_velocity != 0; }}},
           {"hersey", "Hersey number mu N L D/W", kNone, numbers(&Number::hersey)}}};
}

/// The bearing's axes rest: power enters through the torques, and through the load if the journal's support deforms.
double power_put_in(const Solution& s) {
  const film::FilmObservables& film = s.state.film;
  return -film.torque_journal * s.state.point.journal_speed - film.torque_shell * s.state.point.shell_speed +
         s.state.load.dot(s.state.point.e_rate);
}

Group friction() {
  const auto is_rough = [](const Solution& s) { return s.numbers.film_ratio > 0; };
  using Film = film::FilmObservables;
  using Number = bearing::BearingNumbers;
  return {
      "friction",
      {{"friction_journal",
        kNone,
        numbers(&Number::friction_journal),
        {.grid_error = error_of(&bearing::GridError::friction_journal)}},
       {"friction_shell", kNone, numbers(&Number::friction_shell)},
       {"torque_journal",
        kNewtonMetre,
        film(&Film::torque_journal),
        {.grid_error = error_of(&bearing::GridError::torque_journal)}},
       {"torque_shell",
        kNewtonMetre,
        film(&Film::torque_shell),
        {.grid_error = error_of(&bearing::GridError::torque_shell)}},
       {"power_film", kWatt, film(&Film::power_film), {.grid_error = error_of(&bearing::GridError::power_film)}},
       {"torque_journal_other_shear", kNewtonMetre, film(&Film::torque_journal_other_shear), {.only = shears_differ}},
       {"power_film_other_shear", kWatt, film(&Film::power_film_other_shear), {.only = shears_differ}},
       {"load_on_shear", kNone, load_on_shear},
       {"power_asperity", kWatt, film(&Film::power_asperity)},
       {"power_put_in", "power put in by torques and load", kWatt, power_put_in},
       power_not_explained(power_put_in),
       {"asperity_share", kNone, numbers(&Number::asperity_share)},
       {"film_ratio", kNone, numbers(&Number::film_ratio), {.only = is_rough}}}};
}

Group oil() {
  using Film = film::FilmObservables;
  return {"oil",
          {{"side_flow",
            "side flow",
            kFlow,
            film(&Film::flow_sides),
            {.grid_error = error_of(&bearing::GridError::side_flow)}},
           {"flow_left", kFlow, film(&Film::flow_left)},
           {"flow_right", kFlow, film(&Film::flow_right)},
           {"flow_leading", kFlow, film(&Film::flow_first), {.only = has_arcs}},
           {"flow_trailing", kFlow, film(&Film::flow_last), {.only = has_arcs}},
           {"flow_supply", kFlow, film(&Film::flow_supply)},
           flow_through_features(),
           {"oil_volume", kVolume, film(&Film::oil_volume)},
           mass_balance_error(),
           {"cavitated_share", kNone, film(&Film::cavitated_share)},
           {"rupture_angle", kDegree, film(&Film::rupture_angle), {.only = ruptures}},
           {"reformation_angle", "  and re-forms at", kDegree, film(&Film::reformation_angle), {.only = ruptures}}}};
}

/// Names of HeatObservables::T_supplies.
std::vector<std::string> supply_names(const Solution& s) {
  std::vector<std::string> names;
  if (s.model.supply.kind != film::SupplyKind::none) names.emplace_back("line");
  for (const film::SurfaceFeature& feature : s.model.features) names.push_back(feature.name);
  return names;
}

bool is_in_body(const Solution& s) { return s.state.heat && s.state.heat->T_body.size() > 0; }

bool has_thermal_shape(const Solution& s) { return s.state.shapes.thermal_shell.size() > 0; }

/// Radial growth of the shell's surface by temperature: its mean over the nodes, and the largest deviation from it.
double growth(const Solution& s) { return s.state.shapes.thermal_shell.mean(); }

double distortion(const Solution& s) { return (s.state.shapes.thermal_shell.array() - growth(s)).abs().maxCoeff(); }

/// True if the journal's wall is a body.
bool journal_is_in_body(const Solution& s) { return s.state.heat && s.state.heat->T_journal_body.size() > 0; }

bool has_journal_shape(const Solution& s) { return s.state.shapes.thermal_journal.size() > 0; }

double journal_growth(const Solution& s) { return s.state.shapes.thermal_journal.mean(); }

double journal_distortion(const Solution& s) {
  return (s.state.shapes.thermal_journal.array() - journal_growth(s)).abs().maxCoeff();
}

/// With both (thermal.64), the mean along.
double clearance_of_bodies(const Solution& s) {
  double c = bearing::clearance(s.model, s.state.point);
  if (has_thermal_shape(s)) c += growth(s);
  if (has_journal_shape(s)) c -= journal_growth(s);
  return c;
}

Group heat() {
  using Heat = film::HeatObservables;
  using Balance = film::HeatBalance;
  const auto has_heat = [](const Solution& s) { return s.state.heat.has_value(); };
  const auto has_one = [](const Solution& s) { return s.state.effective.has_value(); };
  const auto celsius = [](double Heat::*T) {
    return [T](const Solution& s) { return s.state.heat->observed.*T - film::zero_celsius; };
  };
  const auto of_heat = [](double Heat::*member) {
    return [member](const Solution& s) { return s.state.heat->observed.*member; };
  };
  const auto balance = [](double Balance::*member) {
    return [member](const Solution& s) {
      const Balance& b = s.state.heat->observed.balance;
      return without_round_off(b.*member, b.power);
    };
  };
  return {"heat",
          {{"T_effective",
            kCelsius,
            [](const Solution& s) { return s.state.effective->T - film::zero_celsius; },
            {.only = has_one}},
           {"T_out",
            kCelsius,
            [](const Solution& s) { return s.state.effective->T_out - film::zero_celsius; },
            {.only = has_one}},
           {"T_max",
            kCelsius,
            celsius(&Heat::T_max),
            {.grid_error = error_of(&bearing::GridError::T_max), .only = has_heat}},
           {"T_max_angle", "  at the angle", kDegree, of_heat(&Heat::T_max_phi), {.only = has_heat}},
           {"T_max_z", "  at z", kMillimetre, of_heat(&Heat::T_max_z), {.only = has_heat}},
           {"T_shell_max",
            kCelsius,
            celsius(&Heat::T_shell_max),
            {.grid_error = error_of(&bearing::GridError::T_shell_max), .only = has_heat}},
           {"T_shell_max_angle", "  at the angle", kDegree, of_heat(&Heat::T_shell_max_phi), {.only = has_heat}},
           {"T_shell_mean",
            kCelsius,
            celsius(&Heat::T_shell_mean),
            {.grid_error = error_of(&bearing::GridError::T_shell_mean), .only = has_heat}},
           {"T_body_max", kCelsius, celsius(&Heat::T_body_max), {.only = is_in_body}},
           {"bore_growth", kMicrometre, growth, {.only = has_thermal_shape}},
           {"bore_distortion",
            "  largest deviation from it, around and along",
            kMicrometre,
            distortion,
            {.only = has_thermal_shape}},
           {"T_journal",
            kCelsius,
            celsius(&Heat::T_journal),
            {.grid_error = error_of(&bearing::GridError::T_journal), .only = has_heat}},
           {"T_journal_body_max", kCelsius, celsius(&Heat::T_journal_body_max), {.only = journal_is_in_body}},
           {"journal_growth", kMicrometre, journal_growth, {.only = has_journal_shape}},
           {"journal_distortion",
            "  largest deviation from it, along",
            kMicrometre,
            journal_distortion,
            {.only = has_journal_shape}},
           {"clearance_of_bodies",
            kMicrometre,
            clearance_of_bodies,
            {.only = [](const Solution& s) { return has_thermal_shape(s) || has_journal_shape(s); }}},
           {"T_film",
            kCelsius,
            celsius(&Heat::T_film_mean),
            {.grid_error = error_of(&bearing::GridError::T_film), .only = has_heat}},
           {"T_side",
            kCelsius,
            celsius(&Heat::T_side),
            {.grid_error = error_of(&bearing::GridError::T_side), .only = has_heat}},
           {"T_supply_<name>",
            kCelsius,
            [](const Solution& s, std::size_t k) {
              return s.state.heat->observed.T_supplies[static_cast<Eigen::Index>(k)] - film::zero_celsius;
            },
            {.only = has_heat, .each = supply_names}},
           {"heat_dissipated", kWatt, balance(&Balance::power), {.only = has_heat}},
           {"heat_to_oil", "  carried away by the oil", kWatt, balance(&Balance::to_oil), {.only = has_heat}},
           {"heat_to_shell", "  into the shell", kWatt, balance(&Balance::to_shell), {.only = has_heat}},
           {"heat_to_journal", "  into the journal", kWatt, balance(&Balance::to_journal), {.only = has_heat}},
           {"heat_balance_error",
            "  error of the balance of heat",
            kNone,
            [](const Solution& s) { return s.state.heat->observed.balance.error(); },
            {.only = has_heat}},
           {"T_node_<name>",
            kCelsius,
            [](const Solution& s, std::size_t k) {
              return s.state.heat->network.T[static_cast<Eigen::Index>(k)] - film::zero_celsius;
            },
            {.each = [](const Solution& s) { return s.node_names; }}},
           {"network_balance_error",
            "  error of the balance of heat of these bodies",
            kNone,
            [](const Solution& s) { return s.state.heat->network.error(); },
            {.only = [](const Solution& s) { return !s.node_names.empty(); }}}}};
}

/// The four entries of a matrix over x and y, row by row.
/// @param get  the matrix of a solution
/// @param error  its grid error
template <class Get, class Error>
Line matrix(std::string_view key, const Unit& unit, Get get, Error error) {
  const auto entry = [](const Eigen::Matrix2d& of, std::size_t k) {
    return of(static_cast<Eigen::Index>(k / 2), static_cast<Eigen::Index>(k % 2));
  };
  return {key,
          unit,
          [get, entry](const Solution& s, std::size_t k) { return entry(get(s), k); },
          {.each =
               [](const Solution& /*s*/) {
                 return std::vector<std::string>{"xx", "xy", "yx", "yy"};
               },
           .grid_error_of = [error, entry](const Solution& s, std::size_t k) { return entry(error(s), k); }}};
}

Group dynamics() {
  using Matrix = Eigen::Matrix2d;
  return {"stiffness and damping",
          {matrix(
               "stiffness_<ij>", kStiffness,
               [](const Solution& s) -> Matrix { return s.state.coefficients.stiffness.topLeftCorner<2, 2>(); },
               [](const Solution& s) { return s.grid_error.stiffness; }),
           matrix(
               "damping_<ij>", kDamping,
               [](const Solution& s) -> Matrix { return s.state.coefficients.damping.topLeftCorner<2, 2>(); },
               [](const Solution& s) { return s.grid_error.damping; }),
           matrix(
               "K_<ij>", kNone, [](const Solution& s) -> Matrix { return s.coefficients.K; },
               [](const Solution& s) { return s.grid_error.in_load_axes.K; }),
           matrix(
               "C_<ij>", kNone, [](const Solution& s) -> Matrix { return s.coefficients.C; },
               [](const Solution& s) { return s.grid_error.in_load_axes.C; })}};
}

/// Numbers of a threshold that is not there are words.
Group stability() {
  using Whirl = bearing::WhirlStability;
  const auto if_stable = [](const char* words) {
    return [words](const Solution& s) -> std::string { return s.whirl.always_stable ? words : ""; };
  };
  const auto of_mass = [](const Solution& s) -> std::string {
    if (s.whirl.never_stable) return "none: unstable at every mass";
    return s.whirl.always_stable ? "none: stable at every mass" : "";
  };
  return {
      "stability",
      {{"critical_mass", kKilogram, whirl(&Whirl::critical_mass), {.words = of_mass}},
       {"whirl_ratio", kNone, whirl(&Whirl::whirl_ratio), {.words = if_stable("no whirl")}},
       {"stability_number", kNone, whirl(&Whirl::stability_number), {.words = if_stable("no threshold")}},
       {"threshold_speed", kRpm, whirl(&Whirl::threshold_speed), {.words = if_stable("none: stable at every speed")}}}};
}

/// The table of a journal bearing's figures, in the order in which they are reported.
const std::vector<Group>& journal_table() {
  static const std::vector<Group> groups{operating_point(),
                                         film_figures(),
                                         arc_figures(),
                                         deformation(),
                                         with(dimensionless(), regime_of_flow()),
                                         friction(),
                                         with(oil(), restricted_feeds()),
                                         heat(),
                                         dynamics(),
                                         stability()};
  return groups;
}

const std::vector<Group>& tilting_pad_table() {
  static const std::vector<Group> groups{operating_point(),
                                         film_figures(),
                                         arc_figures(),
                                         pad_figures(),
                                         dimensionless(),
                                         friction(),
                                         with(oil(), restricted_feeds()),
                                         heat(),
                                         dynamics()};
  return groups;
}

const std::vector<Group>& ring_table() {
  static const std::vector<Group> groups = [] {
    std::vector<Group> all = ring_figures();
    all.push_back(dynamics());
    for (int k = 0; k < 2; ++k) all.back().lines.pop_back();  // those without a dimension
    return all;
  }();
  return groups;
}

/// Tables by the name of the kind. A new kind is a line here, and a file with its table beside this one.
const std::vector<std::pair<std::string, std::vector<Group>>>& tables() {
  static const std::vector<std::pair<std::string, std::vector<Group>>> all{
      {"journal", journal_table()},         {"plane_slider", plane_slider_figures()},
      {"thrust", thrust_figures()},         {"squeeze_film_damper", squeeze_film_damper_figures()},
      {"tilting_pad", tilting_pad_table()}, {"tilting_pad_thrust", thrust_pad_figures()},
      {"floating_ring", ring_table()},      {"skirt", skirt_figures()}};
  return all;
}

const std::vector<Group>& table_of(const BearingSolution& solution) {
  const std::string kind = kind_of(solution);
  const auto found =
      std::find_if(tables().begin(), tables().end(), [&](const auto& entry) { return entry.first == kind; });
  HERSEY_REQUIRE(found != tables().end(), "every kind of bearing has a table of figures");
  return found->second;
}

/// Returns `pattern` with `name` in place of the part in angle brackets.
std::string filled_in(std::string_view pattern, const std::string& name) {
  const std::string text(pattern);
  const std::size_t from = text.find('<'), to = text.find('>');
  return name.empty() || from == std::string::npos ? text : text.substr(0, from) + name + text.substr(to + 1);
}

}  // namespace

std::string kind_of(const BearingSolution& solution) {
  if (solution.pads) return solution.pads->kind;
  return solution.state.kind ? solution.state.kind->name() : "";
}

std::vector<std::string> figure_keys(const std::string& kind) {
  std::vector<std::string> keys;
  for (const auto& [name, table] : tables()) {
    if (!kind.empty() && kind != name) continue;
    for (const Group& group : table)
      for (const Line& line : group.lines)
        if (std::find(keys.begin(), keys.end(), line.quantity.id) == keys.end()) keys.emplace_back(line.quantity.id);
  }
  return keys;
}

std::vector<BearingFigure> figures_of(const BearingSolution& solution) {
  std::vector<BearingFigure> figures;
  for (const Group& group : table_of(solution)) {
    for (const Line& line : group.lines) {
      if (line.more.only && !line.more.only(solution)) continue;
      const std::vector<std::string> names = line.more.each ? line.more.each(solution) : std::vector<std::string>{""};
      for (std::size_t k = 0; k < names.size(); ++k) {
        const double size = line.unit.size;
        BearingFigure& figure =
            figures.emplace_back(BearingFigure{.key = filled_in(line.quantity.id, names[k]),
                                               .name = filled_in(line.quantity.title, names[k]),
                                               .label = filled_in(line.label, names[k]),
                                               .unit = line.unit.name,
                                               .si_unit = line.unit.si,
                                               .si = size,
                                               .value = line.value(solution, k) / size,
                                               .words = line.more.words ? line.more.words(solution) : "",
                                               .group = group.name});
        const double error = line.more.grid_error      ? line.more.grid_error(solution)
                             : line.more.grid_error_of ? line.more.grid_error_of(solution, k)
                                                       : -1;
        if (solution.grid_error.known && error >= 0) figure.grid_error = error / size;
      }
    }
  }
  return figures;
}

}  // namespace hersey::study
