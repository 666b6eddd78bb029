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

/// What `quasi_newton` keeps of the steps taken.
struct ChangesKept {
  std::size_t most = 24;  ///< over the steps; twice the six components of a bearing's wrench for a pair of bearings
  double noise = 1e-8;    ///< accuracy to be expected of an image, relative to its size: smaller changes are not kept
};

/// Fixed-point iteration x = F(x) with a memory (theory manual, (bearing.16)). One object per coupled system.
class FixedPointIteration {
 public:
  /// @param relaxation  omega of the first correction, and of all of them in `constant`; in (0, 1].
  FixedPointIteration(Acceleration acceleration, double relaxation, ChangesKept kept = {});

  /// A new time step begins: residuals of the last one are no longer neighbours, its differences still are.
  void begin_step();

  /// Of a residual's part that no known change resembles, `quasi_newton` goes this share of the way from now on, at
  /// first all of it: where F answers it with one many times as large, a small share keeps it small until it is known.
  void set_share_of_unknown(double share) { share_of_unknown_ = share; }

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
  ChangesKept kept_;
  double omega_;
  double share_of_unknown_ = 1;
  bool has_last_ = false;
  Eigen::VectorXd last_residual_, last_image_;
  std::vector<Eigen::VectorXd> residual_changes_, image_changes_;  // newest first
};

}  // namespace hersey::solver
