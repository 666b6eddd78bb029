#include "hersey/core/contract.h"
#include "hersey/fem/reduction.h"

namespace hersey::fem {

MassMoments mass_moments(const ReducedBody& body) {
  const Eigen::Index n = body.m.rows(), fields = body.size() + 1;
  const Eigen::VectorXd nodal = body.m * Eigen::VectorXd::Ones(n);
  const auto field = [&](Eigen::Index j) {
    const double* start = j == 0 ? body.nodes.data()->data() : body.Phi.col(j - 1).data();
    return Eigen::Map<const Eigen::Matrix3Xd>(start, 3, n);
  };
  // Row 3 j + i: component i of field j; then all second moments are one product.
  Eigen::MatrixXd rows(3 * fields, n);
  for (Eigen::Index j = 0; j < fields; ++j) rows.middleRows<3>(3 * j) = field(j);
  const Eigen::MatrixXd weighted = rows * body.m;
  const Eigen::MatrixXd products = weighted * rows.transpose();

  MassMoments moments{.mass = nodal.sum(), .first = Eigen::Matrix3Xd(3, fields)};
  moments.second.reserve(static_cast<std::size_t>(fields * fields));
  for (Eigen::Index j = 0; j < fields; ++j) {
    moments.first.col(j) = rows.middleRows<3>(3 * j) * nodal;
    for (Eigen::Index k = 0; k < fields; ++k) moments.second.emplace_back(products.block<3, 3>(3 * j, 3 * k));
  }
  return moments;
}

Matrix3 inertia(const MassMoments& moments, const Eigen::VectorXd& q) {
  const Eigen::Index fields = moments.first.cols();
  HERSEY_REQUIRE(q.size() + 1 == fields, "one coordinate per column of Phi");
  const auto amplitude = [&](Eigen::Index j) { return j == 0 ? 1.0 : q[j - 1]; };
  Matrix3 S = Matrix3::Zero();
  for (Eigen::Index j = 0; j < fields; ++j)
    for (Eigen::Index k = 0; k < fields; ++k) S += amplitude(j) * amplitude(k) * moments.of(j, k);
  return S.trace() * Matrix3::Identity() - S;
}

}  // namespace hersey::fem
