#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "hersey/bearing/bearing_kind.h"
#include "hersey/bearing/coordinates.h"
#include "hersey/film/gap_profile.h"
#include "hersey/film/value_and_slope.h"

namespace hersey::bearing {

/// A position on a skirt, as its shapes see it.
struct SkirtPosition {
  double phi = 0;  ///< from the middle of the thrust side [rad]
  double z = 0;    ///< from the middle of the skirt's length, towards the crown [m]
  double L = 1;    ///< the skirt's length [m]
};

// Shapes of a skirt, by how much its surface lies back from the cylinder (theory manual, skirt.3). A new one is a
// struct like these and an alternative of SkirtShape.

/// Two parabolas along the axis that meet at the widest place.
struct SkirtBarrel {
  double top = 0, bottom = 0;  ///< at the skirt's ends [m], >= 0
  double apex = 0;             ///< z of the widest place, between the ends [m]
  /// Opening there [m].
  [[nodiscard]] double opening(const SkirtPosition& at) const;
};

/// A skirt that is narrower along the pin than across it, top sin^2 phi, linear along the axis.
struct SkirtOvality {
  double top = 0, bottom = 0;  ///< a quarter of the circumference from the thrust side, at the skirt's ends [m], >= 0
  /// Opening there [m].
  [[nodiscard]] double opening(const SkirtPosition& at) const;
};

/// A measured profile.
struct SkirtTable {
  film::MeasuredShape shape;
  /// Opening there [m].
  [[nodiscard]] double opening(const SkirtPosition& at) const;
};

using SkirtShape = std::variant<SkirtBarrel, SkirtOvality, SkirtTable>;

/// A liner whose bore differs from a cylinder, measured or computed hot, in the axes of its own frame.
struct LinerBore {
  film::MeasuredShape shape;
  /// By how much it widens the gap at (phi [rad], z [m]) of the liner [m], and the slope of that along z [-]: straight
  /// lines between the heights of the table, constant beyond them.
  [[nodiscard]] film::ValueAndSlope at(double phi, double z) const;
};

/// Sides of a skirt, in the order of the patches of its film.
inline constexpr std::array<std::string_view, 2> skirt_sides{"thrust", "antithrust"};

/// A piston's skirt in its liner, with a film on the thrust side, about phi = 0, and one on the antithrust side, about
/// phi = pi: two patches on film::Skirt. The skirt's frame has its origin on its axis at half of its length, x towards
/// the thrust side and z along the axis towards the crown; the liner is a cylinder about the z-axis of its own frame,
/// without an end, unless it has a shape of its own. Choose it for the secondary motion of pistons and crossheads.
class PistonSkirt final : public BearingKind {
 public:
  /// @param shapes  of the skirt; they add up
  /// @param liner  unset: a cylinder
  explicit PistonSkirt(std::vector<SkirtShape> shapes = {}, std::optional<LinerBore> liner = {})
      : shapes_(std::move(shapes)), liner_(std::move(liner)) {}

  [[nodiscard]] std::string name() const override { return "skirt"; }
  [[nodiscard]] bool has_axis() const override { return false; }
  [[nodiscard]] std::string fixed_surface() const override { return "skirt"; }
  [[nodiscard]] std::string moving_surface() const override { return "liner"; }
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> description(
      const film::FilmModel& model) const override;
  [[nodiscard]] std::unique_ptr<GapKinematics> gap(const film::FilmModel& model,
                                                   bool moving_surface_deforms) const override;
  [[nodiscard]] std::unique_ptr<SteadyCoordinates> steady_coordinates(const film::FilmModel& model) const override;

  /// Returns by how much the shapes open the gap at the nodes [m], shape (grid.size()).
  [[nodiscard]] Eigen::VectorXd opening(const film::FilmModel& model) const;

 private:
  std::vector<SkirtShape> shapes_;
  std::optional<LinerBore> liner_;
};

/// Returns a grid for such a skirt.
/// @param thrust,antithrust  angles that the films cover, each below pi [rad]
/// @param lines,rows  nodes around each side and along the axis, those on the edges included
[[nodiscard]] film::Grid skirt_grid(double thrust, double antithrust, int lines, int rows);

/// What bears on one side of a skirt.
struct SkirtSide {
  double force = 0;   ///< part of the film and of contact across the liner, that pushes the skirt away from it [N]
  double moment = 0;  ///< of that force about the middle of the skirt's length, force times z [N m]
  /// Where the force acts, z [m]; not a number where there is none.
  [[nodiscard]] double centre() const { return force > 0 ? moment / force : std::nan(""); }
};

/// Returns what bears on both sides (skirt.7). @param normal_forces  of film::FilmObservables
[[nodiscard]] std::array<SkirtSide, 2> skirt_side_forces(const film::FilmModel& model,
                                                         const Eigen::VectorXd& normal_forces);

/// Returns the force on a skirt along the liner's axis (skirt.8), positive towards the crown: what the skirt loses to
/// friction, and the reverse of what drags the liner [N].
/// @param wrench  on the skirt, in its frame @param tilt  slope of the skirt's axis
[[nodiscard]] double skirt_friction(const Vector6& wrench, const Eigen::Vector2d& tilt);

}  // namespace hersey::bearing
