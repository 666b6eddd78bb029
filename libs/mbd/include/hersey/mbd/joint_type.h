#pragma once

namespace hersey::mbd {

/// What a joint leaves free between its inboard frame I and its outboard frame O. X_IO is the identity at zero.
enum class JointType { fixed, revolute, prismatic, cylindrical, spherical, planar, free, universal, screw };

}  // namespace hersey::mbd
