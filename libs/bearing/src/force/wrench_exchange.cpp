#include "force/wrench_exchange.h"

#include <algorithm>

namespace hersey::bearing {
namespace {

// Steps solved as one system after an exchange that did not converge, before the exchange is tried again. A run in
// which the film damps more than inertia holds would otherwise reject every other step.
constexpr int kMonolithicSteps = 16;

}  // namespace

WrenchExchange::WrenchExchange(solver::Acceleration acceleration, double relaxation, Eigen::Index amplitudes,
                               double radius)
    : iteration_(acceleration, relaxation),
      radius_(radius),
      wrench_(Eigen::VectorXd::Zero(6 + amplitudes)),
      wrench_start_(wrench_) {}

void WrenchExchange::begin_step() {
  if (exchanges_ > 0 && !has_ended_) monolithic_steps_left_ = kMonolithicSteps;
  has_ended_ = false;
  wrench_ = wrench_start_;
  has_response_ = false;
  exchanges_ = 0;
  iteration_.begin_step();
}

double WrenchExchange::correct(const mbd::ForceResponse& answer) {
  Eigen::VectorXd size = Eigen::VectorXd::Ones(wrench_.size()), forces(wrench_.size());
  size.head<3>().setConstant(radius_);
  forces << answer.W_B_A, answer.Q;
  const Eigen::VectorXd x = wrench_.cwiseQuotient(size), image = forces.cwiseQuotient(size);
  const double largest = std::max(x.norm(), image.norm());
  wrench_ = iteration_.next(x, image).cwiseProduct(size);
  return largest > 0 ? (image - x).norm() / largest : 0;
}

void WrenchExchange::give(mbd::ForceResponse& response) {
  has_response_ = true;
  response.W_B_A = wrench_.head<6>();
  response.Q = wrench_.tail(wrench_.size() - 6);
}

void WrenchExchange::set(const mbd::ForceResponse& response) { wrench_ << response.W_B_A, response.Q; }

void WrenchExchange::accept_step() {
  wrench_start_ = wrench_;
  iteration_.begin_step();
  exchanges_ = 0;
  monolithic_steps_left_ = std::max(monolithic_steps_left_ - 1, 0);
}

void WrenchExchange::persist(Archive& archive) {
  archive.io("wrench", wrench_start_);
  archive.io("monolithic_steps_left", monolithic_steps_left_);
  if (archive.restores()) wrench_ = wrench_start_;
  const Archive::Group group(archive, "exchange");
  iteration_.persist(archive);
}

void WrenchExchange::persist_step(Archive& archive) {
  archive.io("has_response", has_response_);
  archive.io("has_ended", has_ended_);
}

}  // namespace hersey::bearing
