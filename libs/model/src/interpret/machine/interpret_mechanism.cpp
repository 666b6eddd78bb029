#include <Eigen/Eigenvalues>
#include <algorithm>
#include <map>

#include "hersey/core/spelling.h"
#include "hersey/mbd/joint.h"
#include "interpret/context/interpret.h"

namespace hersey::model {
namespace {

std::vector<Frame> frames_of(Context& context, const Value& body) {
  std::vector<Frame> frames;
  for (const auto& [name, value] : section(body, "frames")) {
    Frame frame;
    frame.name = name;
    frame.position = value.key_position;
    frame.X_BF.r = vector_of(value, "origin");
    if (const Value* rotation = value.find("rotation"); rotation != nullptr && !rotation->broken) {
      const Vector3 axis = direction_of(context, *rotation, "axis");
      frame.X_BF.R = Eigen::AngleAxisd(number_of(*rotation, "angle"), axis).toRotationMatrix();
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

/// The inertia matrix of a possible body: positive semidefinite, and no principal moment above the sum of the others.
Matrix3 inertia_of(Context& context, const Value& body) {
  const Value* value = body.find("inertia");
  if (value == nullptr || value->broken) return Matrix3::Zero();
  const double xx = number_of(*value, "xx"), yy = number_of(*value, "yy"), zz = number_of(*value, "zz");
  const double xy = number_of(*value, "xy"), yz = number_of(*value, "yz"), zx = number_of(*value, "zx");
  const Matrix3 inertia = (Matrix3() << xx, xy, zx, xy, yy, yz, zx, yz, zz).finished();
  if (!inertia.allFinite()) return Matrix3::Zero();
  const Vector3 principal = Eigen::SelfAdjointEigenSolver<Matrix3>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  // Thin plates lie exactly on the limit; data given to some digits may pass it by their rounding.
  const double slack = 1e-3 * principal[2];
  if (principal[0] < -slack || principal[2] > principal[0] + principal[1] + slack) {
    std::array<char, 96> moments{};
    std::snprintf(moments.data(), moments.size(), "%g, %g and %g kg.m^2", principal[0], principal[1], principal[2]);
    context.fault_at_key(*value, std::string("principal moments of inertia ") + moments.data(),
                         "none negative, and none greater than the sum of the others");
  }
  return inertia;
}

/// The coordinates that the mapping `key` of a joint gives values.
std::vector<InitialValue> initial_values(const Value& joint, const std::string& key) {
  std::vector<InitialValue> values;
  for (const auto& [coordinate, given] : section(joint, key)) {
    std::vector<double> numbers = given.numbers;
    if (numbers.empty()) numbers = {given.number};
    values.push_back({coordinate, std::move(numbers), given.key_position});
  }
  return values;
}

/// A coordinate is known, or it is guessed.
void require_guesses_of_others(Context& context, const Value& value, const Joint& joint) {
  for (const InitialValue& guess : joint.guess) {
    const bool is_given = std::any_of(joint.initial.begin(), joint.initial.end(), [&](const InitialValue& initial) {
      return initial.coordinate == guess.coordinate;
    });
    if (!is_given) continue;
    context.fault_at_key(*value.find("guess")->find(guess.coordinate),
                         "a guess of " + guess.coordinate + ", which `initial` gives",
                         "coordinates that `initial` leaves open", "keep one of the two");
  }
}

}  // namespace

std::pair<FrameName, FrameName> pair_of(Context& context, const Value& parent) {
  const Value* between = parent.find("between");
  if (between == nullptr || between->members.size() != 2) return {};
  FrameName first = frame_of(context, between->members[0].value);
  FrameName second = frame_of(context, between->members[1].value);
  if (!first.body.empty() && first.body == second.body) {
    context.fault(between->members[1].value, "both frames on body '" + first.body + "'", "frames of two bodies");
  }
  return {std::move(first), std::move(second)};
}

void require_function_of_time(Context& context, const Function& function, const std::string& what) {
  for (const Variable& variable : function.variables) {
    if (variable.kind == Variable::Kind::time) continue;
    const std::string name = variable.joint + "." + variable.coordinate;
    context.faults.push_back(
        {function.position, function.path, what + " that depends on " + name, "a function of time alone", ""});
    return;
  }
}

void interpret_bodies(Context& context) {
  context.model.ground.name = "ground";
  for (const auto& [name, value] : section(context.root, "bodies")) {
    if (name == "ground") {
      context.model.ground.frames = frames_of(context, value);
      (void)flexible_of(context, value, context.model.ground.frames);
      (void)beam_of(context, value, context.model.ground.frames);
      context.model.ground.shapes = shapes_of(context, value);
      (void)faces_of_body(context, value, nullptr);
      context.model.ground.position = value.key_position;
      continue;
    }
    Body body;
    body.name = name;
    body.position = value.key_position;
    body.mass = number_of(value, "mass");
    body.centre_of_mass = vector_of(value, "centre_of_mass");
    body.inertia = inertia_of(context, value);
    body.frames = frames_of(context, value);
    body.shapes = shapes_of(context, value);
    body.flexible = flexible_of(context, value, body.frames);
    body.beam = beam_of(context, value, body.frames);
    body.faces = faces_of_body(context, value, body.flexible ? &*body.flexible : nullptr);
    if (body.flexible && body.flexible->mesh && !body.flexible->mesh->elements.empty() && body.shapes.empty()) {
      body.faces.push_back(skin_of(*body.flexible->mesh));
      body.shapes.push_back(body.faces.back().shape);
    }
    context.model.bodies.push_back(std::move(body));
  }
}

void interpret_joints(Context& context) {
  for (const auto& [name, value] : section(context.root, "joints")) {
    Joint joint;
    joint.name = name;
    joint.position = value.key_position;
    std::tie(joint.inboard, joint.outboard) = pair_of(context, value);
    joint.type = mbd::joint_type_of(value.text).value_or(joint.type);
    if (value.find("axis") != nullptr) joint.axis = direction_of(context, value, "axis");
    if (joint.type == JointType::screw) {
      joint.lead = number_of(value, "lead");
      if (const Value* lead = value.find("lead"); lead != nullptr && !lead->broken && joint.lead == 0) {
        context.fault(*lead, "a lead of 0", "a travel per revolution", "a revolute joint has none");
      }
    }
    joint.initial = initial_values(value, "initial");
    joint.guess = initial_values(value, "guess");
    require_guesses_of_others(context, value, joint);
    context.model.joints.push_back(std::move(joint));
  }
}

void interpret_drives(Context& context) {
  std::map<std::string, std::string> driven;  // joint.coordinate -> drive
  for (const auto& [name, value] : section(context.root, "drives")) {
    Drive drive;
    drive.name = name;
    drive.position = value.key_position;
    drive.joint = text_of(value, "joint");
    drive.coordinate = text_of(value, "coordinate");
    const auto coordinate = coordinate_of(context, value);
    const Value* motion = value.find("position");
    std::string per;
    if (motion == nullptr && (motion = value.find("speed")) != nullptr) {
      drive.prescribes = Drive::Prescribes::speed;
      per = "/s";
    } else if (motion == nullptr) {
      motion = value.find("acceleration");
      drive.prescribes = Drive::Prescribes::acceleration;
      per = "/s^2";
    }
    drive.ramp = number_of(value, "ramp");
    if (coordinate && motion != nullptr) {
      drive.motion = function_of(context, *motion, (coordinate->rotational ? "rad" : "m") + per);
      require_function_of_time(context, drive.motion, "a drive");
      const auto [first, is_new] = driven.try_emplace(drive.joint + "." + drive.coordinate, name);
      if (!is_new) {
        context.fault_at_key(value, "a second drive of " + first->first, "one drive per coordinate",
                             "the other is '" + first->second + "'");
      }
    }
    context.model.drives.push_back(std::move(drive));
  }
}

}  // namespace hersey::model
