#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <array>
#include <memory>
#include <vector>

#include "hersey/fem/reduction.h"
#include "hersey/mbd/elastic_body.h"

namespace hersey::mbd {

struct ModalWorkspace;

/// A body reduced to shapes: a material point at x moves to x + sum over a of q_a Phi_a(x) in the body's own axes,
/// which are those of frame 0. The first 6 (frames - 1) shapes are the static responses to a unit [rotation;
/// displacement] of frames 1, 2, ... with the others fixed; further ones are motions with all frames fixed. No shape
/// moves frame 0.
struct ModalBodyData {
  double mass = 0;                ///< [kg]
  std::vector<Pose> rest;         ///< rest pose of each frame in the body's axes; rest[0] is the identity
  Eigen::Matrix3Xd first_moment;  ///< integral of rho Y_a, Y_0 = x and Y_a = Phi_a, shape (3, 1 + shapes)
  /// Integrals of rho Y_a,p Y_b,r, component by component: second_moment[3 p + r](a, b), shape (1 + shapes)^2.
  std::array<Eigen::MatrixXd, 9> second_moment;
  /// Number of shapes for rotation and displacement of each frame but the first: 6, or 12 with the rotation matrix
  /// (theory manual eq. (flexible-bodies.22)).
  int shapes_per_frame = 6;
  Eigen::MatrixXd stiffness;      ///< shape (shapes, shapes)
  Eigen::MatrixXd damping;        ///< shape (shapes, shapes)
  Eigen::Matrix3Xd nodes;         ///< undeformed [m], shape (3, nodes)
  Eigen::MatrixXd displacements;  ///< displacements of the nodes for unit amplitudes, shape (3 nodes, shapes)
  /// Returns the number of shapes.
  [[nodiscard]] Eigen::Index shapes() const { return stiffness.rows(); }
};

/// Sets nodes and shapes, and the first and second moments of their mass.
/// @param nodal_mass  symmetric, shape (nodes, nodes), the same in every direction: M = nodal_mass (x) I3
/// @param x           nodes, shape (3, nodes)
/// @param shapes      displacements, shape (3 nodes, shapes), node after node
/// @cost O(nodes shapes^2)
void set_moments(ModalBodyData& data, const Eigen::SparseMatrix<double>& nodal_mass, const Eigen::Matrix3Xd& x,
                 const Eigen::MatrixXd& shapes);

/// Rayleigh damping: mass times M, of the shapes against the body's own axes, plus stiffness times K.
struct RayleighDamping {
  double mass = 0;       ///< [1/s]
  double stiffness = 0;  ///< [s]
};

/// Returns the data of a reduced mesh whose axes are those of its first frame. Shapes that move that frame are omitted,
/// since they are combinations of rigid motions and the other shapes. Internal shapes are scaled to a largest
/// displacement of 1, so that their coordinates are lengths (theory manual eq. (flexible-bodies.14)).
/// @param shapes  receives the displacements of all nodes in each shape, shape (3 nodes, shapes); may be null
[[nodiscard]] ModalBodyData modal_data(const fem::ReducedBody& reduced, const RayleighDamping& damping,
                                       Eigen::MatrixXd* shapes = nullptr);

/// The flexible body of small strain and large motion in the floating frame of its first frame, with every term of
/// inertia that the shapes have (theory manual eq. (flexible-bodies.1) to (flexible-bodies.7)).
/// @see Shabana (2013), Dynamics of Multibody Systems, ch. 5; Craig and Bampton (1968), AIAA J. 6, 1313.
class ModalBody : public ElasticBody {
 public:
  /// @pre the matrices have the shapes ModalBodyData says, and shapes >= shapes_per_frame (frames - 1).
  explicit ModalBody(ModalBodyData data);
  ~ModalBody() override;

  [[nodiscard]] int frame_count() const override { return static_cast<int>(data_.rest.size()); }
  [[nodiscard]] int coordinate_count() const override {
    return static_cast<int>(data_.shapes()) - data_.shapes_per_frame * (frame_count() - 1);
  }
  [[nodiscard]] Pose rest_pose(int i) const override { return data_.rest[static_cast<std::size_t>(i)]; }
  [[nodiscard]] double mass() const override { return data_.mass; }
  [[nodiscard]] Vector3 centre() const override { return data_.first_moment.col(0) / data_.mass; }
  void add_load(const NodalLoad& load) override;
  [[nodiscard]] int shape_count() const override { return static_cast<int>(data_.shapes()); }
  void find_shapes(const ElasticMotion& motion, bool want_tangent, ShapeMotion& shapes) override;
  void evaluate(const ElasticMotion& motion, bool want_tangent, ElasticResponse& response) override;
  [[nodiscard]] ElasticEnergy energy(const ElasticMotion& motion, const Vector3& gravity) override;

  /// Returns the amplitudes of all shapes, shape (shapes).
  [[nodiscard]] virtual Eigen::VectorXd amplitudes(const ElasticMotion& motion);
  /// Returns the displacements of all nodes in the body's axes, shape (3 nodes), from the `shapes` of modal_data.
  [[nodiscard]] virtual Eigen::VectorXd displacements(const ElasticMotion& motion, const Eigen::MatrixXd& shapes);
  [[nodiscard]] const ModalBodyData& data() const { return data_; }

 protected:
  using Workspace = ModalWorkspace;
  [[nodiscard]] Workspace& work() { return *work_; }
  /// Computes amplitudes and sums over shapes at a motion.
  virtual void gather(const ElasticMotion& motion, bool want_tangent);
  /// Adds the contribution of degrees of freedom beside the shapes to forces and derivatives of [frame 0; amplitudes].
  virtual void add_nodes(const ElasticMotion& motion, bool want_tangent) { (void)motion, (void)want_tangent; }
  void add_load_energies(const ElasticMotion& motion, ElasticEnergy& energy);
  /// Returns the magnitude of elastic forces caused by the round-off of poses.
  [[nodiscard]] const Eigen::VectorXd& round_off() const { return round_off_; }
  /// Adds forces of stiffness and damping on the amplitudes.
  virtual void add_elasticity(bool want_tangent);

 private:
  /// A nodal load on the shapes, theory manual eq. (flexible-bodies.23).
  struct ProjectedLoad {
    LoadAxes axes = LoadAxes::body;
    Vector3 force = Vector3::Zero();  ///< sum over nodes of f
    std::vector<Matrix3> moments;     ///< sums over nodes of Y_a f^T, Y_0 = x
  };
  [[nodiscard]] Eigen::VectorXd stiffness_at_size() const;
  void gather_amplitudes(const ElasticMotion& motion, bool want_tangent);
  void fill_transformations(bool want_tangent);
  void add_inertia(const ElasticFrame& base);
  void differentiate_inertia(const ElasticFrame& base);
  void add_momentum_share(const ElasticFrame& base, double dt);
  void add_loads(const ElasticMotion& motion, bool want_tangent);
  void project_load(const ProjectedLoad& load, const Pose& X_WB);
  void rotate_load(const ProjectedLoad& load, double value, const Matrix3& Q);
  void reduce_to_frames(bool want_tangent, ElasticResponse& response);

  ModalBodyData data_;
  Eigen::MatrixXd modal_mass_;
  Eigen::VectorXd round_off_;
  std::vector<ProjectedLoad> loads_;
  std::unique_ptr<Workspace> work_;
};

}  // namespace hersey::mbd
