#pragma once

#include <Eigen/Dense>
#include <cmath>

/// The plane slider-crank turning at constant speed: kinematics and forces by hand, without any multibody code.
namespace hersey::verification {

/// Crank pivot at the origin, slider on the x axis; crank angle alpha and rod angle beta from x, r sin alpha = L sin
/// beta with the rod's direction (cos beta, -sin beta) from the crank pin to the slider.
struct SliderCrank {
  double r = 0.048, L = 0.15;                           ///< crank radius, rod length [m]
  double crank_mass = 2, crank_com = 0.01;              ///< com on the crank's line [m]
  double rod_mass = 0.6, rod_com = 0.04, rod_J = 2e-3;  ///< com from the crank pin [m], inertia about it
  double slider_mass = 0.45;
  double g = 9.81;     ///< along -y [m/s^2]
  double omega = 300;  ///< [rad/s]
  double push = 0;     ///< force on the slider along x [N]

  struct Answer {
    double slider, slider_v, slider_a;  ///< of the slider along x
    double beta, beta_rate;
    Eigen::Vector2d small_end;  ///< force of the rod on the slider [N]
    Eigen::Vector2d big_end;    ///< force of the crank on the rod
    Eigen::Vector2d main;       ///< force of ground on the crank
    double side;                ///< force of the guide on the slider along y
    double torque;              ///< drive torque on the crank
  };

  [[nodiscard]] Answer at(double t) const {
    const double a = omega * t, sa = std::sin(a), ca = std::cos(a);
    Answer s{};
    const double sb = r / L * sa;
    s.beta = std::asin(sb);
    const double cb = std::cos(s.beta);
    s.beta_rate = r * omega * ca / (L * cb);
    const double beta_acc = (-r * omega * omega * sa + L * sb * s.beta_rate * s.beta_rate) / (L * cb);
    s.slider = r * ca + L * cb;
    s.slider_v = -r * omega * sa - L * sb * s.beta_rate;
    s.slider_a = -r * omega * omega * ca - L * cb * s.beta_rate * s.beta_rate - L * sb * beta_acc;

    const Eigen::Vector2d u(cb, -sb), du(-sb, -cb);  // rod's direction and its derivative by beta
    const Eigen::Vector2d pin_a = -omega * omega * r * Eigen::Vector2d(ca, sa);
    const Eigen::Vector2d rod_a = pin_a + rod_com * (du * beta_acc - u * s.beta_rate * s.beta_rate);
    const Eigen::Vector2d weight(0, -g);
    // Slider: F_rod + side + push + weight = m a. Rod: pin + F_slider(= -small_end) + weight = m a, and moments about
    // the rod's centre of mass; the rod turns by -beta, so its angular acceleration is -beta_acc.
    s.small_end.x() = slider_mass * s.slider_a - push;
    const Eigen::Vector2d rod_sum = rod_mass * (rod_a - weight);  // big_end - small_end
    // -rod_J beta_acc = cross(-c u, big_end) + cross((L - c) u, -small_end)
    //                 = -c cross(u, rod_sum) - L cross(u, small_end)
    const auto cross = [](const Eigen::Vector2d& p, const Eigen::Vector2d& q) { return p.x() * q.y() - p.y() * q.x(); };
    const double moment = (rod_J * beta_acc - rod_com * cross(u, rod_sum)) / L;  // cross(u, small_end)
    s.small_end.y() = (moment + u.y() * s.small_end.x()) / u.x();
    s.side = slider_mass * g - s.small_end.y();
    s.big_end = rod_sum + s.small_end;
    const Eigen::Vector2d arm(ca, sa);
    s.main = crank_mass * (-omega * omega * crank_com * arm - weight) + s.big_end;
    s.torque = cross(r * arm, s.big_end) - crank_mass * cross(crank_com * arm, weight);
    return s;
  }
};

}  // namespace hersey::verification
