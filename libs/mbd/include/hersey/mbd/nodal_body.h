#pragma once

#include <Eigen/Dense>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hersey/fem/elastic_body.h"
#include "hersey/fem/finite_strain.h"
#include "hersey/fem/reduction.h"
#include "hersey/mbd/modal_body.h"
#include "hersey/solver/second_order_history.h"

namespace hersey::mbd {

class NodalFactors;
struct NodalFactor;
struct NodalFields;

/// Measure of strain.
enum class Strain {
  small,  ///< linearly, in the body's axes
  finite  ///< strain of Green and Lagrange
};

/// The flexible body of small strain and large motion with a displacement of every node: over the static shapes of its
/// frames, as of a modal body, each node moves by w,
///
///     y(x) = x + sum q_a Psi_a(x) + w(x),    no frame moved by w.
///
/// Surfaces that carry films bring their film modes as further static shapes, whose amplitudes are coordinates of the
/// body; film pressures then do no work on w. The mechanism sees these and the frames alone: w is condensed, with the
/// matrix m M + c D + k K factorised once per step size, in the body's axes. What spin adds to that matrix, 2 c omega~
/// M and less, is left to iteration (theory manual eq. (flexible-bodies.15) to (flexible-bodies.20)).
///
/// With Strain::finite the elastic forces are those of Green and Lagrange's strain (St. Venant and Kirchhoff): strains
/// may be moderate, rotations against the body's axes large, and what is pulled gets stiffer. The static shapes of a
/// frame then move its nodes rigidly at any rotation (flexible-bodies.22). The matrix is that of the state at the start
/// of each step and is factorised in every step. At the start w is the static response to the inertia forces and the
/// weight at the start, at rest relative to the body's axes, as if the motion had been steady before. After
/// `start_undeformed` it is zero and is released.
class NodalBody final : public ModalBody {
 public:
  /// @param body     the whole mesh
  /// @param reduced  of that mesh with the same frames and film modes; its vibrations serve to draw the body, not to
  ///                 move it
  /// @pre frames but the first are rigid where `strain` is finite
  /// @throws InputError  stating the memory needed if the factor does not fit
  NodalBody(fem::ElasticBody body, const fem::ReducedBody& reduced, const RayleighDamping& damping,
            Strain strain = Strain::small);
  ~NodalBody() override;

  /// Starts with w = w' = 0: until the first step is accepted, instants (steps of length 0) are evaluated there, with
  /// w'' from the forces.
  void start_undeformed() { lets_go_ = true; }

  void add_load(const NodalLoad& load) override;
  void evaluate(const ElasticMotion& motion, bool want_tangent, ElasticResponse& response) override;
  [[nodiscard]] ElasticEnergy energy(const ElasticMotion& motion, const Vector3& gravity) override;
  void begin_step(const ElasticMotion& start, double dt) override;
  void accept_step(const ElasticMotion& end) override;
  [[nodiscard]] bool has_condensed_unknowns() const override { return true; }
  [[nodiscard]] bool needs_tangent() const override { return true; }
  [[nodiscard]] double internal_residual() const override { return internal_residual_; }
  [[nodiscard]] std::string name_of_internal_residual() const override { return "equations of the nodes"; }
  [[nodiscard]] std::string domain_error() const override { return failure_; }
  void persist(Archive& archive) override;

  /// Returns the amplitudes of the frames' shapes, then those of the vibration modes by projection of w.
  [[nodiscard]] Eigen::VectorXd amplitudes(const ElasticMotion& motion) override;
  [[nodiscard]] Eigen::VectorXd displacements(const ElasticMotion& motion, const Eigen::MatrixXd& shapes) override;

  /// Returns the number of solutions with the factorised matrix so far.
  [[nodiscard]] long solves() const;
  [[nodiscard]] const fem::ElasticBody& mesh_body() const { return body_; }

 protected:
  void gather(const ElasticMotion& motion, bool want_tangent) override;
  void add_nodes(const ElasticMotion& motion, bool want_tangent) override;
  void add_elasticity(bool want_tangent) override;

 private:
  /// Returns the static shapes, (3 nodes, shapes).
  [[nodiscard]] const Eigen::MatrixXd& Psi() const { return data().displacements; }
  [[nodiscard]] Eigen::Matrix3Xd loads_on_nodes(const ElasticMotion& motion,
                                                std::optional<LoadAxes> axes = std::nullopt) const;
  [[nodiscard]] Eigen::MatrixXd rotated_loads(const ElasticMotion& motion) const;
  [[nodiscard]] static Eigen::MatrixXd torque_of_loads(const Eigen::Matrix3Xd& loads,
                                                       const Eigen::MatrixXd& displacements);
  [[nodiscard]] bool follows(const ElasticMotion& motion) const;
  [[nodiscard]] solver::Stage stage_of(const ElasticMotion& motion) const;
  void settle(const ElasticMotion& motion);
  void iterate(const ElasticMotion& motion, const solver::Stage& stage);
  void update_fields();
  void update_accelerations(const ElasticFrame& base);
  [[nodiscard]] double unbalance(const ElasticMotion& motion);
  /// Integrals of rho X_r f_p of answers X and a field f: [r](column of X, p).
  using Moments = std::array<Eigen::MatrixX3d, 3>;
  [[nodiscard]] Eigen::VectorXd elastic_forces();
  void refresh_stiffness();
  void follow_frames(const solver::Stage& stage);
  [[nodiscard]] Eigen::VectorXd frame_amplitudes();
  void condense(const ElasticMotion& motion);
  [[nodiscard]] Eigen::MatrixXd forces_of_answers(const NodalFactor& factor, const solver::Stage& stage,
                                                  const ElasticFrame& base, const Moments& by_y, const Moments& by_rate,
                                                  const Moments& by_acc);
  void add_forces_on_nodes(const NodalFactor& factor, const ElasticFrame& base, const Moments& by_y,
                           const Moments& by_rate, const Eigen::MatrixXd& answer);

  fem::ElasticBody body_;
  RayleighDamping damping_;
  Strain strain_;
  Eigen::Matrix3Xd x_;             ///< undeformed nodes
  Eigen::RowVectorXd nodal_mass_;  ///< sums of the rows of m
  Eigen::Index frame_shapes_ = 0;  ///< static shapes of the frames; those of films follow
  Eigen::MatrixXd Psi_size_;       ///< absolute values of Psi
  Eigen::MatrixXd drawn_frames_;   ///< finite strains: static shapes of the frames for drawing
  Eigen::MatrixXd vibrations_;     ///< vibration modes for drawing, largest displacement 1
  Eigen::VectorXd vibration_mass_;
  std::array<Eigen::MatrixXd, 3> m_Psi_;  ///< m times each component of Psi, (nodes, shapes)
  /// Columns E of (flexible-bodies.19): 3 accelerations, 9 of rotation, M Psi; with finite strain K(u) Psi as well.
  Eigen::MatrixXd columns_;
  std::vector<NodalLoad> loads_;
  solver::SecondOrderHistory w_;
  std::unique_ptr<NodalFactors> factors_;
  std::unique_ptr<NodalFields> fields_;
  fem::FiniteStrain finite_;             ///< at the last displacement evaluated
  Eigen::VectorXd elastic_;              ///< forces of the material there
  Eigen::MatrixXd stiffness_of_shapes_;  ///< Psi^T K(u) Psi, of the state the matrix is of
  Eigen::VectorXd followed_;             ///< amplitudes of the frames at the last motion of the nodes with them
  Eigen::VectorXd r_, sizes_;            ///< residual forces on the nodes, and magnitudes of their terms
  bool at_rest_ = true;
  bool lets_go_ = false;       ///< the motion has not started yet; it starts from w = 0
  bool is_let_go_ = false;     ///< the present evaluation is at the instant of that start
  bool is_stale_ = true;       ///< finite strains: the matrix is not that of this step, or does not converge any more
  bool is_predicted_ = false;  ///< the step has just begun, with predicted frames and nodes
  double internal_residual_ = 0;
  std::string failure_;
};

}  // namespace hersey::mbd
