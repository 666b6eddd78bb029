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

/// Conductance (nodes, nodes) [W/K] of an element with nodes at `x`, int k grad N_a . grad N_b dV (elastic.24).
/// @pre smallest_jacobian(type, x) > 0 @verified_by heat_conduction_test.cpp
[[nodiscard]] ElementMatrix element_conductance(ElementType type, const NodeColumns& x, double conductivity,
                                                Integration rule = Integration::full);

/// Faces that pass heat to surroundings in proportion to how much hotter they are.
struct CooledFaces {
  std::vector<ElementFace> faces;
  double transfer = 0;   ///< coefficient [W/(m^2 K)], >= 0
  double T_ambient = 0;  ///< [K]
};

/// Nodes whose temperature is given.
struct HeldNodes {
  std::vector<int> nodes;
  double T = 0;  ///< [K]
};

/// What a body exchanges heat with; faces that are not named here pass none.
struct ThermalSurroundings {
  std::vector<CooledFaces> cooled;
  std::vector<HeldNodes> held;  ///< of a node in several of them the last counts
};

/// Heat [W] that flows into each node, (n), of a flux [W/m^2] into faces, a function of the position: int N_a q dA.
[[nodiscard]] Eigen::VectorXd heat_load(const Mesh& mesh, const std::vector<ElementFace>& faces,
                                        const std::function<double(const Vector3& x)>& flux);

/// Temperatures of a body by the heat that flows into its nodes, (elastic.25):
///
///     [K_T + sum_s alpha_s int N_a N_b dA] T = Q + sum_s alpha_s T_s int N_a dA,    T as given at held nodes.
class HeatConduction {
 public:
  /// @param materials of the elements, by Element::material (none given: the first)
  /// @throws ContractError unless every element conducts
  HeatConduction(const Mesh& mesh, const std::vector<ThermalMaterial>& materials, ThermalSurroundings surroundings,
                 Integration rule = Integration::full);

  /// Once; `singular` where the heat of the body, or of a part of it, has nowhere to go.
  [[nodiscard]] solver::FactorSummary factorise();

  /// T (n, columns) [K] of heat (n, columns) [W] into the nodes. Heat into a held node goes straight out of it.
  /// @pre the last factorise() was solved()
  [[nodiscard]] Eigen::MatrixXd temperatures(const Eigen::MatrixXd& heat) const;

  /// What of these heat alone makes: T where all surroundings and held nodes are at 0.
  [[nodiscard]] Eigen::MatrixXd rises(const Eigen::MatrixXd& heat) const;

  /// Heat that leaves through each of the cooled faces at temperatures T (n), in their order [W] (elastic.26).
  [[nodiscard]] Eigen::VectorXd cooling(const Eigen::VectorXd& T) const;

  /// Heat that leaves through each of the held sets, in their order [W].
  /// @param heat (n) [W] into the nodes, at which they have the temperatures T (n)
  [[nodiscard]] Eigen::VectorXd held_heat(const Eigen::VectorXd& T, const Eigen::VectorXd& heat) const;

  /// Conductance matrix of body and cooled faces (n, n) [W/K].
  [[nodiscard]] const Eigen::SparseMatrix<double>& conductance() const { return A_; }

 private:
  void cool(const Mesh& mesh);

  ThermalSurroundings surroundings_;
  Eigen::SparseMatrix<double> A_;
  Eigen::VectorXd ambient_;               ///< right side of the cooled faces [W]
  Eigen::VectorXd interface_wrench_;      ///< temperatures of held nodes, 0 of the others
  std::vector<int> owner_;                ///< which of the held sets a node belongs to, -1: none
  std::vector<int> free_;                 ///< nodes without a given temperature
  std::vector<Eigen::VectorXd> to_face_;  ///< of each of the cooled faces alpha int N_a dA (n) [W/K]
  solver::SymmetricFactor factor_;
};

}  // namespace hersey::fem
