#pragma once

#include <string>

#include "hersey/bearing/film_force.h"

namespace hersey::bearing {

/// An oil film between the bore of a shell frame A and the journal of a frame B.
class JournalBearing final : public FilmForce {
 public:
  /// As FilmForce.
  JournalBearing(std::string name, const film::FilmModel& model, const BearingOptions& options = {});
};

}  // namespace hersey::bearing
