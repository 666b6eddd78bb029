#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "hersey/fem/elastic_body.h"
#include "hersey/fem/film_surface.h"

namespace hersey::fem {

struct Ring {
  double inner = 0.0225, outer = 0.03, width = 0.0156;  // m
  std::array<int, 3> cells = {2, 24, 4};                // through the wall, around, along
};

/// A ring about the z-axis, its middle in the origin, with surfaces and node sets `bore`, `outside`, `bottom` and
/// `top`; midside nodes lie on the circles.
inline Mesh ring_mesh(ElementType type, const Ring& ring) {
  const double two_pi = 2 * std::numbers::pi;
  const Mesh box = box_mesh(type, {ring.outer - ring.inner, two_pi, ring.width}, ring.cells);
  Mesh mesh = box;
  mesh.nodes.clear();
  mesh.node_labels.clear();
  std::map<std::tuple<long, long, long>, int> indices;  // the box's ends y = 0 and y = two_pi are one
  std::vector<int> index;
  for (const Vector3& x : box.nodes) {
    const double y = x.y() > two_pi * (1 - 1e-9) ? 0 : x.y();
    const auto key = std::make_tuple(std::lround(x.x() * 1e9), std::lround(y * 1e9), std::lround(x.z() * 1e9));
    const auto [at, is_new] = indices.try_emplace(key, static_cast<int>(mesh.nodes.size()));
    index.push_back(at->second);
    if (!is_new) continue;
    const double r = ring.inner + x.x();
    mesh.nodes.emplace_back(r * std::cos(y), r * std::sin(y), x.z() - ring.width / 2);
    mesh.node_labels.push_back(static_cast<long>(mesh.nodes.size()));
  }
  for (int& node : mesh.connectivity) node = index[static_cast<std::size_t>(node)];
  const std::map<std::string, std::string> names = {{"x0", "bore"}, {"x1", "outside"}, {"z0", "bottom"}, {"z1", "top"}};
  mesh.surfaces.clear();
  mesh.node_sets.clear();
  for (const auto& [side, name] : names) {
    mesh.surfaces[name] = box.surfaces.at(side);
    std::vector<int>& nodes = mesh.node_sets[name];
    for (const int node : box.node_sets.at(side)) nodes.push_back(index[static_cast<std::size_t>(node)]);
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
  return mesh;
}

/// The whole bore of a ring, or its outside as a journal.
inline FilmCylinder film_of(const Ring& ring, bool is_bore = true) {
  return {.X = {}, .R = is_bore ? ring.inner : ring.outer, .L = ring.width, .is_bore = is_bore};
}

/// Coefficients of the spline that meets cos(phi) at the knots, the same all along.
inline Eigen::VectorXd cosine_on(const SurfaceFunctions& functions) {
  const double h = 2 * std::numbers::pi / functions.around();
  Eigen::VectorXd c(functions.count());
  for (int j = 0; j < functions.count(); ++j) c[j] = 3 / (2 + std::cos(h)) * std::cos(h * (j % functions.around()));
  return c;
}

}  // namespace hersey::fem
