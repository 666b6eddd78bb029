#include "force/wearing_surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "hersey/bearing/shapes_at_rest.h"
#include "hersey/core/contract.h"
#include "hersey/core/two_pi.h"
#include "hersey/film/film_surface.h"
#include "hersey/film/nodal_field.h"

namespace hersey::bearing {

using Eigen::VectorXd;

WearingSurfaces::WearingSurfaces(const film::FilmModel& model, const WearModel& wear,
                                 std::shared_ptr<CommonSurface> common)
    : model_(model),
      wear_(wear),
      area_(film::NodalField(model).weights()),
      around_(model.grid.n_z),
      ring_(wear.around == WearAround::local ? std::optional(JournalRing(model.grid)) : std::nullopt),
      common_(std::move(common)),
      worn_(VectorXd::Zero(model.grid.size() + (ring_ ? ring_->size() : model.grid.n_z))),
      start_(worn_),
      now_(worn_),
      rate_(worn_) {
  const film::Grid& grid = model.grid;
  const double whole = two_pi / covered_angle(grid);
  around_ = whole * Eigen::Map<const Eigen::MatrixXd>(area_.data(), grid.n_z, grid.n_phi).rowwise().sum();
  if (common_) common_->films.push_back(this);
}

// (wear.10)
VectorXd WearingSurfaces::worn() const {
  VectorXd depths = worn_;
  if (!common_) return depths;
  const Eigen::Index n = area_.size();
  auto moving = depths.tail(depths.size() - n);
  moving.setZero();
  for (const WearingSurfaces* film : common_->films) {
    HERSEY_REQUIRE(film->worn_.size() - film->area_.size() == moving.size(), "films of one surface have its rows");
    moving += film->of_moving(film->worn_);
  }
  return depths;
}

VectorXd WearingSurfaces::at_rows(const VectorXd& rows) const {
  VectorXd values(area_.size());
  for (Eigen::Index node = 0; node < values.size(); ++node) values[node] = rows[node % rows.size()];
  return values;
}

VectorXd WearingSurfaces::moving_at_nodes(const VectorXd& depths) const {
  return ring_ ? ring_->at_nodes(of_moving(depths)) : at_rows(of_moving(depths));
}

VectorXd WearingSurfaces::moving() const {
  const VectorXd depths = worn();
  if (!ring_) return at_rows(of_moving(depths));
  JournalRing unturned = *ring_;
  unturned.turn(0);
  return unturned.at_nodes(of_moving(depths));
}

void WearingSurfaces::begin_step(double dt) {
  const double part = over_ > 0 ? std::min(1.0, dt / over_) : 1.0;
  now_ = start_ + part * (worn() - start_);
  if (dt > 0)
    rate_ = (now_ - start_) / dt;
  else
    rate_.setZero();
}

void WearingSurfaces::accept_step(double dt) {
  start_ = now_;
  over_ = dt;
}

void WearingSurfaces::add_to(const mbd::RelativeMotion& /*motion*/, const GapKinematics::Turning& turning,
                             film::SurfaceMotion& surfaces) {
  if (ring_) ring_->turn(turning.angle);
  add_to_shell(now_.head(area_.size()), surfaces);
  add_to_journal(-moving_at_nodes(now_), surfaces);
  surfaces.g_rate += opening(rate_);
  if (ring_) surfaces.g_rate += turning.speed * ring_->by_angle(of_moving(now_));  // (wear.9)
  if (wear_.running_in) surfaces.roughness_ratio = roughness(now_);
}

void WearingSurfaces::add_turning(const GapKinematics::Turning& turning,
                                  std::vector<film::MotionDirection>& of_parameters) const {
  if (!ring_) return;
  film::MotionDirection &angle = of_parameters[static_cast<std::size_t>(turning.of_angle)],
                        &speed = of_parameters[static_cast<std::size_t>(turning.of_speed)];
  const VectorXd slope = ring_->by_angle(of_moving(now_));
  add_field(slope, angle.g);
  add_field(ring_->by_angle(of_moving(rate_)) + turning.speed * ring_->by_angle_twice(of_moving(now_)), angle.g_rate);
  add_field(slope / turning.radius, speed.g_rate);
}

// (wear.5)
VectorXd WearingSurfaces::roughness(const VectorXd& depths) const {
  const RunningIn& run_in = *wear_.running_in;
  return opening(depths).unaryExpr(
      [&](double worn) { return 1 + (1 - run_in.ratio) * std::expm1(-worn / run_in.depth); });
}

double WearingSurfaces::power(const VectorXd& normal_forces) const { return opening(rate_).dot(normal_forces); }

// (wear.3), (wear.8)
VectorXd WearingSurfaces::moving_depths(const VectorXd& work) const {
  const Eigen::Index n_z = around_.size();
  const VectorXd amounts = work.cwiseProduct(area_);
  VectorXd depths = ring_ ? ring_->collected(amounts) : amounts;
  const Eigen::Index lines = depths.size() / n_z;
  Eigen::Map<Eigen::MatrixXd> by_row(depths.data(), n_z, lines);
  if (!ring_) return by_row.rowwise().sum().cwiseQuotient(around_);
  by_row.array().colwise() /= around_.array() / static_cast<double>(lines);
  return depths;
}

void WearingSurfaces::wear_off(const VectorXd& p_asperity, const film::SurfaceMotion& surfaces, double dt) {
  const film::Grid& grid = model_.grid;
  VectorXd slid(p_asperity.size());
  for (int node = 0; node < grid.size(); ++node) {
    const double along = film::stretch(model_.surface, model_.R, model_.L * grid.z_over_L(node % grid.n_z));
    slid[node] = p_asperity[node] *
                 std::hypot(along * (surfaces.u_journal - surfaces.u_shell), surfaces.w_journal - surfaces.w_shell);
  }
  if (dt > 0) {
    const VectorXd work = 0.5 * wear_.acceleration * dt * (sliding_pressure_ + slid);  // [Pa m]
    worn_.head(area_.size()) += wear_.fixed.coefficient * work;
    worn_.tail(worn_.size() - area_.size()) += wear_.moving.coefficient * moving_depths(work);
    volume_of_cycle_ += (wear_.fixed.coefficient + wear_.moving.coefficient) * work.dot(area_);
    of_cycle_ += dt;
    constexpr double round_off_of_steps = 1e-9;  // of a cycle that ends with a step
    if (wear_.cycle > 0 && of_cycle_ >= (1 - round_off_of_steps) * wear_.cycle) {
      if (volume_of_last_ >= 0) error_ += 0.5 * std::abs(volume_of_cycle_ - volume_of_last_);
      volume_of_last_ = std::exchange(volume_of_cycle_, 0.0);
      of_cycle_ = 0;
    }
  }
  sliding_pressure_ = std::move(slid);
}

double WearingSurfaces::moving_depth() const {
  const VectorXd depths = worn();
  return ring_ ? ring_->at_lines(of_moving(depths)).maxCoeff() : of_moving(depths).maxCoeff();
}

double WearingSurfaces::moving_volume() const {
  const VectorXd depths = of_moving(worn_);
  const Eigen::Index lines = depths.size() / around_.size();
  return Eigen::Map<const Eigen::MatrixXd>(depths.data(), around_.size(), lines).rowwise().mean().dot(around_);
}

WearObservation WearingSurfaces::observe() const {
  const auto of_fixed = worn_.head(area_.size());
  WearObservation shown{.fixed_depth = of_fixed.maxCoeff(),
                        .fixed_volume = of_fixed.dot(area_),
                        .moving_depth = moving_depth(),
                        .moving_volume = moving_volume(),
                        .acceleration_error = error_};
  if (wear_.running_in) {
    const VectorXd ratio = roughness_ratio();
    shown.roughness_least = ratio.minCoeff(), shown.roughness_mean = ratio.dot(area_) / area_.sum();
  }
  if (sliding_pressure_.size() > 0)
    shown.rate = (wear_.fixed.coefficient + wear_.moving.coefficient) * sliding_pressure_.dot(area_);
  return shown;
}

std::string WearingSurfaces::failure() const {
  const auto worn_through = [](const char* surface, double depth, const SurfaceWear& wear) {
    return depth < wear.lining ? std::string()
                               : fmt::format("the {} surface has worn by {:.4g} um, all of its lining of {:.4g} um",
                                             surface, 1e6 * depth, 1e6 * wear.lining);
  };
  std::string fixed = worn_through("fixed", worn_.head(area_.size()).maxCoeff(), wear_.fixed);
  return !fixed.empty() ? fixed : worn_through("moving", moving_depth(), wear_.moving);
}

void WearingSurfaces::persist(Archive& archive) {
  const Archive::Group group(archive, "wear");
  archive.io("worn", worn_), archive.io("sliding_pressure", sliding_pressure_);
  archive.io("start", start_), archive.io("now", now_), archive.io("rate", rate_), archive.io("over", over_);
  archive.io("of_cycle", of_cycle_), archive.io("volume_of_cycle", volume_of_cycle_);
  archive.io("volume_of_last", volume_of_last_), archive.io("error", error_);
}

}  // namespace hersey::bearing
