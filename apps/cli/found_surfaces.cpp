#include "found_surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "table.h"

namespace hersey::cli {
namespace {

using fem::FoundSurface;
using Kind = FoundSurface::Kind;
using Use = FoundSurface::Use;

constexpr std::size_t kMostCylinders = 20, kMostPlanes = 10;  // on the screen

constexpr double kDegree = std::numbers::pi / 180;

/// In millimetres to 0.1 um: finer differences come from the positions of a mesh's nodes.
std::string in_mm(double length) {
  const double shown = std::round(1e3 * length * 1e4) / 1e4;
  return fmt::format("{:.6g}", shown == 0 ? 0.0 : shown);
}

std::string position_in_mm(const Vector3& x) {
  return fmt::format("{} {} {}", in_mm(x.x()), in_mm(x.y()), in_mm(x.z()));
}

/// "z", "-x" or "0.6 0.8 0".
std::string direction_text(const Vector3& axis) {
  for (int i = 0; i < 3; ++i)
    if ((axis.cwiseAbs() - Vector3::Unit(i)).lpNorm<Eigen::Infinity>() < 1e-6)
      return fmt::format("{}{}", axis[i] < 0 ? "-" : "", "xyz"[i]);
  return fmt::format("{:.4f} {:.4f} {:.4f}", axis.x(), axis.y(), axis.z());
}

const char* kind_of(const FoundSurface& surface) {
  if (surface.kind == Kind::plane) return "plane";
  if (surface.runs_into_neighbours) return surface.is_internal ? "inner rounding" : "outer rounding";
  return surface.is_internal ? "inner cylinder" : "outer cylinder";
}

const char* use_of(const FoundSurface& surface) {
  if (surface.use() == Use::bore) return "could be a bore";
  return surface.use() == Use::journal ? "could be a journal" : "";
}

}  // namespace

std::string found_text(const std::vector<FoundSurface>& found) {
  if (found.empty()) return "";
  std::vector<std::vector<std::string>> lines = {
      {"found [mm]", "kind", "diameter", "width", "arc", "area", "axis, normal", "centre", ""}};
  std::size_t cylinders = 0, planes = 0, left_out = 0;
  for (const FoundSurface& surface : found) {
    const bool is_plane = surface.kind == Kind::plane;
    if (is_plane ? planes++ >= kMostPlanes : cylinders++ >= kMostCylinders) {
      ++left_out;
      continue;
    }
    const std::string area = fmt::format("{:.5g}", 1e6 * surface.area);
    if (is_plane)
      lines.push_back({surface.name, kind_of(surface), "", "", "", area, direction_text(surface.axis),
                       position_in_mm(surface.centre), ""});
    else
      lines.push_back({surface.name, kind_of(surface), in_mm(2 * surface.radius), in_mm(surface.width),
                       fmt::format("{:.0f} deg", surface.arc / kDegree), area, direction_text(surface.axis),
                       position_in_mm(surface.centre), use_of(surface)});
  }
  std::string text = aligned(lines, 6);
  if (left_out > 0) text += fmt::format("  and {} smaller ones, which --json lists\n", left_out);
  return text;
}

}  // namespace hersey::cli
