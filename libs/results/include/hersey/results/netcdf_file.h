#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "hersey/results/reader.h"

namespace hersey::results {

/// What a copy of results in netCDF holds.
struct NetcdfSummary {
  std::size_t variables = 0;
  /// Paths of data whose columns have different units, which the results do not tell: no variable of the CF conventions
  /// may have several.
  std::vector<std::string> left_out;
};

/// The version of the CF conventions (cfconventions.org) that a copy follows, as its attribute `Conventions` names it.
inline constexpr const char* cf_conventions = "CF-1.11";

/// Writes a copy of results as netCDF 4 by the CF conventions, for programs that cannot read the results file itself.
///
/// Groups, names and numbers are those of the results. What differs, and why: text has a fixed length, as GNU Octave
/// and Fortran programs read no other; the components of a dimension stand in a variable of their own, since a
/// coordinate variable has numbers; columns of different units are a variable each; a dimension whose values do not
/// rise or fall strictly, such as the frequencies of modes, is a number from 0 with these values beside it; units are
/// as CF writes them; what is not a number is
/// `_FillValue`. Data without rows are left out. Time is in s from the start of the run, which is no date: CF's "since"
/// would invent one. The file appears under its name when it is whole; until then it is `<path>.new`.
/// @param history  what made the copy, for the attribute `history`
/// @throws ReadError, WriteError. @verified_by netcdf_test.py
NetcdfSummary write_netcdf(const Reader& results, const std::filesystem::path& path, const std::string& history);

}  // namespace hersey::results
