#include "hersey/solver/second_order_history.h"

namespace hersey::solver {

using Eigen::VectorXd;

void SecondOrderHistory::start(const VectorXd& x) {
  x_ = x_start_ = x;
  v_ = vdot_ = v_start_ = vdot_start_ = a_ = VectorXd::Zero(x.size());
  last_dt_ = 0;
  predicted_ = false;
}

void SecondOrderHistory::predict(const Stage& stage) {
  if (predicted_) return;
  predicted_ = true;
  dt_ = stage.dt;
  parameters_ = stage.parameters;
  const auto& [alpha_m, alpha_f, gamma, beta] = parameters_;
  a_start_ = stage.fresh || last_dt_ == 0 ? vdot_start_ : vdot_start_ + (dt_ / last_dt_) * (a_ - vdot_start_);
  x_ = x_start_ + dt_ * v_start_ + (0.5 * dt_ * dt_) * a_start_;
  v_ = v_start_ + dt_ * a_start_;
  vdot_ = (a_start_ - alpha_f * vdot_start_) / (1 - alpha_f);
  x_predicted_ = x_;
}

void SecondOrderHistory::move(const Stage& stage, const VectorXd& dx) {
  x_ += stage.k * dx;
  v_ += stage.c * dx;
  vdot_ += stage.m * dx;
}

void SecondOrderHistory::accept() {
  if (predicted_) {
    a_ = a_start_ + (x_ - x_predicted_) / (parameters_.beta * dt_ * dt_);
    last_dt_ = dt_;
    predicted_ = false;
  }
  x_start_ = x_;
  v_start_ = v_;
  vdot_start_ = vdot_;
}

void SecondOrderHistory::persist(Archive& archive) {
  archive.io("x", x_start_);
  archive.io("v", v_start_);
  archive.io("vdot", vdot_start_);
  archive.io("a", a_);
  archive.io("last_dt", last_dt_);
  if (!archive.restores()) return;
  x_ = x_start_;
  v_ = v_start_;
  vdot_ = vdot_start_;
  predicted_ = false;
}

}  // namespace hersey::solver
