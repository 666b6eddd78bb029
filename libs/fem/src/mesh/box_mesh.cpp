#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "element/element_kind.h"
#include "hersey/core/contract.h"
#include "hersey/fem/elastic_body.h"
#include "hersey/fem/shape_functions.h"

namespace hersey::fem {
namespace {

using Cell = std::array<int, 3>;

// A hexahedron's corners cut into wedges along the diagonal 0-2, into six tetrahedra around the diagonal 0-6, and into
// six pyramids that meet in its middle, 8.
const std::vector<std::vector<int>>& pieces(ElementType type) {
  static const std::vector<std::vector<int>> whole = {{0, 1, 2, 3, 4, 5, 6, 7}};
  static const std::vector<std::vector<int>> halves = {{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}};
  static const std::vector<std::vector<int>> tets = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6},
                                                     {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
  static const std::vector<std::vector<int>> pyramids = {{0, 1, 2, 3, 8}, {4, 7, 6, 5, 8}, {0, 4, 5, 1, 8},
                                                         {1, 5, 6, 2, 8}, {2, 6, 7, 3, 8}, {3, 7, 4, 0, 8}};
  const int corners = kind_of(type).corners;
  if (corners == 8) return whole;
  if (corners == 6) return halves;
  if (corners == 5) return pyramids;
  HERSEY_REQUIRE(corners == 4, "a shape that fills a box");
  return tets;
}

constexpr int kPerCell = 4;  // steps of the lattice: half-way between a corner and the middle of a cell is one

/// Makes nodes on a lattice finer than the cells, each when first asked for.
class Lattice {
 public:
  Lattice(Mesh& mesh, const Vector3& size, const Cell& cells) : mesh_(mesh) {
    for (int k = 0; k < 3; ++k) step_[k] = size[k] / (kPerCell * cells[static_cast<std::size_t>(k)]);
  }

  int node(const Cell& at) {
    const auto [entry, is_new] = number_.try_emplace(at, static_cast<int>(mesh_.nodes.size()));
    if (is_new) {
      mesh_.nodes.emplace_back(at[0] * step_[0], at[1] * step_[1], at[2] * step_[2]);
      mesh_.node_labels.push_back(entry->second + 1);
    }
    return entry->second;
  }

  [[nodiscard]] const std::map<Cell, int>& numbers() const { return number_; }

 private:
  Mesh& mesh_;
  Vector3 step_;
  std::map<Cell, int> number_;
};

void add_element(Mesh& mesh, Lattice& lattice, ElementType type, const Cell& cell, const std::vector<int>& piece) {
  static const Eigen::Matrix3Xd cube = [] {
    Eigen::Matrix3Xd corners_and_middle = Eigen::Matrix3Xd::Zero(3, 9);
    corners_and_middle.leftCols<8>() = natural_nodes(ElementType::hex8);
    return corners_and_middle;
  }();
  // The nodes of the piece are where its straight-sided shape puts them.
  const auto linear = piece.size() == 8   ? ElementType::hex8
                      : piece.size() == 6 ? ElementType::wedge6
                      : piece.size() == 5 ? ElementType::pyramid5
                                          : ElementType::tet4;
  NodeColumns corners(3, piece.size());
  for (std::size_t a = 0; a < piece.size(); ++a)
    for (int k = 0; k < 3; ++k)
      corners(k, static_cast<Eigen::Index>(a)) =
          kPerCell * (cell[static_cast<std::size_t>(k)] + (1 + cube(k, piece[a])) / 2);
  mesh.elements.push_back({.type = type,
                           .label = static_cast<long>(mesh.elements.size()) + 1,
                           .first = static_cast<int>(mesh.connectivity.size())});
  const Eigen::Matrix3Xd natural = natural_nodes(type);
  for (Eigen::Index a = 0; a < natural.cols(); ++a) {
    const Vector3 at = corners * shape_functions(linear, natural.col(a)).N;
    Cell lattice_point;
    for (int k = 0; k < 3; ++k) lattice_point[static_cast<std::size_t>(k)] = static_cast<int>(std::lround(at[k]));
    mesh.connectivity.push_back(lattice.node(lattice_point));
  }
}

void add_sides(Mesh& mesh, const std::map<Cell, int>& numbers, const Cell& cells) {
  constexpr std::array<char, 3> axes = {'x', 'y', 'z'};
  for (std::size_t k = 0; k < 3; ++k)
    for (int end = 0; end < 2; ++end) {
      const std::string name = {axes[k], static_cast<char>('0' + end)};
      std::vector<char> there(mesh.nodes.size(), 0);
      for (const auto& [at, node] : numbers)
        if (at[k] == kPerCell * end * cells[k]) there[static_cast<std::size_t>(node)] = 1;
      for (std::size_t a = 0; a < there.size(); ++a)
        if (there[a]) mesh.node_sets[name].push_back(static_cast<int>(a));
      for (std::size_t e = 0; e < mesh.elements.size(); ++e)
        for (int face = 0; face < face_count(mesh.elements[e].type); ++face) {
          const auto& nodes = face_nodes(mesh.elements[e].type, face);
          const int* of = mesh.nodes_of(mesh.elements[e]);
          if (std::all_of(nodes.begin(), nodes.end(), [&](int a) { return there[static_cast<std::size_t>(of[a])]; }))
            mesh.surfaces[name].push_back({static_cast<int>(e), face});
        }
    }
}

}  // namespace

Mesh box_mesh(ElementType type, const Vector3& size, const std::array<int, 3>& cells) {
  HERSEY_REQUIRE(type != ElementType::beam2, "a box of solids");
  HERSEY_REQUIRE(*std::min_element(cells.begin(), cells.end()) > 0 && size.minCoeff() > 0, "the box has volume");
  Mesh mesh;
  Lattice lattice(mesh, size, cells);
  for (int z = 0; z < cells[2]; ++z)
    for (int y = 0; y < cells[1]; ++y)
      for (int x = 0; x < cells[0]; ++x)
        for (const std::vector<int>& piece : pieces(type)) add_element(mesh, lattice, type, {x, y, z}, piece);
  add_sides(mesh, lattice.numbers(), cells);
  return mesh;
}

}  // namespace hersey::fem
