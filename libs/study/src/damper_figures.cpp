#include <cmath>

#include "figure_table.h"

// Figures of a squeeze-film damper: on a circular orbit in axes that rotate with it, x radial and y along its motion
// where it goes from x towards y; for small motions about a position in the bearing's axes.
namespace hersey::study {
namespace {

double radius_of(const Solution& s) { return s.state.e.norm(); }
bool orbits(const Solution& s) { return s.state.point.whirl_speed != 0; }
bool is_small(const Solution& s) { return !orbits(s); }
bool has_inertia(const Solution& s) { return s.state.coefficients.inertia.size() > 0; }

double clearance_of(const Solution& s) { return bearing::clearance(s.model, s.state.point); }

/// Force on the journal along its eccentricity, and along its motion (damper.2).
double radial(const Solution& s) {
  return without_round_off(-s.state.load.dot(s.state.e) / radius_of(s), s.state.load.norm());
}
double tangential(const Solution& s) {
  const bearing::Coordinates &e = s.state.e, &load = s.state.load;
  return -std::copysign(1.0, s.whirl_speed) * (e.x() * load.y() - e.y() * load.x()) / radius_of(s);
}

double stiffness_of_orbit(const Solution& s) { return -radial(s) / radius_of(s); }
double damping_of_orbit(const Solution& s) { return -tangential(s) / (radius_of(s) * std::abs(s.whirl_speed)); }

/// (damper.3)
double unit_damping(const Solution& s) {
  return s.model.lubricant.mu0 * s.model.R * std::pow(s.model.L / clearance_of(s), 3);
}

/// The journal's surface moves with its centre, against the film's force; neither surface rotates.
double put_in_by_orbit(const Solution& s) { return -tangential(s) * radius_of(s) * std::abs(s.whirl_speed); }

Group point_of_damper() {
  return {"operating point",
          {{"whirl_speed", kRpm, [](const Solution& s) { return s.whirl_speed; }},
           {"orbit_ratio", kNone, [](const Solution& s) { return radius_of(s) / clearance_of(s); }, {.only = orbits}},
           {"eccentricity_ratio",
            kNone,
            [](const Solution& s) { return radius_of(s) / clearance_of(s); },
            {.only = is_small}},
           {"squeeze_reynolds", kNone, [](const Solution& s) {
              return s.model.lubricant.density * std::abs(s.whirl_speed) * std::pow(clearance_of(s), 2) /
                     s.model.lubricant.mu0;
            }}}};
}

Group film_of_damper() {
  using Film = film::FilmObservables;
  using Error = bearing::GridError;
  return {"film",
          {{"h_min", kMicrometre, film(&Film::h_min), {.grid_error = error_of(&Error::h_min)}},
           {"h_min_angle", "  at the angle", kDegree, film(&Film::h_min_phi)},
           minimum_thickness_over_features(),
           {"p_max", kMegapascal, film(&Film::p_max), {.grid_error = error_of(&Error::p_max)}},
           {"p_max_angle",
            "  at the angle, from the narrowest gap in the sense of rotation",
            kDegree,
            film(&Film::p_max_phi),
            {.only = orbits}},
           {"p_max_z", "  at z", kMillimetre, height(&Film::p_max_z)}}};
}

Group force_of_damper() {
  return {
      "force of the orbit",
      {{"force_radial", kNewton, radial, {.only = orbits}},
       {"force_tangential", kNewton, tangential, {.only = orbits}},
       {"orbit_stiffness", kStiffness, stiffness_of_orbit, {.only = orbits}},
       {"orbit_damping", kDamping, damping_of_orbit, {.only = orbits}},
       {"K_orbit",
        kNone,
        [](const Solution& s) { return stiffness_of_orbit(s) / (unit_damping(s) * std::abs(s.whirl_speed)); },
        {.only = orbits}},
       {"C_orbit", kNone, [](const Solution& s) { return damping_of_orbit(s) / unit_damping(s); }, {.only = orbits}}}};
}

std::vector<std::string> entries(const Solution& /*s*/) { return {"xx", "xy", "yx", "yy"}; }

double entry(const bearing::DynamicCoefficients::Matrix& matrix, std::size_t k) {
  return matrix(static_cast<Eigen::Index>(k / 2), static_cast<Eigen::Index>(k % 2));
}

Group motions_of_damper() {
  return {"small motions",
          {{"stiffness_<ij>",
            kStiffness,
            [](const Solution& s, std::size_t k) { return entry(s.state.coefficients.stiffness, k); },
            {.only = is_small, .each = entries}},
           {"damping_<ij>",
            kDamping,
            [](const Solution& s, std::size_t k) { return entry(s.state.coefficients.damping, k); },
            {.only = is_small, .each = entries}},
           {"added_mass_<ij>",
            kKilogram,
            [](const Solution& s, std::size_t k) { return entry(s.state.coefficients.inertia, k); },
            {.only = has_inertia, .each = entries}}}};
}

Group power_of_damper() {
  using Film = film::FilmObservables;
  Line unexplained = power_not_explained(put_in_by_orbit);
  unexplained.more.only = orbits;
  return {"power",
          {{"power_film",
            kWatt,
            film(&Film::power_film),
            {.grid_error = error_of(&bearing::GridError::power_film), .only = orbits}},
           {"power_put_in", "power put in by the orbit", kWatt, put_in_by_orbit, {.only = orbits}},
           std::move(unexplained)}};
}

Group oil_of_damper() {
  using Film = film::FilmObservables;
  return {"oil",
          {{"side_flow", "side flow", kFlow, film(&Film::flow_sides)},
           {"flow_left", kFlow, film(&Film::flow_left)},
           {"flow_right", kFlow, film(&Film::flow_right)},
           {"flow_supply", kFlow, film(&Film::flow_supply)},
           flow_through_features(),
           {"oil_volume", kVolume, film(&Film::oil_volume)},
           mass_balance_error(),
           {"cavitated_share", kNone, film(&Film::cavitated_share)}}};
}

}  // namespace

std::vector<Group> squeeze_film_damper_figures() {
  return {point_of_damper(),   film_of_damper(),  force_of_damper(),
          motions_of_damper(), power_of_damper(), oil_of_damper()};
}

}  // namespace hersey::study
