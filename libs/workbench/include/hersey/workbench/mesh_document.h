#pragma once

#include <string>
#include <vector>

#include "hersey/fem/mesh.h"
#include "hersey/fem/mesh_quality.h"
#include "hersey/fem/surface_detection.h"

/// What `hersey mesh` tells of a mesh.
namespace hersey::workbench {

/// Sizes, elements, sets and materials of a mesh in SI, as a JSON object: that of `hersey mesh --json`.
[[nodiscard]] std::string mesh_json(const fem::Mesh& mesh, const fem::MeshQuality& quality);

/// The surfaces in SI, as a JSON list.
[[nodiscard]] std::string found_json(const std::vector<fem::FoundSurface>& found);

/// Returns the lines of a model file that make frames and bearings of the bores and journals; empty if there are none.
/// @param file, length_unit  of the mesh that has the surfaces by their names
[[nodiscard]] std::string model_lines(const std::vector<fem::FoundSurface>& found, const std::string& file,
                                      const std::string& length_unit);

/// For each surface that the mesh names, a JSON list of `{name, key, frame, bearing}`: a name for keys of a model file,
/// the value of a frame there, and that of the bearing that it could be (else empty). @param body  that has the mesh
[[nodiscard]] std::string uses_json(const fem::Mesh& mesh, const std::vector<fem::FoundSurface>& found,
                                    const std::string& body);

/// The triangles of the outside for pictures: `{surfaces: [{name, corners, triangles}], rest: {corners, triangles}}`,
/// those of the found and then of the file's other surfaces, and of what belongs to none.
[[nodiscard]] std::string picture_json(const fem::Mesh& mesh, const std::vector<fem::FoundSurface>& found);

}  // namespace hersey::workbench
