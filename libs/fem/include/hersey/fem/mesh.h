#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hersey/core/spatial.h"

namespace hersey::fem {

/// Types of elements. Nodes are numbered as in Abaqus and CalculiX (corners first; midside nodes follow the corners'
/// edges bottom, top, upright), and so are faces; readers of other formats renumber them.
/// Files of reduced bodies store the values of this enumeration: append new types at the end.
enum class ElementType { tet4, tet10, wedge6, wedge15, hex8, hex20, beam2, pyramid5, pyramid13 };

/// Returns the number of nodes of an element, midside nodes included.
[[nodiscard]] int node_count(ElementType type);
[[nodiscard]] int face_count(ElementType type);  ///< 0 for a beam
/// Returns the name of a type, such as "tet4".
[[nodiscard]] const char* name_of(ElementType type);

/// Returns the nodes of one face, ordered so that the right-hand rule gives the outward normal: its corners, then the
/// midside nodes of its edges in the same order.
[[nodiscard]] const std::vector<int>& face_nodes(ElementType type, int face);

struct Element {
  ElementType type = ElementType::tet4;
  long label = 0;     ///< number of the element in its file
  int first = 0;      ///< index of its first node in Mesh::connectivity
  int material = -1;  ///< index in Mesh::materials; -1: none given
};

/// Face `face` of element `element`, both counted from 0.
struct ElementFace {
  int element = 0;
  int face = 0;
};

/// Material as a mesh file gives it; every number is optional because files often omit some.
struct MeshMaterial {
  std::string name;
  std::optional<double> youngs_modulus;  ///< in the file's units until the mesh is scaled
  std::optional<double> poisson_ratio;
  std::optional<double> density;
};

/// Term of a tie: the displacement of a node along an axis of the mesh, times a coefficient.
struct TieTerm {
  int node = 0, axis = 0;
  double coefficient = 0;
};

/// Linear equation between displacements, sum coefficient u = 0, (elastic.31). The degree of freedom of the first term
/// occurs in no other tie of the mesh.
using MeshTie = std::vector<TieTerm>;

/// Nodes, elements and named sets of a body, in metres once scaled, in the body's own axes.
struct Mesh {
  std::vector<Vector3> nodes;     ///< positions [m]
  std::vector<long> node_labels;  ///< numbers of the nodes in the file
  std::vector<Element> elements;
  std::vector<int> connectivity;  ///< indices in `nodes`, element after element
  std::vector<MeshMaterial> materials;
  std::map<std::string, std::vector<int>> node_sets;     ///< indices in `nodes`, ascending
  std::map<std::string, std::vector<int>> element_sets;  ///< indices in `elements`, ascending
  std::map<std::string, std::vector<ElementFace>> surfaces;
  std::vector<MeshTie> ties;  ///< independent of each other

  /// Returns the indices of an element's nodes in `nodes`, node_count(element.type) of them.
  [[nodiscard]] const int* nodes_of(const Element& element) const { return connectivity.data() + element.first; }
};

}  // namespace hersey::fem
