#pragma once

#include <filesystem>
#include <string>

#include "rotor_page.h"

namespace hersey::cli {

/// Writes what `hersey rotor` has found as an HDF5 file, a row for each speed that was solved; SI units, speeds in
/// rad/s. docs/rotors.md has its layout.
/// @param model  path of the model file @throws results::WriteError @verified_by tests/cli/rotor_test.py
void write_rotor_results(const RotorFindings& found, const std::string& model, const std::filesystem::path& path);

}  // namespace hersey::cli
