#include "film_wrench.h"

#include <cmath>

namespace hersey::film {
namespace {

// Boundary friction turns smoothly from one direction of sliding to the other over this speed.
constexpr double friction_speed = 1e-3;

/// A derivative of the nodal field P by differences: sum of weight * P[node].
struct Stencil {
  std::array<int, 3> node{};
  std::array<double, 3> weight{};
};

// The slope at x = 0 of the parabola through three nodes, two of them at x = a and x = b.
std::array<double, 3> parabola_slope(double a, double b) {
  return {-(a + b) / (a * b), b / (a * (b - a)), -a / (b * (b - a))};
}

Stencil slope_at(int k, int first, double a, int second, double b) {
  return {{k, first, second}, parabola_slope(a, b)};
}

Stencil slope_phi(const Grid& grid, const GridGeometry& geometry, int i, int j) {
  const int before = (i + grid.n_phi - 1) % grid.n_phi, after = (i + 1) % grid.n_phi;
  return slope_at(grid.index(i, j), grid.index(before, j), -geometry.dx[before], grid.index(after, j), geometry.dx[i]);
}

// Second order up to the edges, where the difference is one-sided.
Stencil slope_z(const Grid& grid, const GridGeometry& geometry, int i, int j) {
  const int k = grid.index(i, j), last = grid.n_z - 1;
  const Eigen::VectorXd& dz = geometry.dz;
  if (j == 0) return slope_at(k, k + 1, dz[0], k + 2, dz[0] + dz[1]);
  if (j == last) return slope_at(k, k - 1, -dz[last - 1], k - 2, -dz[last - 1] - dz[last - 2]);
  return slope_at(k, k - 1, -dz[j - 1], k + 1, dz[j]);
}

double slope(const Stencil& stencil, const std::vector<Node>& nodes) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += stencil.weight[k] * nodes[stencil.node[k]].wall;
  return sum;
}

}  // namespace

FilmWrench::FilmWrench(const FilmModel& model) : model_(model), geometry_(model_) {
  const Grid& grid = model_.grid;
  cosine_ = geometry_.phi.array().cos();
  sine_ = geometry_.phi.array().sin();
  by_u_.setZero(6, grid.size());
  by_g_.setZero(6, grid.size());
}

FilmWrench::Basis FilmWrench::basis(int i, int j) const {
  const double R = model_.R, z = geometry_.z[j], c = cosine_[i], s = sine_[i];
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
  const double area = geometry_.weight_phi[i] * geometry_.weight_z[j];
  const Basis b = basis(i, j);

  // Shear on the shell (film.18): tau = share mu slip/h - h/2 grad p, along phi and along z.
  const Stencil by_phi = slope_phi(grid, geometry_, i, j), by_z = slope_z(grid, geometry_, i, j);
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
