#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "hersey/core/spatial.h"
#include "hersey/fem/mesh.h"
#include "hersey/mbd/bushing.h"
#include "hersey/mbd/coordinate_laws.h"
#include "hersey/mbd/gear_mesh.h"
#include "hersey/mbd/linear_bearing.h"
#include "hersey/mbd/piston_ring.h"
#include "hersey/mbd/spring_damper.h"
#include "hersey/model/function.h"
#include "hersey/model/names.h"

/// The section `forces`. Data of a force between two frames (`from`, `to`) or on a joint coordinate (`on`) construct
/// the force themselves: no other code depends on its kind.
namespace hersey::model {

/// A force [N] or torque [N m] on a body, at the origin of `at`.
struct BodyLoad {
  bool is_torque = false;
  FrameName at;
  Axes axes = Axes::ground;          ///< axes of components or direction: ground's or those of frame `at`
  std::optional<Vector3> direction;  ///< unit vector; then `functions` holds the magnitude alone
  std::vector<Function> functions;   ///< three components, or one magnitude along `direction`
};

struct SpringDamper {
  FrameName from, to;
  double stiffness = 0;             ///< [N/m], >= 0
  double damping = 0;               ///< [N s/m], >= 0
  double free_length = 0;           ///< [m], >= 0
  std::optional<Function> tension;  ///< further pull [N] over the length [m]
  /// Constructs a law for one machine.
  [[nodiscard]] std::shared_ptr<mbd::TwoBodyForce> made() const {
    return std::make_shared<mbd::SpringDamper>(stiffness, damping, free_length, tension ? tension->value : nullptr);
  }
};

/// Spring and damper on one joint coordinate.
struct CoordinateSpring {
  CoordinateName on;
  double stiffness = 0;               ///< [N m/rad] or [N/m], >= 0
  double damping = 0;                 ///< [N m s/rad] or [N s/m], >= 0
  double free_position = 0;           ///< [rad] or [m]
  std::optional<Function> restoring;  ///< further torque or force that pulls back, over the stretch [rad] or [m]
};

/// An elastic connection in all six directions, rotations first in the matrices.
struct Bushing {
  FrameName from, to;
  Matrix6 stiffness = Matrix6::Zero(), damping = Matrix6::Zero();  ///< symmetric, positive semidefinite
  /// Constructs a law for one machine.
  [[nodiscard]] std::shared_ptr<mbd::TwoBodyForce> made() const {
    return std::make_shared<mbd::Bushing>(stiffness, damping);
  }
};

/// A bearing by its coefficients over the speed of the shaft, `from` the housing `to` the shaft.
struct BearingTable {
  FrameName from, to;
  std::shared_ptr<const mbd::BearingCoefficientTable> table;  ///< null only where faults were reported
  /// Constructs a law for one machine.
  [[nodiscard]] std::shared_ptr<mbd::TwoBodyForce> made() const { return std::make_shared<mbd::LinearBearing>(table); }
};

/// An unbalance of a shaft, `from` ground, whose axes do not rotate, `to` its station.
struct Unbalance {
  FrameName from, to;
  Vector3 moment = Vector3::Zero();  ///< mass times eccentricity, in the station's axes [kg m]
  std::optional<double> begins;      ///< the instant at which it appears; unset: it has always been there [s]
};

/// The mesh of two gear wheels, `from` the first `to` the second.
struct GearMesh {
  FrameName from, to;
  mbd::GearMesh::Data data;
};

/// Friction of a piston ring, `from` the liner `to` the piston.
struct PistonRing {
  FrameName from, to;
  mbd::PistonRing::Data data;   ///< `gas` apart
  std::optional<Function> gas;  ///< pressure [Pa], over time or the crank's rotation
};

struct JointFriction {
  CoordinateName on;
  double coulomb = 0;           ///< [N m] or [N], >= 0
  double viscous = 0;           ///< [N m s/rad] or [N s/m], >= 0
  double transition_speed = 0;  ///< [rad/s] or [m/s], > 0
  /// Constructs a law, with its own memory, for one machine.
  [[nodiscard]] std::shared_ptr<mbd::CoordinateForce> made() const {
    return std::make_shared<mbd::JointFriction>(coulomb, viscous, transition_speed);
  }
};

struct SpeedControl {
  CoordinateName on;
  Function speed;           ///< of time [rad/s] or [m/s]
  double proportional = 0;  ///< [N m s/rad] or [N s/m], >= 0
  double integral = 0;      ///< [N m/rad] or [N/m], >= 0
  double limit = 0;         ///< [N m] or [N], > 0; infinity for none
  /// Constructs a law, with its own memory, for one machine.
  [[nodiscard]] std::shared_ptr<mbd::CoordinateForce> made() const {
    return std::make_shared<mbd::SpeedController>(speed.value, proportional, integral, limit);
  }
};

/// A pressure [Pa] on faces of a flexible body's mesh, against their outward normals; or a force [N] spread evenly over
/// their area.
struct SurfaceLoad {
  bool is_pressure = false;
  std::string body;
  std::vector<fem::ElementFace> faces;
  Axes axes = Axes::body;            ///< of a force
  std::optional<Vector3> direction;  ///< of a force's magnitude; of a pressure: it falls as the cosine from there
  std::vector<Function> functions;   ///< of time or the crank's rotation: one value, or three components of a force
};

/// One entry of `forces`.
struct Force {
  std::string name;
  std::variant<BodyLoad, SurfaceLoad, SpringDamper, CoordinateSpring, Bushing, BearingTable, Unbalance, GearMesh,
               PistonRing, JointFriction, SpeedControl>
      data;
  SourcePosition position;

  /// Data of the force if it is a T, null otherwise.
  template <class T>
  [[nodiscard]] const T* as() const {
    return std::get_if<T>(&data);
  }
};

/// A function of time that a force follows, with its description.
template <class F>
struct ForceFunction {
  F* function;
  std::string unit, text;  ///< "N", "force gas"
};

/// Returns the functions of time of a force; not its laws over a length or an angle.
[[nodiscard]] std::vector<ForceFunction<Function>> functions_of(Force& force);
[[nodiscard]] std::vector<ForceFunction<const Function>> functions_of(const Force& force);

/// The frames that a force acts on.
[[nodiscard]] std::vector<FrameName> frames_of(const Force& force);

}  // namespace hersey::model
