#pragma once

namespace hersey::film {

/// A value and its derivative.
struct ValueAndSlope {
  double value = 0;
  double slope = 0;
};

}  // namespace hersey::film
