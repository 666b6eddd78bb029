#include "tree/drive_motion.h"

#include <algorithm>
#include <cmath>

#include "hersey/core/settable_function.h"
#include "tree/quadrature.h"

namespace hersey::mbd {
namespace {

/// base + s(t) (f(t) - base), s a quintic from 0 to 1 whose first two derivatives vanish at both ends.
class RampedFunction final : public ScalarFunction {
 public:
  RampedFunction(std::shared_ptr<const ScalarFunction> f, double base, double start, double duration)
      : f_(std::move(f)), base_(base), start_(start), duration_(duration) {}

  [[nodiscard]] double value(std::span<const double> t) const override {
    return base_ + blend(t[0]).s * (f_->value(t) - base_);
  }
  void gradient(std::span<const double> t, std::span<double> gradient) const override {
    const Blend b = blend(t[0]);
    f_->gradient(t, gradient);
    gradient[0] = b.ds * (f_->value(t) - base_) + b.s * gradient[0];
  }
  [[nodiscard]] double second_derivative(std::span<const double> t) const override {
    const Blend b = blend(t[0]);
    double slope = 0;
    f_->gradient(t, {&slope, 1});
    return b.dds * (f_->value(t) - base_) + 2 * b.ds * slope + b.s * f_->second_derivative(t);
  }

 private:
  struct Blend {
    double s, ds, dds;
  };
  [[nodiscard]] Blend blend(double t) const {
    const double x = std::clamp((t - start_) / duration_, 0.0, 1.0), T = duration_;
    return {x * x * x * (10 + x * (6 * x - 15)), 30 * x * x * (1 - x) * (1 - x) / T,
            60 * x * (1 - x) * (1 - 2 * x) / (T * T)};
  }

  std::shared_ptr<const ScalarFunction> f_;
  double base_, start_, duration_;
};

std::shared_ptr<const ScalarFunction> ramped(const DriveSpec& spec, double initial) {
  if (spec.ramp <= 0) return spec.function;
  const double base = spec.kind == DriveSpec::Kind::position ? initial : 0.0;
  return std::make_shared<RampedFunction>(spec.function, base, spec.start, spec.ramp);
}

}  // namespace

DriveMotion::DriveMotion(const DriveSpec& spec, double initial, double initial_rate)
    : kind_(spec.kind),
      function_(ramped(spec, initial)),
      constant_(spec.kind == DriveSpec::Kind::speed &&
                dynamic_cast<const ConstantFunction*>(now(function_.get())) != nullptr),
      settable_(dynamic_cast<const SettableFunction*>(function_.get())),
      initial_(initial),
      anchor_position_(initial),
      anchor_rate_(initial_rate) {}

double DriveMotion::position(double t) const {
  const double span = t - anchor_time_;
  switch (kind_) {
    case DriveSpec::Kind::position:
      return value(t);
    case DriveSpec::Kind::speed:
      if (counts_from_start()) return initial_ + value(t) * t;
      return anchor_position_ + integrate([&](double s) { return value(s); }, anchor_time_, t);
    case DriveSpec::Kind::acceleration:
      return anchor_position_ + anchor_rate_ * span +
             integrate([&](double s) { return (t - s) * value(s); }, anchor_time_, t);
  }
  return 0;
}

double DriveMotion::velocity(double t) const {
  if (kind_ == DriveSpec::Kind::position) return slope(t);
  if (kind_ == DriveSpec::Kind::speed) return value(t);
  return anchor_rate_ + integrate([&](double s) { return value(s); }, anchor_time_, t);
}

double DriveMotion::acceleration(double t) const {
  if (kind_ == DriveSpec::Kind::position) return function_->second_derivative({&t, 1});
  return kind_ == DriveSpec::Kind::speed ? slope(t) : value(t);
}

bool DriveMotion::counts_from_start() const { return constant_ && !(settable_ != nullptr && settable_->is_set()); }

double DriveMotion::value(double t) const { return function_->value({&t, 1}); }

double DriveMotion::slope(double t) const {
  double slope = 0;
  function_->gradient({&t, 1}, {&slope, 1});
  return slope;
}

void DriveMotion::anchor(double t) {
  if (kind_ == DriveSpec::Kind::position || t == anchor_time_) return;
  if (constant_ && settable_ == nullptr) return;
  const double rate = kind_ == DriveSpec::Kind::acceleration ? velocity(t) : anchor_rate_;
  anchor_position_ = position(t);
  anchor_rate_ = rate;
  anchor_time_ = t;
  // An input that has been set once is not integrated from the start again.
  if (!counts_from_start()) constant_ = false;
}

void DriveMotion::persist(Archive& archive) {
  archive.io("constant", constant_);
  archive.io("time", anchor_time_);
  archive.io("position", anchor_position_);
  archive.io("rate", anchor_rate_);
}

}  // namespace hersey::mbd
