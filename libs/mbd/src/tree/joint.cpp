#include "hersey/mbd/joint.h"

#include <array>
#include <cmath>
#include <numbers>

#include "hersey/core/contract.h"

namespace hersey::mbd {
namespace {

constexpr Coordinate kRotation{.name = "rotation", .rotational = true};
constexpr Coordinate kTranslation{.name = "translation"};
constexpr std::array<Coordinate, 1> kRevolute{kRotation};
constexpr std::array<Coordinate, 1> kPrismatic{kTranslation};
constexpr std::array<Coordinate, 2> kCylindrical{kTranslation, {.name = "rotation", .offset = 1, .rotational = true}};
constexpr std::array<Coordinate, 1> kSpherical{
    {{.name = "orientation", .size = 3, .rotational = true, .orientation = true}}};
constexpr std::array<Coordinate, 3> kPlanar{
    {{.name = "x"}, {.name = "y", .offset = 1}, {.name = "rotation", .offset = 2, .rotational = true}}};
constexpr std::array<Coordinate, 2> kFree{
    {{.name = "position", .size = 3},
     {.name = "orientation", .offset = 3, .size = 3, .rotational = true, .orientation = true}}};

constexpr std::array<Coordinate, 2> kUniversal{
    {{.name = "rotation_1", .rotational = true}, {.name = "rotation_2", .offset = 1, .rotational = true}}};

constexpr std::array<std::string_view, 9> kNames{"fixed",  "revolute", "prismatic", "cylindrical", "spherical",
                                                 "planar", "free",     "universal", "screw"};

Pose rotation(const Vector3& rotation_vector) {
  return {rotation_exp(rotation_vector).toRotationMatrix(), Vector3::Zero()};
}

}  // namespace

std::string_view name_of(JointType type) { return kNames[static_cast<std::size_t>(type)]; }

std::optional<JointType> joint_type_of(std::string_view name) {
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (kNames[i] == name) return static_cast<JointType>(i);
  return std::nullopt;
}

std::span<const Coordinate> coordinates_of(JointType type) {
  switch (type) {
    case JointType::fixed:
      return {};
    case JointType::revolute:
    case JointType::screw:
      return kRevolute;
    case JointType::prismatic:
      return kPrismatic;
    case JointType::cylindrical:
      return kCylindrical;
    case JointType::spherical:
      return kSpherical;
    case JointType::planar:
      return kPlanar;
    case JointType::free:
      return kFree;
    case JointType::universal:
      return kUniversal;
  }
  HERSEY_REQUIRE(false, "every joint type is listed");
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

Matrix3 joint_axes(const Vector3& axis) {
  HERSEY_REQUIRE(axis.norm() > 0, "a joint's axis has a direction");
  const Vector3 n = axis.normalized();
  Matrix3 axes;
  if (n == Vector3::UnitX()) {
    axes << Vector3::UnitY(), Vector3::UnitZ(), n;
  } else if (n == Vector3::UnitY()) {
    axes << Vector3::UnitZ(), Vector3::UnitX(), n;
  } else {
    // The smallest rotation that takes z to the axis: the identity for z itself.
    axes = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), n).toRotationMatrix();
    axes.col(2) = n;
  }
  return axes;
}

Pose joint_pose(JointType type, const Vector3& axis, std::span<const double> values, double lead) {
  HERSEY_REQUIRE(static_cast<int>(values.size()) == degrees_of_freedom(type), "one value per degree of freedom");
  const Matrix3 axes = joint_axes(axis);
  const Vector3 n = axes.col(2);
  switch (type) {
    case JointType::fixed:
      return {};
    case JointType::revolute:
      return rotation(values[0] * n);
    case JointType::prismatic:
      return {Matrix3::Identity(), values[0] * n};
    case JointType::cylindrical:
      return Pose{Matrix3::Identity(), values[0] * n} * rotation(values[1] * n);
    case JointType::spherical:
      return rotation({values[0], values[1], values[2]});
    case JointType::planar:
      return Pose{Matrix3::Identity(), values[0] * axes.col(0) + values[1] * axes.col(1)} * rotation(values[2] * n);
    case JointType::free:
      return Pose{Matrix3::Identity(), Vector3(values[0], values[1], values[2])} *
             rotation({values[3], values[4], values[5]});
    case JointType::universal:
      return rotation(values[0] * axes.col(0)) * rotation(values[1] * axes.col(1));
    case JointType::screw:
      return Pose{Matrix3::Identity(), lead / (2 * std::numbers::pi) * values[0] * n} * rotation(values[0] * n);
  }
  HERSEY_REQUIRE(false, "every joint type is listed");
}

}  // namespace hersey::mbd
