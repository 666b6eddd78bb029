#include "film_wrench.h"

#include <cmath>
#include <numbers>

namespace hersey::film {
namespace {

// Boundary friction turns smoothly from one direction of sliding to the other over this speed.
constexpr double friction_speed = 1e-3;

/// A derivative of the nodal field P by differences: sum of weight * P[node].
struct Stencil {
  std::array<int, 3> node{};
  std::array<double, 3> weight{};
};

Stencil slope_phi(const Grid& grid, double dx, int i, int j) {
  const int before = grid.index((i + grid.n_phi - 1) % grid.n_phi, j), after = grid.index((i + 1) % grid.n_phi, j);
  return {{before, after, after}, {-0.5 / dx, 0.5 / dx, 0}};
}

// Second order up to the edges, where the difference is one-sided.
Stencil slope_z(const Grid& grid, double dz, int i, int j) {
  const int k = grid.index(i, j);
  if (j == 0) return {{k, k + 1, k + 2}, {-1.5 / dz, 2 / dz, -0.5 / dz}};
  if (j == grid.n_z - 1) return {{k, k - 1, k - 2}, {1.5 / dz, -2 / dz, 0.5 / dz}};
  return {{k - 1, k + 1, k + 1}, {-0.5 / dz, 0.5 / dz, 0}};
}

// Weights of the integral over [0, n - 1] from values at 0, 1, ..., n - 1 (Gregory's end corrections of second order;
// Newton-Cotes below six points). Exact for parabolas: a film's pressure is nearly one across the width, and the
// trapezoidal rule alone would lose 1/(n - 1)^2 of the load.
Eigen::VectorXd quadrature(int n) {
  if (n == 3) return Eigen::Vector3d(1, 4, 1) / 3;
  if (n == 4) return Eigen::Vector4d(3, 9, 9, 3) / 8;
  if (n == 5) return (Eigen::VectorXd(5) << 1, 4, 2, 4, 1).finished() / 3;
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(n);
  const Eigen::Vector3d end(9.0 / 24, 28.0 / 24, 23.0 / 24);
  weights.head<3>() = end;
  weights.tail<3>() = end.reverse();
  return weights;
}

double slope(const Stencil& stencil, const std::vector<Node>& nodes) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += stencil.weight[k] * nodes[stencil.node[k]].wall;
  return sum;
}

}  // namespace

FilmWrench::FilmWrench(const FilmModel& model) : model_(model) {
  const Grid& grid = model_.grid;
  const double dphi = 2 * std::numbers::pi / grid.n_phi;
  dx_ = model_.R * dphi;
  dz_ = model_.L / (grid.n_z - 1);
  cosine_.resize(grid.n_phi);
  sine_.resize(grid.n_phi);
  for (int i = 0; i < grid.n_phi; ++i) {
    cosine_[i] = std::cos(i * dphi);
    sine_[i] = std::sin(i * dphi);
  }
  area_ = dx_ * dz_ * quadrature(grid.n_z);
  by_u_.setZero(6, grid.size());
  by_g_.setZero(6, grid.size());
}

FilmWrench::Basis FilmWrench::basis(int i, int j) const {
  const double R = model_.R, z = -0.5 * model_.L + j * dz_, c = cosine_[i], s = sine_[i];
  // Moments r x f about the origin with r = R e_r + z e_z.
  Basis b;
  b.radial << -z * s, z * c, 0, c, s, 0;
  b.tangential << -z * c, -z * s, R, -s, c, 0;
  b.axial << R * s, -R * c, 0, 0, 0, 1;
  b.shear_tangential = b.tangential;
  b.shear_axial = b.axial;
  if (model_.shear_force == ShearForce::torque_only) {
    b.shear_tangential.tail<3>().setZero();
    b.shear_axial.tail<3>().setZero();
  }
  return b;
}

void FilmWrench::set_speeds(const SurfaceMotion& motion) {
  slip_ << motion.u_journal - motion.u_shell, motion.w_journal - motion.w_shell;
  const double square = slip_.squaredNorm() + friction_speed * friction_speed, speed = std::sqrt(square);
  const double mu_friction = model_.asperities.mu_friction;
  friction_ = mu_friction / speed * slip_;
  friction_slip_ = mu_friction / speed * (Eigen::Matrix2d::Identity() - slip_ * slip_.transpose() / square);
}

void FilmWrench::evaluate(const std::vector<Node>& nodes, const SurfaceMotion& motion, bool want_gradient) {
  const Grid& grid = model_.grid;
  set_speeds(motion);
  pressure_.setZero(), shear_.setZero(), asperity_.setZero();
  if (want_gradient) by_u_.setZero(), by_g_.setZero(), by_slip_.setZero();
  for (int i = 0; i < grid.n_phi; ++i) {
    for (int j = 0; j < grid.n_z; ++j) add_node(nodes, i, j, want_gradient);
  }
  total_ = pressure_ + shear_ + asperity_;
}

void FilmWrench::add_node(const std::vector<Node>& nodes, int i, int j, bool want_gradient) {
  const Grid& grid = model_.grid;
  const int k = grid.index(i, j);
  const Node& node = nodes[k];
  const double area = area_[j];
  const Basis b = basis(i, j);

  // Shear on the shell (film.18): tau = share mu slip/h - h/2 grad p, along phi and along z.
  const Stencil by_phi = slope_phi(grid, dx_, i, j), by_z = slope_z(grid, dz_, i, j);
  const double p_phi = slope(by_phi, nodes), p_z = slope(by_z, nodes);
  const double mu = 1 / node.fluidity, couette = node.share * mu / node.h;
  pressure_ += area * node.wall * b.radial;
  shear_ += area * ((couette * slip_[0] - 0.5 * node.h * p_phi) * b.shear_tangential +
                    (couette * slip_[1] - 0.5 * node.h * p_z) * b.shear_axial);
  const Vector6 contact = b.radial + friction_[0] * b.tangential + friction_[1] * b.axial;
  if (node.asperity != 0) asperity_ += area * node.asperity * contact;
  if (!want_gradient) return;

  const Vector6 sheared = slip_[0] * b.shear_tangential + slip_[1] * b.shear_axial;
  const Vector6 by_h = area * (-couette / node.h * sheared - 0.5 * (p_phi * b.shear_tangential + p_z * b.shear_axial) +
                               node.asperity_h * contact);
  const double couette_u = (node.share_u * mu - node.share * mu * mu * node.fluidity_u) / node.h;
  by_u_.col(k) += node.h_u * by_h + area * (node.wall_u * b.radial + couette_u * sheared);
  by_g_.col(k) += node.h_g * by_h;
  for (int s = 0; s < 3; ++s) {
    const double half = -0.5 * area * node.h;
    by_u_.col(by_phi.node[s]) += half * by_phi.weight[s] * nodes[by_phi.node[s]].wall_u * b.shear_tangential;
    by_u_.col(by_z.node[s]) += half * by_z.weight[s] * nodes[by_z.node[s]].wall_u * b.shear_axial;
  }
  by_slip_.col(0) += area * couette * b.shear_tangential;
  by_slip_.col(1) += area * couette * b.shear_axial;
  if (node.asperity == 0) return;
  by_slip_ += area * node.asperity * (b.tangential * friction_slip_.row(0) + b.axial * friction_slip_.row(1));
}

Vector6 FilmWrench::along(const MotionDirection& direction) const {
  const Eigen::Vector2d slip(direction.u_journal - direction.u_shell, direction.w_journal - direction.w_shell);
  Vector6 d = by_slip_ * slip;
  if (direction.g.size() != 0) d += by_g_ * direction.g;
  return d;
}

}  // namespace hersey::film
