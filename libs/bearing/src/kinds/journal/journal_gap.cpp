#include "hersey/bearing/journal_gap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "hersey/bearing/clearance.h"
#include "hersey/bearing/journal_bearing.h"

namespace hersey::bearing {
namespace {

// Below this fraction of the clearance the direction of the eccentricity, hence of the widest gap, is not
// differentiated.
constexpr double direction_floor = 1e-6;

// Eccentricity over the clearance from which a step can follow the widest gap: nearer to the centre it goes round by
// half a turn for next to no motion. A journal that leaves the centre at its start is followed.
constexpr double all_but_centred = 1e-2;

constexpr double degrees_per_radian = 180 / std::numbers::pi;

// How many of the parameters act. The angles come last: that of the widest gap matters only where the supply follows
// it, the journal's only where it carries features or a shape of its own.
Eigen::Index acting_parameters(const film::FilmModel& model, bool journal_deforms) {
  const auto is_journals = [](const auto& thing) { return thing.surface == film::Surface::journal; };
  const bool turns = std::any_of(model.features.begin(), model.features.end(), is_journals) ||
                     std::any_of(model.profiles.begin(), model.profiles.end(), is_journals);
  if (turns || journal_deforms) return kParameterCount;
  return model.supply.kind == film::SupplyKind::widest_gap ? kSupplyAngle + 1 : kSupplyAngle;
}

}  // namespace

JournalGap::JournalGap(const film::FilmModel& model, bool journal_deforms)
    : R_(model.R), L_(model.L), c_(clearance(model)), surfaces_(model) {
  parameters_ = Eigen::VectorXd::Zero(acting_parameters(model, journal_deforms));
  d_dX_ = d_dV_ = Jacobian::Zero(parameters_.size(), 6);
}

void JournalGap::begin_step(const mbd::RelativeMotion& start) {
  fixed_supply_.reset();
  if (is_near_centre_ && is_aligned(start.X_AB))
    fixed_supply_ = journal_kinematics(start.X_AB, start.V_AB_A, R_, direction_floor * c_).value[kSupplyAngle];
}

void JournalGap::end_step(const mbd::RelativeMotion& end) {
  is_near_centre_ = is_aligned(end.X_AB) && position(end).ratio() < all_but_centred;
}

void JournalGap::persist(Archive& archive) {
  archive.io("is_near_centre", is_near_centre_), archive.io("held_supply", fixed_supply_);
}

std::string JournalGap::evaluate(const mbd::RelativeMotion& motion, film::SurfaceMotion& surfaces) {
  if (!is_aligned(motion.X_AB)) {
    return fmt::format("the surfaces do not face each other: the journal's z-axis stands at {:.0f} deg to the shell's",
                       std::acos(std::abs(motion.X_AB.R(2, 2))) * degrees_per_radian);
  }
  kinematics_ = journal_kinematics(motion.X_AB, motion.V_AB_A, R_, direction_floor * c_);
  if (fixed_supply_ && motion.dt > 0) {
    kinematics_.value[kSupplyAngle] = *fixed_supply_;
    kinematics_.d_dX.row(kSupplyAngle).setZero();
  }
  surfaces_.set_clearance_change(growth_, growth_rate_);
  surfaces_.evaluate(kinematics_.value, surfaces);
  parameters_ = kinematics_.value.head(parameters_.size());
  d_dX_ = kinematics_.d_dX.topRows(parameters_.size());
  d_dV_ = kinematics_.d_dV.topRows(parameters_.size());
  return {};
}

const film::MotionDirection& JournalGap::direction(Index parameter) const {
  return surfaces_.direction(static_cast<int>(parameter));
}

bool JournalGap::is_angle(Index parameter) const { return parameter == kSupplyAngle || parameter == kRotation; }

std::string JournalGap::position_text() const {
  const std::string text = fmt::format("eccentricity ratio {:.4f}", kinematics_.e().norm() / (c_ + growth_));
  const double tilt = kinematics_.tilt().norm();
  // A tilt that closes the gap at the edges of a concentric journal.
  if (tilt * L_ / 2 <= c_ + growth_) return text;
  return text + fmt::format(", its axis {:.3g} deg off the bore's", std::atan(tilt) * degrees_per_radian);
}

GapKinematics::Turning JournalGap::turning() const {
  return {.angle = kinematics_.value[kRotation],
          .speed = kinematics_.value[kJournalSpeed] / R_,
          .radius = R_,
          .of_angle = kRotation,
          .of_speed = kJournalSpeed};
}

GapPosition JournalGap::position(const mbd::RelativeMotion& motion) const {
  const JournalKinematics k = journal_kinematics(motion.X_AB, motion.V_AB_A, R_, direction_floor * c_);
  return {.e = k.e(), .tilt = k.tilt(), .speed = motion.V_AB_A[2], .relative = k.e() / (c_ + growth_)};
}

Eigen::VectorXd JournalGap::relative_shift(const Pose& before, const Pose& after) const {
  return (after.r - before.r).head<2>() / c_;
}

JournalBearing::JournalBearing(std::string name, const film::FilmModel& model, const BearingOptions& options)
    : FilmForce(std::move(name), model, std::make_unique<JournalGap>(model, options.journal_surface != nullptr),
                options) {}

}  // namespace hersey::bearing
