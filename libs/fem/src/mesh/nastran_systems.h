#pragma once

#include <array>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mesh/raw_mesh.h"

namespace hersey::fem {

/// Coordinate systems of a bulk data file and the grid points in them: each system may be defined by points of another
/// one, or by grid points, which may lie in other systems themselves.
class NastranSystems {
 public:
  enum class Kind { rectangular, cylindrical, spherical };

  /// Origin and axes in the basic system.
  struct System {
    Kind kind = Kind::rectangular;
    Vector3 origin = Vector3::Zero();
    Matrix3 axes = Matrix3::Identity();  ///< axes as columns
  };

  /// CORD2R, C, S: three points a, b, c in the system `in`, the origin, one on the z-axis, one in the x-z plane.
  void add_by_points(long number, Kind kind, long in, const std::array<Vector3, 3>& points, FileLocation location);
  /// CORD1R, C, S: by grid points.
  void add_by_grids(long number, Kind kind, const std::array<long, 3>& grids, FileLocation location);

  /// Adds a grid point; call it once for each node of the mesh, in their order.
  /// @param position, motion  systems of the coordinates and of the displacements; none: those of GRDSET
  void add_grid(long label, const Vector3& coordinates, std::optional<long> position, std::optional<long> motion,
                FileLocation location);
  /// GRDSET, before or behind the grid points that it concerns.
  void set_defaults(long position, long motion) { default_position_ = position, default_motion_ = motion; }

  /// Transforms the positions of all grid points of `raw` into the basic system.
  /// @throws InputError for systems and grid points that the file does not define, that define each other in a cycle,
  /// or whose points lie on one line
  void resolve(RawMesh& raw);

  /// Directions of a grid point's displacements 1, 2, 3 in the basic system, as columns, where it lies after `resolve`.
  [[nodiscard]] Matrix3 directions(const RawMesh& raw, long label);
  /// Position of a grid point after `resolve`; none where the file does not define it.
  [[nodiscard]] const Vector3* position(long label) const;

 private:
  enum class Progress { open, begun, done };
  struct Definition {
    FileLocation location;
    Kind kind = Kind::rectangular;
    bool is_by_grids = false;
    long in = 0;
    std::array<Vector3, 3> points{};
    std::array<long, 3> grids{};
    System system;
    Progress progress = Progress::open;
  };
  struct Grid {
    Vector3 r = Vector3::Zero();
    std::optional<long> position, motion;
    FileLocation location;
    bool is_basic = false;  ///< true: r is in the basic system
  };

  void add(long number, Definition definition);
  const System& resolved(const RawMesh& raw, long number, FileLocation user, int depth);
  const Vector3& resolved_grid(const RawMesh& raw, std::size_t index, int depth);
  [[nodiscard]] std::size_t index_of(const RawMesh& raw, long label, FileLocation user) const;
  void find_axes(const RawMesh& raw, long number, Definition& definition, int depth);

  long default_position_ = 0, default_motion_ = 0;
  std::map<long, Definition> systems_;
  std::vector<std::pair<long, FileLocation>> repeated_;
  std::vector<Grid> grids_;                      ///< grid points in the order of RawMesh::nodes
  std::unordered_map<long, std::size_t> first_;  ///< first index of each label
};

}  // namespace hersey::fem
