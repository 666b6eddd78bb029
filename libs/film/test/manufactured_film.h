#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <functional>

#include "film_cases.h"

namespace hersey::film {

/// df/dx to round-off: smooth fields that vary by themselves over lengths of `unit` or more. Central differences of
/// eighth order leave (unit/50)^8/630 of the ninth derivative, 4e-17 of a field's own size.
template <class Function>
double slope_of(Function&& f, double x, double unit) {
  const double d = unit / 50;
  constexpr std::array<double, 4> weight{4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
  double sum = 0;
  for (int k = 1; k <= 4; ++k) sum += weight[k - 1] * (f(x + k * d) - f(x - k * d));
  return sum / d;
}

/// Integral over [a, b] by Gauss' rule of five points in eight parts: to round-off for the fields of these tests.
template <class Function>
double integral(Function&& f, double a, double b) {
  constexpr std::array<double, 5> point{0, 0.5384693101056831, -0.5384693101056831, 0.9061798459386640,
                                        -0.9061798459386640},
      weight{0.5688888888888889, 0.4786286704993665, 0.4786286704993665, 0.2369268850561891, 0.2369268850561891};
  constexpr int parts = 8;
  const double half = 0.5 * (b - a) / parts;
  double sum = 0;
  for (int part = 0; part < parts; ++part) {
    for (std::size_t k = 0; k < point.size(); ++k) sum += half * weight[k] * f(a + half * (2 * part + 1 + point[k]));
  }
  return sum;
}

/// A film whose pressure, thickness and temperature are given as closed expressions; the rate of its gap follows from
/// its equations (film.2), (thermal.6) (theory manual, film.59). All smooth terms are included: an eccentric, tilted
/// journal, a bore that is not round, a liner that deforms, Barus' law, a compressible oil, surfaces that move in both
/// directions, viscosities that vary along and across the film.
///
/// Across the film, eta = 0 at the shell and 1 at the journal, the fluidity at p_cav is the parabola
/// f = f_S (1 - eta) + f_J eta + d eta (1 - eta), so that all integrals across are closed.
struct ManufacturedFilm {
  double R = 0.03, L = 0.03, c = 30e-6;  // [m]
  double mu0 = 0.03;                     // [Pa s]
  double alpha = 4e-8;                   // of Barus' law [1/Pa]
  DensityLaw density = DowsonHigginson{.rise = 1e-8, .saturation = 2e-8};
  double compliance = 4e-13;                                           // [m/Pa]: 0.15 c at the peak
  double p_edge = 2e5, p_rise = 1e7;                                   // [Pa]
  double lean = 0.3;                                                   // of the pressure towards one edge [-], > 0
  double u_shell = 1, u_journal = 6, w_shell = -0.1, w_journal = 0.3;  // [m/s]
  double spread = 1;                              // variation of fluidities along the film; 0: one viscosity [-]
  Eigen::Vector2d e{-0.35 * 30e-6, 0.1 * 30e-6};  // [m]
  Eigen::Vector2d tilt{0.1 * 30e-6 / 0.03, -0.2 * 30e-6 / 0.03};  // [-]

  double T_ref = 320, beta = 0.034;                                     // [K], [1/K]
  double oil_density = 860, specific_heat = 2000, conductivity = 0.13;  // [kg/m^3], [J/(kg K)], [W/(m K)]

  static constexpr double peak_phi = 2;  // [rad]

  /// 0 on both edges.
  [[nodiscard]] double axial_shape(double z) const {
    const double s = z / L, b = 1 - 4 * s * s;
    return b * (1 + lean * s);
  }
  [[nodiscard]] double axial_slope(double z) const {
    const double s = z / L, b = 1 - 4 * s * s;
    return (-8 * s * (1 + lean * s) + lean * b) / L;
  }
  [[nodiscard]] static double around_shape(double phi) {
    return 1 + 0.5 * std::cos(phi - peak_phi) + 0.1 * std::cos(2 * (phi - peak_phi));
  }
  [[nodiscard]] double p(double phi, double z) const { return p_edge + p_rise * around_shape(phi) * axial_shape(z); }
  /// Position of the highest pressure of a film between open edges: axial_slope = 0.
  [[nodiscard]] double peak_z() const { return L * (-8 + std::sqrt(64 + 48 * lean * lean)) / (24 * lean); }
  /// Displacement of the bore outwards from its cylinder [m].
  [[nodiscard]] double opening(double phi, double z) const {
    return 0.1 * c * (std::cos(2 * phi + 0.5) * (1 + z / L) + 2 * z * z / (L * L));
  }
  [[nodiscard]] double h(double phi, double z) const {
    const Eigen::Vector2d e_r(std::cos(phi), std::sin(phi));
    return c - (e + tilt * z).dot(e_r) + opening(phi, z) + compliance * p(phi, z);
  }

  /// The fluidity's a + b eta + c eta^2 at a point [1/(Pa s)], of the pressure p_cav.
  [[nodiscard]] std::array<double, 3> fluidity(double phi, double z) const {
    const double shell = 1 + 0.3 * spread * std::cos(phi + 1), journal = 1 + 0.8 * spread;
    const double bulge = spread * (2 + std::sin(phi)) * (1 + z * z / (L * L));
    return {shell / mu0, (journal - shell + bulge) / mu0, -bulge / mu0};
  }
  /// Integral of eta^power f from 0 to eta.
  [[nodiscard]] double fluidity_up_to(double eta, int power, double phi, double z) const {
    const auto f = fluidity(phi, z);
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += f[k] * std::pow(eta, k + power + 1) / (k + power + 1);
    return sum;
  }
  /// (thermal.4)
  [[nodiscard]] double I(int power, double phi, double z) const { return fluidity_up_to(1, power, phi, z); }
  /// (thermal.5)
  [[nodiscard]] double flow_fluidity(double phi, double z) const {
    return 12 * (I(2, phi, z) - std::pow(I(1, phi, z), 2) / I(0, phi, z));
  }
  [[nodiscard]] double skew(double phi, double z) const { return 2 * I(1, phi, z) / I(0, phi, z) - 1; }
  /// mu(0)/mu(p)
  [[nodiscard]] double thinner(double phi, double z) const { return std::exp(-alpha * p(phi, z)); }
  [[nodiscard]] double rho(double phi, double z) const {
    return std::visit([&](const auto& law) { return law.ratio(p(phi, z)).value; }, density);
  }

  [[nodiscard]] Eigen::Vector2d grad_p(double phi, double z) const {
    const double around = -0.5 * std::sin(phi - peak_phi) - 0.2 * std::sin(2 * (phi - peak_phi));
    return {p_rise * around * axial_shape(z) / R, p_rise * around_shape(phi) * axial_slope(z)};
  }
  /// Speed over the shell's at eta, around and along, and its integral h du from 0 to eta (thermal.7).
  [[nodiscard]] Eigen::Vector2d velocity(double eta, double phi, double z) const {
    const double G0 = fluidity_up_to(eta, 0, phi, z), G1 = fluidity_up_to(eta, 1, phi, z), I0 = I(0, phi, z);
    return shell() + slip() * G0 / I0 +
           std::pow(h(phi, z), 2) * thinner(phi, z) * (G1 - I(1, phi, z) / I0 * G0) * grad_p(phi, z);
  }
  [[nodiscard]] Eigen::Vector2d shell() const { return {u_shell, w_shell}; }
  [[nodiscard]] Eigen::Vector2d slip() const { return {u_journal - u_shell, w_journal - w_shell}; }

  /// Flow per width (thermal.6).
  [[nodiscard]] Eigen::Vector2d flow(double phi, double z) const {
    const double gap = h(phi, z);
    const Eigen::Vector2d along_pressure =
        -gap * gap * gap / 12 * flow_fluidity(phi, z) * thinner(phi, z) * grad_p(phi, z);
    return rho(phi, z) * (along_pressure + (shell() + 0.5 * (1 - skew(phi, z)) * slip()) * gap);
  }
  template <class Vector>
  [[nodiscard]] double divergence(Vector&& q, double phi, double z) const {
    return slope_of([&](double x) { return q(x, z)[0]; }, phi, 1) / R +
           slope_of([&](double x) { return q(phi, x)[1]; }, z, L);
  }
  /// Rate of the gap that balances the oil: rho dg/dt + div q = 0.
  [[nodiscard]] double g_rate(double phi, double z) const {
    return -divergence([&](double x, double y) { return flow(x, y); }, phi, z) / rho(phi, z);
  }
  /// Shear on the shell (film.49), of viscosities that differ across the film.
  [[nodiscard]] Eigen::Vector2d shear(double phi, double z) const {
    return slip() / (I(0, phi, z) * thinner(phi, z) * h(phi, z)) -
           0.5 * (1 + skew(phi, z)) * h(phi, z) * grad_p(phi, z);
  }

  /// Integral over the whole film.
  template <class Density>
  [[nodiscard]] double over_area(Density&& density_at) const {
    constexpr int lines = 96;  // smooth around: exact to round-off
    double sum = 0;
    for (int k = 0; k < lines; ++k) {
      const double phi = 2 * pi * k / lines;
      sum += integral([&](double z) { return density_at(phi, z); }, -L / 2, L / 2);
    }
    return sum * 2 * pi * R / lines;
  }
  /// (film.51), (film.52)
  [[nodiscard]] Vector6 wrench_on_shell() const {
    Vector6 wrench;
    for (int k = 0; k < 6; ++k) {
      wrench[k] = over_area([&](double phi, double z) {
        const Vector3 e_r(std::cos(phi), std::sin(phi), 0), e_phi(-e_r.y(), e_r.x(), 0), e_z(0, 0, 1);
        const Eigen::Vector2d tau = shear(phi, z), slope = grad_p(phi, z);
        const Vector3 t = p(phi, z) * e_r + tau[0] * e_phi + tau[1] * e_z;
        const Vector3 moment = (R * e_r + z * e_z).cross(t) + R * opening(phi, z) * slope[0] * e_z;
        return k < 3 ? moment[k] : (t + opening(phi, z) * slope[1] * e_z)[k - 3];
      });
    }
    return wrench;
  }
  /// Power of sliding and of the flow along pressure (film.53).
  [[nodiscard]] double power() const {
    return over_area([&](double phi, double z) {
      const double gap = h(phi, z);
      return slip().squaredNorm() / (I(0, phi, z) * thinner(phi, z) * gap) +
             std::pow(gap, 3) / 12 * flow_fluidity(phi, z) * thinner(phi, z) * grad_p(phi, z).squaredNorm();
    });
  }
  /// Outflow over an edge.
  [[nodiscard]] double outflow(double edge) const {
    constexpr int lines = 96;
    double sum = 0;
    for (int k = 0; k < lines; ++k) sum += flow(2 * pi * k / lines, edge * L / 2)[1];
    return edge * sum * 2 * pi * R / lines;
  }
  /// Outflow over an edge of a quantity across the film [m^3/s times that].
  template <class Field>
  [[nodiscard]] double outflow(double edge, Field&& of) const {
    constexpr int lines = 96;
    double sum = 0;
    for (int k = 0; k < lines; ++k) {
      const double phi = 2 * pi * k / lines, z = edge * L / 2;
      sum += rho(phi, z) * h(phi, z) *
             integral([&](double eta) { return velocity(eta, phi, z)[1] * of(eta, phi, z); }, 0, 1);
    }
    return edge * sum * 2 * pi * R / lines;
  }

  /// Temperature of the oil, with viscosities mu0 exp[-beta (T - T_ref)].
  [[nodiscard]] double T(double eta, double phi, double z) const {
    const auto f = fluidity(phi, z);
    return T_ref + std::log(mu0 * (f[0] + eta * (f[1] + eta * f[2]))) / beta;
  }
  /// Flow per width between the shell and eta, the integral of (thermal.7).
  [[nodiscard]] Eigen::Vector2d flow_up_to(double eta, double phi, double z) const {
    const auto f = fluidity(phi, z);
    double G0 = 0, G1 = 0;  // integrals of those from 0 to eta
    for (int k = 0; k < 3; ++k) {
      G0 += f[k] * std::pow(eta, k + 2) / ((k + 1) * (k + 2));
      G1 += f[k] * std::pow(eta, k + 3) / ((k + 2) * (k + 3));
    }
    const double I0 = I(0, phi, z), gap = h(phi, z);
    return rho(phi, z) * gap *
           (eta * shell() + slip() * G0 / I0 +
            gap * gap * thinner(phi, z) * (G1 - I(1, phi, z) / I0 * G0) * grad_p(phi, z));
  }
  /// Heat source that balances (thermal.10), (thermal.66) [W/m^3]: heat that the oil carries along and across, less its
  /// conduction and its dissipation.
  [[nodiscard]] double source(double eta, double phi, double z, double rate) const {
    const double thickness = h(phi, z), C = oil_density * specific_heat;
    const Eigen::Vector2d u = rho(phi, z) * velocity(eta, phi, z);
    const Eigen::Vector2d grad_T{slope_of([&](double x) { return T(eta, x, z); }, phi, 1) / R,
                                 slope_of([&](double x) { return T(eta, phi, x); }, z, L)};
    const double upwards =
        -divergence([&](double x, double y) { return flow_up_to(eta, x, y); }, phi, z) - eta * rho(phi, z) * rate;
    const auto a = fluidity(phi, z);
    const double f = a[0] + eta * (a[1] + eta * a[2]), f_eta = a[1] + 2 * eta * a[2], f_eta_eta = 2 * a[2];
    const double T_eta = f_eta / (beta * f), T_eta_eta = (f_eta_eta * f - f_eta * f_eta) / (beta * f * f);
    // mu times the slope of (thermal.7).
    const double I0 = I(0, phi, z), E = thinner(phi, z);
    const Eigen::Vector2d stress =
        slip() / (I0 * E * thickness) + thickness * (eta - I(1, phi, z) / I0) * grad_p(phi, z);
    return C * (u.dot(grad_T) + upwards * T_eta / thickness) - conductivity * T_eta_eta / (thickness * thickness) -
           f * E * stress.squaredNorm();
  }
  /// Into the oil's wall at eta = 0 or 1 [W].
  [[nodiscard]] double heat_into_wall(double eta) const {
    return over_area([&](double phi, double z) {
      const double slope = slope_of([&](double x) { return T(x, phi, z); }, eta, 1);
      return (eta == 0 ? 1 : -1) * conductivity * slope / h(phi, z);
    });
  }

  [[nodiscard]] FilmModel model(const Grid& grid) const {
    FilmModel m{.R = R, .L = L, .c = c, .grid = grid};
    m.lubricant.mu0 = mu0, m.lubricant.density = oil_density;
    m.lubricant.temperature_law = ExponentialViscosity{.mu_ref = mu0, .T_ref = T_ref, .beta = beta};
    m.lubricant.specific_heat = specific_heat, m.lubricant.conductivity = conductivity;
    m.lubricant.viscosity_law = Barus{alpha};
    m.lubricant.density_law = density;
    m.compliance = compliance;
    m.edge_left.pressure = m.edge_right.pressure = p_edge;
    m.fill_speed = u_journal / R;
    return m;
  }
  [[nodiscard]] Eigen::VectorXd at_nodes(const Grid& grid, const std::function<double(double, double)>& field) const {
    Eigen::VectorXd values(grid.size());
    for (int i = 0; i < grid.n_phi; ++i)
      for (int j = 0; j < grid.n_z; ++j) values[grid.index(i, j)] = field(grid.phi(i), L * grid.z_over_L(j));
    return values;
  }
  [[nodiscard]] SurfaceMotion motion(const Grid& grid) const {
    SurfaceMotion m;
    m.g = at_nodes(grid, [this](double phi, double z) { return h(phi, z) - compliance * p(phi, z); });
    m.g_rate = at_nodes(grid, [this](double phi, double z) { return g_rate(phi, z); });
    m.shell_opening = at_nodes(grid, [this](double phi, double z) { return opening(phi, z); });
    m.u_shell = u_shell, m.u_journal = u_journal, m.w_shell = w_shell, m.w_journal = w_journal;
    return m;
  }
  [[nodiscard]] LayeredViscosity viscosity(const Grid& grid) const {
    return {.fluidity = at_nodes(grid, [this](double phi, double z) { return flow_fluidity(phi, z); }),
            .shear_fluidity = at_nodes(grid, [this](double phi, double z) { return I(0, phi, z); }),
            .skew = at_nodes(grid, [this](double phi, double z) { return skew(phi, z); })};
  }
};

}  // namespace hersey::film
