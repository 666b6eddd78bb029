#pragma once

#include <array>
#include <span>
#include <vector>

#include "balance/by_surfaces.h"
#include "balance/face_law.h"
#include "balance/gap_operator.h"
#include "balance/node.h"
#include "gap/feature_cover.h"
#include "gap/gap_interpolation.h"
#include "gap/grid_geometry.h"
#include "gap/pocket_relief.h"
#include "gap/rough_gap.h"
#include "hersey/film/film_domain.h"
#include "hersey/film/film_model.h"
#include "hersey/film/film_response.h"

namespace hersey::film {

/// A face between the control volumes of the nodes `a` and `b`; its flow counts positive from a to b.
struct Face {
  int a = 0, b = 0;
  double width = 0;            ///< across the flow [m]
  double length = 0;           ///< from a to b [m]
  double stretch = 1;          ///< factor of speeds along phi there [-]
  std::array<int, 4> slots{};  ///< indices of (a,a), (a,b), (b,a), (b,b) among the Jacobian's values
};

/// Flow that recirculates in the pockets under a flow tube.
struct PocketFlow {
  double recirculation = 0;  ///< power that recirculation dissipates [W]
  /// Contribution to the integral of h dp over the flow tube and its width [N], with derivatives by the thickness on
  /// the face, the mean of 1/mu, the drop of the walls' pressure, the speed past the pockets' steps and phi_journal.
  struct Moment {
    double value = 0, h = 0, fluidity = 0, drop = 0, past = 0, journal = 0;
  };
  Moment moment;
};

/// A control volume that the border of a cavity cuts, in a film without a fill fraction: the fraction of it that is
/// full (film.60, film.61), and its derivatives.
struct CavityBorder {
  int node = 0;
  int of = 0;  ///< node whose unknowns determine the border; differs from `node` only on an edge at p_cav
  double fraction = 0;
  double by_u = 0, by_h = 0;            ///< by u and film thickness at `of`
  double by_rate = 0, by_rotation = 0;  ///< by the two members of SlidingChange
  double by_line = 0;                   ///< by phi_supply [1/rad]
  std::array<int, 4> beside{};          ///< nodes around `of`; -1: none
  std::array<double, 4> by_beside{};    ///< by their u
};

/// Balance of oil (film.2) in every control volume, with the flows (film.1) over its faces, its Jacobian by u and its
/// derivative along any change of the surfaces. u [Pa] is the one unknown of a node: u >= 0 is a full film at p_cav +
/// u; u < 0 is a cavitated film, theta = 1 + u/fill_scale where it has a fill fraction (film.5).  The residual's rows
/// [m^3/s] are outflow plus storage in the film; u - u_given times a conductance on an edge at prescribed pressure; and
/// a blend of both beside the supply line and on features (film.17 to film.22).
class FlowBalance {
 public:
  explicit FlowBalance(const FilmModel& model);
  FlowBalance(const FlowBalance&) = delete;
  FlowBalance& operator=(const FlowBalance&) = delete;

  [[nodiscard]] const FilmModel& model() const { return model_; }
  [[nodiscard]] int size() const { return model_.grid.size(); }

  /// Makes evaluations compute FaceFlow::little also where the node upstream is full: for sweeps, which change fill
  /// fractions between evaluations.
  void always_evaluate_starved_flow() { expects_any_fill_ = true; }

  /// Evaluates nodes, flows and residual at `u`. Outside the domain none of them may be used.
  FilmDomain evaluate(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u);

  /// Computes the Jacobian's values at the state of the last evaluate(), in the order of the pattern.
  void assemble_jacobian();

  /// Derivative of the residual along a direction, at fixed u.
  /// @param port_flows  if asked for: that of the flows through features, as find_port_flows_along(), for less work
  void derivative(const MotionDirection& direction, Eigen::VectorXd& dr, Eigen::VectorXd* port_flows = nullptr) const;
  /// Gives an operator the derivatives by gap and rate at the state last evaluated. @pre restricted_ports().empty()
  void find_gap_operator(GapOperator& by_gap) const;
  [[nodiscard]] GapOperator gap_operator() const { return {interpolation_, prescribed_edge_nodes_}; }

  /// Change of the residual as flows accelerate at the rate at which they change with `du` (damper.6) [m^3 s].
  void inertia_residual(const Eigen::Ref<const Eigen::VectorXd>& du, double momentum_factor, Eigen::VectorXd& dr) const;

  /// Oil entering through each feature (film.22): as supply() and over_land(), summed [m^3/s], shape (features).
  void find_port_flows(Eigen::VectorXd& flow) const;
  /// Their derivatives by u, shape (n, features).
  void find_port_flows_by_u(Eigen::MatrixXd& by_u) const;
  /// Their derivatives along a direction, at fixed u, shape (features).
  void find_port_flows_along(const MotionDirection& direction, Eigen::VectorXd& change) const;

  /// A feature behind a restrictor. Its pressure is u at a node that it covers wholly, whose row is the balance of the
  /// oil through the restrictor (hydrostatic.1).
  struct RestrictedPort {
    int feature = 0;
    int node = 0;
    double u = 0;       ///< of the feature [Pa]
    double supply = 0;  ///< pressure before the restrictor above p_cav [Pa]
    /// True if u is a pressure; else the recess lacks oil.
    bool has_pressure = true;
    double by_supply = 1;  ///< d supply/d (pressure of the port) [-]
  };
  [[nodiscard]] const std::vector<RestrictedPort>& restricted_ports() const { return restricted_; }
  /// Derivatives by u of the rows of restricted ports, `rows` of shape (n, restricted), and of all other rows by u of
  /// the ports' nodes as the pressure of their features, `columns` of the same shape (hydrostatic.5). The pattern's
  /// values leave both out: there each feature has a given pressure.
  void find_restricted(Eigen::MatrixXd& rows, Eigen::MatrixXd& columns) const;
  /// Pressure in a feature above p_cav [Pa]: that of its supply, or behind its restrictor.
  [[nodiscard]] double feature_unknown(int feature) const { return feature_u_[static_cast<std::size_t>(feature)]; }
  /// Flow of the restrictor of a port [m^3/s] by the drop of pressure over it.
  [[nodiscard]] ValueAndSlope restrictor_flow(const RestrictedPort& port) const;

  /// Subtracts from a right-hand side the defect of the squeeze term over a time step: the control volume's area times
  /// the difference between the gap's rate at the end of the step and its mean rate over the step (film.15).
  void subtract_squeeze_defect(Eigen::VectorXd& rhs) const;
  /// Computes the oil balance of the time step whose state was last evaluated, with flows changed along `du`.
  void settle(const Eigen::VectorXd& du, StepOilBalance& oil) const;
  /// Sets the initial oil content; flows are undefined.
  void initialise_oil_balance(StepOilBalance& oil) const;

  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  /// Fraction of a control volume in which the film is cavitated (film.62) [-].
  [[nodiscard]] double cavitated_fraction(int node) const;
  /// Borders of cavities in a film without a fill fraction.
  [[nodiscard]] const std::vector<CavityBorder>& borders() const { return borders_; }
  [[nodiscard]] const std::vector<RoughGap>& rough_gaps() const { return rough_; }
  [[nodiscard]] const std::vector<Face>& faces() const { return faces_; }
  [[nodiscard]] const std::vector<FaceFlow>& flows() const { return flows_; }
  [[nodiscard]] const PocketFlow& pocket_flow(std::size_t flow_tube) const { return pocket_flows_[flow_tube]; }
  [[nodiscard]] double recirculation(
      std::size_t f) const {  ///< power that the oil recirculating in pockets dissipates [W]
    return flow_tube_of_[f] < 0 ? 0 : pocket_flows_[static_cast<std::size_t>(flow_tube_of_[f])].recirculation;
  }
  [[nodiscard]] const Eigen::VectorXd& residual() const { return residual_; }
  /// Outflow plus storage of every control volume. On boundary nodes it is the oil fed from outside.
  [[nodiscard]] const Eigen::VectorXd& balance() const { return balance_; }
  /// Index of the face from node (i, j) to the next along phi, and to the next along z. The last line of a patch has a
  /// face of no width from the node to itself.
  [[nodiscard]] std::size_t face_after(int i, int j) const { return static_cast<std::size_t>(model_.grid.index(i, j)); }
  [[nodiscard]] std::size_t face_above(int i, int j) const {
    return first_axial_face_ + static_cast<std::size_t>(i * (model_.grid.n_z - 1) + j);
  }
  /// Faces of a node to those before and after it along phi, then along z; -1: none.
  [[nodiscard]] std::array<int, 4> faces_around(int node) const;
  [[nodiscard]] double storage(int node) const;             ///< [m^3/s]
  [[nodiscard]] double storage_by_content(int node) const;  ///< its derivative by the oil's content [m^3/s]
  /// Gap that contains the oil of a control volume, mean depth of pockets included [m].
  [[nodiscard]] double oil_gap(int node) const { return cells_[node].gap + cells_[node].depth; }
  /// Derivatives of the thickness on face f by that at each of its nodes, and by its bend [-].
  [[nodiscard]] std::array<double, 2> thickness_weights(std::size_t f) const;
  [[nodiscard]] const PocketRelief& relief() const { return relief_; }
  [[nodiscard]] const SurfaceMotion& speeds() const { return speeds_; }  ///< without fields
  /// Velocity of the journal's surface relative to the shell's in a row of the grid [m/s].
  [[nodiscard]] Eigen::Vector2d slip(int j) const;
  [[nodiscard]] double largest_throughput() const { return largest_throughput_; }  ///< of a control volume [m^3/s]
  [[nodiscard]] double relative_residual() const;
  [[nodiscard]] int worst_node() const;
  [[nodiscard]] double area(int node) const { return area_[node]; }  ///< of the control volume [m^2]
  [[nodiscard]] const GridGeometry& geometry() const { return geometry_; }
  [[nodiscard]] double speed_phi() const { return speed_phi_; }
  /// True if a node lies on an edge of prescribed pressure, where its row prescribes u in place of a balance.
  [[nodiscard]] bool is_on_prescribed_edge(int node) const { return edges_[node].kind == EdgeNode::Kind::prescribed; }
  /// True if a node lies on an edge at p_cav of a film with a fill fraction: oil leaves freely, and its row is a
  /// balance.
  [[nodiscard]] bool is_on_open_edge(int node) const { return edges_[node].kind == EdgeNode::Kind::open; }
  /// True if a node lies on an edge with a seal: its balance includes what leaks there.
  [[nodiscard]] bool is_on_leaking_edge(int node) const { return edges_[node].kind == EdgeNode::Kind::leaking; }
  /// u at which an edge at p_cav is as full as its surroundings; -infinity where nothing comes in [Pa].
  [[nodiscard]] double ambient_unknown(int node) const { return edges_[node].ambient; }
  /// Oil that is given at this node: of a flow to the end of its patch, or by a layer on the journal [m^3/s].
  [[nodiscard]] double given_flow(int node) const { return edges_[node].flow + layer_flow(node); }
  [[nodiscard]] double layer_flow(int node) const;  ///< part of given_flow() that a layer brings (film.65) [m^3/s]
  [[nodiscard]] bool brings_layer(int node) const;  ///< true if a layer, however thin, comes in over this node's edge
  /// True on an edge at p_cav with oil outside: oil that comes in there fills the gap, whatever u is.
  [[nodiscard]] bool is_flooded(int node) const { return is_on_open_edge(node) && edges_[node].ambient == 0; }
  /// Returns the flow over the edge on which a node lies, of all flows over edges.
  template <class Flows>
  [[nodiscard]] double& flow_over_edge(Flows& flows, int node) const {
    if (edges_[node].of_patch) return flow_over_end(flows, node);
    return node % model_.grid.n_z == 0 ? flows.flow_left : flows.flow_right;
  }
  /// Adds the outflow at a node to the flow over its edge. At a corner between an open side and an open end the oil
  /// that comes along the side leaves over the end.
  template <class Flows>
  void add_flow_over_edge(Flows& flows, int node, double flow) const {
    const double along = edges_[node].is_corner ? flow_along_side(node) : 0;
    if (along != 0) flow_over_end(flows, node) += along;
    flow_over_edge(flows, node) += flow - along;
  }
  [[nodiscard]] double outflow(int node) const;  ///< oil leaving over the edge at this node [m^3/s]
  /// Fraction of outflow() that passes the end of a patch on which the node lies; the rest passes a side.
  [[nodiscard]] double end_fraction(int node) const;
  /// Outflow by the pressure that acts: in a film that bears tension it leaves out the inflow that tension draws
  /// (film.55) [m^3/s].
  [[nodiscard]] double acting_outflow(int node) const;
  /// Node whose u decides whether the film is full: on an edge at p_cav without a fill fraction the next one from the
  /// edge.
  [[nodiscard]] int phase_node(int node) const;
  [[nodiscard]] double supply(int node) const;  ///< oil entering from line or feature at this node [m^3/s]
  /// Part of the supply line's flow that crosses the face which the line cuts, from a to b, since the line feeds the
  /// film at its own position (film.21) [m^3/s].
  [[nodiscard]] double line_flow_through_face(std::size_t f) const;
  [[nodiscard]] double supply_dissipation(int node) const;  ///< power dissipated between the node and its supply [W]
  /// Fraction of supply_dissipation() that is dissipated in the control volume `other` on the other side of the line
  /// [-].
  struct DissipationSplit {
    int other = 0;
    double fraction = 0;
  };
  [[nodiscard]] DissipationSplit split_of_dissipation(int node) const;
  [[nodiscard]] int feature_at(int node) const;  ///< the feature that feeds this node; -1 for none
  /// Flow from a feature straight over the land between its end and the edge, beyond the flow in the flow tube from the
  /// next node (film.22); it is part of the feature's flow and of the outflow [m^3/s].
  [[nodiscard]] double over_land(int node) const;
  [[nodiscard]] double drop_over_land(int node) const;   ///< pressure drop over the land [Pa]
  [[nodiscard]] double power_over_land(int node) const;  ///< [W]
  /// True if the supply line or a feature contributes to a node's row.
  [[nodiscard]] bool is_on_supply(int node) const { return prescribed_index_[node] >= 0; }
  /// Fraction of a node's oil that a supply has mixed [-]: 1 on line and features, and on edges that they reach,
  /// although the edge has a pressure of its own there.
  [[nodiscard]] double supplied_fraction(int node) const;
  [[nodiscard]] bool is_supplied(int node) const { return supplied_at(node) != nullptr; }
  /// Feature that has mixed it; -1: the line, or none.
  [[nodiscard]] int supplied_by(int node) const;
  /// Weight of a node's own balance in its row: 1 away from line and features, 0 on them.
  [[nodiscard]] double balance_weight(int node) const;
  [[nodiscard]] double supply_conductance(
      int node) const;  ///< conductance between u and the supply in that row [m^3/(Pa s)]
  [[nodiscard]] double supply_unknown(int node) const;  ///< u of the supply [Pa]
  /// Fraction of missing oil, u < 0, that the supply provides [-]: 1 on line and features, 0 at the next node.
  [[nodiscard]] double draws(int node) const;
  /// True if the supply only provides what a node lacks and takes nothing from it.
  [[nodiscard]] bool only_fills(int node) const;
  /// Entrained flow from a node towards the supply line beside it.
  struct TowardsLine {
    bool counts = false;     ///< true if the line contributes to the node's row
    double full = 0;         ///< flow of a full gap, out of the node [m^3/s]
    bool from_node = false;  ///< the flow has the node's fill fraction; else the line's
    double strip =
        0;  ///< squeeze flow of the half of the distance nearer to the line, which counts as the line's [m^3/s]
  };
  [[nodiscard]] TowardsLine towards_line(int node) const;
  [[nodiscard]] bool is_cut(std::size_t f) const;                               ///< by the supply line
  [[nodiscard]] double edge_unknown(int node) const { return edges_[node].u; }  ///< u on an edge [Pa]
  /// Conductance of the seal at a node of a leaking edge [m^3/(Pa s)]; 0 elsewhere.
  [[nodiscard]] double seal_conductance(int node) const {
    return edges_[node].seal * nodes_[node].flow[1].value * nodes_[node].density;
  }

  [[nodiscard]] const std::vector<int>& column_start() const { return column_start_; }
  [[nodiscard]] const std::vector<int>& row_index() const { return row_index_; }
  [[nodiscard]] std::span<const double> values() const { return {values_.data(), row_index_.size()}; }
  [[nodiscard]] int diagonal_slot(int node) const { return diagonal_slot_[node]; }
  /// Derivatives of the flow over face f by u at its nodes.
  [[nodiscard]] std::array<double, 2> flow_by_u(std::size_t f) const;
  /// Conductance scale of the model, c^3/(12 mu0) (2 dz/dx + 2 dx/dz) [m^3/(Pa s)].
  [[nodiscard]] double conductance_scale() const { return D0_; }

 private:
  /// A node whose pressure the supply prescribes wholly or in part (film.21, film.22): its row is r = (1 - chi)
  /// (balance + slack) + tie (u - u_given). Beside the line the balance ends in the middle of the way to the line.
  struct PrescribedNode {
    int node = 0;
    double chi = 0;             ///< weight of the supply in the row [-]
    double chi_line = 0;        ///< d/d phi_supply [1/rad]
    double chi_journal = 0;     ///< d/d phi_journal [1/rad]
    double mixed_fraction = 0;  ///< fraction of the node's oil that the supply has mixed [-]
    double draws = 1;           ///< fraction of missing oil that the supply provides [-]
    double draws_line = 0;      ///< d/d phi_supply [1/rad]
    double draws_journal = 0;   ///< d/d phi_journal [1/rad]
    int feature = -1;           ///< index of the feature; -1: the line
    double u = 0;               ///< u of the supply [Pa]
    double by_port = 0;         ///< d u/d (u of the restricted port) [-]
    double by_supply = 0;       ///< d u/d (pressure of the port) [-]
    bool is_main = false;       ///< node of a restricted port
    double centrality = 0;      ///< feature: 1 - distance from its centre over half its size (CoveredNode) [-]
    int other = -1;             ///< line: the node on its other side
    /// Line: weights of h at this node, of h at `other` and of the bend of the gap in the thickness between node and
    /// line.
    double near = 1, far = 0, bend = 0;
    double near_line = 0, bend_line = 0;  ///< line: d/d phi_supply [1/rad]
    double conductance = 0;               ///< line: width/(12 length of the flow tube) [-]
    double distance = 0;                  ///< line: distance to it over the length of the flow tube [-]
    double distance_line = 0;             ///< d/d phi_supply [1/rad]
  };
  static constexpr double as_written = 1e-9;  ///< relative accuracy of a length in the model file
  /// A node on an edge with less than a cell of land between the edge and a feature's end.
  struct Land {
    int node = 0, inside = 0, feature = 0;
    double conductance = 0;  ///< of the land, in addition to that of the flow tube, per h^3/(12 mu) [-]
    double by_journal = 0;   ///< its derivative by phi_journal [1/rad]
    double u = 0;            ///< of the feature [Pa]
  };
  /// Interval around the node, measured from it, over which a feature's end faces it [m].
  struct LandInterval {
    int node = 0, inside = 0, feature = 0;
    double from = 0, to = 0;
    double from_journal = 0, to_journal = 0;  ///< derivatives by phi_journal [m/rad]
    double gain = 0;                          ///< 1/land - 1/flow tube [1/m]
    double u = 0;
  };
  /// Conductance between a prescribed node and its supply [m^3/(Pa s)], with derivatives.
  struct Tie {
    double k = 0, k_u = 0, k_g = 0;
    double k_u_other = 0, k_g_other = 0, k_bend = 0, k_line = 0, k_journal = 0;
    double k_rate = 0, k_rotation = 0;  ///< by the two members of SlidingChange
  };
  /// Position of a supply line that cuts the flow tubes between two columns of nodes.
  struct Line {
    bool cuts = false;
    int column = 0;       ///< column of nodes before it
    double fraction = 0;  ///< fraction of the distance to the next column [-]
    double by_phi = 0;    ///< d/d phi_supply [1/rad]
  };
  /// Gap that contains the oil of a control volume, with derivatives (film.14).
  struct Cell {
    double gap = 0, gap_h = 1, gap_excess = 1;            ///< [m]
    double depth = 0, depth_start = 0;                    ///< mean depth of pockets [m]
    double turning = 0;                                   ///< mean depth of the journal's pockets [m]
    double start = 0, start_slope = 1, start_excess = 1;  ///< gap from which the rate leads to the present one [m]
  };
  /// Properties of a node that its edge determines.
  struct EdgeNode {
    enum class Kind { none, wall, prescribed, open, leaking };
    Kind kind = Kind::none;
    bool of_patch = false;   ///< the edge is the end of a patch
    bool is_corner = false;  ///< a row's edge meets an open end of a patch
    int inside = 0;          ///< the next node from the edge
    double u = 0;            ///< prescribed unknown, or that of the pressure behind a seal [Pa]
    double ambient = 0;      ///< ambient_unknown() [Pa]
    double seal = 0;         ///< of a seal: flow per pressure and fluidity [m^3] (damper.1)
    double flow = 0;         ///< part of the flow given at the end of a patch [m^3/s]
    bool has_layer = false;  ///< a layer comes in here where the journal runs inwards
    double layer = 0;        ///< its thickness times the node's width [m^2]
  };

  /// Fraction of a full gap's entrained flow that crosses a face which the line cuts, with derivatives: by the fill
  /// fraction upstream, by thickness at both nodes, by bend, excess upstream and phi_journal.
  struct CutFaceFraction {
    double value = 1, theta = 0, h_a = 0, h_b = 0, bend = 0, excess = 0, journal = 0;
  };

  /// Oil that leaves through the seal of a leaking edge at a node, with derivatives by u, by the undeformed gap and by
  /// the two members of SlidingChange.
  struct SealFlow {
    double value = 0, u = 0, g = 0, rate = 0, rotation = 0;
  };
  /// Flow through the seal at a node of a leaking edge, driven by a pressure p above p_cav [Pa] (damper.1).
  [[nodiscard]] double seal_flow_at(int node, double p) const;
  [[nodiscard]] SealFlow seal_flow(int node) const;

  template <class Flows>
  [[nodiscard]] double& flow_over_end(Flows& flows, int node) const {
    return model_.grid.begins_patch(node / model_.grid.n_z) ? flows.flow_first : flows.flow_last;
  }
  /// Flow along the side of a patch to its corner [m^3/s].
  [[nodiscard]] double flow_along_side(int node) const;
  [[nodiscard]] double inward_speed(int node) const;       ///< of the journal's surface over an edge z = +-L/2 [m/s]
  [[nodiscard]] std::size_t face_at_edge(int node) const;  ///< face from the node to the next one from the edge
  /// Oil entering by the row of this node [m^3/s].
  [[nodiscard]] double supply_of_row(int node) const;
  void lay_edges();
  void spread_given_flows();
  void lay_faces();
  void lay_face_runs();
  void lay_pattern();
  void find_supply(const SurfaceMotion& motion);
  /// Returns the node of a restricted port; -1: none.
  [[nodiscard]] int main_node(const std::vector<CoveredNode>& covered) const;
  void keep_restricted_ports();
  void replace_restricted_rows();
  /// find_port_flows_along() by the change of the balances of all nodes.
  void find_port_flows_along(const MotionDirection& direction, const Eigen::VectorXd& balance,
                             Eigen::VectorXd& change) const;
  /// Sets the rows of restricted ports in a change of the residual.
  void find_restricted_along(const MotionDirection& direction, const Eigen::VectorXd& balance,
                             Eigen::VectorXd& dr) const;
  void prescribe_line(double phi);
  void find_strips(int feature, double phi, double u);
  void merge_land_intervals();
  void clear_lands();
  [[nodiscard]] const Land* land_at(int node) const;
  /// Conductance of the land at a node [m^3/(Pa s)] with its derivatives by phi_journal, and by u, gap and the two
  /// members of SlidingChange on the edge (0) and at the next node from it (1).
  struct LandTie {
    double k = 0, k_journal = 0;
    std::array<double, 2> k_u{}, k_g{}, k_rate{}, k_rotation{};
  };
  [[nodiscard]] LandTie tie_over_land(const Land& land) const;
  /// Outflow on an open edge that takes what the row of a supply beside it gives back, in place of slack().
  [[nodiscard]] bool returns_to_edge(int node) const;
  [[nodiscard]] static bool yields_to(const PrescribedNode& prescribed, const PrescribedNode& to);
  void prescribe(const PrescribedNode& prescribed, bool only_oil = false);
  [[nodiscard]] std::size_t line_face(const PrescribedNode& prescribed) const;
  [[nodiscard]] bool has_line_row(int node) const;
  [[nodiscard]] bool is_beside_line(int node) const;  ///< the line's other side has such a row, too
  [[nodiscard]] double line_balance(int node) const;
  void find_carried_fraction(std::size_t f, const FaceGap<double>& gap, const EntrainedFlow& carried);
  [[nodiscard]] CutFaceFraction fraction_towards_line(int node, const TowardsLine& t) const;
  [[nodiscard]] double line_fraction_along(const PrescribedNode& prescribed, const CutFaceFraction& fraction,
                                           const MotionDirection& direction, const GapChangeBesideLine& gap) const;
  [[nodiscard]] double thickness_towards_line(const PrescribedNode& prescribed) const;
  [[nodiscard]] FlowTubeGap gap_towards_line(const PrescribedNode& prescribed, double h) const;
  [[nodiscard]] ByGap carried_in_pockets(const PrescribedNode& prescribed) const;
  [[nodiscard]] double strip_area(
      const PrescribedNode& prescribed) const;  ///< of the half of the distance nearer to the line [m^2]
  void add_line_by_u(const PrescribedNode& prescribed);
  [[nodiscard]] double line_row_along(const PrescribedNode& prescribed, const MotionDirection& direction,
                                      const GapChangeBesideLine& gap) const;
  /// Change of a prescribed row but for that of its weighted balance.
  [[nodiscard]] double prescribed_along(const PrescribedNode& prescribed, const MotionDirection& direction,
                                        const GapChangeBesideLine& gap) const;
  /// Of the direction last given to balance_along().
  [[nodiscard]] GapChangeBesideLine gap_change_at(const PrescribedNode& prescribed,
                                                  const MotionDirection& direction) const;
  /// u - u_given [Pa] as it counts in the row, and its slope.
  [[nodiscard]] ValueAndSlope excess(const PrescribedNode& prescribed) const;
  [[nodiscard]] double draws_along(const PrescribedNode& prescribed, const MotionDirection& direction) const;
  /// Features of the model, each of which is a port; through one that is not fed flows nothing.
  [[nodiscard]] Eigen::Index port_count() const { return static_cast<Eigen::Index>(model_.features.size()); }
  /// Change of the pressure of a feature, which counts up to `u` above p_cav, with the pressure of its port.
  [[nodiscard]] double port_along(int feature, double u, const MotionDirection& direction) const;
  /// Change of what a row draws from its supply, with the pressure of its port [Pa].
  [[nodiscard]] double supply_along(const PrescribedNode& prescribed, const MotionDirection& direction) const;
  /// u of a feature whose supply has no oil [Pa]; 0 where supplies are full.
  [[nodiscard]] double lowest_supply(int feature) const;
  /// Change of the balances of all nodes with the surfaces, flows towards a supply line apart.
  void balance_along(const MotionDirection& direction, Eigen::VectorXd& db) const;
  void find_changes_by_surfaces() const;
  void find_prescribed_by_gap() const;
  void add_storage_along(const MotionDirection& direction, Eigen::VectorXd& dr) const;
  void find_flow_by_surfaces(std::size_t f, FlowsBySurfaces& by) const;
  /// Adds the changes of the flows over the faces of one kind, whose nodes lie `next` apart.
  void add_flows_along(const FlowsBySurfaces& by, Eigen::Index next, const MotionDirection& direction,
                       const Speeds& speeds, Eigen::VectorXd& dr) const;
  void add_sliding_along(Eigen::VectorXd& dr) const;
  [[nodiscard]] const SlidingChange& sliding_along(int node) const {
    return direction_sliding_[static_cast<std::size_t>(node % model_.grid.n_z)];
  }
  [[nodiscard]] int slot_to_other(const PrescribedNode& prescribed) const;
  /// Adds the change of what layers bring with the journal's speed.
  void bring_layers_along(double w_journal, Eigen::VectorXd& dr) const;
  void add_turning_pockets(const MotionDirection& direction, Eigen::VectorXd& dr) const;
  [[nodiscard]] double pocket_edge_speed(std::size_t f,
                                         const PocketFlowTube& flow_tube) const;  ///< of the edges of a pocket [m/s]
  /// Speed of a pocket's edges around the bearing, from the mean speed and the journal's. It is linear and serves for
  /// changes as well.
  [[nodiscard]] static double edge_speed_of(const PocketFlowTube& flow_tube, double mean, double journal) {
    if (!flow_tube.in_journal) return 0;
    return flow_tube.in_shell ? mean : journal;
  }
  /// True if oil crosses the edge of a pocket of the journal over face f.
  [[nodiscard]] bool oil_crosses_pocket_edge(std::size_t f) const;
  /// Derivatives by the speeds of the flow per width which the surfaces entrain from the control volume upstream of
  /// face f if it is full [m].
  [[nodiscard]] Speeds entrained_upstream(std::size_t f, int from) const;
  [[nodiscard]] const Node& upstream(std::size_t f) const {
    return nodes_[flows_[f].couette >= 0 ? faces_[f].a : faces_[f].b];
  }
  /// Change of a row's sliding with the surfaces' speeds.
  [[nodiscard]] SlidingChange change_of_sliding(const MotionDirection& direction, int j) const;
  [[nodiscard]] const PrescribedNode* prescribed_at(int node) const;
  [[nodiscard]] const PrescribedNode* supplied_at(int node) const;
  [[nodiscard]] Tie tie(const PrescribedNode& prescribed) const;
  [[nodiscard]] Tie tie_to_line(const PrescribedNode& prescribed) const;
  void take_history(const FilmHistory& history);
  void take_motion(const SurfaceMotion& motion);
  void take_unknowns(const Eigen::VectorXd& u);
  /// Evaluates the states of the nodes, and adds the storage in their control volumes to the balance.
  [[nodiscard]] FilmDomain evaluate_nodes(const SurfaceMotion& motion, const Eigen::VectorXd& u);
  /// Round-off of u on a line or groove at p_cav, where u = 0 [Pa].
  [[nodiscard]] double round_off_of_u() const { return 1e-9 * fill_scale(model_); }
  /// Speed at which the surfaces slide in a row of the grid, over that in P0 [-].
  [[nodiscard]] double sliding_fraction(int j) const;
  void find_borders();
  [[nodiscard]] CavityBorder cut_by_tension(int i, int j) const;
  [[nodiscard]] CavityBorder filled_by_pressure(int i, int j) const;
  void apply_border(const CavityBorder& border);
  void extend_borders_to_edges();
  [[nodiscard]] bool is_layered() const { return viscosity_.fluidity.size() != 0; }
  /// False where the gap that carries the oil is that between the surfaces.
  [[nodiscard]] bool has_rough_gaps() const { return !rough_law_.is_smooth() || is_layered(); }
  static void skew(double skew, double h, RoughGap& gap);
  void evaluate_cell(int node, const SurfaceMotion& motion);
  /// Consecutive faces between consecutive nodes.
  struct FaceRun {
    int face = 0, a = 0, b = 0, count = 0;
  };
  template <bool is_rough>
  class PackedFaces;
  /// Evaluates the flows over all faces and adds them to the balances.
  void add_faces();
  template <bool is_rough>
  void add_faces_of();
  template <bool is_rough>
  void add_face(int f);
  void add_flow(int f, double poiseuille, double entrained);
  /// The face, or several from the first on (face_law.h).
  template <class Number>
  [[nodiscard]] FaceShape<Number> shape_of(int first, bool is_axial) const;
  template <bool is_rough, class Number>
  [[nodiscard]] BesideFace<Number> beside_face(int first, bool is_axial) const;
  void deepen(std::size_t f, FaceGap<double>& gap);
  void add_oil_of_pockets(std::size_t f, int from, LittleOil<double>& oil) const;
  [[nodiscard]] double thickness_on(std::size_t f) const;
  [[nodiscard]] bool is_limited(std::size_t f) const;
  void replace_boundary_rows();
  [[nodiscard]] double slack(int node) const;
  [[nodiscard]] double outflow_of_row(int node) const;  ///< outflow without the flow over land
  [[nodiscard]] bool blocks_inflow(int node) const;     ///< on an edge at p_cav of prescribed pressure
  [[nodiscard]] double slack_u(int node) const;
  [[nodiscard]] double storage_u(int node) const;
  [[nodiscard]] double storage_h(int node) const;
  [[nodiscard]] double storage_g(int node) const;
  [[nodiscard]] double storage_excess(int node) const;
  [[nodiscard]] double storage_g_rate(int node) const;
  [[nodiscard]] double storage_excess_rate(int node) const;
  /// Moves oil in excess of full control volumes, or lacking in empty ones, on with the flow to nodes that can take it.
  void redistribute_surplus(const std::vector<char>& accepts_surplus, StepOilBalance& oil) const;
  void discharge_surplus(double rest, int node, const std::vector<char>& accepts_surplus, StepOilBalance& oil) const;
  double sweep_surplus(int j, double carry, const std::vector<char>& accepts_surplus, StepOilBalance& oil,
                       bool is_final_sweep) const;
  [[nodiscard]] double start_of(int node) const;  ///< film's gap at the start of the step, pockets apart [m]
  [[nodiscard]] double oil_shown(int node, double content) const;  ///< per area, with a fill fraction of 0 to 1 [m]
  [[nodiscard]] double pocket_rate(int node) const;                ///< rate of the mean depth in a steady film [m/s]
  [[nodiscard]] bool axial(std::size_t f) const { return f >= first_axial_face_; }
  /// 1/mu of pressure-driven flow at a node of face f, across it.
  [[nodiscard]] const Fluidity& flow_of(int node, std::size_t f) const { return nodes_[node].flow[axial(f) ? 1 : 0]; }
  /// Mean speed of both surfaces across face f [m/s], which entrains the oil.
  [[nodiscard]] double entrainment(std::size_t f) const { return axial(f) ? speed_z_ : faces_[f].stretch * speed_phi_; }
  [[nodiscard]] double half_slip(std::size_t f) const {
    return axial(f) ? half_slip_z_ : faces_[f].stretch * half_slip_phi_;
  }
  /// Changes of the speeds around the bearing, where a face does not stretch them, and along its axis.
  [[nodiscard]] static Speeds around_speeds(const MotionDirection& direction);
  [[nodiscard]] static Speeds axial_speeds(const MotionDirection& direction);
  /// Changes of the speeds across face f.
  [[nodiscard]] Speeds speeds_along(std::size_t f, const MotionDirection& direction) const {
    return axial(f) ? axial_speeds(direction) : around_speeds(direction) * faces_[f].stretch;
  }
  /// True if the oil's viscosity depends on the speed at which the surfaces slide.
  [[nodiscard]] bool has_sliding_viscosity() const {
    return !model_.lubricant.shear_thinning.is_newtonian() || model_.turbulence.counts();
  }
  /// Entrained flows over a face by the speeds of the surfaces, of a full gap and of little oil, without density and
  /// without swept volumes, which the step has fixed [m^2].
  struct CarriedBySpeeds {
    Speeds full, little;
  };
  [[nodiscard]] CarriedBySpeeds carried_by_speeds(std::size_t f) const;

  FilmModel model_;
  const CavitationLaw& cavitation_;
  CavitationScales scales_;
  NodeLaw law_;
  RoughGapLaw rough_law_;
  GridGeometry geometry_;
  double D0_ = 0, unit_conductance_ = 0;
  std::vector<EdgeNode> edges_;             ///< of every node
  std::vector<int> prescribed_edge_nodes_;  ///< nodes on edges of prescribed pressure
  std::vector<int> leaking_edge_nodes_;     ///< nodes on edges with a seal
  std::vector<double> area_;                ///< of the control volumes [m^2]
  std::vector<Face> faces_;
  std::vector<FaceRun> around_runs_, axial_runs_;
  std::size_t first_axial_face_ = 0;
  std::vector<int> column_start_, row_index_, diagonal_slot_;
  std::vector<std::array<int, 5>> row_slots_;  ///< slots of the entries of every balanced row

  std::vector<Node> nodes_;
  std::vector<RoughGap> rough_;
  std::vector<CavityBorder> borders_;
  std::vector<FaceFlow> flows_;
  std::vector<double> values_;  ///< one more than the pattern: rows without a balance scatter there
  Eigen::VectorXd residual_, balance_, throughput_, g_rate_, content_start_, w_start_, gap_start_, u_;
  LayeredViscosity viscosity_;
  GapInterpolation interpolation_;
  PocketRelief relief_;
  Eigen::VectorXd bends_, excesses_, rate_excesses_;  ///< bends of the gap, excesses of the gap and of its rate
  mutable Eigen::VectorXd direction_bends_, direction_excesses_, direction_rate_excesses_;
  mutable Eigen::VectorXd direction_balance_, direction_flow_;
  mutable BySurfaces by_surfaces_;
  mutable std::vector<SlidingChange> direction_sliding_;  ///< of the rows
  std::vector<Cell> cells_;
  std::vector<int> flow_tube_of_;         ///< pocket flow tube of every face; -1: none
  std::vector<PocketFlow> pocket_flows_;  ///< of the flow tubes
  Line line_;
  std::vector<CutFaceFraction> line_fractions_;  ///< of the faces that the line cuts, by their axial row
  SurfaceMotion speeds_;
  std::vector<Sliding> sliding_;  ///< of the rows
  std::vector<PrescribedNode> prescribed_;
  std::vector<int> prescribed_index_;                ///< index of every node in prescribed_; -1: none
  std::vector<PrescribedNode> supplied_edge_nodes_;  ///< nodes of a supply whose pressure an edge prescribes
  std::vector<int> edge_index_;                      ///< index of every node in supplied_edge_nodes_; -1: none
  std::vector<Land> lands_;
  std::vector<LandInterval> strips_;
  std::vector<int> land_index_;  ///< index of every node in lands_; -1: none
  std::vector<CoveredNode> covered_;
  std::vector<RestrictedPort> restricted_;
  std::vector<double> feature_u_;     ///< of every feature [Pa]
  bool freezes_deformation_ = false;  ///< the step starts with the deformation with which it ends
  double phi_start_ = 0;
  bool has_start_gap_ = false, uses_gap_difference_ = false, expects_any_fill_ = false;
  double dt_ = 0, speed_phi_ = 0, speed_z_ = 0, half_slip_phi_ = 0, half_slip_z_ = 0, largest_throughput_ = 0;
};

}  // namespace hersey::film
