#pragma once

namespace hersey::mbd {

// Share of the force that would stop a body within the step, counted as a magnitude its rows balance: a relative
// tolerance of 1e-8 then asks for velocities to 1e-12, which double precision can still deliver.
inline constexpr double kMomentumShare = 1e-4;

}  // namespace hersey::mbd
