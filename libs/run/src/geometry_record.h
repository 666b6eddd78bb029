#pragma once

#include <vector>

#include "hersey/mbd/mechanism_builder.h"
#include "hersey/model/model.h"
#include "hersey/results/writer.h"

namespace hersey::run {

/// Writes what a picture of the machine needs beside its motion: shapes of bodies and of ground, where joints and
/// bearings sit in their bodies, and what connects which bodies (layout: docs/results-file.md).
/// @param hidden_joints  those of the mechanism that the file does not show
void write_geometry(const model::Model& model, const mbd::MechanismSpec& spec, const std::vector<bool>& hidden_joints,
                    results::Writer& writer);

}  // namespace hersey::run
