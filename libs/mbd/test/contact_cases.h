#pragma once

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <vector>

#include "hersey/mbd/contact.h"

namespace hersey::mbd::test {

inline Pose pose_at(const Vector3& phi, const Vector3& r) { return {rotation_exp(phi).toRotationMatrix(), r}; }

/// Corners of a mesh, those at the same position (but for round-off) once.
struct UniqueCorners {
  std::vector<Vector3> corners;
  std::map<std::array<long, 3>, int> number_at;  // by nanometres

  int add(const Vector3& p) {
    const std::array position{std::lround(1e9 * p.x()), std::lround(1e9 * p.y()), std::lround(1e9 * p.z())};
    const auto [entry, is_new] = number_at.try_emplace(position, static_cast<int>(corners.size()));
    if (is_new) corners.push_back(p);
    return entry->second;
  }
};

/// A box's surface in twelve triangles, seen from outside counter-clockwise, each face cut `cuts` times each way.
inline std::shared_ptr<const TriangleMesh> box_mesh(const Box& box, int cuts = 1) {
  auto mesh = std::make_shared<TriangleMesh>();
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-0.5, 0.5}) {
      const int first = static_cast<int>(mesh->corners.size());
      for (int i = 0; i <= cuts; ++i)
        for (int j = 0; j <= cuts; ++j) {
          Vector3 p;
          p[axis] = side;
          p[(axis + 1) % 3] = static_cast<double>(i) / cuts - 0.5;
          p[(axis + 2) % 3] = static_cast<double>(j) / cuts - 0.5;
          mesh->corners.push_back(box.X_BS * p.cwiseProduct(box.size));
        }
      for (int i = 0; i < cuts; ++i)
        for (int j = 0; j < cuts; ++j) {
          const int a = first + i * (cuts + 1) + j, b = a + cuts + 1, c = b + 1, d = a + 1;
          if (side > 0) {
            mesh->triangles.push_back({a, b, c});
            mesh->triangles.push_back({a, c, d});
          } else {
            mesh->triangles.push_back({a, c, b});
            mesh->triangles.push_back({a, d, c});
          }
        }
    }
  // Corners at the same position are one corner, as the STL reader leaves them.
  UniqueCorners unique;
  std::vector<int> index;
  for (const Vector3& corner : mesh->corners) index.push_back(unique.add(corner));
  mesh->corners = unique.corners;
  for (auto& triangle : mesh->triangles)
    for (int& corner : triangle) corner = index[corner];
  return mesh;
}

/// A ball's surface, an octahedron refined `levels` times and pulled onto the sphere.
inline std::shared_ptr<const TriangleMesh> ball_mesh(double radius, int levels) {
  struct Builder {
    TriangleMesh mesh;
    UniqueCorners unique;
    void split(const Vector3& a, const Vector3& b, const Vector3& c, int levels) {
      if (levels == 0) {
        const int i = unique.add(a), j = unique.add(b), k = unique.add(c);
        mesh.triangles.push_back({i, j, k});
        return;
      }
      const Vector3 ab = (a + b).normalized(), bc = (b + c).normalized(), ca = (c + a).normalized();
      split(a, ab, ca, levels - 1);
      split(ab, b, bc, levels - 1);
      split(ca, bc, c, levels - 1);
      split(ab, bc, ca, levels - 1);
    }
  } builder;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0}) {
        const Vector3 a(x, 0, 0), b(0, y, 0), c(0, 0, z);
        if (x * y * z > 0) {
          builder.split(a, b, c, levels);
        } else {
          builder.split(a, c, b, levels);
        }
      }
  builder.mesh.corners = builder.unique.corners;
  for (Vector3& corner : builder.mesh.corners) corner *= radius;
  return std::make_shared<TriangleMesh>(std::move(builder.mesh));
}

}  // namespace hersey::mbd::test
