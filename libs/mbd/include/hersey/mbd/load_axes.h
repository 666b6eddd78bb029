#pragma once

namespace hersey::mbd {

/// Axes in which the direction of a load is constant: those of ground, or those of the body on which it acts.
enum class LoadAxes { ground, body };

}  // namespace hersey::mbd
