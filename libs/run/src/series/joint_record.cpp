#include "series/joint_record.h"

#include <fmt/format.h>

namespace hersey::run {
namespace {

std::vector<std::string> coordinate_names(const mbd::JointSpec& joint) {
  std::vector<std::string> names;
  for (const mbd::Coordinate& coordinate : mbd::coordinates_of(joint.type)) {
    for (int i = 0; i < coordinate.size; ++i) {
      names.push_back(coordinate.size == 1 ? std::string(coordinate.name)
                                           : fmt::format("{}_{}", coordinate.name, "xyz"[i]));
    }
  }
  return names;
}

int degrees_of(const mbd::JointSpec& joint) { return mbd::degrees_of_freedom(joint.type); }
bool has_degrees(const mbd::JointSpec& joint) { return degrees_of(joint) > 0; }

/// Unit of values whose unit is `angle` or `length`.
std::string unit_of(const mbd::JointSpec& joint, const char* angle, const char* length) {
  return degrees_of(joint) > 1 ? "SI" : is_rotational(joint, 0) ? angle : length;
}

/// Units of all of them, where the unit is `angle` or `length`.
std::vector<std::string> units_of(const mbd::JointSpec& joint, const char* angle, const char* length) {
  std::vector<std::string> units;
  for (int k = 0; k < degrees_of(joint); ++k) units.emplace_back(is_rotational(joint, k) ? angle : length);
  return units;
}

template <class Member>
auto values_of(Member member) {
  return [member](const mbd::JointObservation& observation) {
    const mbd::JointValues& values = std::invoke(member, observation);
    return std::span<const double>(values.data(), static_cast<std::size_t>(values.size()));
  };
}

const QuantityTable<mbd::JointObservation, mbd::JointSpec>& joint_quantities() {
  static const Extent<mbd::JointSpec> coordinates{
      "k",
      [](const mbd::JointSpec& joint, std::size_t /*k*/) { return std::vector{degrees_of(joint)}; },
      {"coordinate"}};
  static const QuantityTable<mbd::JointObservation, mbd::JointSpec> table{
      {"coordinates",
       "rad|m|SI",
       "joint coordinates, names in the joint's attribute coordinate_names",
       values_of(&mbd::JointObservation::position),
       {.symbol = "q",
        .note = "[n] of a joint with one; `SI` of several: the attribute `column_units` has that of each",
        .only = has_degrees,
        .extent = coordinates,
        .unit = [](const mbd::JointSpec& joint) { return unit_of(joint, "rad", "m"); }}},
      {"rates",
       "rad/s|m/s|SI",
       "rates of the joint coordinates",
       values_of(&mbd::JointObservation::rate),
       {.note = "[n] of a joint with one; `SI` of several: the attribute `column_units` has that of each",
        .only = has_degrees,
        .extent = coordinates,
        .unit = [](const mbd::JointSpec& joint) { return unit_of(joint, "rad/s", "m/s"); }}},
      {"reaction_force", "N", "on the outboard body, inboard frame's axes", &mbd::JointObservation::force},
      {"reaction_torque", "N.m", "on the outboard body about the inboard frame", &mbd::JointObservation::torque},
  };
  return table;
}

const std::vector<Attribute<mbd::JointSpec>>& joint_name_attributes() {
  static const std::vector<Attribute<mbd::JointSpec>> table{
      {"coordinate_names", "", "of its coordinates", coordinate_names, {.only = has_degrees}}};
  return table;
}

std::string group_of(const mbd::JointSpec& joint) { return "/joints/" + joint.name + "/"; }

using JointRows = QuantityRows<mbd::JointObservation, mbd::JointSpec>;

JointRows declare_joint(const mbd::JointSpec& joint, const JointRows* other, results::Writer& writer) {
  if (degrees_of(joint) > 1)
    writer.labels(group_of(joint) + "coordinate", coordinate_names(joint), "joint coordinates");
  write_once(joint_name_attributes(), group_of(joint), joint, writer);
  JointRows rows{joint_quantities(), group_of(joint), joint, writer, other};
  if (degrees_of(joint) > 1) {
    writer.attribute(group_of(joint) + "coordinates", results::column_units, units_of(joint, "rad", "m"));
    writer.attribute(group_of(joint) + "rates", results::column_units, units_of(joint, "rad/s", "m/s"));
  }
  return rows;
}

}  // namespace

bool is_rotational(const mbd::JointSpec& joint, int value) {
  for (const mbd::Coordinate& coordinate : mbd::coordinates_of(joint.type)) {
    if (value >= coordinate.offset && value < coordinate.offset + coordinate.size) return coordinate.rotational;
  }
  return false;
}

JointRecord::JointRecord(const mbd::JointSpec& joint, const JointRecord* other, results::Writer& writer)
    : rows_(declare_joint(joint, other != nullptr ? &other->rows_ : nullptr, writer)) {}

void JointRecord::describe(QuantityGroup& group) {
  run::describe(joint_name_attributes(), "n", group);
  run::describe(joint_quantities(), "n", group);
}

}  // namespace hersey::run
