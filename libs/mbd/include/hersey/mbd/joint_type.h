#pragma once

namespace hersey::mbd {

/// Relative motion that a joint allows between its inboard frame I and its outboard frame O. X_IO is the identity at
/// zero.
enum class JointType { fixed, revolute, prismatic, cylindrical, spherical, planar, free, universal, screw };

}  // namespace hersey::mbd
