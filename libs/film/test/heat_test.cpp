#include <doctest/doctest.h>

#include "hot_film.h"

namespace hersey::film {
namespace heat_test {

constexpr double zero_celsius = 273.15;

/// Oil A of the reference cases: mu = 0.0277 exp(-0.034 (T - 40 degC)) Pa s.
Lubricant oil_a() {
  Lubricant oil{.mu0 = 0.0277, .density = 860};
  oil.temperature_law = ExponentialViscosity{.mu_ref = 0.0277, .T_ref = 40 + zero_celsius, .beta = 0.034};
  oil.specific_heat = 2000, oil.conductivity = 0.13;
  return oil;
}

void show(const std::string& name, int n, const HotFilm& hot) {
    MESSAGE(name << ' ' << n << " it " << hot.iterations << " W " << hot.film.force_pressure.norm() << " dir "
              << std::atan2(hot.film.force_pressure.y(), hot.film.force_pressure.x()) * 180 / pi + 360
              << " M " << hot.film.torque_journal << " Ms " << hot.film.torque_shell << " Tin " << hot.heat.T_supplies[0] - 273.15 << " Tside "
              << hot.heat.T_side - 273.15 << " Tfilm " << hot.heat.T_film_mean - 273.15 << " Tj " << hot.heat.T_journal - 273.15 << " P "
              << hot.heat.balance.power << " Q " << hot.film.flow_left + hot.film.flow_right << " err "
              << hot.heat.balance.error() << " pmax " << hot.film.p_max << " Tmax " << hot.heat.T_max - 273.15 << " Tshell max " << hot.heat.T_shell_max - 273.15
              << " mean " << hot.heat.T_shell_mean - 273.15 << " toshell " << hot.heat.balance.to_shell << " toj " << hot.heat.balance.to_journal);
}

void bulk(const char* name, double LD, double eps, double groove, bool mixing, Cavitation cav) {
  for (const int n : {60, 120, 240}) {
    FilmModel model{.R = 0.05, .L = 0.1 * LD, .c = 50e-6, .grid = {.n_phi = n, .n_z = n / 5 + 1}, .lubricant = oil_a()};
    model.cavitation = cav;
    model.supply = {SupplyKind::fixed_angle, 0, 0};
    model.shear_force = ShearForce::torque_only;
    if (cav == Cavitation::reynolds) model.cavitated_shear = CavitatedShear::full;
    ThermalModel thermal{.layers = 1, .T_supply = 313.15, .T_edges = 313.15, .shell = InsulatedWall{}, .journal = InsulatedWall{}};
    if (!mixing) thermal.carry_over = 0;
    Journal journal = turning(model, eps, 314.1592653589793);
    if (groove != 180) {
      journal.e = eps * model.c * Eigen::Vector2d(std::cos(-groove*pi/180), std::sin(-groove*pi/180));
      model.supply.kind = SupplyKind::none;
      model.features.push_back({.name = "g", .phi = 0, .z = 0, .arc = 20 * pi / 180, .length = model.L, .pressure = 0, .depth = 1e-3});
    }
    show(name, n, solve_hot(model, thermal, surfaces(model, journal), journal.e));
  }
}

TEST_CASE("probe") {




  try { bulk("C5", 1, 0.6, 180, false, Cavitation::reynolds); } catch (const std::exception& e) { MESSAGE(std::string(e.what())); }
  for (const int c : {0, 1, 2, 3}) for (const int n : {60, 120}) for (const int nl : {5, 10}) { if (n == 120 && nl == 10) continue;
    FilmModel model{.R = 0.05, .L = 0.08, .c = 145e-6, .grid = {.n_phi = n, .n_z = n / 5 + 1}, .lubricant = oil_a()};
    model.shear_force = ShearForce::torque_only;
    model.features.push_back({.name = "g", .phi = 0, .z = 0, .arc = 18 * pi / 180, .length = 0.07, .pressure = 70e3});
    ThermalModel thermal{.layers = c == 3 ? 1 : nl, .T_supply = 313.15, .T_edges = 313.15};
    if (c == 0) thermal.shell = InsulatedWall{};
    if (c == 1) thermal.shell = WallAtTemperature{.T = 323.15}, thermal.journal = WallAtTemperature{.T = 319.15};
    if (c == 2) thermal.shell = RingWall{.outer_radius = 0.1, .conductivity = 50, .transfer = 80, .T_ambient = 313.15};
    if (c == 3) thermal.journal = InsulatedWall{};
    const double phi = 230 * pi / 180;
    Journal journal{.e = 0.7 * model.c * Eigen::Vector2d(std::cos(phi), std::sin(phi)), .omega_journal = 209.43951023931953};
    const char* names[] = {"F1", "F2", "F3", "G1"};
    show(names[c], n, solve_hot(model, thermal, surfaces(model, journal), journal.e));
  }
}

}  // namespace heat_test
}  // namespace hersey::film
