#pragma once

#include "interpret/context/interpret.h"

namespace hersey::model {

/// Reads `restrictor` of a hole or pocket, whose `pressure` has been read, and whether that makes it fed; reports one
/// without a supply.
void read_restrictor(Context& context, const Value& value, const Function& pressure, film::SurfaceFeature& feature);

/// Puts the oil in the restrictors of a bearing, all else of which has been read, as warm as it is supplied; reports a
/// solver that finds no pressures behind them.
void complete_restrictors(Context& context, const Value& value, Bearing& bearing);

}  // namespace hersey::model
