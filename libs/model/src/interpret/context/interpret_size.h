#pragma once

#include "interpret/context/interpret.h"

namespace hersey::model {

/// Reports what would take more memory than the machine has: grids of films, instants that steps have to hit because
/// tables bend or rows are wanted there. After everything else has been read.
void check_size(Context& context);

}  // namespace hersey::model
