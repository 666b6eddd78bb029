#pragma once

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "hersey/fem/elastic_material.h"
#include "hersey/fem/load_file.h"

namespace hersey::fem {

/// By what SI values are multiplied for a file.
struct FileScale {
  double length = 1, pressure = 1, density = 1;
  double conductivity = 1;  ///< W/(m K) = N/(s K), the same with millimetres
  double transfer = 1;      ///< coefficients of heat transfer, W/(m^2 K) = 0.001 N/(mm s K)
};

[[nodiscard]] inline FileScale scale_of(FileUnits units) {
  if (units == FileUnits::si) return {};
  return {
      .length = 1e3, .pressure = 1e-6, .density = 1e-12, .conductivity = 1, .transfer = 1e-3};  // t/mm^3, N/(mm s K)
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

/// Whether temperatures strain a body.
[[nodiscard]] inline bool is_strained_by_heat(const LoadedBody& body) {
  return body.heat && body.heat->material.expansion > 0;
}

/// Temperatures in files are in degC.
[[nodiscard]] inline double in_celsius(double T) { return T - 273.15; }

/// A cooled face, once, with all that cools it.
struct CooledFace {
  ElementFace face;
  double transfer = 0;   ///< sum of the coefficients [W/(m^2 K)]
  double T_ambient = 0;  ///< mean of the surroundings' temperatures by these [K]
};

/// Cooled faces by element and face. Programs take one coefficient for a face.
[[nodiscard]] inline std::vector<CooledFace> cooled_faces_once(const std::vector<CooledFaces>& cooled) {
  std::map<std::pair<int, int>, CooledFace> faces;
  for (const CooledFaces& surface : cooled)
    for (const ElementFace& face : surface.faces) {
      if (!(surface.transfer > 0)) continue;
      CooledFace& sum = faces[{face.element, face.face}];
      const double transfer = sum.transfer + surface.transfer;
      sum.face = face;
      sum.T_ambient = (sum.transfer * sum.T_ambient + surface.transfer * surface.T_ambient) / transfer;
      sum.transfer = transfer;
    }
  std::vector<CooledFace> once;
  once.reserve(faces.size());
  for (const auto& [key, face] : faces) once.push_back(face);
  return once;
}

/// Elements by the index of their material.
[[nodiscard]] inline std::vector<std::vector<int>> elements_by_material(const LoadedBody& body) {
  std::vector<std::vector<int>> elements(body.materials.size());
  for (std::size_t e = 0; e < body.mesh.elements.size(); ++e)
    elements[static_cast<std::size_t>(std::max(body.mesh.elements[e].material, 0))].push_back(static_cast<int>(e));
  return elements;
}

}  // namespace hersey::fem
