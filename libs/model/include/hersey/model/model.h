#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hersey/bearing/bearing_kind.h"
#include "hersey/bearing/global_heat.h"
#include "hersey/bearing/wear.h"
#include "hersey/core/input_error.h"
#include "hersey/core/scalar_function.h"
#include "hersey/core/spatial.h"
#include "hersey/fem/beam.h"
#include "hersey/fem/elastic_material.h"
#include "hersey/fem/film_surface.h"
#include "hersey/fem/heat_conduction.h"
#include "hersey/fem/mesh_quality.h"
#include "hersey/fem/reduction.h"
#include "hersey/film/film_model.h"
#include "hersey/film/thermal_model.h"
#include "hersey/film/thermal_network.h"
#include "hersey/mbd/contact.h"
#include "hersey/mbd/joint_type.h"
#include "hersey/mbd/nodal_body.h"
#include "hersey/mbd/shape.h"
#include "hersey/model/fmu.h"
#include "hersey/model/force.h"
#include "hersey/model/function.h"
#include "hersey/model/names.h"
#include "hersey/model/oil_circuit.h"
#include "hersey/model/oil_validity.h"
#include "hersey/model/study_settings.h"
#include "hersey/solver/fixed_point_iteration.h"

/// The checked model file as plain data: SI units, names resolved, nothing built yet.
///
/// Everything that has a name in the file keeps it and its location, so that a fault found later (a gap closed at the
/// start, a table that does not cover the run) can point at the line that causes it.
namespace hersey::model {

struct Frame {
  std::string name;
  Pose X_BF;  ///< pose of the frame in its body
  SourcePosition position;
  // On a flexible body
  std::vector<int> nodes;  ///< nodes of its mesh to which the frame is attached; of a beam, the single one
  fem::Connection connection = fem::Connection::rigid;
};

/// Heat conduction and thermal expansion of a body.
struct BodyHeat {
  fem::ThermalMaterial material;  ///< of all of its elements; expansion 0: it keeps its shape
  double T_reference = 293.15;    ///< at which it has the shape of its mesh [K]
  fem::ThermalSurroundings surroundings;
  /// Index in surroundings.cooled of all outer faces that are not named elsewhere; faces with films are not cooled.
  std::optional<std::size_t> rest;
  std::vector<int> fixed;  ///< nodes that are fixed as it expands; none: it expands freely
};

/// Elastic properties of a body.
struct Flexible {
  std::shared_ptr<const fem::Mesh> mesh;            ///< in metres; null where the file is broken
  std::shared_ptr<const fem::ReducedBody> reduced;  ///< read from a file, with its mesh; null: `mesh` is to be reduced
  std::vector<fem::SolidMaterial> materials;        ///< of the mesh's elements
  fem::Parts parts = fem::Parts::one;               ///< of the mesh
  bool nodal = false;                               ///< a displacement of every node, not of shapes
  mbd::Strain strain = mbd::Strain::small;          ///< finite: of nodal bodies
  int modes = 10;                                   ///< with all frames fixed
  std::vector<std::string> load_surfaces;           ///< surfaces or sets of nodes
  double static_error = 0.01;                       ///< of their displacements
  int load_harmonics = 4;
  std::vector<std::vector<fem::ElementFace>> contact_faces;  ///< that touch other bodies
  double highest = 0;                                        ///< leave out modes above this frequency [Hz]; 0: none
  mbd::RayleighDamping damping;
  std::optional<BodyHeat> heat;  ///< unset: nothing is known of it
  double vtu_every = 0;          ///< interval of the deformed meshes written beside the results [s]; 0: none
  SourcePosition position;
};

/// A slender body: its axis divided into straight elements.
struct Beam {
  std::vector<Vector3> nodes;  ///< of the axis, from the first one, body axes [m]; at least two
  std::vector<Matrix3> axes;   ///< of the section in each element; x from node to node
  fem::BeamSection section;
  std::vector<Eigen::Vector2d> outline;  ///< of the section (y, z), around; for pictures [m]
  fem::ElasticMaterial material;
  double mass_per_length = 0;                    ///< [kg/m]
  Vector3 inertia_per_length = Vector3::Zero();  ///< of the section about its own x, y and z [kg m]
  double damping = 0;                            ///< forces of strain rates over those of strains [s]
  SourcePosition position;
};

/// Faces of a flexible body's mesh that touch other bodies and deform with it.
struct DeformingFaces {
  mbd::Shape shape;                     ///< a triangle mesh, undeformed
  std::vector<int> nodes;               ///< of the body's mesh, for each corner
  std::vector<fem::ElementFace> faces;  ///< the same faces
};

struct Body {
  std::string name;                          ///< "ground" only in Model::ground
  double mass = 0;                           ///< [kg], >= 0
  Vector3 centre_of_mass = Vector3::Zero();  ///< from the body's origin, body axes [m]
  Matrix3 inertia = Matrix3::Zero();  ///< about the centre of mass, body axes [kg m^2]; symmetric, physically possible
  std::vector<Frame> frames;
  std::vector<mbd::Shape> shapes;
  std::vector<DeformingFaces> faces;
  std::optional<Flexible> flexible;  ///< if set, mass, centre and inertia are those of its mesh, and each frame has
                                     ///< nodes
  std::optional<Beam> beam;          ///< the same
  SourcePosition position;
};

using mbd::JointType;

/// Value of a coordinate or of its rate at the start.
struct InitialValue {
  std::string coordinate;     ///< "rotation", "rotation_rate", "orientation", "angular_velocity", ...
  std::vector<double> value;  ///< one value, or three for orientation, position, velocity, angular_velocity; SI
  SourcePosition position;
};

struct Joint {
  std::string name;
  JointType type = JointType::revolute;
  FrameName inboard, outboard;
  Vector3 axis = Vector3::UnitZ();    ///< unit vector in the inboard frame; planar: normal of the plane
  double lead = 0;                    ///< of a screw: travel per revolution [m], not 0
  std::vector<InitialValue> initial;  ///< only those given, and kept
  std::vector<InitialValue> guess;    ///< of positions, where the assembly begins to look; the others from 0
  SourcePosition position;
};

/// Prescribed motion of one scalar joint coordinate.
struct Drive {
  enum class Prescribes { position, speed, acceleration };
  std::string name;
  std::string joint;
  std::string coordinate;
  Prescribes prescribes = Prescribes::position;
  Function motion;  ///< of time [rad or m; rad/s or m/s; rad/s^2 or m/s^2]
  double ramp = 0;  ///< time over which it is blended in [s]
  SourcePosition position;
};

/// output = sum of f_i(input_i): a gear, a rack, a cam.
struct CoordinateCoupling {
  struct Term {
    CoordinateName input;
    double factor = 0;                 ///< where there is no function; counted from where the joints start
    std::optional<Function> function;  ///< of the input
  };
  std::string name;
  CoordinateName output;
  std::vector<Term> terms;
  SourcePosition position;
};

/// A shape of a body.
struct ShapeName {
  std::string body;  ///< a body's name, or "ground"
  std::string shape;
  SourcePosition position;
};

struct Contact {
  std::string name;
  ShapeName first, second;
  mbd::ContactLaw law;    ///< as given, or worked out from materials and restitution
  bool is_hertz = false;  ///< the stiffness is Hertz's
  SourcePosition position;
};

struct Lubricant {
  std::string name;
  film::Lubricant data;               ///< at `temperature`, where there is one
  std::string grade;                  ///< by which it can be bought; empty: by its own numbers
  std::optional<double> temperature;  ///< where a bearing has none of its own [K]
  OilValidity validity;
  SourcePosition position;
};

/// A groove between the films of two bearings, in which their oil mixes (theory manual, thermal.68).
struct Groove {
  std::string name;
  std::size_t before = 0, after = 0;   ///< bearings whose last end, and whose first end, lie on it
  std::optional<double> T_fresh = {};  ///< of what comes in addition [K]; unset: that of the oil `after` draws
  double carry_over = 1;               ///< fraction of the oil that reaches it which stays on the journal [-]
};

/// The section `thermal`.
struct Thermal {
  film::ThermalNetworkModel network;
  std::vector<Groove> grooves;
  std::vector<SourcePosition> positions;  ///< of its nodes
};

/// Heating model of a bearing's film.
using Heat = std::variant<std::monostate, bearing::GlobalHeat, film::ThermalModel>;

/// Treatment of rings, free journals and nodes of the thermal network in a simulation.
enum class ThermalWalls {
  transient,   ///< temperatures follow from heat capacities
  cycle_mean,  ///< constant over a cycle, then set to the steady temperatures of its mean heat
  frozen,      ///< constant at their initial values
};

enum class CouplingScheme { monolithic, partitioned };

struct Coupling {
  CouplingScheme scheme = CouplingScheme::monolithic;
  double relaxation = 0.1;  ///< partitioned: share of the first correction taken, in (0, 1]
  solver::Acceleration acceleration = solver::Acceleration::quasi_newton;  ///< partitioned
  int max_iterations = 50;                                                 ///< partitioned: exchanges per step
};

/// Conditions of a journal bearing without a machine. Either the load or the position is given.
struct JournalPoint {
  double journal_speed = 0,
         shell_speed = 0;      ///< about the bearing's axis [rad/s]; of smooth surfaces at rest their sum is not 0
  std::optional<double> load;  ///< on the journal [N], > 0
  double load_angle = 0;       ///< its direction, from x towards y [rad]
  std::optional<double> eccentricity_ratio;  ///< [0, 1)
  double eccentricity_angle = 0;             ///< direction of the journal's position, from x towards y [rad]
  double radial_velocity = 0;     ///< of the journal's centre in that direction [m/s]; 0 where a load is given
  double tilt_x = 0, tilt_y = 0;  ///< slope of the journal's axis towards x and y
  double journal_angle = 0;       ///< rotation of the journal [rad]
  SourcePosition position;
};

/// Conditions of a plane slider without a machine. Either the load or the film thickness is given.
struct SliderPoint {
  double speed = 0;                      ///< of the runner along the pad's y-axis [m/s]
  std::optional<double> load;            ///< that presses runner and pad together [N], > 0
  std::optional<double> film_thickness;  ///< smallest distance of the undeformed surfaces [m], > 0
  double approach_speed = 0;             ///< of runner and pad towards each other [m/s]; 0 where a load is given
  double tilt_along = 0;   ///< slope of the runner against the pad: the gap is wider at the leading end [-]
  double tilt_across = 0;  ///< slope across the sliding direction: the gap is narrower at z > 0 [-]
  SourcePosition position;
};

/// Conditions of a thrust bearing without a machine. Either the load or the film thickness is given.
struct ThrustPoint {
  double speed = 0;                      ///< of the runner about the stator's z-axis [rad/s]
  std::optional<double> load;            ///< that presses runner and stator together [N], > 0
  std::optional<double> film_thickness;  ///< smallest distance of the undeformed surfaces [m], > 0
  double approach_speed = 0;             ///< of runner and stator towards each other [m/s]; 0 where a load is given
  double tilt_x = 0, tilt_y = 0;         ///< slope of the runner's axis towards x and y [-]
  SourcePosition position;
};

/// Conditions of a squeeze-film damper without a machine: a circular orbit about the bore's axis, or small motions
/// about a position at which the journal rests.
struct DamperPoint {
  double whirl_speed = 0;         ///< angular velocity of the orbit, or frequency of small motions [rad/s], not 0
  double orbit_ratio = 0;         ///< radius of the orbit over the clearance, [0, 1); 0: small motions
  double eccentricity_ratio = 0;  ///< of the position about which small motions go on, [0, 1); 0 with an orbit
  double eccentricity_angle = 0;  ///< direction of that position, from x towards y [rad]
  SourcePosition position;
};

/// Conditions of a piston skirt without a machine: its position and motion in the liner. Either the offsets of both
/// ends or a side force is given.
struct SkirtPoint {
  double speed = 0;                              ///< of the skirt along its z-axis [m/s]
  double offset_top = 0, offset_bottom = 0;      ///< of the axis at both ends, towards the thrust side [m]
  double velocity_top = 0, velocity_bottom = 0;  ///< at which these change [m/s]
  std::optional<double> side_force;              ///< that presses the skirt towards the thrust side [N], not 0
  double tilt = 0;                               ///< with a side force: slope of the skirt's axis towards it [-]
  SourcePosition position;
};

/// Conditions of a single bearing without a machine, by its kind.
using OperatingPoint = std::variant<JournalPoint, SliderPoint, ThrustPoint, DamperPoint, SkirtPoint>;

/// How the inertia of a film's oil acts on its journal.
enum class OilInertia {
  none,
  added_mass,                 ///< of a parabolic velocity profile: at low frequencies
  added_mass_high_frequency,  ///< of a uniform velocity profile: at high frequencies
};

/// Returns the momentum factor of that inertia (damper.7); 0: it has none [-].
[[nodiscard]] inline double momentum_factor(OilInertia inertia) {
  if (inertia == OilInertia::none) return 0;
  return inertia == OilInertia::added_mass ? 1.2 : 1;
}

/// A bearing's surface that lies on the mesh of its flexible body.
struct DeformingSurface {
  std::shared_ptr<const fem::FilmSurface> surface;  ///< in the axes of the bearing's frame; never null
  std::optional<int> modes;  ///< largest number of film modes of the body for this surface; unset: by its form
  SourcePosition position;
};

struct Bearing {
  std::string name;
  std::shared_ptr<const bearing::BearingKind> kind = bearing::journal_kind();  ///< never null
  FrameName shell, journal;  ///< of the fixed and of the moving surface; empty in a model of bearings alone
  std::string lubricant;
  film::FilmModel film;  ///< complete: size, clearance, grid, lubricant, cavitation, supply, asperities, compliance
  Heat heat;             ///< none: one temperature
  std::optional<bearing::WallExpansion> expansion;  ///< of the walls, whatever heats the film; unset: they keep size
  double growth = 0;  ///< of the clearance of a film with one given temperature: expansion at that [m]
  std::optional<bearing::WearModel> wear;      ///< of both surfaces over a run; unset: none
  std::string worn_group;                      ///< of the films that wear one moving surface; empty: this film only
  double initial_fill = 1;                     ///< share of the gap that is oil as a run begins [-]
  OilValidity validity;                        ///< of its oil
  std::optional<double> permissible_pressure;  ///< permissible pressure of its lining [Pa]; unset: the usual value in
                                               ///< engines
  std::vector<Function> feature_pressures;     ///< of each of film.features [Pa], over time or the crank's rotation
  std::vector<CircuitPort> circuit_ports;  ///< features that the circuit feeds, whose `feature_pressures` mean nothing
  film::FilmSolver solver = film::FilmSolver::newton;
  Coupling coupling;
  std::optional<fem::ElasticMaterial> shell_material, journal_material;
  std::optional<DeformingSurface> shell_surface, journal_surface;  ///< unset: rigid
  /// On the mesh of the shell's body, of a shell whose wall is that body (film::BodyWall); else null.
  std::shared_ptr<const fem::FilmSurface> heated_shell;
  /// The surface of the journal's body, for a journal whose wall is that body (film::BodyJournal); else null.
  std::shared_ptr<const fem::FilmSurface> heated_journal;
  OilInertia oil_inertia = OilInertia::none;
  bool moves_with_inertia = false;  ///< in a machine the motion feels that inertia (damper.15)
  std::optional<OperatingPoint> operating_point;
  SourcePosition position;
};

/// Index of the circuit's node that feeds a feature; unset: none does.
[[nodiscard]] inline std::optional<std::size_t> node_of_feature(const Bearing& bearing, std::size_t feature) {
  for (const CircuitPort& port : bearing.circuit_ports)
    if (port.feature == feature) return port.node;
  return std::nullopt;
}

struct Model;

/// A bearing of several films and bodies. In a machine its parts are bodies, joints, forces and bearings of the model
/// like any others; by itself it is a model of its own.
struct Composite {
  Bearing bearing;                     ///< name, size, oil and operating point; its film is that of its first pad
  std::string kind;                    ///< as in the model file, "tilting_pad"
  std::vector<std::string> pads;       ///< names of the bearings that are its films
  std::vector<double> pivot_angles;    ///< of each pad, from the fixed surface's x-axis towards y [rad]
  double pivot_radius = 0;             ///< of pads below a collar: their pivots' distance from the axis [m]
  double whirl_ratio = 1;              ///< frequency over the shaft's at which the parts follow [-]
  std::shared_ptr<const Model> alone;  ///< by itself at its operating point; null: it can only be in its machine
  std::vector<Fault> alone_faults;     ///< why; empty where there is one
};

/// The joint whose driven rotation is the machine's crank angle.
struct Crank {
  std::string joint;
  double speed = 0;          ///< [rad/s], not 0
  double initial_angle = 0;  ///< rotation at t = start [rad]
};

/// Ends the run early once each bearing repeats.
struct Settle {
  double tolerance = 1e-4;  ///< change of the eccentricity ratio between comparisons
  double over = 0;          ///< time between comparisons [s]
};

/// Cycles that are run and discarded before those of the run.
enum class LeadIn {
  none,
  half_grids,  ///< cycles with films on grids of half as many lines and rows, until they repeat
  shooting,    ///< cycles of the run itself, each begun where those before predict that they repeat
};

/// Ends the run early once a cycle repeats the one before.
struct Cycle {
  double period = 0;             ///< [s], > 0
  bool is_period_found = false;  ///< by shooting, beginning with `period`: of a machine that oscillates by itself
  double tolerance = 0.01;       ///< relative difference of the figures of two cycles; 0: all cycles are run
  int most = 20;                 ///< cycles, >= 1
  LeadIn lead_in = LeadIn::none;
  int multipliers = 0;  ///< number of Floquet multipliers to find of the motion that repeats; with LeadIn::shooting
};

/// Steps chosen by their error.
struct ErrorControl {
  double tolerance = 1e-4;  ///< of the local error of a step: see run::StepError
  double smallest = 1e-9;   ///< [s]
  double largest = 0;       ///< [s]
};

/// Kind of analysis of a run.
enum class Analysis {
  dynamics,     ///< motion under forces, integrated over time
  kinematics,   ///< motion that drives prescribe completely, and the forces it takes
  equilibrium,  ///< a state of rest under the loads at the start
  steady,       ///< the steady motion in which drives go on as they do at the start and all else keeps still
  modes,        ///< frequencies and damping of small motions about a state
};

/// The state about which modes are sought.
enum class ModesAbout {
  start,
  equilibrium,
  turning,  ///< the steady motion in which drives go on as they do at the start and all else keeps still
  end,
};

/// Method that integrates the motion over time.
enum class Integrator {
  generalized_alpha,  ///< implicit, second order, damps what steps do not resolve
  dormand_prince,     ///< explicit, eighth order; for rigid bodies without films and contacts
};

/// Initial state of bodies that deform.
enum class InitialDeformation {
  none,      ///< undeformed
  internal,  ///< in equilibrium with their forces between their frames, which keep their undeformed positions
  complete   ///< as forces hold it
};

struct Simulation {
  Analysis analysis = Analysis::dynamics;
  ModesAbout modes_about = ModesAbout::start;
  double start = 0;     ///< [s]
  double duration = 0;  ///< [s], > 0
  double step = 0;      ///< [s], > 0; under error control a hundredth of its largest
  std::optional<ErrorControl> error_control;
  std::optional<Crank> crank;
  InitialDeformation initial_deformation = InitialDeformation::none;
  Integrator integrator = Integrator::generalized_alpha;
  double spectral_radius = 0.8;  ///< of generalized-alpha, 0..1
  double tolerance = 1e-8;       ///< relative, of Newton
  int max_iterations = 50;       ///< of Newton, per step
  double smallest_step = 1e-9;   ///< [s]
  std::optional<Settle> settle;
  std::optional<Cycle> cycle;  ///< then `duration` is at most that of all cycles

  /// Schedule of the checkpoints from which an interrupted run can be resumed.
  struct Checkpoints {
    double every = 0;        ///< simulated time between them [s]; 0: does not count
    double wall_time = 300;  ///< computing time between them [s], > 0
  };
  Checkpoints checkpoint;
  SourcePosition position;

  /// True if the analysis follows a motion over time; the others look at one state.
  [[nodiscard]] bool has_duration() const {
    return analysis == Analysis::dynamics || analysis == Analysis::kinematics ||
           (analysis == Analysis::modes && modes_about == ModesAbout::end);
  }
  /// True if the state looked at is the steady motion of the drives.
  [[nodiscard]] bool is_steady_motion() const {
    return analysis == Analysis::steady || (analysis == Analysis::modes && modes_about == ModesAbout::turning);
  }
};

struct Output {
  int every = 1;                  ///< steps between rows of the time series, >= 1
  double interval = 0;            ///< time between rows of the time series, hit exactly; 0: rows by steps [s]
  double fields_every = 0;        ///< time between stored fields [s]; the reader fills in duration/100
  std::vector<double> meshes_at;  ///< times since the start at which deformed meshes are written, ascending [s]
  SourcePosition position;
};

/// A parameter's value in this run, with overrides applied.
struct Parameter {
  std::string name;
  std::string text;  ///< as written, e.g. "2500 N"
  SourcePosition position;
};

struct Model {
  std::string file;  ///< the path given to the reader
  std::string title, description;
  std::vector<Parameter> parameters;
  Vector3 gravity = Vector3::Zero();  ///< [m/s^2]
  Body ground;                        ///< carries frames only
  std::vector<Body> bodies;           ///< in the order of the file
  std::vector<Joint> joints;
  std::vector<Fmu> fmus;
  std::vector<Drive> drives;
  std::vector<CoordinateCoupling> couplings;
  std::vector<Force> forces;
  std::vector<Contact> contacts;
  std::vector<Lubricant> lubricants;
  Thermal thermal;
  std::optional<OilCircuit> circuit;
  std::vector<Bearing> bearings;
  std::vector<Composite> composites;  ///< whose films are among the bearings if they are in the machine
  ThermalWalls thermal_walls = ThermalWalls::transient;
  Simulation simulation;
  Output output;
  std::optional<Study> study;
  std::vector<Fault> warnings;  ///< implausible values that can be computed
  std::string resolved_text;    ///< the file's text, preceded by comments naming the overrides of this run

  std::map<std::string, std::uint64_t> files;  ///< file names as given in the model, with a hash of their content

  std::map<std::string, SourcePosition> positions;  ///< of every key in the file, by key path

  /// True if the file contains bearings without a machine: they can be solved but not simulated.
  [[nodiscard]] bool is_of_bearings_alone() const { return bodies.empty() && simulation.duration == 0; }

  /// Faces that a contact names; null if it names none that deform.
  [[nodiscard]] const DeformingFaces* find_faces(const ShapeName& name) const;
  /// A shape that a contact names; null if there is none.
  [[nodiscard]] const mbd::ShapeGeometry* find_shape(const ShapeName& name) const;

  /// Location of `path` ("bearings.big_end.radial_clearance"); that of its nearest given parent if it was left out.
  [[nodiscard]] SourcePosition position_of(const std::string& path) const;
};

}  // namespace hersey::model
