#include "hersey/core/version.h"

namespace hersey {

const char* version() { return HERSEY_VERSION; }

}  // namespace hersey
