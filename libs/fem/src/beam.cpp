#include "hersey/fem/beam.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hersey/core/contract.h"
#include "hersey/core/input_error.h"
#include "hersey/solver/sparse_lu.h"
#include "hersey/solver/symmetric_factor.h"

namespace hersey::fem {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

constexpr double smallest_part = 1e-4;  // of the load
constexpr double largest_turn = 1.0;    // rad, of a node in one iteration: beyond, Newton's method is lost

/// Places of the free unknowns; -1: held.
std::vector<int> free_places(const BeamBody& body, const std::vector<int>& held, int& count) {
  std::vector<int> place(6 * body.nodes.size(), 0);
  for (const int dof : held) place[static_cast<std::size_t>(dof)] = -1;
  count = 0;
  for (int& p : place)
    if (p == 0) p = count++;
  return place;
}

/// Residual (inner minus outer forces) and its derivative on the free unknowns.
class Balance {
 public:
  Balance(const BeamBody& body, const std::vector<int>& held, const std::vector<BeamLoad>& loads)
      : body_(body), loads_(loads), place_(free_places(body, held, size_)) {}

  void evaluate(const BeamState& state, double share) {
    residual = Eigen::VectorXd::Zero(size_);
    entries_.clear();
    for (const BeamElement& element : body_.elements) add_element(element, state);
    for (const BeamLoad& load : loads_) add_load(load, state, share);
    tangent.resize(size_, size_);
    tangent.setFromTriplets(entries_.begin(), entries_.end());
  }

  [[nodiscard]] Eigen::VectorXd spread(const Eigen::VectorXd& x) const {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(place_.size()));
    for (std::size_t i = 0; i < place_.size(); ++i)
      if (place_[i] >= 0) all[static_cast<Eigen::Index>(i)] = x[place_[i]];
    return all;
  }

  [[nodiscard]] int size() const { return size_; }

  Eigen::VectorXd residual;
  Eigen::SparseMatrix<double> tangent;

 private:
  [[nodiscard]] int place(int node, int i) const { return place_[static_cast<std::size_t>(6 * node + i)]; }

  void add_element(const BeamElement& element, const BeamState& state) {
    const BeamResponse response = beam_response(element, state);
    const auto at = [&](int i) { return place(i < 6 ? element.a : element.b, i % 6); };
    for (int i = 0; i < 12; ++i) {
      if (at(i) < 0) continue;
      residual[at(i)] += response.force[i];
      for (int j = 0; j < 12; ++j)
        if (at(j) >= 0) entries_.emplace_back(at(i), at(j), response.tangent(i, j));
    }
  }

  // A moment m in space is R^T m in the node's axes, and turns with theta as -theta x R^T m.
  void add_load(const BeamLoad& load, const BeamState& state, double share) {
    const Vector3 moment = share * (state.R[static_cast<std::size_t>(load.node)].conjugate() * load.moment);
    const Matrix3 turned = skew(moment);
    for (int i = 0; i < 3; ++i) {
      if (const int p = place(load.node, 3 + i); p >= 0) residual[p] -= share * load.force[i];
      const int row = place(load.node, i);
      if (row < 0) continue;
      residual[row] -= moment[i];
      for (int j = 0; j < 3; ++j)
        if (const int column = place(load.node, j); column >= 0) entries_.emplace_back(row, column, -turned(i, j));
    }
  }

  const BeamBody& body_;
  const std::vector<BeamLoad>& loads_;
  int size_ = 0;
  std::vector<int> place_;
  Triplets entries_;
};

double size_of(const BeamBody& body) {
  double size = 0;
  for (const Vector3& x : body.nodes) size = std::max(size, (x - body.nodes[0]).norm());
  return size;
}

/// Newton's method for one share of the load; false: no equilibrium was found, `state` is of no use.
bool equilibrate(Balance& balance, solver::SparseLu& lu, double size, double share, const BeamStaticOptions& options,
                 BeamState& state, int& iterations) {
  for (int i = 0; i < options.most_iterations; ++i) {
    ++iterations;
    balance.evaluate(state, share);
    if (lu.size() != balance.size()) lu.analyse(balance.tangent);
    const auto nonzeros = static_cast<std::size_t>(balance.tangent.nonZeros());
    if (!lu.factorise({balance.tangent.valuePtr(), nonzeros})) return false;
    Eigen::VectorXd x = -balance.residual;
    lu.solve({x.data(), static_cast<std::size_t>(x.size())});
    const Eigen::VectorXd correction = balance.spread(x);
    double turn = 0, moved = 0;
    for (Eigen::Index node = 0; 6 * node < correction.size(); ++node) {
      turn = std::max(turn, correction.segment<3>(6 * node).norm());
      moved = std::max(moved, correction.segment<3>(6 * node + 3).norm());
    }
    if (!(turn < largest_turn) || !(moved < size)) return false;
    move(state, correction);
    if (std::max(turn, moved / size) < options.tolerance) return true;
  }
  return false;
}

}  // namespace

BeamStiffness beam_stiffness(const BeamSection& s, const ElasticMaterial& material) {
  HERSEY_REQUIRE(std::min({s.area, s.shear_y, s.shear_z, s.I_y, s.I_z, s.J}) > 0, "a section has area and stiffness");
  const double E = material.youngs_modulus, G = E / (2 * (1 + material.poisson_ratio));
  return {E * s.area, G * s.shear_y, G * s.shear_z, G * s.J, E * s.I_y, E * s.I_z};
}

BeamBody beam_body(const Mesh& mesh, const BeamStiffness& stiffness, const Vector3& up) {
  BeamBody body{.nodes = mesh.nodes};
  std::vector<Fault> faults;
  for (const Element& e : mesh.elements) {
    if (e.type != ElementType::beam2) continue;
    const int* node = mesh.nodes_of(e);
    const Vector3 along = mesh.nodes[static_cast<std::size_t>(node[1])] - mesh.nodes[static_cast<std::size_t>(node[0])];
    const Vector3 y = up.cross(along);
    if (!(y.norm() > 1e-6 * up.norm() * along.norm())) {
      faults.push_back(
          {.found = fmt::format("beam element {} has no length or lies along the section's z-axis", e.label),
           .expected = "an element across that axis",
           .suggestion = "give another direction for the section's z-axis"});
      continue;
    }
    BeamElement element{.a = node[0], .b = node[1], .length = along.norm(), .stiffness = stiffness};
    element.frame.col(0) = along.normalized();
    element.frame.col(1) = y.normalized();
    element.frame.col(2) = element.frame.col(0).cross(element.frame.col(1));
    body.elements.push_back(element);
  }
  if (!faults.empty()) throw InputError(std::move(faults));
  return body;
}

BeamState undeformed(const BeamBody& body) {
  return {body.nodes, std::vector<Eigen::Quaterniond>(body.nodes.size(), Eigen::Quaterniond::Identity())};
}

void move(BeamState& state, const Eigen::VectorXd& small) {
  HERSEY_REQUIRE(small.size() == 6 * static_cast<Eigen::Index>(state.r.size()), "six unknowns per node");
  for (std::size_t a = 0; a < state.r.size(); ++a) {
    const auto first = 6 * static_cast<Eigen::Index>(a);
    state.R[a] = (state.R[a] * rotation_exp(small.segment<3>(first))).normalized();
    state.r[a] += small.segment<3>(first + 3);
  }
}

BeamStaticSummary solve_beam(const BeamBody& body, const std::vector<int>& held, const std::vector<BeamLoad>& loads,
                             BeamState& state, const BeamStaticOptions& options) {
  HERSEY_REQUIRE(options.steps > 0 && state.r.size() == body.nodes.size(), "a state of this body");
  Balance balance(body, held, loads);
  solver::SparseLu lu;
  const double size = size_of(body);
  BeamStaticSummary summary;
  if (balance.size() == 0) return {.ok = true, .load = 1};
  double part = 1.0 / options.steps;
  while (summary.load < 1) {
    // The last part ends on the whole load, not on a sum of parts.
    const double next = summary.load + part > 1 - 1e-9 ? 1 : summary.load + part;
    BeamState trial = state;
    if (equilibrate(balance, lu, size, next, options, trial, summary.iterations)) {
      state = std::move(trial);
      summary.load = next;
    } else if ((part /= 2) < smallest_part) {
      summary.message =
          fmt::format("no equilibrium beyond {:.4g} of the load: the beam is not held, or it buckles", summary.load);
      return summary;
    }
  }
  summary.ok = true;
  return summary;
}

int unstable_motions(const BeamBody& body, const std::vector<int>& held, const std::vector<BeamLoad>& loads,
                     const BeamState& state) {
  Balance balance(body, held, loads);
  if (balance.size() == 0) return 0;
  balance.evaluate(state, 1);
  // In equilibrium the derivative in turning axes differs from the symmetric second derivative of the energy by
  // round-off.
  const Eigen::SparseMatrix<double> transposed = balance.tangent.transpose();
  const Eigen::SparseMatrix<double> symmetric = (balance.tangent + transposed) / 2;
  solver::SymmetricFactor factor;
  factor.analyse(symmetric);
  const solver::FactorSummary summary = factor.factorise(symmetric);
  return summary.ok() ? summary.negative_pivots : -1;
}

}  // namespace hersey::fem
