#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "feature_cover.h"
#include "grid_geometry.h"
#include "hersey/film/film_domain.h"
#include "hersey/film/reynolds.h"
#include "node.h"
#include "rough_gap.h"

namespace hersey::film {

/// A face between the control volumes of the nodes `a` and `b`; its flow counts positive from a to b.
struct Face {
  int a = 0, b = 0;
  double width = 0;            ///< across the flow [m]
  double length = 0;           ///< from a to b [m]
  std::array<int, 4> slots{};  ///< where (a,a), (a,b), (b,a), (b,b) stand among the Jacobian's values
};

/// The flow over a face, linearised (film.9): dq = K d(p_a - p_b) + q_h_a dh_a + q_h_b dh_b + q_fluidity d(1/mu) +
/// q_density d density + couette d theta_upwind. Flows are of mass over rho0.
struct FaceFlow {
  double K = 0;           ///< conductance [m^3/(Pa s)]
  double density = 1;     ///< rho/rho0 on the face [-]
  double q_density = 0;   ///< with it: the volume that flows [m^3/s]
  double q_h_a = 0;       ///< with the film thickness at a [m^2/s]
  double q_h_b = 0;       ///< with that at b [m^2/s]
  double q_fluidity = 0;  ///< with the face's 1/mu
  double couette = 0;     ///< entrained flow of a full gap [m^3/s]
};

/// Balance of oil in every control volume, its Jacobian in u and its derivative along any change of the surfaces.
///
/// Rows of the residual [m^3/s]: outflow plus storage in the film, u - u_given times a conductance on an edge at given
/// pressure, a blend of both beside the supply line and on features (film.10 to film.13, film.25).
class FlowBalance {
 public:
  explicit FlowBalance(const FilmModel& model);
  FlowBalance(const FlowBalance&) = delete;
  FlowBalance& operator=(const FlowBalance&) = delete;

  [[nodiscard]] const FilmModel& model() const { return model_; }
  [[nodiscard]] int size() const { return model_.grid.size(); }

  /// Nodes, flows and residual at `u`. Outside the domain nothing of them is to be used.
  FilmDomain evaluate(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u);

  /// Values of the Jacobian at the state of the last evaluate(), in the order of the pattern.
  void assemble_jacobian();

  void derivative(const MotionDirection& direction, Eigen::VectorXd& dr) const;

  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  [[nodiscard]] const RoughGaps& rough_gaps() const { return rough_; }  ///< empty for smooth surfaces
  [[nodiscard]] const std::vector<Face>& faces() const { return faces_; }
  [[nodiscard]] const std::vector<FaceFlow>& flows() const { return flows_; }
  [[nodiscard]] const Eigen::VectorXd& residual() const { return residual_; }
  /// Outflow plus storage of every control volume, boundary nodes included: there it is the oil fed from outside.
  [[nodiscard]] const Eigen::VectorXd& balance() const { return balance_; }
  /// The face from node (i, j) to the next around the bearing, and to the next along the axis.
  [[nodiscard]] std::size_t face_after(int i, int j) const { return static_cast<std::size_t>(model_.grid.index(i, j)); }
  [[nodiscard]] std::size_t face_above(int i, int j) const {
    return first_axial_face_ + static_cast<std::size_t>(i * (model_.grid.n_z - 1) + j);
  }
  [[nodiscard]] double storage(int node) const;             ///< [m^3/s]
  [[nodiscard]] double storage_by_content(int node) const;  ///< its derivative with the oil's content [m^3/s]
  /// The gap that holds oil at a node: the film thickness, between rough surfaces the mean of the local gap [m].
  [[nodiscard]] double oil_gap(int node) const { return rough_.empty() ? nodes_[node].h : rough_[node].mean; }
  [[nodiscard]] double largest_throughput() const { return largest_throughput_; }
  [[nodiscard]] double relative_residual() const;
  [[nodiscard]] int worst_node() const;
  [[nodiscard]] double area(int node) const { return area_[node]; }  ///< of the control volume [m^2]
  [[nodiscard]] const GridGeometry& geometry() const { return geometry_; }
  [[nodiscard]] double speed_phi() const { return speed_phi_; }
  [[nodiscard]] double speed_z() const { return speed_z_; }
  [[nodiscard]] bool edge_row(int j) const;  ///< an edge whose pressure is given: no balance there
  [[nodiscard]] bool open_row(int j) const { return open_edge(model_, j); }  ///< an edge at p_cav
  /// u at which an edge at p_cav is as full as what lies outside; -infinity where nothing comes in [Pa].
  [[nodiscard]] double ambient_unknown(int j) const { return j == 0 ? ambient_left_ : ambient_right_; }
  [[nodiscard]] double outflow(int node) const;  ///< oil leaving over the edge at this node [m^3/s]
  [[nodiscard]] double supply(int node) const;   ///< oil entering from line or feature at this node [m^3/s]
  [[nodiscard]] int feature_at(int node) const;  ///< the feature that feeds this node; -1 for none
  /// Share chi of the supply condition in a node's row: 0 away from line and features, 1 on them.
  [[nodiscard]] double supply_share(int node) const;
  [[nodiscard]] double supply_conductance(int node) const;  ///< what ties u to the supply in those rows [m^3/(Pa s)]
  [[nodiscard]] double supply_unknown(int node) const;      ///< u that the supply gives [Pa]
  [[nodiscard]] double edge_unknown(int j) const;           ///< u on an edge [Pa]

  [[nodiscard]] const std::vector<int>& column_start() const { return column_start_; }
  [[nodiscard]] const std::vector<int>& row_index() const { return row_index_; }
  [[nodiscard]] std::span<const double> values() const { return {values_.data(), row_index_.size()}; }
  [[nodiscard]] int diagonal_slot(int node) const { return diagonal_slot_[node]; }
  /// Conductance scale of the model, c^3/(12 mu0) (2 dz/dx + 2 dx/dz) [m^3/(Pa s)].
  [[nodiscard]] double conductance_scale() const { return D0_; }

 private:
  /// A node whose row the supply holds wholly or in part.
  struct HeldNode {
    int node = 0;
    double chi = 0;          ///< share of the condition [-]
    double chi_line = 0;     ///< with phi_supply [1/rad]
    double chi_journal = 0;  ///< with phi_journal [1/rad]
    int feature = -1;        ///< -1: the line
    double u = 0;            ///< given [Pa]
  };
  /// What ties a held node to its u, with derivatives.
  struct Tie {
    double k = 0, k_u = 0, k_g = 0;
  };

  void lay_faces();
  void lay_pattern();
  void find_supply(const SurfaceMotion& motion);
  void hold_line(double phi);
  void hold(const HeldNode& held);
  [[nodiscard]] const HeldNode* held_at(int node) const;
  [[nodiscard]] Tie tie(const HeldNode& held) const;
  void take_history(const FilmHistory& history);
  [[nodiscard]] FilmDomain evaluate_nodes(const SurfaceMotion& motion, const Eigen::VectorXd& u);
  void add_face(std::size_t f);
  void add_rough_face(std::size_t f);
  void add_flow(std::size_t f, double theta);
  void replace_boundary_rows();
  [[nodiscard]] double slack(int node) const;
  [[nodiscard]] double slack_u(int node) const;
  [[nodiscard]] double storage_u(int node) const;
  [[nodiscard]] double storage_by_start(int node) const;
  [[nodiscard]] double storage_h(int node) const;
  [[nodiscard]] double storage_g(int node) const;
  [[nodiscard]] double storage_g_rate(int node) const;
  [[nodiscard]] bool axial(std::size_t f) const { return f >= first_axial_face_; }
  /// Mean speed of both surfaces across face f [m/s]: the oil they carry along.
  [[nodiscard]] double entrainment(std::size_t f) const { return axial(f) ? speed_z_ : speed_phi_; }
  /// Flow over face f per density, fill fraction and unit of the speeds' mean and of half their difference [m^2].
  [[nodiscard]] double carrying_area(std::size_t f, double speed, double half_slip) const;

  FilmModel model_;
  NodeLaw law_;
  std::optional<RoughGapLaw> rough_law_;
  GridGeometry geometry_;
  double D0_ = 0, unit_conductance_ = 0;
  double ambient_left_ = 0, ambient_right_ = 0;
  std::vector<double> area_;  ///< of the control volumes [m^2]
  std::vector<Face> faces_;
  std::size_t first_axial_face_ = 0;
  std::vector<int> column_start_, row_index_, diagonal_slot_;
  std::vector<std::array<int, 5>> row_slots_;  ///< of every balanced row the slots of its entries

  std::vector<Node> nodes_;
  RoughGaps rough_;
  std::vector<FaceFlow> flows_;
  std::vector<double> values_;  ///< one more than the pattern: rows without a balance scatter there
  Eigen::VectorXd residual_, balance_, throughput_, g_rate_, content_start_, w_start_, u_;
  std::vector<ValueAndSlope> mean_start_;  ///< rough surfaces: the mean gap the step starts from
  std::vector<HeldNode> held_;
  std::vector<int> held_index_;  ///< of every node its place in held_, -1 for none
  std::vector<CoveredNode> covered_;
  bool liner_rests_ = false;  ///< the step starts with the deformation it ends with
  double dt_ = 0, speed_phi_ = 0, speed_z_ = 0, half_slip_phi_ = 0, half_slip_z_ = 0, largest_throughput_ = 0;
};

}  // namespace hersey::film
