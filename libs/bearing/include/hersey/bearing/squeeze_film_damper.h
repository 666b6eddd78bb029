#pragma once

#include <memory>

#include "hersey/bearing/bearing_kind.h"

namespace hersey::bearing {

/// A squeeze-film damper: a journal that does not rotate but orbits in its bore (theory manual, chapter damper). Gap
/// and coordinates are those of a journal; by itself it is solved on an orbit or for small motions about a position,
/// which need no load.
[[nodiscard]] std::shared_ptr<const BearingKind> squeeze_film_damper_kind();

/// True of that kind.
[[nodiscard]] bool is_damper(const BearingKind& kind);

}  // namespace hersey::bearing
