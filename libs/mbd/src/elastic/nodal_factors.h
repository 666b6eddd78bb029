#pragma once

#include <Eigen/Dense>
#include <array>
#include <list>
#include <string>

#include "hersey/fem/constrained_stiffness.h"
#include "hersey/fem/elastic_body.h"
#include "hersey/fem/reduction.h"
#include "hersey/mbd/modal_body.h"

namespace hersey::mbd {

/// Columns of (flexible-bodies.19) before M Psi: 3 accelerations, 9 of rotation.
inline constexpr Eigen::Index kInertiaColumns = 12;

/// One factor, and what its answers X = (m M + c D + k K)^-1 E to columns E mean to the frames.
struct NodalFactor {
  double shift = 0;
  double scale = 1;  ///< m M + c D + k K = scale (K - shift M)
  fem::ConstrainedStiffness matrix;
  Eigen::MatrixXd X;                   ///< (3 n, columns)
  Eigen::MatrixXd W;                   ///< E^T X, symmetric
  std::array<Eigen::MatrixXd, 3> m_X;  ///< m times each component of X, (n, columns)
  /// X_p^T m X_r and X_p^T m Psi_r of components p and r, at 3 p + r.
  std::array<Eigen::MatrixXd, 9> answers, shapes;
};

/// Factors of m M + c D + k K of a mesh that no frame moves, for the few step sizes in use.
class NodalFactors {
 public:
  /// @param body     outlives the factors
  /// @param columns  forces E whose answers X = (m M + c D + k K)^-1 E matter, (3 n, columns)
  /// @param shapes   of the frames, (3 n, shapes)
  NodalFactors(const fem::ElasticBody& body, fem::FrameSupports supports, const RayleighDamping& damping,
               const Eigen::MatrixXd& columns, const Eigen::MatrixXd& shapes);

  /// The factor for a stage with k = 1; null, with `message`, if it does not fit into memory.
  [[nodiscard]] const NodalFactor* of(const solver::Stage& stage, std::string& message);

  /// Takes another stiffness of the same pattern: factors are made anew.
  void restiffen(const Eigen::SparseMatrix<double>& K);

  /// (m M + c D + k K)^-1 f.
  [[nodiscard]] Eigen::VectorXd solve(const NodalFactor& factor, const Eigen::VectorXd& f);

  /// Removes from `f` the reactions of the frames: forces on fixed nodes and constraint forces of averaging frames.
  void leave_to_frames(Eigen::VectorXd& f) const;

  /// Saves or restores the step sizes of the factors if their matrix is constant: a step uses the factor of a nearly
  /// equal step size, so that the round-off of solutions depends on previous steps. Restoring factorises them again.
  void persist(Archive& archive);

  [[nodiscard]] long solves() const { return solves_; }

 private:
  [[nodiscard]] bool factorise(NodalFactor& factor, double shift, double scale, std::string& message);
  [[nodiscard]] bool add(double shift, double scale, std::string& message);
  void make_room();
  void describe(NodalFactor& factor) const;

  const fem::ElasticBody& body_;
  fem::FrameSupports supports_;
  RayleighDamping damping_;
  const Eigen::MatrixXd &columns_, &shapes_;
  Eigen::MatrixXd bearing_;         ///< (C C^T)^-1
  Eigen::SparseMatrix<double> K_;   ///< stiffness that replaces that of the body, if set
  bool is_stale_ = false;           ///< K_ is newer than the factors
  std::list<NodalFactor> factors_;  ///< the last used first
  long solves_ = 0;
};

}  // namespace hersey::mbd
