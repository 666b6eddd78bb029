#include "surface/film_coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "hersey/core/two_pi.h"
#include "surface/film_quadrature.h"

namespace hersey::fem {
namespace {
constexpr int points_around = 144, points_along = 24;  // number of points

double phi_at(int i) { return (i + 0.5) * two_pi / points_around; }
double z_at(int k, double L) { return ((k + 0.5) / points_along - 0.5) * L; }

/// True if (phi, z) lies in a triangle or on its edges.
bool holds(const std::array<FilmCorner, 3>& corners, double phi, double z) {
  double low = 0, high = 0, size = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const FilmCorner &from = corners[c], &to = corners[(c + 1) % 3];
    const double along_edge = (to.phi - from.phi) * (z - from.z), across = (to.z - from.z) * (phi - from.phi);
    const double side = along_edge - across;
    size = std::max({size, std::abs(along_edge), std::abs(across)});
    low = std::min(low, side);
    high = std::max(high, side);
  }
  return low >= -1e-9 * size || high <= 1e-9 * size;
}

bool has_film(const FilmCylinder& cylinder, double phi) {
  if (!cylinder.arc) return true;
  return std::abs(std::remainder(phi - cylinder.arc->from - cylinder.arc->over / 2, two_pi)) < cylinder.arc->over / 2;
}

/// Marks the points in one triangle.
void mark(const std::array<FilmCorner, 3>& corners, double L, std::vector<char>& covered) {
  const auto [phi_low, phi_high] = std::minmax({corners[0].phi, corners[1].phi, corners[2].phi});
  const auto [z_low, z_high] = std::minmax({corners[0].z, corners[1].z, corners[2].z});
  const int i_first = static_cast<int>(std::floor(phi_low / two_pi * points_around - 0.5));
  const int i_last = static_cast<int>(std::ceil(phi_high / two_pi * points_around - 0.5));
  const int k_first = std::max(0, static_cast<int>(std::floor((z_low / L + 0.5) * points_along - 0.5)));
  const int k_last = std::min(points_along - 1, static_cast<int>(std::ceil((z_high / L + 0.5) * points_along - 0.5)));
  for (int i = i_first; i <= i_last; ++i)
    for (int k = k_first; k <= k_last; ++k)
      if (holds(corners, phi_at(i), z_at(k, L)))
        covered[static_cast<std::size_t>((i % points_around + points_around) % points_around * points_along + k)] = 1;
}

/// The shortest arc that holds all columns marked: [first, number of columns].
std::array<int, 2> arc_of(const std::array<char, points_around>& marked) {
  int best_gap = 0, best_end = 0, gap = 0;
  for (int i = 0; i < 2 * points_around; ++i) {
    if (marked[static_cast<std::size_t>(i % points_around)] != 0) {
      gap = 0;
    } else if (++gap > best_gap && gap <= points_around) {
      best_gap = gap;
      best_end = i;
    }
  }
  return {(best_end + 1) % points_around, points_around - best_gap};
}

}  // namespace

std::string FilmCover::text() const {
  const double degrees = 360 / two_pi;
  const std::string phi =
      phi_over > two_pi * (1 - 1.5 / points_around)
          ? "all around"
          : fmt::format("from {:.0f} to {:.0f} deg", phi_from * degrees, (phi_from + phi_over) * degrees);
  return fmt::format("a surface that covers only {:.0f} % of the film: there is none {}, z = {:.3g} to {:.3g} mm",
                     std::floor(100 * (1 - missing)), phi, 1e3 * z_low, 1e3 * z_high);
}

FilmCover film_cover(const Mesh& mesh, const std::vector<ElementFace>& faces, const FilmCylinder& cylinder, int parts) {
  std::vector<char> covered(static_cast<std::size_t>(points_around * points_along), 0);
  for (const ElementFace face : faces)
    for (const auto& corners : film_triangles(mesh, face, cylinder, parts)) mark(corners, cylinder.L, covered);
  std::array<char, points_around> has_gap{};
  int all = 0, missing = 0, k_low = points_along, k_high = -1;
  for (int i = 0; i < points_around; ++i)
    for (int k = 0; k < points_along; ++k) {
      if (!has_film(cylinder, phi_at(i))) continue;
      ++all;
      if (covered[static_cast<std::size_t>(i * points_along + k)] != 0) continue;
      ++missing;
      has_gap[static_cast<std::size_t>(i)] = 1;
      k_low = std::min(k_low, k);
      k_high = std::max(k_high, k);
    }
  if (missing == 0) return {};
  const auto [first, columns] = arc_of(has_gap);
  return {.missing = static_cast<double>(missing) / all,
          .phi_from = first * two_pi / points_around,
          .phi_over = columns * two_pi / points_around,
          .z_low = (static_cast<double>(k_low) / points_along - 0.5) * cylinder.L,
          .z_high = (static_cast<double>(k_high + 1) / points_along - 0.5) * cylinder.L};
}

}  // namespace hersey::fem
