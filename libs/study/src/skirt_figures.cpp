#include <cmath>
#include <string>
#include <vector>

#include "figure_table.h"
#include "hersey/bearing/skirt.h"

// Figures of a piston's skirt in its liner.
namespace hersey::study {
namespace {

double speed_of_skirt(const Solution& s) { return s.model.R * s.state.point.journal_speed; }
double side_force_of(const Solution& s) { return s.state.load[0]; }
double friction_of_skirt(const Solution& s) {
  return bearing::skirt_friction(s.state.film.wrench_on_shell, s.state.tilt);
}

/// Offset of the skirt's axis at one of its ends. @param end  1 at the top, -1 at the bottom
auto offset_at(double end) {
  return [end](const Solution& s) { return s.state.e[0] + 0.5 * end * s.model.L * s.state.tilt.x(); };
}
auto velocity_at(double end) {
  return [end](const Solution& s) {
    return s.state.point.e_rate[0] + 0.5 * end * s.model.L * s.state.point.tilt_rate.x();
  };
}

bool moves_sideways(const Solution& s) { return squeezes(s) || s.state.point.tilt_rate.norm() > 0; }
bool bears_side_force(const Solution& s) { return side_force_of(s) != 0; }

/// What bears on the sides, found from the forces of the film's nodes.
bearing::SkirtSide side_of(const Solution& s, std::size_t k) {
  return bearing::skirt_side_forces(s.model, s.state.film.normal_forces).at(k);
}

/// Index of the k-th side on which something bears.
std::size_t bearing_side(const Solution& s, std::size_t k) { return side_of(s, 0).force > 0 ? k : 1; }

std::vector<std::string> names_of_bearing_sides(const Solution& s) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < bearing::skirt_sides.size(); ++k)
    if (side_of(s, k).force > 0) names.emplace_back(bearing::skirt_sides.at(k));
  return names;
}

/// Power that the skirt puts into the film by its motion along and across the liner.
double put_in_by_skirt(const Solution& s) {
  const Vector6& wrench = s.state.film.wrench_on_shell;
  return -friction_of_skirt(s) * speed_of_skirt(s) + side_force_of(s) * s.state.point.e_rate[0] -
         wrench[1] * s.state.point.tilt_rate.x();
}

std::vector<std::string> names_of_sides(const Solution& /*s*/) {
  return {bearing::skirt_sides.begin(), bearing::skirt_sides.end()};
}

Group position_of_skirt() {
  constexpr Unit kMetrePerSecond{"m/s", "m/s", 1};
  return {"operating point",
          {{"skirt_speed", kMetrePerSecond, speed_of_skirt},
           {"side_force", kNewton, side_force_of, {.grid_error = load_error}},
           {"offset_top", kMicrometre, offset_at(1)},
           {"offset_bottom", kMicrometre, offset_at(-1)},
           {"velocity_top", kMillimetrePerSecond, velocity_at(1), {.only = moves_sideways}},
           {"velocity_bottom", kMillimetrePerSecond, velocity_at(-1), {.only = moves_sideways}},
           {"skirt_slope", kMicrometrePerMetre, [](const Solution& s) { return s.state.tilt.x(); }}}};
}

Group film_of_skirt() {
  using Film = film::FilmObservables;
  using Error = bearing::GridError;
  return {
      "film",
      {{"h_min", kMicrometre, film(&Film::h_min), {.grid_error = error_of(&Error::h_min)}},
       {"h_min_angle", "  at", kDegree, film(&Film::h_min_phi)},
       {"h_min_z", "  at z", kMillimetre, height(&Film::h_min_z)},
       {"p_max", kMegapascal, film(&Film::p_max), {.grid_error = error_of(&Error::p_max)}},
       {"p_max_angle", "  at", kDegree, film(&Film::p_max_phi)},
       {"p_max_z", "  at z", kMillimetre, height(&Film::p_max_z)},
       {"h_min_<side>",
        kMicrometre,
        [](const Solution& s, std::size_t k) { return s.state.film.patches.at(k).h_min; },
        {.each = names_of_sides}},
       {"p_max_<side>",
        kMegapascal,
        [](const Solution& s, std::size_t k) { return s.state.film.patches.at(k).p_max; },
        {.each = names_of_sides}},
       {"side_force_<side>",
        kNewton,
        [](const Solution& s, std::size_t k) { return side_of(s, k).force; },
        {.each = names_of_sides}},
       {"centre_<side>",
        kMillimetre,
        [](const Solution& s, std::size_t k) { return side_of(s, bearing_side(s, k)).centre(); },
        {.each = names_of_bearing_sides}},
       {"skirt_moment", kNewtonMetre, [](const Solution& s) { return side_of(s, 0).moment - side_of(s, 1).moment; }}}};
}

Group friction_figures_of_skirt() {
  using Film = film::FilmObservables;
  return {"friction",
          {{"friction_skirt",
            kNone,
            [](const Solution& s) { return std::abs(friction_of_skirt(s) / side_force_of(s)); },
            {.grid_error = error_of(&bearing::GridError::friction_journal), .only = bears_side_force}},
           {"skirt_friction", kNewton, friction_of_skirt},
           {"skirt_shear", kNewton, [](const Solution& s) { return s.state.film.force_shear.z(); }},
           {"power_film", kWatt, film(&Film::power_film), {.grid_error = error_of(&bearing::GridError::power_film)}},
           {"power_film_other_shear", kWatt, film(&Film::power_film_other_shear), {.only = shears_differ}},
           {"power_asperity", kWatt, film(&Film::power_asperity)},
           {"power_put_in", "power put in by the skirt's motion", kWatt, put_in_by_skirt},
           power_not_explained(put_in_by_skirt)}};
}

bool meets_layers(const Solution& s) { return s.model.edge_left.layer || s.model.edge_right.layer; }

Group oil_of_skirt() {
  using Film = film::FilmObservables;
  return {"oil",
          {{"flow_top", kFlow, film(&Film::flow_right)},
           {"flow_bottom", kFlow, film(&Film::flow_left)},
           {"oil_volume", kVolume, film(&Film::oil_volume)},
           mass_balance_error(),
           {"cavitated_share", kNone, film(&Film::cavitated_share)},
           {"starved_share", kNone, film(&Film::starved_share), {.only = meets_layers}},
           {"flow_scraped", kFlow, film(&Film::flow_scraped), {.only = meets_layers}}}};
}

/// Derivatives by the offset of the skirt's middle and by its slope towards the thrust side.
Group dynamics_of_skirt() {
  constexpr Unit kMomentStiffness{"N.m/rad", "N.m", 1}, kMomentDamping{"N.m.s/rad", "N.m.s", 1},
      kImpulse{"N.s", "N.s", 1};
  const auto entry = [](bearing::DynamicCoefficients::Matrix bearing::DynamicCoefficients::*matrix, int i, int j) {
    return [=](const Solution& s) { return (s.state.coefficients.*matrix)(i, j); };
  };
  const auto stiffness = &bearing::DynamicCoefficients::stiffness, damping = &bearing::DynamicCoefficients::damping;
  return {"stiffness and damping",
          {{"stiffness_side",
            kStiffness,
            entry(stiffness, 0, 0),
            {.grid_error = [](const Solution& s) { return s.grid_error.stiffness(0, 0); }}},
           {"stiffness_side_by_tilt", kNewton, entry(stiffness, 0, 1)},
           {"stiffness_tilt", kMomentStiffness, entry(stiffness, 1, 1)},
           {"damping_side",
            kDamping,
            entry(damping, 0, 0),
            {.grid_error = [](const Solution& s) { return s.grid_error.damping(0, 0); }}},
           {"damping_side_by_tilt", kImpulse, entry(damping, 0, 1)},
           {"damping_tilt", kMomentDamping, entry(damping, 1, 1)}}};
}

}  // namespace

std::vector<Group> skirt_figures() {
  return {position_of_skirt(), with(film_of_skirt(), regime_of_flow()), friction_figures_of_skirt(), oil_of_skirt(),
          dynamics_of_skirt()};
}

}  // namespace hersey::study
