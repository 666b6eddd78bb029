#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hersey/bearing/film_force.h"
#include "hersey/circuit/circuit.h"
#include "hersey/core/scalar_function.h"
#include "hersey/film/surface_feature.h"
#include "hersey/film/temperature_law.h"
#include "hersey/film/thermal_network.h"
#include "hersey/mbd/coordinate_force.h"
#include "hersey/mbd/shared_unknowns.h"

namespace hersey::bearing {

/// The film of a bearing in a circuit.
struct CircuitFilm {
  std::shared_ptr<FilmForce> film;
  std::size_t force = 0;           ///< of the film in its mechanism
  std::vector<std::size_t> nodes;  ///< at which each of its ports draws, in the order of BearingOptions::circuit_ports
};

/// A shaft whose speed is `offset` plus `factor` times the rate of a joint coordinate.
struct CircuitShaft {
  double offset = 0;                           ///< [rad/s]
  double factor = 1;                           ///< [-]
  std::optional<std::size_t> coordinate = {};  ///< of those on which the unknowns depend; unset: the speed is constant
};

/// A hole of one surface of a bearing that passes over a groove of the other, an element of the circuit.
struct CircuitHole {
  std::size_t film = 0;  ///< whose surfaces they are: index in the circuit's films
  film::SurfaceFeature hole, groove;
};

/// Temperatures of a circuit's oil: each node is one of a thermal network (theory manual, circuit.14).
struct CircuitHeat {
  double heat_capacity = 0;                ///< of the oil, per volume [J/(m^3 K)], > 0
  film::TemperatureLaw law;                ///< its viscosity
  std::vector<std::size_t> nodes = {};     ///< in the network, of each node of the circuit
  std::vector<std::size_t> coolants = {};  ///< in the network, of each element; of no account but to coolers
  Eigen::VectorXd T = {};                  ///< of each node of the circuit at the start [K]
};

/// What a circuit shows after a step.
struct CircuitObservation {
  Eigen::VectorXd pressures;   ///< of nodes [Pa]
  Eigen::VectorXd flows;       ///< through elements [m^3/s]
  Eigen::VectorXd drawn;       ///< by films from each node [m^3/s]
  Eigen::VectorXd content;     ///< oil in each node that stores some [m^3]
  Eigen::VectorXd speeds;      ///< of shafts [rad/s]
  Eigen::VectorXd open_areas;  ///< of holes over grooves [m^2]
  /// Of nodes, after the step [K], and heat from the oil into the coolant of each cooler, in the order of elements [W];
  /// empty: the oil has one temperature.
  Eigen::VectorXd temperatures, cooled;
  Eigen::VectorXd fills;           ///< fraction of each node that is oil [-]; below 1 only at the cavitation pressure
  Eigen::VectorXd axis_pressures;  ///< at the axis in each element that passes it, in their order [Pa]
  double dissipated = 0;           ///< in elements, as far as it warms the oil [W]
  double balance_error = 0;        ///< largest imbalance of a node over the largest flow [-]
  double power = 0;                ///< that pumps and other sources put into the oil [W]
};

/// A circuit of oil between films: the pressures of its nodes, or their fills, are unknowns that these films share.
///
/// An evaluation finds them with every film linear in pressures and surfaces (circuit.9), elements as they are. They
/// then follow the surfaces of all films to the next evaluation (circuit.11), so that films, circuit and bodies are one
/// Newton iteration.
/// @verified_by oil_circuit_test.cpp
class OilCircuit final : public mbd::SharedUnknowns {
 public:
  /// @param given  pressure over time of each node that has a given one, null for others
  /// @param holes  over grooves, in the order of circuit::Element::hole
  /// @param heat  unset: the oil has the one temperature of the network's oil
  OilCircuit(circuit::Network network, std::vector<CircuitFilm> films,
             std::vector<std::shared_ptr<const ScalarFunction>> given, std::vector<CircuitShaft> shafts,
             std::vector<CircuitHole> holes = {}, std::optional<CircuitHeat> heat = {});

  void begin_step(double dt) override;
  void follow(const mbd::SharedMotion& motion) override;
  void condense(std::span<mbd::ForceResponse> responses) override;
  void accept_step() override;
  [[nodiscard]] bool has_condensed_unknowns() const override { return true; }
  [[nodiscard]] double internal_residual() const override { return worst_.over_largest_flow; }
  [[nodiscard]] std::string name_of_internal_residual() const override {
    return "node " + circuit_.network().nodes[worst_.node].name;
  }
  [[nodiscard]] std::string domain_error() const override { return domain_error_; }
  void persist(Archive& archive) override;

  [[nodiscard]] const circuit::Circuit& circuit() const { return circuit_; }  ///< without its films
  /// Returns its figures at the step last accepted.
  [[nodiscard]] const CircuitObservation& observation() const { return observation_; }

  /// Returns the torque that the circuit puts on the coordinate of a shaft [N m] (circuit.21, circuit.22), at the
  /// evaluation or the accepted step last made; 0 before the first.
  [[nodiscard]] double torque_on(std::size_t shaft) const;

  // Temperatures move after a step has been accepted, and stay over the next one.

  /// Null: the oil has one temperature.
  [[nodiscard]] const CircuitHeat* heat() const { return heat_ ? &*heat_ : nullptr; }
  /// Returns the oil between nodes in the step last accepted, as streams of a thermal network.
  [[nodiscard]] std::vector<film::OilStream> streams() const;
  /// Adds these streams over a step of `dt` [s] to the means of a cycle.
  void add_streams_to_mean(double dt);
  /// Returns the means since the last call.
  [[nodiscard]] std::vector<film::OilStream> mean_streams();
  /// Takes the temperatures of its nodes from those of the network [K]; elements have the viscosity of the oil that
  /// flows into them.
  void follow_temperatures(const Eigen::VectorXd& T_network);
  /// Sets the temperatures of its nodes [K].
  void set_temperatures(const Eigen::VectorXd& T);

 private:
  void set_conditions(const mbd::SharedMotion& motion);
  void refuse_backward_pumps();
  void open_holes();
  /// Adds what the angle of a film's journal changes by the holes that pass its grooves, to columns of its parameters.
  void add_passing_holes(std::size_t film, const Eigen::VectorXd& p, Eigen::MatrixXd& rhs) const;
  void pass_pressures();
  /// Change of the pressure that a film's port is given with its node's entry of pressures.
  [[nodiscard]] double port_scale(const CircuitFilm& film, std::size_t node) const;
  /// Solves films and circuit in turn until all nodes give what films draw.
  void balance_with_films(const mbd::SharedMotion& motion);
  [[nodiscard]] circuit::Drawn drawn_by_films() const;
  /// Finds the pressures at which the circuit gives what linear films draw.
  [[nodiscard]] circuit::CircuitSummary solve(const circuit::Drawn& drawn, Eigen::VectorXd& p) const;
  struct Imbalance {
    double over_largest_flow = 0;  ///< of the worst node [-]
    std::size_t node = 0;
    double flow = 0;  ///< of the worst node [m^3/s]
  };
  /// Imbalance of nodes at pressures `p` where films draw `drawn`.
  [[nodiscard]] Imbalance imbalance(const Eigen::VectorXd& p, const Eigen::VectorXd& drawn) const;
  void update_viscosities();
  void observe_axes();
  void persist_heat(Archive& archive);

  circuit::Circuit circuit_;
  std::vector<CircuitFilm> films_;
  std::vector<std::shared_ptr<const ScalarFunction>> given_;
  std::vector<CircuitShaft> shafts_;
  std::vector<CircuitHole> holes_;
  std::optional<CircuitHeat> heat_;
  std::vector<double> area_by_angle_;  // of each hole [m^2/rad]
  circuit::Conditions conditions_;

  Eigen::VectorXd p_;                     // at the present evaluation
  Eigen::VectorXd p_solved_;              // of the last condensation
  std::vector<Eigen::VectorXd> at_;       // parameters of each film there
  std::vector<Eigen::MatrixXd> p_by_at_;  // (nodes, parameters)
  Eigen::VectorXd drawn_;
  bool is_condensed_ = false;

  Eigen::VectorXd p_start_;  // to which a rejected step returns; empty before the start
  Imbalance worst_;          // at the pressures with which the films were evaluated last
  std::string domain_error_;
  CircuitObservation observation_;

  std::vector<film::OilStream> sum_;  // of streams times the lengths of their steps; empty before the first
  double sum_of_steps_ = 0;           // [s]
};

/// Torque of a circuit's pump, or of a bore that rotates, on the coordinate that turns it; the oil takes its power.
///
/// It follows pressures and flows of each evaluation; how they answer to motions of films and shaft is left out of the
/// tangent.
/// @verified_by shaft_torque_test.cpp
class CircuitTorque final : public mbd::CoordinateForce {
 public:
  /// @param shaft  of the circuit; it follows this force's coordinate
  CircuitTorque(std::shared_ptr<const OilCircuit> circuit, std::size_t shaft)
      : circuit_(std::move(circuit)), shaft_(shaft) {}
  [[nodiscard]] mbd::CoordinateEffort evaluate(double /*t*/, double /*position*/, double /*rate*/) const override {
    return {.value = circuit_->torque_on(shaft_)};
  }
  [[nodiscard]] bool is_source() const override { return true; }

 private:
  std::shared_ptr<const OilCircuit> circuit_;
  std::size_t shaft_;
};

}  // namespace hersey::bearing
