#pragma once

#include <array>
#include <vector>

#include "balance/flow_balance.h"
#include "balance/node.h"
#include "gap/grid_geometry.h"
#include "gap/rough_gap.h"
#include "hersey/core/spatial.h"
#include "hersey/film/film_model.h"
#include "hersey/film/film_response.h"

namespace hersey::film {

/// The film's wrench on the shell at the grid's origin, [moment; force] in grid axes, by origin, with its derivatives
/// (theory manual, film.48 to film.52).
class FilmWrench {
 public:
  explicit FilmWrench(const FilmModel& model);

  /// Sums the tractions of all nodes; with `want_gradient` also their derivatives.
  /// @param balance  whose nodes and faces have been evaluated.
  void evaluate(const FlowBalance& balance, const SurfaceMotion& motion, bool want_gradient);

  [[nodiscard]] const Vector6& total() const { return total_; }
  [[nodiscard]] const Vector6& pressure() const { return pressure_; }
  [[nodiscard]] const Vector6& shear() const { return shear_; }        ///< of the film; its force is 0 for torque_only
  [[nodiscard]] const Vector6& asperity() const { return asperity_; }  ///< contact pressure and boundary friction

  /// Boundary friction's power per contact pressure and area in a row of the grid [m/s].
  [[nodiscard]] double friction_power_per_contact(int j) const {
    const Row& row = rows_[static_cast<std::size_t>(j)];
    return row.friction.dot(row.slip);
  }

  /// Factor of Couette shear at a node, below 1 where features have depth [-].
  [[nodiscard]] double relief_factor(int node) const { return relief_.empty() ? 1 : relief_[node].value; }

  /// d total / du at fixed surfaces, times du.
  [[nodiscard]] Vector6 change_by_u(const Eigen::Ref<const Eigen::VectorXd>& du) const { return by_u_ * du; }
  /// d total / d(direction) at fixed u.
  [[nodiscard]] Vector6 along(const MotionDirection& direction) const;
  /// d total / d(gap) at fixed u, shape (6, n).
  void find_by_gap(Eigen::Matrix<double, 6, Eigen::Dynamic>& by) const;
  /// What is added to it where the shell's surface opens the gap.
  [[nodiscard]] const Eigen::Matrix<double, 6, Eigen::Dynamic>& by_shell_opening() const;
  [[nodiscard]] const Eigen::Matrix<double, 6, Eigen::Dynamic>& gradient_u() const { return by_u_; }
  /// Difference of shear() with the other CavitatedShear, all else being the same.
  [[nodiscard]] Vector6 more_of_other_shear(const FlowBalance& balance) const;
  /// Forces that push the surfaces apart at each node.
  [[nodiscard]] const NormalForces& normal() const { return normal_; }

 private:
  /// Wrenches of unit tractions at one node; the last two also as the film's shear counts.
  struct Basis : UnitTractions {
    Vector6 shear_along, shear_across;
  };
  [[nodiscard]] Basis basis(int i, int j) const;
  [[nodiscard]] Basis with_shear(const UnitTractions& unit) const;
  /// A derivative of a nodal field by differences: sum of weight * field[node].
  struct Stencil {
    std::array<int, 3> node{};
    std::array<double, 3> weight{};

    /// Returns the slope of the pressure on the walls [Pa/m].
    [[nodiscard]] double of_wall(const std::vector<Node>& nodes) const {
      return weight[0] * nodes[node[0]].wall + weight[1] * nodes[node[1]].wall + weight[2] * nodes[node[2]].wall;
    }
  };
  /// Shear on the shell at one node (film.49, film.46): couette . slip - half_gap . grad p, index 0 along phi, 1 along
  /// z.
  struct Shear {
    Eigen::Vector2d couette, couette_u, couette_h;  ///< [Pa s/m] and slopes at given film thickness and at given u
    Eigen::Vector2d couette_rate;                   ///< with the logarithm of the sliding speed [Pa s/m]
    Eigen::Vector2d half_gap, half_gap_h;           ///< [m]
  };
  [[nodiscard]] static Shear shear_of(const Node& node, const RoughGap& rough, const ValueAndSlope& relief);
  /// Sums over nodes.
  struct Sums {
    Vector6 pressure = Vector6::Zero(), shear = Vector6::Zero(), asperity = Vector6::Zero();
    Vector6 by_journal = Vector6::Zero();
    Eigen::Matrix<double, 6, 2> by_slip = Eigen::Matrix<double, 6, 2>::Zero();
  };
  template <class Surface>
  void add_nodes(const Surface& surface, const FlowBalance& balance, bool want_gradient);
  void add_node(const FlowBalance& balance, const Basis& b, int i, int j, bool want_gradient, Sums& sums);
  /// Adds the derivatives by u of the pressure's slope, of which the film's shear has `drag` per unit along `traction`.
  void add_slope_by_u(const std::vector<Node>& nodes, const Stencil& slope, double drag, const Vector6& traction);
  void lay_stencils();
  [[nodiscard]] Stencil slope_phi(int i, int j) const;
  [[nodiscard]] Stencil slope_z(int node, int j) const;
  void take_relief(const FlowBalance& balance);
  void push_on_pocket_walls(const FlowBalance& balance, bool want_gradient);
  [[nodiscard]] Vector6 pushes_along(const MotionDirection& direction) const;
  void cut_off(const std::vector<Node>& nodes, bool want_gradient);
  void add_borders(const FlowBalance& balance);
  void push_on_slopes(const std::vector<Node>& nodes, bool want_gradient);
  void set_speeds(const SurfaceMotion& motion);

  FilmModel model_;
  GridGeometry geometry_;
  GapInterpolation interpolation_;
  std::vector<GridLine> lines_;
  Vector6 shear_counts_;             ///< 1 for entries of a wrench in which the film's shear counts, else 0
  std::vector<Stencil> phi_slopes_;  ///< of every line, between lines and at unit stretch
  std::vector<Stencil> z_slopes_;    ///< of every row, between rows
  Vector6 total_, pressure_, shear_, asperity_;
  NormalForces normal_;
  /// Contribution of the walls of the pockets in a flow tube, with its derivatives.
  struct WallPush {
    std::size_t face = 0;
    int row = 0;        ///< of the grid
    Vector6 direction;  ///< of a unit of PocketFlow::Moment
    double by_bend = 0, by_past = 0;
    double by_rate = 0, by_rotation = 0;  ///< with the two members of SlidingChange
    bool in_journal = false;
  };
  std::vector<WallPush> pushes_;
  Vector6 by_journal_;                  ///< by phi_journal, of rotating pockets
  Vector6 by_supply_;                   ///< by phi_supply, of borders of cavities beside the line
  std::vector<double> relief_journal_;  ///< of the factor below [1/rad]
  std::vector<ValueAndSlope> relief_;   ///< factor of Couette shear where features have depth [-, 1/m]; empty: 1
  Eigen::Matrix<double, 6, Eigen::Dynamic> by_u_, by_g_, by_opening_;
  Eigen::VectorXd opening_;              ///< displacement of the shell outwards from its cylinder [m]; empty: none
  Eigen::Matrix<double, 6, 2> by_slip_;  ///< by the journal's speed relative to the shell, along phi at R and along z
  /// Quantities of a row of the grid, on which the surfaces have one speed.
  struct Row {
    double stretch = 1;             ///< of that speed along phi [-]
    Eigen::Vector2d slip;           ///< that speed [m/s]
    Eigen::Vector2d rate_slip;      ///< derivative of its logarithm [s/m]
    Eigen::Vector2d friction;       ///< boundary friction per contact pressure on the shell [-]
    Eigen::Matrix2d friction_slip;  ///< its derivative by slip [s/m]
  };
  std::vector<Row> rows_;
};

}  // namespace hersey::film
