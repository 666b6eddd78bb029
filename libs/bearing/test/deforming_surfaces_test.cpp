// Films between surfaces of elastic bodies: the gap they make, and the forces that go back to their shapes.
#include "gap/deforming_surfaces.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "hersey/bearing/journal_bearing.h"
#include "rough_film.h"

namespace hersey::bearing {
namespace deforming_surfaces_test {

constexpr double kSolved = 1e-8;  // films solved to 1e-10 of their largest throughput

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kShell = 3, kJournal = 2;

/// Unit amplitudes move the surface by up to 1.
std::shared_ptr<const ElasticSurface> random_surface(double width, Index amplitudes, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  ElasticSurface surface{SurfaceFunctions(9, 4, width), MatrixXd(36, amplitudes)};
  for (Index i = 0; i < surface.D.size(); ++i) surface.D.data()[i] = uniform(random);
  return std::make_shared<ElasticSurface>(surface);
}

BearingOptions between_elastic_surfaces(double width) {
  BearingOptions options;
  options.shell_surface = random_surface(width, kShell, 1);
  options.journal_surface = random_surface(width, kJournal, 2);
  return options;
}

mbd::RelativeMotion some_motion() {
  mbd::RelativeMotion motion;
  motion.dt = 1e-4;
  motion.X_AB = {rotation_exp({3e-4, -2e-4, 0.4}).toRotationMatrix(), {14e-6, -12e-6, 0}};
  motion.V_AB_A << 0.3, -0.2, 370, 4e-3, -9e-3, 0.05;
  motion.s = VectorXd::LinSpaced(kShell + kJournal, 1e-6, -2e-6);
  motion.s_rate = VectorXd::LinSpaced(kShell + kJournal, -2e-3, 3e-3);
  return motion;
}

/// [wrench on the journal; forces on shapes] with the film solved to the end at `motion`, from the filled state at
/// `start`.
VectorXd converged_forces(const mbd::RelativeMotion& start, const mbd::RelativeMotion& motion,
                          mbd::ForceResponse& response) {
  const film::FilmModel model = rough_film();
  JournalBearing bearing("b", model, between_elastic_surfaces(model.L));
  mbd::RelativeMotion at_start = start;
  at_start.dt = 0;
  bearing.evaluate(at_start, false, response);
  REQUIRE(bearing.domain_error().empty());
  bearing.accept_step(at_start);
  bearing.begin_step(start, motion.dt);
  for (int k = 0; k < 30; ++k) bearing.evaluate(motion, true, response);
  REQUIRE(bearing.internal_residual() < 1e-11);  // thirty iterations: as far as round-off lets it
  VectorXd forces(6 + response.Q.size());
  forces << response.W_B_A, response.Q;
  return forces;
}

VectorXd converged_forces(const mbd::RelativeMotion& start, const mbd::RelativeMotion& motion) {
  mbd::ForceResponse response;
  return converged_forces(start, motion, response);
}

/// A column of the tangent against differences between two motions, relative to its own size.
void compare(const VectorXd& column, const VectorXd& difference, double least) {
  for (const auto& [first, count] : {std::pair<Index, Index>{0, 3}, {3, 3}, {6, kShell + kJournal}}) {
    const Index begin = first;  // clang 14 captures no structured binding
    CAPTURE(begin);
    const double scale = std::max(column.segment(first, count).norm(), least);
    CHECK((column.segment(first, count) - difference.segment(first, count)).norm() <= 2e-4 * scale);
  }
}

TEST_CASE("TangentOfAFilmBetweenElasticSurfaces_MatchesFiniteDifferences") {
  const mbd::RelativeMotion motion = some_motion();
  mbd::ForceResponse response;
  const VectorXd forces = converged_forces(motion, motion, response);
  CHECK(response.Q.cwiseAbs().minCoeff() > 1);
  const auto difference = [&](const auto& move, double step) -> VectorXd {
    mbd::RelativeMotion plus = motion, minus = motion;
    move(plus, step);
    move(minus, -step);
    return (converged_forces(motion, plus) - converged_forces(motion, minus)) / (2 * step);
  };
  VectorXd column(forces.size());
  for (Index j = 0; j < 6; ++j) {
    CAPTURE(j);
    const auto turn = [&](mbd::RelativeMotion& m, double x) { m.X_AB = pose_exp(x * Vector6::Unit(j)) * m.X_AB; };
    column << response.dW_dX.col(j), response.dQ_dX.col(j);
    // What is small beside the whole counts as much of it.
    compare(column, difference(turn, j < 3 ? 1e-7 : 2e-9), 1e-4 * response.dW_dX.norm());
    const auto speed = [&](mbd::RelativeMotion& m, double x) { m.V_AB_A[j] += x; };
    column << response.dW_dV.col(j), response.dQ_dV.col(j);
    // What is small beside the whole counts as much of it.
    compare(column, difference(speed, j < 3 ? 1e-5 : 1e-7), 1e-6 * response.dW_dV.norm());
  }
  for (Index a = 0; a < kShell + kJournal; ++a) {
    CAPTURE(a);
    column << response.dW_ds.col(a), response.dQ_ds.col(a);
    compare(column, difference([&](mbd::RelativeMotion& m, double x) { m.s[a] += x; }, 2e-9), 0);
    column << response.dW_dr.col(a), response.dQ_dr.col(a);
    compare(column, difference([&](mbd::RelativeMotion& m, double x) { m.s_rate[a] += x; }, 1e-7), 0);
  }
}

TEST_CASE("GapOfElasticSurfaces_ChangesAtItsRate") {
  const film::FilmModel model = rough_film();
  const BearingOptions options = between_elastic_surfaces(model.L);
  DeformingSurfaces surfaces(model, options.shell_surface, options.journal_surface);
  const VectorXd s = VectorXd::LinSpaced(kShell + kJournal, 1, 2), rate = VectorXd::LinSpaced(kShell + kJournal, -3, 5);
  const double phi = 0.7, omega = 11, dt = 1e-6;
  const auto gap_at = [&](double t) {
    film::SurfaceMotion motion;
    motion.g = motion.g_rate = VectorXd::Zero(model.grid.size());
    surfaces.add_displacements(s + t * rate, rate, {.angle = phi + t * omega, .speed = omega}, motion);
    return motion;
  };
  const VectorXd numeric = (gap_at(dt).g - gap_at(-dt).g) / (2 * dt);
  const film::SurfaceMotion now = gap_at(0);
  CHECK((now.g_rate - numeric).norm() <
        1e-8 * numeric.norm());  // differences of step 1e-6 s: h^2, and round-off over h
  // A sum: round-off.
  CHECK((now.g - surfaces.shell_displacement(s) + surfaces.journal_displacement(s)).norm() < 1e-14 * now.g.norm());
}

TEST_CASE("ShellThatWidensEverywhere_IsAWiderBearing") {
  film::FilmModel narrow = rough_film(), wide = rough_film();
  const double widening = 3e-6;
  wide.c += widening;
  // The clearance also scales how strongly the pressure of a supply line is prescribed.
  for (film::FilmModel* model : {&narrow, &wide}) {
    model->supply.kind = film::SupplyKind::none;
    model->edge_left.pressure = model->edge_right.pressure = 2e5;
  }
  ElasticSurface bore{SurfaceFunctions(9, 4, narrow.L), MatrixXd::Ones(36, 1)};
  JournalBearing elastic("b", narrow, {.shell_surface = std::make_shared<ElasticSurface>(bore)}), rigid("b", wide);
  mbd::RelativeMotion motion = some_motion();
  motion.dt = 0;
  motion.s.resize(0);
  motion.s_rate.resize(0);
  mbd::ForceResponse of_elastic, of_rigid;
  rigid.evaluate(motion, false, of_rigid);
  motion.s = VectorXd::Constant(1, widening);
  motion.s_rate = VectorXd::Zero(1);
  elastic.evaluate(motion, false, of_elastic);
  elastic.accept_step(motion);
  CHECK((of_elastic.W_B_A - of_rigid.W_B_A).norm() < kSolved * of_rigid.W_B_A.norm());
  CHECK(of_elastic.Q[0] == doctest::Approx(elastic.observe(motion).film.normal_forces.sum()).epsilon(kSolved));
}

/// A smooth isoviscous film on a fine grid.
film::FilmModel fine_film() {
  film::FilmModel model;
  model.R = 0.03, model.L = 0.02, model.c = 40e-6;
  model.grid = {.n_phi = 180, .n_z = 41};
  model.supply = {.kind = film::SupplyKind::fixed_angle, .phi = 2, .pressure = 2e5};
  return model;
}

/// A bore that ovalises and bends by some tenths of the clearance for amplitudes of 1e-6.
std::shared_ptr<const ElasticSurface> big_end_bore(double width) {
  ElasticSurface surface{SurfaceFunctions(24, 4, width), MatrixXd(96, 2)};
  for (Index j = 0; j < 96; ++j) {
    const double phi = 2 * std::numbers::pi * static_cast<double>(j % 24) / 24, along = static_cast<double>(j / 24);
    surface.D(j, 0) = 8 * std::cos(2 * phi - 0.5);
    surface.D(j, 1) = 2 * std::sin(3 * phi) + 0.4 * along * std::cos(2 * phi + 1);
  }
  return std::make_shared<ElasticSurface>(surface);
}

/// The film's answer to `motion`, kept for a step.
BearingObservation observation_of(JournalBearing& bearing, mbd::RelativeMotion motion) {
  mbd::ForceResponse response;
  const double dt = std::exchange(motion.dt, 0.0);
  bearing.evaluate(motion, false, response);
  REQUIRE(bearing.domain_error().empty());
  bearing.accept_step(motion);
  bearing.begin_step(motion, dt);
  motion.dt = dt;
  for (int k = 0; k < 30; ++k) bearing.evaluate(motion, true, response);
  REQUIRE(bearing.internal_residual() < 1e-10);  // the tolerance of a film
  bearing.accept_step(motion);
  return bearing.observe(motion);
}

mbd::RelativeMotion turning_journal(Index amplitudes) {
  mbd::RelativeMotion motion;
  motion.dt = 1;  // a film that has settled
  motion.X_AB = {rotation_exp({1e-4, -2e-4, 0.4}).toRotationMatrix(), {14e-6, -17e-6, 0}};
  motion.V_AB_A.head<3>() = 300 * motion.X_AB.R.col(2);
  motion.V_AB_A.tail<3>() = -motion.V_AB_A.head<3>().cross(motion.X_AB.r);  // its axis rests
  motion.s = VectorXd::Zero(amplitudes);
  motion.s_rate = VectorXd::Zero(amplitudes);
  return motion;
}

// The journal is round: oil shears it and has no other moment about its axis. Its torque follows from pressure and
// thickness alone; the bore's shape enters through the film's wrench on the shell.
TEST_CASE("TorqueOnADeformedBore_IsThatOfTheSurface") {
  const film::FilmModel model = fine_film();
  const film::Grid& grid = model.grid;
  JournalBearing bearing("b", model, {.shell_surface = big_end_bore(model.L)});
  mbd::RelativeMotion motion = turning_journal(2);
  motion.s << 1e-6, -1e-6;
  const BearingObservation observed = observation_of(bearing, motion);
  const film::FilmFields fields = bearing.fields();
  const double dphi = 2 * std::numbers::pi / grid.n_phi, dz = model.L / (grid.n_z - 1);
  const double slip = model.R * motion.V_AB_A[2];
  double torque = 0;
  for (int k = 0; k < grid.size(); ++k) {
    const int i = k / grid.n_z, j = k % grid.n_z;
    const double simpson = (j == 0 || j == grid.n_z - 1 ? 1 : j % 2 == 1 ? 4 : 2) / 3.0;
    const double rise =
        fields.p[grid.index((i + 1) % grid.n_phi, j)] - fields.p[grid.index((i + grid.n_phi - 1) % grid.n_phi, j)];
    torque -= simpson * dz * model.R *
              (model.R * dphi * fields.theta[k] * model.lubricant.mu0 * slip / fields.h[k] + 0.25 * fields.h[k] * rise);
  }
  // What was left out before: some per cent.
  double slopes = 0;
  for (int k = 0; k < grid.size(); ++k) {
    const int i = k / grid.n_z, j = k % grid.n_z;
    slopes += 0.5 * dz * model.R * fields.p[k] *
              (fields.d_shell[grid.index((i + 1) % grid.n_phi, j)] -
               fields.d_shell[grid.index((i + grid.n_phi - 1) % grid.n_phi, j)]);
  }
  CHECK(std::abs(slopes) > 0.01 * std::abs(torque));
  CHECK(observed.film.torque_journal == doctest::Approx(torque).epsilon(2e-3));
  CHECK(-observed.power_into_bodies == doctest::Approx(observed.film.power_taken()).epsilon(2e-3));
  CHECK(-observed.power_into_bodies == doctest::Approx(-torque * 300).epsilon(2e-3));
}

// Everything moves: what the bodies put in by wrench and forces on shapes is what the film's integrals say.
TEST_CASE("PowerPutInByBodiesThatDeform_IsWhatTheFilmTakes") {
  film::FilmModel model = fine_film();
  model.grid = {.n_phi = 120, .n_z = 25};
  model.lubricant.viscosity_law = film::Barus{1.5e-8};
  model.asperities = {.model = film::AsperityModel::greenwood_tripp_exact,
                      .sigma = 5e-6,
                      .elastic_factor = 3e-3,
                      .composite_modulus = 57e9,
                      .mu_friction = 0.1};
  for (const double compliance : {0.0, 2e-13}) {
    CAPTURE(compliance);
    model.compliance = compliance;
    JournalBearing bearing("b", model,
                           {.shell_surface = big_end_bore(model.L), .journal_surface = big_end_bore(model.L)});
    mbd::RelativeMotion motion = turning_journal(4);
    motion.dt = 1e-5;
    motion.V_AB_A += (Vector6() << 0.1, -0.2, 0, 4e-3, -9e-3, 0).finished();
    motion.s << 0.5e-6, -0.6e-6, 0.2e-6, 0.3e-6;
    motion.s_rate << 1e-3, 4e-4, -1e-3, 3e-4;
    const BearingObservation observed = observation_of(bearing, motion);
    CHECK(observed.film.power_asperity > 0.1);
    CHECK(-observed.power_into_bodies == doctest::Approx(observed.film.power_taken()).epsilon(5e-3));
  }
}

}  // namespace deforming_surfaces_test
}  // namespace hersey::bearing
