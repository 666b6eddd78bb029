#pragma once

#include <string>
#include <vector>

#include "hersey/film/film_work.h"

namespace hersey::run {

/// Statistics of a count per step over a run.
struct PerStep {
  double median = 0, mean = 0;
  int most = 0;
};

/// A part of a run's computing time.
struct WorkPart {
  std::string name;    ///< "film big_end", "elastic bodies", ...
  double seconds = 0;  ///< that the steps waited for it
};

/// Cost of the coupling of film and bodies of one bearing.
struct CouplingWork {
  std::string bearing, scheme;
  PerStep film_iterations;  ///< linearisations of the film
  PerStep exchanges;        ///< exchanges of wrenches between film and bodies; monolithic: none
  int steps_as_one = 0;  ///< partitioned: steps that were solved monolithically because the exchange did not converge
};

/// Where the time of one bearing's film goes, its start included.
struct FilmCost {
  std::string bearing;
  int nodes = 0;
  double seconds = 0;   ///< in the film's own thread, surfaces and temperatures included
  film::FilmWork work;  ///< what of it the film's equations took
};

/// Cost of a run's steps. Films are solved in parallel: the time until all of them are solved is divided among them in
/// proportion to the time each of them took in its own thread.
struct Work {
  double start_up = 0;          ///< reading, meshes, reduction, the starting state [s]
  double stepping = 0;          ///< all steps, rejected ones and recording included [s]
  std::vector<WorkPart> parts;  ///< their sum is `stepping`
  PerStep newton_iterations;    ///< of accepted steps
  std::vector<CouplingWork> couplings;
  std::vector<FilmCost> films;  ///< one of each bearing
};

}  // namespace hersey::run
