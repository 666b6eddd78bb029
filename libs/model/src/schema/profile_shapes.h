#pragma once

#include "check/vocabulary.h"
#include "hersey/film/gap_profile.h"

namespace hersey::model {

/// Deviations from a cylinder that a formula describes; a measured one comes from a table beside them.
[[nodiscard]] const std::vector<Alternative<film::ProfileShape>>& profile_shapes();

}  // namespace hersey::model
