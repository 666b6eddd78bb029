#pragma once

#include <vector>

namespace hersey {

/// One of the functions of a surface that are not zero at a point.
struct SurfaceTerm {
  int index = 0;          ///< which function, 0..count() - 1
  double value = 0;       ///< psi
  double by_phi = 0;      ///< d psi / d phi
  double by_phi_phi = 0;  ///< d^2 psi / d phi^2
};

/// Smooth functions psi_j(phi, z) on a cylinder |z| <= width / 2: products of periodic cubic B-splines around and of
/// clamped B-splines along, (film-surface.1), (film-surface.2). No function is negative and all of them add up to 1.
/// Twice continuously differentiable around.
/// @see de Boor (2001), A Practical Guide to Splines, ch. IX. @verified_by surface_functions_test.cpp
class SurfaceFunctions {
 public:
  /// @param around functions around, >= 4; function i has its largest value at phi = 2 pi i / around
  /// @param along functions along the axis, >= 1, splines of degree min(3, along - 1)
  /// @param width of the surface [m], > 0
  /// @throws ContractError outside these ranges
  SurfaceFunctions(int around, int along, double width);

  /// Functions around the cylinder.
  [[nodiscard]] int around() const { return around_; }
  /// Functions along its axis.
  [[nodiscard]] int along() const { return along_; }
  /// Of the cylinder [m].
  [[nodiscard]] double width() const { return width_; }
  /// All functions: around() along().
  [[nodiscard]] int count() const { return around_ * along_; }

  /// Writes the functions that are not zero at (phi, z), at most 16, into `terms`; function i around and k along has
  /// index k * around + i. Any angle [rad]; a z [m] beyond the width is taken as the width's end. The values add up to
  /// 1, the derivatives to 0. Allocates only where `terms` has no room yet.
  void at(double phi, double z, std::vector<SurfaceTerm>& terms) const;

 private:
  int around_ = 0, along_ = 0;
  double width_ = 0;
};

}  // namespace hersey
