#pragma once

#include <memory>
#include <string>

#include "hersey/fem/elastic_body.h"
#include "hersey/mbd/body_reduction.h"
#include "hersey/mbd/mechanism.h"

namespace hersey::mbd::test {

/// A box along x with a frame on each end it is asked for.
struct Beam {
  Vector3 size{1, 0.1, 0.06};
  std::array<int, 3> cells{8, 2, 2};
  fem::ElasticMaterial material{.youngs_modulus = 2.1e11, .poisson_ratio = 0.3, .density = 7850};
  bool tip = false;  ///< a second frame, on the end x = length
  Connection connection = Connection::rigid;
  ReductionOptions options{.modes = 8};
  fem::ElementType type = fem::ElementType::hex8;

  [[nodiscard]] Pose frame_at(double x) const { return {Matrix3::Identity(), {x, size.y() / 2, size.z() / 2}}; }
  [[nodiscard]] fem::ElasticBody elastic() const {
    return fem::assemble(fem::box_mesh(type, size, cells), {fem::isotropic(material)});
  }
  [[nodiscard]] std::vector<InterfaceSpec> interfaces(const fem::Mesh& mesh) const {
    std::vector<InterfaceSpec> specs{{"root", frame_at(0), mesh.node_sets.at("x0"), connection}};
    if (tip) specs.push_back({"tip", frame_at(size.x()), mesh.node_sets.at("x1"), connection});
    return specs;
  }
  [[nodiscard]] BodyReduction reduced() const {
    const fem::ElasticBody body = elastic();
    return reduce(body, interfaces(body.mesh), options);
  }
  /// Adds it to `builder` as `name`; its axes have their origin at the corner.
  [[nodiscard]] FlexibleBodyIds add_to(MechanismBuilder& builder, const std::string& name = "beam") const {
    std::vector<std::string> names;
    if (tip) names.emplace_back("tip");
    return builder.add_flexible_body(name, names, std::make_shared<ModalBody>(reduced().data));
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
