#pragma once

#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "hersey/fem/elastic_body.h"

/// Meshes for tests, and dense linear algebra on them.
namespace hersey::fem {

constexpr std::array<ElementType, 8> solids = {ElementType::tet4,     ElementType::tet10,    ElementType::wedge6,
                                               ElementType::wedge15,  ElementType::hex8,     ElementType::hex20,
                                               ElementType::pyramid5, ElementType::pyramid13};

inline const SolidMaterial steel = isotropic({.youngs_modulus = 2.1e11, .poisson_ratio = 0.3, .density = 7850});

inline ElementType linear_of(ElementType type) {
  if (type == ElementType::tet10) return ElementType::tet4;
  if (type == ElementType::wedge15) return ElementType::wedge6;
  if (type == ElementType::pyramid13) return ElementType::pyramid5;
  return type == ElementType::hex20 ? ElementType::hex8 : type;
}

/// Puts midside nodes on the middle of straight edges.
inline void straighten(Mesh& mesh) {
  for (const Element& e : mesh.elements) {
    const int corners = node_count(linear_of(e.type));
    const Eigen::Matrix3Xd natural = natural_nodes(e.type);
    NodeColumns x(3, corners);
    for (int a = 0; a < corners; ++a) x.col(a) = mesh.nodes[mesh.nodes_of(e)[a]];
    for (int a = corners; a < node_count(e.type); ++a)
      mesh.nodes[mesh.nodes_of(e)[a]] = x * shape_functions(linear_of(e.type), natural.col(a)).N;
  }
}

/// A box of 2 x 2 x 2 cells whose nodes have been moved, the outer ones too.
inline Mesh distorted_box(ElementType type) {
  Mesh mesh = box_mesh(type, {1, 0.8, 1.3}, {2, 2, 2});
  for (Vector3& x : mesh.nodes)
    x += 0.07 * Vector3(std::sin(5 * x.y() + x.z()), std::sin(4 * x.z() + 2 * x.x()), std::cos(7 * x.x() - x.y()));
  straighten(mesh);
  return mesh;
}

/// One element of `type` with straight, unequal edges.
inline NodeColumns distorted_element(ElementType type) {
  Eigen::Matrix3Xd corners = natural_nodes(linear_of(type));
  for (Eigen::Index a = 0; a < corners.cols(); ++a)
    corners.col(a) += 0.1 * Vector3(std::sin(3.0 * a), std::cos(2.0 * a), std::sin(5.0 * a + 1));
  const Eigen::Matrix3Xd natural = natural_nodes(type);
  NodeColumns x(3, natural.cols());
  for (Eigen::Index a = 0; a < natural.cols(); ++a)
    x.col(a) = corners * shape_functions(linear_of(type), natural.col(a)).N;
  return x;
}

/// MacNeal and Harder (1985), Finite Elem. Anal. Des. 1, 3, Fig. 2: seven distorted bricks in a unit cube; nodes 0 to 7
/// are the cube's corners.
inline Mesh macneal_harder(ElementType type) {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  for (const Vector3& inner : {Vector3(0.249, 0.342, 0.192), Vector3(0.826, 0.288, 0.288), Vector3(0.850, 0.649, 0.263),
                               Vector3(0.273, 0.750, 0.230), Vector3(0.320, 0.186, 0.643), Vector3(0.677, 0.305, 0.683),
                               Vector3(0.788, 0.693, 0.644), Vector3(0.165, 0.745, 0.702)})
    mesh.nodes.push_back(inner);
  std::vector<std::vector<int>> bricks = {{8, 9, 10, 11, 12, 13, 14, 15}};
  for (int f = 0; f < 6; ++f) {
    std::vector<int> brick = face_nodes(ElementType::hex8, f);
    for (int a = 0; a < 4; ++a) brick.push_back(brick[a]);
    for (int a = 0; a < 4; ++a) brick[a] += 8;
    bricks.push_back(brick);
  }
  const Eigen::Matrix3Xd natural = natural_nodes(type);
  std::map<std::pair<int, int>, int> middle;
  for (const auto& brick : bricks) {
    mesh.elements.push_back(
        {.type = type, .label = long(mesh.elements.size()) + 1, .first = int(mesh.connectivity.size())});
    mesh.connectivity.insert(mesh.connectivity.end(), brick.begin(), brick.end());
    for (Eigen::Index m = 8; m < natural.cols(); ++m) {
      std::vector<int> ends;
      for (int a = 0; a < 8; ++a)
        if ((natural.col(a) - natural.col(m)).norm() < 1.1) ends.push_back(brick[a]);
      const auto [at, is_new] = middle.try_emplace(std::minmax(ends[0], ends[1]), int(mesh.nodes.size()));
      if (is_new) mesh.nodes.push_back((mesh.nodes[ends[0]] + mesh.nodes[ends[1]]) / 2);
      mesh.connectivity.push_back(at->second);
    }
  }
  return mesh;
}

/// u with K u = f on the free degrees of freedom and u as given where `fixed`.
inline Eigen::VectorXd solve_dense(const Eigen::MatrixXd& K, const Eigen::VectorXd& f, const std::vector<char>& fixed,
                                   Eigen::VectorXd u) {
  std::vector<int> free;
  for (int i = 0; i < K.rows(); ++i)
    if (!fixed[i]) free.push_back(i);
  for (const int i : free) u[i] = 0;
  const Eigen::VectorXd rest = f - K * u;
  const Eigen::VectorXd x = Eigen::MatrixXd(K(free, free)).ldlt().solve(Eigen::VectorXd(rest(free)));
  u(free) = x;
  return u;
}

}  // namespace hersey::fem
