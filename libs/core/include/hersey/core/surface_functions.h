#pragma once

#include <optional>
#include <vector>

namespace hersey {

/// Value and derivatives of a surface function that is not zero at a point.
struct SurfaceTerm {
  int index = 0;          ///< index of the function, 0..count() - 1
  double value = 0;       ///< psi
  double by_phi = 0;      ///< d psi / d phi
  double by_phi_phi = 0;  ///< d^2 psi / d phi^2
};

/// Part of a cylinder: from an angle on over another [rad].
struct SurfaceArc {
  double from = 0, over = 0;
};

/// Smooth functions psi_j(phi, z) on a cylinder |z| <= width / 2: products of periodic cubic B-splines around the
/// cylinder and of clamped B-splines along its axis, (film-surface.1), (film-surface.2). On an arc of a cylinder they
/// are clamped at its ends, too. The functions are not negative and their sum is 1. Twice continuously differentiable
/// around.
/// @see de Boor (2001), A Practical Guide to Splines, ch. IX. @verified_by surface_functions_test.cpp
class SurfaceFunctions {
 public:
  /// @param around  number of functions around the cylinder, >= 4; function i has its maximum at phi = 2 pi i / around
  /// @param along   number of functions along the axis, >= 1; splines of degree min(3, along - 1)
  /// @param width   axial width of the surface [m], > 0
  /// @param arc     the part of the cylinder that the surface is; all of it unless given. Its extent is > 0 and less
  ///                than a turn
  /// @throws ContractError outside these ranges
  SurfaceFunctions(int around, int along, double width, std::optional<SurfaceArc> arc = std::nullopt);

  /// Returns the number of functions around the cylinder.
  [[nodiscard]] int around() const { return around_; }
  /// Returns the number of functions along its axis.
  [[nodiscard]] int along() const { return along_; }
  /// Returns the arc of the cylinder that they are on; none: all of it.
  [[nodiscard]] const std::optional<SurfaceArc>& arc() const { return arc_; }
  /// Returns the axial width of the cylinder [m].
  [[nodiscard]] double width() const { return width_; }
  /// Returns the number of all functions, around() along().
  [[nodiscard]] int count() const { return around_ * along_; }

  /// Writes the functions that are not zero at (phi, z), at most 16, into `terms`; function i around and k along has
  /// index k * around + i. The angle [rad] is arbitrary; a z [m] beyond an edge is taken as the edge, an angle
  /// beyond an arc as its nearer end, where values go on unchanged. The sum of the
  /// values is 1, that of the derivatives is 0. Allocates only if the capacity of `terms` is too small.
  void at(double phi, double z, std::vector<SurfaceTerm>& terms) const;

 private:
  int around_ = 0, along_ = 0;
  double width_ = 0;
  std::optional<SurfaceArc> arc_;
};

}  // namespace hersey
