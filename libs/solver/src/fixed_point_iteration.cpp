#include "hersey/solver/fixed_point_iteration.h"

#include <algorithm>
#include <cmath>

#include "hersey/core/contract.h"

namespace hersey::solver {
namespace {

// Columns whose part independent of newer ones falls below this share of the largest are noise.
constexpr double kIndependence = 1e-7;

Eigen::MatrixXd columns(const std::vector<Eigen::VectorXd>& vectors) {
  Eigen::MatrixXd matrix(vectors.front().size(), static_cast<Eigen::Index>(vectors.size()));
  for (std::size_t k = 0; k < vectors.size(); ++k) matrix.col(static_cast<Eigen::Index>(k)) = vectors[k];
  return matrix;
}

}  // namespace

FixedPointIteration::FixedPointIteration(Acceleration acceleration, double relaxation, ChangesKept kept)
    : acceleration_(acceleration), relaxation_(relaxation), kept_(kept), omega_(relaxation) {
  HERSEY_REQUIRE(relaxation > 0 && relaxation <= 1, "a relaxation factor lies in (0, 1]");
}

void FixedPointIteration::begin_step() { has_last_ = false; }

Eigen::VectorXd FixedPointIteration::next(const Eigen::VectorXd& x, const Eigen::VectorXd& image) {
  const Eigen::VectorXd residual = image - x;
  Eigen::VectorXd result;
  switch (acceleration_) {
    case Acceleration::constant:
      result = x + relaxation_ * residual;
      break;
    case Acceleration::aitken:
      result = aitken(x, residual);
      break;
    case Acceleration::quasi_newton:
      remember(residual, image);
      result = residual_changes_.empty() ? Eigen::VectorXd(x + relaxation_ * residual) : quasi_newton(image, residual);
      break;
  }
  last_residual_ = residual;
  last_image_ = image;
  has_last_ = true;
  return result;
}

Eigen::VectorXd FixedPointIteration::aitken(const Eigen::VectorXd& x, const Eigen::VectorXd& residual) {
  if (has_last_) {
    const Eigen::VectorXd change = residual - last_residual_;
    const double square = change.squaredNorm();
    if (square > 0) omega_ = -omega_ * last_residual_.dot(change) / square;
  } else {
    // A new step starts with the size the last one ended with, but never beyond the user's factor.
    omega_ = std::copysign(std::min(std::abs(omega_), relaxation_), omega_);
  }
  return x + omega_ * residual;
}

void FixedPointIteration::remember(const Eigen::VectorXd& residual, const Eigen::VectorXd& image) {
  if (!has_last_) return;
  // The difference of two nearly equal images shows the tolerance of their solver, not the map.
  if ((residual - last_residual_).norm() <= kept_.noise * image.norm()) return;
  residual_changes_.insert(residual_changes_.begin(), residual - last_residual_);
  image_changes_.insert(image_changes_.begin(), image - last_image_);
  if (residual_changes_.size() > kept_.most) {
    residual_changes_.pop_back();
    image_changes_.pop_back();
  }
}

// The combination of known changes that would cancel the residual takes the image along.
Eigen::VectorXd FixedPointIteration::quasi_newton(const Eigen::VectorXd& image, const Eigen::VectorXd& residual) const {
  const Eigen::MatrixXd V = columns(residual_changes_), W = columns(image_changes_);
  // Newest changes first, so that old ones only fill directions the new ones leave open (Gram-Schmidt, filtered).
  Eigen::MatrixXd Q(V.rows(), V.cols()), C(W.rows(), V.cols());
  Eigen::Index count = 0;
  for (Eigen::Index k = 0; k < V.cols() && count < V.rows(); ++k) {
    const Eigen::VectorXd share = Q.leftCols(count).transpose() * V.col(k);
    Eigen::VectorXd independent = V.col(k) - Q.leftCols(count) * share;
    const double norm = independent.norm();
    if (norm <= kIndependence * V.col(k).norm()) continue;
    Q.col(count) = independent / norm;
    C.col(count) = (W.col(k) - C.leftCols(count) * share) / norm;
    ++count;
  }
  const Eigen::VectorXd known = Q.leftCols(count).transpose() * residual;
  const Eigen::VectorXd next = image - C.leftCols(count) * known;
  if (relaxation_of_unknown_ == 1) return next;
  return next - (1 - relaxation_of_unknown_) * (residual - Q.leftCols(count) * known);
}

void FixedPointIteration::learn_from(const FixedPointIteration& other,
                                     const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& transfer) {
  residual_changes_.clear(), image_changes_.clear();
  for (const Eigen::VectorXd& change : other.residual_changes_) residual_changes_.push_back(transfer(change));
  for (const Eigen::VectorXd& change : other.image_changes_) image_changes_.push_back(transfer(change));
}

void FixedPointIteration::persist(Archive& archive) {
  const auto vector = [](Archive& a, Eigen::VectorXd& item) { a.io("change", item); };
  archive.io("omega", omega_);
  archive.each("residual_changes", residual_changes_, vector);
  archive.each("image_changes", image_changes_, vector);
  archive.io("has_last", has_last_);
  archive.io("last_residual", last_residual_), archive.io("last_image", last_image_);
}

}  // namespace hersey::solver
