#include "answers/scene_parts.h"

#include <algorithm>
#include <exception>
#include <limits>
#include <numbers>
#include <optional>
#include <variant>

#include "hersey/fem/load_vectors.h"
#include "hersey/fem/skin.h"
#include "hersey/mbd/joint.h"

namespace hersey::workbench {
namespace {

constexpr int kSamples =
    720;  // of a function whose largest value is looked for: one for each degree of two revolutions

Json json_of(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

/// Functions that belong together, as components of a vector or as one magnitude, at one instant.
class Functions {
 public:
  Functions(const std::vector<model::Function>& functions, const model::Model& model, const run::Picture& picture)
      : functions_(functions), model_(model), picture_(picture) {}

  [[nodiscard]] bool are_constant() const {
    return std::all_of(functions_.begin(), functions_.end(), [](const auto& f) { return f.is_constant(); });
  }

  /// Values where the first variable has the value `first`, or the one of the start, and all others have that.
  [[nodiscard]] Eigen::VectorXd values(std::optional<double> first) const {
    Eigen::VectorXd values(static_cast<Eigen::Index>(functions_.size()));
    for (std::size_t i = 0; i < functions_.size(); ++i) {
      const model::Function& function = functions_[i];
      std::vector<double> x;
      for (const model::Variable& variable : function.variables) x.push_back(at_start(variable));
      if (first && !x.empty()) x[0] = *first;
      if (function.domain && !x.empty()) x[0] = std::clamp(x[0], function.domain->first, function.domain->second);
      values[static_cast<Eigen::Index>(i)] = function.value->value(x);
    }
    return values;
  }

  /// The largest values that the first variable leads to.
  [[nodiscard]] Eigen::VectorXd largest() const {
    const auto varies =
        std::find_if(functions_.begin(), functions_.end(), [](const auto& f) { return !f.is_constant(); });
    Eigen::VectorXd largest = values({});
    if (varies == functions_.end()) return largest;
    const auto [low, high] = range_of(*varies);
    for (int i = 0; i <= kSamples; ++i) {
      const Eigen::VectorXd now = values(low + (high - low) * i / kSamples);
      if (now.norm() > largest.norm()) largest = now;
    }
    return largest;
  }

 private:
  /// Rates are those that the joint begins with, where they are given.
  [[nodiscard]] double at_start(const model::Variable& variable) const {
    using Of = model::Variable::Kind;
    if (variable.kind == Of::coordinate) return picture_.coordinate(variable.joint, variable.coordinate);
    if (variable.kind == Of::time) return model_.simulation.start;
    for (const model::Joint& joint : model_.joints)
      if (joint.name == variable.joint)
        for (const model::InitialValue& given : joint.initial)
          if (given.coordinate == variable.coordinate + "_rate" && given.value.size() == 1) return given.value[0];
    return 0;
  }

  [[nodiscard]] std::pair<double, double> range_of(const model::Function& function) const {
    if (function.domain) return *function.domain;
    const double from = at_start(function.variables.front());
    if (function.variables.front().kind == model::Variable::Kind::time)
      return {from, from + model_.simulation.duration};
    return {from, from + 4 * std::numbers::pi};  // a cycle of a four-stroke engine
  }

  const std::vector<model::Function>& functions_;
  const model::Model& model_;
  const run::Picture& picture_;
};

/// Adds size and direction: those of the components, or along `direction`.
void add_values(const std::vector<model::Function>& functions, const std::optional<Vector3>& direction,
                const model::Model& model, const run::Picture& picture, Json& load) {
  if (direction) load["direction"] = json_of(*direction);
  const Functions all(functions, model, picture);
  Eigen::VectorXd values;
  std::string when = all.are_constant() ? "always" : "start";
  try {
    values = all.values({});
    if (when == "start" && !(values.norm() > 0)) values = all.largest(), when = "largest";
  } catch (const std::exception&) {
    return;  // a function that has no value there: the check of the start says so
  }
  if (!values.allFinite()) return;
  const bool is_vector = values.size() == 3;
  const double size = is_vector ? values.norm() : std::abs(values[0]);
  load["value"] = size;
  load["when"] = when;
  if (is_vector && size > 0) load["direction"] = json_of(Vector3(values / size));
  if (direction && values[0] < 0) load["direction"] = json_of(-*direction);
}

const model::Body& body_called(const model::Model& model, const std::string& name) {
  for (const model::Body& body : model.bodies)
    if (body.name == name) return body;
  return model.ground;
}

Pose pose_of(const model::Model& model, const model::FrameName& name) {
  for (const model::Frame& frame : body_called(model, name.body).frames)
    if (frame.name == name.frame) return frame.X_BF;
  return {};
}

/// What is drawn of each kind of force.
struct LoadDrawing {
  const model::Model& model;
  const run::Picture& picture;
  Json& load;

  void operator()(const model::BodyLoad& force) const {
    const Pose X_BF = pose_of(model, force.at);
    const bool in_body = force.axes == model::Axes::body;
    load["kind"] = force.is_torque ? "torque" : "force";
    load["body"] = force.at.body;
    load["torque"] = force.is_torque;
    load["at"] = json_of(X_BF.r);
    load["axes"] = in_body ? "body" : "ground";
    load["unit"] = force.is_torque ? "N m" : "N";
    add_values(force.functions, force.direction, model, picture, load);
    if (!in_body || !load.contains("direction")) return;
    const auto direction = load["direction"].get<std::vector<double>>();
    load["direction"] = json_of(X_BF.R * Vector3(direction[0], direction[1], direction[2]));
  }

  void operator()(const model::SurfaceLoad& force) const {
    load["kind"] = force.is_pressure ? "pressure" : "surface_force";
    load["body"] = force.body;
    load["torque"] = false;
    load["axes"] = force.is_pressure || force.axes == model::Axes::body ? "body" : "ground";
    load["unit"] = force.is_pressure ? "Pa" : "N";
    const model::Body& body = body_called(model, force.body);
    if (!body.flexible || !body.flexible->mesh || force.faces.empty()) return;
    const fem::Mesh& mesh = *body.flexible->mesh;
    const Eigen::Matrix3Xd normals = fem::nodal_normals(mesh, force.faces);
    Vector3 normal = Vector3::Zero(), middle = Vector3::Zero();
    double area = 0;
    for (Eigen::Index i = 0; i < normals.cols(); ++i) {
      const double of_node = normals.col(i).norm();
      normal += normals.col(i);
      middle += of_node * mesh.nodes[static_cast<std::size_t>(i)];
      area += of_node;
    }
    load["at"] = json_of(area > 0 ? Vector3(middle / area) : middle);
    std::optional<Vector3> direction = force.direction;
    // A pressure pushes against the outward normals. Where they cancel, as in a whole bore, it has no direction.
    constexpr double kCancels = 1e-3;  // of the area: meshes are not quite round
    if (force.is_pressure) {
      direction.reset();
      if (normal.norm() > kCancels * area) direction = -normal.normalized();
    }
    add_values(force.functions, direction, model, picture, load);
  }

  void operator()(const model::SpringDamper& force) const { between("spring_damper", force); }
  void operator()(const model::Bushing& force) const { between("bushing", force); }
  void operator()(const model::BearingTable& force) const { between("bearing_table", force); }
  void operator()(const model::PistonRing& force) const { between("piston_ring", force); }
  void operator()(const model::CoordinateSpring& force) const {
    on(model::is_rotation(force.on.coordinate) ? "torsion_spring" : "sliding_spring", force.on);
  }
  void operator()(const model::JointFriction& force) const { on("joint_friction", force.on); }
  void operator()(const model::SpeedControl& force) const { on("speed_control", force.on); }
  /// Of kinds without a drawing of their own it is shown what they act on.
  template <class Force>
  requires requires(const Force& force) {
    force.from.body;
    force.to.body;
  }
  void operator()(const Force& force) const { between("between_frames", force); }
  template <class Force>
  requires requires(const Force& force) {
    force.on.joint;
    force.on.coordinate;
  }
  void operator()(const Force& force) const { on("on_coordinate", force.on); }

 private:
  template <class Force>
  void between(const char* kind, const Force& force) const {
    load["kind"] = kind;
    load["from"] = force.from.body;
    load["to"] = force.to.body;
  }
  void on(const char* kind, const model::CoordinateName& name) const {
    load["kind"] = kind;
    load["joint"] = name.joint;
    load["coordinate"] = name.coordinate;
  }
};

}  // namespace

Json loads_json(const model::Model& model, const run::Picture& picture) {
  Json loads = Json::array();
  for (const model::Force& force : model.forces) {
    Json load{{"name", force.name}};
    std::visit(LoadDrawing{model, picture, load}, force.data);
    loads.push_back(std::move(load));
  }
  return loads;
}

Json frames_json(const model::Model& model) {
  Json frames = Json::object();
  const auto add = [&](const std::string& name, const model::Body& body) {
    Json list = Json::array();
    for (const model::Frame& frame : body.frames) {
      const Eigen::Quaterniond turn(frame.X_BF.R);
      list.push_back({{"name", frame.name},
                      {"position", json_of(frame.X_BF.r)},
                      {"orientation", {turn.w(), turn.x(), turn.y(), turn.z()}}});
    }
    if (!list.empty()) frames[name] = std::move(list);
  };
  add("ground", model.ground);
  for (const model::Body& body : model.bodies) add(body.name, body);
  return frames;
}

Json circuit_json(const model::Model& model) {
  const model::OilCircuit& circuit = *model.circuit;
  Json nodes = Json::array(), elements = Json::array(), feeds = Json::array();
  for (std::size_t k = 0; k < circuit.network.nodes.size(); ++k) {
    Json node{{"name", circuit.network.nodes[k].name}, {"given", circuit.network.nodes[k].is_given}};
    const std::optional<model::Function>& given = circuit.pressures[k];
    if (given) {
      try {
        const std::vector<double> start(given->variables.size(), model.simulation.start);
        node["pressure"] = given->value->value(start);
      } catch (const std::exception&) {
        // a function that has no value there: the check of the start says so
      }
    }
    nodes.push_back(std::move(node));
  }
  for (const circuit::Element& element : circuit.network.elements) elements.push_back(element.name);
  for (const model::Bearing& bearing : model.bearings)
    for (const model::CircuitPort& port : bearing.circuit_ports)
      feeds.push_back({{"node", circuit.network.nodes[port.node].name},
                       {"bearing", bearing.name},
                       {"feature", bearing.film.features[port.feature].name}});
  return {{"nodes", std::move(nodes)}, {"elements", std::move(elements)}, {"feeds", std::move(feeds)}};
}

}  // namespace hersey::workbench
