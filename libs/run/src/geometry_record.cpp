#include "geometry_record.h"

#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace hersey::run {
namespace {

/// Writes the parts of one shape, in body axes.
class ShapeWriter {
 public:
  ShapeWriter(results::Writer& writer, std::string group) : writer_(writer), group_(std::move(group)) {}

  void operator()(const mbd::Sphere& s) const {
    kind("sphere");
    point("centre", s.centre, "centre");
    length("radius", s.radius);
  }
  void operator()(const mbd::Cylinder& s) const { bar("cylinder", s.from, s.to, s.radius); }
  void operator()(const mbd::Capsule& s) const { bar("capsule", s.from, s.to, s.radius); }
  void operator()(const mbd::Box& s) const {
    kind("box");
    point("centre", s.X_BS.r, "centre");
    point("size", s.size, "edges");
    const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rows = s.X_BS.R;
    writer_.constant(group_ + "/rotation", {rows.data(), 9}, "1", "of its edges, row by row");
  }
  void operator()(const mbd::HalfSpace& s) const {
    kind("half_space");
    point("point", s.point, "a point of the plane");
    writer_.constant(group_ + "/normal", {s.normal.data(), 3}, "1", "points out of it", results::Writer::xyz);
  }
  void operator()(const std::shared_ptr<const mbd::TriangleMesh>& s) const {
    kind("mesh");
    std::vector<double> corners, triangles;
    corners.reserve(3 * s->corners.size());
    triangles.reserve(3 * s->triangles.size());
    for (const Vector3& r : s->corners) corners.insert(corners.end(), r.data(), r.data() + 3);
    for (const auto& t : s->triangles) triangles.insert(triangles.end(), t.begin(), t.end());
    writer_.constant(group_ + "/corners", corners, "m", "x, y, z of each corner");
    writer_.constant(group_ + "/triangles", triangles, "1", "corners of each triangle, counted from 0");
  }

 private:
  void kind(const char* name) const { writer_.attribute(group_, "shape", name); }
  void point(const char* name, const Vector3& r, const char* description) const {
    writer_.constant(group_ + "/" + name, {r.data(), 3}, "m", description, results::Writer::xyz);
  }
  void length(const char* name, double value) const { writer_.constant(group_ + "/" + name, {&value, 1}, "m", name); }
  void bar(const char* name, const Vector3& from, const Vector3& to, double radius) const {
    kind(name);
    point("from", from, "centre of one end");
    point("to", to, "centre of the other end");
    length("radius", radius);
  }

  results::Writer& writer_;
  std::string group_;
};

void write_shapes(const model::Body& body, const std::string& group, results::Writer& writer) {
  for (const mbd::Shape& shape : body.shapes) {
    std::visit(ShapeWriter(writer, group + "/shapes/" + shape.name), shape.geometry);
  }
}

const mbd::FrameSpec& frame(const mbd::MechanismSpec& spec, mbd::FrameId id) {
  return spec.frames[static_cast<std::size_t>(id.index)];
}

/// Which two bodies something connects, and where.
void write_link(const mbd::MechanismSpec& spec, const std::string& group, mbd::FrameId a, mbd::FrameId b,
                results::Writer& writer) {
  const auto end = [&](const std::string& which, mbd::FrameId id) {
    const mbd::FrameSpec& f = frame(spec, id);
    writer.attribute(group, which, spec.bodies[static_cast<std::size_t>(f.body.index)].name);
    writer.constant(group + "/" + which + "_origin", {f.X_BF.r.data(), 3}, "m", "place in the body " + which,
                    results::Writer::xyz);
  };
  end("inboard", a);
  end("outboard", b);
}

/// Mass and centre, in its axes, of the elastic body called `name`, whose pieces may be many.
std::pair<double, Vector3> mass_of_elastic(const mbd::MechanismSpec& spec, const std::string& name) {
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

void write_geometry(const model::Model& model, const mbd::MechanismSpec& spec, const std::vector<bool>& hidden_joints,
                    results::Writer& writer) {
  writer.constant("/ground/gravity", {spec.gravity.data(), 3}, "m/s^2", "acceleration of gravity",
                  results::Writer::xyz);
  write_shapes(model.ground, "/ground", writer);
  for (const model::Body& body : model.bodies) {
    const std::string group = "/bodies/" + body.name;
    double mass = body.mass;
    Vector3 centre = body.centre_of_mass;
    if (body.flexible || body.beam) std::tie(mass, centre) = mass_of_elastic(spec, body.name);
    writer.attribute(group, "mass", mass);
    writer.constant(group + "/centre_of_mass", {centre.data(), 3}, "m", "in the body", results::Writer::xyz);
    write_shapes(body, group, writer);
  }
  for (std::size_t j = 0; j < spec.joints.size(); ++j) {
    if (hidden_joints[j]) continue;
    const mbd::JointSpec& joint = spec.joints[j];
    const std::string group = "/joints/" + joint.name;
    writer.attribute(group, "type", std::string(mbd::name_of(joint.type)));
    write_link(spec, group, joint.inboard, joint.outboard, writer);
    const Vector3 axis = frame(spec, joint.inboard).X_BF.R * joint.axis.normalized();
    writer.constant(group + "/axis", {axis.data(), 3}, "1", "in the axes of the inboard body", results::Writer::xyz);
  }
  for (const mbd::MechanismSpec::Force& force : spec.forces) {
    // Films and contacts are named as they are in messages, "bearing big_end".
    std::string group = "/forces/" + force.name;
    for (const std::string kind : {"bearing", "contact"})
      if (force.name.starts_with(kind + " ")) group = "/" + kind + "s/" + force.name.substr(kind.size() + 1);
    write_link(spec, group, force.a, force.b, writer);
    const Vector3 axis = frame(spec, force.a).X_BF.R.col(2);
    writer.constant(group + "/axis", {axis.data(), 3}, "1", "z-axis of the inboard frame, in its body's axes",
                    results::Writer::xyz);
  }
}

}  // namespace hersey::run
