#include "hersey/mbd/body_reduction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "held_lanczos.h"
#include "hersey/core/contract.h"
#include "hersey/core/input_error.h"
#include "hersey/solver/symmetric_factor.h"

namespace hersey::mbd {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

[[noreturn]] void refuse(const std::string& path, const std::string& found, const std::string& expected,
                         const std::string& suggestion = {}) {
  throw InputError({.position = {}, .path = path, .found = found, .expected = expected, .suggestion = suggestion});
}

Vector3 centre_of(const fem::Mesh& mesh, const std::vector<int>& nodes) {
  Vector3 sum = Vector3::Zero();
  for (int n : nodes) sum += mesh.nodes[static_cast<std::size_t>(n)];
  return sum / static_cast<double>(nodes.size());
}

/// Sum over the nodes of |d|^2 - d d^T about their centre.
Matrix3 spread_of(const fem::Mesh& mesh, const std::vector<int>& nodes) {
  const Vector3 c = centre_of(mesh, nodes);
  Matrix3 sum = Matrix3::Zero();
  for (int n : nodes) {
    const Vector3 d = mesh.nodes[static_cast<std::size_t>(n)] - c;
    sum += d.squaredNorm() * Matrix3::Identity() - d * d.transpose();
  }
  return sum;
}

void check_interfaces(const fem::Mesh& mesh, const std::vector<InterfaceSpec>& interfaces) {
  std::vector<int> owner(mesh.nodes.size(), -1);
  for (std::size_t i = 0; i < interfaces.size(); ++i) {
    const InterfaceSpec& interface = interfaces[i];
    for (int n : interface.nodes) {
      int& first = owner[static_cast<std::size_t>(n)];
      if (first >= 0 && first != static_cast<int>(i))
        refuse("frames." + interface.name,
               fmt::format("node {} that frame '{}' holds too", mesh.node_labels[static_cast<std::size_t>(n)],
                           interfaces[static_cast<std::size_t>(first)].name),
               "node sets that do not share nodes", "hold the surfaces by sets that stop short of each other");
      first = static_cast<int>(i);
    }
    const bool spread = interface.nodes.size() >= 3;
    const Vector3 moments =
        spread
            ? Vector3(Eigen::SelfAdjointEigenSolver<Matrix3>(spread_of(mesh, interface.nodes), Eigen::EigenvaluesOnly)
                          .eigenvalues())
            : Vector3::Zero();
    if (!(moments[0] > 1e-8 * moments[2]))
      refuse("frames." + interface.name,
             spread ? "a node set that lies on a line" : fmt::format("{} nodes", interface.nodes.size()),
             "three or more nodes that do not lie on a line", "a frame turns too: take the nodes of a face");
  }
}

/// The mesh with every interface held: K of the nodes that no rigid interface carries, bordered by the mean motions of
/// averaging ones, factorised once.
class HeldBody {
 public:
  HeldBody(const fem::ElasticBody& body, const std::vector<InterfaceSpec>& interfaces)
      : body_(body), interfaces_(interfaces), place_(static_cast<std::size_t>(body.node_count()), 0) {
    for (const InterfaceSpec& i : interfaces)
      if (i.connection == Connection::rigid)
        for (int n : i.nodes) place_[static_cast<std::size_t>(n)] = -1;
    for (int& p : place_)
      if (p >= 0) p = free_++;
    for (const InterfaceSpec& i : interfaces)
      if (i.connection == Connection::average) bordered_.push_back(&i);
    factorise();
  }

  [[nodiscard]] Index free_size() const { return 3 * static_cast<Index>(free_); }

  /// Displacements of all nodes under nodal forces `f` on them, with given motions of the interfaces and, in `u`, the
  /// displacements of rigid ones.
  /// @param motions  [theta; u] of each interface, shape (6 interfaces, columns)
  void solve(const MatrixXd& f, const MatrixXd& motions, MatrixXd& u) const {
    u.setZero(body_.size(), f.cols());
    Index border = free_size();
    MatrixXd b = MatrixXd::Zero(size_, f.cols());
    for (std::size_t i = 0; i < interfaces_.size(); ++i) {
      const MatrixXd motion = motions.middleRows(6 * static_cast<Index>(i), 6);
      if (interfaces_[i].connection == Connection::average) {
        b.middleRows(border, 6) = scale_ * motion;
        border += 6;
        continue;
      }
      const MatrixXd moved = rigid_piece(body_.mesh, interfaces_[i]) * motion;
      for (std::size_t n = 0; n < interfaces_[i].nodes.size(); ++n)
        u.middleRows(3 * interfaces_[i].nodes[n], 3) = moved.middleRows(3 * static_cast<Index>(n), 3);
    }
    const MatrixXd rhs = f - body_.K * u;
    for (std::size_t n = 0; n < place_.size(); ++n)
      if (place_[n] >= 0) b.middleRows(3 * place_[n], 3) = rhs.middleRows(3 * static_cast<Index>(n), 3);
    factor_.solve(b);
    for (std::size_t n = 0; n < place_.size(); ++n)
      if (place_[n] >= 0) u.middleRows(3 * static_cast<Index>(n), 3) = b.middleRows(3 * place_[n], 3);
  }

 private:
  void factorise() {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(static_cast<std::size_t>(body_.K.nonZeros()));
    scale_ = body_.K.diagonal().mean();
    for (Index column = 0; column < body_.K.outerSize(); ++column) {
      const int p = place_[static_cast<std::size_t>(column / 3)];
      if (p < 0) continue;
      for (SparseMatrix::InnerIterator e(body_.K, column); e; ++e)
        if (const int r = place_[static_cast<std::size_t>(e.row() / 3)]; r >= 0)
          entries.emplace_back(3 * r + e.row() % 3, 3 * p + column % 3, e.value());
    }
    size_ = free_size();
    for (const InterfaceSpec* i : bordered_) {
      const MatrixXd C = scale_ * mean_motion(body_.mesh, *i);
      for (std::size_t n = 0; n < i->nodes.size(); ++n) {
        const int p = place_[static_cast<std::size_t>(i->nodes[n])];
        for (int a = 0; a < 3; ++a)
          for (int k = 0; k < 6; ++k) {
            entries.emplace_back(size_ + k, 3 * p + a, C(3 * static_cast<Index>(n) + a, k));
            entries.emplace_back(3 * p + a, size_ + k, C(3 * static_cast<Index>(n) + a, k));
          }
      }
      size_ += 6;
    }
    SparseMatrix A(size_, size_);
    A.setFromTriplets(entries.begin(), entries.end());
    factor_.analyse(A);
    const solver::FactorSummary summary = factor_.factorise(A);
    if (summary.ok()) return;
    if (summary.status == solver::FactorStatus::singular)
      refuse("mesh", fmt::format("{} motions of parts of the mesh that no frame holds", summary.null_unknowns.size()),
             "elements that hang together", "nodes of touching parts have to be the same nodes, not doubles");
    refuse("mesh", summary.message, "a mesh that fits", "a coarser one, or linear elements");
  }

  const fem::ElasticBody& body_;
  const std::vector<InterfaceSpec>& interfaces_;
  std::vector<int> place_;  ///< of each node among the free ones; -1: a rigid interface carries it
  int free_ = 0;
  std::vector<const InterfaceSpec*> bordered_;
  Index size_ = 0;
  double scale_ = 1;  ///< of the border, so that its entries are comparable with K's
  solver::SymmetricFactor factor_;
};

/// Lowest modes with all interfaces held: the largest eigenvalues of K^-1 M.
void append_modes(const fem::ElasticBody& body, const HeldBody& held, std::size_t interfaces,
                  const ReductionOptions& options, BodyReduction& reduction) {
  const MatrixXd at_rest = MatrixXd::Zero(6 * static_cast<Index>(interfaces), 1);
  const auto mass = [&](const VectorXd& x) { return VectorXd(fem::mass_times(body.m, x)); };
  const auto apply = [&](const VectorXd& x) {
    MatrixXd u;
    held.solve(fem::mass_times(body.m, x), at_rest, u);
    return VectorXd(u.col(0));
  };
  const int count = static_cast<int>(std::min<Index>(options.modes, held.free_size()));
  const LanczosModes modes = largest_modes(body.size(), count, apply, mass);
  for (Index i = 0; i < modes.theta.size(); ++i) {
    const double frequency = 1 / (2 * std::numbers::pi * std::sqrt(modes.theta[i]));
    if (options.highest > 0 && frequency > options.highest) break;
    reduction.frequencies.push_back(frequency);
    Index largest = 0;
    const VectorXd shape = modes.vectors.col(i);
    const double size =
        Eigen::Map<const Eigen::Matrix3Xd>(shape.data(), 3, shape.size() / 3).colwise().norm().maxCoeff(&largest);
    reduction.shapes.conservativeResize(Eigen::NoChange, reduction.shapes.cols() + 1);
    reduction.shapes.rightCols<1>() = shape / size;
  }
}

}  // namespace

MatrixXd rigid_piece(const fem::Mesh& mesh, const InterfaceSpec& interface) {
  MatrixXd motions(3 * static_cast<Index>(interface.nodes.size()), 6);
  for (std::size_t n = 0; n < interface.nodes.size(); ++n) {
    const Vector3 d = mesh.nodes[static_cast<std::size_t>(interface.nodes[n])] - interface.X_BF.r;
    motions.middleRows<3>(3 * static_cast<Index>(n)) << -skew(d), Matrix3::Identity();
  }
  return motions;
}

MatrixXd mean_motion(const fem::Mesh& mesh, const InterfaceSpec& interface) {
  // The motion y for which R y is nearest to u: (R^T R)^-1 R^T u.
  const MatrixXd R = rigid_piece(mesh, interface);
  const Matrix6 normal = R.transpose() * R;
  return R * normal.inverse();
}

BodyReduction reduce(const fem::ElasticBody& body, const std::vector<InterfaceSpec>& interfaces,
                     const ReductionOptions& options) {
  HERSEY_REQUIRE(!interfaces.empty(), "a body has a frame");
  check_interfaces(body.mesh, interfaces);
  const HeldBody held(body, interfaces);
  const Index n = static_cast<Index>(interfaces.size()), static_shapes = 6 * (n - 1);
  BodyReduction reduction;
  reduction.shapes.resize(body.size(), static_shapes);
  if (static_shapes > 0) {
    MatrixXd motions = MatrixXd::Zero(6 * n, static_shapes);
    motions.bottomRows(static_shapes).setIdentity();
    held.solve(MatrixXd::Zero(body.size(), static_shapes), motions, reduction.shapes);
  }
  append_modes(body, held, interfaces.size(), options, reduction);

  ModalBodyData& data = reduction.data;
  Eigen::Matrix3Xd x(3, body.node_count());
  for (Index i = 0; i < x.cols(); ++i) x.col(i) = body.mesh.nodes[static_cast<std::size_t>(i)];
  set_moments(data, body.m, x, reduction.shapes);
  const MatrixXd K = reduction.shapes.transpose() * (body.K * reduction.shapes);
  data.stiffness = 0.5 * (K + K.transpose());
  const MatrixXd M = reduction.shapes.transpose() * fem::mass_times(body.m, reduction.shapes);
  data.damping = options.damping_mass * 0.5 * (M + M.transpose()) + options.damping_stiffness * data.stiffness;
  // The mesh's axes ride on the first frame; the others start from where they stand in them.
  for (const InterfaceSpec& interface : interfaces) data.rest.push_back(interface.X_BF);
  data.rest[0] = Pose{};
  return reduction;
}

}  // namespace hersey::mbd
