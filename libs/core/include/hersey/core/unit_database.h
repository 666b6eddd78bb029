#pragma once

#include <filesystem>

namespace hersey {

/// The database of units that this copy of the library reads with its first quantity, and never again: what happens to
/// the file afterwards changes nothing. Without effect once it has been read, or where there is no such file.
///
/// Where none is given it is the one of the variable UDUNITS2_XML_PATH, and where that names no database, or is not
/// set, the one that udunits2 was installed with. Nothing is ever put into the environment.
/// @verified_by unit_database_test.cpp
void use_unit_database(const std::filesystem::path& database);

/// The file that is read: the one in use, or where none is yet the one that would be.
[[nodiscard]] std::filesystem::path unit_database();

}  // namespace hersey
