#include "kinds/journal/journal_coordinates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hersey/bearing/bearing_kind.h"
#include "hersey/bearing/journal_gap.h"
#include "hersey/bearing/steady_surfaces.h"
#include "kinds/journal/short_bearing.h"

namespace hersey::bearing {
namespace {

// Eccentricity over the clearance below which no gap is the widest.
constexpr double kNearCentre = 1e-6;

// A gap of this fraction of the clearance counts as none.
constexpr double kLeastGap = 3e-3;

class JournalKind final : public BearingKind {
 public:
  [[nodiscard]] std::string name() const override { return "journal"; }
  [[nodiscard]] bool has_axis() const override { return true; }
  [[nodiscard]] std::string fixed_surface() const override { return "shell"; }
  [[nodiscard]] std::string moving_surface() const override { return "journal"; }
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> description(
      const film::FilmModel& /*model*/) const override {
    return {};  // clearance and shape are stated with the temperatures of the walls
  }
  [[nodiscard]] std::unique_ptr<GapKinematics> gap(const film::FilmModel& model,
                                                   bool moving_surface_deforms) const override {
    return std::make_unique<JournalGap>(model, moving_surface_deforms);
  }
  [[nodiscard]] std::unique_ptr<SteadyCoordinates> steady_coordinates(const film::FilmModel& model) const override {
    return std::make_unique<JournalCoordinates>(model);
  }
};

}  // namespace

std::shared_ptr<const BearingKind> journal_kind() {
  static const std::shared_ptr<const BearingKind> kind = std::make_shared<JournalKind>();
  return kind;
}

JournalCoordinates::JournalCoordinates(const film::FilmModel& model)
    : model_(model), surfaces_(model), force_rows_(ForceRows::Zero(4, 6)) {
  // F_x, F_y, M_y, -M_x: the moments that work on the tilts.
  force_rows_(0, 3) = force_rows_(1, 4) = force_rows_(2, 1) = 1;
  force_rows_(3, 0) = -1;
}

film::SurfaceMotion JournalCoordinates::surfaces(const OperatingPoint& point, const Coordinates& e) {
  return steady_surfaces(surfaces_, model_, point, e);
}

std::vector<film::MotionDirection> JournalCoordinates::directions(const Coordinates& e, Index first,
                                                                  Index count) const {
  std::vector<film::MotionDirection> result;
  for (Index k = first; k < first + count; ++k) {
    result.push_back(surfaces_.direction(static_cast<int>(k)));
    if (k > kEy || model_.supply.kind != film::SupplyKind::widest_gap || e.norm() <= kNearCentre * clearance(model_))
      continue;
    result.back().phi_supply = (k == kEx ? -e.y() : e.x()) / e.squaredNorm();
  }
  return result;
}

double JournalCoordinates::smallest_gap(const OperatingPoint& point, const Coordinates& e) {
  film::SurfaceMotion motion;
  surfaces_.set_clearance_change(point.growth, 0);
  surfaces_.evaluate(parameters_of(model_, point, e), motion);
  return surfaces_.smallest_gap();
}

double JournalCoordinates::scale(const OperatingPoint& point, const Coordinates& /*e*/) {
  return clearance(model_, point);
}

Coordinates JournalCoordinates::start(const OperatingPoint& point) { return ocvirk_position(model_, point); }

Coordinates JournalCoordinates::opened(const OperatingPoint& /*point*/, const Coordinates& e, int k) {
  return std::exp2(-k) * e;
}

// Each distance halves what is left of the clearance; surfaces that yield overlap beyond it by up to a few times what
// the load deforms them.
std::vector<double> JournalCoordinates::distances(const OperatingPoint& point, double depth) {
  const double c = clearance(model_, point), room = std::max(0.1, 1 - 0.5 * model_.L * point.tilt.norm() / c) * c;
  const bool is_smooth = model_.asperities.model == film::AsperityModel::none;
  std::vector<double> result;
  for (double gap = 0.5; gap > (is_smooth ? 1 : 0.1) * kLeastGap; gap /= 2) result.push_back((1 - gap) * room);
  depth += model_.compliance * point.load->norm() / (model_.R * model_.L);
  for (double fraction = 0.25; depth > 0 && fraction <= 8; fraction *= 2) result.push_back(room + fraction * depth);
  return result;
}

Coordinates JournalCoordinates::at(const OperatingPoint& /*point*/, double distance, double angle) {
  return distance * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

std::string JournalCoordinates::position_text(const OperatingPoint& point, const Coordinates& e) const {
  return fmt::format("eccentricity ratio {:.4f}", e.norm() / clearance(model_, point));
}

}  // namespace hersey::bearing
