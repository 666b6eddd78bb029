#include <cmath>

#include "figure_table.h"

// Figures of a pad on a plane runner: their coordinate y is the film's phi, as its R is 1 m.
namespace hersey::study {
namespace {

double load_of(const Solution& s) { return s.state.load[0]; }
bool bears(const Solution& s) { return load_of(s) > 0; }
double speed_of(const Solution& s) { return s.state.point.journal_speed; }

/// Drag on the runner along its own surface, against its motion: the film's force on the pad, seen along the tangent of
/// the tilted runner (theory manual, slider.6).
double drag(const Solution& s) {
  const Vector6& on_pad = s.state.film.wrench_on_shell;
  return on_pad[4] + s.state.tilt.x() * on_pad[3];
}

double put_in(const Solution& s) { return drag(s) * speed_of(s) + load_of(s) * s.state.point.e_rate[0]; }

/// Where the resultant of all normal forces acts.
double centre_along(const Solution& s) { return -s.state.film.wrench_on_shell[2] / load_of(s); }
double centre_across(const Solution& s) {
  return without_round_off(s.state.film.wrench_on_shell[1] / load_of(s), s.model.L);
}

Group point_figures() {
  constexpr Unit kMetrePerSecond{"m/s", "m/s", 1};
  return {"operating point",
          {{"sliding_speed", kMetrePerSecond, speed_of},
           {"load", kNewton, load_of, {.grid_error = load_error}},
           {"approach_speed",
            kMillimetrePerSecond,
            [](const Solution& s) { return s.state.point.e_rate[0]; },
            {.only = squeezes}},
           {"film_thickness_middle", kMicrometre, [](const Solution& s) { return -s.state.e[0]; }},
           {"tilt_along", kMicrometrePerMetre, [](const Solution& s) { return s.state.tilt.x(); }},
           {"tilt_across", kMicrometrePerMetre, [](const Solution& s) { return s.state.tilt.y(); }}}};
}

Group pad_film() {
  using Film = film::FilmObservables;
  using Error = bearing::GridError;
  return {"film",
          {{"h_min", kMicrometre, film(&Film::h_min), {.grid_error = error_of(&Error::h_min)}},
           {"h_min_y", "  at y", kMillimetre, film(&Film::h_min_phi)},
           {"h_min_z", "  at z", kMillimetre, height(&Film::h_min_z)},
           minimum_thickness_over_features(),
           {"p_max", kMegapascal, film(&Film::p_max), {.grid_error = error_of(&Error::p_max)}},
           {"p_max_y", "  at y", kMillimetre, film(&Film::p_max_phi)},
           {"p_max_z", "  at z", kMillimetre, height(&Film::p_max_z)},
           {"centre_y", kMillimetre, centre_along, {.only = bears}},
           {"centre_z", kMillimetre, centre_across, {.only = bears}}}};
}

Group numbers_of_sliders() {
  return {"numbers",
          {{"load_number",
            kNone,
            [](const Solution& s) {
              const double B = s.model.R * (s.model.grid.phi(s.model.grid.n_phi - 1) - s.model.grid.phi(0));
              return load_of(s) * std::pow(s.state.film.h_min / B, 2) /
                     (6 * s.model.lubricant.mu0 * std::abs(speed_of(s)) * s.model.L);
            },
            {.only = [](const Solution& s) { return speed_of(s) != 0; }}},
           {"hersey",
            "Hersey number mu |U| L/W",
            kNone,
            [](const Solution& s) { return s.model.lubricant.mu0 * std::abs(speed_of(s)) * s.model.L / load_of(s); },
            {.only = bears}}}};
}

Group pad_friction() {
  using Film = film::FilmObservables;
  return {"friction",
          {{"friction_runner",
            kNone,
            [](const Solution& s) { return std::abs(drag(s)) / load_of(s); },
            {.grid_error = error_of(&bearing::GridError::friction_journal), .only = bears}},
           {"force_runner", kNewton, drag},
           {"force_pad", kNewton, [](const Solution& s) { return s.state.film.wrench_on_shell[4]; }},
           {"power_film", kWatt, film(&Film::power_film), {.grid_error = error_of(&bearing::GridError::power_film)}},
           {"power_film_other_shear", kWatt, film(&Film::power_film_other_shear), {.only = shears_differ}},
           {"power_asperity", kWatt, film(&Film::power_asperity)},
           {"power_put_in", "power put in by drag and load", kWatt, put_in},
           power_not_explained(put_in),
           {"asperity_share",
            kNone,
            [](const Solution& s) { return s.state.film.force_asperity.x() / load_of(s); },
            {.only = [](const Solution& s) { return s.model.asperities.model != film::AsperityModel::none; }}}}};
}

Group pad_oil() {
  using Film = film::FilmObservables;
  return {"oil",
          {{"flow_leading", kFlow, film(&Film::flow_first)},
           {"flow_trailing", kFlow, film(&Film::flow_last)},
           {"side_flow",
            "flow out over both sides",
            kFlow,
            film(&Film::flow_sides),
            {.grid_error = error_of(&bearing::GridError::side_flow)}},
           {"flow_left", kFlow, film(&Film::flow_left)},
           {"flow_right", kFlow, film(&Film::flow_right)},
           {"flow_supply", kFlow, film(&Film::flow_supply)},
           flow_through_features(),
           {"oil_volume", kVolume, film(&Film::oil_volume)},
           mass_balance_error(),
           {"cavitated_share", kNone, film(&Film::cavitated_share)},
           {"rupture_y", kMillimetre, film(&Film::rupture_angle), {.only = ruptures}},
           {"reformation_y", "  and re-forms at y", kMillimetre, film(&Film::reformation_angle), {.only = ruptures}}}};
}

/// The film's phi is y, as its R is 1 m.
Group slider_heat() {
  using Heat = film::HeatObservables;
  const auto of = [](double Heat::*place) {
    return [place](const Solution& s) { return s.state.heat->observed.*place; };
  };
  return flat_heat({{"T_max_y", "  at y", kMillimetre, of(&Heat::T_max_phi), {.only = has_film_heat}},
                    {"T_max_z", "  at z", kMillimetre, of(&Heat::T_max_z), {.only = has_film_heat}}},
                   {{"T_face_max_y", "  at y", kMillimetre, of(&Heat::T_shell_max_phi), {.only = has_film_heat}}});
}

/// Derivatives by the runner's distance (n) and its slopes along (a) and across (c).
Group pad_dynamics() {
  constexpr Unit kMomentStiffness{"N.m/rad", "N.m", 1}, kMomentDamping{"N.m.s/rad", "N.m.s", 1};
  const auto entry = [](bearing::DynamicCoefficients::Matrix bearing::DynamicCoefficients::*matrix, int i, int j) {
    return [=](const Solution& s) { return (s.state.coefficients.*matrix)(i, j); };
  };
  const auto stiffness = &bearing::DynamicCoefficients::stiffness, damping = &bearing::DynamicCoefficients::damping;
  return {"stiffness and damping",
          {{"stiffness",
            kStiffness,
            entry(stiffness, 0, 0),
            {.grid_error = [](const Solution& s) { return s.grid_error.stiffness(0, 0); }}},
           {"stiffness_along", kMomentStiffness, entry(stiffness, 1, 1)},
           {"stiffness_across", kMomentStiffness, entry(stiffness, 2, 2)},
           {"stiffness_coupling", kNewton, entry(stiffness, 0, 1)},
           {"damping",
            kDamping,
            entry(damping, 0, 0),
            {.grid_error = [](const Solution& s) { return s.grid_error.damping(0, 0); }}},
           {"damping_along", kMomentDamping, entry(damping, 1, 1)},
           {"damping_across", kMomentDamping, entry(damping, 2, 2)}}};
}

}  // namespace

std::vector<Group> plane_slider_figures() {
  return {point_figures(),
          pad_film(),
          with(numbers_of_sliders(), regime_of_flow()),
          pad_friction(),
          with(pad_oil(), restricted_feeds()),
          slider_heat(),
          pad_dynamics()};
}

}  // namespace hersey::study
