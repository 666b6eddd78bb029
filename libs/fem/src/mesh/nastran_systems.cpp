// Coordinate systems as in the quick reference guide of MSC Nastran (2012): CORD1R, CORD2C, GRID and the like.
#include "mesh/nastran_systems.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace hersey::fem {
namespace {

using Kind = NastranSystems::Kind;

constexpr double kDegreeOfAngle = std::numbers::pi / 180;
constexpr double kOnALine = 1e-10;  // sine of the angle below which three points define no plane
constexpr int kDeepestChain = 1000;

/// Components along the system's own axes of a point: r, theta, z or r, theta from z, phi in degrees.
Vector3 along_axes(Kind kind, const Vector3& q) {
  if (kind == Kind::rectangular) return q;
  if (kind == Kind::cylindrical)
    return {q[0] * std::cos(kDegreeOfAngle * q[1]), q[0] * std::sin(kDegreeOfAngle * q[1]), q[2]};
  const double from_axis = q[0] * std::sin(kDegreeOfAngle * q[1]);
  return {from_axis * std::cos(kDegreeOfAngle * q[2]), from_axis * std::sin(kDegreeOfAngle * q[2]),
          q[0] * std::cos(kDegreeOfAngle * q[1])};
}

Vector3 in_basic(const NastranSystems::System& system, const Vector3& q) {
  return system.origin + system.axes * along_axes(system.kind, q);
}

}  // namespace

void NastranSystems::add(long number, Definition definition) {
  const auto [first, is_new] = systems_.try_emplace(number, definition);
  const Definition& other = first->second;
  const bool is_same = other.kind == definition.kind && other.is_by_grids == definition.is_by_grids &&
                       other.in == definition.in && other.points == definition.points &&
                       other.grids == definition.grids;
  if (!is_new && !is_same) repeated_.emplace_back(number, definition.location);
}

void NastranSystems::add_by_points(long number, Kind kind, long in, const std::array<Vector3, 3>& points,
                                   FileLocation location) {
  Definition definition;
  definition.location = location;
  definition.kind = kind;
  definition.in = in;
  definition.points = points;
  add(number, definition);
}

void NastranSystems::add_by_grids(long number, Kind kind, const std::array<long, 3>& grids, FileLocation location) {
  Definition definition;
  definition.location = location;
  definition.kind = kind;
  definition.is_by_grids = true;
  definition.grids = grids;
  add(number, definition);
}

void NastranSystems::add_grid(long label, const Vector3& coordinates, std::optional<long> position,
                              std::optional<long> motion, FileLocation location) {
  first_.try_emplace(label, grids_.size());
  grids_.push_back({coordinates, position, motion, location, false});
}

const NastranSystems::System& NastranSystems::resolved(const RawMesh& raw, long number, FileLocation user, int depth) {
  static const System basic;
  if (number == 0) return basic;
  const auto found = systems_.find(number);
  if (found == systems_.end())
    raw.fail(user, fmt::format("the coordinate system {}, which the file does not define", number),
             "a system of a CORD1R, CORD1C, CORD1S, CORD2R, CORD2C or CORD2S, or the basic system, 0 or empty",
             "add its entry, or let the program that made the file write all points in basic coordinates");
  Definition& definition = found->second;
  if (definition.progress == Progress::done) return definition.system;
  if (definition.progress == Progress::begun || depth > kDeepestChain)
    raw.fail(definition.location,
             fmt::format("the coordinate system {} is defined by itself, through other systems", number),
             "systems that lead to the basic one", "give one system of the cycle in basic coordinates");
  definition.progress = Progress::begun;
  find_axes(raw, number, definition, depth);
  definition.progress = Progress::done;
  return definition.system;
}

void NastranSystems::find_axes(const RawMesh& raw, long number, Definition& definition, int depth) {
  std::array<Vector3, 3> points;
  for (std::size_t k = 0; k < 3; ++k)
    points[k] = definition.is_by_grids
                    ? resolved_grid(raw, index_of(raw, definition.grids[k], definition.location), depth)
                    : in_basic(resolved(raw, definition.in, definition.location, depth + 1), definition.points[k]);
  const Vector3 to_z = points[1] - points[0], to_x = points[2] - points[0];
  const Vector3 normal = to_z.cross(to_x);
  if (!(normal.norm() > kOnALine * to_z.norm() * to_x.norm()))
    raw.fail(definition.location, fmt::format("the coordinate system {} has its three points on one line", number),
             "an origin, a point on the z-axis and a third beside that axis");
  System& system = definition.system;
  system.kind = definition.kind;
  system.origin = points[0];
  system.axes.col(2) = to_z.normalized();
  system.axes.col(1) = normal.normalized();
  system.axes.col(0) = system.axes.col(1).cross(system.axes.col(2));
}

const Vector3& NastranSystems::resolved_grid(const RawMesh& raw, std::size_t index, int depth) {
  Grid& grid = grids_[index];
  if (!grid.is_basic) {
    grid.r = in_basic(resolved(raw, grid.position.value_or(default_position_), grid.location, depth + 1), grid.r);
    grid.is_basic = true;
  }
  return grid.r;
}

std::size_t NastranSystems::index_of(const RawMesh& raw, long label, FileLocation user) const {
  const auto found = first_.find(label);
  if (found == first_.end())
    raw.fail(user, fmt::format("the grid point {}, which the file does not define", label), "a grid point of the file");
  return found->second;
}

void NastranSystems::resolve(RawMesh& raw) {
  if (!repeated_.empty()) {
    const auto& [number, location] = repeated_.front();
    raw.fail(location,
             fmt::format("the coordinate system {} is already defined in line {}, differently", number,
                         systems_.at(number).location.line),
             "each system once");
  }
  for (std::size_t n = 0; n < raw.nodes.size(); ++n) raw.nodes[n] = resolved_grid(raw, n, 0);
}

Matrix3 NastranSystems::directions(const RawMesh& raw, long label) {
  const auto found = first_.find(label);
  if (found == first_.end()) return Matrix3::Identity();
  const Grid& grid = grids_[found->second];
  const System& system = resolved(raw, grid.motion.value_or(default_motion_), grid.location, 0);
  if (system.kind == Kind::rectangular) return system.axes;
  const Vector3 own = system.axes.transpose() * (grid.r - system.origin);
  const double phi = std::hypot(own.x(), own.y()) > 0 ? std::atan2(own.y(), own.x()) : 0;
  Matrix3 local;
  if (system.kind == Kind::cylindrical) {
    local << std::cos(phi), -std::sin(phi), 0, std::sin(phi), std::cos(phi), 0, 0, 0, 1;
  } else {
    const double theta = own.norm() > 0 ? std::atan2(std::hypot(own.x(), own.y()), own.z()) : 0;
    local.col(0) << std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta);
    local.col(1) << std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi), -std::sin(theta);
    local.col(2) << -std::sin(phi), std::cos(phi), 0;
  }
  return system.axes * local;
}

const Vector3* NastranSystems::position(long label) const {
  const auto found = first_.find(label);
  return found == first_.end() ? nullptr : &grids_[found->second].r;
}

}  // namespace hersey::fem
