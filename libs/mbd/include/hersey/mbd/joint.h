#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hersey/core/spatial.h"
#include "hersey/mbd/joint_type.h"

namespace hersey::mbd {

/// Returns the name of the type in model files, such as "revolute".
[[nodiscard]] std::string_view name_of(JointType type);
/// Returns the type of that name; nothing for an unknown name.
[[nodiscard]] std::optional<JointType> joint_type_of(std::string_view name);

/// One named coordinate of a joint type, as users write it. Its values are `size` entries of the joint's list of
/// values: 1 for a scalar, 3 for a position, and 3 for an orientation (given and reported as a rotation vector; its
/// rate is the angular velocity of O relative to I in O's axes).
struct Coordinate {
  std::string_view name;
  int offset = 0;
  int size = 1;
  bool rotational = false;  ///< radians, otherwise metres
  bool orientation = false;
};

/// The coordinates of a joint type in their order: revolute: rotation; prismatic: translation; cylindrical:
/// translation, rotation; planar: x, y, rotation; spherical: orientation; free: position, orientation; fixed: none;
/// universal: rotation_1 about t1 of the inboard frame (see joint_axes), rotation_2 about t2 of the outboard frame;
/// screw: rotation.
[[nodiscard]] std::span<const Coordinate> coordinates_of(JointType type);

/// Returns the name of a coordinate's rate: rotation_rate; velocity of a position, angular_velocity of an orientation.
[[nodiscard]] std::string rate_name(const Coordinate& coordinate);

/// True if the only relative rotation that the joint allows is that about its axis.
[[nodiscard]] bool rotates_about_one_axis(JointType type);

/// Returns the number of values (and of degrees of freedom) of a joint type, 0..6.
[[nodiscard]] int degrees_of_freedom(JointType type);

/// Returns the coordinate called `name`; nothing if the type has none of that name.
[[nodiscard]] std::optional<Coordinate> find_coordinate(JointType type, std::string_view name);

/// Returns the axes that a joint about (or along, or normal to) the unit vector `axis` uses: columns t1, t2, axis,
/// right-handed; the identity for z, cyclic permutations for x and y. A planar joint's x and y run along t1 and t2.
[[nodiscard]] Matrix3 joint_axes(const Vector3& axis);

/// Returns the joint's pose X_IO at the given values, shape (degrees_of_freedom).
/// @param lead  axial displacement of a screw per revolution [m], positive for a right-handed screw; ignored for other
/// types
[[nodiscard]] Pose joint_pose(JointType type, const Vector3& axis, std::span<const double> values, double lead = 0);

}  // namespace hersey::mbd
