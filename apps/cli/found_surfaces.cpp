#include "found_surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "table.h"

namespace hersey::cli {
namespace {

using fem::FoundSurface;
using Kind = FoundSurface::Kind;
using Use = FoundSurface::Use;

constexpr std::size_t kMostCylinders = 20, kMostPlanes = 10;  // on the screen
constexpr std::size_t kMostWithLines = 12;

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

/// The rotation from a frame's z-axis, the bearing's, to the cylinder's.
std::string rotation_to(const Vector3& axis) {
  const Vector3 about = Vector3::UnitZ().cross(axis);
  if (about.norm() < 1e-9) return "";
  const double angle = std::atan2(about.norm(), axis.z()) / kDegree;
  // To a millionth, which a width of 1 m shows as a micrometre.
  Vector3 unit = about.normalized();
  for (double& component : unit) component = std::round(1e6 * component) / 1e6 + 0.0;  // no -0
  return fmt::format(", rotation: {{axis: {} {} {}, angle: {:.7g} deg}}", unit.x(), unit.y(), unit.z(), angle);
}

/// Returns a surface's own name if a key may be called so; names by position have numbers in them that are unsuitable
/// there.
std::string key_of(const FoundSurface& surface, std::size_t number) {
  const bool is_word = std::all_of(surface.name.begin(), surface.name.end(),
                                   [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
  if (is_word && surface.name.find("_at_") == std::string::npos) return surface.name;
  return fmt::format("{}_{}", surface.use() == Use::bore ? "bore" : "journal", number);
}

}  // namespace

nlohmann::json found_json(const std::vector<FoundSurface>& found) {
  const auto list = [](const Vector3& v) { return nlohmann::json{v.x(), v.y(), v.z()}; };
  nlohmann::json surfaces = nlohmann::json::array();
  for (const FoundSurface& surface : found) {
    const bool is_plane = surface.kind == Kind::plane;
    nlohmann::json entry = {{"name", surface.name},           {"kind", is_plane ? "plane" : "cylinder"},
                            {"faces", surface.faces.size()},  {"area", surface.area},
                            {"centre", list(surface.centre)}, {"deviation", surface.deviation}};
    entry[is_plane ? "normal" : "axis"] = list(surface.axis);
    if (!is_plane) {
      entry["diameter"] = 2 * surface.radius;
      entry["width"] = surface.width;
      entry["arc"] = surface.arc;
      entry["cover"] = surface.cover;
      entry["internal"] = surface.is_internal;
      entry["rounding"] = surface.runs_into_neighbours;
      const Use use = surface.use();
      entry["could_be"] = use == Use::bore ? "bore" : use == Use::journal ? "journal" : "";
    }
    surfaces.push_back(std::move(entry));
  }
  return surfaces;
}

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

std::string model_lines(const std::vector<FoundSurface>& found, const std::string& file,
                        const std::string& length_unit) {
  std::string frames, bearings;
  std::size_t bores = 0, journals = 0;
  for (const FoundSurface& surface : found) {
    const bool is_bore = surface.use() == Use::bore;
    if (surface.use() == Use::none || bores + journals >= kMostWithLines) continue;
    const std::size_t number = is_bore ? ++bores : ++journals;
    const std::string key = key_of(surface, number);
    frames += fmt::format("      {}: {{nodes: {}, origin: {} mm{}, connection: average}}\n", key, surface.name,
                          position_in_mm(surface.centre), rotation_to(surface.axis));
    bearings +=
        fmt::format("  {0}: {{{1}: part.{0}, {1}_surface: {{faces: {2}}}, diameter: {3} mm, width: {4} mm}}\n", key,
                    is_bore ? "shell" : "journal", surface.name, in_mm(2 * surface.radius), in_mm(surface.width));
  }
  if (frames.empty()) return "";
  return fmt::format(
      "in a model file, with what else the bearing needs (`hersey explain bearings`):\n"
      "bodies:\n  part:\n    flexible: {{mesh: {}, length_unit: {}}}   # and a material\n    frames:\n{}bearings:\n{}",
      file, length_unit, frames, bearings);
}

}  // namespace hersey::cli
