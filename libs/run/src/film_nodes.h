#pragma once

#include "hersey/model/model.h"
#include "hersey/results/writer.h"

namespace hersey::run {

/// Writes where the nodes of a bearing's film lie, the dimensions of all its fields. Before the fields.
void write_film_nodes(const model::Bearing& bearing, results::Writer& writer);

}  // namespace hersey::run
