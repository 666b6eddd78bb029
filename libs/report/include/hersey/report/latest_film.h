#pragma once

#include <string>

#include "hersey/results/reader.h"

namespace hersey::report {

/// Pressure and thickness of a bearing's film at the last instant that they are stored at, with its nodes, as JSON with
/// datasets by path as the page reads them (web/src/data.ts): `{bearing, t, datasets}`. `t` is null, and there are no
/// datasets, before the first instant and where the file has no fields of it.
/// @verified_by latest_film_test.cpp
[[nodiscard]] std::string latest_film_json(const results::Reader& reader, const std::string& bearing);

}  // namespace hersey::report
