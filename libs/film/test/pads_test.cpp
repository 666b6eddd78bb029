#include <doctest/doctest.h>

#include <algorithm>
#include <array>

#include "film_cases.h"
#include "hot_film.h"
#include "relative.h"

// Pads of a bore, fed at their ends, whose films break before these: mirrored, refined, and warm.
namespace hersey::film {
namespace pads_test {

/// Pads from the converging gap to behind the narrowest gap, which lies at pi, or their mirror image.
struct Pads {
  FilmModel model;
  Journal journal;
};

Pads pads(bool mirrored, Cavitation cavitation, int lines, int rows) {
  const auto at = [mirrored](double phi) { return mirrored ? 2 * pi - phi : phi; };
  const auto patch = [&](double from, double to, int n) {
    return mirrored ? Patch{at(to), at(from), n} : Patch{from, to, n};
  };
  std::vector<Patch> patches{patch(1.8, 3.0, lines), patch(3.3, 4.9, lines)};
  if (mirrored) std::reverse(patches.begin(), patches.end());
  Pads p{.model = {.R = 0.03, .L = 0.03, .c = 30e-6, .grid = patch_grid(patches, rows), .lubricant = thinning_oil()},
         .journal = {.e = {-18e-6, 0}, .omega_journal = mirrored ? -200.0 : 200.0}};
  FilmModel& m = p.model;
  m.cavitation = cavitation;
  m.cavitated_shear = CavitatedShear::film_share;
  const PatchEnds first{.first = {.pressure = 4e5}, .last = {.pressure = 2e5}};
  const PatchEnds last{.first = {.pressure = 3e5}, .last = {}};
  m.ends = mirrored ? std::vector<PatchEnds>{{.first = last.last, .last = last.first},
                                             {.first = first.last, .last = first.first}}
                    : std::vector<PatchEnds>{first, last};
  m.features = {{.name = "inlet", .phi = at(3.3), .arc = 0.2, .length = 0.7 * m.L, .pressure = 3e5},
                {.name = "outlet", .phi = at(4.9), .arc = 0.1, .length = 0.7 * m.L, .pressure = 1e5}};
  return p;
}

constexpr std::array<Cavitation, 3> all{Cavitation::guembel, Cavitation::reynolds, Cavitation::mass_conserving};

TEST_CASE("PadsWithTheOtherSense_AreTheMirrorImage") {
  for (const Cavitation cavitation : all) {
    CAPTURE(static_cast<int>(cavitation));
    const Pads one = pads(false, cavitation, 17, 9), other = pads(true, cavitation, 17, 9);
    const SolvedFilm film = solve_cold(one.model, one.journal), image = solve_cold(other.model, other.journal);
    REQUIRE(film.summary.solved());
    REQUIRE(image.summary.solved());
    constexpr double solved = 1e-7;  // residuals of 1e-10, amplified by the film's condition
    CHECK(image.observed.torque_journal == relative(-film.observed.torque_journal).epsilon(solved));
    CHECK(image.observed.power_film == relative(film.observed.power_film).epsilon(solved));
    CHECK(image.observed.cavitated_share == relative(film.observed.cavitated_share).epsilon(solved));
    CHECK(image.observed.flow_supply == relative(film.observed.flow_supply).epsilon(solved));
    CHECK(image.wrench[3] == relative(film.wrench[3]).epsilon(solved));
    CHECK(image.wrench[4] == relative(-film.wrench[4]).epsilon(solved));
    CHECK(film.observed.cavitated_share > 0.1);
  }
}

// Borders of cavities, where a film cavitates before the end of its pad too, are no matter of the lines they lie
// between. (A conserved film re-forms before such an end by whole cells.)
TEST_CASE("CavitiesOfPads_DoNotDependOnTheGrid") {
  for (const Cavitation cavitation : {Cavitation::guembel, Cavitation::reynolds}) {
    for (const bool mirrored : {false, true}) {
      CAPTURE(static_cast<int>(cavitation));
      CAPTURE(mirrored);
      std::array<FilmObservables, 2> observed;
      for (const int k : {0, 1}) {
        Pads p = pads(mirrored, cavitation, k == 0 ? 17 : 65, k == 0 ? 9 : 33);
        p.model.features.clear();  // holes have edges of their own
        const SolvedFilm film = solve_cold(p.model, p.journal);
        REQUIRE(film.summary.solved());
        observed[static_cast<std::size_t>(k)] = film.observed;
      }
      constexpr double of_second_order = 1.5e-2;  // some (1/16)^2 of films with slopes around five
      CHECK(observed[0].torque_journal == relative(observed[1].torque_journal).epsilon(of_second_order));
      CHECK(observed[0].power_film == relative(observed[1].power_film).epsilon(of_second_order));
    }
  }
}

// Where an end has more pressure than the film anywhere, the peak lies there.
TEST_CASE("PeakAtAnEnd_IsTheEndsPressure") {
  for (const bool mirrored : {false, true}) {
    CAPTURE(mirrored);
    Pads p = pads(mirrored, Cavitation::mass_conserving, 17, 9);
    p.model.features.clear();
    (mirrored ? p.model.ends[0].first : p.model.ends[1].last).pressure = 9e7;
    const SolvedFilm film = solve_cold(p.model, p.journal);
    REQUIRE(film.summary.solved());
    CHECK(film.observed.p_max == relative(9e7).epsilon(1e-12));                                          // round-off
    CHECK(std::abs(film.observed.p_max_phi) == relative(mirrored ? 2 * pi - 4.9 : 4.9).epsilon(1e-12));  // likewise
  }
}

// Oil that is carried towards a wall has its peak there, on either side of the bearing.
TEST_CASE("PeakAtAWall_LiesThere") {
  for (const bool mirrored : {false, true}) {
    CAPTURE(mirrored);
    Pads p = pads(mirrored, Cavitation::mass_conserving, 17, 9);
    p.model.features.clear();
    (mirrored ? p.model.ends[1].first : p.model.ends[0].last) = {.kind = EdgeKind::closed};
    const SolvedFilm film = solve_cold(p.model, p.journal);
    REQUIRE(film.summary.solved());
    CHECK(film.observed.p_max == relative(film.fields.p.maxCoeff()).epsilon(1e-12));  // in a row of the grid
    CHECK(std::abs(film.observed.p_max_phi) == relative(mirrored ? 2 * pi - 3 : 3.0).epsilon(1e-12));  // round-off
  }
}

// Warm oil that thins as its layers are sheared, with holes over both ends of a pad.
TEST_CASE("WarmPadsWithTheOtherSense_AreTheMirrorImage") {
  const auto solved = [](bool mirrored) {
    Pads p = pads(mirrored, Cavitation::mass_conserving, 13, 7);
    p.model.lubricant.shear_thinning = {.law = Carreau{.limit = 0.4, .exponent = 0.6}, .critical_rate = 1e5};
    ThermalModel thermal = supplied_at_40(4);
    thermal.shell = WallAtTemperature{.T = 45 + zero_celsius};
    return solve_hot(p.model, thermal, surfaces(p.model, p.journal), p.journal.e);
  };
  const HotFilm film = solved(false), image = solved(true);
  constexpr double tolerance = 1e-4;  // K: the last iterations of film, heat and thinning leave this of some 10
  CHECK(std::abs(image.heat.T_max - film.heat.T_max) < tolerance);
  CHECK(std::abs(image.heat.T_journal - film.heat.T_journal) < tolerance);
  CHECK(std::abs(image.heat.T_side - film.heat.T_side) < tolerance);
  CHECK(film.heat.T_max > 42 + zero_celsius);
  CHECK(image.film.torque_journal == relative(-film.film.torque_journal).epsilon(1e-5));  // likewise
}

}  // namespace pads_test
}  // namespace hersey::film
