#include "massless.h"

#include <cmath>
#include <set>

namespace hersey::solver {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Index = Equations::Index;

constexpr double kMasslessTolerance = 1e-10;  // of the terms that a motion balances
constexpr double kNoDamping = 1e-10;          // relative to that of the coordinates in a motion
constexpr int kMasslessIterations = 60, kMasslessHalvings = 12;
constexpr const char* kNoBalance = "no velocity balances the forces on motions without inertia";

class MasslessBalance {
 public:
  MasslessBalance(Equations& equations, const State& start, const MatrixXd& N)
      : equations_(equations), N_(N), here_(start), v_start_(start.v), y_(VectorXd::Zero(N.cols())) {
    here_.vdot.setZero();
    here_.lambda.setZero();
  }

  MasslessSummary run(State& state) {
    MasslessSummary summary;
    if (!evaluate()) return no_answer<MasslessSummary>(failure_);
    for (int iteration = 0; worst_ > kMasslessTolerance; ++iteration) {
      if (iteration == kMasslessIterations) return no_answer<MasslessSummary>(kNoBalance);
      if (summary.undetermined = undamped(); !summary.undetermined.empty()) return loose(summary);
      if (!advance()) return no_answer<MasslessSummary>(failure_);
    }
    // A vanishing force does not imply damping.
    if (summary.undetermined = undamped(); !summary.undetermined.empty()) return loose(summary);
    state.v = here_.v;
    summary.set_solved(true);
    return summary;
  }

 private:
  static MasslessSummary loose(MasslessSummary summary) {
    summary.fail("nothing holds some of the motions without inertia");
    return summary;
  }

  bool evaluate() {
    here_.v = v_start_ + N_ * y_;
    VectorXd residual, scale;
    Equations::SparseMatrix C;
    for (int i = 0;; ++i) {
      equations_.assemble(here_, {.dt = 0, .k = 0, .c = 1, .m = 0, .dq = {}}, residual, scale, &C);
      failure_ = equations_.domain_error();
      if (failure_.empty() && !residual.allFinite()) failure_ = "the forces are not numbers";
      if (failure_.empty() && i == kMasslessIterations)
        failure_ = equations_.name_of_internal_residual() + " is not solved";
      if (!failure_.empty()) return false;
      if (equations_.internal_residual() <= kMasslessTolerance) break;
    }
    const Index nv = equations_.nv();
    force_ = N_.transpose() * residual.head(nv);
    damping_ = N_.transpose() * MatrixXd(C).topLeftCorner(nv, nv) * N_;
    const VectorXd size = N_.cwiseAbs().transpose() * scale.head(nv);
    worst_ = 0;
    for (Index i = 0; i < force_.size(); ++i)
      if (force_[i] != 0) worst_ = std::max(worst_, std::abs(force_[i]) / size[i]);
    return true;
  }

  /// 1/sqrt of the damping of each motion, so that forces and torques compare.
  [[nodiscard]] VectorXd units() const {
    return damping_.diagonal().unaryExpr([](double c) { return c != 0 ? 1 / std::sqrt(std::abs(c)) : 1.0; });
  }

  /// Components of the motions that no damping resists.
  [[nodiscard]] std::vector<Index> undamped() const {
    const VectorXd unit = units();
    Eigen::FullPivLU<MatrixXd> lu(MatrixXd(unit.asDiagonal() * damping_ * unit.asDiagonal()));
    lu.setThreshold(kNoDamping);
    if (lu.isInvertible()) return {};
    const MatrixXd kernel = lu.kernel();
    const MatrixXd loose = (N_ * unit.asDiagonal() * kernel).cwiseAbs();
    std::set<Index> components;
    for (Index j = 0; j < loose.cols(); ++j)
      for (Index k = 0; k < loose.rows(); ++k)
        if (loose(k, j) > 0.1 * loose.col(j).maxCoeff()) components.insert(k);
    return {components.begin(), components.end()};
  }

  /// Newton's increment, halved until the equations accept it and the forces get smaller.
  bool advance() {
    const VectorXd before = y_, unit = units(), force = force_;
    const VectorXd dy = damping_.fullPivLu().solve(-force);
    double length = 1;
    for (int halvings = 0; halvings <= kMasslessHalvings; ++halvings, length /= 2) {
      y_ = before + length * dy;
      if (!evaluate()) continue;
      if (worst_ <= kMasslessTolerance || (unit.cwiseProduct(force_)).norm() < unit.cwiseProduct(force).norm())
        return true;
    }
    if (failure_.empty()) failure_ = kNoBalance;
    return false;
  }

  Equations& equations_;
  const MatrixXd& N_;
  State here_;
  VectorXd v_start_, y_, force_;
  MatrixXd damping_;
  double worst_ = 0;
  std::string failure_;
};

}  // namespace

MasslessSummary balance_massless(Equations& equations, State& state, const MatrixXd& N) {
  return MasslessBalance(equations, state, N).run(state);
}

}  // namespace hersey::solver
