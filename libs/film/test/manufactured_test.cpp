#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "heat/layering.h"
#include "hot_film.h"
#include "manufactured_film.h"

// Films whose answers are given, with everything on that is smooth (theory manual, film.59 and thermal.66): every
// figure that is shown of them errs with the square of the distance of the nodes.
namespace hersey::film {
namespace manufactured_test {

// Errors of the figures by kind: those of one kind have one scale.
using Errors = std::map<std::string, std::map<std::string, double>>;

double largest(const std::map<std::string, double>& errors) {
  double size = 0;
  for (const auto& [name, error] : errors) size = std::max(size, std::abs(error));
  return size;
}

// Each grid halves all distances of the one before. Once errors of higher order have decayed, halving divides the error
// by 4; 2^1.9 leaves them a part. A figure in which two errors of second order happen to cancel has no order of its
// own: it is small beside those of its kind.
void check_order(const std::vector<Errors>& on, const std::map<std::string, double>& lower = {}) {
  constexpr double beside = 0.2;
  for (const auto& [kind, figures] : on.back()) {
    const auto known = lower.find(kind);
    const double least = std::pow(2, known == lower.end() ? 1.9 : known->second);
    const double size = largest(figures);
    for (const auto& [name, last] : figures) {
      const double coarse = on.front().at(kind).at(name), middle = on[1].at(kind).at(name), fine = last;
      const std::string figure = kind + ", " + name;
      CAPTURE(figure);
      CAPTURE(coarse);
      CAPTURE(middle);
      CAPTURE(fine);
      CHECK((std::abs(fine) < beside * size || least * std::abs(fine) < std::abs(middle) ||
             least * least * std::abs(fine) < std::abs(coarse)));
    }
    CHECK(largest(on[1].at(kind)) > least * size);
  }
}

struct Solution {
  FilmObservables observed;
  FilmFields fields;
};

Solution solve(const ManufacturedFilm& exact, const Grid& grid) {
  const FilmModel model = exact.model(grid);
  const SurfaceMotion motion = exact.motion(grid);
  FilmHistory history;
  history.viscosity = exact.viscosity(grid);
  Reynolds reynolds(model);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(grid.size());
  const FilmSolveSummary solved = solve_film(reynolds, motion, history, {}, u);
  REQUIRE(solved.solved());
  return {observe_film(model, motion, history, exact.e, u, exact.tilt), film_fields(model, motion, u)};
}

Errors errors_of(const ManufacturedFilm& exact, const Grid& grid) {
  const auto [observed, fields] = solve(exact, grid);
  REQUIRE(observed.cavitated_share == 0);
  Errors errors;
  const auto at_nodes = [&](auto field) { return exact.at_nodes(grid, field); };
  const auto p = [&](double phi, double z) { return exact.p(phi, z); };
  errors["pressure"] = {{"nodes", (fields.p - at_nodes(p)).cwiseAbs().maxCoeff() / exact.p_rise},
                        {"largest", (observed.p_max - exact.p(exact.peak_phi, exact.peak_z())) / exact.p_rise}};
  const Vector6 wrench = exact.wrench_on_shell(), missing = observed.wrench_on_shell - wrench;
  const double load = wrench.tail<3>().norm();
  errors["load"] = {{"x", missing[3] / load},
                    {"y", missing[4] / load},
                    {"moment x", missing[0] / (load * exact.L)},
                    {"moment y", missing[1] / (load * exact.L)}};
  const double torque =
      -wrench[2] - exact.tilt.dot(wrench.head<2>()) + exact.e.x() * wrench[4] - exact.e.y() * wrench[3];
  errors["friction"] = {{"on the shell", missing[2] / torque},
                        {"on the journal", observed.torque_journal / torque - 1},
                        {"along the axis", missing[5] * exact.R / torque},
                        {"power", observed.power_film / exact.power() - 1}};
  const auto density_of_oil = [&](double phi, double z) { return exact.rho(phi, z) * exact.h(phi, z); };
  const auto rate_of_oil = [&](double phi, double z) { return exact.rho(phi, z) * exact.g_rate(phi, z); };
  errors["flow"] = {{"left", observed.flow_left / exact.outflow(-1) - 1},
                    {"right", observed.flow_right / exact.outflow(1) - 1},
                    {"stored", (observed.storage_rate - exact.over_area(rate_of_oil)) / exact.outflow(1)},
                    {"oil", observed.oil_volume / exact.over_area(density_of_oil) - 1}};
  return errors;
}

std::vector<Errors> on_three_grids(const ManufacturedFilm& exact) {
  std::vector<Errors> on;
  for (const int n : {1, 2, 4}) on.push_back(errors_of(exact, Grid{.n_phi = 40 * n, .n_z = 12 * n + 1}));
  return on;
}

TEST_CASE("ManufacturedFilm_IsMetWithOrderTwoInEveryFigure") { check_order(on_three_grids({})); }

TEST_CASE("ManufacturedFilm_OfOneViscosity_IsMetWithOrderTwo") { check_order(on_three_grids({.spread = 0})); }

TEST_CASE("ManufacturedFilm_OnAGradedGrid_IsMetWithOrderTwo") {
  std::vector<Errors> on;
  for (const int n : {1, 2, 4})
    on.push_back(errors_of({}, graded_grid(40 * n, 12 * n + 1, {{3, 0.8, 3}}, {{0.5, 0.1, 2}})));
  check_order(on);
}

/// The film lies between walls of prescribed temperatures, with oil that leaves over both edges at all heights.
HotFilm solve_hot(const ManufacturedFilm& exact, const Grid& grid, const Layering& across) {
  const auto layers = static_cast<int>(across.size());
  ThermalModel thermal{.layers = layers, .T_supply = exact.T_ref};
  Eigen::VectorXd around(grid.n_phi);
  for (int i = 0; i < grid.n_phi; ++i) around[i] = exact.T(0, grid.phi(i), 0);
  thermal.shell = WallAtTemperature{.around = around};
  thermal.journal = WallAtTemperature{.T = exact.T(1, 0, 0)};
  thermal.source.resize(grid.size() * layers);
  for (int k = 0; k < grid.size(); ++k) {
    const double phi = grid.phi(k / grid.n_z), z = exact.L * grid.z_over_L(k % grid.n_z), rate = exact.g_rate(phi, z);
    for (int l = 0; l < layers; ++l)
      thermal.source[k * layers + l] = exact.source(across.middle(static_cast<std::size_t>(l)), phi, z, rate);
  }
  return solve_hot(exact.model(grid), thermal, exact.motion(grid), exact.e);
}

Errors hot_errors_of(const ManufacturedFilm& exact, const Grid& grid, int layers) {
  const Layering across(static_cast<std::size_t>(layers));
  const HotFilm hot = solve_hot(exact, grid, across);
  double inside = 0, outside = 0;
  for (int k = 0; k < grid.size(); ++k) {
    const double phi = grid.phi(k / grid.n_z), z = exact.L * grid.z_over_L(k % grid.n_z);
    double& worst = std::abs(z) <= 0.25 * exact.L ? inside : outside;
    for (int l = 0; l < layers; ++l) {
      const double T = exact.T(across.middle(static_cast<std::size_t>(l)), phi, z);
      worst = std::max(worst, std::abs(hot.state.film[k * layers + l] - T));
    }
  }
  const auto oil = [&](double phi, double z) { return exact.rho(phi, z) * exact.h(phi, z); };
  const auto oil_times_T = [&](double phi, double z) {
    return oil(phi, z) * integral([&](double eta) { return exact.T(eta, phi, z); }, 0, 1);
  };
  const auto T_there = [&](double eta, double phi, double z) { return exact.T(eta, phi, z); };
  const double side_flow = exact.outflow(-1) + exact.outflow(1);
  const double T_side = (exact.outflow(-1, T_there) + exact.outflow(1, T_there)) / side_flow;

  Errors errors;
  const HeatBalance& balance = hot.heat.balance;
  const double power = exact.power(), rc = exact.oil_density * exact.specific_heat;
  errors["temperature [K]"] = {{"inside", inside},
                               {"mean", hot.heat.T_film_mean - exact.over_area(oil_times_T) / exact.over_area(oil)}};
  errors["temperature towards edges [K]"] = {{"layers", outside}, {"of the oil that leaves", hot.heat.T_side - T_side}};
  errors["heat over power"] = {
      {"into the shell", (balance.to_shell - exact.heat_into_wall(0)) / power},
      {"into the journal", (balance.to_journal - exact.heat_into_wall(1)) / power},
      {"of the oil that leaves", (balance.to_oil - rc * side_flow * (T_side - exact.T_ref)) / power},
      {"power", balance.power / power - 1}};
  CHECK(balance.error() < 1e-12);  // an identity but for round-off: what is made is part of it
  errors["film"] = {{"largest pressure", (hot.film.p_max - exact.p(exact.peak_phi, exact.peak_z())) / exact.p_rise},
                    {"flow left", hot.film.flow_left / exact.outflow(-1) - 1},
                    {"flow right", hot.film.flow_right / exact.outflow(1) - 1}};
  return errors;
}

// Layers are halved together with the grid. Along edges temperatures are of lower order: half of the last face's
// dissipation represents that at the edge, half a cell away (theory manual, thermal.66), and heat that leaves with the
// oil or into walls contains a part of that.
TEST_CASE("ManufacturedTemperature_IsMetWithOrderTwoInside") {
  const ManufacturedFilm exact{.w_shell = 0, .w_journal = 0};
  std::vector<Errors> on;
  for (const int n : {1, 2, 4}) on.push_back(hot_errors_of(exact, Grid{.n_phi = 20 * n, .n_z = 6 * n + 1}, 16 * n));
  check_order(on, {{"temperature towards edges [K]", 1.3}, {"heat over power", 1.3}});
}

}  // namespace manufactured_test
}  // namespace hersey::film
