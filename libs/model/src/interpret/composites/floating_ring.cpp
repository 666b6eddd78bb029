#include "interpret/composites/floating_ring.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "check/members.h"
#include "interpret/composites/pad_parts.h"
#include "schema/bearing_keys.h"

// A floating ring: a body between two films, in the plane across the bearing.
namespace hersey::model {
namespace {

/// Speed of a ring over that of the journal, to begin with: both films have about the same friction.
constexpr double usual_speed_ratio = 0.25;

/// Size of one of its films [m].
struct RingFilm {
  double radius = 0, width = 0, clearance = 0;
};

RingFilm film_of_ring(const Value& value) {
  const Value* diametral = value.find("diametral_clearance");
  return {.radius = 0.5 * number_of(value, "diameter"),
          .width = number_of(value, "width"),
          .clearance = diametral != nullptr ? 0.5 * diametral->number : number_of(value, "radial_clearance")};
}

/// Keys of the entry that both films have.
bool is_of_both_films(const std::string& key) {
  return key == "shear_force" || find_key(shared_bearing_keys(), key) != nullptr;
}

/// Reports what cannot be: a ring without a wall, or one that nothing keeps off the shell.
void check_ring(const Value& value, const RingFilm& inner, const RingFilm& outer, const CompositeParts& parts,
                std::vector<Fault>& faults) {
  const double bore = inner.radius, outside = outer.radius - outer.clearance;
  if (outside <= bore) {
    const Value& at = *value.find("outer")->find("diameter");
    faults.push_back(
        {at.position, at.path, fmt::format("{:.6g} mm, in which a ring of that bore has no wall", 2e3 * outer.radius),
         fmt::format("more than {:.6g} mm, bore of the ring and outer clearance", 2e3 * (bore + outer.clearance)), ""});
  }
  const Value& ring = *value.find("ring");
  const auto* point = parts.point ? std::get_if<JournalPoint>(&*parts.point) : nullptr;
  if (ring.find("rotation")->text == "locked" && number_of(ring, "centring_stiffness") == 0 && point != nullptr &&
      point->load) {
    const Value& at = *ring.find("rotation");
    faults.push_back({at.position, at.path, "a locked ring under a load, which sinks through its outer film",
                      "a 'centring_stiffness', or an 'eccentricity_ratio' instead of the load", ""});
  }
}

}  // namespace

std::optional<Node> floating_ring(const Node& node, const Value& value, const std::string& shell,
                                  const std::string& journal, CompositeParts& parts, std::vector<Fault>& faults) {
  const RingFilm inner = film_of_ring(*value.find("inner")), outer = film_of_ring(*value.find("outer"));
  const Value& ring = *value.find("ring");
  parts.clearance = inner.clearance + outer.clearance;
  parts.sections = {"inner", "outer"};
  const std::size_t faults_before = faults.size();
  check_ring(value, inner, outer, parts, faults);
  if (faults.size() > faults_before) return std::nullopt;

  // A hollow cylinder, theory manual eq. (rings.1).
  const double r = inner.radius, R = outer.radius - outer.clearance, width = std::max(inner.width, outer.width);
  const double of_density = number_of(ring, "density") * std::numbers::pi * (R * R - r * r) * width;
  const double mass = ring.find("mass") != nullptr ? number_of(ring, "mass") : of_density;
  const double axial = 0.5 * mass * (R * R + r * r), across = 0.5 * axial + mass * width * width / 12;
  const Value* given = ring.find("initial_speed");
  const bool is_free = ring.find("rotation")->text == "free";
  const double speed = !is_free ? 0 : given != nullptr ? given->number : usual_speed_ratio * parts.speed;

  std::string text = fmt::format(
      "bodies:\n  {0}_ring: {{mass: {1} kg, inertia: {{xx: {2} kg.m^2, yy: {2} kg.m^2, zz: {3} kg.m^2}}}}\n"
      "joints:\n  {0}_ring: {{type: planar, between: [{4}, {0}_ring], axis: z, initial: {{rotation_rate: {5} "
      "rad/s}}}}\n",
      parts.name, mass, across, axial, shell, speed);
  if (!is_free)
    text += fmt::format("drives:\n  {0}_pin: {{joint: {0}_ring, coordinate: rotation, position: 0 rad}}\n", parts.name);
  if (const double stiffness = number_of(ring, "centring_stiffness"); stiffness > 0)
    text += fmt::format(
        "forces:\n  {0}_centring: {{type: bushing, between: [{1}, {0}_ring], stiffness: [{2} N/m, {2} N/m, 0 N/m]}}\n",
        parts.name, shell, stiffness);
  text += fmt::format(
      "bearings:\n  {0}_inner: {{shell: {0}_ring, journal: {1}}}\n  {0}_outer: {{shell: {2}, journal: {0}_ring}}\n",
      parts.name, journal, shell);
  Node tree = parts_tree(text, parts.position);
  for (const std::string& section : parts.sections) {
    const std::string name = parts.name + "_" + section;
    parts.pads.push_back(name);
    Node& film = *tree.find("bearings")->find(name);
    for (const Entry& own : node.find(section)->entries) {
      film.entries.push_back(own);
      parts.own_keys.push_back(section + "." + own.key);
    }
    for (const Entry& own : node.entries)
      if (is_of_both_films(own.key) && film.find(own.key) == nullptr) film.entries.push_back(own);
  }
  return tree;
}

}  // namespace hersey::model
