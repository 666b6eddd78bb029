#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hersey/core/spatial.h"

namespace hersey::fem {

/// Shapes of elements. Nodes are numbered as in Abaqus and CalculiX (corners first; midside nodes follow the corners'
/// edges bottom, top, upright), faces as there too; readers of other formats renumber.
/// Files of reduced bodies hold their places here: new ones come last.
enum class ElementType { tet4, tet10, wedge6, wedge15, hex8, hex20, beam2, pyramid5, pyramid13 };

/// Nodes of an element, midside ones included.
[[nodiscard]] int node_count(ElementType type);
[[nodiscard]] int face_count(ElementType type);  ///< 0 for a beam
/// "tet4".
[[nodiscard]] const char* name_of(ElementType type);

/// Nodes of one face, outward normal by the right hand: corners in turn, then the midside nodes of its edges in turn.
[[nodiscard]] const std::vector<int>& face_nodes(ElementType type, int face);

struct Element {
  ElementType type = ElementType::tet4;
  long label = 0;     ///< its number in the file it came from
  int first = 0;      ///< place of its first node in Mesh::connectivity
  int material = -1;  ///< place in Mesh::materials; -1: none given
};

/// Face `face` of element `element`, both counted from 0.
struct ElementFace {
  int element = 0;
  int face = 0;
};

/// What a mesh file says of a material; every number is optional because files often leave some out.
struct MeshMaterial {
  std::string name;
  std::optional<double> youngs_modulus;  ///< in the file's units until the mesh is scaled
  std::optional<double> poisson_ratio;
  std::optional<double> density;
};

/// A share of a tie: the displacement of a node along an axis of the mesh, times a coefficient.
struct TieTerm {
  int node = 0, axis = 0;
  double coefficient = 0;
};

/// A linear equation that displacements obey, sum coefficient u = 0, (elastic.31). The first term's degree of freedom
/// is in no other tie of the mesh.
using MeshTie = std::vector<TieTerm>;

/// Nodes, elements and named sets of a body, in metres once scaled, in the body's own axes.
struct Mesh {
  std::vector<Vector3> nodes;     ///< positions [m]
  std::vector<long> node_labels;  ///< their numbers in the file
  std::vector<Element> elements;
  std::vector<int> connectivity;  ///< places in `nodes`, element after element
  std::vector<MeshMaterial> materials;
  std::map<std::string, std::vector<int>> node_sets;     ///< places in `nodes`, ascending
  std::map<std::string, std::vector<int>> element_sets;  ///< places in `elements`, ascending
  std::map<std::string, std::vector<ElementFace>> surfaces;
  std::vector<MeshTie> ties;  ///< independent of each other

  /// Places of its nodes in `nodes`, node_count(element.type) of them.
  [[nodiscard]] const int* nodes_of(const Element& element) const { return connectivity.data() + element.first; }
};

}  // namespace hersey::fem
