#include "nodal_setup.h"

#include <vector>

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
