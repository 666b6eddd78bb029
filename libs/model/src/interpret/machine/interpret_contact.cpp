#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hersey/core/spelling.h"
#include "hersey/mbd/hertz.h"
#include "hersey/mbd/restitution.h"
#include "interpret/context/interpret.h"

namespace hersey::model {
namespace {

std::vector<std::string> names_of(const Body& body) {
  std::vector<std::string> names;
  names.reserve(body.shapes.size() + body.faces.size());
  for (const mbd::Shape& shape : body.shapes) names.push_back(shape.name);
  for (const DeformingFaces& faces : body.faces)
    if (std::find(names.begin(), names.end(), faces.shape.name) == names.end()) names.push_back(faces.shape.name);
  return names;
}

constexpr int most_contact_nodes = 500;  // each takes a solution with the body's stiffness at the start

const Body* find_body(const Model& model, const std::string& name) {
  if (name == "ground") return &model.ground;
  for (const Body& body : model.bodies)
    if (body.name == name) return &body;
  return nullptr;
}

const mbd::ShapeGeometry* find_in(const Body& body, const std::string& shape) {
  for (const mbd::Shape& candidate : body.shapes)
    if (candidate.name == shape) return &candidate.geometry;
  for (const DeformingFaces& faces : body.faces)
    if (faces.shape.name == shape) return &faces.shape.geometry;
  return nullptr;
}

/// Reads one contact.
class ContactReader {
 public:
  ContactReader(Context& context, const Value& value) : context_(context), value_(value) {}

  Contact read(const std::string& name) {
    contact_.name = name;
    contact_.position = value_.key_position;
    const bool is_pair = read_pair();
    if (is_pair) read_stiffness();
    if (is_pair) keep_answers();
    read_damping();
    if (const Value* friction = value_.find("friction"); friction != nullptr && !friction->broken) {
      contact_.law.friction = number_of(*friction, "coefficient");
      contact_.law.slip_speed = number_of(*friction, "slip_speed");
    }
    return std::move(contact_);
  }

 private:
  /// Both shapes exist, belong to different bodies and can touch.
  bool read_pair() {
    const Value* between = value_.find("between");
    if (between == nullptr || between->members.size() != 2) return false;
    contact_.first = name_of(between->members[0].value);
    contact_.second = name_of(between->members[1].value);
    const mbd::ShapeGeometry* first = shape_of(between->members[0].value, contact_.first);
    const mbd::ShapeGeometry* second = shape_of(between->members[1].value, contact_.second);
    if (first == nullptr || second == nullptr) return false;
    const Value& at = between->members[1].value;
    if (contact_.first.body == contact_.second.body) {
      context_.fault(at, "both shapes on body '" + contact_.first.body + "'", "shapes of two bodies");
      return false;
    }
    if (context_.model.find_faces(contact_.first) != nullptr) {
      context_.fault(between->members[0].value, "faces that deform as the first shape", "them as the second one",
                     "change the two");
      return false;
    }
    if (!mbd::can_touch(*first, *second)) {
      context_.fault(at, "contact of a " + mbd::name_of(*first) + " with a " + mbd::name_of(*second),
                     "a sphere and anything, a half_space and anything but another, two capsules, or a mesh and "
                     "anything but another mesh",
                     "write one of the two as spheres, or as a mesh");
      return false;
    }
    return true;
  }

  // Faces that deform bring static answers to forces at their nodes into their body.
  void keep_answers() {
    const DeformingFaces* faces = context_.model.find_faces(contact_.second);
    if (faces == nullptr) return;
    if (is_of_finite_strain(contact_.second.body)) {
      context_.fault(value_.find("between")->members[1].value, "faces that deform of a body of finite strain",
                     "a body of `strain: small`, or a shape on one of its frames",
                     "faces move by static shapes, which a large bend is not");
      return;
    }
    // Two contacts on the same faces share the answers: given twice, they would depend on each other.
    const auto has_them = [&](const Contact& other) {
      return other.second.body == contact_.second.body && other.second.shape == contact_.second.shape;
    };
    const std::vector<Contact>& before = context_.model.contacts;
    if (std::any_of(before.begin(), before.end(), has_them)) return;
    for (Body& body : context_.model.bodies) {
      if (body.name != contact_.second.body || body.flexible->reduced) continue;
      if (static_cast<int>(faces->nodes.size()) <= most_contact_nodes) {
        body.flexible->contact_faces.push_back(faces->faces);
      } else if (body.flexible->nodal) {
        context_.fault(value_.find("between")->members[1].value,
                       fmt::format("{} nodes of a nodal body that may touch", faces->nodes.size()),
                       fmt::format("at most {}", most_contact_nodes),
                       "give the body a shape `faces` of the part that touches");
      }
    }
  }

  [[nodiscard]] bool is_of_finite_strain(const std::string& name) const {
    const Body* body = find_body(context_.model, name);
    return body->flexible && body->flexible->strain == mbd::Strain::finite;
  }

  static ShapeName name_of(const Value& reference) {
    const auto dot = reference.text.find('.');
    if (dot == std::string::npos) return {reference.text, "", reference.position};
    return {reference.text.substr(0, dot), reference.text.substr(dot + 1), reference.position};
  }

  const mbd::ShapeGeometry* shape_of(const Value& reference, const ShapeName& name) {
    if (reference.broken || context_.root.find("bodies") == nullptr) return nullptr;
    const Body* body = find_body(context_.model, name.body);
    if (body == nullptr) {
      std::vector<std::string> bodies = {"ground"};
      for (const Body& candidate : context_.model.bodies) bodies.push_back(candidate.name);
      context_.fault(reference, "unknown body '" + name.body + "'", one_of(bodies), did_you_mean(name.body, bodies));
      return nullptr;
    }
    const mbd::ShapeGeometry* shape = find_in(*body, name.shape);
    if (shape == nullptr && !context_.has_fault_in("bodies." + name.body + ".shapes." + name.shape)) {
      const std::vector<std::string> names = names_of(*body);
      context_.fault(reference, "unknown shape '" + name.shape + "' of body '" + name.body + "'",
                     names.empty() ? "a body with `shapes`; '" + name.body + "' has none" : one_of(names),
                     did_you_mean(name.shape, names));
    }
    return shape;
  }

  void read_stiffness() {
    const mbd::ShapeGeometry& first = *context_.model.find_shape(contact_.first);
    const mbd::ShapeGeometry& second = *context_.model.find_shape(contact_.second);
    const bool pressure =
        context_.model.find_faces(contact_.second) != nullptr || mbd::touches_with_pressure(first, second);
    const std::string pair = "a " + mbd::name_of(first) + " on a " + mbd::name_of(second);
    if (const Value* materials = value_.find("materials")) return read_hertz(*materials, first, second, pair);
    const Value* stiffness = value_.find("stiffness");
    if (stiffness == nullptr || stiffness->broken) return;
    const Value* given = stiffness->find(pressure ? "pressure" : "force");
    if (given == nullptr) {
      if (stiffness->find(pressure ? "force" : "pressure") == nullptr) return;  // neither: already reported
      context_.fault_at_key(*stiffness, std::string(pressure ? "a force" : "a pressure") + " for " + pair,
                            pressure ? "`pressure`: each corner of the mesh represents the area around it"
                                     : "`force`: only a mesh on anything but a sphere is pressed by its area");
      return;
    }
    const Value* exponent = stiffness->find("exponent");
    contact_.law.exponent = exponent != nullptr ? exponent->number : (pressure ? 1.0 : 1.5);
    contact_.law.stiffness = given->number / std::pow(number_of(*stiffness, "penetration"), contact_.law.exponent);
  }

  void read_hertz(const Value& materials, const mbd::ShapeGeometry& first, const mbd::ShapeGeometry& second,
                  const std::string& pair) {
    const auto radii = mbd::relative_radii(first, second);
    if (!radii) {
      context_.fault_at_key(materials, "Hertz's stiffness for " + pair,
                            "shapes that touch in a point of known radii: a sphere and anything, or a capsule on a "
                            "half_space",
                            "give `stiffness`");
      return;
    }
    if (materials.broken || materials.members.size() != 2) return;
    std::array<fem::ElasticMaterial, 2> solids;
    for (std::size_t i = 0; i < 2; ++i) {
      const Value& value = materials.members[i].value;
      solids[i] = {number_of(value, "youngs_modulus"), number_of(value, "poisson_ratio"), 0};
      if (value.broken || !(solids[i].youngs_modulus > 0) || !(std::abs(solids[i].poisson_ratio) < 1) ||
          solids[i].poisson_ratio >= 0.5)
        return;
    }
    if (!((*radii)[1] > 0)) return;  // a shape whose size could not be read; the fault is reported there
    contact_.is_hertz = true;
    contact_.law.exponent = 1.5;
    contact_.law.stiffness = mbd::hertz_stiffness(fem::composite_modulus(solids[0], solids[1]), *radii);
  }

  void read_damping() {
    const Value* damping = value_.find("damping");
    if (damping == nullptr || damping->broken) return;
    contact_.law.damping = number_of(*damping, "coefficient");
    const double restitution = number_of(*damping, "restitution"), speed = number_of(*damping, "speed");
    if (0 < restitution && restitution <= 1 && speed > 0)
      contact_.law.damping = mbd::damping_of_restitution(restitution, speed);
  }

  Context& context_;
  const Value& value_;
  Contact contact_;
};

}  // namespace

const DeformingFaces* Model::find_faces(const ShapeName& name) const {
  const Body* body = find_body(*this, name.body);
  if (body == nullptr) return nullptr;
  for (const DeformingFaces& faces : body->faces)
    if (faces.shape.name == name.shape) return &faces;
  return nullptr;
}

const mbd::ShapeGeometry* Model::find_shape(const ShapeName& name) const {
  const Body* body = find_body(*this, name.body);
  return body != nullptr ? find_in(*body, name.shape) : nullptr;
}

void interpret_contacts(Context& context) {
  for (const auto& [name, value] : section(context.root, "contacts"))
    context.model.contacts.push_back(ContactReader(context, value).read(name));
}

}  // namespace hersey::model
