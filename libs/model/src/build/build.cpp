#include "hersey/model/build.h"

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "build/build_beam.h"
#include "build/build_flexible.h"
#include "hersey/bearing/film_inertia.h"
#include "hersey/bearing/journal_bearing.h"
#include "hersey/core/contract.h"
#include "hersey/fem/load_distributions.h"
#include "hersey/mbd/coordinate_laws.h"
#include "hersey/mbd/unbalance.h"
#include "hersey/model/wall_conduction.h"

namespace hersey::model {
namespace {

// A function of time and of the crank's rotation as one of time alone: the crank rotates at constant speed.
class OverTime final : public ScalarFunction {
 public:
  OverTime(Function function, const Simulation& simulation) : function_(std::move(function)), simulation_(simulation) {}

  [[nodiscard]] double value(std::span<const double> t) const override {
    std::vector<double> x;
    for (const Variable& variable : function_.variables) x.push_back(argument(variable.kind, t[0]));
    return function_.value->value(x);
  }
  void gradient(std::span<const double> t, std::span<double> gradient) const override {
    std::vector<double> x, by_x(function_.variables.size());
    for (const Variable& variable : function_.variables) x.push_back(argument(variable.kind, t[0]));
    function_.value->gradient(x, by_x);
    gradient[0] = 0;
    for (std::size_t i = 0; i < by_x.size(); ++i) gradient[0] += by_x[i] * rate(function_.variables[i].kind);
  }
  [[nodiscard]] double second_derivative(std::span<const double> t) const override {
    const double d = 1e-6, now = t[0], before = now - d, after = now + d;
    return (value({&before, 1}) - 2 * value(t) + value({&after, 1})) / (d * d);
  }

 private:
  [[nodiscard]] double argument(Variable::Kind kind, double t) const {
    if (kind == Variable::Kind::time) return t;
    if (kind == Variable::Kind::rate) return simulation_.crank->speed;
    return simulation_.crank->initial_angle + simulation_.crank->speed * (t - simulation_.start);
  }
  [[nodiscard]] double rate(Variable::Kind kind) const {
    if (kind == Variable::Kind::time) return 1;
    return kind == Variable::Kind::rate ? 0 : simulation_.crank->speed;
  }

  Function function_;
  Simulation simulation_;
};

// offset + slope x
class Line final : public ScalarFunction {
 public:
  Line(double offset, double slope) : offset_(offset), slope_(slope) {}
  [[nodiscard]] double value(std::span<const double> x) const override { return offset_ + slope_ * x[0]; }
  void gradient(std::span<const double>, std::span<double> gradient) const override { gradient[0] = slope_; }
  [[nodiscard]] double second_derivative(std::span<const double>) const override { return 0; }

 private:
  double offset_, slope_;
};

mbd::DriveSpec::Kind drive_kind(Drive::Prescribes prescribes) {
  switch (prescribes) {
    case Drive::Prescribes::position:
      return mbd::DriveSpec::Kind::position;
    case Drive::Prescribes::speed:
      return mbd::DriveSpec::Kind::speed;
    case Drive::Prescribes::acceleration:
      return mbd::DriveSpec::Kind::acceleration;
  }
  HERSEY_REQUIRE(false, "every kind of drive is listed");
}

// Walks the model once, in the order in which parts refer to each other.
class Builder {
 public:
  explicit Builder(const Model& model) : model_(model) {}

  Machine build() {
    mechanism_.set_gravity(model_.gravity);
    if (model_.simulation.spectral_radius < 1) mechanism_.cut_paths();
    if (model_.simulation.analysis == Analysis::dynamics) mechanism_.choose_roots();
    if (starts_undeformed()) mechanism_.loosen_beams();
    add_frames(model_.ground, mbd::MechanismBuilder::ground());
    for (const Body& body : model_.bodies) {
      if (body.flexible) {
        add_flexible(body);
        continue;
      }
      if (body.beam) {
        add_beam(body);
        continue;
      }
      add_frames(body, mechanism_.add_body({body.name, body.mass, body.centre_of_mass, body.inertia}));
    }
    for (const Joint& joint : model_.joints) add_joint(joint);
    for (const Drive& drive : model_.drives) add_drive(drive);
    for (const CoordinateCoupling& coupling : model_.couplings) add_coupling(coupling);
    for (const Force& force : model_.forces) add_force(force);
    for (const Contact& contact : model_.contacts) add_contact(contact);
    for (const Bearing& bearing : model_.bearings) add_bearing(bearing);
    if (model_.circuit) add_circuit(*model_.circuit);
    add_network();
    machine_.grooves = model_.thermal.grooves;
    machine_.frames = frames_;
    machine_.mechanism = mechanism_.finalise();
    return std::move(machine_);
  }

 private:
  [[nodiscard]] bool starts_undeformed() const {
    return model_.simulation.analysis == Analysis::dynamics &&
           model_.simulation.initial_deformation == InitialDeformation::none;
  }

  void add_frames(const Body& body, mbd::BodyId id) {
    const std::string name = id == mbd::MechanismBuilder::ground() ? "ground" : body.name;
    bodies_[name] = id;
    frames_[{name, ""}] = mechanism_.frame_of(id);
    poses_[{name, ""}] = Pose{};
    for (const Frame& frame : body.frames) {
      frames_[{name, frame.name}] = mechanism_.add_frame({frame.name, id, frame.X_BF});
      poses_[{name, frame.name}] = frame.X_BF;
    }
  }

  void add_flexible(const Body& body) {
    const std::vector<const DeformingSurface*> surfaces = surfaces_on(model_, body);
    std::vector<BuiltSurface> kept;
    BuiltFlexible built = build_flexible(body, surfaces, starts_undeformed(), kept);
    for (std::size_t i = 0; i < surfaces.size(); ++i) kept_[surfaces[i]] = kept[i];
    std::vector<std::string> names;
    for (std::size_t i = 1; i < body.frames.size(); ++i) names.push_back(body.frames[i].name);
    const mbd::FlexibleBodyIds ids = mechanism_.add_flexible_body(body.name, names, built.body);
    bodies_[body.name] = ids.bodies[0];
    frames_[{body.name, ""}] = ids.frames[0];
    poses_[{body.name, ""}] = Pose{};
    for (std::size_t i = 0; i < body.frames.size(); ++i) {
      // The first frame rides on the body's axes, the others on their own with the mesh's axes.
      Pose X = body.frames[i].X_BF;
      if (i > 0) X.r.setZero();
      frames_[{body.name, body.frames[i].name}] = mechanism_.add_frame({body.frames[i].name, ids.bodies[i], X});
      poses_[{body.name, body.frames[i].name}] = X;
    }
    built.elastic = ids.elastic;
    machine_.flexibles.push_back(std::move(built));
  }

  void add_beam(const Body& body) {
    BuiltBeam built = build_beam(body, mechanism_);
    bodies_[body.name] = built.ids.bodies[0];
    frames_[{body.name, ""}] = built.ids.frames[0];
    poses_[{body.name, ""}] = Pose{};
    for (const Frame& frame : body.frames) {
      const Pose X{frame.X_BF.R, Vector3::Zero()};  // nodes keep the body's axes
      const mbd::BodyId node = built.ids.bodies[static_cast<std::size_t>(frame.nodes.front())];
      frames_[{body.name, frame.name}] = mechanism_.add_frame({frame.name, node, X});
      poses_[{body.name, frame.name}] = X;
    }
    machine_.beams.push_back(std::move(built));
  }

  [[nodiscard]] mbd::FrameId frame(const FrameName& name) const { return frames_.at({name.body, name.frame}); }

  // Values of all of a joint's coordinates (or their rates), and which of them are not given; empty if none is known.
  struct StartingValues {
    std::vector<double> values;
    std::vector<bool> loose;

    void take(const InitialValue& known, const mbd::Coordinate& coordinate, int count, bool is_given) {
      values.resize(static_cast<std::size_t>(count), 0.0);
      loose.resize(static_cast<std::size_t>(count), true);
      std::copy(known.value.begin(), known.value.end(), values.begin() + coordinate.offset);
      std::fill_n(loose.begin() + coordinate.offset, coordinate.size, !is_given);
    }
  };

  static StartingValues starting_values(const Joint& joint, bool rates) {
    const JointType type = joint.type;
    const int count = mbd::degrees_of_freedom(type);
    StartingValues known;
    for (const mbd::Coordinate& coordinate : mbd::coordinates_of(type)) {
      const std::string name(rates ? mbd::rate_name(coordinate) : coordinate.name);
      for (const InitialValue& value : joint.guess)
        if (value.coordinate == name) known.take(value, coordinate, count, false);
      for (const InitialValue& value : joint.initial)
        if (value.coordinate == name) known.take(value, coordinate, count, true);
    }
    return known;
  }

  void add_joint(const Joint& joint) {
    StartingValues position = starting_values(joint, false), rate = starting_values(joint, true);
    const mbd::JointId id = mechanism_.add_joint({.name = joint.name,
                                                  .type = joint.type,
                                                  .inboard = frame(joint.inboard),
                                                  .outboard = frame(joint.outboard),
                                                  .axis = joint.axis,
                                                  .lead = joint.lead,
                                                  .initial = std::move(position.values),
                                                  .initial_rate = std::move(rate.values),
                                                  .loose = std::move(position.loose),
                                                  .loose_rate = std::move(rate.loose)});
    joints_[joint.name] = {id, joint.type};
  }

  [[nodiscard]] mbd::CoordinateRef coordinate(const std::string& joint, const std::string& name) const {
    const auto& [id, type] = joints_.at(joint);
    const auto found = mbd::find_coordinate(type, name);
    HERSEY_REQUIRE(found && found->size == 1, "the reader checks coordinates");
    return {id, found->offset};
  }

  [[nodiscard]] mbd::CoordinateRef coordinate(const CoordinateName& name) const {
    return coordinate(name.joint, name.coordinate);
  }

  void add_drive(const Drive& drive) {
    mechanism_.add_drive({.name = drive.name,
                          .coordinate = coordinate(drive.joint, drive.coordinate),
                          .kind = drive_kind(drive.prescribes),
                          .function = drive.motion.value,
                          .ramp = drive.ramp,
                          .start = model_.simulation.start});
  }

  [[nodiscard]] mbd::LoadTerm term(const Function& function, const Vector6& direction) const {
    mbd::LoadTerm term{.direction = direction, .magnitude = function.value, .variables = {}};
    for (const Variable& variable : function.variables) {
      mbd::Variable argument;
      if (variable.kind != Variable::Kind::time) {
        argument.kind =
            variable.kind == Variable::Kind::rate ? mbd::Variable::Kind::rate : mbd::Variable::Kind::position;
        argument.coordinate = coordinate(variable.joint, variable.coordinate);
      }
      term.variables.push_back(argument);
    }
    return term;
  }

  void add(const std::string& name, const BodyLoad& load) {
    // The mechanism takes the body's axes, the file those of the frame named.
    const Matrix3 R = load.axes == Axes::body ? poses_.at({load.at.body, load.at.frame}).R : Matrix3::Identity();
    const int first = load.is_torque ? 0 : 3;
    mbd::LoadSpec spec{.name = name,
                       .frame = frame(load.at),
                       .axes = load.axes == Axes::body ? mbd::LoadAxes::body : mbd::LoadAxes::ground,
                       .terms = {}};
    for (std::size_t i = 0; i < load.functions.size(); ++i) {
      Vector6 direction = Vector6::Zero();
      direction.segment<3>(first) = R * load.direction.value_or(Vector3::Unit(static_cast<Eigen::Index>(i)));
      spec.terms.push_back(term(load.functions[i], direction));
    }
    mechanism_.add_load(std::move(spec));
  }

  // Index among the machine's flexible bodies.
  [[nodiscard]] std::size_t flexible_called(const std::string& name) const {
    const auto at = std::find_if(machine_.flexibles.begin(), machine_.flexibles.end(),
                                 [&](const BuiltFlexible& flexible) { return flexible.name == name; });
    HERSEY_REQUIRE(at != machine_.flexibles.end(), "the reader checks bodies");
    return static_cast<std::size_t>(at - machine_.flexibles.begin());
  }

  void add(const std::string& name, const SurfaceLoad& load) {
    const std::size_t at = flexible_called(load.body);
    const BuiltFlexible& flexible = machine_.flexibles[at];
    const std::size_t first = mechanism_.nodal_loads(flexible.elastic);
    for (std::size_t i = 0; i < load.functions.size(); ++i)
      mechanism_.add_nodal_load(flexible.elastic, nodal_load(name, load, *flexible.mesh, i),
                                std::make_shared<OverTime>(load.functions[i], model_.simulation));
    machine_.surface_loads.push_back({name, at, first, load.functions.size()});
  }

  // Unit load by which the value `i` of a surface load is multiplied.
  static mbd::NodalLoad nodal_load(const std::string& name, const SurfaceLoad& load, const fem::Mesh& mesh,
                                   std::size_t i) {
    Eigen::VectorXd f;
    if (load.is_pressure)
      f = load.direction ? fem::cosine_pressure_load(mesh, load.faces, *load.direction)
                         : fem::pressure_load(mesh, load.faces, 1);
    else
      f = fem::spread_force(mesh, load.faces, load.direction.value_or(Vector3::Unit(static_cast<Eigen::Index>(i))));
    return {name, load.axes == Axes::ground ? mbd::LoadAxes::ground : mbd::LoadAxes::body,
            Eigen::Map<const Eigen::Matrix3Xd>(f.data(), 3, f.size() / 3)};
  }

  void add_force(const Force& force) {
    std::visit([&](const auto& data) { add(force.name, data); }, force.data);
  }

  /// Whatever acts between two frames, or on a coordinate, and makes itself.
  template <class Law>
  void add(const std::string& name, const Law& law) {
    if constexpr (requires { law.from; })
      mechanism_.add_force(name, frame(law.from), frame(law.to), law.made());
    else
      mechanism_.add_coordinate_force(name, coordinate(law.on), law.made());
  }

  void add(const std::string& name, const Unbalance& law) {
    const double begins = law.begins.value_or(-std::numeric_limits<double>::infinity());
    mechanism_.add_force(name, frame(law.from), frame(law.to),
                         std::make_shared<mbd::Unbalance>(law.moment, model_.gravity, begins));
  }

  void add(const std::string& name, const PistonRing& ring) {
    mbd::PistonRing::Data data = ring.data;
    if (ring.gas) data.gas = std::make_shared<OverTime>(*ring.gas, model_.simulation);
    const auto made = std::make_shared<mbd::PistonRing>(std::move(data));
    machine_.rings.push_back({name, mechanism_.add_force(name, frame(ring.from), frame(ring.to), made), made});
  }

  void add(const std::string& name, const GearMesh& mesh) {
    const auto made = std::make_shared<mbd::GearMesh>(mesh.data);
    machine_.gear_meshes.push_back({name, mechanism_.add_force(name, frame(mesh.from), frame(mesh.to), made), made});
  }

  void add(const std::string& name, const CoordinateSpring& spring) {
    mechanism_.add_spring({.name = name,
                           .coordinate = coordinate(spring.on),
                           .stiffness = spring.stiffness,
                           .damping = spring.damping,
                           .free_position = spring.free_position});
    if (spring.restoring)
      mechanism_.add_coordinate_force(
          name, coordinate(spring.on),
          std::make_shared<mbd::FunctionSpring>(spring.restoring->value, spring.free_position));
  }

  // Where a scalar coordinate starts.
  [[nodiscard]] double initial_value(const CoordinateName& name) const {
    for (const Joint& joint : model_.joints) {
      if (joint.name != name.joint) continue;
      for (const std::vector<InitialValue>* values : {&joint.initial, &joint.guess})
        for (const InitialValue& value : *values)
          if (value.coordinate == name.coordinate) return value.value.front();
    }
    return 0;
  }

  void add_coupling(const CoordinateCoupling& coupling) {
    mbd::CouplingSpec spec{.name = coupling.name, .output = coordinate(coupling.output), .terms = {}};
    // Gears mesh where the joints start; a relation says where.
    double offset = initial_value(coupling.output);
    for (const CoordinateCoupling::Term& term : coupling.terms) offset -= term.factor * initial_value(term.input);
    for (const CoordinateCoupling::Term& term : coupling.terms) {
      if (term.function) {
        spec.terms.push_back({coordinate(term.input), term.function->value});
      } else {
        spec.terms.push_back({coordinate(term.input), std::make_shared<Line>(offset, term.factor)});
        offset = 0;
      }
    }
    mechanism_.add_coupling(std::move(spec));
  }

  // Displacements of some nodes, (3 nodes, shapes), of those of all nodes of a mesh.
  static Eigen::MatrixXd rows_of(const Eigen::MatrixXd& displacements, const std::vector<int>& nodes) {
    Eigen::MatrixXd some(3 * static_cast<Eigen::Index>(nodes.size()), displacements.cols());
    for (std::size_t i = 0; i < nodes.size(); ++i)
      some.middleRows<3>(3 * static_cast<Eigen::Index>(i)) = displacements.middleRows<3>(3 * nodes[i]);
    return some;
  }

  void add_contact(const Contact& contact) {
    const mbd::ShapeGeometry *first = model_.find_shape(contact.first), *second = model_.find_shape(contact.second);
    HERSEY_REQUIRE(first != nullptr && second != nullptr, "the reader checks shapes");
    const mbd::FrameId a = frames_.at({contact.first.body, ""}), b = frames_.at({contact.second.body, ""});
    std::shared_ptr<mbd::Contact> force;
    mbd::ForceSurfaces surfaces;
    if (const DeformingFaces* faces = model_.find_faces(contact.second)) {
      const BuiltFlexible& flexible = machine_.flexibles[flexible_called(contact.second.body)];
      surfaces.b = flexible.elastic;
      force = std::make_shared<mbd::Contact>(*first,
                                             std::get<std::shared_ptr<const mbd::TriangleMesh>>(faces->shape.geometry),
                                             rows_of(flexible.body->data().displacements, faces->nodes), contact.law);
    } else {
      force = std::make_shared<mbd::Contact>(*first, *second, contact.law);
    }
    const mbd::ForceId id = mechanism_.add_force("contact " + contact.name, a, b, force, surfaces);
    machine_.contacts.push_back({std::move(force), id, bodies_.at(contact.first.body)});
  }

  // A bearing's surface by the shapes of its flexible body, in the axes of the bearing's frame.
  [[nodiscard]] std::shared_ptr<const bearing::ElasticSurface> surface_of(const DeformingSurface& surface,
                                                                          const FrameName& on) const {
    const BuiltFlexible& flexible = machine_.flexibles[flexible_called(on.body)];
    const auto body =
        std::find_if(model_.bodies.begin(), model_.bodies.end(), [&](const Body& b) { return b.name == on.body; });
    return elastic_surface(surface, *body, on.frame, flexible.body->data().displacements);
  }

  void add_bearing(const Bearing& bearing) {
    bearing::BearingOptions options;
    options.coupling = bearing.coupling.scheme == CouplingScheme::partitioned ? bearing::Coupling::partitioned
                                                                              : bearing::Coupling::monolithic;
    options.acceleration = bearing.coupling.acceleration;
    options.relaxation = bearing.coupling.relaxation;
    options.film.solver = bearing.solver;
    options.initial_dt = model_.simulation.step;
    options.initial_fill = bearing.initial_fill;
    options.starts_steady = !model_.simulation.has_duration();
    if (const auto* heat = std::get_if<film::ThermalModel>(&bearing.heat)) {
      options.thermal = *heat;
      if (auto* body = std::get_if<film::BodyWall>(&options.thermal->shell))
        body->conduction = wall_conduction(model_, bearing);
      if (auto* body = std::get_if<film::BodyJournal>(&options.thermal->journal))
        body->conduction = journal_conduction(model_, bearing);
    }
    options.growth = bearing.growth;
    options.wear = bearing.wear;
    if (bearing.wear && !bearing.worn_group.empty()) {
      std::shared_ptr<bearing::CommonSurface>& common = worn_groups_[bearing.worn_group];
      if (!common) common = std::make_shared<bearing::CommonSurface>();
      options.common = common;
    }
    if (bearing.moves_with_inertia)
      options.inertia = std::make_shared<bearing::FilmInertia>(bearing.film, momentum_factor(bearing.oil_inertia));
    for (const Function& pressure : bearing.feature_pressures) {
      options.feature_pressures.push_back(std::make_shared<OverTime>(pressure, model_.simulation));
    }
    for (const CircuitPort& port : bearing.circuit_ports) options.circuit_ports.push_back(port.feature);
    BuiltBearing built;
    mbd::ForceSurfaces surfaces;
    if (bearing.shell_surface) {
      options.shell_surface = surface_of(*bearing.shell_surface, bearing.shell);
      surfaces.a = machine_.flexibles[flexible_called(bearing.shell.body)].elastic;
      built.shell = kept_.at(&*bearing.shell_surface);
    }
    if (bearing.journal_surface) {
      options.journal_surface = surface_of(*bearing.journal_surface, bearing.journal);
      surfaces.b = machine_.flexibles[flexible_called(bearing.journal.body)].elastic;
      built.journal = kept_.at(&*bearing.journal_surface);
    }
    const bool journal_changes =
        options.journal_surface != nullptr || (bearing.wear && bearing.wear->around == bearing::WearAround::local);
    built.bearing = std::make_shared<bearing::FilmForce>(bearing.name, bearing.film,
                                                         bearing.kind->gap(bearing.film, journal_changes), options);
    built.force = mechanism_.add_force("bearing " + bearing.name, frame(bearing.shell), frame(bearing.journal),
                                       built.bearing, surfaces);
    machine_.bearings.push_back(std::move(built));
  }

  void add_network() {
    film::ThermalNetworkModel network = model_.thermal.network;
    if (model_.circuit && model_.circuit->temperatures)
      for (const film::ThermalNode& node : model_.circuit->temperatures->added) network.nodes.push_back(node);
    if (!network.nodes.empty()) machine_.network.emplace(std::move(network));
  }

  static std::optional<bearing::CircuitHeat> heat_of(const OilCircuit& circuit) {
    if (!circuit.temperatures) return std::nullopt;
    const CircuitTemperatures& given = *circuit.temperatures;
    return bearing::CircuitHeat{
        .heat_capacity = given.heat_capacity,
        .law = given.law,
        .nodes = given.nodes,
        .coolants = given.coolants,
        .T = Eigen::Map<const Eigen::VectorXd>(given.T.data(), static_cast<Eigen::Index>(given.T.size()))};
  }

  void add_circuit(const OilCircuit& circuit) {
    std::vector<bearing::CircuitFilm> films;
    std::vector<std::size_t> film_of_bearing(model_.bearings.size());
    for (std::size_t i = 0; i < model_.bearings.size(); ++i) {
      if (model_.bearings[i].circuit_ports.empty()) continue;
      const BuiltBearing& built = machine_.bearings[i];
      film_of_bearing[i] = films.size();
      films.push_back({.film = built.bearing, .force = static_cast<std::size_t>(built.force.index), .nodes = {}});
      for (const CircuitPort& port : model_.bearings[i].circuit_ports) films.back().nodes.push_back(port.node);
    }
    std::vector<std::shared_ptr<const ScalarFunction>> given;
    for (const std::optional<Function>& pressure : circuit.pressures)
      given.push_back(pressure ? std::make_shared<OverTime>(*pressure, model_.simulation) : nullptr);
    std::vector<bearing::CircuitShaft> shafts;
    std::vector<mbd::CoordinateRef> coordinates;
    for (const CircuitShaft& shaft : circuit.shafts) {
      shafts.push_back({.offset = shaft.speed, .factor = shaft.ratio});
      if (!shaft.on) continue;
      shafts.back().coordinate = coordinates.size();
      coordinates.push_back(coordinate(*shaft.on));
    }
    std::vector<bearing::CircuitHole> holes;
    for (const CircuitHole& hole : circuit.holes) {
      const std::vector<film::SurfaceFeature>& features = model_.bearings[hole.of_bearing].film.features;
      holes.push_back({.film = film_of_bearing[hole.of_bearing],
                       .hole = features[hole.hole_feature],
                       .groove = features[hole.groove_feature]});
    }
    machine_.circuit = std::make_shared<bearing::OilCircuit>(circuit.network, std::move(films), std::move(given),
                                                             std::move(shafts), std::move(holes), heat_of(circuit));
    mechanism_.add_shared_unknowns("circuit", machine_.circuit, std::move(coordinates));
    for (const circuit::Element& element : circuit.network.elements)
      if (element.shaft && circuit.shafts[*element.shaft].on)
        mechanism_.add_coordinate_force("circuit_" + element.name, coordinate(*circuit.shafts[*element.shaft].on),
                                        std::make_shared<bearing::CircuitTorque>(machine_.circuit, *element.shaft));
  }

  const Model& model_;
  mbd::MechanismBuilder mechanism_;
  Machine machine_;
  std::map<const DeformingSurface*, BuiltSurface> kept_;  // parts of bearings' surfaces that flexible bodies keep
  std::map<std::string, std::shared_ptr<bearing::CommonSurface>> worn_groups_;
  std::map<std::string, mbd::BodyId> bodies_;
  std::map<std::pair<std::string, std::string>, mbd::FrameId> frames_;
  std::map<std::pair<std::string, std::string>, Pose> poses_;
  std::map<std::string, std::pair<mbd::JointId, mbd::JointType>> joints_;
};

}  // namespace

Machine build(const Model& model) { return Builder(model).build(); }

}  // namespace hersey::model
