#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hersey/bearing/film_force.h"
#include "hersey/bearing/oil_circuit.h"
#include "hersey/film/thermal_network.h"
#include "hersey/mbd/beam_segment.h"
#include "hersey/mbd/contact.h"
#include "hersey/mbd/gear_mesh.h"
#include "hersey/mbd/mechanism.h"
#include "hersey/model/model.h"

namespace hersey::model {

/// A bearing's surface on a flexible body.
struct BuiltSurface {
  std::string body;
  int around = 0, along = 0;  ///< functions
  int modes = 0;              ///< answers to film pressure that the body keeps of this surface
  double lost = 0;            ///< largest compliance left out over the largest
};

/// A bearing of a machine and the two-body force it is in the mechanism.
struct BuiltBearing {
  std::shared_ptr<bearing::FilmForce> bearing;
  mbd::ForceId force;
  std::optional<BuiltSurface> shell, journal;  ///< unset: rigid
};

/// A contact of a machine, the two-body force it is, and the body of its first shape.
struct BuiltContact {
  std::shared_ptr<mbd::Contact> contact;
  mbd::ForceId force;
  mbd::BodyId first;
};

/// A flexible body of a machine.
struct BuiltFlexible {
  std::string name;
  std::shared_ptr<mbd::ModalBody> body;
  std::shared_ptr<const fem::Mesh> mesh;
  Eigen::MatrixXd shapes;                     ///< displacements of the nodes per amplitude, shape (3 nodes, shapes)
  std::vector<double> frequencies;            ///< with all frames fixed [Hz]
  std::vector<fem::SolidMaterial> materials;  ///< of the mesh's elements; none: unknown
  mbd::Strain strain = mbd::Strain::small;
  std::vector<fem::StaticError> static_errors;  ///< of the surfaces that carry load
  mbd::ElasticId elastic;
};

/// A pressure or force on the mesh of a flexible body: `count` nodal loads from `first` on.
struct BuiltSurfaceLoad {
  std::string name;
  std::size_t flexible = 0;  ///< index in Machine::flexibles
  std::size_t first = 0, count = 0;
};

/// A piston ring of a machine, a force between two bodies.
struct BuiltRing {
  std::string name;
  mbd::ForceId force;
  std::shared_ptr<const mbd::PistonRing> ring;
};

/// A gear mesh of a machine, a force between two bodies.
struct BuiltMesh {
  std::string name;
  mbd::ForceId force;
  std::shared_ptr<mbd::GearMesh> mesh;
};

/// A beam of a machine.
struct BuiltBeam {
  std::string name;
  std::vector<std::shared_ptr<mbd::BeamSegment>> segments;
  mbd::BeamBodyIds ids;
  std::vector<bool> is_named;  ///< of each node: a frame sits on it, or the beam's own
};

/// A model turned into equations. Bodies, joints, drives, contacts and bearings keep the order of the model; body 0 of
/// the mechanism is ground, and a flexible body is followed by bodies and free joints of its further frames.
struct Machine {
  std::unique_ptr<mbd::Mechanism> mechanism;
  std::vector<BuiltContact> contacts;
  std::vector<BuiltBearing> bearings;
  std::shared_ptr<bearing::OilCircuit> circuit;  ///< between their feeds; null: the model has none
  std::optional<film::ThermalNetwork> network;   ///< of walls that are nodes; unset: the model has none
  std::vector<Groove> grooves;                   ///< between films with temperatures
  std::vector<BuiltFlexible> flexibles;
  std::vector<BuiltSurfaceLoad> surface_loads;
  std::vector<BuiltRing> rings;
  std::vector<BuiltMesh> gear_meshes;
  std::vector<BuiltBeam> beams;
  std::map<std::pair<std::string, std::string>, mbd::FrameId> frames;  ///< by body and frame; "": the body's own
};

}  // namespace hersey::model
