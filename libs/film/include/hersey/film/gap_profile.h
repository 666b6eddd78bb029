#pragma once

#include <Eigen/Dense>
#include <variant>
#include <vector>

namespace hersey::film {

struct Grid;

// Deviations of a surface from its cylinder, as metal that is missing: by how much they widen the gap [m] at (phi, z).
// A new one is a struct like these and its name in Profile.

/// Falls off towards both edges as a parabola.
struct Barrel {
  double drop = 0;  ///< at the edges [m]
  [[nodiscard]] double opening(double phi, double z, double L) const;
};

/// Opens along the axis, by nothing at z = 0.
struct Taper {
  double rise = 0;  ///< from z = -L/2 to L/2 [m]
  [[nodiscard]] double opening(double phi, double z, double L) const;
};

/// An ellipse: wider by `amplitude` at `angle` and opposite, narrower by as much in between.
struct Ovality {
  double amplitude = 0;  ///< [m]
  double angle = 0;      ///< [rad]
  [[nodiscard]] double opening(double phi, double z, double L) const;
};

/// Equal circular arcs, each with its centre moved by `offset` away from the middle of its arc: there the gap is that
/// of the clearance, and between two arcs it is widest. Two of them are a lemon bore.
struct Lobes {
  int count = 2;      ///< >= 2
  double offset = 0;  ///< [m], >= 0
  double angle = 0;   ///< middle of one arc [rad]
  [[nodiscard]] double opening(double phi, double z, double L) const;
};

using Profile = std::variant<Barrel, Taper, Ovality, Lobes>;

/// Sum of all openings at the nodes of the grid [m], shape (grid.size()).
[[nodiscard]] Eigen::VectorXd gap_profile(const std::vector<Profile>& profiles, const Grid& grid, double L);

}  // namespace hersey::film
