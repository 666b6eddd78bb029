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
                 optional("rotation", rotation_format(), "Turns the frame's axes from the body's.", "none"),
                 optional("nodes", text("a set of nodes", "big_end"),
                          "Set of the mesh's nodes that the frame of a flexible body stands on."),
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

Key axis_key(const std::string& meaning) { return defaulted("axis", axis_format(), "z", meaning); }

Key initial_format(std::vector<Key> coordinates) {
  return defaulted(
      "initial", object("initial values of coordinates", std::move(coordinates)), "{}",
      "Where the joint starts, and how fast. Values given are kept; those left out start from 0 and move where loops, "
      "drives and couplings ask for it. Values that do not fit together are moved by the least that makes them fit, "
      "and "
      "told, if that is at most 1e-3 (rad, of the machine's size, of the largest rate); otherwise refused.");
}

Key guess_format(std::vector<Key> coordinates) {
  return defaulted(
      "guess", object("guesses of coordinates", std::move(coordinates)), "{}",
      "Where the search for coordinates that `initial` leaves open begins: chooses among the ways in which "
      "a loop can close. Not kept.");
}

Key angle_guess(const std::string& name) {
  return optional(name, quantity("rad", "30 deg"), "Angle near the start.", "0");
}
Key shift_guess(const std::string& name) {
  return optional(name, quantity("m", "0.1 mm"), "Displacement near the start.", "0");
}
Key orientation_guess() {
  return optional("orientation", vector("rad", "0 0 30 deg"), "Rotation vector near the start.", "0");
}
Key position_guess() {
  return optional("position", vector("m", "0 0.01 0 mm"), "Position near the start, inboard axes.", "0");
}

Key angle_key(const std::string& name) { return optional(name, quantity("rad", "30 deg"), "Angle at the start.", "0"); }
Key angle_rate_key(const std::string& name) {
  return optional(name, quantity("rad/s", "3570 rpm"), "Angular velocity at the start.", "0");
}
Key shift_key(const std::string& name) {
  return optional(name, quantity("m", "0.1 mm"), "Displacement at the start.", "0");
}
Key shift_rate_key(const std::string& name) {
  return optional(name, quantity("m/s", "2 m/s"), "Velocity at the start.", "0");
}

std::vector<Key> orientation_keys() {
  return {
      optional("orientation", vector("rad", "0 0 30 deg"), "Rotation vector at the start.", "0"),
      optional("angular_velocity", vector("rad/s", "0 0 3570 rpm"), "At the start, in the outboard frame's axes.", "0"),
  };
}

std::vector<Key> free_keys() {
  std::vector<Key> keys = {
      optional("position", vector("m", "0 0.01 0 mm"), "Position at the start, inboard axes.", "0"),
      optional("velocity", vector("m/s", "0 0 2 m/s"), "Velocity at the start, inboard axes.", "0"),
  };
  for (Key& key : orientation_keys()) keys.push_back(std::move(key));
  return keys;
}

std::vector<Key> planar_keys() {
  return {shift_key("x"),           shift_key("y"),           angle_key("rotation"),
          shift_rate_key("x_rate"), shift_rate_key("y_rate"), angle_rate_key("rotation_rate")};
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
  const TypePtr body =
      object("a body",
             {
                 optional("mass", quantity("kg", "5 kg", Range::not_negative()),
                          "Mass; 0 where joints, drives, dampers or films hold the body."),
                 optional("flexible", flexible_format(),
                          "The body deforms: its mesh takes the place of mass, centre and inertia."),
                 optional("beam", beam_format(),
                          "The body is a beam: section and material take the place of mass, centre and inertia."),
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
  const auto about = axis_key("Axis of rotation in the inboard frame: x, y, z or three numbers.");
  const auto along = axis_key("Axis of sliding in the inboard frame.");
  const auto both = axis_key("Axis of sliding and rotation in the inboard frame.");
  const auto normal = axis_key("Normal of the plane in the inboard frame.");
  const auto shaft = axis_key("Axis of the shafts in the inboard frame.");
  const auto thread = axis_key("Axis of the thread in the inboard frame.");
  return named(
      "a mapping from names to joints",
      variant("a joint", "type", {between_format()},
              {
                  {"fixed", "no motion", {}},
                  {"revolute",
                   "rotation about an axis; coordinate `rotation`",
                   {about, initial_format({angle_key("rotation"), angle_rate_key("rotation_rate")}),
                    guess_format({angle_guess("rotation")})}},
                  {"prismatic",
                   "sliding along an axis; coordinate `translation`",
                   {along, initial_format({shift_key("translation"), shift_rate_key("translation_rate")}),
                    guess_format({shift_guess("translation")})}},
                  {"cylindrical",
                   "sliding along and rotation about one axis; coordinates `translation`, `rotation`",
                   {both,
                    initial_format({shift_key("translation"), angle_key("rotation"), shift_rate_key("translation_rate"),
                                    angle_rate_key("rotation_rate")}),
                    guess_format({shift_guess("translation"), angle_guess("rotation")})}},
                  {"spherical",
                   "a ball; coordinate `orientation` (a rotation vector)",
                   {initial_format(orientation_keys()), guess_format({orientation_guess()})}},
                  {"planar",
                   "motion in a plane; coordinates `x`, `y`, `rotation`",
                   {normal, initial_format(planar_keys()),
                    guess_format({shift_guess("x"), shift_guess("y"), angle_guess("rotation")})}},
                  {"universal",
                   "a cross (Cardan) joint between shafts along `axis`: the cross turns about the first of the two "
                   "axes normal to it in the inboard frame (x for z, y for x, z for y) and about the second in the "
                   "outboard frame; coordinates `rotation_1`, `rotation_2`",
                   {shaft,
                    initial_format({angle_key("rotation_1"), angle_key("rotation_2"), angle_rate_key("rotation_1_rate"),
                                    angle_rate_key("rotation_2_rate")}),
                    guess_format({angle_guess("rotation_1"), angle_guess("rotation_2")})}},
                  {"screw",
                   "rotation about an axis with travel along it; coordinate `rotation`",
                   {thread, required("lead", quantity("m", "5 mm"), "Travel per turn, right-handed where positive."),
                    initial_format({angle_key("rotation"), angle_rate_key("rotation_rate")}),
                    guess_format({angle_guess("rotation")})}},
                  {"free",
                   "all six motions; coordinates `position`, `orientation`",
                   {initial_format(free_keys()), guess_format({position_guess(), orientation_guess()})}},
              }));
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
