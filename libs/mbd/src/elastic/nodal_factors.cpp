#include "elastic/nodal_factors.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

namespace hersey::mbd {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Factors are kept up to this size together, the one in use in any case.
constexpr double kMemory = 1.5e9;  // [bytes]
constexpr std::size_t kMost = 6;

// A step size that differs by less takes the same factor: times at which steps end have round-off, and the factor of a
// matrix so close solves as well.
constexpr double kSameStep = 1e-7;

/// Component p of displacements (3 n, columns), shape (n, columns).
MatrixXd component(const MatrixXd& u, std::size_t p) {
  MatrixXd one(u.rows() / 3, u.cols());
  for (Eigen::Index j = 0; j < u.cols(); ++j)
    one.col(j) = Eigen::Map<const VectorXd, 0, Eigen::InnerStride<3>>(u.col(j).data() + p, one.rows());
  return one;
}

}  // namespace

NodalFactors::NodalFactors(const fem::ElasticBody& body, fem::FrameSupports supports, const RayleighDamping& damping,
                           const MatrixXd& columns, const MatrixXd& shapes)
    : body_(body), supports_(std::move(supports)), damping_(damping), columns_(columns), shapes_(shapes) {
  if (supports_.C.rows() > 0) bearing_ = MatrixXd(supports_.C * supports_.C.transpose()).inverse();
}

const NodalFactor* NodalFactors::of(const solver::Stage& stage, std::string& message) {
  const double scale = stage.k + stage.c * damping_.stiffness;
  const double shift = -(stage.m + stage.c * damping_.mass) / scale;
  const auto close = [](double a, double b) { return std::abs(a - b) <= kSameStep * std::abs(a); };
  const auto same = [&](const NodalFactor& factor) { return close(factor.shift, shift) && close(factor.scale, scale); };
  if (is_stale_ && !factors_.empty()) {
    factors_.erase(std::next(factors_.begin()), factors_.end());  // the ordering of the first serves the next
  } else if (const auto found = std::find_if(factors_.begin(), factors_.end(), same); found != factors_.end()) {
    factors_.splice(factors_.begin(), factors_, found);
    return &factors_.front();
  } else {
    make_room();
    return add(shift, scale, message) ? &factors_.front() : nullptr;
  }
  return factorise(factors_.front(), shift, scale, message) ? &factors_.front() : nullptr;
}

bool NodalFactors::add(double shift, double scale, std::string& message) {
  factors_.push_front({shift,
                       scale,
                       fem::ConstrainedStiffness(body_.K, body_.m, supports_.fixed_dofs, supports_.C),
                       {},
                       {},
                       {},
                       {},
                       {}});
  return factorise(factors_.front(), shift, scale, message);
}

bool NodalFactors::factorise(NodalFactor& factor, double shift, double scale, std::string& message) {
  if (K_.rows() > 0) factor.matrix.replace(K_);
  factor.shift = shift;
  factor.scale = scale;
  if (const solver::FactorSummary summary = factor.matrix.factorise(shift); !summary.solved()) {
    message = summary.message;
    factors_.pop_front();
    return false;
  }
  is_stale_ = false;
  describe(factor);
  return true;
}

void NodalFactors::restiffen(const Eigen::SparseMatrix<double>& K) {
  K_ = K;
  is_stale_ = true;
}

void NodalFactors::describe(NodalFactor& factor) const {
  factor.X = factor.matrix.solve(columns_) / factor.scale;
  factor.W = columns_.transpose() * factor.X;
  std::array<MatrixXd, 3> answer, shape;
  for (std::size_t p = 0; p < 3; ++p) {
    answer[p] = component(factor.X, p);
    shape[p] = component(shapes_, p);
  }
  for (std::size_t p = 0; p < 3; ++p) {
    factor.m_X[p] = body_.m * answer[p];
    for (std::size_t r = 0; r < 3; ++r) {
      factor.shapes[3 * p + r] = factor.m_X[p].transpose() * shape[r];
      if (r < p) {
        factor.answers[3 * p + r] = factor.answers[3 * r + p].transpose();  // m is symmetric
      } else {
        factor.answers[3 * p + r] = factor.m_X[p].transpose() * answer[r];
      }
    }
  }
}

void NodalFactors::make_room() {
  if (factors_.empty()) return;
  const double each = factors_.front().matrix.memory_estimate();
  while (!factors_.empty() && (factors_.size() >= kMost || static_cast<double>(factors_.size() + 1) * each > kMemory))
    factors_.pop_back();
}

VectorXd NodalFactors::solve(const NodalFactor& factor, const VectorXd& f) {
  ++solves_;
  return factor.matrix.solve(f) / factor.scale;
}

void NodalFactors::leave_to_frames(VectorXd& f) const {
  for (const int dof : supports_.fixed_dofs) f[dof] = 0;
  if (supports_.C.rows() == 0) return;
  f -= supports_.C.transpose() * (bearing_ * (supports_.C * f));
  for (const int dof : supports_.fixed_dofs) f[dof] = 0;
}

void NodalFactors::persist(Archive& archive) {
  std::vector<std::pair<double, double>> steps;
  if (K_.rows() == 0)
    for (const NodalFactor& factor : factors_) steps.emplace_back(factor.shift, factor.scale);
  archive.each("step", steps, [](Archive& a, std::pair<double, double>& step) {
    a.io("shift", step.first);
    a.io("scale", step.second);
  });
  if (!archive.restores() || K_.rows() > 0) return;
  factors_.clear();
  std::string message;
  std::reverse(steps.begin(), steps.end());  // the one used last goes in last, to the front
  for (const auto& [shift, scale] : steps)
    if (!add(shift, scale, message)) throw ArchiveError(message);
}

}  // namespace hersey::mbd
