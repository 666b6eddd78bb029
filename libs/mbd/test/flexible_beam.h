#pragma once

#include <doctest/doctest.h>

#include <memory>
#include <string>
#include <utility>

#include "hersey/fem/elastic_body.h"
#include "hersey/fem/reduction.h"
#include "hersey/mbd/mechanism.h"
#include "hersey/mbd/mechanism_builder.h"
#include "hersey/mbd/modal_body.h"
#include "hersey/mbd/nodal_body.h"

namespace hersey::mbd::test {

/// A box along x with frames on the requested ends.
struct Beam {
  Vector3 size{1, 0.1, 0.06};
  std::array<int, 3> cells{8, 2, 2};
  fem::ElasticMaterial material{.youngs_modulus = 2.1e11, .poisson_ratio = 0.3, .density = 7850};
  bool tip = false;        ///< a second frame, on the end x = length
  bool tip_first = false;  ///< of the two
  fem::Connection connection = fem::Connection::rigid;
  int modes = 8;
  fem::ElementType type = fem::ElementType::hex8;
  RayleighDamping damping = {};
  bool nodal = false;
  bool contact = false;  ///< film modes of the side y = width
  Strain strain = Strain::small;

  [[nodiscard]] Pose frame_at(double x) const { return {Matrix3::Identity(), {x, size.y() / 2, size.z() / 2}}; }
  [[nodiscard]] fem::ElasticBody elastic() const {
    return fem::assemble(fem::box_mesh(type, size, cells), {fem::isotropic(material)});
  }
  [[nodiscard]] fem::ReducedBody reduced_mesh() const {
    const fem::ElasticBody body = elastic();
    std::vector<fem::InterfaceFrame> frames{{"root", frame_at(0).r, body.mesh.node_sets.at("x0"), connection, {}}};
    if (tip) frames.push_back({"tip", frame_at(size.x()).r, body.mesh.node_sets.at("x1"), connection, {}});
    if (tip_first) std::swap(frames[0], frames[1]);
    fem::ReductionOptions options;
    options.modes = modes;
    if (contact) options.contact_faces.push_back(body.mesh.surfaces.at("y1"));
    const fem::Reduction reduction = fem::reduce(body, frames, options);
    REQUIRE_MESSAGE(reduction.solved(), reduction.message);
    return reduction.body;
  }
  [[nodiscard]] ModalBodyData reduced() const { return modal_data(reduced_mesh(), damping); }
  [[nodiscard]] std::shared_ptr<NodalBody> all_nodes() const {
    return std::make_shared<NodalBody>(elastic(), reduced_mesh(), damping, strain);
  }
  /// Adds it to `builder` as `name`; its axes have their origin at the corner.
  [[nodiscard]] FlexibleBodyIds add_to(MechanismBuilder& builder, const std::string& name = "beam") const {
    std::vector<std::string> names;
    if (tip) names.emplace_back(tip_first ? "root" : "tip");
    if (nodal) return builder.add_flexible_body(name, names, all_nodes());
    return builder.add_flexible_body(name, names, std::make_shared<ModalBody>(reduced()));
  }
  [[nodiscard]] double mass() const { return material.density * size.prod(); }
  /// The rigid body it is the elastic one of.
  [[nodiscard]] BodySpec rigid(const std::string& name) const {
    const Vector3 s2 = size.cwiseAbs2();
    const Vector3 moments = mass() / 12 * (Vector3::Constant(s2.sum()) - s2);
    return {.name = name, .mass = mass(), .com = size / 2, .inertia = moments.asDiagonal()};
  }
};

}  // namespace hersey::mbd::test
