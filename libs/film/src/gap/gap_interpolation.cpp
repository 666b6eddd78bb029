#include "gap/gap_interpolation.h"

#include <cmath>

#include "hersey/core/turn.h"

namespace hersey::film {
namespace {

/// Weights by which four nodal values give the value at angle 0, exact for 1, cos, sin and sin of twice the angle.
std::array<double, 4> weights_at_face(const std::array<double, 4>& angle) {
  Eigen::Matrix4d basis;  // a column per node
  for (int k = 0; k < 4; ++k) basis.col(k) << 1, 1 - std::cos(angle[k]), std::sin(angle[k]), std::sin(2 * angle[k]);
  const Eigen::Vector4d w = basis.fullPivLu().solve(Eigen::Vector4d::UnitX());
  return {w[0], w[1], w[2], w[3]};
}

/// Weights by which three nodal values, the middle one at angle 0, give the mean from -back to ahead, exact for 1, cos
/// and sin.
std::array<double, 3> weights_in_cell(double before, double after, double back, double ahead) {
  Eigen::Matrix3d basis;
  basis << 1, 1, 1, 1 - std::cos(before), 0, 1 - std::cos(after), -std::sin(before), 0, std::sin(after);
  const double width = back + ahead;
  const Eigen::Vector3d mean(1, 1 - (std::sin(ahead) + std::sin(back)) / width,
                             (std::cos(back) - std::cos(ahead)) / width);
  const Eigen::Vector3d w = basis.fullPivLu().solve(mean);
  return {w[0], w[1], w[2]};
}

}  // namespace

GapInterpolation::GapInterpolation(const Grid& grid, const GridGeometry& geometry)
    : n_phi_(grid.n_phi), n_z_(grid.n_z) {
  const double R = geometry.dx.sum() / turn;
  const auto step = [&](int i) { return geometry.dx[(i + n_phi_) % n_phi_] / R; };
  for (int i = 0; i < n_phi_; ++i) {
    const double half = 0.5 * step(i);
    face_.push_back(weights_at_face({-half - step(i - 1), -half, half, half + step(i + 1)}));
    cell_.push_back(weights_in_cell(step(i - 1), step(i), 0.5 * step(i - 1), half));
  }
}

void GapInterpolation::bends(const Eigen::VectorXd& field, Eigen::VectorXd& bends) const {
  bends.resize(field.size());
  const auto line = [&](int i) { return field.segment(static_cast<Eigen::Index>((i + n_phi_) % n_phi_) * n_z_, n_z_); };
  for (int i = 0; i < n_phi_; ++i) {
    const std::array<double, 4>& w = face_[i];
    bends.segment(static_cast<Eigen::Index>(i) * n_z_, n_z_) =
        w[0] * line(i - 1) + (w[1] - 0.5) * line(i) + (w[2] - 0.5) * line(i + 1) + w[3] * line(i + 2);
  }
}

double GapInterpolation::bend(const Eigen::VectorXd& field, int i, int j) const {
  const auto at = [&](int k) { return field[static_cast<Eigen::Index>((k + n_phi_) % n_phi_) * n_z_ + j]; };
  const std::array<double, 4>& w = face_[i];
  return w[0] * at(i - 1) + (w[1] - 0.5) * at(i) + (w[2] - 0.5) * at(i + 1) + w[3] * at(i + 2);
}

void GapInterpolation::excesses(const Eigen::VectorXd& field, Eigen::VectorXd& excesses) const {
  excesses.resize(field.size());
  const auto line = [&](int i) { return field.segment(static_cast<Eigen::Index>((i + n_phi_) % n_phi_) * n_z_, n_z_); };
  for (int i = 0; i < n_phi_; ++i) {
    const std::array<double, 3>& w = cell_[i];
    excesses.segment(static_cast<Eigen::Index>(i) * n_z_, n_z_) =
        w[0] * line(i - 1) + (w[1] - 1) * line(i) + w[2] * line(i + 1);
  }
}

}  // namespace hersey::film
