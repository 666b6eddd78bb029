#pragma once

#include <string>

#include "hersey/model/model.h"
#include "hersey/results/reader.h"

namespace hersey::run {

/// Reads the model of a finished run again, from the text and the overrides that its results hold: what later
/// computations need of meshes and frames. Meshes and tables are sought where the model file lay.
/// @param model_file  where it lies now; empty: where the results say that it lay
/// @throws InputError with the faults of the model, such as a mesh that is not there
/// @throws results::ReadError where the results do not say where it lay
/// @verified_by loads_test.py
[[nodiscard]] model::Model model_of_results(const results::Reader& results, const std::string& model_file = {});

/// Requires a body's mesh to be the one that the results were made with.
/// @throws InputError at the mesh in the model file
void require_same_mesh(const results::Reader& results, const model::Model& model, const model::Body& body);

}  // namespace hersey::run
