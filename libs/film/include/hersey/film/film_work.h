#pragma once

namespace hersey::film {

/// Where the computing time of a film goes, since it was made. Parts exclude each other [s].
struct FilmWork {
  double balance = 0;      ///< properties of the oil at the nodes, flows between them, residuals
  double jacobian = 0;     ///< derivatives of the residual by the unknowns
  double factors = 0;      ///< factorisations
  double solutions = 0;    ///< right-hand sides, by factors or multigrid
  double derivatives = 0;  ///< residual and forces along motions of the surfaces
  double forces = 0;       ///< sums of pressure and shear, with their derivatives by the unknowns
  int evaluations = 0;     ///< of the residual
  int factorisations = 0;

  FilmWork& operator+=(const FilmWork& other) {
    balance += other.balance, jacobian += other.jacobian, factors += other.factors;
    solutions += other.solutions, derivatives += other.derivatives, forces += other.forces;
    evaluations += other.evaluations, factorisations += other.factorisations;
    return *this;
  }
  /// Sum of the parts [s].
  [[nodiscard]] double total() const { return balance + jacobian + factors + solutions + derivatives + forces; }
};

}  // namespace hersey::film
