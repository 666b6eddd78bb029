#include <doctest/doctest.h>

#include <array>

#include "film_cases.h"
#include "relative.h"

// One bearing seen from different frames, action and reaction, and the balance of power.
namespace hersey::film {
namespace invariance_test {

FilmModel flooded(int n_phi, int n_z) {
  FilmModel m{.R = 0.03, .L = 0.03, .c = 30e-6, .grid = {n_phi, n_z}};
  m.edge_left.pressure = m.edge_right.pressure = 5e7;  // full film everywhere: smooth, so that orders can be measured
  return m;
}

// In the frame of the ground the shell rotates at omega_shell and the journal at omega_journal while the centre moves.
// In a grid that rotates at omega_grid speeds are less by its own, and the centre's velocity by omega_grid x e.
Journal seen_from(const Journal& ground, double omega_grid) {
  Journal j = ground;
  j.omega_shell -= omega_grid;
  j.omega_journal -= omega_grid;
  j.e_rate -= omega_grid * Eigen::Vector2d(-ground.e.y(), ground.e.x());
  return j;
}

const Journal swinging{.e = {8e-6, -13e-6}, .e_rate = {0.002, 0.004}, .omega_shell = 90, .omega_journal = 250};

TEST_CASE("FilmForces_DoNotDependOnTheFrame") {
  // Wedge and squeeze of a round journal are the same oil to round-off, on any grid.
  for (const int n : {12, 48}) {
    const FilmModel m = flooded(n, 13);
    const Vector6 ground = solve_cold(m, swinging).wrench;
    for (const double omega : {swinging.omega_shell, swinging.omega_journal, 33.0}) {
      const Vector6 turning_grid = solve_cold(m, seen_from(swinging, omega)).wrench;
      // The tolerance is the solver's, rtol 1e-10.
      CHECK((turning_grid - ground).tail<3>().norm() < 1e-10 * ground.tail<3>().norm());
    }
  }
}

TEST_CASE("CavitatedFilmForces_DoNotDependOnTheFrame") {
  FilmModel m = flooded(60, 13);
  m.cavitation = Cavitation::reynolds;
  m.edge_left.pressure = m.edge_right.pressure = 0;
  const Vector6 ground = solve_cold(m, swinging).wrench;
  const Vector6 shell = solve_cold(m, seen_from(swinging, swinging.omega_shell)).wrench;
  CHECK((shell - ground).tail<3>().norm() < 1e-8 * ground.tail<3>().norm());  // what Newton leaves
}

TEST_CASE("CarriedOil_DoesNotDependOnTheFrame") {
  // Shell and journal rotate together: in their own frame nothing moves, while in a grid fixed to the ground the fill
  // fraction is carried around. A partly cavitated film keeps its fill fraction in both; the upwind transport smears it
  // with first order in the step.
  FilmModel m{.R = 0.03, .L = 0.01, .c = 30e-6, .grid = {360, 3}};
  m.edge_left.kind = m.edge_right.kind = EdgeKind::closed;
  const double omega = 100, dt = 2 * pi / m.grid.n_phi / omega;  // one node per step
  Eigen::VectorXd fill(m.grid.size());
  for (int i = 0; i < m.grid.n_phi; ++i) {
    for (int j = 0; j < 3; ++j) fill[m.grid.index(i, j)] = 0.5 + 0.3 * std::cos(2 * pi * i / m.grid.n_phi);
  }
  Reynolds reynolds(m);
  FilmHistory history{dt, fill, Eigen::VectorXd::Zero(m.grid.size())};
  const SurfaceMotion motion = surfaces(m, {.omega_shell = omega, .omega_journal = omega});
  Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  const int steps = 45;
  for (int s = 0; s < steps; ++s) {
    REQUIRE(solve_film(reynolds, motion, history, {}, u).solved());
    history.theta = film_fields(m, motion, u).theta;
  }
  double worst = 0;
  for (int i = 0; i < m.grid.n_phi; ++i) {
    const double carried = 0.5 + 0.3 * std::cos(2 * pi * (i - steps) / m.grid.n_phi);
    worst = std::max(worst, std::abs(history.theta[m.grid.index(i, 1)] - carried));
  }
  CHECK(worst < 0.3 * steps * std::pow(2 * pi / m.grid.n_phi, 2));  // numerical diffusion D t with D = U dx per step
}

TEST_CASE("MirroredBearing_MirrorsItsForces") {
  FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {60, 9}};
  m.supply = {SupplyKind::widest_gap, 0, 0};
  const Journal one{.e = {-20e-6, 0}, .tilt = {3e-4, 2e-4}, .omega_journal = 200};
  const Journal mirrored{.e = {-20e-6, 0}, .tilt = {3e-4, -2e-4}, .omega_journal = -200};
  const SolvedFilm a = solve_cold(m, one), b = solve_cold(m, mirrored);
  Vector6 expected = a.wrench;  // y -> -y: forces mirror as vectors, moments as axial vectors
  expected[0] *= -1, expected[2] *= -1, expected[4] *= -1;
  // The tolerance is the solver's, rtol 1e-10, in a film with weak spots.
  CHECK((b.wrench - expected).norm() < 1e-9 * a.wrench.norm());
}

TEST_CASE("FrictionTorques_DifferByForceTimesEccentricity") {
  const FilmModel m = flooded(60, 13);
  const SolvedFilm film = solve_cold(m, swinging);
  const double couple = swinging.e.x() * film.wrench[4] - swinging.e.y() * film.wrench[3];
  // Identity of the two definitions: round-off.
  CHECK(film.observed.torque_journal + film.observed.torque_shell == relative(couple).epsilon(1e-12));
}

// Power the bodies put in = power dissipated, in a full film whose edges are at one pressure. The net force of shear
// does work on the centre's velocity that the film's speeds leave out: c/R. Without it the rest is the grid's.
TEST_CASE("MechanicalPower_IsDissipated") {
  const auto error = [](ShearForce shear_force, int n_phi, int n_z) {
    FilmModel m = flooded(n_phi, n_z);
    m.shear_force = shear_force;
    const SolvedFilm film = solve_cold(m, swinging);
    const Eigen::Vector2d force = film.wrench.segment<2>(3);
    // The journal is subject to -force along the centre's velocity and the torque about its own axis; the shell to its
    // torque.
    const double bodies = -force.dot(swinging.e_rate) + film.observed.torque_journal * swinging.omega_journal +
                          film.observed.torque_shell * swinging.omega_shell;
    // Pushing oil out against the edge pressure is no dissipation: a constant pressure does no net work here, as the
    // volume under a moving round journal does not change. Rates are means over control volumes there and nodal here.
    CHECK(std::abs(film.observed.power_oil + film.observed.power_stored) < 2e-4 * film.observed.power_film);
    return std::abs(bodies + film.observed.power_film) / film.observed.power_film;
  };
  CHECK(error(ShearForce::full, 60, 13) < 3e-4);
  const double coarse = error(ShearForce::torque_only, 60, 13), fine = error(ShearForce::torque_only, 120, 25);
  CHECK(coarse < 2e-4);
  CHECK(fine < 0.3 * coarse);
}

TEST_CASE("AsperityFriction_OpposesSlidingAndDissipates") {
  FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {120, 9}};
  m.supply = {SupplyKind::widest_gap, 0, 0};
  m.asperities = {AsperityModel::greenwood_tripp_fit, 1e-6, 3e-3, 57e9, 0.1};
  const double omega = 50;
  const SolvedFilm with = solve_cold(m, turning(m, 0.95, omega));
  m.asperities.mu_friction = 0;
  const SolvedFilm without = solve_cold(m, turning(m, 0.95, omega));
  const double torque = with.observed.torque_shell - without.observed.torque_shell;
  CHECK(torque > 0);
  // Power of boundary friction = torque on the shell times relative speed.
  CHECK(with.observed.power_asperity == doctest::Approx(torque * omega).epsilon(1e-3));  // 1 mm/s of smoothing, 1.5 m/s
  CHECK(with.observed.force_asperity.x() < 0);  // pushes the shell towards the contact, at -x
}

}  // namespace invariance_test
}  // namespace hersey::film
