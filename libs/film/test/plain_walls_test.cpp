#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <memory>

#include "film_over_time.h"
#include "heat/layering.h"
#include "hersey/film/grid_transfer.h"
#include "relative.h"

// Walls that keep their shape, networks and scales in another order, and figures of a film before its first step.
namespace hersey::film {
namespace plain_walls_test {

constexpr double round_off = 1e-12;  // of sums and products of a few numbers

FilmModel bearing() { return small_bearing_with_hole(0.7, 24, 7); }

const Journal loaded{.e = {15e-6, 8e-6}, .omega_journal = 300};

TEST_CASE("FirstGuess_IsNoWarmerThanOilThatDoesNotThin") {
  const FilmModel model = bearing();
  for (const double rise : {0.0, 0.2}) {
    CAPTURE(rise);
    auto body = std::make_shared<JournalConduction>();
    body->T0 = 300, body->rise = rise;
    ThermalModel thermal = supplied_at_40(3);
    thermal.journal = BodyJournal{.conduction = body};
    HeatState image = FilmHeat(model, thermal).state();
    image.film.setConstant(thermal.T_supply - 5);
    image.film[7] = thermal.T_supply + 30;
    image.journal = thermal.T_supply + 20;
    const HeatState guess = first_guess(model, thermal, thermal.T_supply, image);
    CHECK(guess.film[3] == image.film[3]);  // colder than what comes: nothing that oil has made
    CHECK(guess.film[7] > thermal.T_supply);
    CHECK(guess.film[7] < image.film[7]);
    if (rise == 0) CHECK(guess.journal == image.journal);  // as its body is, whatever the oil gives it
    if (rise == 0) continue;
    CHECK(guess.journal < image.journal);
    CHECK(body->temperature(guess.journal_heat) == relative(guess.journal).epsilon(round_off));
  }
}

TEST_CASE("WallsThatKeepTheirShape_HaveNone") {
  const FilmModel model = bearing();
  ThermalModel thermal = supplied_at_40(3);
  thermal.shell = RingWall{.outer_radius = 0.04};
  const FilmHeat ring(model, thermal);
  auto wall = std::make_shared<WallConduction>();
  wall->T0.setConstant(model.grid.n_phi, 310);
  wall->rise = 0.1 * Eigen::MatrixXd::Identity(model.grid.n_phi, model.grid.n_phi);
  wall->T_body0 = Eigen::Vector2d(305, 310);
  wall->rise_body = Eigen::MatrixXd::Constant(2, model.grid.n_phi, 0.05);
  auto shaft = std::make_shared<JournalConduction>();
  shaft->T0 = 310, shaft->rise = 0.1;
  shaft->T_body0 = Eigen::Vector2d(305, 310), shaft->rise_body = Eigen::Vector2d(0.05, 0.1);
  thermal.shell = BodyWall{.conduction = wall};
  thermal.journal = BodyJournal{.conduction = shaft};
  FilmHeat bodies(model, thermal);
  for (const FilmHeat* heat : {&ring, static_cast<const FilmHeat*>(&bodies)}) {
    CHECK(heat->shell_opening().size() == 0);
    CHECK(heat->shell_opening_in_time().size() == 0);
    CHECK(heat->journal_growth().size() == 0);
    CHECK(heat->journal_growth_in_time().size() == 0);
  }
  CHECK(ring.body_temperatures().size() == 0);
  CHECK(ring.journal_body_temperatures().size() == 0);
  // Their temperatures follow the heat all the same: 24 angles of 2 W, and 10 W.
  HeatState state = bodies.state();
  state.wall_heat.setConstant(2), state.journal_heat = 10;
  bodies.set_state(state);
  CHECK((bodies.body_temperatures() - Eigen::Vector2d(305 + 2.4, 310 + 2.4)).norm() < 310 * round_off);
  CHECK((bodies.journal_body_temperatures() - Eigen::Vector2d(305.5, 311)).norm() < 310 * round_off);
  const WallConduction observed = on_grid(*wall, model.grid, resampled(model.grid, 12, 5));
  CHECK(!observed.deforms());
  CHECK((observed.body(Eigen::VectorXd::Constant(12, 4)) - bodies.body_temperatures()).norm() < 310 * round_off);
}

// The hottest of a body's nodes by the heat that has settled it; before, as warm everywhere.
TEST_CASE("HottestOfBodies_IsThatOfTheirNodes") {
  const FilmModel model = bearing();
  auto wall = std::make_shared<WallConduction>();
  wall->T0.setConstant(model.grid.n_phi, 310);
  wall->rise = 0.5 * Eigen::MatrixXd::Identity(model.grid.n_phi, model.grid.n_phi);
  wall->T_body0 = Eigen::Vector2d(305, 310);
  wall->rise_body = Eigen::MatrixXd::Constant(2, model.grid.n_phi, 0.05);
  auto shaft = std::make_shared<JournalConduction>();
  shaft->T0 = 310, shaft->rise = 0.1;
  ThermalModel thermal = supplied_at_40(3);
  thermal.shell = BodyWall{.conduction = wall, .T_start = 320};
  thermal.journal = BodyJournal{.conduction = shaft};
  FilmOverTime steady(model, thermal, loaded), step(model, thermal, loaded);
  steady.advance(0), step.advance(1e-3);
  CHECK(steady.heat.observables().T_body_max == steady.heat.body_temperatures().maxCoeff());
  CHECK(step.heat.observables().T_body_max == 320);
}

// A journal that is a node sets the film's temperature beside every kind of shell.
TEST_CASE("NodeBesideAShellWithoutHeat_SetsTheFilmsTemperature") {
  const FilmModel model = bearing();
  ThermalModel thermal = supplied_at_40(3);
  thermal.journal = NodeWall{.T = 320, .node = 0, .name = "shaft"};
  FilmOverTime film(model, thermal, loaded), other(model, thermal, loaded);
  film.advance(1e-3);
  const WallHeatFlow observed = film.heat.heat_flow();
  Eigen::VectorXd T = observed.T;
  T[1] += 10;
  film.heat.move_walls(T);
  HeatState begin = other.heat.state();
  begin.journal = T[1];
  other.heat.set_state(begin);
  other.advance(1e-3);
  CHECK(film.heat.state().journal == T[1]);
  // K; a step's systems are solved to 1e-7 of an answer of some 10 K.
  CHECK((film.heat.state().film - other.heat.state().film).cwiseAbs().maxCoeff() < 1e-5);
}

// Shear thinning is that of the last film: a second call changes nothing, and an oil that does not thin has none.
TEST_CASE("ThinningOfTheSameFilm_IsTheSame") {
  FilmModel model = bearing();
  const SurfaceMotion motion = surfaces(model, loaded);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model.grid.size());
  Reynolds reynolds(model);
  REQUIRE(solve_film(reynolds, motion, {}, {}, u).solved());
  for (const bool thins : {false, true}) {
    CAPTURE(thins);
    if (thins) model.lubricant.shear_thinning = {.law = Carreau{.limit = 0.3, .exponent = 0.6}, .critical_rate = 1e5};
    const ThermalModel thermal = supplied_at_40(3);
    FilmHeat heat(model, thermal);
    FilmHistory history;
    history.viscosity = heat.viscosity();
    heat.advance(motion, history, u);
    const double first = heat.thin(motion, history, u), second = heat.thin(motion, history, u);
    CHECK((first > 0 || !thins));
    CHECK(second <= 1e-8);  // Newton's changes of 1e-4 leave their square
    Archive saved;
    heat.persist(saved);
    FilmHeat restored(model, thermal);
    Archive content(saved.content());
    restored.persist(content);
    CHECK(content.unread().empty());
    CHECK(restored.viscosity().fluidity == heat.viscosity().fluidity);
  }
}

// A path has no direction.
TEST_CASE("PathsOfANetwork_MayBeNamedFromEitherEnd") {
  CHECK(NetworkObservables{}.error() == 0);  // of no heat at all
  std::array<Eigen::VectorXd, 2> T;
  std::array<double, 2> to_fixed{};
  for (const std::size_t k : {0U, 1U}) {
    const ThermalPath there{"cooler", 0, 1, 5.0}, back{"cooler", 1, 0, 5.0};
    ThermalNetwork network(
        {.nodes = {{"block", 100, 340, false}, {"air", 0, 300, true}}, .paths = {k == 0 ? there : back}});
    network.advance(2, {});
    T[k] = network.observables().T, to_fixed[k] = network.observables().to_fixed;
  }
  CHECK(T[0] == T[1]);
  CHECK(to_fixed[0] == to_fixed[1]);
  CHECK(to_fixed[0] > 0);
}

TEST_CASE("OneLayer_HasNoSlope") {
  CHECK(layering_of(1).slope(0, [](std::size_t) { return 3.0; }) == 0);
}

TEST_CASE("RotatedGrid_HasItsLinesBetweenTheFormerOnes") {
  const Grid grid = graded_grid(24, 9, {{.position = 1, .reach = 0.5, .factor = 4}}, {});
  CHECK(Grid{24, 9}.is_uniform());
  CHECK(!grid.is_uniform());
  CHECK(!graded_grid(24, 9, {}, {{.position = 0.5, .reach = 0.1, .factor = 4}}).is_uniform());
  const Grid same = turned(grid, 0), other = turned(grid, 0.25);
  for (int i = 0; i < grid.n_phi; ++i) {
    const double next = i + 1 < grid.n_phi ? grid.phi(i + 1) : grid.phi(0) + 2 * pi;
    CHECK(same.phi(i) == grid.phi(i));
    CHECK(other.phi(i) - grid.phi(i) == relative(0.25 * (next - grid.phi(i))).epsilon(1e-9));  // differences of angles
  }
}

// Pressures counted from a vacuum press the liner by what they are above the atmosphere.
TEST_CASE("ScaleOfPressures_ChangesNoFilm") {
  constexpr double atmosphere = 101325;
  std::array<SolvedFilm, 2> films;
  for (const std::size_t k : {0U, 1U}) {
    FilmModel m = bearing();
    m.compliance = 2e-3 / 5e9;
    const double zero = k == 0 ? 0 : atmosphere;
    if (k == 1) m.pressures = PressureScale::absolute;
    m.p_cav += zero, m.features[0].pressure += zero;
    m.edge_left.pressure += zero, m.edge_right.pressure += zero;
    films[k] = solve_cold(m, loaded);
    REQUIRE(films[k].summary.solved());
  }
  CHECK((films[1].fields.h - films[0].fields.h).norm() < 1e-7 * films[0].fields.h.norm());         // residuals of 1e-10
  CHECK(films[1].observed.p_max - atmosphere == relative(films[0].observed.p_max).epsilon(1e-7));  // likewise
}

TEST_CASE("PressureOfAFeature_MayBeGivenWithTheMotion") {
  FilmModel m = bearing();
  SurfaceMotion motion = surfaces(m, loaded);
  motion.feature_pressure = Eigen::VectorXd::Constant(1, 4e5);
  const SolvedFilm by_motion = solve_cold(m, motion, loaded.e);
  m.features[0].pressure = 4e5;
  const SolvedFilm by_model = solve_cold(m, loaded);
  CHECK(by_motion.u == by_model.u);
  CHECK(by_motion.observed.flow_supply == by_model.observed.flow_supply);
}

// The wrench does not depend on the presence of shapes on which the film pushes, too.
TEST_CASE("FilmWithoutShapes_IsCondensedToTheSameWrench") {
  const FilmModel m = bearing();
  const SurfaceMotion motion = surfaces(m, loaded);
  const Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  const std::vector<MotionDirection> directions{{.g = Eigen::VectorXd::Constant(m.grid.size(), 1e-6)},
                                                {.u_journal = 1}};
  for (const LinearSolver linear : {LinearSolver::direct, LinearSolver::multigrid}) {
    Reynolds reynolds(m, linear);
    REQUIRE(reynolds.linearise(motion, {}, u).is_inside());
    CondensedFilm plain, shaped;
    SurfaceShapes shapes = SurfaceShapes::none(m.grid.size());
    reynolds.condense(directions, shapes, plain);
    shapes.openings.setOnes(m.grid.size(), 1);
    shapes.surfaces.push_back({shapes.openings.sparseView(), {}, Eigen::MatrixXd::Ones(1, 1), false});
    reynolds.condense(directions, shapes, shaped);
    CHECK(plain.Q.size() == 0);
    CHECK((plain.wrench - shaped.wrench).norm() < 1e-9 * shaped.wrench.norm());  // the solver leaves 1e-10
    CHECK((plain.wrench_by_s - shaped.wrench_by_s.leftCols(2)).norm() < 1e-9 * shaped.wrench_by_s.norm());  // likewise
  }
}

// Fields keep their positions between rings whose lines lie elsewhere, in either direction.
TEST_CASE("FieldBetweenRotatedRings_KeepsItsPosition") {
  const Grid one{36, 5}, other = turned(Grid{24, 7}, 0.5);
  for (const bool backwards : {false, true}) {
    CAPTURE(backwards);
    const Grid &from = backwards ? other : one, &to = backwards ? one : other;
    const auto field = [](const Grid& grid) {
      Eigen::VectorXd values(grid.size());
      for (int k = 0; k < grid.size(); ++k)
        values[k] = std::cos(grid.phi(k / grid.n_z)) + 3 * grid.z_over_L(k % grid.n_z);
      return values;
    };
    const Eigen::VectorXd there = GridTransfer::by_position(from, to)(field(from), 1);
    const double step = 2 * pi / from.n_phi;
    CHECK((there - field(to)).cwiseAbs().maxCoeff() < step * step / 8);  // of straight lines along a cosine
  }
}

}  // namespace plain_walls_test
}  // namespace hersey::film
