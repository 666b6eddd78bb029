#pragma once

#include <Eigen/Dense>
#include <functional>
#include <vector>

#include "hersey/core/archive.h"

namespace hersey::solver {

/// Correction of the exchanged quantities in a fixed-point iteration.
enum class Acceleration {
  constant,      ///< x + omega (F(x) - x), omega fixed
  aitken,        ///< omega from the last two residuals (Kuettler and Wall 2008)
  quasi_newton,  ///< least-squares fit of the interface Jacobian to the steps taken (IQN-ILS, Degroote et al. 2009)
};

/// Differences of previous iterations that `quasi_newton` keeps.
struct ChangesKept {
  std::size_t most = 24;  ///< largest number kept over the steps; twice the six components of a bearing's wrench for a
                          ///< pair of bearings
  double noise = 1e-8;    ///< expected accuracy of an image relative to its magnitude; smaller changes are not kept
};

/// Accelerated fixed-point iteration x = F(x) (theory manual, (bearing.16)). One object per coupled system.
class FixedPointIteration {
 public:
  /// @param relaxation  omega of the first correction, with `constant` of all corrections; in (0, 1].
  FixedPointIteration(Acceleration acceleration, double relaxation, ChangesKept kept = {});

  /// Begins a new time step: the last residual is discarded, the differences of the previous step are kept.
  void begin_step();

  /// Sets the relaxation of the part of the residual that lies outside the span of the known changes, for
  /// `quasi_newton`; initially 1. If F amplifies this part strongly, a small value keeps it small until its change is
  /// known.
  void set_relaxation_of_unknown(double relaxation) { relaxation_of_unknown_ = relaxation; }

  /// Returns the next x; `image` is F(x). All entries should be of comparable magnitude.
  [[nodiscard]] Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& image);

  /// Initialises the differences with those of a similar system, such as one on another grid, converted by `transfer`.
  void learn_from(const FixedPointIteration& other,
                  const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& transfer);

  /// Saves or restores the history.
  void persist(Archive& archive);

 private:
  [[nodiscard]] Eigen::VectorXd aitken(const Eigen::VectorXd& x, const Eigen::VectorXd& residual);
  [[nodiscard]] Eigen::VectorXd quasi_newton(const Eigen::VectorXd& image, const Eigen::VectorXd& residual) const;
  void remember(const Eigen::VectorXd& residual, const Eigen::VectorXd& image);

  Acceleration acceleration_;
  double relaxation_;
  ChangesKept kept_;
  double omega_;
  double relaxation_of_unknown_ = 1;
  bool has_last_ = false;
  Eigen::VectorXd last_residual_, last_image_;
  std::vector<Eigen::VectorXd> residual_changes_, image_changes_;  // newest first
};

}  // namespace hersey::solver
