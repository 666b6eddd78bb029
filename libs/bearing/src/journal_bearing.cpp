#include "hersey/bearing/journal_bearing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "hersey/core/contract.h"

namespace hersey::bearing {
namespace {

// Below this share of the clearance the direction of the eccentricity, hence of the widest gap, is not differentiated.
constexpr double kDirectionFloor = 1e-6;

// exp(20) = 5e8: no oil, and far from overflow.
constexpr double kLargestExponent = 20;

// How many of the parameters act. The angles come last: that of the widest gap matters only where the supply follows
// it, the journal's only where it carries features or a shape of its own.
int acting_parameters(const film::FilmModel& model) {
  const auto is_journals = [](const auto& thing) { return thing.surface == film::Surface::journal; };
  const bool turns = std::any_of(model.features.begin(), model.features.end(), is_journals) ||
                     std::any_of(model.profiles.begin(), model.profiles.end(), is_journals);
  if (turns) return kParameterCount;
  return model.supply.kind == film::SupplyKind::widest_gap ? kSupplyAngle + 1 : kSupplyAngle;
}

}  // namespace

JournalBearing::JournalBearing(std::string name, const film::FilmModel& model, const BearingOptions& options)
    : name_(std::move(name)),
      options_(options),
      reynolds_(model, film::linear_solver_of(options.film.solver)),
      rigid_(model),
      directions_(static_cast<std::size_t>(acting_parameters(model))),
      interface_(options.acceleration, options.relaxation) {
  const int n = model.grid.size();
  u_ = u_start_ = du_ = Eigen::VectorXd::Zero(n);
  history_.theta = Eigen::VectorXd::Ones(n);
  history_.w = Eigen::VectorXd::Zero(n);
  history_start_ = observed_history_ = history_;
}

void JournalBearing::place(const mbd::RelativeMotion& motion) {
  kinematics_ = journal_kinematics(motion.X_AB, motion.V_AB_A, model().R, kDirectionFloor * model().c);
  rigid_.place(kinematics_.value, surfaces_);
  feed(motion.t);
  domain_error_.clear();
  // An elastic surface may be pushed beyond the undeformed one; rigid ones may not meet.
  const double gap = rigid_.smallest_gap();
  if (!std::isfinite(gap) || (model().compliance == 0 && gap <= 0)) report_contact();
}

void JournalBearing::feed(double t) {
  const auto& pressures = options_.feature_pressures;
  surfaces_.feature_pressure.resize(static_cast<Eigen::Index>(pressures.size()));
  for (std::size_t f = 0; f < pressures.size(); ++f) {
    surfaces_.feature_pressure[static_cast<Eigen::Index>(f)] = pressures[f]->value({&t, 1});
  }
}

void JournalBearing::report_contact() {
  domain_error_ =
      fmt::format("the journal touches the shell (smallest undeformed gap {:.4g} um, eccentricity ratio {:.4f})",
                  1e6 * rigid_.smallest_gap(), kinematics_.e().norm() / model().c);
}

// Pressures from a linear prediction may lie beyond any that a viscosity law means; and where the undeformed surfaces
// overlap, pressure alone holds them apart.
bool JournalBearing::is_sensible() const {
  const double largest = u_.maxCoeff();
  if (!std::isfinite(largest) || film::log_viscosity_ratio(model().lubricant, largest).value > kLargestExponent)
    return false;
  return rigid_.smallest_gap() > 0 || film::film_fields(model(), surfaces_, u_).h.minCoeff() > 0;
}

// The film of a freshly filled gap: first without memory of the deformation, then with the deformation it has.
void JournalBearing::fill_gap() {
  history_.dt = options_.initial_dt;
  history_.theta.setOnes();
  history_.w.setZero();
  history_.density.setOnes(u_.size());
  if (!is_sensible()) return report_contact();
  for (int pass = 0; pass < (model().compliance > 0 ? 2 : 1); ++pass) {
    const film::FilmSolveSummary summary = film::solve_film(reynolds_, surfaces_, history_, options_.film, u_);
    if (!summary.converged) {
      domain_error_ = "no film at the start: " + summary.message;
      return;
    }
    history_.w = film::film_fields(model(), surfaces_, u_).w;
  }
}

void JournalBearing::begin_step(const mbd::RelativeMotion& start, double dt) {
  const Vector3 x_axis = start.X_AB.R.col(0);
  rigid_.begin_step(std::atan2(x_axis.y(), x_axis.x()), dt);
  history_ = history_start_;
  history_.dt = dt;
  u_ = u_start_;
  linearised_ = false;
  iterations_ = 0;
  given_ = given_start_;
  answered_ = false;
  interface_.begin_step();
}

// u += du0 + U (s - s_last): the film's share of the Newton increment the bodies have just taken.
void JournalBearing::follow_surfaces() {
  if (!linearised_) return;
  ParameterVector ds = kinematics_.value - s_linearised_;
  for (const int angle : {kSupplyAngle, kRotation}) ds[angle] = std::remainder(ds[angle], 2 * std::numbers::pi);
  reynolds_.follow(ds.head(static_cast<Eigen::Index>(directions_.size())), du_);
  u_ = u_linearised_ + du_;
  if (!is_sensible()) u_ = u_linearised_;
}

Vector6 JournalBearing::condense_film() {
  for (std::size_t k = 0; k < directions_.size(); ++k) directions_[k] = rigid_.direction(static_cast<int>(k));
  Vector6 wrench;
  reynolds_.condense(directions_, wrench, wrench_ds_);
  return wrench;
}

Vector6 JournalBearing::incremented_wrench() {
  reynolds_.newton_increment(du_);
  return reynolds_.wrench_on_shell() + reynolds_.wrench_gradient(du_);
}

void JournalBearing::evaluate(const mbd::RelativeMotion& motion, bool want_tangent, mbd::ForceResponse& response) {
  place(motion);
  response.W_B_A.setZero();
  response.dW_dX.setZero();
  response.dW_dV.setZero();
  if (!domain_error_.empty()) return;
  if (motion.dt == 0) {
    observed_surfaces_ = surfaces_;
    fill_gap();
    if (!domain_error_.empty()) return;
    linearised_ = false;
    evaluate_monolithic(want_tangent, response);
    given_ = response.W_B_A;
  } else if (options_.coupling == Coupling::monolithic) {
    evaluate_monolithic(want_tangent, response);
  } else {
    evaluate_partitioned(response);
  }
}

void JournalBearing::evaluate_monolithic(bool want_tangent, mbd::ForceResponse& response) {
  follow_surfaces();
  if (!is_sensible()) return report_contact();
  reynolds_.linearise(surfaces_, history_, u_);
  internal_residual_ = reynolds_.relative_residual();
  s_linearised_ = kinematics_.value;
  u_linearised_ = u_;
  ++iterations_;

  // The journal takes the negative of what the shell takes.
  response.W_B_A = -(want_tangent ? condense_film() : incremented_wrench());
  linearised_ = want_tangent;
  if (!want_tangent) return;
  response.dW_dX.noalias() = -wrench_ds_ * kinematics_.d_dX.topRows(wrench_ds_.cols());
  response.dW_dV.noalias() = -wrench_ds_ * kinematics_.d_dV.topRows(wrench_ds_.cols());
}

void JournalBearing::evaluate_partitioned(mbd::ForceResponse& response) {
  // The first surfaces of a step are a prediction, no answer to any wrench yet.
  if (answered_) {
    if (!is_sensible()) return report_contact();
    const film::FilmSolveSummary summary = film::solve_film(reynolds_, surfaces_, history_, options_.film, u_);
    iterations_ += summary.iterations;
    if (!summary.converged) {
      domain_error_ = summary.message;
      return;
    }
    // One more Newton increment: the exchange would otherwise see the film's tolerance as a change of the wrench.
    reynolds_.linearise(surfaces_, history_, u_);
    const Vector6 wrench = incremented_wrench();
    u_ += du_;
    // Moments over the radius, so that all six entries are forces of comparable size.
    const Vector6 size = (Vector6() << Vector3::Constant(model().R), Vector3::Ones()).finished();
    const Vector6 x = given_.cwiseQuotient(size), image = -wrench.cwiseQuotient(size);
    const double largest = std::max(x.norm(), image.norm());
    internal_residual_ = largest > 0 ? (image - x).norm() / largest : 0;
    given_ = Vector6(interface_.next(x, image)).cwiseProduct(size);
  } else {
    internal_residual_ = 1;
  }
  answered_ = true;
  response.W_B_A = given_;
}

void JournalBearing::accept_step(const mbd::RelativeMotion& end) {
  place(end);
  const film::FilmFields fields = film::film_fields(model(), surfaces_, u_);
  observed_surfaces_ = surfaces_;
  observed_history_ = history_;
  observed_iterations_ = iterations_;
  history_start_.theta = fields.theta;
  history_start_.w = fields.w;
  history_start_.density = fields.density;
  u_start_ = u_;
  given_start_ = given_;
}

std::string JournalBearing::name_of_internal_residual() const {
  if (options_.coupling == Coupling::partitioned) {
    return "wrench exchanged between film and bodies";
  }
  const int node = reynolds_.worst_node(), n_z = model().grid.n_z;
  return fmt::format("film node ({}, {})", node / n_z, node % n_z);
}

BearingObservation JournalBearing::observe(const mbd::RelativeMotion& motion) const {
  const JournalKinematics k = journal_kinematics(motion.X_AB, motion.V_AB_A, model().R, kDirectionFloor * model().c);
  BearingObservation seen;
  seen.e = k.e();
  seen.tilt = k.tilt();
  seen.speed = motion.V_AB_A[2];
  seen.film = film::observe_film(model(), observed_surfaces_, observed_history_, seen.e, u_start_);
  seen.wrench_on_shell = seen.film.wrench_on_shell;
  seen.power_into_bodies = -seen.wrench_on_shell.dot(motion.V_AB_A);
  seen.film_iterations = observed_iterations_;
  return seen;
}

// What begin_step returns to. What the last step showed is not kept: it has been observed.
void JournalBearing::persist(Archive& archive) {
  archive.io("theta", history_start_.theta);
  archive.io("w", history_start_.w);
  archive.io("density", history_start_.density);
  archive.io("u", u_start_);
  archive.io("given_wrench", given_start_);
  {
    const Archive::Group group(archive, "exchange");
    interface_.persist(archive);
  }
  const Archive::Group group(archive, "film");
  reynolds_.persist(archive);
}

film::FilmFields JournalBearing::fields() const { return film::film_fields(model(), observed_surfaces_, u_start_); }

}  // namespace hersey::bearing
