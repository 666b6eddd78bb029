#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// How good the elements of one type are.
struct ElementQuality {
  int count = 0;
  double smallest_shape = 1;   ///< of all corners: 1 ideal, 0 flat; see `corner_shape`
  double mean_shape = 0;       ///< over the elements, each by its worst corner
  long label_of_smallest = 0;  ///< element with the worst corner
  double largest_aspect = 1;   ///< longest by shortest edge of an element, between corners
};

/// What can be said of a mesh before anything is computed with it.
struct MeshQuality {
  Vector3 lower = Vector3::Zero(), upper = Vector3::Zero();  ///< bounding box [m]
  double volume = 0;                                         ///< of the solids [m^3]
  std::optional<double> mass;  ///< [kg]; none unless every solid has a density in the mesh file
  std::map<ElementType, ElementQuality> types;
  std::vector<long> folded;                         ///< labels of solids with a Jacobian that is not positive
  std::vector<std::pair<long, long>> repeated;      ///< labels of elements on the same corners
  std::vector<std::pair<long, long>> mismatched;    ///< labels of elements whose common face has other midside nodes
  std::vector<std::pair<long, long>> touching;      ///< labels of nodes at the same place, 1e-6 of the box
  std::vector<std::pair<long, int>> parts;          ///< unconnected parts: label of an element of each, its elements
  std::vector<std::string> joining_sets;            ///< node sets with nodes of several parts, but not all of them
  std::vector<std::vector<std::string>> part_sets;  ///< of each part: node sets that lie within it
  /// Diagonal of the bounding box [m].
  [[nodiscard]] double size() const { return (upper - lower).norm(); }
};

/// Mean ratio 3 det(A)^(2/3) / |A|^2 of the three edges at a corner, A mapping the ideal corner (of an equilateral
/// tetrahedron, a regular wedge, a cube) to the element's: 1 for the ideal shape of any size, 0 when flat or inverted.
/// @see Knupp (2001), SIAM J. Sci. Comput. 23, 193.
[[nodiscard]] double corner_shape(ElementType type, const Matrix3& edges);

/// Smallest `corner_shape` of an element; 1 for a beam.
[[nodiscard]] double element_shape(const Mesh& mesh, const Element& element);

/// Cost: linear in the mesh but for sorting.
[[nodiscard]] MeshQuality quality_of(const Mesh& mesh);

/// Whether parts that share no node and that no tie joins are a mistake.
enum class Parts {
  one,   ///< the body hangs together by itself
  apart  ///< each part is held by frames
};

/// What makes a mesh unfit for computing: folded or repeated elements, unconnected parts. `file` names the mesh.
[[nodiscard]] std::vector<Fault> faults_of(const MeshQuality& quality, const std::string& file,
                                           Parts parts = Parts::one);

/// A body whose unit of length hardly is the one meant: of more than 10 m or less than 0.1 mm.
/// @param box   its lengths along the axes [m]
/// @param more  what else to say of a large one, ", 3 m^3"
[[nodiscard]] std::optional<Fault> size_warning(const Vector3& box, const std::string& file,
                                                const std::string& more = {}, bool is_heavy = false);

/// What hardly is meant: a body of more than 10 m or a tonne or less than 0.1 mm (a wrong unit of length), nodes that
/// lie on each other unconnected, very flat elements, faces that hang together by their corners alone; parts that are
/// left apart on purpose.
[[nodiscard]] std::vector<Fault> warnings_of(const MeshQuality& quality, const std::string& file,
                                             Parts parts = Parts::one);

}  // namespace hersey::fem
