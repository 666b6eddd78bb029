#include "schema/format.h"
#include "schema/machine_vocabulary.h"

namespace hersey::model {
namespace {

const Range kNotNegative = Range::not_negative();

std::vector<Key> load_keys(const std::string& unit, const std::string& example) {
  const TypePtr function = function_format({unit}, example);
  return {
      required("body", reference(Refers::frame, "rod.small_end"), "Where it acts: `body` or `body.frame`."),
      optional("components", list("three functions", function, 3), "Along x, y and z."),
      optional("direction", axis_format(),
               "Direction of `magnitude`: x, y, z or three numbers, whose length does not matter."),
      optional("magnitude", function, "Along `direction`."),
      defaulted("axes", choice(axes_of_frame_words), "ground", "Axes of `components` or `direction`."),
  };
}

Key mesh_body_key() { return required("body", reference(Refers::body, "rod"), "The flexible body."); }

Key faces_key() {
  return required(
      "faces", text("a surface or a set of nodes", "big_end"),
      "Where on its mesh: a surface, or a set of nodes, which means the faces all of whose nodes are in it.");
}

std::vector<Key> pressure_keys() {
  return {
      mesh_body_key(),
      faces_key(),
      required("pressure", function_format({"Pa"}, "20 MPa"),
               "Pushes against the outward normals of the undeformed body; a function of time or of the crank's "
               "rotation."),
      optional("towards", axis_format(),
               "Where a pin in a bore pushes, body axes: the pressure there, falling as the cosine of the angle to "
               "nothing at 90 deg and beyond.",
               "the same pressure on all faces"),
  };
}

std::vector<Key> surface_force_keys() {
  const TypePtr function = function_format({"N"}, "500 N");
  return {
      mesh_body_key(),
      faces_key(),
      optional("components", list("three functions", function, 3),
               "The whole force along x, y and z; functions of time or of the crank's rotation."),
      optional("direction", axis_format(), "Direction of `magnitude`: x, y, z or three numbers."),
      optional("magnitude", function, "The whole force along `direction`."),
      defaulted("axes", choice(axes_of_body_words), "ground", "Axes of `components` or `direction`."),
  };
}

Key joint_key() { return required("joint", reference(Refers::joint, "main"), "The joint it acts in."); }

Key coordinate_key() {
  return defaulted("coordinate", reference(Refers::coordinate, "rotation"), "rotation", "Its coordinate.");
}

Key ends_key() {
  return required("between", list("two frames", reference(Refers::frame, "rod.small_end"), 2), "Its two ends.");
}

std::vector<Key> bushing_keys() {
  const TypePtr matrix = list("six rows", list("six numbers", number("1e6"), 6), 6);
  return {
      ends_key(),
      defaulted("stiffness", vector("N/m", "1e6 1e6 2e6 N/m"), "0 0 0 N/m", "Along x, y, z of the first frame."),
      defaulted("rotational_stiffness", vector("N.m/rad", "500 500 10 N.m/rad"), "0 0 0 N.m/rad", "About x, y, z."),
      defaulted("damping", vector("N.s/m", "100 100 100 N.s/m"), "0 0 0 N.s/m", "Along x, y, z."),
      defaulted("rotational_damping", vector("N.m.s/rad", "1 1 1 N.m.s/rad"), "0 0 0 N.m.s/rad", "About x, y, z."),
      optional("stiffness_matrix", matrix,
               "Further stiffness, SI units, x, y, z and then the rotations; symmetric, positive semidefinite."),
      optional("damping_matrix", matrix, "Further damping, likewise."),
  };
}

std::vector<Key> friction_keys() {
  return {
      joint_key(),
      coordinate_key(),
      defaulted("coulomb", quantity_in({"N.m", "N"}, "0.5 N.m", kNotNegative), "0 N.m",
                "Friction torque or force while sliding: friction coefficient times normal force times radius."),
      defaulted("viscous", quantity_in({"N.m.s/rad", "N.s/m"}, "0.01 N.m.s/rad", kNotNegative), "0 N.m.s/rad",
                "Torque or force per speed."),
      required("transition_speed", quantity_in({"rad/s", "m/s"}, "0.01 rad/s", Range::positive()),
               "Speed v_t of the smooth passage through zero, `coulomb` v/sqrt(v^2 + v_t^2): below it the joint creeps "
               "instead of sticking."),
  };
}

std::vector<Key> control_keys() {
  return {
      joint_key(),
      coordinate_key(),
      required("speed", function_format({"rad/s", "m/s"}, "3570 rpm"), "The speed wanted, a function of time."),
      required("proportional", quantity_in({"N.m.s/rad", "N.s/m"}, "2 N.m.s/rad", kNotNegative),
               "Torque or force per missing speed."),
      defaulted("integral", quantity_in({"N.m/rad", "N/m"}, "5 N.m/rad", kNotNegative), "0 N.m/rad",
                "Torque or force per missing angle or way."),
      optional("limit", quantity_in({"N.m", "N"}, "20 N.m", Range::positive()),
               "Largest torque or force, both ways; the integral part does not wind up beyond it.", "none"),
  };
}

std::vector<Key> torsion_keys() {
  return {
      joint_key(),
      coordinate_key(),
      defaulted("stiffness", quantity("N.m/rad", "100 N.m/rad", kNotNegative), "0", "Stiffness."),
      defaulted("damping", quantity("N.m.s/rad", "0.1 N.m.s/rad", kNotNegative), "0", "Damping."),
      defaulted("free_angle", quantity("rad", "0 deg"), "0", "Angle without torque."),
      optional("torque", law_format("N.m", "angle", "rad", "5 N.m"),
               "Further torque that pulls back, over the angle from `free_angle`; its energy is not counted."),
  };
}

std::vector<Key> sliding_keys() {
  return {
      joint_key(),
      defaulted("coordinate", reference(Refers::coordinate, "translation"), "translation", "Its coordinate."),
      defaulted("stiffness", quantity("N/m", "1e5 N/m", kNotNegative), "0", "Stiffness."),
      defaulted("damping", quantity("N.s/m", "10 N.s/m", kNotNegative), "0", "Damping."),
      defaulted("free_position", quantity("m", "0 mm"), "0", "Position without force."),
      optional("force", law_format("N", "stretch", "m", "50 N"),
               "Further force that pulls back, over the stretch from `free_position`; its energy is not counted."),
  };
}

}  // namespace

TypePtr forces_format() {
  const TypePtr force =
      variant("a force", "type", {},
              {
                  {"force", "a force at a point of a body", load_keys("N", "500 N")},
                  {"torque", "a torque on a body", load_keys("N.m", "5 N.m")},
                  {"pressure", "a pressure on faces of a flexible body's mesh, with which it turns", pressure_keys()},
                  {"surface_force", "a force spread evenly over faces of a flexible body's mesh", surface_force_keys()},
                  {"spring_damper",
                   "along the line between two points",
                   {
                       ends_key(),
                       defaulted("stiffness", quantity("N/m", "1e5 N/m", kNotNegative), "0", "Stiffness."),
                       defaulted("damping", quantity("N.s/m", "10 N.s/m", kNotNegative), "0", "Damping."),
                       defaulted("free_length", quantity("m", "50 mm", kNotNegative), "0", "Length without force."),
                       optional("tension", law_format("N", "length", "m", "50 N"),
                                "Further pull over the distance of the two ends; its energy is not counted."),
                   }},
                  {"torsion_spring", "on a rotational joint coordinate", torsion_keys()},
                  {"sliding_spring", "on a translational joint coordinate", sliding_keys()},
                  {"bushing", "elastic in all six directions; turns less than 170 deg", bushing_keys()},
                  {"joint_friction", "dry and viscous friction on a joint coordinate", friction_keys()},
                  {"speed_control", "a motor with a PI controller that turns a joint coordinate at a wanted speed",
                   control_keys()},
              });
  return named("a mapping from names to forces",
               with_together(with_exactly_one(force, {"components", "magnitude"}), {"direction", "magnitude"}));
}

TypePtr couplings_format() {
  const TypePtr coordinate = text("joint.coordinate", "main.rotation");
  const Key input = required("input", coordinate, "A scalar coordinate, `joint.coordinate`.");
  const Key output = required("output", coordinate, "The coordinate that follows.");
  const TypePtr term = object("an input", {input, required("factor", number("0.5"), "Its factor.")});
  const TypePtr coupling = variant(
      "a coupling", "type", {output},
      {
          {"gear",
           "output = ratio times input, both rotations or both translations, from where the joints start",
           {input, required("ratio", number("-2.5"),
                            "Turns of the output per turn of the input; negative where they "
                            "turn against each other.")}},
          {"rack",
           "output (a translation) = radius times input (a rotation), from where the joints start",
           {input, required("radius", quantity("m", "20 mm"), "Pitch radius; negative to run the other way.")}},
          {"linear",
           "output = sum of factors times inputs, all rotations or all translations, from where the joints start: a "
           "differential",
           {required("inputs", list("inputs", term), "What is added up.")}},
          {"relation",
           "output = function of the input: a cam",
           {input, required("function", relation_format(), "The output over the input.")}},
      });
  return named("a mapping from names to couplings", coupling);
}

}  // namespace hersey::model
