#include <string>
#include <utility>
#include <vector>

#include "hersey/mbd/joint.h"
#include "schema/format.h"
#include "schema/machine_vocabulary.h"

namespace hersey::model {

TypePtr rotation_format() {
  return object(
      "an axis and an angle",
      {
          required("axis", axis_format(), "Direction: x, y, z or three numbers, whose length does not matter."),
          required("angle", quantity("rad", "90 deg"), "Right-handed about the axis."),
      });
}

namespace {

TypePtr frames_format() {
  return named(
      "a mapping from names to frames",
      object("a frame",
             {
                 optional("origin", vector("m", "0 50 0 mm"), "From the body's origin.",
                          "0 0 0 m; with `nodes`, the centre of their faces"),
                 optional("rotation", rotation_format(), "Rotates the frame's axes from the body's.", "none"),
                 optional("nodes", text("a set of nodes", "big_end"),
                          "Set of the mesh's nodes to which the frame of a flexible body is attached."),
                 optional("connection", choice(connection_words), "How frame and nodes hold each other.", "rigid"),
                 optional("along",
                          or_word(quantity("m", "250 mm", Range::not_negative()),
                                  {{"start", "at its first point"}, {"end", "at its last point"}}),
                          "Where on a beam the frame sits: distance from its start along its axis.",
                          "**required** on beams"),
             }));
}

Key between_format() {
  return required("between", list("two frames", reference(Refers::frame, "crank.pin"), 2),
                  "Inboard and outboard frame, each `body` or `body.frame`; coordinates count from the first to the "
                  "second.");
}

/// Format of the values of a joint's coordinates, or of their rates: for one number and for three.
struct ValueFormat {
  std::string unit, example, three, text;
};

ValueFormat at_start(const mbd::Coordinate& coordinate) {
  if (coordinate.orientation) return {"rad", "", "0 0 30 deg", "Rotation vector at the start."};
  if (coordinate.rotational) return {"rad", "30 deg", "", "Angle at the start."};
  if (coordinate.size == 3) return {"m", "", "0 0.01 0 mm", "Position at the start, inboard axes."};
  return {"m", "0.1 mm", "", "Displacement at the start."};
}

ValueFormat rate_at_start(const mbd::Coordinate& coordinate) {
  if (coordinate.orientation) return {"rad/s", "", "0 0 3570 rpm", "At the start, in the outboard frame's axes."};
  if (coordinate.rotational) return {"rad/s", "3570 rpm", "", "Angular velocity at the start."};
  if (coordinate.size == 3) return {"m/s", "", "0 0 2 m/s", "Velocity at the start, inboard axes."};
  return {"m/s", "2 m/s", "", "Velocity at the start."};
}

ValueFormat near_start(const mbd::Coordinate& coordinate) {
  ValueFormat format = at_start(coordinate);
  format.text.replace(format.text.find("at the start"), std::string("at the start").size(), "near the start");
  return format;
}

Key value_key(const std::string& name, const ValueFormat& format) {
  return optional(name,
                  format.three.empty() ? quantity(format.unit, format.example) : vector(format.unit, format.three),
                  format.text, "0");
}

Key initial_key(mbd::JointType type) {
  std::vector<Key> values;
  for (const mbd::Coordinate& coordinate : mbd::coordinates_of(type))
    values.push_back(value_key(std::string(coordinate.name), at_start(coordinate)));
  for (const mbd::Coordinate& coordinate : mbd::coordinates_of(type))
    values.push_back(value_key(mbd::rate_name(coordinate), rate_at_start(coordinate)));
  return defaulted(
      "initial", object("initial values of coordinates", std::move(values)), "{}",
      "Where the joint starts, and how fast. Values given are kept; those left out start from 0 and move where loops, "
      "drives and couplings ask for it. Values that do not fit together are moved by the least that makes them fit, "
      "and reported, if that is at most 1e-3 (rad, of the machine's size, of the largest rate); otherwise refused.");
}

Key guess_key(mbd::JointType type) {
  std::vector<Key> values;
  for (const mbd::Coordinate& coordinate : mbd::coordinates_of(type))
    values.push_back(value_key(std::string(coordinate.name), near_start(coordinate)));
  return defaulted(
      "guess", object("guesses of coordinates", std::move(values)), "{}",
      "Where the search for coordinates that `initial` leaves open begins: chooses among the ways in which "
      "a loop can close. Not kept.");
}

/// Format of a joint type in the model file; its coordinates follow from the type.
struct JointFormat {
  mbd::JointType type;
  std::string text;
  std::string axis = {};  ///< description of its axis; empty: it has none
  std::vector<Key> more = {};
};

std::vector<JointFormat> joint_formats() {
  using enum mbd::JointType;
  return {
      {fixed, "no motion"},
      {revolute, "rotation about an axis; coordinate `rotation`",
       "Axis of rotation in the inboard frame: x, y, z or three numbers."},
      {prismatic, "sliding along an axis; coordinate `translation`", "Axis of sliding in the inboard frame."},
      {cylindrical, "sliding along and rotation about one axis; coordinates `translation`, `rotation`",
       "Axis of sliding and rotation in the inboard frame."},
      {spherical, "a ball; coordinate `orientation` (a rotation vector)"},
      {planar, "motion in a plane; coordinates `x`, `y`, `rotation`", "Normal of the plane in the inboard frame."},
      {universal,
       "a cross (Cardan) joint between shafts along `axis`: the cross rotates about the first of the two axes normal "
       "to "
       "it in the inboard frame (x for z, y for x, z for y) and about the second in the outboard frame; coordinates "
       "`rotation_1`, `rotation_2`",
       "Axis of the shafts in the inboard frame."},
      {screw,
       "rotation about an axis with travel along it; coordinate `rotation`",
       "Axis of the thread in the inboard frame.",
       {required("lead", quantity("m", "5 mm"), "Travel per revolution, right-handed where positive.")}},
      {free, "all six motions; coordinates `position`, `orientation`"},
  };
}

}  // namespace

TypePtr bodies_format() {
  const TypePtr moment = quantity("kg.m^2", "0.01 kg.m^2");
  const TypePtr principal = quantity("kg.m^2", "0.01 kg.m^2", Range::not_negative());
  const TypePtr inertia =
      object("moments of inertia",
             {
                 defaulted("xx", principal, "0", "Moment of inertia about x."),
                 defaulted("yy", principal, "0", "Moment of inertia about y."),
                 defaulted("zz", principal, "0", "Moment of inertia about z."),
                 defaulted("xy", moment, "0", "Element xy of the inertia matrix (minus the product of inertia)."),
                 defaulted("yz", moment, "0", "Element yz."),
                 defaulted("zx", moment, "0", "Element zx."),
             });
  const TypePtr frames = frames_format();
  const TypePtr body = object(
      "a body",
      {
          optional("mass", quantity("kg", "5 kg", Range::not_negative()),
                   "Mass; 0 where joints, drives, dampers or films hold the body."),
          optional("flexible", flexible_format(), "The body deforms: its mesh replaces mass, centre and inertia."),
          optional("beam", beam_format(), "The body is a beam: section and material replace mass, centre and inertia."),
          defaulted("inertia", inertia, "{}", "Inertia matrix about the centre of mass, body axes."),
          defaulted("centre_of_mass", vector("m", "0 48 0 mm"), "0 0 0 m", "From the body's origin, body axes."),
          optional("frames", frames, "Frames fixed on the body; `body` alone names the body's own frame."),
          optional("shapes", shapes_format(), "What the report draws of it, and what `contacts` name.",
                   "lines between its joints; of a flexible body or beam, its surface"),
      });
  const TypePtr ground =
      object("ground", {optional("frames", frames, "Frames fixed in space."),
                        optional("shapes", shapes_format(), "What the report draws of it, and what `contacts` name.")});
  return named("a mapping from names to bodies", with_exactly_one(body, {"mass", "flexible", "beam"}),
               {optional("ground", ground, "The resting body; it exists always and may carry frames.")});
}

TypePtr joints_format() {
  std::vector<Variant> kinds;
  for (JointFormat& joint : joint_formats()) {
    std::vector<Key> keys;
    if (!joint.axis.empty()) keys.push_back(defaulted("axis", axis_format(), "z", joint.axis));
    for (Key& key : joint.more) keys.push_back(std::move(key));
    if (mbd::degrees_of_freedom(joint.type) > 0) {
      keys.push_back(initial_key(joint.type));
      keys.push_back(guess_key(joint.type));
    }
    kinds.push_back({std::string(mbd::name_of(joint.type)), joint.text, std::move(keys)});
  }
  return named("a mapping from names to joints", variant("a joint", "type", {between_format()}, std::move(kinds)));
}

TypePtr drives_format() {
  const TypePtr drive = object(
      "a drive",
      {
          required("joint", reference(Refers::joint, "main"), "The joint driven."),
          required("coordinate", reference(Refers::coordinate, "rotation"), "Its coordinate; not an orientation."),
          optional("position", function_format({"rad", "m"}, "0 deg"), "Function of time the coordinate follows."),
          optional("speed", function_format({"rad/s", "m/s"}, "3570 rpm"),
                   "Function of time its rate follows, from the joint's initial position."),
          optional("acceleration", function_format({"rad/s^2", "m/s^2"}, "10 rad/s^2"),
                   "Function of time its second derivative follows, from the joint's initial position and rate."),
          defaulted("ramp", quantity("s", "50 ms", Range::not_negative()), "0 s",
                    "The motion is blended in over this time from the start of the run, twice differentiable: a speed "
                    "or acceleration from 0, a position from the joint's initial one."),
      });
  return named("a mapping from names to drives", with_exactly_one(drive, {"position", "speed", "acceleration"}));
}

}  // namespace hersey::model
