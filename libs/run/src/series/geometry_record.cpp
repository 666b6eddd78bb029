#include "series/geometry_record.h"

#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace hersey::run {
namespace {

using results::Writer;

/// The parts of each kind of shape, in the axes of its body.
template <class Shape>
struct Parts;

template <>
struct Parts<mbd::Sphere> {
  static constexpr const char* name = "sphere";
  [[nodiscard]] static std::vector<Constant<mbd::Sphere>> table() {
    return {{"centre", "m", "centre", "[3]", &mbd::Sphere::centre, Writer::xyz},
            {"radius", "m", "radius", "[1]", &mbd::Sphere::radius}};
  }
};

/// Constants of a cylinder or capsule.
template <class Bar>
[[nodiscard]] std::vector<Constant<Bar>> parts_of_bar() {
  return {{"from", "m", "centre of one end", "[3]", &Bar::from, Writer::xyz},
          {"to", "m", "centre of the other end", "[3]", &Bar::to, Writer::xyz},
          {"radius", "m", "radius", "[1]", &Bar::radius}};
}

template <>
struct Parts<mbd::Cylinder> {
  static constexpr const char* name = "cylinder";
  [[nodiscard]] static std::vector<Constant<mbd::Cylinder>> table() { return parts_of_bar<mbd::Cylinder>(); }
};

template <>
struct Parts<mbd::Capsule> {
  static constexpr const char* name = "capsule";
  [[nodiscard]] static std::vector<Constant<mbd::Capsule>> table() { return parts_of_bar<mbd::Capsule>(); }
};

template <>
struct Parts<mbd::Box> {
  static constexpr const char* name = "box";
  [[nodiscard]] static std::vector<Constant<mbd::Box>> table() {
    return {{"centre", "m", "centre", "[3]", part(&mbd::Box::X_BS, &Pose::r), Writer::xyz},
            {"size", "m", "edges", "[3]", &mbd::Box::size, Writer::xyz},
            {"rotation", "1", "of its edges, row by row", "[9]",
             [](const mbd::Box& box) { return Eigen::Matrix<double, 3, 3, Eigen::RowMajor>(box.X_BS.R); }}};
  }
};

template <>
struct Parts<mbd::HalfSpace> {
  static constexpr const char* name = "half_space";
  [[nodiscard]] static std::vector<Constant<mbd::HalfSpace>> table() {
    return {{"point", "m", "a point of the plane", "[3]", &mbd::HalfSpace::point, Writer::xyz},
            {"normal", "1", "points out of it", "[3]", &mbd::HalfSpace::normal, Writer::xyz}};
  }
};

template <>
struct Parts<mbd::TriangleMesh> {
  static constexpr const char* name = "mesh";
  [[nodiscard]] static std::vector<Constant<mbd::TriangleMesh>> table() {
    return {{"corners", "m", "x, y, z of each corner", "[3 corners]",
             [](const mbd::TriangleMesh& mesh) {
               std::vector<double> corners;
               corners.reserve(3 * mesh.corners.size());
               for (const Vector3& r : mesh.corners) corners.insert(corners.end(), r.data(), r.data() + 3);
               return corners;
             }},
            {"triangles", "1", "corners of each triangle, counted from 0", "[3 triangles]",
             [](const mbd::TriangleMesh& mesh) {
               std::vector<double> triangles;
               triangles.reserve(3 * mesh.triangles.size());
               for (const auto& t : mesh.triangles) triangles.insert(triangles.end(), t.begin(), t.end());
               return triangles;
             }}};
  }
};

/// Writes the parts of one shape.
struct ShapeWriter {
  Writer& writer;
  std::string group;  ///< ends with "/"

  template <class Shape>
  void operator()(const Shape& shape) const {
    writer.attribute(group.substr(0, group.size() - 1), "shape", Parts<Shape>::name);
    write_once(Parts<Shape>::table(), group, shape, writer);
  }
  void operator()(const std::shared_ptr<const mbd::TriangleMesh>& mesh) const { (*this)(*mesh); }
};

void write_shapes(const model::Body& body, const std::string& group, Writer& writer) {
  for (const mbd::Shape& shape : body.shapes)
    std::visit(ShapeWriter{writer, group + "shapes/" + shape.name + "/"}, shape.geometry);
}

template <class Shape>
void describe_parts(QuantityGroup& group) {
  std::vector<Constant<Shape>> table = Parts<Shape>::table();
  QuantityGroup parts;
  run::describe(table, "n", parts);
  for (QuantityInfo& part : parts.quantities) {
    part.note = std::string("of a ") + Parts<Shape>::name;
    group.quantities.push_back(std::move(part));
  }
}

const mbd::FrameSpec& frame(const mbd::MechanismSpec& spec, mbd::FrameId id) {
  return spec.frames[static_cast<std::size_t>(id.index)];
}

FrameOnBody on_body(const mbd::MechanismSpec& spec, mbd::FrameId id) {
  const mbd::FrameSpec& at = frame(spec, id);
  return {spec.bodies[static_cast<std::size_t>(at.body.index)].name, at.X_BF};
}

/// Two bodies that something connects, and where.
struct Link {
  FrameOnBody inboard, outboard;
  Vector3 axis;                      ///< in the axes of the inboard body
  Vector3 x_axis = Vector3::Zero();  ///< x axis of the inboard frame
};

auto body_name(FrameOnBody Link::*end) {
  return [end](const Link& link) { return (link.*end).body; };
}

auto origin(FrameOnBody Link::*end) {
  return [end](const Link& link) -> Vector3 { return (link.*end).X_BF.r; };
}

const std::vector<Attribute<Link>>& link_attributes() {
  static const std::vector<Attribute<Link>> table{
      {"inboard", "", "the body at one end", body_name(&Link::inboard)},
      {"outboard", "", "the body at the other end", body_name(&Link::outboard)},
  };
  return table;
}

/// @param axis  description of the axis
std::vector<Constant<Link>> link_constants(const char* axis) {
  return {{"inboard_origin", "m", "position in the body inboard", "[3]", origin(&Link::inboard), Writer::xyz},
          {"outboard_origin", "m", "position in the body outboard", "[3]", origin(&Link::outboard), Writer::xyz},
          {"axis", "1", axis, "[3]", &Link::axis, Writer::xyz}};
}

const std::vector<Constant<Link>>& joint_constants() {
  static const std::vector<Constant<Link>> table = link_constants("in the axes of the inboard body");
  return table;
}

const std::vector<Constant<Link>>& force_constants() {
  static const std::vector<Constant<Link>> table = [] {
    std::vector<Constant<Link>> constants = link_constants("z-axis of the inboard frame, in its body's axes");
    constants.push_back({"x_axis", "1", "x-axis of the inboard frame, in its body's axes: bearing angles begin there",
                         "[3]", &Link::x_axis, Writer::xyz});
    return constants;
  }();
  return table;
}

const std::vector<Attribute<mbd::JointSpec>>& joint_attributes() {
  static const std::vector<Attribute<mbd::JointSpec>> table{
      {"type", "", "as in the model file",
       [](const mbd::JointSpec& joint) { return std::string(mbd::name_of(joint.type)); }}};
  return table;
}

const std::vector<Constant<mbd::MechanismSpec>>& ground_constants() {
  static const std::vector<Constant<mbd::MechanismSpec>> table{
      {"gravity", "m/s^2", "acceleration of gravity", "[3]", &mbd::MechanismSpec::gravity, Writer::xyz}};
  return table;
}

struct MassPoint {
  double mass = 0;  ///< [kg]
  Vector3 centre;   ///< body axes [m]
};

const std::vector<Attribute<MassPoint>>& body_attributes() {
  static const std::vector<Attribute<MassPoint>> table{{"mass", "kg", "of the body", &MassPoint::mass}};
  return table;
}

const std::vector<Constant<MassPoint>>& body_constants() {
  static const std::vector<Constant<MassPoint>> table{
      {"centre_of_mass", "m", "in the body", "[3]", &MassPoint::centre, Writer::xyz}};
  return table;
}

/// Mass and centre, in its axes, of the elastic body called `name`, which may consist of many pieces.
MassPoint mass_of_elastic(const mbd::MechanismSpec& spec, const std::string& name) {
  double mass = 0;
  Vector3 moment = Vector3::Zero(), origin = Vector3::Zero();  // a piece begins where the one before it ends
  for (const mbd::MechanismSpec::Elastic& elastic : spec.elastics) {
    if (elastic.name != name) continue;
    mass += elastic.body->mass();
    moment += elastic.body->mass() * (origin + elastic.body->centre());
    origin += elastic.body->rest_pose(elastic.body->frame_count() - 1).r;
  }
  return {mass, moment / mass};
}

}  // namespace

void write_ground(const model::Body& ground, const Vector3& gravity, Writer& writer) {
  mbd::MechanismSpec spec;
  spec.gravity = gravity;
  write_once(ground_constants(), "/ground/", spec, writer);
  write_shapes(ground, "/ground/", writer);
}

void write_body(const model::Body& body, double mass, const Vector3& centre_of_mass, Writer& writer) {
  const std::string group = "/bodies/" + body.name + "/";
  const MassPoint point{mass, centre_of_mass};
  write_once(body_attributes(), group, point, writer);
  write_once(body_constants(), group, point, writer);
  write_shapes(body, group, writer);
}

void write_joint_position(const mbd::MechanismSpec& spec, const mbd::JointSpec& joint, Writer& writer) {
  const std::string group = "/joints/" + joint.name + "/";
  const Link link{on_body(spec, joint.inboard), on_body(spec, joint.outboard),
                  frame(spec, joint.inboard).X_BF.R * joint.axis.normalized()};
  write_once(joint_attributes(), group, joint, writer);
  write_once(link_attributes(), group, link, writer);
  write_once(joint_constants(), group, link, writer);
}

void write_link(const std::string& group, const FrameOnBody& inboard, const FrameOnBody& outboard, Writer& writer) {
  const Link link{inboard, outboard, inboard.X_BF.R.col(2), inboard.X_BF.R.col(0)};
  write_once(link_attributes(), group, link, writer);
  write_once(force_constants(), group, link, writer);
}

void write_geometry(const model::Model& model, const mbd::MechanismSpec& spec, const std::vector<bool>& hidden_joints,
                    Writer& writer) {
  write_ground(model.ground, spec.gravity, writer);
  for (const model::Body& body : model.bodies) {
    const MassPoint mass =
        body.flexible || body.beam ? mass_of_elastic(spec, body.name) : MassPoint{body.mass, body.centre_of_mass};
    write_body(body, mass.mass, mass.centre, writer);
  }
  for (std::size_t j = 0; j < spec.joints.size(); ++j)
    if (!hidden_joints[j]) write_joint_position(spec, spec.joints[j], writer);
  for (const mbd::MechanismSpec::Force& force : spec.forces) {
    // Films and contacts are named as they are in messages, "bearing big_end".
    std::string group = "/forces/" + force.name + "/";
    for (const std::string kind : {"bearing", "contact"})
      if (force.name.starts_with(kind + " ")) group = "/" + kind + "s/" + force.name.substr(kind.size() + 1) + "/";
    write_link(group, on_body(spec, force.a), on_body(spec, force.b), writer);
  }
}

void describe_link(QuantityGroup& group) {
  describe(link_attributes(), "n", group);
  describe(force_constants(), "n", group);
}

void describe_joint_position(QuantityGroup& group) {
  describe(joint_attributes(), "n", group);
  describe(link_attributes(), "n", group);
  describe(joint_constants(), "n", group);
}

void describe_mass(QuantityGroup& group) {
  describe(body_attributes(), "n", group);
  describe(body_constants(), "n", group);
}

QuantityGroup describe_ground() {
  QuantityGroup group{.path = "/ground/", .heading = "of ground", .quantities = {}};
  describe(ground_constants(), "n", group);
  return group;
}

QuantityGroup describe_shapes(const char* path) {
  QuantityGroup group{.path = path, .heading = "of a shape, in the axes of its body", .quantities = {}};
  group.quantities.push_back({.name = "shape",
                              .unit = "",
                              .text = "what it is: `sphere`, `cylinder`, `capsule`, `box`, `half_space` or `mesh`",
                              .kind = QuantityInfo::Kind::attribute});
  describe_parts<mbd::Sphere>(group);
  describe_parts<mbd::Cylinder>(group);
  describe_parts<mbd::Capsule>(group);
  describe_parts<mbd::Box>(group);
  describe_parts<mbd::HalfSpace>(group);
  describe_parts<mbd::TriangleMesh>(group);
  return group;
}

}  // namespace hersey::run
