#pragma once

namespace hersey::mbd {

/// Axes that the direction of a load is fixed in: ground's, or those of the body it acts on.
enum class LoadAxes { ground, body };

}  // namespace hersey::mbd
