#pragma once

#include <Eigen/SparseCore>
#include <functional>
#include <string>
#include <vector>

#include "hersey/fem/element_point.h"
#include "hersey/fem/mesh.h"
#include "hersey/fem/quadrature.h"
#include "hersey/fem/thermal_material.h"
#include "hersey/solver/symmetric_factor.h"

/// Steady conduction of heat in a mesh (theory manual, elastic.24 to elastic.26).
namespace hersey::fem {

/// Returns the conductance (nodes, nodes) [W/K] of an element with nodes at `x`, int k grad N_a . grad N_b dV
/// (elastic.24).
/// @pre smallest_jacobian(type, x) > 0 @verified_by heat_conduction_test.cpp
[[nodiscard]] ElementMatrix element_conductance(ElementType type, const NodeColumns& x, double conductivity,
                                                Integration rule = Integration::full);

/// Faces with convective heat transfer to surroundings: the flux is proportional to the temperature difference.
struct CooledFaces {
  std::vector<ElementFace> faces;
  double transfer = 0;   ///< coefficient [W/(m^2 K)], >= 0
  double T_ambient = 0;  ///< [K]
};

/// Nodes with a prescribed temperature.
struct PrescribedNodes {
  std::vector<int> nodes;
  double T = 0;  ///< [K]
};

/// Surroundings with which a body exchanges heat; faces that are not named here are insulated.
struct ThermalSurroundings {
  std::vector<CooledFaces> cooled;
  std::vector<PrescribedNodes> prescribed;  ///< where a node is in several entries, the last one counts
};

/// Returns the heat [W] that flows into each node, (n), for a flux [W/m^2] into faces, a function of the position: int
/// N_a q dA.
[[nodiscard]] Eigen::VectorXd heat_load(const Mesh& mesh, const std::vector<ElementFace>& faces,
                                        const std::function<double(const Vector3& x)>& flux);

/// Solver for the temperatures of a body by the heat that flows into its nodes, (elastic.25):
///
///     [K_T + sum_s alpha_s int N_a N_b dA] T = Q + sum_s alpha_s T_s int N_a dA,    T prescribed at some nodes.
class HeatConduction {
 public:
  /// @param materials of the elements, by Element::material (none given: the first)
  /// @throws ContractError unless every element conducts
  HeatConduction(const Mesh& mesh, const std::vector<ThermalMaterial>& materials, ThermalSurroundings surroundings,
                 Integration rule = Integration::full);

  /// Factorises the matrix; call it once. `singular` means that the heat of the body, or of a part of it, reaches no
  /// surroundings.
  [[nodiscard]] solver::FactorSummary factorise();

  /// Returns T (n, columns) [K] for heat (n, columns) [W] into the nodes. Heat into a node of prescribed temperature
  /// leaves through that node.
  /// @pre the last factorise() was solved()
  [[nodiscard]] Eigen::MatrixXd temperatures(const Eigen::MatrixXd& heat) const;

  /// Returns the part of the temperatures that is caused by the heat alone: T where all surroundings and prescribed
  /// temperatures are 0.
  [[nodiscard]] Eigen::MatrixXd rises(const Eigen::MatrixXd& heat) const;

  /// Returns the heat that leaves through each of the cooled faces at temperatures T (n), in their order [W]
  /// (elastic.26).
  [[nodiscard]] Eigen::VectorXd cooling(const Eigen::VectorXd& T) const;

  /// Returns the heat that leaves through each set of nodes of prescribed temperature, in their order [W].
  /// @param heat (n) [W] into the nodes, at which they have the temperatures T (n)
  [[nodiscard]] Eigen::VectorXd reaction_heat(const Eigen::VectorXd& T, const Eigen::VectorXd& heat) const;

  /// Conductance matrix of body and cooled faces (n, n) [W/K].
  [[nodiscard]] const Eigen::SparseMatrix<double>& conductance() const { return A_; }

 private:
  void cool(const Mesh& mesh);

  ThermalSurroundings surroundings_;
  Eigen::SparseMatrix<double> A_;
  Eigen::VectorXd ambient_;               ///< right side of the cooled faces [W]
  Eigen::VectorXd prescribed_T_;          ///< prescribed temperatures, 0 at all other nodes
  std::vector<int> owner_;                ///< index of the prescribed set to which each node belongs, -1: none
  std::vector<int> free_;                 ///< nodes without a prescribed temperature
  std::vector<Eigen::VectorXd> to_face_;  ///< alpha int N_a dA (n) of each of the cooled faces [W/K]
  solver::SymmetricFactor factor_;
};

}  // namespace hersey::fem
