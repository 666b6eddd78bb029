#include <Eigen/Eigenvalues>
#include <limits>

#include "interpret/interpret.h"
#include "schema/machine_vocabulary.h"

namespace hersey::model {
namespace {

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

/// The six rows under `key`, x, y, z first, turned to rotations first.
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
  const bool symmetric = (matrix - matrix.transpose()).cwiseAbs().maxCoeff() <= 1e-6 * size;
  const double smallest = Eigen::SelfAdjointEigenSolver<Matrix6>(matrix, Eigen::EigenvaluesOnly).eigenvalues()[0];
  if (!symmetric || smallest < -1e-6 * size) {
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

JointFriction friction_of(Context& context, const Value& value) {
  const FoundCoordinate on = acted_on(context, value);
  require_unit(context, value, "coulomb", on, "N.m", "N");
  require_unit(context, value, "viscous", on, "N.m.s/rad", "N.s/m");
  require_unit(context, value, "transition_speed", on, "rad/s", "m/s");
  return {on.name, number_of(value, "coulomb"), number_of(value, "viscous"), number_of(value, "transition_speed")};
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

Force force_of(Context& context, const std::string& name, const Value& value) {
  Force force;
  force.name = name;
  force.position = value.key_position;
  if (value.text == "force" || value.text == "torque") {
    force.load = load_of(context, value, value.text == "torque");
  } else if (value.text == "pressure" || value.text == "surface_force") {
    force.type = ForceType::surface_load;
    force.surface_load = surface_load_of(context, value);
  } else if (value.text == "spring_damper") {
    force.type = ForceType::spring_damper;
    force.spring_damper = spring_damper_of(context, value);
  } else if (value.text == "torsion_spring" || value.text == "sliding_spring") {
    force.type = ForceType::coordinate_spring;
    force.coordinate_spring = coordinate_spring_of(context, value, value.text == "torsion_spring");
  } else if (value.text == "bushing") {
    force.type = ForceType::bushing;
    force.bushing = bushing_of(context, value);
  } else if (value.text == "joint_friction") {
    force.type = ForceType::joint_friction;
    force.joint_friction = friction_of(context, value);
  } else if (value.text == "speed_control") {
    force.type = ForceType::speed_control;
    force.speed_control = control_of(context, value);
  }
  return force;
}

}  // namespace

void interpret_forces(Context& context) {
  for (const auto& [name, value] : section(context.root, "forces")) {
    context.model.forces.push_back(force_of(context, name, value));
  }
}

}  // namespace hersey::model
