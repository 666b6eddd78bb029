#include "hersey/workbench/mesh_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <string_view>
#include <utility>

#include "answers/request.h"
#include "hersey/fem/skin.h"

namespace hersey::workbench {
namespace {

using fem::FoundSurface;
using fem::Mesh;
using fem::MeshQuality;
using Use = FoundSurface::Use;
using Kind = FoundSurface::Kind;

constexpr std::size_t kMostWithLines = 12;
constexpr double kDegree = std::numbers::pi / 180;

nlohmann::json list_of(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

nlohmann::json sets_json(const Mesh& mesh) {
  nlohmann::json sets = {{"nodes", nlohmann::json::object()},
                         {"elements", nlohmann::json::object()},
                         {"surfaces", nlohmann::json::object()}};
  for (const auto& [name, set] : mesh.node_sets) sets["nodes"][name] = set.size();
  for (const auto& [name, set] : mesh.element_sets) sets["elements"][name] = set.size();
  for (const auto& [name, set] : mesh.surfaces) sets["surfaces"][name] = set.size();
  return sets;
}

nlohmann::json quality_json(const MeshQuality& quality) {
  nlohmann::json types = nlohmann::json::object();
  for (const auto& [type, of_type] : quality.types) {
    nlohmann::json entry = {{"count", of_type.count}};
    if (type != fem::ElementType::beam2) {
      entry["smallest_shape"] = of_type.smallest_shape;
      entry["mean_shape"] = of_type.mean_shape;
      entry["label_of_smallest_shape"] = of_type.label_of_smallest;
      entry["largest_aspect"] = of_type.largest_aspect;
    }
    types[fem::name_of(type)] = std::move(entry);
  }
  return types;
}

nlohmann::json document_of(const Mesh& mesh, const MeshQuality& quality) {
  nlohmann::json materials = nlohmann::json::array();
  for (const fem::MeshMaterial& material : mesh.materials) {
    nlohmann::json entry = {{"name", material.name}};
    if (material.youngs_modulus) entry["youngs_modulus"] = *material.youngs_modulus;
    if (material.poisson_ratio) entry["poisson_ratio"] = *material.poisson_ratio;
    if (material.density) entry["density"] = *material.density;
    materials.push_back(std::move(entry));
  }
  nlohmann::json document = {{"nodes", mesh.nodes.size()},
                             {"degrees_of_freedom", 3 * mesh.nodes.size()},
                             {"elements", quality_json(quality)},
                             {"box", {{"lower", list_of(quality.lower)}, {"upper", list_of(quality.upper)}}},
                             {"volume", quality.volume},
                             {"ties", mesh.ties.size()},
                             {"parts", quality.parts.size()},
                             {"outer_faces", fem::outer_faces(mesh).size()},
                             {"materials", std::move(materials)},
                             {"sets", sets_json(mesh)}};
  document["mass"] = quality.mass ? nlohmann::json(*quality.mass) : nlohmann::json();
  document["units"] = {
      {"box", "m"}, {"volume", "m^3"}, {"mass", "kg"}, {"youngs_modulus", "Pa"}, {"density", "kg/m^3"}};
  return document;
}

/// In millimetres to 0.1 um: finer differences come from the positions of a mesh's nodes.
std::string in_mm(double length) {
  const double shown = std::round(1e3 * length * 1e4) / 1e4;
  return fmt::format("{:.6g}", shown == 0 ? 0.0 : shown);
}

std::string position_in_mm(const Vector3& x) {
  return fmt::format("{} {} {}", in_mm(x.x()), in_mm(x.y()), in_mm(x.z()));
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
  if (surface.kind == Kind::plane) return fmt::format("plane_{}", number);
  return fmt::format("{}_{}", surface.is_internal ? "bore" : "journal", number);
}

/// A name as YAML takes it for a text, also within braces: in quotes where it is no plain word.
std::string in_yaml(const std::string& name) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.' || c == '/';
  };
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  constexpr std::array<std::string_view, 9> values{"null", "true", "false", "yes", "no", "on", "off", "y", "n"};
  const bool begins_plain = !name.empty() && (std::isalpha(static_cast<unsigned char>(name[0])) != 0 || name[0] == '_');
  if (begins_plain && std::all_of(name.begin(), name.end(), is_plain) &&
      std::find(values.begin(), values.end(), lower) == values.end())
    return name;
  std::string quoted = "\"";
  for (const char c : name) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') quoted += '\\';
    if (code < 0x20 || code == 0x7f)
      quoted += fmt::format("\\x{:02x}", code);
    else
      quoted += c;
  }
  return quoted + '"';
}

/// The value of a frame at a found surface, and of the bearing that it could be (else empty).
struct SurfaceUse {
  std::string key, frame, bearing;
};

SurfaceUse use_of(const FoundSurface& surface, const std::string& key, const std::string& body) {
  SurfaceUse use{key, "", ""};
  const std::string name = in_yaml(surface.name);
  if (surface.kind == Kind::plane)
    use.frame = fmt::format("{{nodes: {}, origin: {} mm, connection: average}}", name, position_in_mm(surface.centre));
  else
    use.frame = fmt::format("{{nodes: {}, origin: {} mm{}, connection: average}}", name, position_in_mm(surface.centre),
                            rotation_to(surface.axis));
  if (surface.use() != Use::none)
    use.bearing = fmt::format("{{{1}: {0}, {1}_surface: {{faces: {4}}}, diameter: {2} mm, width: {3} mm}}",
                              in_yaml(body + "." + key), surface.use() == Use::bore ? "shell" : "journal",
                              in_mm(2 * surface.radius), in_mm(surface.width), name);
  return use;
}

nlohmann::json triangles_json(const Mesh& mesh, const std::vector<fem::ElementFace>& faces) {
  const fem::Skin skin = fem::skin(mesh, faces);
  std::vector<float> corners;
  corners.reserve(3 * skin.nodes.size());
  for (const int node : skin.nodes)
    for (const double x : mesh.nodes[static_cast<std::size_t>(node)]) corners.push_back(static_cast<float>(x));
  std::vector<int> triangles;
  triangles.reserve(3 * skin.triangles.size());
  for (const auto& t : skin.triangles) triangles.insert(triangles.end(), t.begin(), t.end());
  return {{"corners", corners}, {"triangles", triangles}};
}

/// Surfaces of the file that are none of those found.
std::vector<std::string> further_surfaces(const Mesh& mesh, const std::vector<FoundSurface>& found) {
  std::vector<std::string> names;
  for (const auto& [name, faces] : mesh.surfaces) {
    const auto is_it = [&, of = &name](const FoundSurface& surface) { return surface.name == *of; };
    if (!faces.empty() && std::none_of(found.begin(), found.end(), is_it)) names.push_back(name);
  }
  return names;
}

}  // namespace

std::string uses_json(const Mesh& mesh, const std::vector<FoundSurface>& found, const std::string& body) {
  nlohmann::json uses = nlohmann::json::array();
  std::size_t number = 0;
  const auto add = [&](const std::string& name, const SurfaceUse& use) {
    uses.push_back({{"name", name}, {"key", use.key}, {"frame", use.frame}, {"bearing", use.bearing}});
  };
  for (const FoundSurface& surface : found) {
    ++number;
    if (!mesh.surfaces.contains(surface.name)) continue;
    add(surface.name, use_of(surface, key_of(surface, number), body));
  }
  for (const std::string& name : further_surfaces(mesh, found)) {
    const bool is_word =
        std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
    add(name, {is_word ? name : fmt::format("surface_{}", ++number), fmt::format("{{nodes: {}}}", in_yaml(name)), ""});
  }
  return dumped(uses);
}

std::string picture_json(const Mesh& mesh, const std::vector<FoundSurface>& found) {
  const auto order = [](const fem::ElementFace& a, const fem::ElementFace& b) {
    return std::pair(a.element, a.face) < std::pair(b.element, b.face);
  };
  std::set<fem::ElementFace, decltype(order)> shown(order);
  nlohmann::json surfaces = nlohmann::json::array();
  const auto add = [&](const std::string& name, const std::vector<fem::ElementFace>& faces) {
    nlohmann::json surface = triangles_json(mesh, faces);
    surface["name"] = name;
    surfaces.push_back(std::move(surface));
    shown.insert(faces.begin(), faces.end());
  };
  for (const FoundSurface& surface : found) add(surface.name, surface.faces);
  for (const std::string& name : further_surfaces(mesh, found)) add(name, mesh.surfaces.at(name));
  std::vector<fem::ElementFace> rest;
  for (const fem::ElementFace& face : fem::outer_faces(mesh))
    if (!shown.contains(face)) rest.push_back(face);
  return dumped({{"surfaces", std::move(surfaces)}, {"rest", triangles_json(mesh, rest)}});
}

std::string mesh_json(const Mesh& mesh, const MeshQuality& quality) { return dumped(document_of(mesh, quality)); }

std::string found_json(const std::vector<FoundSurface>& found) {
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
  return dumped(surfaces);
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
    const SurfaceUse use = use_of(surface, key, "part");
    frames += fmt::format("      {}: {}\n", key, use.frame);
    bearings += fmt::format("  {}: {}\n", key, use.bearing);
  }
  if (frames.empty()) return "";
  return fmt::format(
      "in a model file, with what else the bearing needs (`hersey explain bearings`):\n"
      "bodies:\n  part:\n    flexible: {{mesh: {}, length_unit: {}}}   # and a material\n    frames:\n{}bearings:\n{}",
      in_yaml(file), length_unit, frames, bearings);
}

}  // namespace hersey::workbench
