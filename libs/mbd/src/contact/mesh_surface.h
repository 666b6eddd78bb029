#pragma once

#include <array>
#include <memory>
#include <vector>

#include "contact/box_tree.h"
#include "hersey/mbd/shape.h"

namespace hersey::mbd {

/// The part of a triangle that is nearest to a point.
enum class Feature { face, edge, corner };

struct NearestOnTriangle {
  Feature feature = Feature::face;
  int part = 0;  ///< edge from corner `part` to the next; or corner `part`
  Vector3 point = Vector3::Zero();
  double distance = 0;  ///< >= 0
};

/// A triangulated surface prepared for contact: neighbours, normals, areas, a tree of boxes.
class MeshSurface {
 public:
  /// Relative difference of two distances that says nothing.
  static constexpr double round_off = 1e-14;

  explicit MeshSurface(std::shared_ptr<const TriangleMesh> mesh);

  [[nodiscard]] const TriangleMesh& mesh() const { return *mesh_; }
  [[nodiscard]] const Vector3& corner(int triangle, int i) const {
    return mesh_->corners[mesh_->triangles[triangle][i % 3]];
  }
  [[nodiscard]] const Vector3& normal(int triangle) const { return normals_[triangle]; }
  /// A third of the area of the triangles around each corner [m^2].
  [[nodiscard]] const std::vector<double>& corner_areas() const { return corner_areas_; }
  [[nodiscard]] const BoxTree& triangles() const { return triangles_; }
  [[nodiscard]] const BoxTree& corners() const { return corners_; }

  /// @see Ericson (2005), Real-Time Collision Detection, Sec. 5.1.5.
  [[nodiscard]] NearestOnTriangle nearest_on(int triangle, const Vector3& p) const;

  /// True if `found`, the nearest point of `triangle` to p, is a local minimum of the distance over the surface: no
  /// neighbour that shares its edge or corner is nearer.
  [[nodiscard]] bool is_local_minimum(int triangle, const NearestOnTriangle& found, const Vector3& p) const;

 private:
  std::shared_ptr<const TriangleMesh> mesh_;
  std::vector<Vector3> normals_;
  std::vector<double> corner_areas_;
  std::vector<int> around_start_, around_;  ///< triangles around corner c: around_[around_start_[c] .. [c + 1])
  BoxTree triangles_, corners_;
};

}  // namespace hersey::mbd
