#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hersey/core/scalar_function.h"
#include "hersey/core/spatial.h"
#include "hersey/mbd/coordinate_force.h"
#include "hersey/mbd/elastic_body.h"
#include "hersey/mbd/joint.h"
#include "hersey/mbd/load_axes.h"
#include "hersey/mbd/shared_unknowns.h"
#include "hersey/mbd/two_body_force.h"

/// Specification of a mechanism: bodies, frames, joints, forces, drives.
namespace hersey::mbd {

/// Index of an item in the order of addition; each kind of item has its own type.
template <class Tag>
struct Id {
  int index = -1;
  friend bool operator==(const Id&, const Id&) = default;
};
using BodyId = Id<struct BodyTag>;
using FrameId = Id<struct FrameTag>;
using JointId = Id<struct JointTag>;
using ForceId = Id<struct ForceTag>;    ///< forces between two bodies
using SpringId = Id<struct SpringTag>;  ///< springs on a joint coordinate
using LoadId = Id<struct LoadTag>;
using DriveId = Id<struct DriveTag>;
using CoordinateForceId = Id<struct CoordinateForceTag>;
using CouplingId = Id<struct CouplingTag>;
using ElasticId = Id<struct ElasticTag>;

/// A rigid body.
struct BodySpec {
  std::string name;
  double mass = 0;                    ///< [kg], >= 0
  Vector3 com = Vector3::Zero();      ///< centre of mass from the body's origin, body axes [m]
  Matrix3 inertia = Matrix3::Zero();  ///< about the centre of mass, body axes [kg m^2], positive semidefinite
};

/// A frame fixed on a body.
struct FrameSpec {
  std::string name;
  BodyId body;
  Pose X_BF;  ///< pose of the frame on the body
};

struct JointSpec {
  std::string name;
  JointType type = JointType::fixed;
  FrameId inboard;
  FrameId outboard;
  Vector3 axis = Vector3::UnitZ();  ///< axis in the inboard frame; any length > 0
  double lead = 0;  ///< axial displacement of a screw per revolution [m], positive for a right-handed screw
  std::vector<double>
      initial;  ///< values in the order of coordinates_of(type); empty: zero, and free to move in assembly
  std::vector<double> initial_rate;  ///< rates likewise
  std::vector<bool> loose;           ///< per value: `initial` is a guess and free to move; empty: no value is a guess
  std::vector<bool> loose_rate;      ///< per value: `initial_rate` is a guess

  /// True if the initial value `i` is prescribed.
  [[nodiscard]] bool is_given(int i) const { return is_in(initial, loose, i); }
  /// True if the initial rate `i` is prescribed.
  [[nodiscard]] bool is_rate_given(int i) const { return is_in(initial_rate, loose_rate, i); }
  /// True if any initial value or rate is prescribed.
  [[nodiscard]] bool has_given() const {
    for (int i = 0; i < degrees_of_freedom(type); ++i)
      if (is_given(i) || is_rate_given(i)) return true;
    return false;
  }

 private:
  static bool is_in(const std::vector<double>& values, const std::vector<bool>& loose, int i) {
    return !values.empty() && (loose.empty() || !loose[static_cast<std::size_t>(i)]);
  }
};

/// A scalar joint coordinate: entry `value` of the joint's list of values.
struct CoordinateRef {
  JointId joint;
  int value = 0;
};

/// An argument of a load's function.
struct Variable {
  enum class Kind { time, position, rate };
  Kind kind = Kind::time;
  CoordinateRef coordinate;  ///< for position and rate
};

/// direction * magnitude(variables): one term of a load.
struct LoadTerm {
  Vector6 direction = Vector6::Zero();  ///< [tau; f], dimensionless
  std::shared_ptr<const ScalarFunction> magnitude;
  std::vector<Variable> variables;  ///< the arguments of `magnitude`, in order
};

/// A force and torque on a body, at the origin of a frame; the reaction goes to ground.
struct LoadSpec {
  std::string name;
  FrameId frame;
  LoadAxes axes = LoadAxes::ground;  ///< axes of `direction`: ground's, or those of the frame's body
  std::vector<LoadTerm> terms;
};

/// A spring and damper on a scalar joint coordinate: generalised force -(stiffness (q - free) + damping qdot).
struct CoordinateSpringSpec {
  std::string name;
  CoordinateRef coordinate;
  double stiffness = 0;      ///< [N m/rad] or [N/m]
  double damping = 0;        ///< [N m s/rad] or [N s/m]
  double free_position = 0;  ///< [rad] or [m]
};

/// Prescribed motion of a scalar joint coordinate.
struct DriveSpec {
  enum class Kind { position, speed, acceleration };
  std::string name;
  CoordinateRef coordinate;
  Kind kind = Kind::position;
  std::shared_ptr<const ScalarFunction> function;  ///< function of time alone
  double ramp = 0;   ///< time over which the motion is blended in from rest, twice differentiable [s]
  double start = 0;  ///< when the ramp begins [s]
};

/// Holonomic relation between scalar joint coordinates: output = sum of f_i(input_i). Gear, rack, cam,
/// differential. It acts between the two bodies of each joint and does no work in all.
struct CouplingSpec {
  struct Term {
    CoordinateRef input;
    std::shared_ptr<const ScalarFunction> function;  ///< function of the input alone, twice differentiable
  };
  std::string name;
  CoordinateRef output;
  std::vector<Term> terms;
};

/// Elastic bodies on whose deformation a force between two bodies depends, beside the motion of its frames.
struct ForceSurfaces {
  std::optional<ElasticId> a, b;
};

/// All parts of a mechanism in the order of addition.
struct MechanismSpec {
  Vector3 gravity = Vector3::Zero();  ///< [m/s^2], ground axes
  std::vector<BodySpec> bodies;       ///< body 0 is ground
  std::vector<FrameSpec> frames;      ///< bodies' own frames among them
  std::vector<FrameId> body_frames;   ///< each body's own frame
  std::vector<JointSpec> joints;
  std::vector<LoadSpec> loads;
  std::vector<CoordinateSpringSpec> springs;
  std::vector<DriveSpec> drives;
  std::vector<CouplingSpec> couplings;

  struct CoordinateForce {
    std::string name;
    CoordinateRef coordinate;
    std::shared_ptr<mbd::CoordinateForce> force;
  };
  std::vector<CoordinateForce> coordinate_forces;

  struct Force {
    std::string name;
    FrameId a, b;
    std::shared_ptr<TwoBodyForce> force;
    ForceSurfaces surfaces;
  };
  std::vector<Force> forces;

  /// Unknowns that some of the forces share, and the coordinates on whose rates they depend.
  struct Shared {
    std::string name;
    std::shared_ptr<SharedUnknowns> unknowns;
    std::vector<CoordinateRef> coordinates;
  };
  std::vector<Shared> shared;

  struct Elastic {
    std::string name;
    std::vector<FrameId> frames;    ///< frames in the order of the elastic body, each on a body of its own
    std::vector<JointId> freedoms;  ///< free joints from the first frame at rest_pose to each other; none of segments
    std::shared_ptr<ElasticBody> body;
    std::vector<std::string> load_names;                       ///< names of its loads, in the order of addition
    std::vector<std::shared_ptr<const ScalarFunction>> loads;  ///< their values, functions of time
  };
  std::vector<Elastic> elastics;
  std::vector<JointId> deforming;  ///< free joints of elastic bodies, whose coordinates are deformations
  int longest_path = std::numeric_limits<int>::max();  ///< see MechanismBuilder::cut_paths
  bool loosens_beams = false;                          ///< see MechanismBuilder::loosen_beams
  bool chooses_roots = false;                          ///< see MechanismBuilder::choose_roots
};

/// Ids of the parts of a flexible body in a mechanism.
struct FlexibleBodyIds {
  ElasticId elastic;
  std::vector<BodyId> bodies;   ///< body of each frame; the first has the flexible body's name and axes
  std::vector<FrameId> frames;  ///< own frames of `bodies`
};

/// Ids of the parts of a beam in a mechanism.
struct BeamBodyIds {
  std::vector<ElasticId> segments;
  std::vector<JointId> freedoms;  ///< joint of each node but the first, against the first
  std::vector<BodyId> bodies;     ///< body of each node; the first has the beam's name and axes
  std::vector<FrameId> frames;    ///< own frames of `bodies`
};

}  // namespace hersey::mbd
