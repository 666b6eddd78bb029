#pragma once

#include <Eigen/Core>
#include <random>

namespace hersey {

/// Entries from -1 to 1, the same for the same shape and seed whatever has run before. Eigen's own Random() goes on
/// where the last test of the program left off.
inline Eigen::MatrixXd seeded_random(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::MatrixXd matrix(rows, columns);
  for (double& entry : matrix.reshaped()) entry = uniform(generator);
  return matrix;
}

}  // namespace hersey
