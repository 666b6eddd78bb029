#include "kinds/journal/journal_coordinates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hersey/bearing/bearing_kind.h"
#include "hersey/bearing/journal_gap.h"
#include "hersey/bearing/steady_surfaces.h"
#include "kinds/journal/short_bearing.h"

namespace hersey::bearing {
namespace {

// Eccentricity over the clearance below which no gap is the widest.
constexpr double kNearCentre = 1e-6;

// A journal that no arc stops moves by so many clearances at most.
constexpr double kMostRoom = 4;

// A gap of this fraction of the clearance counts as none.
constexpr double kLeastGap = 3e-3;

class JournalKind final : public BearingKind {
 public:
  [[nodiscard]] std::string name() const override { return "journal"; }
  [[nodiscard]] bool has_axis() const override { return true; }
  [[nodiscard]] std::string fixed_surface() const override { return "shell"; }
  [[nodiscard]] std::string moving_surface() const override { return "journal"; }
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> description(
      const film::FilmModel& model) const override {
    std::vector<std::pair<std::string, std::string>>
        rows;  // clearance and shape are stated with the walls' temperatures
    const film::Arcs* bore = film::arcs_of(model);
    if (bore == nullptr) return rows;
    constexpr double kDegrees = 180 / std::numbers::pi;
    for (const film::Arc& arc : bore->arcs) {
      const double c_b = clearance(model) + arc.extra_clearance, c_p = c_b + arc.offset;
      rows.emplace_back(
          "arc " + arc.name,
          fmt::format("from {:.5g} to {:.5g} deg, clearance {:.4g} um where it is nearest, at {:.5g} deg, "
                      "preload {:.4g}",
                      kDegrees * arc.from, kDegrees * arc.to, 1e6 * c_b, kDegrees * arc.thinnest, 1 - c_b / c_p));
    }
    return rows;
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

// Each node of an arc is reached where the motion towards it equals the gap of a central journal.
double JournalCoordinates::room_towards(const OperatingPoint& point, double angle) {
  const film::Grid& grid = model_.grid;
  if (grid.closes()) return 1;
  const Eigen::VectorXd g = surfaces(point, Coordinates::Zero(2)).g;
  const double c = clearance(model_, point);
  double room = kMostRoom;
  for (int i = 0; i < grid.n_phi; ++i) {
    const double towards = std::cos(grid.phi(i) - angle) * c;
    if (towards > 0) room = std::min(room, g.segment(grid.index(i, 0), grid.n_z).minCoeff() / towards);
  }
  return room;
}

// The bore's equilibrium, as far on its way to the nearest arc as it is to the bore there.
Coordinates JournalCoordinates::start(const OperatingPoint& point) {
  const Eigen::Vector2d e = ocvirk_position(model_, point);
  return room_towards(point, std::atan2(e.y(), e.x())) * e;
}

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

Coordinates JournalCoordinates::at(const OperatingPoint& point, double distance, double angle) {
  return room_towards(point, angle) * distance * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

std::string JournalCoordinates::position_text(const OperatingPoint& point, const Coordinates& e) const {
  return fmt::format("eccentricity ratio {:.4f}", e.norm() / clearance(model_, point));
}

}  // namespace hersey::bearing
