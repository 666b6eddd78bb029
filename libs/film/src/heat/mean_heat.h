#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <vector>

#include "heat/heat_system.h"
#include "hersey/core/archive.h"
#include "hersey/film/grid.h"

namespace hersey::film {

/// What a film gives to walls that keep their temperature, and how that follows them: means over time of the heat that
/// rings and journals take up, and of the film's equations of heat without storage (theory manual, thermal.50,
/// thermal.51).
class MeanHeat {
 public:
  /// The equations of a step, walls' rows included.
  struct Equations {
    const HeatSystem& system;
    const Eigen::VectorXd& added;                 ///< to the diagonals of the film's rows: they store nothing [W/K]
    const Eigen::VectorXd& by_journal;            ///< of the rows, by the journal's temperature [W/K]
    const std::vector<double>& to_journal;        ///< of the journal's row, by the layers beside it [W/K]
    const Eigen::MatrixXd& by_supplies;           ///< of the rows, by the supplies' temperatures [W/K]
    const Eigen::MatrixXd& of_supplies;           ///< rows of supplies as columns: of system, journal, supplies [W/K]
    const Eigen::VectorXd& capacity;              ///< heat capacity of the film's rows [J/K]
    const Eigen::MatrixXd& capacity_of_supplies;  ///< and what of it the supplies' rows have [J/K]
  };

  /// Changes of temperature after which walls would take up no heat [K].
  struct Change {
    Eigen::VectorXd shell;  ///< shape (n_phi), or empty
    double journal = 0;
  };

  MeanHeat(const Grid& grid, int layers, bool has_ring, bool has_free_journal, int supplies);

  /// Takes those of a step of length dt.
  void add_equations(double dt, const Equations& equations);
  /// And what walls lacked in it to keep their temperatures, of system and journal [W]; the film's temperatures [K].
  void add_heat(double dt, const Eigen::VectorXd& into, const Eigen::VectorXd& start, const Eigen::VectorXd& end);
  /// Since the last call of settle().
  [[nodiscard]] bool has_steps() const { return time_ > 0; }
  /// By the means since the last call; there is a step since then.
  [[nodiscard]] Change settle();

  void persist(Archive& archive);

 private:
  [[nodiscard]] Eigen::VectorXd missing() const;
  [[nodiscard]] Eigen::SparseMatrix<double> matrix() const;
  void clear();

  Grid grid_;
  int layers_;
  bool has_ring_, has_free_journal_;
  int supplies_;
  double time_ = 0;
  HeatSystem system_;
  Eigen::VectorXd by_journal_, to_journal_, into_, capacity_;
  Eigen::MatrixXd by_supplies_, of_supplies_, capacity_of_supplies_;
  Eigen::VectorXd begin_, end_;  // temperatures of the film
  double journal_self_ = 0;
};

}  // namespace hersey::film
