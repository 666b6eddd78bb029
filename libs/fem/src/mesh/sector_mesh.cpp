#include "hersey/fem/sector_mesh.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "hersey/core/contract.h"
#include "hersey/fem/elastic_body.h"

namespace hersey::fem {
namespace {

constexpr double kSameLine = 1e-9;  // of a whole extent: borders this near are one

/// Lines of the mesh along one coordinate, through borders in ascending order: in each interval as many
/// elements as come nearest to `count` over the whole.
std::vector<double> lines_between(const std::vector<double>& borders, int count) {
  const double whole = borders.back() - borders.front();
  std::vector<double> lines{borders.front()};
  for (const double end : borders) {
    const double begin = lines.back(), length = end - begin;
    if (length <= kSameLine * whole) continue;
    const int here = std::max(1, static_cast<int>(std::lround(count * length / whole)));
    for (int k = 1; k <= here; ++k) lines.push_back(begin + length * k / here);
  }
  return lines;
}

/// Place in units of elements, as a value between the lines.
double between(const std::vector<double>& lines, double place) {
  const auto k = std::min(static_cast<std::size_t>(place), lines.size() - 2);
  return lines[k] + (place - static_cast<double>(k)) * (lines[k + 1] - lines[k]);
}

std::vector<int> nodes_of_seat(const Mesh& mesh, const RingSector& sector) {
  const SectorSeat& seat = *sector.seat;
  const double middle = 0.5 * (seat.from + seat.to), half = 0.5 * (seat.to - seat.from);
  const double angle_near = kSameLine * (sector.to - sector.from), width_near = kSameLine * sector.width;
  std::vector<int> nodes;
  for (const int node : mesh.node_sets.at("outer")) {
    const Vector3& x = mesh.nodes[static_cast<std::size_t>(node)];
    const double off = std::atan2(x.y() * std::cos(middle) - x.x() * std::sin(middle),
                                  x.x() * std::cos(middle) + x.y() * std::sin(middle));
    if (std::abs(off) <= half + angle_near && std::abs(x.z()) <= 0.5 * seat.width + width_near) nodes.push_back(node);
  }
  return nodes;
}

}  // namespace

Mesh sector_mesh(const RingSector& sector) {
  HERSEY_REQUIRE(sector.inner > 0 && sector.outer > sector.inner && sector.width > 0 && sector.to > sector.from,
                 "a sector has volume");
  std::vector<double> around{sector.from, sector.to}, along{-sector.width / 2, sector.width / 2};
  if (const auto& seat = sector.seat) {
    HERSEY_REQUIRE(seat->from >= sector.from && seat->to <= sector.to && seat->to > seat->from && seat->width > 0 &&
                       seat->width <= sector.width,
                   "the seat lies within the sector");
    around = {sector.from, seat->from, seat->to, sector.to};
    along = {-sector.width / 2, -seat->width / 2, seat->width / 2, sector.width / 2};
  }
  const std::vector<double> radii = lines_between({sector.inner, sector.outer}, sector.elements[2]),
                            angles = lines_between(around, sector.elements[0]),
                            heights = lines_between(along, sector.elements[1]);
  const auto cells = [](const std::vector<double>& lines) { return static_cast<int>(lines.size()) - 1; };
  // A box whose elements are cubes of length 1, bent.
  const Vector3 size(cells(radii), cells(angles), cells(heights));
  Mesh mesh = box_mesh(ElementType::hex20, size, {cells(radii), cells(angles), cells(heights)});
  for (Vector3& x : mesh.nodes) {
    const double r = between(radii, x.x()), angle = between(angles, x.y());
    x = Vector3(r * std::cos(angle), r * std::sin(angle), between(heights, x.z()));
  }
  for (const auto& [side, name] : {std::pair<std::string, std::string>{"x0", "inner"},
                                   {"x1", "outer"},
                                   {"y0", "first_end"},
                                   {"y1", "last_end"},
                                   {"z0", "low_side"},
                                   {"z1", "high_side"}}) {
    mesh.node_sets[name] = std::move(mesh.node_sets.extract(side).mapped());
    mesh.surfaces[name] = std::move(mesh.surfaces.extract(side).mapped());
  }
  if (sector.seat) mesh.node_sets["seat"] = nodes_of_seat(mesh, sector);
  return mesh;
}

}  // namespace hersey::fem
