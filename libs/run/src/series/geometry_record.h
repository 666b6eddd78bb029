#pragma once

#include <string>
#include <vector>

#include "hersey/mbd/mechanism_builder.h"
#include "hersey/model/model.h"
#include "table/quantity.h"

namespace hersey::run {

/// Writes the data, besides the motion, that a picture of the machine needs: shapes of bodies and of ground, positions
/// of joints and bearings in their bodies, and the bodies that each of them connects (layout: docs/results-file.md).
/// @param hidden_joints  joints of the mechanism that the file does not show
void write_geometry(const model::Model& model, const mbd::MechanismSpec& spec, const std::vector<bool>& hidden_joints,
                    results::Writer& writer);

/// Gravity, and the shapes of ground.
void write_ground(const model::Body& ground, const Vector3& gravity, results::Writer& writer);
/// Mass, centre and shapes of a body.
void write_body(const model::Body& body, double mass, const Vector3& centre_of_mass, results::Writer& writer);
/// Type and position of a joint.
void write_joint_position(const mbd::MechanismSpec& spec, const mbd::JointSpec& joint, results::Writer& writer);

/// A frame of a body, by the body's name.
struct FrameOnBody {
  std::string body;
  Pose X_BF;
};
/// The bodies that a force, a bearing or a contact connects, and where.
/// @param group  of it, ends with "/"
void write_link(const std::string& group, const FrameOnBody& inboard, const FrameOnBody& outboard,
                results::Writer& writer);

/// Adds the position of a force between two bodies, a bearing or a contact.
void describe_link(QuantityGroup& group);
/// Adds the position of a joint, with its type.
void describe_joint_position(QuantityGroup& group);
/// Adds mass and centre of a body.
void describe_mass(QuantityGroup& group);
[[nodiscard]] QuantityGroup describe_ground();
/// Parts of shapes. @param path  of a shape's group
[[nodiscard]] QuantityGroup describe_shapes(const char* path);

}  // namespace hersey::run
