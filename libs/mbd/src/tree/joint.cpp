#include "hersey/mbd/joint.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "hersey/core/contract.h"
#include "tree/joint_kind.h"

namespace hersey::mbd {
namespace {

std::vector<Coordinate> coordinates_of(const JointKind& kind) {
  std::vector<Coordinate> coordinates;
  auto step = kind.chain.begin();
  int offset = 0;
  for (const JointKind::Name& name : kind.coordinates) {
    Coordinate coordinate{.name = name.text,
                          .offset = offset,
                          .size = 0,
                          .rotational = is_rotational(step->motion),
                          .orientation = step->motion == Motion::ball};
    for (int k = 0; k < name.steps; ++k) coordinate.size += values_of((step++)->motion);
    offset += coordinate.size;
    coordinates.push_back(coordinate);
  }
  return coordinates;
}

Pose rotation(const Vector3& rotation_vector) {
  return {rotation_exp(rotation_vector).toRotationMatrix(), Vector3::Zero()};
}

}  // namespace

std::string_view name_of(JointType type) { return kind_of(type).name; }

std::optional<JointType> joint_type_of(std::string_view name) {
  for (const JointKind& kind : joint_kinds())
    if (kind.name == name) return kind.type;
  return std::nullopt;
}

std::span<const Coordinate> coordinates_of(JointType type) {
  static const std::vector<std::vector<Coordinate>> all = [] {
    std::vector<std::vector<Coordinate>> made;
    for (const JointKind& kind : joint_kinds()) made.push_back(coordinates_of(kind));
    return made;
  }();
  return all.at(static_cast<std::size_t>(type));
}

std::string rate_name(const Coordinate& coordinate) {
  if (coordinate.orientation) return "angular_velocity";
  return coordinate.size == 3 ? "velocity" : std::string(coordinate.name) + "_rate";
}

int degrees_of_freedom(JointType type) {
  int n = 0;
  for (const Coordinate& c : coordinates_of(type)) n += c.size;
  return n;
}

std::optional<Coordinate> find_coordinate(JointType type, std::string_view name) {
  for (const Coordinate& c : coordinates_of(type))
    if (c.name == name) return c;
  return std::nullopt;
}

namespace {

/// Returns the smallest rotation from z to n: the identity for z itself, 180 degrees about x for -z.
Matrix3 rotation_from_z(const Vector3& n) {
  const double across = n.head<2>().squaredNorm();
  if (across == 0) return Vector3(1, n.z(), n.z()).asDiagonal();
  const double k = n.z() > 0 ? 1 / (1 + n.z()) : (1 - n.z()) / across;  // the same, and exact near -z as well
  Matrix3 R;
  R << 1 - k * n.x() * n.x(), -k * n.x() * n.y(), n.x(),  //
      -k * n.x() * n.y(), 1 - k * n.y() * n.y(), n.y(),   //
      -n.x(), -n.y(), n.z();
  return R;
}

}  // namespace

Matrix3 joint_axes(const Vector3& axis) {
  HERSEY_REQUIRE(axis.norm() > 0, "a joint's axis has a direction");
  const Vector3 n = axis.normalized();
  Matrix3 axes;
  if (n == Vector3::UnitX()) {
    axes << Vector3::UnitY(), Vector3::UnitZ(), n;
  } else if (n == Vector3::UnitY()) {
    axes << Vector3::UnitZ(), Vector3::UnitX(), n;
  } else {
    axes = rotation_from_z(n);
  }
  return axes;
}

Pose joint_pose(JointType type, const Vector3& axis, std::span<const double> values, double lead) {
  HERSEY_REQUIRE(static_cast<int>(values.size()) == degrees_of_freedom(type), "one value per degree of freedom");
  const Matrix3 axes = joint_axes(axis);
  Pose X_IO;
  auto value = values.begin();
  for (const JointKind::Step& step : kind_of(type).chain) {
    const Vector3 along = direction(step.along, axes);
    if (step.motion == Motion::ball) {
      X_IO = X_IO * rotation({value[0], value[1], value[2]});
    } else {
      if (step.motion == Motion::prismatic) X_IO = X_IO * Pose{Matrix3::Identity(), *value * along};
      if (step.motion == Motion::screw)
        X_IO = X_IO * Pose{Matrix3::Identity(), lead / (2 * std::numbers::pi) * *value * along};
      if (is_rotational(step.motion)) X_IO = X_IO * rotation(*value * along);
    }
    value += values_of(step.motion);
  }
  return X_IO;
}

bool rotates_about_one_axis(JointType type) {
  int rotations = 0;
  for (const JointKind::Step& step : kind_of(type).chain)
    if (is_rotational(step.motion)) rotations += values_of(step.motion);
  return rotations == 1;
}

}  // namespace hersey::mbd
