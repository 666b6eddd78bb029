#include "hersey/bearing/plane_slider.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "hersey/core/contract.h"
#include "kinds/plane_slider/slider_coordinates.h"
#include "kinds/plane_slider/slider_gap.h"

namespace hersey::bearing {

double PadRamp::opening(double y, double /*z*/, double pad_length, double /*width*/) const {
  const double behind = y + 0.5 * pad_length;
  return rise * std::max(0.0, 1 - behind / length);
}

double PadCrown::opening(double y, double /*z*/, double pad_length, double /*width*/) const {
  return drop * std::pow(2 * y / pad_length, 2);
}

double PadBarrel::opening(double /*y*/, double z, double /*pad_length*/, double width) const {
  return drop * std::pow(2 * z / width, 2);
}

PlaneSlider::PlaneSlider(double length, std::vector<PadShape> shapes) : length_(length), shapes_(std::move(shapes)) {
  HERSEY_REQUIRE(length > 0, "a pad has a length");
}

std::vector<std::pair<std::string, std::string>> PlaneSlider::description(const film::FilmModel& model) const {
  std::vector<std::pair<std::string, std::string>> rows;
  rows.emplace_back(
      "size", fmt::format("{:.4g} mm along and {:.4g} mm across the sliding direction", 1e3 * length_, 1e3 * model.L));
  if (const Eigen::VectorXd d = opening(model); !d.isZero(0))
    rows.emplace_back("shape", fmt::format("the pad's face differs from a plane by {:.4g} to {:.4g} um",
                                           1e6 * d.minCoeff(), 1e6 * d.maxCoeff()));
  return rows;
}

std::unique_ptr<GapKinematics> PlaneSlider::gap(const film::FilmModel& model, bool moving_surface_deforms) const {
  HERSEY_REQUIRE(!moving_surface_deforms, "a runner is rigid");
  return std::make_unique<SliderGap>(model, opening(model));
}

std::unique_ptr<SteadyCoordinates> PlaneSlider::steady_coordinates(const film::FilmModel& model) const {
  return std::make_unique<SliderCoordinates>(model, length_, opening(model));
}

Eigen::VectorXd PlaneSlider::opening(const film::FilmModel& model) const {
  const film::Grid& grid = model.grid;
  Eigen::VectorXd opening = Eigen::VectorXd::Zero(grid.size());
  for (int i = 0; i < grid.n_phi; ++i) {
    for (int j = 0; j < grid.n_z; ++j) {
      const double y = model.R * grid.phi(i), z = model.L * grid.z_over_L(j);
      for (const PadShape& shape : shapes_)
        opening[grid.index(i, j)] +=
            std::visit([&](const auto& s) { return s.opening(y, z, length_, model.L); }, shape);
    }
  }
  return opening;
}

film::Grid slider_grid(double length, int lines, int rows) {
  return film::patch_grid({{.from = -0.5 * length, .to = 0.5 * length, .lines = lines}}, rows);
}

}  // namespace hersey::bearing
