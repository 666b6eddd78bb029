#include "hersey/fem/elastic_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "element/block_pattern.h"
#include "hersey/core/contract.h"
#include "hersey/core/input_error.h"

namespace hersey::fem {
namespace {

constexpr std::size_t most_listed = 5;  // labels in one message

std::string labels(const std::vector<long>& all) {
  std::string text;
  for (std::size_t i = 0; i < std::min(all.size(), most_listed); ++i)
    text += fmt::format("{}{}", i ? ", " : "", all[i]);
  if (all.size() > most_listed) text += fmt::format(" and {} more", all.size() - most_listed);
  return text;
}

NodeColumns positions(const Mesh& mesh, const Element& element) {
  const int n = node_count(element.type);
  NodeColumns x(3, n);
  for (int a = 0; a < n; ++a) x.col(a) = mesh.nodes[static_cast<std::size_t>(mesh.nodes_of(element)[a])];
  return x;
}

/// Labels of the nodes that no element uses.
std::vector<long> loose_nodes(const Mesh& mesh) {
  std::vector<char> used(mesh.nodes.size(), 0);
  for (const int node : mesh.connectivity) used[static_cast<std::size_t>(node)] = 1;
  std::vector<long> loose;
  for (std::size_t a = 0; a < used.size(); ++a)
    if (!used[a]) loose.push_back(a < mesh.node_labels.size() ? mesh.node_labels[a] : static_cast<long>(a) + 1);
  return loose;
}

void require_sound(const Mesh& mesh) {
  std::vector<long> beams, folded;
  for (const Element& e : mesh.elements) {
    if (e.type == ElementType::beam2)
      beams.push_back(e.label);
    else if (!(smallest_jacobian(e.type, positions(mesh, e)) > 0))
      folded.push_back(e.label);
  }
  std::vector<Fault> faults;
  const auto complain = [&](const std::vector<long>& who, const char* what, const char* wanted, const char* remedy) {
    if (!who.empty())
      faults.push_back(
          {.found = fmt::format(fmt::runtime(what), labels(who)), .expected = wanted, .suggestion = remedy});
  };
  complain(folded, "elements {} are folded or inside out (their Jacobian is not positive)",
           "elements of positive volume", "remesh there, or straighten the midside nodes");
  complain(beams, "elements {} are beams", "solid elements only", "");
  complain(loose_nodes(mesh), "nodes {} belong to no element", "nodes of elements only", "remove them from the mesh");
  if (mesh.elements.empty()) faults.push_back({.found = "a mesh without elements", .expected = "solid elements"});
  if (!faults.empty()) throw InputError(std::move(faults));
}

}  // namespace

const SolidMaterial& ElasticBody::material_of(const Element& element) const {
  return materials[static_cast<std::size_t>(std::max(element.material, 0))];
}

NodeColumns ElasticBody::positions_of(const Element& element) const { return positions(mesh, element); }

void find_inertia(ElasticBody& body) {
  const Eigen::Map<const Eigen::Matrix3Xd> x(body.mesh.nodes.data()->data(), 3,
                                             static_cast<Eigen::Index>(body.mesh.nodes.size()));
  const Eigen::VectorXd nodal = body.m * Eigen::VectorXd::Ones(x.cols());
  body.mass = nodal.sum();
  body.centre = body.mass > 0 ? Vector3(x * nodal / body.mass) : Vector3(x.rowwise().mean());
  const Eigen::Matrix3Xd r = x.colwise() - body.centre;
  const Matrix3 S = r * (r * body.m).transpose();  // int rho r r^T
  body.inertia = S.trace() * Matrix3::Identity() - (S + S.transpose()) / 2;
}

ElasticBody assemble(Mesh mesh, std::vector<SolidMaterial> materials, Integration integration) {
  HERSEY_REQUIRE(!materials.empty(), "a body is of something");
  require_sound(mesh);
  ElasticBody body{.mesh = std::move(mesh), .materials = std::move(materials), .integration = integration};
  const BlockPattern pattern(body.mesh);
  body.K = pattern.vector_matrix();
  body.m = pattern.scalar_matrix();
  for (const Element& e : body.mesh.elements) {
    HERSEY_REQUIRE(e.material < static_cast<int>(body.materials.size()), "every element's material is given");
    const SolidMaterial& material = body.material_of(e);
    const NodeColumns x = body.positions_of(e);
    pattern.add_vector(body.mesh, e, element_stiffness(e.type, x, material, integration), body.K);
    pattern.add_scalar(body.mesh, e, material.density * element_mass(e.type, x), body.m);
  }
  find_inertia(body);
  return body;
}

Eigen::MatrixXd mass_times(const Eigen::SparseMatrix<double>& m, const Eigen::MatrixXd& u) {
  HERSEY_REQUIRE(u.rows() == 3 * m.rows(), "three rows per node");
  Eigen::MatrixXd product(u.rows(), u.cols());
  for (Eigen::Index c = 0; c < u.cols(); ++c) {
    const Eigen::Map<const Eigen::Matrix3Xd> in(u.col(c).data(), 3, m.rows());
    Eigen::Map<Eigen::Matrix3Xd> out(product.col(c).data(), 3, m.rows());
    out.setZero();
    for (Eigen::Index b = 0; b < m.outerSize(); ++b)  // m is symmetric
      for (Eigen::SparseMatrix<double>::InnerIterator entry(m, b); entry; ++entry)
        out.col(b) += entry.value() * in.col(entry.row());
  }
  return product;
}

Eigen::MatrixXd rigid_motions(const Mesh& mesh, const Vector3& about) {
  Eigen::MatrixXd motions(3 * mesh.nodes.size(), 6);
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
    motions.middleRows<3>(3 * static_cast<Eigen::Index>(a)) << -skew(mesh.nodes[a] - about), Matrix3::Identity();
  return motions;
}

}  // namespace hersey::fem
