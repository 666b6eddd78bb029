#include "hersey/fem/heat_conduction.h"

#include <algorithm>

#include "element/block_pattern.h"
#include "hersey/core/contract.h"
#include "surface/face_quadrature.h"

namespace hersey::fem {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

NodeColumns element_positions(const Mesh& mesh, const Element& element) {
  NodeColumns x(3, node_count(element.type));
  for (Index a = 0; a < x.cols(); ++a) x.col(a) = mesh.nodes[static_cast<std::size_t>(mesh.nodes_of(element)[a])];
  return x;
}

/// Rows and columns of `nodes` alone; the lower triangle is enough.
SparseMatrix lower_part_of(const SparseMatrix& A, const std::vector<int>& nodes) {
  std::vector<int> index(static_cast<std::size_t>(A.rows()), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i) index[static_cast<std::size_t>(nodes[i])] = static_cast<int>(i);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(A.nonZeros() / 2 + A.rows()));
  for (Index j = 0; j < A.outerSize(); ++j)
    for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry) {
      const int row = index[static_cast<std::size_t>(entry.row())], column = index[static_cast<std::size_t>(j)];
      if (column >= 0 && row >= column) entries.emplace_back(row, column, entry.value());
    }
  SparseMatrix part(static_cast<Index>(nodes.size()), static_cast<Index>(nodes.size()));
  part.setFromTriplets(entries.begin(), entries.end());
  return part;
}

}  // namespace

ElementMatrix element_conductance(ElementType type, const NodeColumns& x, double conductivity, Integration rule) {
  ElementMatrix K = ElementMatrix::Zero(x.cols(), x.cols());
  for (const auto& [xi, weight] : stiffness_points(type, rule)) {
    const ElementPoint point = element_point(shape_functions(type, xi), x);
    K.noalias() += weight * point.jacobian * conductivity * point.gradients * point.gradients.transpose();
  }
  return K;
}

VectorXd heat_load(const Mesh& mesh, const std::vector<ElementFace>& faces,
                   const std::function<double(const Vector3& x)>& flux) {
  VectorXd Q = VectorXd::Zero(static_cast<Index>(mesh.nodes.size()));
  for (const ElementFace& face : faces)
    visit_face(mesh, face, [&](const std::vector<int>& nodes, const FacePoint& point) {
      const double q = point.area * flux(point.x);
      for (std::size_t a = 0; a < nodes.size(); ++a) Q[nodes[a]] += point.N[static_cast<Index>(a)] * q;
    });
  return Q;
}

HeatConduction::HeatConduction(const Mesh& mesh, const std::vector<ThermalMaterial>& materials,
                               ThermalSurroundings surroundings, Integration rule)
    : surroundings_(std::move(surroundings)) {
  HERSEY_REQUIRE(!materials.empty(), "a body is of something");
  const BlockPattern pattern(mesh);
  A_ = pattern.scalar_matrix();
  for (const Element& element : mesh.elements) {
    HERSEY_REQUIRE(element.material < static_cast<int>(materials.size()), "every element's material is given");
    const double k = materials[static_cast<std::size_t>(std::max(element.material, 0))].conductivity;
    HERSEY_REQUIRE(k > 0, "a body that conducts heat");
    pattern.add_scalar(mesh, element, element_conductance(element.type, element_positions(mesh, element), k, rule), A_);
  }
  cool(mesh);
  owner_.assign(mesh.nodes.size(), -1);
  prescribed_T_ = VectorXd::Zero(A_.rows());
  for (std::size_t s = 0; s < surroundings_.prescribed.size(); ++s)
    for (const int node : surroundings_.prescribed[s].nodes) {
      owner_[static_cast<std::size_t>(node)] = static_cast<int>(s);
      prescribed_T_[node] = surroundings_.prescribed[s].T;
    }
  for (std::size_t a = 0; a < owner_.size(); ++a)
    if (owner_[a] < 0) free_.push_back(static_cast<int>(a));
}

void HeatConduction::cool(const Mesh& mesh) {
  ambient_ = VectorXd::Zero(A_.rows());
  std::vector<Eigen::Triplet<double>> entries;
  for (const CooledFaces& cooled : surroundings_.cooled) {
    HERSEY_REQUIRE(cooled.transfer >= 0, "heat flows to where it is colder");
    VectorXd to_face = VectorXd::Zero(A_.rows());
    for (const ElementFace& face : cooled.faces)
      visit_face(mesh, face, [&](const std::vector<int>& nodes, const FacePoint& point) {
        const double H = cooled.transfer * point.area;
        for (std::size_t b = 0; b < nodes.size(); ++b) {
          const double by_b = H * point.N[static_cast<Index>(b)];
          to_face[nodes[b]] += by_b;
          for (std::size_t a = 0; a < nodes.size(); ++a)
            entries.emplace_back(nodes[a], nodes[b], by_b * point.N[static_cast<Index>(a)]);
        }
      });
    ambient_ += cooled.T_ambient * to_face;
    to_face_.push_back(std::move(to_face));
  }
  SparseMatrix H(A_.rows(), A_.cols());
  H.setFromTriplets(entries.begin(), entries.end());
  A_ += H;
}

solver::FactorSummary HeatConduction::factorise() {
  const bool is_cooled =
      std::any_of(to_face_.begin(), to_face_.end(), [](const VectorXd& to_face) { return to_face.sum() > 0; });
  if (!is_cooled && free_.size() == owner_.size())
    return {{solver::FactorStatus::singular, "the body's heat has nowhere to go"}};
  if (free_.empty()) return {{solver::FactorStatus::factorised}};
  const SparseMatrix A = lower_part_of(A_, free_);
  factor_.analyse(A);
  solver::FactorSummary summary = factor_.factorise(A);
  if (summary.status == solver::FactorStatus::singular)
    summary.message = "the heat of a part of the body has nowhere to go";
  return summary;
}

MatrixXd HeatConduction::rises(const MatrixXd& heat) const {
  HERSEY_REQUIRE(heat.rows() == A_.rows(), "one row per node");
  MatrixXd T = MatrixXd::Zero(heat.rows(), heat.cols());
  if (free_.empty()) return T;
  MatrixXd x = heat(free_, Eigen::all);
  factor_.solve(x);
  T(free_, Eigen::all) = x;
  return T;
}

MatrixXd HeatConduction::temperatures(const MatrixXd& heat) const {
  const VectorXd known = ambient_ - A_ * prescribed_T_;
  return rises(heat.colwise() + known).colwise() + prescribed_T_;
}

VectorXd HeatConduction::cooling(const VectorXd& T) const {
  VectorXd heat(static_cast<Index>(to_face_.size()));
  for (Index s = 0; s < heat.size(); ++s) {
    const auto at = static_cast<std::size_t>(s);
    heat[s] = to_face_[at].dot(T) - surroundings_.cooled[at].T_ambient * to_face_[at].sum();
  }
  return heat;
}

VectorXd HeatConduction::reaction_heat(const VectorXd& T, const VectorXd& heat) const {
  const VectorXd out = heat + ambient_ - A_ * T;
  VectorXd sums = VectorXd::Zero(static_cast<Index>(surroundings_.prescribed.size()));
  for (std::size_t a = 0; a < owner_.size(); ++a)
    if (owner_[a] >= 0) sums[owner_[a]] += out[static_cast<Index>(a)];
  return sums;
}

}  // namespace hersey::fem
