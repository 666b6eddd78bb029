#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "hersey/circuit/aerated_oil.h"
#include "hersey/circuit/laws.h"
#include "hersey/core/outcome.h"

/// Circuits of oil: nodes with a pressure each, and elements through which oil flows between them. They know no films:
/// what draws oil from a node is a flow that depends on pressures.
namespace hersey::circuit {

/// A point of the circuit with one pressure.
struct Node {
  std::string name;
  bool is_given = false;                ///< its pressure is given: a sump, the surroundings, a supply
  std::optional<Storage> storage = {};  ///< what it stores over time; unset: nothing
  /// By how much its entry of pressures lies below the cavitation pressure where it is empty [Pa], > 0: a scale without
  /// influence on the solution. Nodes that store oil have their own.
  double fill_scale = 1e5;
  /// At which oil ceases to fill it [Pa]: that of films that draw there, elsewhere the vacuum.
  double p_cav = -standard_atmosphere;
};

/// What lies between two nodes.
struct Element {
  std::string name;
  std::size_t from = 0, to = 0;  ///< nodes; flows count from the one to the other
  Law law;
  std::optional<std::size_t> shaft = {};  ///< index in Conditions::speeds, of a pump or of a body with which it rotates
  double r_from = 0, r_to = 0;           ///< distances of its ends from the axis about which it rotates (circuit.2) [m]
  bool passes_axis = false;              ///< it is straight and leads from one side of the axis to the other
  std::optional<std::size_t> hole = {};  ///< index in Conditions::open_areas, of a hole over a groove
};

/// All data of a circuit. They are plain: what a Circuit asks of them is checked where a model is read.
struct Network {
  std::vector<Node> nodes;
  std::vector<Element> elements;
  Oil oil;
  double ambient = standard_atmosphere;  ///< absolute pressure where pressures of the circuit are 0 [Pa]
};

/// Pressure and fill of a node (circuit.18), with derivatives by its entry of pressures.
struct NodeState {
  double p = 0;  ///< [Pa]
  double p_slope = 1;
  double fill = 1;        ///< fraction of the node that is oil [-]
  double fill_slope = 0;  ///< [1/Pa]
};

/// Flow of oil through an element and its derivatives.
struct Through {
  double value = 0;               ///< from its first node to its second [m^3/s]
  double by_from = 0, by_to = 0;  ///< by the entries of pressures of its nodes [m^3/(Pa s)]
  double by_area = 0;             ///< by the open area of a hole over a groove [m/s]
};

/// What a circuit's balance depends on beside its pressures.
struct Conditions {
  Eigen::VectorXd given;   ///< pressures of nodes whose pressure is given [Pa], shape (nodes); others mean nothing
  Eigen::VectorXd speeds;  ///< of shafts [rad/s]
  Eigen::VectorXd open_areas = {};   ///< of holes over grooves [m^2]
  Eigen::VectorXd viscosities = {};  ///< of the oil in each element [Pa s]; empty: that of the circuit's oil
  double dt = 0;                     ///< length of the step [s]; 0: nodes store nothing, the flow is steady
  Eigen::VectorXd content;  ///< oil in each node at the start of the step [m^3], shape (nodes); unused for dt = 0
};

/// What others draw from the nodes, linear in the nodes' pressures.
struct Drawn {
  Eigen::VectorXd flow;  ///< at pressures `p` [m^3/s], shape (nodes)
  Eigen::MatrixXd by_p;  ///< shape (nodes, nodes)
  Eigen::VectorXd p;     ///< [Pa], shape (nodes)
};

/// Summary of a solution. On failure the pressures are the last iterate's.
struct [[nodiscard]] CircuitSummary : Outcome {
  int iterations = 0;
  double residual = 0;  ///< largest imbalance of a node over the largest flow [-]
};

/// Balance of a circuit at each node, with exact derivatives, and its solution by Newton's method.
///
/// Pressures are a vector over all nodes, one entry each. A node whose pressure is not given cannot have one below the
/// cavitation pressure: an entry below it is none, but says how far the node is filled (circuit.18), see state(). Rows
/// of nodes with a given pressure are those of that pressure: no balance.
/// @verified_by circuit_test.cpp
class Circuit {
 public:
  /// @throws ContractError for elements between nodes, or on shafts, that do not exist
  explicit Circuit(Network network);

  [[nodiscard]] const Network& network() const { return network_; }  ///< as given
  /// Number of nodes.
  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(network_.nodes.size()); }

  /// Returns pressure and fill of a node where its entry of pressures is `p`.
  [[nodiscard]] NodeState state(std::size_t node, double p) const;
  /// Returns the entry below the cavitation pressure at which the node is empty, less that pressure, > 0 [Pa].
  [[nodiscard]] double fill_scale(std::size_t node) const { return fill_scales_[node]; }
  /// Returns the pressures of all nodes [Pa].
  [[nodiscard]] Eigen::VectorXd pressures(const Eigen::VectorXd& p) const;
  /// Returns how far each node is filled [-].
  [[nodiscard]] Eigen::VectorXd fills(const Eigen::VectorXd& p) const;

  /// Returns the flow of oil through an element (circuit.19).
  [[nodiscard]] Through flow(std::size_t element, const Eigen::VectorXd& p, const Conditions& conditions) const;
  /// Returns the flows through all elements [m^3/s].
  [[nodiscard]] Eigen::VectorXd flows(const Eigen::VectorXd& p, const Conditions& conditions) const;
  /// Returns the torque that an element takes from its shaft [N m]: that of a pump (circuit.21), or of a bore that
  /// rotates (circuit.22); 0 without a shaft.
  [[nodiscard]] double torque(std::size_t element, const Eigen::VectorXd& p, const Conditions& conditions) const;
  /// Returns the pressure at the axis in an element that passes it (circuit.17) [Pa].
  [[nodiscard]] double pressure_at_axis(std::size_t element, const Eigen::VectorXd& p,
                                        const Conditions& conditions) const;
  /// Returns what the oil loses on its way through an element, as heat [W], >= 0: flow times drop of pressure; in a
  /// pump that of the leak.
  [[nodiscard]] double dissipation(std::size_t element, const Eigen::VectorXd& p, const Conditions& conditions) const;
  /// Returns the oil in each node [m^3]; 0 in those that store none.
  [[nodiscard]] Eigen::VectorXd content(const Eigen::VectorXd& p) const;

  /// The balance of each node and its derivatives.
  struct Balance {
    Eigen::VectorXd surplus;  ///< flow in through elements less what the node stores [m^3/s], shape (nodes)
    Eigen::MatrixXd by_p;     ///< shape (nodes, nodes)
    double largest_flow = 0;  ///< through an element, or into a store [m^3/s]
    double round_off = 0;     ///< of `surplus` [m^3/s]
  };
  /// Computes it at pressures `p` (circuit.1).
  void evaluate(const Eigen::VectorXd& p, const Conditions& conditions, Balance& balance) const;

  /// Finds the pressures at which every node gives what is drawn from it.
  /// @param p  where to begin; on return the solution
  [[nodiscard]] CircuitSummary solve(const Conditions& conditions, const Drawn& drawn, Eigen::VectorXd& p) const;
  /// Returns pressures from which to begin: those that are given, and elsewhere the highest of these and of relief
  /// valves, nowhere below the cavitation pressure.
  [[nodiscard]] Eigen::VectorXd start(const Conditions& conditions) const;

  /// Returns nothing drawn.
  [[nodiscard]] Drawn nothing_drawn() const;
  /// Turns d surplus/dp into a matrix whose rows of given pressures are those of the identity, times a conductance.
  void fix_given(Eigen::MatrixXd& by_p) const;

 private:
  [[nodiscard]] double drop(const Element& element, const Eigen::VectorXd& p, const Conditions& conditions) const;
  [[nodiscard]] Storage::Content content_of(std::size_t node, double p) const;

  Network network_;
  std::vector<double> fill_scales_;
};

}  // namespace hersey::circuit
