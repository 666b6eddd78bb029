#include "elastic/nodal_setup.h"

#include <vector>

#include "hersey/core/contract.h"
#include "hersey/fem/constrained_stiffness.h"

namespace hersey::mbd {

using Eigen::Index;
using Eigen::MatrixXd;

ModalBodyData static_data(const fem::ElasticBody& body, const fem::ReducedBody& reduced,
                          const RayleighDamping& damping) {
  fem::ReducedBody still = reduced;
  const Index n = reduced.internal_first();
  Index size = n;
  for (const fem::FilmModes& film : reduced.film_modes) size += film.shapes.cols();
  still.Phi.resize(reduced.Phi.rows(), size);
  still.Phi.leftCols(n) = reduced.Phi.leftCols(n);
  still.K = MatrixXd::Zero(size, size);
  still.K.topLeftCorner(n, n) = reduced.K.topLeftCorner(n, n);
  Index at = n;
  for (const fem::FilmModes& film : reduced.film_modes) {
    still.Phi.middleCols(at, film.shapes.cols()) = film.shapes;
    at += film.shapes.cols();
  }
  // Frames at rest bear no work of the films' shapes, so that these strain the body independently of the frames'.
  const MatrixXd films = still.Phi.rightCols(size - n);
  const MatrixXd K = films.transpose() * (body.K * films);
  still.K.bottomRightCorner(size - n, size - n) = 0.5 * (K + K.transpose());
  still.M = still.Phi.transpose() * fem::mass_times(body.m, still.Phi);
  still.internal_omega.resize(0);
  return modal_data(still, damping);
}

ModalBodyData finite_data(const fem::ElasticBody& body, const fem::ReducedBody& reduced,
                          const RayleighDamping& damping) {
  ModalBodyData data = static_data(body, reduced, damping);
  constexpr Index kTurns = 9, kPerFrame = 12;
  const auto further = static_cast<Index>(reduced.frames.size()) - 1;
  const Index films = data.shapes() - 6 * further;
  MatrixXd Psi = MatrixXd::Zero(body.size(), kPerFrame * further + films);
  for (Index i = 0; i < further; ++i) {
    const fem::InterfaceFrame& frame = reduced.frames[static_cast<std::size_t>(i) + 1];
    HERSEY_REQUIRE(frame.connection == fem::Connection::rigid,
                   "averaging frames rotate little against the first frame");
    for (const int node : frame.nodes) {
      const Vector3 d = reduced.nodes[static_cast<std::size_t>(node)] - frame.origin;
      for (Index p = 0; p < 3; ++p) {
        for (Index r = 0; r < 3; ++r) Psi(3 * node + p, kPerFrame * i + 3 * p + r) = d[r];
        Psi(3 * node + p, kPerFrame * i + kTurns + p) = 1;
      }
    }
  }
  if (further > 0) {
    const fem::FrameSupports supports = supports_of(body, reduced);
    fem::ConstrainedStiffness constrained(body.K, body.m, supports.fixed_dofs, supports.C);
    HERSEY_REQUIRE(constrained.factorise().solved(), "the reduction has factorised this matrix");
    Psi -= constrained.solve(MatrixXd(body.K * Psi));
  }
  Psi.rightCols(films) = data.displacements.rightCols(films);
  const Eigen::Matrix3Xd x = data.nodes;
  set_moments(data, reduced.m, x, Psi);
  data.shapes_per_frame = kPerFrame;
  data.stiffness = Psi.transpose() * (body.K * Psi);
  data.damping = damping.mass * (Psi.transpose() * fem::mass_times(body.m, Psi));
  return data;
}

fem::FrameSupports supports_of(const fem::ElasticBody& body, const fem::ReducedBody& reduced) {
  fem::FrameSupports supports = fem::frame_supports(body.mesh, reduced.frames);
  std::vector<Eigen::Triplet<double>> entries;
  const Eigen::SparseMatrix<double>& C = supports.C;
  for (Index j = 0; j < C.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(C, j); entry; ++entry)
      entries.emplace_back(static_cast<int>(entry.row()), static_cast<int>(j), entry.value());
  Index row = C.rows();
  for (const fem::FilmModes& film : reduced.film_modes) {
    for (Index k = 0; k < film.loads.cols(); ++k, ++row) {
      const double largest = film.loads.col(k).cwiseAbs().maxCoeff();
      for (Index i = 0; i < film.loads.rows(); ++i)
        if (film.loads(i, k) != 0)
          entries.emplace_back(static_cast<int>(row), static_cast<int>(i), film.loads(i, k) / largest);
    }
  }
  supports.C.resize(row, body.size());
  supports.C.setFromTriplets(entries.begin(), entries.end());
  return supports;
}

}  // namespace hersey::mbd
