// The section `forces`: of each type its keys, how they are read, and its name, in this order.
#include <Eigen/Cholesky>
#include <functional>
#include <limits>

#include "interpret/context/interpret.h"
#include "schema/format.h"
#include "schema/machine_vocabulary.h"

namespace hersey::model {
namespace {

const Range kNotNegative = Range::not_negative();

Key joint_key() { return required("joint", reference(Refers::joint, "main"), "The joint it acts in."); }

Key coordinate_key() {
  return defaulted("coordinate", reference(Refers::coordinate, "rotation"), "rotation", "Its coordinate.");
}

Key ends_key() {
  return required("between", list("two frames", reference(Refers::frame, "rod.small_end"), 2), "Its two ends.");
}

/// A coordinate and what it is measured in; reports where it does not exist or is not of the kind wanted.
struct FoundCoordinate {
  CoordinateName name;
  bool rotational = true;
  bool valid = false;
};

FoundCoordinate acted_on(Context& context, const Value& value) {
  const auto coordinate = coordinate_of(context, value);
  return {{text_of(value, "joint"), text_of(value, "coordinate")},
          coordinate && coordinate->rotational,
          coordinate.has_value()};
}

/// Reports a quantity whose unit does not fit the coordinate; a zero left at its default fits both.
void require_unit(Context& context, const Value& value, const std::string& key, const FoundCoordinate& on,
                  const std::string& rotational, const std::string& translational) {
  const Value* given = value.find(key);
  if (given == nullptr || given->broken || !on.valid || given->number == 0) return;
  const std::string& wanted = on.rotational ? rotational : translational;
  if (given->unit == wanted) return;
  context.fault(
      *given, "a value in " + given->unit, "a value in " + wanted,
      std::string("coordinate '") + on.name.coordinate + "' is " + (on.rotational ? "a rotation" : "a translation"));
}

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

BodyLoad load_of(Context& context, const Value& value, bool is_torque) {
  BodyLoad load;
  load.is_torque = is_torque;
  const std::string unit = is_torque ? "N.m" : "N";
  if (const Value* body = value.find("body")) load.at = frame_of(context, *body);
  load.axes = meaning_of(value, "axes", axes_of_frame_words);
  if (const Value* components = value.find("components")) {
    for (const auto& [index, component] : components->members) {
      load.functions.push_back(function_of(context, component, unit));
    }
  }
  if (value.find("direction") != nullptr) load.direction = direction_of(context, value, "direction");
  if (const Value* magnitude = value.find("magnitude")) {
    load.functions.push_back(function_of(context, *magnitude, unit));
  }
  return load;
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

std::vector<Key> spring_damper_keys() {
  return {
      ends_key(),
      defaulted("stiffness", quantity("N/m", "1e5 N/m", kNotNegative), "0", "Stiffness."),
      defaulted("damping", quantity("N.s/m", "10 N.s/m", kNotNegative), "0", "Damping."),
      defaulted("free_length", quantity("m", "50 mm", kNotNegative), "0", "Length without force."),
      optional("tension", law_format("N", "length", "m", "50 N"),
               "Further pull over the distance of the two ends; its energy is its integral from the start."),
  };
}

SpringDamper spring_damper_of(Context& context, const Value& value) {
  auto [from, to] = pair_of(context, value);
  SpringDamper spring{std::move(from),
                      std::move(to),
                      number_of(value, "stiffness"),
                      number_of(value, "damping"),
                      number_of(value, "free_length"),
                      {}};
  if (const Value* tension = value.find("tension"))
    spring.tension = function_of(context, *tension, "N", {"length", "m"});
  return spring;
}

std::vector<Key> torsion_keys() {
  return {
      joint_key(),
      coordinate_key(),
      defaulted("stiffness", quantity("N.m/rad", "100 N.m/rad", kNotNegative), "0", "Stiffness."),
      defaulted("damping", quantity("N.m.s/rad", "0.1 N.m.s/rad", kNotNegative), "0", "Damping."),
      defaulted("free_angle", quantity("rad", "0 deg"), "0", "Angle without torque."),
      optional("torque", law_format("N.m", "angle", "rad", "5 N.m"),
               "Further torque that pulls back, over the angle from `free_angle`; its energy is its integral."),
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
               "Further force that pulls back, over the stretch from `free_position`; its energy is its integral."),
  };
}

CoordinateSpring coordinate_spring_of(Context& context, const Value& value, bool rotational) {
  CoordinateSpring spring;
  const FoundCoordinate on = acted_on(context, value);
  spring.on = on.name;
  spring.stiffness = number_of(value, "stiffness");
  spring.damping = number_of(value, "damping");
  spring.free_position = number_of(value, rotational ? "free_angle" : "free_position");
  if (const Value* law = value.find(rotational ? "torque" : "force"))
    spring.restoring = function_of(context, *law, rotational ? "N.m" : "N",
                                   rotational ? Argument{"angle", "rad"} : Argument{"stretch", "m"});
  if (on.valid && on.rotational != rotational) {
    context.fault(*value.find("coordinate"),
                  "coordinate '" + on.name.coordinate + (on.rotational ? "', a rotation" : "', a displacement"),
                  rotational ? "a rotational coordinate" : "a translational coordinate",
                  rotational ? "sliding_spring acts on displacements" : "torsion_spring acts on rotations");
  }
  return spring;
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

/// The six rows under `key`, x, y, z first, reordered to rotations first.
Matrix6 matrix_of(const Value& value, const std::string& key) {
  Matrix6 given = Matrix6::Zero();
  const Value* rows = value.find(key);
  if (rows == nullptr || rows->broken) return given;
  for (std::size_t i = 0; i < rows->members.size() && i < 6; ++i) {
    const Value& row = rows->members[i].value;
    for (std::size_t j = 0; j < row.members.size() && j < 6; ++j)
      given(static_cast<Eigen::Index>((i + 3) % 6), static_cast<Eigen::Index>((j + 3) % 6)) =
          row.members[j].value.number;
  }
  return given;
}

/// Stiffness or damping: the diagonal and the matrix together, symmetric and positive semidefinite.
Matrix6 bushing_matrix(Context& context, const Value& value, const std::string& quantity) {
  for (const std::string& key : {"rotational_" + quantity, quantity}) {
    const Value* given = value.find(key);
    if (given != nullptr && !given->broken && vector_of(value, key).minCoeff() < 0)
      context.fault(*given, "a negative " + quantity, "three values >= 0");
  }
  Matrix6 matrix = matrix_of(value, quantity + "_matrix");
  matrix.diagonal().head<3>() += vector_of(value, "rotational_" + quantity);
  matrix.diagonal().tail<3>() += vector_of(value, quantity);
  const Value* rows = value.find(quantity + "_matrix");
  const double size = matrix.cwiseAbs().maxCoeff();
  if (rows == nullptr || rows->broken || !matrix.allFinite() || size == 0) return matrix;
  constexpr double kFewDigits = 1e-6;  // of numbers that somebody wrote down
  const bool symmetric = (matrix - matrix.transpose()).cwiseAbs().maxCoeff() <= kFewDigits * size;
  const Eigen::LLT<Matrix6> raised(matrix + kFewDigits * size * Matrix6::Identity());
  if (!symmetric || raised.info() != Eigen::Success) {
    context.fault_at_key(*rows,
                         symmetric ? "a matrix that is not positive semidefinite" : "a matrix that is not symmetric",
                         "a symmetric matrix without negative eigenvalues");
  }
  return 0.5 * (matrix + matrix.transpose());
}

Bushing bushing_of(Context& context, const Value& value) {
  Bushing bushing;
  std::tie(bushing.from, bushing.to) = pair_of(context, value);
  bushing.stiffness = bushing_matrix(context, value, "stiffness");
  bushing.damping = bushing_matrix(context, value, "damping");
  return bushing;
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

JointFriction friction_of(Context& context, const Value& value) {
  const FoundCoordinate on = acted_on(context, value);
  require_unit(context, value, "coulomb", on, "N.m", "N");
  require_unit(context, value, "viscous", on, "N.m.s/rad", "N.s/m");
  require_unit(context, value, "transition_speed", on, "rad/s", "m/s");
  return {on.name, number_of(value, "coulomb"), number_of(value, "viscous"), number_of(value, "transition_speed")};
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

SpeedControl control_of(Context& context, const Value& value) {
  const FoundCoordinate on = acted_on(context, value);
  SpeedControl control;
  control.on = on.name;
  if (const Value* speed = value.find("speed"); speed != nullptr && on.valid) {
    control.speed = function_of(context, *speed, on.rotational ? "rad/s" : "m/s");
    require_function_of_time(context, control.speed, "a wanted speed");
  }
  require_unit(context, value, "proportional", on, "N.m.s/rad", "N.s/m");
  require_unit(context, value, "integral", on, "N.m/rad", "N/m");
  require_unit(context, value, "limit", on, "N.m", "N");
  control.proportional = number_of(value, "proportional");
  control.integral = number_of(value, "integral");
  control.limit = value.find("limit") != nullptr ? number_of(value, "limit") : std::numeric_limits<double>::infinity();
  return control;
}

/// A type of force: its name, what it is, its keys, and what they describe.
struct ForceKind {
  Variant format;
  std::function<decltype(Force::data)(Context&, const Value&)> read;
};

const std::vector<ForceKind>& force_kinds() {
  static const std::vector<ForceKind> kinds{
      {{"force", "a force at a point of a body", load_keys("N", "500 N")},
       [](Context& context, const Value& value) { return load_of(context, value, false); }},
      {{"torque", "a torque on a body", load_keys("N.m", "5 N.m")},
       [](Context& context, const Value& value) { return load_of(context, value, true); }},
      {{"pressure", "a pressure on faces of a flexible body's mesh, with which it rotates", pressure_keys()},
       surface_load_of},
      {{"surface_force", "a force spread evenly over faces of a flexible body's mesh", surface_force_keys()},
       surface_load_of},
      {{"spring_damper", "along the line between two points", spring_damper_keys()}, spring_damper_of},
      {{"torsion_spring", "on a rotational joint coordinate", torsion_keys()},
       [](Context& context, const Value& value) { return coordinate_spring_of(context, value, true); }},
      {{"sliding_spring", "on a translational joint coordinate", sliding_keys()},
       [](Context& context, const Value& value) { return coordinate_spring_of(context, value, false); }},
      {{"bushing", "elastic in all six directions; rotates less than 170 deg", bushing_keys()}, bushing_of},
      {{"bearing_table",
        "a bearing, seal or magnetic bearing by its stiffness and damping, over the speed of the shaft",
        bearing_table_keys()},
       bearing_table_of},
      {{"unbalance", "an unbalance of a shaft: mass off its axis", unbalance_keys()}, unbalance_of},
      {{"gear_mesh",
        "the teeth of two gear wheels, spur or helical, as stiffness and damping along their line of action",
        gear_mesh_keys()},
       gear_mesh_of},
      {{"piston_ring", "friction of a piston ring on its liner by tension, gas and a Stribeck curve",
        piston_ring_keys()},
       piston_ring_of},
      {{"joint_friction", "dry and viscous friction on a joint coordinate", friction_keys()}, friction_of},
      {{"speed_control", "a motor with a PI controller that rotates a joint coordinate at a wanted speed",
        control_keys()},
       control_of},
  };
  return kinds;
}

}  // namespace

TypePtr forces_format() {
  std::vector<Variant> formats;
  for (const ForceKind& kind : force_kinds()) formats.push_back(kind.format);
  return named(
      "a mapping from names to forces",
      with_together(with_exactly_one(variant("a force", "type", {}, std::move(formats)), {"components", "magnitude"}),
                    {"direction", "magnitude"}));
}

void interpret_forces(Context& context) {
  for (const auto& [name, value] : section(context.root, "forces"))
    for (const ForceKind& kind : force_kinds())
      if (kind.format.tag == value.text)
        context.model.forces.push_back({name, kind.read(context, value), value.key_position});
}

}  // namespace hersey::model
