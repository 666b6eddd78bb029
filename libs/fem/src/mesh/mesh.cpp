#include "hersey/fem/mesh.h"

#include <array>

namespace hersey::fem {
namespace {

struct Topology {
  const char* name;
  int nodes;
  std::vector<std::vector<int>> faces;
};

// Faces as in the CalculiX manual, sections on C3D4 to C3D20; S1 is face 0.
const std::array<Topology, 7>& topologies() {
  static const std::array<Topology, 7> all = {{
      {"tet4", 4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}},
      {"tet10", 10, {{0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 8, 7}, {1, 2, 3, 5, 9, 8}, {2, 0, 3, 6, 7, 9}}},
      {"wedge6", 6, {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}},
      {"wedge15",
       15,
       {{0, 2, 1, 8, 7, 6},
        {3, 4, 5, 9, 10, 11},
        {0, 1, 4, 3, 6, 13, 9, 12},
        {1, 2, 5, 4, 7, 14, 10, 13},
        {2, 0, 3, 5, 8, 12, 11, 14}}},
      {"hex8", 8, {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}},
      {"hex20",
       20,
       {{0, 3, 2, 1, 11, 10, 9, 8},
        {4, 5, 6, 7, 12, 13, 14, 15},
        {0, 1, 5, 4, 8, 17, 12, 16},
        {1, 2, 6, 5, 9, 18, 13, 17},
        {2, 3, 7, 6, 10, 19, 14, 18},
        {3, 0, 4, 7, 11, 16, 15, 19}}},
      {"beam2", 2, {}},
  }};
  return all;
}

const Topology& topology(ElementType type) { return topologies()[static_cast<std::size_t>(type)]; }

}  // namespace

int node_count(ElementType type) { return topology(type).nodes; }
int face_count(ElementType type) { return static_cast<int>(topology(type).faces.size()); }
const char* name_of(ElementType type) { return topology(type).name; }
const std::vector<int>& face_nodes(ElementType type, int face) {
  return topology(type).faces[static_cast<std::size_t>(face)];
}

}  // namespace hersey::fem
