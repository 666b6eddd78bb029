#pragma once

#include <Eigen/Dense>
#include <functional>
#include <vector>

#include "hersey/core/archive.h"

namespace hersey::solver {

/// How a fixed-point iteration corrects what it exchanges.
enum class Acceleration {
  constant,      ///< x + omega (F(x) - x), omega fixed
  aitken,        ///< omega from the last two residuals (Kuettler and Wall 2008)
  quasi_newton,  ///< least-squares fit of the interface Jacobian to the steps taken (IQN-ILS, Degroote et al. 2009)
};

/// Fixed-point iteration x = F(x) with a memory (theory manual, (bearing.16)). One object per coupled system.
class FixedPointIteration {
 public:
  /// @param relaxation  omega of the first correction, and of all of them in `constant`; in (0, 1].
  FixedPointIteration(Acceleration acceleration, double relaxation);

  /// A new time step begins: residuals of the last one are no longer neighbours, its differences still are.
  void begin_step();

  /// The next x after F(x) came out as `image`. All entries should be of comparable size.
  [[nodiscard]] Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& image);

  /// Begins with the changes that a like system has shown, such as one on another grid, carried over by `transfer`.
  void learn_from(const FixedPointIteration& other,
                  const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& transfer);

  /// What it remembers.
  void persist(Archive& archive);

 private:
  [[nodiscard]] Eigen::VectorXd aitken(const Eigen::VectorXd& x, const Eigen::VectorXd& residual);
  [[nodiscard]] Eigen::VectorXd quasi_newton(const Eigen::VectorXd& image, const Eigen::VectorXd& residual) const;
  void remember(const Eigen::VectorXd& residual, const Eigen::VectorXd& image);

  Acceleration acceleration_;
  double relaxation_;
  double omega_;
  bool has_last_ = false;
  Eigen::VectorXd last_residual_, last_image_;
  std::vector<Eigen::VectorXd> residual_changes_, image_changes_;  // newest first
};

}  // namespace hersey::solver
