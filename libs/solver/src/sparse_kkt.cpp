#include "sparse_kkt.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace hersey::solver {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

// If all pivots of an elimination exceed this, there is no motion without inertia.
constexpr double kSoundCondition = 1e-11;
// Motions of more inertia than this have some, by an estimate that is right to a factor of a few.
constexpr double kLeastInertia = 100 * kNoInertia;

}  // namespace

VectorXd inertia_scales(const VectorXd& diagonal) {
  VectorXd s = VectorXd::Ones(diagonal.size());
  double largest_scale = 0;
  for (Index k = 0; k < s.size(); ++k) {
    if (!(diagonal[k] > 0)) continue;
    s[k] = 1 / std::sqrt(diagonal[k]);
    largest_scale = std::max(largest_scale, s[k]);
  }
  for (Index k = 0; k < s.size() && largest_scale > 0; ++k)
    if (!(diagonal[k] > 0)) s[k] = largest_scale;
  return s;
}

SparseKkt::SparseKkt(const Equations::SparseMatrix& S, Index nv) : S_(S), scale_(S.rows()) {
  VectorXd diagonal = VectorXd::Zero(nv), norm = VectorXd::Zero(S.rows() - nv);
  for (Index k = 0; k < nv; ++k) diagonal[k] = S.coeff(k, k);
  scale_.head(nv) = inertia_scales(diagonal);
  for (Index column = 0; column < nv; ++column)
    for (Equations::SparseMatrix::InnerIterator entry(S, column); entry; ++entry)
      if (entry.row() >= nv) norm[entry.row() - nv] += std::pow(entry.value() * scale_[column], 2);
  for (Index i = 0; i < norm.size(); ++i) scale_[nv + i] = norm[i] > 0 ? 1 / std::sqrt(norm[i]) : 1;
  Equations::SparseMatrix scaled = scale_.asDiagonal() * S * scale_.asDiagonal();
  scaled.makeCompressed();
  lu_.analyse(scaled);
  factorised_ = lu_.factorise({scaled.valuePtr(), static_cast<std::size_t>(scaled.nonZeros())});
}

bool SparseKkt::sound() const { return factorised_ && lu_.reciprocal_condition() > kSoundCondition; }

bool SparseKkt::all_motions_have_inertia(Index nv) const {
  if (!factorised_ || sound()) return factorised_;
  VectorXd y = VectorXd::Zero(scale_.size());
  std::minstd_rand random;  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same start each time
  std::uniform_real_distribution<double> part(-1, 1);
  for (Index k = 0; k < nv; ++k) y[k] = part(random);
  double largest = 0;
  for (int power = 0; power < 8; ++power) {
    y.head(nv).normalize();
    y.tail(y.size() - nv).setZero();
    lu_.solve({y.data(), static_cast<std::size_t>(y.size())});
    largest = std::max(largest, y.head(nv).norm());
    if (largest * kLeastInertia > 1) return false;
  }
  return true;
}

bool SparseKkt::solve(const VectorXd& b, VectorXd& x) const {
  x = VectorXd::Zero(b.size());
  VectorXd r = b;
  for (int pass = 0; pass < 3; ++pass) {
    VectorXd dx = scale_.cwiseProduct(r);
    lu_.solve({dx.data(), static_cast<std::size_t>(dx.size())});
    x += scale_.cwiseProduct(dx);
    r = b - S_ * x;
  }
  return x.allFinite() &&
         scale_.cwiseProduct(r).norm() <= 1e-10 * (scale_.cwiseProduct(b).norm() + x.cwiseQuotient(scale_).norm());
}

}  // namespace hersey::solver
