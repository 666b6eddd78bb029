#include <cmath>
#include <string>
#include <vector>

#include "figure_table.h"

// Figures of a floating ring: where journal and ring are, how fast it rotates, and both films.
namespace hersey::study {
namespace {

const RingState& ring_of(const Solution& s) { return *s.pads->ring; }

double direction_of(const Eigen::Vector2d& e) { return std::atan2(e.y(), e.x()); }

std::vector<std::string> names_of_films(const Solution& s) {
  std::vector<std::string> names;
  for (const RingFilmState& film : ring_of(s).films) names.push_back(film.name);
  return names;
}

auto of_ring_film(double film::FilmObservables::*member) {
  return [member](const Solution& s, std::size_t k) { return ring_of(s).films[k].film.*member; };
}

Line ring_films(std::string_view key, const Unit& unit, double film::FilmObservables::*member) {
  return {key, unit, of_ring_film(member), {.each = names_of_films}};
}

}  // namespace

std::vector<Group> ring_figures() {
  using Film = film::FilmObservables;
  return {
      {"operating point",
       {{"journal_speed", kRpm, point(&bearing::OperatingPoint::journal_speed)},
        {"load", kNewton, [](const Solution& s) { return s.state.load.norm(); }},
        {"load_angle", kDegree, [](const Solution& s) { return direction_of(s.state.load); }},
        {"journal_shift", kMicrometre, [](const Solution& s) { return ring_of(s).journal.norm(); }},
        {"journal_shift_angle", "  its direction", kDegree,
         [](const Solution& s) { return direction_of(ring_of(s).journal); }},
        {"ring_shift", kMicrometre, [](const Solution& s) { return ring_of(s).centre.norm(); }},
        {"ring_shift_angle", "  its direction", kDegree,
         [](const Solution& s) { return direction_of(ring_of(s).centre); }},
        {"ring_speed", kRpm, [](const Solution& s) { return ring_of(s).speed; }},
        {"ring_speed_ratio", kNone, [](const Solution& s) { return ring_of(s).speed / s.state.point.journal_speed; }}}},
      {"films",
       {{"film_eccentricity_ratio_<name>",
         kNone,
         [](const Solution& s, std::size_t k) { return ring_of(s).films[k].e.norm() / ring_of(s).films[k].clearance; },
         {.each = names_of_films}},
        ring_films("film_h_min_<name>", kMicrometre, &Film::h_min),
        ring_films("film_p_max_<name>", kMegapascal, &Film::p_max),
        ring_films("film_torque_journal_<name>", kNewtonMetre, &Film::torque_journal),
        ring_films("film_torque_shell_<name>", kNewtonMetre, &Film::torque_shell),
        ring_films("film_power_<name>", kWatt, &Film::power_film),
        {"film_side_flow_<name>",
         kFlow,
         [](const Solution& s, std::size_t k) { return ring_of(s).films[k].film.flow_sides(); },
         {.each = names_of_films}},
        ring_films("film_flow_supply_<name>", kFlow, &Film::flow_supply),
        ring_films("film_cavitated_share_<name>", kNone, &Film::cavitated_share)}},
      {"friction",
       {{"power_films", kWatt,
         [](const Solution& s) {
           double sum = 0;
           for (const RingFilmState& film : ring_of(s).films) sum += film.film.power_film;
           return sum;
         }},
        {"pads_whirl_ratio", kNone, [](const Solution& s) { return s.pads->whirl_ratio; }}}}};
}

}  // namespace hersey::study
