#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "hersey/fem/elastic_body.h"
#include "hersey/fem/heat_conduction.h"
#include "hersey/fem/thermal_material.h"

namespace hersey::cli {

/// A body that is no longer at the temperature at which it has its shape.
struct SolidHeat {
  std::vector<fem::ThermalMaterial> materials;
  Eigen::VectorXd T;     ///< of the nodes (n) [K]
  Eigen::VectorXd rise;  ///< over the reference temperature (n) [K]
  /// Heat that leaves through what --cooling and --temperature name, in the order given [W].
  struct Leaving {
    std::string name;
    double power = 0;
  };
  std::vector<Leaving> leaving;
};

/// Returns what --temperature SET=80degC and --cooling name. @throws InputError: unknown surfaces, values that are none
[[nodiscard]] fem::ThermalSurroundings surroundings_of(const SolidArguments& arguments, const fem::Mesh& mesh);

/// Returns the temperatures that --temperature, --cooling and --heat cause by steady conduction; none if no option
/// concerns heat.
/// @throws InputError: constants that are missing, unknown surfaces, heat without a path to the surroundings
[[nodiscard]] std::optional<SolidHeat> heat_of(const SolidArguments& arguments, const fem::ElasticBody& body);

}  // namespace hersey::cli
