#pragma once

#include "hersey/mbd/mechanism_builder.h"
#include "hersey/model/model.h"
#include "hersey/results/writer.h"

namespace hersey::run {

/// Writes what a picture of the machine needs beside its motion: shapes of bodies and of ground, where joints and
/// bearings sit in their bodies, and what connects which bodies (layout: docs/results-file.md).
void write_geometry(const model::Model& model, const mbd::MechanismSpec& spec, results::Writer& writer);

}  // namespace hersey::run
