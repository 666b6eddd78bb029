#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// Quality of the elements of one type.
struct ElementQuality {
  int count = 0;
  double smallest_shape = 1;   ///< smallest shape of all corners: 1 ideal, 0 flat; see `corner_shape`
  double mean_shape = 0;       ///< mean over the elements, each with its worst corner
  long label_of_smallest = 0;  ///< label of the element with the worst corner
  double largest_aspect = 1;   ///< largest ratio of longest to shortest edge of an element, between corners
};

/// Quality of a mesh, known before anything is computed with it.
struct MeshQuality {
  Vector3 lower = Vector3::Zero(), upper = Vector3::Zero();  ///< bounding box [m]
  double volume = 0;                                         ///< volume of the solids [m^3]
  std::optional<double> mass;  ///< mass [kg]; none unless every solid has a density in the mesh file
  std::map<ElementType, ElementQuality> types;
  std::vector<long> folded;                       ///< labels of solids with a Jacobian that is not positive
  std::vector<std::pair<long, long>> repeated;    ///< labels of elements on the same corners
  std::vector<std::pair<long, long>> mismatched;  ///< labels of elements whose common face has other midside nodes
  std::vector<std::pair<long, long>> touching;    ///< labels of nodes at the same position, within 1e-6 of the box
  std::vector<std::pair<long, int>>
      parts;  ///< unconnected parts: label of one element of each part, number of its elements
  std::vector<std::string> joining_sets;            ///< node sets with nodes of several parts, but not all of them
  std::vector<std::vector<std::string>> part_sets;  ///< node sets that lie within each part
  /// Diagonal of the bounding box [m].
  [[nodiscard]] double size() const { return (upper - lower).norm(); }
};

/// Returns the mean ratio 3 det(A)^(2/3) / |A|^2 of the three edges at a corner, A mapping the ideal corner (of an
/// equilateral tetrahedron, a regular wedge, a cube) to the element's corner: 1 for the ideal shape of any size, 0 when
/// flat or inverted.
/// @see Knupp (2001), SIAM J. Sci. Comput. 23, 193.
[[nodiscard]] double corner_shape(ElementType type, const Matrix3& edges);

/// Returns the smallest `corner_shape` of an element; 1 for a beam.
[[nodiscard]] double element_shape(const Mesh& mesh, const Element& element);

/// Computes the quality of a mesh. Its cost is linear in the size of the mesh except for sorting.
[[nodiscard]] MeshQuality quality_of(const Mesh& mesh);

/// Treatment of parts that share no node and that no tie joins.
enum class Parts {
  one,   ///< unconnected parts are a fault
  apart  ///< unconnected parts are intended: frames hold each of them
};

/// Returns the faults that make a mesh unusable: folded or repeated elements, unconnected parts. `file` names the mesh.
[[nodiscard]] std::vector<Fault> faults_of(const MeshQuality& quality, const std::string& file,
                                           Parts parts = Parts::one);

/// Returns a warning for a body of more than 10 m or less than 0.1 mm, whose unit of length is probably wrong.
/// @param box   lengths of the bounding box along the axes [m]
/// @param more  further text for a large body, ", 3 m^3"
[[nodiscard]] std::optional<Fault> size_warning(const Vector3& box, const std::string& file,
                                                const std::string& more = {}, bool is_heavy = false);

/// Returns warnings of probable mistakes: a body of more than 10 m or a tonne or less than 0.1 mm (a wrong unit of
/// length), unconnected nodes at the same position, very flat elements, faces that are connected by their corners
/// alone, parts that are intentionally unconnected.
[[nodiscard]] std::vector<Fault> warnings_of(const MeshQuality& quality, const std::string& file,
                                             Parts parts = Parts::one);

}  // namespace hersey::fem
