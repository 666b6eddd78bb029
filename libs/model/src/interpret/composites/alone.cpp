#include "interpret/composites/alone.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "check/members.h"

namespace hersey::model {
namespace {

/// A key of an operating point that has a value: neither left out, nor at fault, nor `none`.
const Value* given_number(const Value& point, const char* key) {
  const Value* found = point.find(key);
  return found != nullptr && !found->broken && found->text.empty() ? found : nullptr;
}

/// Reports a point in which not exactly one of two keys is given.
void require_one_of(const Value& point, const char* load, const char* place, std::vector<Fault>& faults) {
  const Value *first = given_number(point, load), *second = given_number(point, place);
  const auto report = [&](const Value& at, std::string found, std::string suggestion) {
    faults.push_back({at.key_position, at.path, std::move(found), "exactly one of them", std::move(suggestion)});
  };
  if (first != nullptr && second != nullptr)
    report(*second, fmt::format("keys '{}' and '{}' together", load, place),
           "with --set, give the other one as 'none'");
  if (first == nullptr && second == nullptr) report(point, fmt::format("neither '{}' nor '{}'", load, place), "");
}

void require_speed(const Value& point, const char* key, const std::string& found, std::vector<Fault>& faults) {
  const Value* speed = point.find(key);
  if (speed == nullptr || speed->broken || speed->number != 0) return;
  faults.push_back({speed->position, point.path + "." + key, found, "a speed, of either sign", ""});
}

}  // namespace

void read_journal_of_composite(const Value& bearing, CompositeParts& parts, std::vector<Fault>& faults) {
  const Value* value = bearing.find("operating_point");
  if (value == nullptr || value->broken) return;
  JournalPoint point;
  point.position = value->key_position;
  point.journal_speed = number_of(*value, "journal_speed");
  point.load_angle = number_of(*value, "load_angle");
  point.eccentricity_angle = number_of(*value, "eccentricity_angle");
  parts.whirl_ratio = number_of(*value, "whirl_ratio");
  if (const Value* load = given_number(*value, "load")) point.load = load->number;
  if (const Value* ratio = given_number(*value, "eccentricity_ratio")) point.eccentricity_ratio = ratio->number;
  require_one_of(*value, "load", "eccentricity_ratio", faults);
  require_speed(*value, "journal_speed", "a journal at rest, whose film bears nothing", faults);
  if (point.journal_speed != 0) parts.speed = point.journal_speed;
  parts.point = point;
}

void read_collar_of_composite(const Value& bearing, CompositeParts& parts, std::vector<Fault>& faults) {
  const Value* value = bearing.find("operating_point");
  if (value == nullptr || value->broken) return;
  ThrustPoint point;
  point.position = value->key_position;
  point.speed = number_of(*value, "speed");
  point.tilt_x = std::tan(number_of(*value, "tilt_x"));
  point.tilt_y = std::tan(number_of(*value, "tilt_y"));
  parts.whirl_ratio = number_of(*value, "whirl_ratio");
  if (const Value* load = given_number(*value, "load")) point.load = load->number;
  if (const Value* film = given_number(*value, "film_thickness")) point.film_thickness = film->number;
  require_one_of(*value, "load", "film_thickness", faults);
  require_speed(*value, "speed", "a collar at rest, which drags no oil into the film", faults);
  parts.point = point;
}

std::string journal_alone(const CompositeParts& parts) {
  const JournalPoint point =
      parts.point ? std::get<JournalPoint>(*parts.point) : JournalPoint{.journal_speed = 1, .eccentricity_ratio = 0};
  std::string text = fmt::format(
      "hersey: 1\nbodies:\n  journal: {{mass: 1 kg, inertia: {{xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}}}\n"
      "joints:\n  journal: {{type: planar, between: [ground, journal], axis: z}}\n"
      "drives:\n  rotation: {{joint: journal, coordinate: rotation, speed: {} rad/s}}\n",
      point.journal_speed);
  if (point.load) {
    text += fmt::format("forces:\n  load: {{type: force, body: journal, components: [{} N, {} N, 0 N]}}\n",
                        *point.load * std::cos(point.load_angle), *point.load * std::sin(point.load_angle));
  } else {
    const double e = *point.eccentricity_ratio * parts.clearance;
    for (const auto& [axis, at] : {std::pair{'x', e * std::cos(point.eccentricity_angle)},
                                   std::pair{'y', e * std::sin(point.eccentricity_angle)}})
      text += fmt::format("  {0}: {{joint: journal, coordinate: {0}, position: {1} m}}\n", axis, at);
  }
  return text + "simulation: {analysis: steady}\n";
}

std::string collar_alone(const CompositeParts& parts) {
  const ThrustPoint point =
      parts.point ? std::get<ThrustPoint>(*parts.point) : ThrustPoint{.speed = 1, .film_thickness = parts.clearance};
  // Its axis, turned about x and then about y, leans by the slopes a_x and a_y (thrust.11).
  const double about_x = -std::atan(point.tilt_y), about_y = std::atan(point.tilt_x * std::cos(about_x));
  // The search measures motions by the size that masses have; what rotates has none, and no gyroscopic moments.
  std::string text = fmt::format(
      "hersey: 1\nbodies:\n  lift: {{mass: 0 kg}}\n  collar: {{mass: 0 kg}}\n"
      "  tilt: {{mass: 1 kg, inertia: {{xx: {0} kg.m^2, yy: {0} kg.m^2, zz: {0} kg.m^2}}}}\n"
      "joints:\n  distance: {{type: prismatic, between: [ground, lift], axis: z, initial: {{translation: {1} m}}}}\n"
      "  tilts: {{type: universal, between: [lift, tilt], axis: z}}\n"
      "  rotation: {{type: revolute, between: [tilt, collar], axis: z}}\n"
      "drives:\n  rotation: {{joint: rotation, coordinate: rotation, speed: {2} rad/s}}\n"
      "  about_x: {{joint: tilts, coordinate: rotation_1, position: {3} rad}}\n"
      "  about_y: {{joint: tilts, coordinate: rotation_2, position: {4} rad}}\n",
      parts.pivot_radius * parts.pivot_radius, point.film_thickness.value_or(parts.clearance), point.speed, about_x,
      about_y);
  if (point.load) {
    text += fmt::format("forces:\n  load: {{type: force, body: collar, axes: ground, components: [0 N, 0 N, {} N]}}\n",
                        -*point.load);
  } else {
    text += fmt::format("  distance: {{joint: distance, coordinate: translation, position: {} m}}\n",
                        *point.film_thickness);
  }
  return text + "simulation: {analysis: steady}\n";
}

}  // namespace hersey::model
