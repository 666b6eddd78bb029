#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "hersey/bearing/clearance.h"
#include "hersey/bearing/skirt.h"
#include "hersey/core/contract.h"
#include "kinds/skirt/skirt_coordinates.h"
#include "kinds/skirt/skirt_gap.h"

namespace hersey::bearing {

double SkirtBarrel::opening(const SkirtPosition& at) const {
  const double above = at.z - apex;
  return above > 0 ? top * std::pow(above / (0.5 * at.L - apex), 2) : bottom * std::pow(above / (0.5 * at.L + apex), 2);
}

double SkirtOvality::opening(const SkirtPosition& at) const {
  const double amplitude = 0.5 * (top + bottom) + (top - bottom) * at.z / at.L;
  return amplitude * std::pow(std::sin(at.phi), 2);
}

double SkirtTable::opening(const SkirtPosition& at) const { return shape.opening(at.phi, at.z, at.L).value; }

film::ValueAndSlope LinerBore::at(double phi, double z) const {
  const auto value = [&](std::size_t k) { return shape.openings[k]->value({&phi, 1}); };
  const auto above = static_cast<std::size_t>(std::upper_bound(shape.z.begin(), shape.z.end(), z) - shape.z.begin());
  if (above == 0) return {value(0), 0};
  if (above == shape.z.size()) return {value(above - 1), 0};
  const double low = value(above - 1), slope = (value(above) - low) / (shape.z[above] - shape.z[above - 1]);
  return {low + slope * (z - shape.z[above - 1]), slope};
}

std::vector<std::pair<std::string, std::string>> PistonSkirt::description(const film::FilmModel& model) const {
  const film::Grid& grid = model.grid;
  HERSEY_REQUIRE(grid.patches.size() == skirt_sides.size(), "a skirt has two sides");
  constexpr double to_degrees = 180 / std::numbers::pi;
  std::vector<std::pair<std::string, std::string>> rows;
  rows.emplace_back(
      "size", fmt::format("{:.4g} mm long, {:.4g} mm in diameter; films on {:.4g} deg of the thrust side and {:.4g} "
                          "deg of the antithrust side",
                          1e3 * model.L, 2e3 * model.R, to_degrees * (grid.phi(grid.patches[1] - 1) - grid.phi(0)),
                          to_degrees * (grid.phi(grid.n_phi - 1) - grid.phi(grid.patches[1]))));
  rows.emplace_back("clearance", fmt::format("{:.4g} um radial ({:.4g} um diametral), where the skirt is widest",
                                             1e6 * clearance(model), 2e6 * clearance(model)));
  if (const Eigen::VectorXd d = opening(model); !d.isZero(0))
    rows.emplace_back("shape", fmt::format("the skirt lies back from a cylinder by {:.4g} to {:.4g} um",
                                           1e6 * d.minCoeff(), 1e6 * d.maxCoeff()));
  if (liner_)
    rows.emplace_back("liner",
                      fmt::format("a measured bore of {} height(s), from z = {:.4g} to {:.4g} mm of its frame",
                                  liner_->shape.z.size(), 1e3 * liner_->shape.z.front(), 1e3 * liner_->shape.z.back()));
  return rows;
}

std::unique_ptr<GapKinematics> PistonSkirt::gap(const film::FilmModel& model, bool moving_surface_deforms) const {
  HERSEY_REQUIRE(!moving_surface_deforms, "a liner is rigid");
  return std::make_unique<SkirtGap>(model, opening(model), liner_);
}

std::unique_ptr<SteadyCoordinates> PistonSkirt::steady_coordinates(const film::FilmModel& model) const {
  return std::make_unique<SkirtCoordinates>(model, opening(model), liner_);
}

Eigen::VectorXd PistonSkirt::opening(const film::FilmModel& model) const {
  const film::Grid& grid = model.grid;
  Eigen::VectorXd opening = Eigen::VectorXd::Zero(grid.size());
  for (int i = 0; i < grid.n_phi; ++i) {
    for (int j = 0; j < grid.n_z; ++j) {
      const SkirtPosition at{.phi = grid.phi(i), .z = model.L * grid.z_over_L(j), .L = model.L};
      for (const SkirtShape& shape : shapes_)
        opening[grid.index(i, j)] += std::visit([&](const auto& s) { return s.opening(at); }, shape);
    }
  }
  return opening;
}

film::Grid skirt_grid(double thrust, double antithrust, int lines, int rows) {
  constexpr double pi = std::numbers::pi;
  HERSEY_REQUIRE(thrust > 0 && thrust < pi && antithrust > 0 && antithrust < pi, "sides below half of the skirt");
  return film::patch_grid({{.from = -0.5 * thrust, .to = 0.5 * thrust, .lines = lines},
                           {.from = pi - 0.5 * antithrust, .to = pi + 0.5 * antithrust, .lines = lines}},
                          rows);
}

std::array<SkirtSide, 2> skirt_side_forces(const film::FilmModel& model, const Eigen::VectorXd& normal_forces) {
  const film::Grid& grid = model.grid;
  std::array<SkirtSide, 2> sides;
  for (int i = 0; i < grid.n_phi; ++i) {
    const auto k = static_cast<std::size_t>(grid.patch_of(i));
    SkirtSide& side = sides.at(k);
    const double across = (k == 0 ? 1 : -1) * std::cos(grid.phi(i));
    for (int j = 0; j < grid.n_z; ++j) {
      const double force = across * normal_forces[grid.index(i, j)];
      side.force += force;
      side.moment += force * model.L * grid.z_over_L(j);
    }
  }
  return sides;
}

double skirt_friction(const Vector6& wrench, const Eigen::Vector2d& tilt) {
  return wrench[5] - tilt.x() * wrench[3] - tilt.y() * wrench[4];
}

}  // namespace hersey::bearing
