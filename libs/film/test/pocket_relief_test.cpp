#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "film_cases.h"
#include "flow_balance.h"
#include "gap_interpolation.h"
#include "pocket_relief.h"

// Depth of features: volume, flow over their steps, and what the film beside them feels.
namespace hersey::film {
namespace {

FilmModel graded() {
  FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6};
  m.grid = graded_grid(40, 9, {{.place = 0.2, .reach = 0.5, .factor = 3}}, {{.place = 0.5, .reach = 0.2, .factor = 2}});
  return m;
}

SurfaceFeature pocket(FeatureShape shape, Surface surface) {
  return {.name = "pocket",
          .shape = shape,
          .surface = surface,
          .phi = 1,
          .z = 1e-3,
          .arc = 0.7,
          .length = 6e-3,
          .is_fed = false,
          .depth = 50e-6};
}

constexpr std::array shapes{FeatureShape::rectangle, FeatureShape::ellipse};

// A pocket on its way over the grid keeps its volume, whatever cells its borders cut.
TEST_CASE("TurningPocket_KeepsItsVolume") {
  FilmModel m = graded();
  const GridGeometry geometry(m);
  for (const auto shape : shapes) {
    m.features = {pocket(shape, Surface::journal)};
    const double share = shape == FeatureShape::ellipse ? pi / 4 : 1;
    for (const double turned : {0.0, 0.013, 1.0, 2.5, 5.0, -3.0}) {
      const Eigen::VectorXd depth = mean_depth(m, turned);
      double volume = 0;
      for (int k = 0; k < depth.size(); ++k) volume += depth[k] * geometry.area(k / 9, k % 9);
      // Gauss' rule across the ellipse's ends leaves some thousandths.
      CHECK(volume == doctest::Approx(share * 0.7 * m.R * 6e-3 * 50e-6).epsilon(share == 1 ? 1e-12 : 1e-2));
      CHECK(depth.maxCoeff() == doctest::Approx(50e-6));
    }
  }
}

// A pocket that reaches the bearing's edge has its depth there.
TEST_CASE("PocketToTheEdge_IsDeepThere") {
  FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {40, 9}};
  m.features = {{.name = "slot", .phi = pi, .arc = 1, .length = 0.02, .is_fed = false, .depth = 1e-4}};
  for (int j = 0; j < 9; ++j) CHECK(mean_depth(m, 0)[m.grid.index(20, j)] == doctest::Approx(1e-4));
  m.features[0].arc = 2 * pi, m.features[0].length = 5e-3, m.features[0].z = 7.5e-3;
  const Eigen::VectorXd all_around = mean_depth(m, 0);
  for (int i = 0; i < 40; ++i) CHECK(all_around[m.grid.index(i, 8)] == doctest::Approx(1e-4));
}

// In a full film at rest but for a journal with a pocket, concentric: the pocket's own volume turns with it and asks for
// no oil. Nothing flows but round and round, whatever the step.
TEST_CASE("PocketThatTurns_CarriesItsOilAlong") {
  FilmModel m = graded();
  m.p_edge_left = m.p_edge_right = 1e5;
  for (const auto shape : shapes) {
    CAPTURE(static_cast<int>(shape));
    m.features = {pocket(shape, Surface::journal)};
    SurfaceMotion motion = surfaces(m, {.omega_shell = 200, .omega_journal = 200});
    motion.phi_journal = 2.9;
    FlowBalance balance(m);
    const Eigen::VectorXd u = Eigen::VectorXd::Constant(m.grid.size(), 1e5), ones = Eigen::VectorXd::Ones(m.grid.size());
    for (const double turned : {1e-3, 0.05, 0.4, 1.5}) {  // from within a cell to twice the pocket
      CAPTURE(turned);
      FilmHistory history{turned / 200, ones, 0 * ones};
      history.phi_journal = motion.phi_journal - turned;
      balance.evaluate(motion, history, u);
      const double scale = 50e-6 * 6 * 6e-3;  // depth times speed times length
      CHECK(balance.balance().cwiseAbs().maxCoeff() < 1e-12 * scale);
    }
  }
}

// Side flow of a bearing with an axial groove at given pressure: its depth is no business of the land beside it.
TEST_CASE("FedGrooveWithDepth_DoesNotLeakOntoTheLand") {
  for (const auto surface : {Surface::shell, Surface::journal}) {
    CAPTURE(static_cast<int>(surface));
    std::array<double, 3> flow{};
    for (int k = 0; k < 3; ++k) {
      FilmModel m{.R = 0.05, .L = 0.06, .c = 75e-6, .grid = {k == 2 ? 120 : 60, k == 2 ? 25 : 13}};
      m.lubricant.mu0 = 0.03;
      m.features = {{.name = "groove",
                     .surface = surface,
                     .phi = 1.3,
                     .arc = 0.35,
                     .length = 0.04,
                     .pressure = 2e5,
                     .depth = k == 1 ? 2e-3 : 0.0}};
      const SolvedFilm film = solve_cold(m, turning(m, 0.6, 300));
      REQUIRE(film.summary.converged);
      flow[static_cast<std::size_t>(k)] = film.observed.flow_left + film.observed.flow_right;
    }
    CHECK(flow[1] == doctest::Approx(flow[0]).epsilon(1e-12));
    CHECK(flow[2] == doctest::Approx(flow[0]).epsilon(0.05));
  }
}

// A hydrostatic channel: pressure drives oil through lands and a pocket between, of any shape; nothing moves. Its flow
// converges with the grid wherever the borders lie.
TEST_CASE("FlowThroughPockets_ConvergesWithTheGrid") {
  for (const auto shape : shapes) {
    CAPTURE(static_cast<int>(shape));
    for (const double depth : {20e-6, 1e-3}) {
      CAPTURE(depth);
      std::array<double, 3> flow{};
      for (int k = 0; k < 3; ++k) {
        const int n = 1 << k;
        FilmModel m{.R = 0.03, .L = 0.03, .c = 30e-6, .grid = {61 * n, 12 * n + 1}};
        m.p_edge_left = 2e6, m.p_edge_right = 1e6;
        m.features = {pocket(shape, Surface::shell)};
        m.features[0].length = 0.017, m.features[0].arc = 1.1, m.features[0].depth = depth;
        const SolvedFilm film = solve_cold(m, turning(m, 0.3, 0));
        REQUIRE(film.summary.converged);
        flow[static_cast<std::size_t>(k)] = film.observed.flow_right;
        CHECK(film.observed.mass_balance_error < 1e-9);
      }
      CAPTURE(flow[0]);
      CAPTURE(flow[1]);
      CAPTURE(flow[2]);
      CHECK(std::abs(flow[1] / flow[2] - 1) < 0.01);
      CHECK(std::abs(flow[0] / flow[2] - 1) < 0.03);
    }
  }
}

// The film's smallest thickness is that of the land: the bearing's own where the narrowest place lies beside the pocket,
// at the pocket's border where it would lie within.
TEST_CASE("SmallestFilm_IsThatOfTheLand") {
  for (const auto surface : {Surface::shell, Surface::journal}) {
    for (const int n_phi : {60, 61, 120}) {
      FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {n_phi, 13}};
      m.p_edge_left = m.p_edge_right = 1e6;
      const Journal journal = turning(m, 0.5, 100);  // narrowest at phi = pi: 15 um
      m.features = {{.name = "pocket", .surface = surface, .phi = 1, .arc = 0.5, .length = 8e-3, .is_fed = false, .depth = 1e-4}};
      CHECK(solve_cold(m, journal).observed.h_min == doctest::Approx(15e-6).epsilon(1e-4));
      m.features[0].phi = pi + 0.1, m.features[0].length = 0.02;
      const FilmObservables o = solve_cold(m, journal).observed;
      // The nearer border lies 0.15 rad from the narrowest place.
      CHECK(o.h_min == doctest::Approx(30e-6 - 15e-6 * std::cos(0.15)).epsilon(0.003));
      CHECK(o.h_min_phi == doctest::Approx(pi - 0.15).epsilon(1e-3));
      CHECK(o.h_min_features == doctest::Approx(115e-6).epsilon(1e-2));
    }
  }
}

// Rate and wedge of a gap that travels around the bearing are the same oil: exactly, on any grid.
TEST_CASE("GapThatTravels_TakesInWhatItGivesAway") {
  for (const Grid& grid : {Grid{12, 5}, Grid{60, 5}, graded().grid}) {
    FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = grid};
    const double omega = 100;
    const Eigen::Vector2d e(9e-6, -14e-6);
    // Seen from the ground both surfaces turn at omega and the centre with them.
    const Journal journal{.e = e, .e_rate = omega * Eigen::Vector2d(-e.y(), e.x()), .omega_shell = omega, .omega_journal = omega};
    FlowBalance balance(m);
    balance.evaluate(surfaces(m, journal), {}, Eigen::VectorXd::Zero(grid.size()));
    CHECK(balance.balance().cwiseAbs().maxCoeff() < 1e-13 * omega * m.R * m.c * m.L);
  }
}

TEST_CASE("InterpolatedGaps_AreOfFourthOrder") {
  std::array<double, 2> face{}, cell{};
  for (int k = 0; k < 2; ++k) {
    FilmModel m{.R = 1, .L = 1, .c = 1, .grid = {k == 0 ? 40 : 80, 3}};
    const GridGeometry geometry(m);
    const GapInterpolation interpolation(m.grid, geometry);
    Eigen::VectorXd field(m.grid.size()), bends, excesses;
    for (int i = 0; i < m.grid.size(); ++i) field[i] = std::cos(3 * geometry.phi[i / 3]);
    interpolation.bends(field, bends);
    interpolation.excesses(field, excesses);
    const double half = 0.5 * geometry.dx[0];
    for (int i = 0; i < m.grid.n_phi; ++i) {
      const int here = m.grid.index(i, 1), next = m.grid.index((i + 1) % m.grid.n_phi, 1);
      const double at_face = 0.5 * (field[here] + field[next]) + bends[here], phi = geometry.phi[i];
      face[k] = std::max(face[k], std::abs(at_face - std::cos(3 * (phi + half))));
      const double mean = (std::sin(3 * (phi + half)) - std::sin(3 * (phi - half))) / (6 * half);
      cell[k] = std::max(cell[k], std::abs(field[here] + excesses[here] - mean));
    }
  }
  CHECK(std::log2(face[0] / face[1]) == doctest::Approx(4).epsilon(0.02));
  CHECK(std::log2(cell[0] / cell[1]) == doctest::Approx(4).epsilon(0.02));
}

}  // namespace
}  // namespace hersey::film
