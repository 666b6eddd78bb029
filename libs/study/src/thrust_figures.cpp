#include <algorithm>
#include <cmath>

#include "figure_table.h"
#include "hersey/bearing/thrust_bearing.h"

// Figures of a thrust bearing: the runner's position is the film thickness on the axis, forces are along it.
namespace hersey::study {
namespace {

/// Load on the runner towards the stator; the search's force is that of the film on the stator, along z.
double thrust_of(const Solution& s) { return -s.state.load[0]; }
bool carries(const Solution& s) { return thrust_of(s) > 0; }
double runner_speed(const Solution& s) { return s.state.point.journal_speed; }
bool rotates(const Solution& s) { return runner_speed(s) != 0; }
double outer_radius(const Solution& s) { return s.model.R + 0.5 * s.model.L; }

/// About the runner's own axis, which leans (thrust.7).
double torque_on_runner(const Solution& s) { return s.state.film.torque_journal; }

/// The stator rests: power enters through the runner's torque, and through the load as runner and stator approach.
double power_of_runner(const Solution& s) {
  return -torque_on_runner(s) * runner_speed(s) + s.state.load[0] * s.state.point.e_rate[0];
}

/// Radius of a place of the film whose z counts from the mean radius.
auto radius(double film::FilmObservables::*z) {
  return [z](const Solution& s) { return s.model.R + s.state.film.*z; };
}

double centre_by_x(const Solution& s) {
  return without_round_off(s.state.film.wrench_on_shell[1] / thrust_of(s), s.model.R);
}
double centre_by_y(const Solution& s) {
  return without_round_off(-s.state.film.wrench_on_shell[0] / thrust_of(s), s.model.R);
}

const bearing::ThrustBearing& geometry(const Solution& s) {
  return dynamic_cast<const bearing::ThrustBearing&>(*s.state.kind);
}

/// Oil that leaves over the leading edges, those with the smaller angle of pads made for a positive rotation.
double flow_over_leading(const Solution& s) {
  return geometry(s).is_forward() ? s.state.film.flow_first : s.state.film.flow_last;
}
double flow_over_trailing(const Solution& s) {
  return geometry(s).is_forward() ? s.state.film.flow_last : s.state.film.flow_first;
}
bool has_pads(const Solution& s) { return !geometry(s).pads().empty(); }

Group thrust_point() {
  return {"operating point",
          {{"runner_speed", kRpm, runner_speed},
           {"load", kNewton, thrust_of, {.grid_error = load_error}},
           {"approach_speed",
            kMillimetrePerSecond,
            [](const Solution& s) { return -s.state.point.e_rate[0]; },
            {.only = squeezes}},
           {"film_thickness_axis", kMicrometre, [](const Solution& s) { return s.state.e[0]; }},
           {"tilt_x", "slope of the runner's axis, x", kMicrometrePerMetre,
            [](const Solution& s) { return s.state.tilt.x(); }},
           {"tilt_y", "slope of the runner's axis, y", kMicrometrePerMetre,
            [](const Solution& s) { return s.state.tilt.y(); }}}};
}

Group thrust_film() {
  using Film = film::FilmObservables;
  using Error = bearing::GridError;
  return {"film",
          {{"h_min", kMicrometre, film(&Film::h_min), {.grid_error = error_of(&Error::h_min)}},
           {"h_min_angle", "  at the angle", kDegree, film(&Film::h_min_phi)},
           {"h_min_r", "  at the radius", kMillimetre, radius(&Film::h_min_z)},
           minimum_thickness_over_features(),
           {"p_max", kMegapascal, film(&Film::p_max), {.grid_error = error_of(&Error::p_max)}},
           {"p_max_angle", "  at the angle", kDegree, film(&Film::p_max_phi)},
           {"p_max_r", "  at the radius", kMillimetre, radius(&Film::p_max_z)},
           {"centre_x", kMillimetre, centre_by_x, {.only = carries}},
           {"centre_y", kMillimetre, centre_by_y, {.only = carries}},
           {"moment_x", "moment on the stator, x", kNewtonMetre,
            [](const Solution& s) {
              return without_round_off(s.state.film.wrench_on_shell[0], s.model.R * s.state.load.norm());
            }},
           {"moment_y", "moment on the stator, y", kNewtonMetre, [](const Solution& s) {
              return without_round_off(s.state.film.wrench_on_shell[1], s.model.R * s.state.load.norm());
            }}}};
}

// What film and contact do to one pad.

std::vector<std::string> pad_names(const Solution& s) {
  std::vector<std::string> names;
  for (const bearing::SectorPad& pad : geometry(s).pads()) names.push_back(pad.name);
  return names;
}

/// Axial force on a pad and its first moments by x and y.
Vector3 resultant(const Solution& s, std::size_t pad) {
  const film::Grid& grid = s.model.grid;
  Vector3 sum = Vector3::Zero();
  for (int i = grid.patches[pad]; i < grid.n_phi && grid.patch_of(i) == static_cast<int>(pad); ++i) {
    for (int j = 0; j < grid.n_z; ++j) {
      const double r = s.model.R + s.model.L * grid.z_over_L(j), phi = grid.phi(i);
      sum += s.state.film.normal_forces[grid.index(i, j)] * Vector3(1, r * std::cos(phi), r * std::sin(phi));
    }
  }
  return sum;
}

double pad_centre_radius(const Solution& s, std::size_t pad) {
  const Vector3 f = resultant(s, pad);
  return std::hypot(f[1], f[2]) / f[0];
}

double pad_centre_angle(const Solution& s, std::size_t pad) {
  const Vector3 f = resultant(s, pad);
  const bearing::SectorPad& sector = geometry(s).pads()[pad];
  const double from_middle =
      std::remainder(std::atan2(f[2], f[1]) - 0.5 * (sector.from + sector.to), 2 * std::numbers::pi);
  return 0.5 * (sector.to - sector.from) + (geometry(s).is_forward() ? from_middle : -from_middle);
}

Group thrust_pads() {
  const auto patch = [](double film::PatchObservables::*member) {
    return [member](const Solution& s, std::size_t k) { return s.state.film.patches[k].*member; };
  };
  return {"pads",
          {{"pad_load_<name>",
            kNewton,
            [](const Solution& s, std::size_t k) { return resultant(s, k)[0]; },
            {.each = pad_names}},
           {"pad_centre_r_<name>", "  its centre's radius", kMillimetre, pad_centre_radius, {.each = pad_names}},
           {"pad_centre_angle_<name>",
            "  its centre's angle from the leading edge",
            kDegree,
            pad_centre_angle,
            {.each = pad_names}},
           {"pad_h_min_<name>", kMicrometre, patch(&film::PatchObservables::h_min), {.each = pad_names}},
           {"pad_p_max_<name>", kMegapascal, patch(&film::PatchObservables::p_max), {.each = pad_names}},
           {"pad_flow_in_<name>",
            kFlow,
            [](const Solution& s, std::size_t k) {
              const film::PatchObservables& of = s.state.film.patches[k];
              return -(geometry(s).is_forward() ? of.flow_first : of.flow_last);
            },
            {.each = pad_names}}}};
}

Group thrust_numbers() {
  return {"numbers",
          {{"thrust_number",
            kNone,
            [](const Solution& s) {
              return thrust_of(s) * std::pow(s.state.film.h_min, 2) /
                     (s.model.lubricant.mu0 * std::abs(runner_speed(s)) * std::pow(outer_radius(s), 4));
            },
            {.only = rotates}}}};
}

Group thrust_friction() {
  using Film = film::FilmObservables;
  using Error = bearing::GridError;
  return {"friction",
          {{"friction_runner",
            "friction coefficient, torque over load and mean radius",
            kNone,
            [](const Solution& s) { return std::abs(torque_on_runner(s)) / (s.model.R * thrust_of(s)); },
            {.grid_error = error_of(&Error::friction_journal), .only = carries}},
           {"torque_runner", kNewtonMetre, torque_on_runner, {.grid_error = error_of(&Error::torque_journal)}},
           {"torque_stator", kNewtonMetre, film(&Film::torque_shell), {.grid_error = error_of(&Error::torque_shell)}},
           {"power_film", kWatt, film(&Film::power_film), {.grid_error = error_of(&Error::power_film)}},
           {"power_film_other_shear", kWatt, film(&Film::power_film_other_shear), {.only = shears_differ}},
           {"power_asperity", kWatt, film(&Film::power_asperity)},
           {"power_put_in", "power put in by torque and load", kWatt, power_of_runner},
           power_not_explained(power_of_runner),
           {"asperity_share",
            kNone,
            [](const Solution& s) { return -s.state.film.force_asperity.z() / thrust_of(s); },
            {.only = [](const Solution& s) { return s.model.asperities.model != film::AsperityModel::none; }}}}};
}

Group thrust_oil() {
  using Film = film::FilmObservables;
  return {"oil",
          {{"flow_leading", "flow out over the leading edges", kFlow, flow_over_leading, {.only = has_pads}},
           {"flow_trailing", "flow out over the trailing edges", kFlow, flow_over_trailing, {.only = has_pads}},
           {"side_flow",
            "flow out over inner and outer edges",
            kFlow,
            film(&Film::flow_sides),
            {.grid_error = error_of(&bearing::GridError::side_flow)}},
           {"flow_inner", kFlow, film(&Film::flow_left)},
           {"flow_outer", kFlow, film(&Film::flow_right)},
           {"flow_supply", kFlow, film(&Film::flow_supply)},
           flow_through_features(),
           {"oil_volume", kVolume, film(&Film::oil_volume)},
           mass_balance_error(),
           {"cavitated_share", kNone, film(&Film::cavitated_share)},
           {"rupture_angle", kDegree, film(&Film::rupture_angle), {.only = ruptures}},
           {"reformation_angle", "  and re-forms at", kDegree, film(&Film::reformation_angle), {.only = ruptures}}}};
}

Group thrust_heat() {
  using Heat = film::HeatObservables;
  const auto of = [](double Heat::*place) {
    return [place](const Solution& s) { return s.state.heat->observed.*place; };
  };
  return flat_heat(
      {{"T_max_angle", "  at the angle", kDegree, of(&Heat::T_max_phi), {.only = has_film_heat}},
       {"T_max_r",
        "  at the radius",
        kMillimetre,
        [](const Solution& s) { return s.model.R + s.state.heat->observed.T_max_z; },
        {.only = has_film_heat}}},
      {{"T_face_max_angle", "  at the angle", kDegree, of(&Heat::T_shell_max_phi), {.only = has_film_heat}}});
}

/// Names of the directions of a tilt, and of pairs of them.
std::vector<std::string> directions(const Solution& /*s*/) { return {"x", "y"}; }
std::vector<std::string> pairs(const Solution& /*s*/) { return {"xx", "xy", "yx", "yy"}; }

/// Derivatives of axial force and moments by the distance and the slopes of the runner's axis: all nine of each.
Group thrust_dynamics() {
  constexpr Unit kMomentStiffness{"N.m/rad", "N.m", 1}, kMomentDamping{"N.m.s/rad", "N.m.s", 1};
  constexpr Unit kNewtonSecond{"N.s", "N.s", 1};
  using Matrix = bearing::DynamicCoefficients::Matrix;
  const auto stiffness = &bearing::DynamicCoefficients::stiffness, damping = &bearing::DynamicCoefficients::damping;
  const auto axial = [](Matrix bearing::DynamicCoefficients::*of) {
    return [of](const Solution& s) { return (s.state.coefficients.*of)(0, 0); };
  };
  // What is zero by symmetry comes out as the round-off of parts that are as large as the axial entry over the radius.
  const auto entry = [](Matrix bearing::DynamicCoefficients::*of, const Solution& s, Eigen::Index i, Eigen::Index j) {
    const Matrix& m = s.state.coefficients.*of;
    const double arms = (i > 0 ? s.model.R : 1) * (j > 0 ? s.model.R : 1);
    return without_round_off(m(i, j), std::abs(m(0, 0)) * arms);
  };
  const auto tilting = [entry](Matrix bearing::DynamicCoefficients::*of) {
    return [=](const Solution& s, std::size_t k) {
      return entry(of, s, 1 + static_cast<Eigen::Index>(k / 2), 1 + static_cast<Eigen::Index>(k % 2));
    };
  };
  const auto force_by_slope = [entry](Matrix bearing::DynamicCoefficients::*of) {
    return [=](const Solution& s, std::size_t k) { return entry(of, s, 0, 1 + static_cast<Eigen::Index>(k)); };
  };
  const auto moment_by_distance = [entry](Matrix bearing::DynamicCoefficients::*of) {
    return [=](const Solution& s, std::size_t k) { return entry(of, s, 1 + static_cast<Eigen::Index>(k), 0); };
  };
  return {"stiffness and damping",
          {{"stiffness",
            kStiffness,
            axial(stiffness),
            {.grid_error = [](const Solution& s) { return s.grid_error.stiffness(0, 0); }}},
           {"tilting_stiffness_<ij>", kMomentStiffness, tilting(stiffness), {.each = pairs}},
           {"load_by_tilt_<i>", kNewton, force_by_slope(stiffness), {.each = directions}},
           {"moment_by_distance_<i>", kNewton, moment_by_distance(stiffness), {.each = directions}},
           {"damping",
            kDamping,
            axial(damping),
            {.grid_error = [](const Solution& s) { return s.grid_error.damping(0, 0); }}},
           {"tilting_damping_<ij>", kMomentDamping, tilting(damping), {.each = pairs}},
           {"load_by_tilting_<i>", kNewtonSecond, force_by_slope(damping), {.each = directions}},
           {"moment_by_approach_<i>", kNewtonSecond, moment_by_distance(damping), {.each = directions}}}};
}

}  // namespace

std::vector<Group> thrust_figures() {
  return {thrust_point(),   thrust_film(),     thrust_pads(),
          thrust_numbers(), thrust_friction(), with(thrust_oil(), restricted_feeds()),
          thrust_heat(),    thrust_dynamics()};
}

std::vector<Group> thrust_pad_figures() {
  return {thrust_point(),    thrust_film(), thrust_pads(), pad_pivot_figures(), thrust_numbers(),
          thrust_friction(), thrust_oil(),  thrust_heat(), thrust_dynamics()};
}

}  // namespace hersey::study
