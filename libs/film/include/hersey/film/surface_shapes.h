#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <vector>

#include "hersey/film/film_response.h"

namespace hersey::film {

/// Shapes in which the surfaces of a film deform: by how much a unit of each amplitude opens the gap at the nodes.
/// There may be a hundred amplitudes, each of which moves all nodes; each is a sum of functions, of which a few differ
/// from zero at a node (theory manual, bearing.12). The surfaces' amplitudes follow one another.
struct SurfaceShapes {
  using Functions = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  /// One surface that deforms.
  struct Surface {
    Functions opening;          ///< gap opened by a unit of each function, shape (n, functions)
    Functions rate;             ///< d gap rate / d coefficient, as it turns, likewise; (0, 0): it does not [1/s]
    Eigen::MatrixXd functions;  ///< coefficients of a unit of each amplitude, shape (functions, amplitudes)
    bool is_shell = false;      ///< as MotionDirection::shell_fraction: 1, else 0
  };
  std::vector<Surface> surfaces;
  Eigen::MatrixXd openings;  ///< gap opened by a unit of each amplitude, shape (n, amplitudes)

  /// Shapes of rigid surfaces of films of `n` nodes: none.
  [[nodiscard]] static SurfaceShapes none(Eigen::Index n) {
    return {.surfaces = {}, .openings = Eigen::MatrixXd(n, 0)};
  }

  /// Returns the number of all amplitudes.
  [[nodiscard]] Eigen::Index amplitudes() const { return openings.cols(); }
  /// Makes a direction, new or made by this function before, the change of the surfaces with an amplitude.
  void find_along_amplitude(Eigen::Index a, MotionDirection& direction) const;
  /// Makes a direction, new or made by this function before, the change of the surfaces with the rate of an amplitude.
  void find_along_rate(Eigen::Index a, MotionDirection& direction) const;
};

}  // namespace hersey::film
