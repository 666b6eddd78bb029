#include "hersey/film/gap_profile.h"

#include <cmath>
#include <numbers>

#include "hersey/film/film_model.h"

namespace hersey::film {
namespace {

constexpr double turn = 2 * std::numbers::pi;

}  // namespace

double Barrel::opening(double /*phi*/, double z, double L) const { return drop * std::pow(2 * z / L, 2); }

double Taper::opening(double /*phi*/, double z, double L) const { return rise * z / L; }

double Ovality::opening(double phi, double /*z*/, double /*L*/) const {
  return amplitude * std::cos(2 * (phi - angle));
}

double Lobes::opening(double phi, double /*z*/, double /*L*/) const {
  return offset * (1 - std::cos(std::remainder(phi - angle, turn / count)));
}

Eigen::VectorXd gap_profile(const std::vector<Profile>& profiles, const Grid& grid, double L) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(grid.size());
  for (int i = 0; i < grid.n_phi; ++i) {
    for (int j = 0; j < grid.n_z; ++j) {
      const double phi = grid.phi(i), z = L * grid.z_over_L(j);
      for (const Profile& profile : profiles) {
        sum[grid.index(i, j)] += std::visit([&](const auto& shape) { return shape.opening(phi, z, L); }, profile);
      }
    }
  }
  return sum;
}

}  // namespace hersey::film
