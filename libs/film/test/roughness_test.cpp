#include <doctest/doctest.h>

#include <array>

#include "film_cases.h"
#include "gap/flow_factors.h"

// Oil between rough surfaces: flow factors in the film.
namespace hersey::film {
namespace roughness_test {

Roughness rough(SurfaceRoughness shell, SurfaceRoughness journal) { return {FlowFactors::patir_cheng, shell, journal}; }

/// Full everywhere: both edges far above the cavitation pressure.
FilmModel full_bearing(int n_phi, int n_z) {
  FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {n_phi, n_z}};
  m.edge_left.pressure = m.edge_right.pressure = 5e7;
  return m;
}

// An inclined slider without side flow, rough like sandpaper or with ridges on either surface: dp/dx follows from the
// flow, p from its integral.
TEST_CASE("RoughSlider_ConvergesToTheIntegralWithOrderTwo") {
  const double length = 0.03, U = 2, mu = 0.02, h0 = 4e-6, h1 = 9e-6;
  for (const Roughness& roughness :
       {rough({1e-6, 1}, {0, 1}), rough({0, 1}, {1e-6, 1}), rough({1e-6, 1.0 / 9}, {1e-6, 6})}) {
    const double sigma = roughness.composite_sigma();
    const auto gap = [&](double x) { return h1 + (h0 - h1) * x / length; };
    // q = -phi h^3/(12 mu) p' + U/2 h_T - U/2 sigma phi_s, the journal moving.
    const double s2 = std::pow(roughness.shell.sigma / sigma, 2), j2 = 1 - s2;
    const PatirCheng both(std::exp(s2 * std::log(roughness.shell.gamma) + j2 * std::log(roughness.journal.gamma)));
    const PatirCheng shell(roughness.shell.gamma), journal(roughness.journal.gamma);
    const int fine = 20000;
    const auto integrals = [&](const std::function<void(double, double, double, double)>& add) {
      for (int k = 0; k < fine; ++k) {
        const double x = length * (k + 0.5) / fine, H = gap(x) / sigma;
        const double phi_s = s2 * shell.shear(H).value - j2 * journal.shear(H).value;
        const double carried = U / 2 * sigma * (mean_gap(H).value - phi_s);
        add(x, 12 * mu / (both.pressure(H).value * std::pow(gap(x), 3)), carried, length / fine);
      }
    };
    double resistance = 0, driven = 0, load = 0;
    integrals([&](double, double r, double carried, double dx) { resistance += r * dx, driven += r * carried * dx; });
    const double q = driven / resistance;
    integrals([&](double x, double r, double carried, double dx) { load -= x * r * (carried - q) * dx; });

    std::array<double, 2> load_error{}, flow_error{};
    for (int k = 0; k < 2; ++k) {
      const int n = 60 << k, grooves = 4, all = n + 2 * grooves;
      const double dx = length / n, cell = 2 * pi / all;
      FilmModel m{.R = all * dx / (2 * pi), .L = 0.01, .c = h0, .grid = {all, 3}, .lubricant = {.mu0 = mu}};
      m.edge_left.kind = m.edge_right.kind = EdgeKind::closed;
      m.roughness = roughness;
      m.features = {{.name = "in", .phi = -0.5 * (grooves - 0.5) * cell, .arc = (grooves - 0.5) * cell, .length = m.L},
                    {.name = "out", .phi = (n + 0.5 * grooves) * cell, .arc = grooves * cell, .length = m.L}};
      SurfaceMotion motion = surfaces(m, {});
      motion.u_journal = U;
      for (int i = 0; i < all; ++i) {
        // The slider's own gap extends into the grooves as far as it affects the ends.
        const double g = i <= n + 2 ? gap(i * dx) : i == all - 1 ? gap(-dx) : h0;
        motion.g.segment(m.grid.index(i, 0), 3).setConstant(g);
      }
      const SolvedFilm film = solve_cold(m, motion, {0, 0});
      REQUIRE(film.summary.solved());
      CHECK(film.observed.mass_balance_error < 1e-9);  // the solver's tolerance is 1e-10 per node
      double found = 0;
      for (int i = 0; i <= n; ++i) found += film.fields.p[m.grid.index(i, 1)] * dx;
      load_error[k] = found / load - 1;
      // Flow into the outlet: fed flows plus the entrained flow between both grooves.
      const double H = h0 / sigma;
      const double phi_s = s2 * shell.shear(H).value - j2 * journal.shear(H).value;
      const double between = U / 2 * sigma * (mean_gap(H).value - phi_s);
      flow_error[k] = (film.observed.flow_features[0] / m.L + between) / q - 1;
    }
    CHECK(std::abs(load_error[1]) < 2e-3);
    CHECK(std::log2(load_error[0] / load_error[1]) == doctest::Approx(2).epsilon(0.05));
    CHECK(std::log2(flow_error[0] / flow_error[1]) == doctest::Approx(2).epsilon(0.05));
  }
}

// A moving rough surface carries oil in its valleys, one at rest retains it; equal surfaces cancel.
TEST_CASE("RoughnessInMotion_CarriesOil") {
  const auto load = [](const Roughness& roughness) {
    FilmModel m = full_bearing(120, 25);
    m.roughness = roughness;
    return solve_cold(m, turning(m, 0.7, 200)).wrench.segment<2>(3).norm();
  };
  const double both = load(rough({1e-6, 1}, {1e-6, 1})), shell = load(rough({std::sqrt(2) * 1e-6, 1}, {0, 1}));
  const double journal = load(rough({0, 1}, {std::sqrt(2) * 1e-6, 1}));
  // Where phi_s falls with the gap, the entrained flow h_T -+ sigma phi_s converges more for the shell and less for the
  // journal.
  CHECK(shell > 1.01 * both);
  CHECK(journal < 0.99 * both);
  CHECK(0.5 * (shell + journal) == doctest::Approx(both).epsilon(1e-3));  // the full film is linear in phi_s
}

// Ridges across the flow raise the pressure of a long bearing, ridges along it reduce it. A short bearing loses its oil
// sideways, and the effect is reversed. The smooth film is the limit of all.
TEST_CASE("FineRoughness_TendsToTheSmoothFilm") {
  const auto load = [](double sigma, double gamma, bool is_long) {
    FilmModel m = full_bearing(120, is_long ? 3 : 25);
    if (is_long) m.edge_left.kind = m.edge_right.kind = EdgeKind::closed, m.supply = {SupplyKind::fixed_angle, 0, 5e7};
    if (sigma > 0) m.roughness = rough({sigma, gamma}, {sigma, gamma});
    return solve_cold(m, turning(m, 0.7, 200)).wrench.segment<2>(3).norm();
  };
  for (const bool is_long : {true, false}) {
    CAPTURE(is_long);
    const double smooth = load(0, 1, is_long);
    for (const double gamma : {1.0 / 9, 1.0, 9.0}) {
      CAPTURE(gamma);
      const auto change = [&](double sigma) { return load(sigma, gamma, is_long) / smooth - 1; };
      double before = change(1.5e-6);
      CHECK(std::abs(before) > 0.01);
      if (gamma != 1) CHECK((before > 0) == ((gamma < 1) == is_long));
      for (const double sigma : {0.7e-6, 0.3e-6, 0.1e-6}) {
        const double now = change(sigma);
        CHECK(std::abs(now) < 0.5 * std::abs(before) + 1e-6);  // the solver's tolerance in the end
        before = now;
      }
      CHECK(std::abs(before) < 2e-3);  // ridges along the flow have the longest tail, H^-1.5
    }
  }
  // Roughness of zero height is exactly smooth.
  FilmModel m = full_bearing(60, 13);
  const Vector6 plain = solve_cold(m, turning(m, 0.7, 200)).wrench;
  m.roughness = rough({0, 1}, {0, 1});
  CHECK((solve_cold(m, turning(m, 0.7, 200)).wrench - plain).norm() == 0);
}

// Power the bodies put in = power dissipated (film.47), as between smooth surfaces: what is left there are the grid's
// error and c/R. The gaps are above 7 sigma.
TEST_CASE("MechanicalPowerBetweenRoughSurfaces_IsDissipated") {
  const Journal journal{.e = {8e-6, 11e-6}, .e_rate = {0.01, -0.02}, .omega_shell = -40, .omega_journal = 300};
  const auto error = [&](const Roughness& roughness) {
    FilmModel m = full_bearing(120, 25);
    m.roughness = roughness;
    const SolvedFilm film = solve_cold(m, journal);
    REQUIRE(film.summary.solved());
    const Eigen::Vector2d force = film.wrench.segment<2>(3);
    const double bodies = -force.dot(journal.e_rate) + film.observed.torque_journal * journal.omega_journal +
                          film.observed.torque_shell * journal.omega_shell;
    return (bodies + film.observed.power_film) / film.observed.power_film;
  };
  const double smooth = error({});
  CHECK(std::abs(smooth) < 2e-3);
  for (const Roughness& roughness : {rough({2e-6, 3}, {1e-6, 0.3}), rough({0, 1}, {2e-6, 1}), rough({2e-6, 0.2}, {})}) {
    // Shear stress and flow that were not reciprocal would be off by 1e-2: sigma phi_s over the gap.
    CHECK(std::abs(error(roughness) - smooth) < 3e-5);
  }
}

TEST_CASE("RoughFilmForces_DoNotDependOnTheFrame") {
  std::array<double, 2> error{};
  for (int k = 0; k < 2; ++k) {
    FilmModel m = k == 0 ? full_bearing(60, 13) : full_bearing(120, 25);
    m.roughness = rough({2e-6, 3}, {1e-6, 0.3});
    Journal journal{.e = {8e-6, 11e-6}, .e_rate = {0.01, -0.02}, .omega_shell = -40, .omega_journal = 300};
    const Vector6 resting = solve_cold(m, journal).wrench;
    // The same bodies in a grid that rotates at 90 rad/s.
    journal.omega_shell -= 90, journal.omega_journal -= 90;
    journal.e_rate -= 90 * Eigen::Vector2d(-journal.e.y(), journal.e.x());
    const Vector6 turning_grid = solve_cold(m, journal).wrench;
    error[k] = (turning_grid - resting).norm() / resting.norm();
  }
  // The mean gap is no linear function of the gap: its values between nodes are accurate to fourth order only.
  CHECK(error[0] < 1e-5);  // 60 nodes, fourth order
}

TEST_CASE("RoughTimeSteps_ConserveOil") {
  FilmModel m{.R = 0.0225, .L = 0.0156, .c = 34e-6, .grid = {60, 13}};
  m.supply = {SupplyKind::fixed_angle, 0, 2e5};
  m.compliance = 4e-13;
  m.asperities = {AsperityModel::greenwood_tripp_exact, 2e-6, 3e-3, 57e9, 0.1};
  m.roughness = rough({2e-6, 6}, {1e-6, 1});
  const double dt = 2e-4, omega = 374;
  Reynolds reynolds(m);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  Journal journal = turning(m, 0.5, omega);
  SurfaceMotion before = surfaces(m, journal);
  REQUIRE(solve_film(reynolds, before, {}, {}, u).solved());
  double smallest = 1;
  for (int step = 1; step <= 20; ++step) {
    const FilmFields fields = film_fields(m, before, u);
    const FilmHistory history{dt, fields.theta, fields.w};
    const double volume_before = observe_film(m, before, {}, journal.e, u).oil_volume;
    journal.e = (0.5 + 0.024 * step) * m.c * Eigen::Vector2d(-std::cos(0.1 * step), 0.8 * std::sin(0.1 * step));
    SurfaceMotion motion = surfaces(m, journal);
    motion.g_rate = (motion.g - before.g) / dt;
    REQUIRE(solve_film(reynolds, motion, history, {}, u).solved());
    const FilmObservables o = observe_film(m, motion, history, journal.e, u);
    const double change = (o.oil_volume - volume_before) / dt;
    // Summed over nodes that the solver leaves 1e-10 of the largest throughput.
    CHECK(std::abs(o.flow_supply - o.flow_left - o.flow_right - change) < 1e-8 * m.R * omega * m.c * m.L);
    CHECK(o.mass_balance_error < 1e-8);
    smallest = std::min(smallest, o.h_min);
    before = motion;
  }
  CHECK(smallest < 3 * m.roughness.composite_sigma());  // asperities have touched
}

// Half the roughness in the surfaces' motion, or in the model, with the summits' elastic factor.
TEST_CASE("RoughnessRatio_IsAFilmOfThatRoughness") {
  FilmModel m{.R = 0.0225, .L = 0.0156, .c = 34e-6, .grid = {48, 9}};
  m.supply = {SupplyKind::widest_gap, 0, 0};
  m.compliance = 4e-13;
  m.asperities = {AsperityModel::greenwood_tripp_exact, 2e-6, 3e-3, 57e9, 0.1, 1e-6};
  m.roughness = rough({1.5e-6, 3}, {1.3e-6, 0.5});
  FilmModel smoother = m;
  constexpr double ratio = 0.5;
  for (double* given :
       {&smoother.asperities.sigma, &smoother.asperities.elastic_factor, &smoother.asperities.mean_summit_height,
        &smoother.roughness.shell.sigma, &smoother.roughness.journal.sigma})
    *given *= ratio;
  const Journal journal = turning(m, 0.96, 374);
  SurfaceMotion run_in = surfaces(m, journal);
  run_in.roughness_ratio = Eigen::VectorXd::Constant(m.grid.size(), ratio);
  const SolvedFilm expected = solve_cold(smoother, journal), stays = solve_cold(m, journal);
  REQUIRE(expected.summary.solved());
  REQUIRE(expected.observed.force_asperity.norm() > 0);
  CHECK((stays.wrench - expected.wrench).norm() > 0.01 * expected.wrench.norm());  // roughness counts there
  for (const FilmSolver solver : {FilmSolver::newton, FilmSolver::multigrid}) {
    const SolvedFilm found = solve_cold(m, run_in, journal.e, {.solver = solver});
    REQUIRE(found.summary.solved());
    constexpr double solved_for = 1e-8;  // the film is solved to 1e-10 of its largest flow
    CHECK((found.wrench - expected.wrench).norm() < solved_for * expected.wrench.norm());
    CHECK((found.fields.p_asperity - expected.fields.p_asperity).norm() <
          solved_for * expected.fields.p_asperity.norm());
    CHECK(found.observed.power_asperity == doctest::Approx(expected.observed.power_asperity).epsilon(solved_for));
  }
}

TEST_CASE("RoughSor_AgreesWithNewton") {
  FilmModel m{.R = 0.0225, .L = 0.0156, .c = 34e-6, .grid = {48, 9}};
  m.supply = {SupplyKind::widest_gap, 0, 0};
  m.roughness = rough({1e-6, 6}, {1e-6, 0.5});
  const SolvedFilm newton = solve_cold(m, turning(m, 0.8, 374));
  const SolvedFilm sor = solve_cold(m, turning(m, 0.8, 374), {.solver = FilmSolver::sor, .rtol = 1e-9});
  REQUIRE(newton.summary.solved());
  REQUIRE(sor.summary.solved());
  // SOR ends at 1e-9, which weak spots of the film amplify.
  CHECK((newton.wrench - sor.wrench).norm() < 1e-6 * newton.wrench.norm());
}

// There is no switch: the solver needs no help from full film to contact.
TEST_CASE("FromFullFilmToContact_NewtonArrives") {
  for (const double gamma : {1.0 / 9, 1.0, 9.0}) {
    FilmModel m{.R = 0.0225, .L = 0.0156, .c = 34e-6, .grid = {60, 13}};
    m.supply = {SupplyKind::widest_gap, 0, 0};
    m.asperities = {AsperityModel::greenwood_tripp_exact, 2e-6, 3e-3, 57e9, 0.1};
    m.roughness = rough({1.5e-6, gamma}, {1.3e-6, gamma});
    double before = 0;
    for (const double e : {0.1, 0.5, 0.8, 0.9, 0.95, 0.97, 0.98, 0.99}) {
      CAPTURE(gamma);
      CAPTURE(e);
      const SolvedFilm film = solve_cold(m, turning(m, e, 374));
      CAPTURE(film.summary.message);
      CHECK(film.summary.solved());
      CHECK(film.summary.iterations <= 15);
      const double load = film.wrench.segment<2>(3).norm();
      CHECK(load > before);
      before = load;
    }
  }
}

}  // namespace roughness_test
}  // namespace hersey::film
