#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "hersey/fem/elastic_material.h"
#include "hersey/fem/load_file.h"

namespace hersey::fem {

/// By what SI values are multiplied for a file.
struct FileScale {
  double length = 1, pressure = 1, density = 1;
};

[[nodiscard]] inline FileScale scale_of(FileUnits units) {
  if (units == FileUnits::si) return {};
  return {.length = 1e3, .pressure = 1e-6, .density = 1e-12};  // t/mm^3
}

/// Young's modulus, Poisson's ratio and density of a material that is the same in all directions; none of others.
[[nodiscard]] inline std::optional<ElasticMaterial> as_isotropic(const SolidMaterial& material) {
  const double lambda = material.D(0, 1), mu = material.D(3, 3);
  if (!(mu > 0) || !(lambda + mu > 0)) return std::nullopt;
  const ElasticMaterial constants{.youngs_modulus = mu * (3 * lambda + 2 * mu) / (lambda + mu),
                                  .poisson_ratio = lambda / (2 * (lambda + mu)),
                                  .density = material.density};
  const double round_off_of_D = 1e-10 * material.D.cwiseAbs().maxCoeff();
  if (!(isotropic(constants).D - material.D).isZero(round_off_of_D)) return std::nullopt;
  return constants;
}

/// Elements by the index of their material.
[[nodiscard]] inline std::vector<std::vector<int>> elements_by_material(const LoadedBody& body) {
  std::vector<std::vector<int>> elements(body.materials.size());
  for (std::size_t e = 0; e < body.mesh.elements.size(); ++e)
    elements[static_cast<std::size_t>(std::max(body.mesh.elements[e].material, 0))].push_back(static_cast<int>(e));
  return elements;
}

}  // namespace hersey::fem
