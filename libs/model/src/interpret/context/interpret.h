#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "check/members.h"
#include "hersey/model/model.h"

namespace hersey::model {

/// Common data for the interpretation of checked values. Broken values have been reported: they are read as zero or
/// empty, so that the rest can still be checked; the model is used only if there are no faults.
struct Context {
  const Value& root;
  Model& model;
  std::vector<Fault>& faults;

  /// Reports a fault at a value.
  void fault(const Value& at, std::string found, std::string expected, std::string suggestion = {});
  /// True if a fault has been reported in `path` or below it: its consequences need not be reported again.
  [[nodiscard]] bool has_fault_in(const std::string& path) const;
  /// Reports a fault at the key that opens a value.
  void fault_at_key(const Value& at, std::string found, std::string expected, std::string suggestion = {});
  /// Reports faults of a file that the value `at` names, with their locations in that file.
  void faults_in_file(const Value& at, const std::vector<Fault>& faults_of_file);
  /// Reports warnings in the same way: Model::warnings.
  void warnings_in_file(const Value& at, const std::vector<Fault>& warnings_of_file);
};

/// Path of a file that the model names, which lies relative to the model file; notes its content in Model::files.
[[nodiscard]] std::filesystem::path referenced_file(Context& context, const std::string& name);

/// A direction of length 1. A zero vector is a fault.
[[nodiscard]] Vector3 direction_of(Context& context, const Value& parent, const std::string& key);

/// A frame that exists; reports a fault otherwise.
[[nodiscard]] FrameName frame_of(Context& context, const Value& reference);

/// Reports a fault unless `reference` names an entry of the section `key`; `what` is such an entry, "joint".
void require_name(Context& context, const Value& reference, const std::string& key, const std::string& what);

/// A scalar coordinate of a joint.
struct JointCoordinate {
  std::string name;
  bool rotational = false;
};

/// The scalar coordinates of the joint called `name`; nothing where there is no such joint or its type is broken.
[[nodiscard]] std::optional<std::vector<JointCoordinate>> coordinates_of_joint(const Value& root,
                                                                               const std::string& name);

/// The coordinate given by the keys `joint` and `coordinate` of `parent`; reports a fault where it does not exist.
[[nodiscard]] std::optional<JointCoordinate> coordinate_of(Context& context, const Value& parent);

/// Reports a pressure of a bearing that lies below its cavitation pressure.
void require_above_cavitation(Context& context, const Value& pressure, const film::FilmModel& film);

/// The temperature of a shell that is given, `temperature` of its wall: one, or over the angles of `grid`; reports what
/// is wrong with a table.
[[nodiscard]] film::WallAtTemperature wall_at_temperature(Context& context, const Value& temperature,
                                                          const film::Grid& grid);

/// The node of the network that `wall` names; reports one that is not there.
[[nodiscard]] film::NodeWall node_wall_of(Context& context, const Value& wall);

/// The node called so by a reference; none, reported, where there is no such node.
[[nodiscard]] std::optional<film::NetworkNode> network_node(Context& context, const Value& name);

/// A temperature, of its own or that of a node (which it has at the start).
struct OwnTemperature {
  double T = 0;  ///< [K]
  std::optional<film::NetworkNode> node = {};
};
/// Result of `temperature_or_node`; nothing if the value is missing or broken.
[[nodiscard]] std::optional<OwnTemperature> own_temperature(Context& context, const Value* value);

/// Warns of a temperature beyond what is known of the oil called `oil`.
void warn_of_temperature(Context& context, const Value& T, const OilValidity& validity, const std::string& oil);

/// The film's heat, and its oil at its temperature, of a bearing all else of which has been read. @param lubricant  its
/// oil; null where there is none of that name
void read_thermal(Context& context, const Value& value, const Lubricant* lubricant, Bearing& bearing);

/// Keys of the walls of a film, in `thermal` and in `materials`.
struct WallKeys {
  std::string fixed = "shell", moving = "journal";
};

/// The same of a film between pads and a runner, whose one temperature has been read if it has one.
void read_flat_heat(Context& context, const Value& value, const WallKeys& walls, const Lubricant* lubricant,
                    Bearing& bearing);

/// Features, grid and shape of a bearing whose size and cavitation have been read.
void read_surfaces(Context& context, const Value& value, Bearing& bearing);

/// Index of the node of the circuit that `name` names; reports one that is not there.
[[nodiscard]] std::optional<std::size_t> circuit_node(Context& context, const Value& name);

/// The surface in the table that `file` names, for a bearing of width L [m]; reports what is wrong with it.
[[nodiscard]] std::optional<film::MeasuredShape> measured_shape_of(Context& context, const Value& file, double L,
                                                                   const film::Grid* sides = nullptr);

/// Argument of a function that is neither time nor a joint coordinate: "length", in m.
struct Argument {
  std::string name, unit;
};

/// A joint coordinate or its rate, as expressions name it, and its SI unit.
struct JointVariable {
  Variable variable;
  std::string unit;
};

/// The one called `name`, "main.rotation_rate"; nothing where there is no such joint or coordinate.
[[nodiscard]] std::optional<JointVariable> joint_variable(const Context& context, const std::string& name);

/// A function whose value is wanted in `si_unit`; reports every fault of its expression, table, units and file.
/// @param argument  what alone it depends on; without a name: time and joint coordinates
[[nodiscard]] Function function_of(Context& context, const Value& value, const std::string& si_unit,
                                   const Argument& argument = {});

/// Reports a function that depends on anything but time; `what` is what does, "a drive".
void require_function_of_time(Context& context, const Function& function, const std::string& what);

/// A pair of frames on two different bodies, given by the key `between`.
[[nodiscard]] std::pair<FrameName, FrameName> pair_of(Context& context, const Value& parent);

/// The shapes of a body, or of ground.
[[nodiscard]] std::vector<mbd::Shape> shapes_of(Context& context, const Value& body);

/// The flexible body described by `flexible` of `body`, none where there is no such key; sets nodes and origins of
/// `frames` too. Reports what is wrong with its mesh, materials and frames.
[[nodiscard]] std::optional<Flexible> flexible_of(Context& context, const Value& body, std::vector<Frame>& frames);

/// How a body of that mesh conducts heat and expands; reports unknown surfaces and heat that has nowhere to go.
[[nodiscard]] BodyHeat body_heat_of(Context& context, const Value& value, const fem::Mesh& mesh);

/// The faces of the surface or node set of `mesh` that `name` names; reports where there are none.
[[nodiscard]] std::vector<fem::ElementFace> faces_of(Context& context, const Value& name, const fem::Mesh& mesh);

/// The surface of a bearing's `side`, "shell" or "journal", that lies on the mesh of the body it is fixed to; none
/// where it is rigid or cannot be, which is reported.
[[nodiscard]] std::optional<DeformingSurface> deforming_surface_of(Context& context, const Value& bearing,
                                                                   const std::string& side, const FrameName& on,
                                                                   const film::FilmModel& film);

/// The faces of the shell's body that a film lies on whose shell is that body (`wall: body`); null where it is not, or
/// cannot be, which is reported. @param bearing  all else of it has been read
[[nodiscard]] std::shared_ptr<const fem::FilmSurface> heated_shell_of(Context& context, const Value& value,
                                                                      const Bearing& bearing);
/// The same for the journal.
[[nodiscard]] std::shared_ptr<const fem::FilmSurface> heated_journal_of(Context& context, const Value& value,
                                                                        const Bearing& bearing);

/// Reports a shell and a journal on meshes of different size.
void require_facing_surfaces(Context& context, const Value& value, const Bearing& bearing);

/// A pressure or force on the mesh of a flexible body.
[[nodiscard]] SurfaceLoad surface_load_of(Context& context, const Value& value);

/// Keys of a piston ring, and the ring that they describe; reports a curve of friction that is negative somewhere.
[[nodiscard]] std::vector<Key> piston_ring_keys();
[[nodiscard]] PistonRing piston_ring_of(Context& context, const Value& value);

/// Keys of an unbalance of a shaft, and the unbalance.
[[nodiscard]] std::vector<Key> unbalance_keys();
[[nodiscard]] Unbalance unbalance_of(Context& context, const Value& value);

/// Keys of the mesh of two gear wheels, and the mesh.
[[nodiscard]] std::vector<Key> gear_mesh_keys();
[[nodiscard]] GearMesh gear_mesh_of(Context& context, const Value& value);

/// Keys of a bearing given by its coefficients, and the bearing; reads their file.
[[nodiscard]] std::vector<Key> bearing_table_keys();
[[nodiscard]] BearingTable bearing_table_of(Context& context, const Value& value);

/// Returns the beam described by `beam` of `body`, none if there is no such key, and attaches `frames` to its nodes.
/// Reports faults of its axis, section and frames.
[[nodiscard]] std::optional<Beam> beam_of(Context& context, const Value& body, std::vector<Frame>& frames);

/// Shapes of `body` that are faces of its mesh; `flexible` is null where it is rigid.
[[nodiscard]] std::vector<DeformingFaces> faces_of_body(Context& context, const Value& body, const Flexible* flexible);

/// The whole outer surface, for the report and for contacts.
[[nodiscard]] DeformingFaces skin_of(const fem::Mesh& mesh);

// The sections of the file.
void interpret_bodies(Context& context);
void interpret_joints(Context& context);
/// The section `fmus`. Before all that follows outputs of FMUs.
void interpret_fmus(Context& context);
/// Reports analyses in which FMUs cannot take part. After simulation.
void check_fmus(Context& context);
void interpret_drives(Context& context);
void interpret_couplings(Context& context);
void interpret_forces(Context& context);
void interpret_contacts(Context& context);
void interpret_lubricants(Context& context);
/// The section `thermal`. Before bearings.
void interpret_thermal_network(Context& context);
/// True if a hole over a groove of the circuit joins two features of a bearing, in any order.
[[nodiscard]] bool joins_features(const Model& model, const std::string& bearing, const std::string& a,
                                  const std::string& b);
/// Finds bearing, hole and groove of the circuit's holes over grooves; reports what cannot pass. After bearings.
void find_passing_holes(Context& context);
/// The section `circuit`. After lubricants, before bearings.
void interpret_circuit(Context& context);
/// Reports ports and nodes of the circuit that cannot be solved. After bearings and drives.
void check_circuit(Context& context);
void interpret_bearings(Context& context);
/// Grooves between films. After bearings.
void interpret_grooves(Context& context);
/// Reports nodes of the network to which nothing leads. After bearings.
void check_thermal_network(Context& context);
/// Refuses faces of nodal bodies that carry several films or contacts. After contacts and bearings.
void require_separate_faces(Context& context);
void interpret_simulation(Context& context);
/// Sets the motion of wall temperatures over time. To be called after bearings and simulation.
void interpret_thermal_walls(Context& context);
/// Reports supply pressures, and loads on meshes, that follow a joint other than the crank.
void check_functions_of_crank(Context& context);
void interpret_study(Context& context);

/// A file has all that a simulation needs, or it holds bearings alone; reports what is missing.
void check_completeness(Context& context);

/// Reports tables that do not cover the run, as far as this is known before it: over time, and over driven joints.
void check_table_ranges(Context& context);

}  // namespace hersey::model
