#pragma once

#include "hersey/film/film_model.h"

namespace hersey::bearing {

/// The radial clearance of a bearing whose walls have grown apart by `growth` [m]. A film knows its c as a scale only:
/// nothing else reads it as the measure of a bearing.
[[nodiscard]] inline double clearance(const film::FilmModel& film, double growth = 0) { return film.c + growth; }

}  // namespace hersey::bearing
