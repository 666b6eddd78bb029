#include "hersey/bearing/thrust_bearing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "hersey/core/contract.h"
#include "hersey/core/two_pi.h"
#include "kinds/thrust/thrust_coordinates.h"
#include "kinds/thrust/thrust_gap.h"

namespace hersey::bearing {

double SectorRamp::opening(const SectorPoint& at) const { return rise * std::max(0.0, 1 - at.theta / arc); }

double SectorCrown::opening(const SectorPoint& at) const { return drop * std::pow(2 * at.theta / at.arc - 1, 2); }

double SectorBarrel::opening(const SectorPoint& at) const {
  return drop * std::pow((2 * at.r - at.inner - at.outer) / (at.outer - at.inner), 2);
}

double SectorCone::opening(const SectorPoint& at) const {
  const double fraction = (at.r - at.inner) / (at.outer - at.inner);
  return rise >= 0 ? rise * fraction : -rise * (1 - fraction);
}

double SectorIncline::opening(const SectorPoint& at) const {
  const double from_middle = at.theta - 0.5 * at.arc;
  return -along * at.r * std::sin(from_middle) + across * (at.r * std::cos(from_middle) - 0.5 * (at.inner + at.outer));
}

ThrustBearing::ThrustBearing(std::vector<SectorPad> pads, std::vector<SectorShape> shapes, bool is_forward)
    : pads_(std::move(pads)), shapes_(std::move(shapes)), is_forward_(is_forward) {
  for (const SectorPad& pad : pads_) HERSEY_REQUIRE(pad.from < pad.to, "a pad has an arc");
}

std::vector<std::pair<std::string, std::string>> ThrustBearing::description(const film::FilmModel& model) const {
  std::vector<std::pair<std::string, std::string>> rows;
  rows.emplace_back("size", fmt::format("{:.4g} mm inner and {:.4g} mm outer diameter", 1e3 * (2 * model.R - model.L),
                                        1e3 * (2 * model.R + model.L)));
  constexpr double in_degrees = 180 / std::numbers::pi;
  std::string pads =
      pads_.empty() ? "a whole washer" : fmt::format("{} pad{} for", pads_.size(), pads_.size() > 1 ? "s" : "");
  if (!pads_.empty())
    pads += is_forward_ ? " a runner that turns from x towards y:" : " a runner that turns from y towards x:";
  for (const SectorPad& pad : pads_)
    pads += fmt::format(" {} {:.4g} to {:.4g} deg{}", pad.name, in_degrees * pad.from, in_degrees * pad.to,
                        &pad == &pads_.back() ? "" : ",");
  rows.emplace_back("pads", std::move(pads));
  if (const Eigen::VectorXd d = opening(model); !d.isZero(0))
    rows.emplace_back("shape", fmt::format("faces differ from the stator's plane by {:.4g} to {:.4g} um",
                                           1e6 * d.minCoeff(), 1e6 * d.maxCoeff()));
  return rows;
}

std::unique_ptr<GapKinematics> ThrustBearing::gap(const film::FilmModel& model, bool moving_surface_deforms) const {
  HERSEY_REQUIRE(!moving_surface_deforms, "a runner is rigid");
  return std::make_unique<ThrustGap>(model, opening(model));
}

std::unique_ptr<SteadyCoordinates> ThrustBearing::steady_coordinates(const film::FilmModel& model) const {
  double arcs = 0;
  for (const SectorPad& pad : pads_) arcs += pad.to - pad.from;
  const auto count = static_cast<int>(std::max<std::size_t>(pads_.size(), 1));
  return std::make_unique<ThrustCoordinates>(model, count, pads_.empty() ? two_pi : arcs / count, opening(model));
}

Eigen::VectorXd ThrustBearing::opening(const film::FilmModel& model) const {
  const film::Grid& grid = model.grid;
  Eigen::VectorXd opening = Eigen::VectorXd::Zero(grid.size());
  SectorPoint at{.arc = two_pi, .inner = model.R - 0.5 * model.L, .outer = model.R + 0.5 * model.L};
  for (int i = 0; i < grid.n_phi; ++i) {
    at.theta = grid.phi(i);
    if (!pads_.empty()) {
      const SectorPad& pad = pads_[static_cast<std::size_t>(grid.patch_of(i))];
      at.arc = pad.to - pad.from;
      at.theta = is_forward_ ? grid.phi(i) - pad.from : pad.to - grid.phi(i);
    }
    for (int j = 0; j < grid.n_z; ++j) {
      at.r = model.R + model.L * grid.z_over_L(j);
      for (const SectorShape& shape : shapes_)
        opening[grid.index(i, j)] += std::visit([&](const auto& s) { return s.opening(at); }, shape);
    }
  }
  return opening;
}

film::Grid thrust_grid(const std::vector<SectorPad>& pads, int lines, int rows) {
  if (pads.empty()) return {.n_phi = lines, .n_z = rows};
  std::vector<film::Patch> patches;
  for (const SectorPad& pad : pads) patches.push_back({.from = pad.from, .to = pad.to, .lines = lines});
  return film::patch_grid(patches, rows);
}

}  // namespace hersey::bearing
