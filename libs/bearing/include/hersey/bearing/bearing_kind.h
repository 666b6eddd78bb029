#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hersey/bearing/gap_kinematics.h"
#include "hersey/bearing/steady_coordinates.h"
#include "hersey/film/film_model.h"

namespace hersey::bearing {

/// Description of a kind of bearing: how its two surfaces lie to each other, in a machine and by itself. A new kind
/// derives from it in a folder of its own, src/kinds/<kind>. Constant, shared between threads.
class BearingKind {
 public:
  virtual ~BearingKind() = default;

  /// Name of the kind in the model file: "journal".
  [[nodiscard]] virtual std::string name() const = 0;
  /// True of kinds whose moving surface has an axis in a bore: position and force lie in the plane across it, with an
  /// attitude, coefficients along the load and a whirl.
  [[nodiscard]] virtual bool has_axis() const = 0;
  /// Names of the fixed and of the moving surface in messages: "shell" and "journal".
  [[nodiscard]] virtual std::string fixed_surface() const = 0;
  /// See fixed_surface().
  [[nodiscard]] virtual std::string moving_surface() const = 0;
  /// True if the leading ends of films in patches are those with the smaller coordinate; pads that are made for the
  /// other sense of motion have them at the larger one.
  [[nodiscard]] virtual bool is_forward() const { return true; }
  /// Returns what a report states of the kind's own geometry: name and text of each statement.
  [[nodiscard]] virtual std::vector<std::pair<std::string, std::string>> description(
      const film::FilmModel& model) const = 0;
  /// Returns the gap of a film between two moving bodies.
  /// @param moving_surface_deforms  its deformation travels over the grid with it
  [[nodiscard]] virtual std::unique_ptr<GapKinematics> gap(const film::FilmModel& model,
                                                           bool moving_surface_deforms) const = 0;
  /// Returns the coordinates of a steady search for a film of this kind.
  [[nodiscard]] virtual std::unique_ptr<SteadyCoordinates> steady_coordinates(const film::FilmModel& model) const = 0;
};

/// A journal in a bore.
[[nodiscard]] std::shared_ptr<const BearingKind> journal_kind();

}  // namespace hersey::bearing
