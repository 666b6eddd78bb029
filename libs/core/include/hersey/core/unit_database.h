#pragma once

#include <filesystem>

namespace hersey {

/// Sets the database of units. This copy of the library reads the database once, with its first quantity; later changes
/// of the file have no effect. The call has no effect after that, or if there is no such file. Without this call the
/// database is that of the environment variable UDUNITS2_XML_PATH; if the variable is not set or names no database, it
/// is the one installed with udunits2. The environment is never changed.
/// @verified_by unit_database_test.cpp
void use_unit_database(const std::filesystem::path& database);

/// Returns the database in use, or, before the first quantity, the one that would be read.
[[nodiscard]] std::filesystem::path unit_database();

}  // namespace hersey
