#pragma once

#include <string>
#include <vector>

namespace hersey::run {

/// How many of something the steps of a run took.
struct PerStep {
  double median = 0, mean = 0;
  int most = 0;
};

/// A part of a run's computing time.
struct WorkPart {
  std::string name;    ///< "film big_end", "elastic bodies", ...
  double seconds = 0;  ///< that the steps waited for it
};

/// How film and bodies of one bearing were brought together.
struct CouplingWork {
  std::string bearing, scheme;
  PerStep film_iterations;  ///< linearisations of the film
  PerStep exchanges;        ///< of wrenches between film and bodies; monolithic: none
  int steps_as_one = 0;     ///< partitioned: steps solved monolithically, as their exchange came to no end
};

/// What a run's steps cost. Films are solved side by side: the time until all of them are known is divided among them
/// in proportion to the time each of them took in its own thread.
struct Work {
  double start_up = 0;          ///< reading, meshes, reduction, the starting state [s]
  double stepping = 0;          ///< all steps, rejected ones and recording included [s]
  std::vector<WorkPart> parts;  ///< their sum is `stepping`
  PerStep newton_iterations;    ///< of accepted steps
  std::vector<CouplingWork> couplings;
};

}  // namespace hersey::run
