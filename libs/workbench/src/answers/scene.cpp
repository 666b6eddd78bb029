#include "answers/scene.h"

#include <algorithm>
#include <array>
#include <variant>

#include "answers/scene_parts.h"
#include "hersey/bearing/film_coordinates.h"
#include "hersey/mbd/joint.h"
#include "hersey/report/instant.h"

namespace hersey::workbench {
namespace {

using model::TextEntry;
using model::TextMap;

// Sections whose parts can be selected, and parts of theirs.
constexpr std::array<const char*, 9> kSections{"bodies",   "joints",    "drives",  "forces",    "contacts",
                                               "bearings", "couplings", "thermal", "lubricants"};
constexpr std::array<const char*, 6> kInner{"frames", "shapes", "features", "arcs", "supply", "pads"};

constexpr int kLastDepth = 2;  // of a part of a part

Json place_of(const TextEntry& entry, const TextColumns& columns) {
  return {{"line", entry.key_at.line},
          {"column", columns.utf16(entry.key_at.line, entry.key_at.column)},
          {"endLine", std::max(entry.key_at.line, entry.value_at.end_line)}};
}

std::string with_slashes(const std::string& path) {
  std::string slashes = "/" + path;
  std::replace(slashes.begin(), slashes.end(), '.', '/');
  return slashes;
}

/// Adds the children of an entry, and theirs where they are parts of a body or bearing.
void add_sources(const TextMap& map, const TextEntry& entry, const TextColumns& columns, int depth, Json& sources) {
  for (const std::size_t child : entry.children) {
    const TextEntry& part = map.entries()[child];
    if (depth == 1 && std::find(kInner.begin(), kInner.end(), part.key) == kInner.end()) continue;
    sources[with_slashes(part.path)] = place_of(part, columns);
    if (depth < kLastDepth) add_sources(map, part, columns, depth + 1, sources);
  }
}

/// Parts that templates or bearings of several films bring in: where the reader says they are.
void add_source(const model::Model& model, const TextMap& map, const TextColumns& columns, const std::string& path,
                Json& sources) {
  const std::string key = with_slashes(path);
  if (sources.contains(key)) return;
  const SourcePosition at = model.position_of(path);
  if (at.line < 1 || at.file != model.file) return;
  if (const TextEntry* entry = map.at(at.line, at.column))
    sources[key] = place_of(*entry, columns);
  else
    sources[key] = {{"line", at.line}, {"column", columns.utf16(at.line, at.column)}, {"endLine", at.line}};
}

Json sources_of(const model::Model& model, const TextMap& map, const TextColumns& columns) {
  Json sources = Json::object();
  for (const char* section : kSections)
    if (const TextEntry* entry = map.find(section)) add_sources(map, *entry, columns, 0, sources);
  for (const char* section : {"circuit.nodes", "circuit.elements"})
    if (const TextEntry* entry = map.find(section)) add_sources(map, *entry, columns, kLastDepth, sources);
  if (const TextEntry* entry = map.find("gravity")) sources["/gravity"] = place_of(*entry, columns);
  const auto add = [&](const auto& parts, const std::string& section) {
    for (const auto& part : parts) add_source(model, map, columns, section + part.name, sources);
  };
  add(model.bodies, "bodies.");
  add(model.joints, "joints.");
  add(model.forces, "forces.");
  add(model.contacts, "contacts.");
  add(model.bearings, "bearings.");
  return sources;
}

Json numbers(const Eigen::VectorXd& values) { return std::vector<double>(values.begin(), values.end()); }

/// A hole, groove or pocket as it lies over the unwrapped film.
Json feature_json(const film::SurfaceFeature& feature, const film::FilmModel& film, const std::string& path,
                  const Json& sources) {
  const double beyond = bearing::is_on_annulus(film) ? film.R : 0;
  Json json{{"name", feature.name},
            {"kind", std::holds_alternative<film::Ellipse>(feature.shape) ? "hole" : "groove"},
            {"surface", feature.surface == film::Surface::journal ? "moving" : "fixed"},
            {"phi", feature.phi},
            {"z", feature.z + beyond},
            {"arc", feature.arc},
            {"length", feature.length},
            {"key", path}};
  const auto source = sources.find(with_slashes(path));
  json["source"] = source == sources.end() ? Json() : *source;
  return json;
}

/// The arcs of a bore and the keys that hold them: each its own, or that of the bore which makes them alike.
Json arcs_json(const model::Bearing& bearing, const model::Model& model) {
  Json list = Json::array();
  const std::string path = "bearings." + bearing.name;
  const bool is_of_bore = model.positions.contains(path + ".bore");
  for (const film::Profile& profile : bearing.film.profiles) {
    const auto* arcs = std::get_if<film::Arcs>(&profile.shape);
    if (arcs == nullptr) continue;
    for (const film::Arc& arc : arcs->arcs)
      list.push_back({{"name", arc.name},
                      {"from", arc.from},
                      {"to", arc.to},
                      {"key", is_of_bore ? path + ".bore" : path + ".arcs." + arc.name},
                      {"isOfBore", is_of_bore}});
  }
  return list;
}

Json bearing_json(const model::Bearing& bearing, const model::Model& model, const Json& sources) {
  const film::FilmModel& film = bearing.film;
  const bearing::FilmCoordinate along = bearing::coordinate_along(film), across = bearing::coordinate_across(film);
  Json json{
      {"radius", film.R}, {"width", film.L}, {"clearance", film.c}, {"along", along.name}, {"across", across.name}};
  json["grid"] = {{"circumferential", film.grid.n_phi},
                  {"axial", film.grid.n_z},
                  {"along", numbers(along.values)},
                  {"across", numbers(across.values)},
                  {"closes", film.grid.closes()}};
  if (film::is_round(film.surface) && !film.grid.closes()) json["grid"]["arcs"] = film::arc_of_lines(film.grid);
  json["features"] = Json::array();
  for (const film::SurfaceFeature& feature : film.features)
    json["features"].push_back(
        feature_json(feature, film, "bearings." + bearing.name + ".features." + feature.name, sources));
  if (Json arcs = arcs_json(bearing, model); !arcs.empty()) json["arcs"] = std::move(arcs);
  if (film.supply.kind != film::SupplyKind::none)
    json["supply"] = {{"at", film.supply.kind == film::SupplyKind::widest_gap ? Json("widest_gap") : Json("angle")},
                      {"phi", film.supply.phi}};
  return json;
}

}  // namespace

Json poses_json(const run::Picture& picture) {
  Json bodies = Json::object();
  for (const auto& [name, pose] : picture.poses()) {
    const Eigen::Quaterniond turn(pose.R);
    bodies[name] = {{"position", {pose.r.x(), pose.r.y(), pose.r.z()}},
                    {"orientation", {turn.w(), turn.x(), turn.y(), turn.z()}}};
  }
  return bodies;
}

Json joints_json(const model::Model& model, const run::Picture& picture) {
  Json joints = Json::object();
  if (model.bodies.empty()) return joints;
  for (const model::Joint& joint : model.joints) {
    Json list = Json::array();
    for (const mbd::Coordinate& coordinate : mbd::coordinates_of(joint.type)) {
      if (coordinate.size != 1) continue;
      const std::string name(coordinate.name);
      list.push_back({{"name", name},
                      {"unit", coordinate.rotational ? "rad" : "m"},
                      {"value", picture.coordinate(joint.name, name)}});
    }
    joints[joint.name] = std::move(list);
  }
  return joints;
}

std::string scene_json(const model::Model& model, const run::Picture& picture, const TextMap& map,
                       const TextColumns& columns) {
  results::Writer writer(results::InMemory{.keeps_all = true});
  picture.write(writer);
  std::string scene = report::instant_json(writer, model.title);
  Json beside{{"sources", sources_of(model, map, columns)}};
  beside["bearings"] = Json::object();
  for (const model::Bearing& bearing : model.bearings)
    beside["bearings"][bearing.name] = bearing_json(bearing, model, beside["sources"]);
  beside["loads"] = loads_json(model, picture);
  beside["frames"] = frames_json(model);
  if (model.circuit) beside["circuit"] = circuit_json(model);
  beside["joints"] = joints_json(model, picture);
  beside["open"] = picture.assembly().solved() ? "" : picture.assembly().message;
  // One object of both, without reading the first again: it may be megabytes.
  scene.back() = ',';
  return scene + dumped(beside).substr(1);
}

}  // namespace hersey::workbench
