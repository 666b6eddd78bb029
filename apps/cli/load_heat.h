#pragma once

#include <optional>

#include "commands.h"
#include "hersey/fem/load_file.h"
#include "hersey/run/body_loads.h"

namespace hersey::cli {

/// Temperatures of a body in files of loads.
struct LoadHeat {
  fem::BodyTemperatures temperatures;
  std::vector<run::FilmTemperatures::Surface> films;
  double film_heat = 0;             ///< from the films' surfaces into the body [W]
  double coldest = 0, warmest = 0;  ///< of its nodes [degC]
};

/// Returns the steady temperatures of the body by those of its films' surfaces, mean over the last cycle (over the
/// chosen instants of a run without cycles), and by what the options and the model's `heat` say; none for a body of
/// which no conductivity is known, and for one that conducts by the model under films without temperatures.
/// @param materials  number of the body's materials
/// @throws InputError: options of heat without --conductivity or films with temperatures, unknown surfaces
[[nodiscard]] std::optional<LoadHeat> heat_of_loads(const LoadsArguments& asked, const model::Model& model,
                                                    const run::BodyLoads& loads, const std::vector<std::size_t>& chosen,
                                                    std::size_t materials);

}  // namespace hersey::cli
