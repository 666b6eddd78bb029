#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <vector>

#include "heat/heat_system.h"
#include "heat/wall_flux.h"
#include "hersey/core/archive.h"
#include "hersey/film/body_journal.h"
#include "hersey/film/body_wall.h"
#include "hersey/film/grid.h"
#include "hersey/film/heat_state.h"

namespace hersey::film {

/// Coupling of n nodes of a network that are no walls with a film of so many rows.
struct OutsideOfMean {
  Eigen::MatrixXd by = {};    ///< of the film's rows, by the nodes' temperatures, shape (rows, n) [W/K]
  Eigen::MatrixXd from = {};  ///< heat into them by the rows' temperatures, shape (n, rows) [W/K]
  Eigen::VectorXd self = {};  ///< heat into them by their own temperatures, shape (n) [W/K]
};

/// Heat from a film into walls that keep their temperature, and its derivatives by these: means over time of the heat
/// that they absorb, and of the film's equations of heat without storage (theory manual, thermal.18, thermal.19).
class MeanHeat {
 public:
  /// Walls that absorb heat. A ring and a journal of its own temperature settle with the film, nodes of a network with
  /// all of its films.
  struct Walls {
    bool ring = false, shell_node = false, own_journal = false, journal_node = false;
    Eigen::Index outside = 0;  ///< nodes that are no walls
    /// Body that conducts, where the ring's rows describe one; null: a ring. It must outlive this.
    const WallConduction* body = nullptr;
    /// Body of the journal; null: it is free, or has no temperature of its own. It must outlive this.
    const JournalConduction* journal_body = nullptr;
  };

  /// Equations of a step, walls' rows included.
  struct Equations {
    const HeatSystem& system;
    const Eigen::VectorXd& added;       ///< added to the diagonals of the film's rows, so that they store nothing [W/K]
    const Eigen::VectorXd& by_journal;  ///< of the rows, by the journal's temperature [W/K]
    const Eigen::VectorXd& by_shell;    ///< of the rows, by the temperature of a shell that is a node [W/K]
    const std::vector<WallFlux>& to_shell;    ///< heat into such a shell, by node
    const std::vector<WallFlux>& to_journal;  ///< heat into the journal, by node
    const Eigen::VectorXd& capacity;          ///< heat capacity of the film's rows [J/K]
    const OutsideOfMean& outside;             ///< empty where there are no such nodes
  };

  /// Temperatures of a ring, or a shell in a body, and a journal of its own temperature [K].
  struct Change {
    Eigen::VectorXd ring;  ///< shape (n_phi), or empty
    double journal = 0;
    Eigen::VectorXd heat = {};  ///< into each angle of a shell in a body [W], or empty
    double journal_heat = 0;    ///< into a journal in a body [W]; else 0
  };

  /// Changes after which ring and journal absorb no heat, or bodies as much as they pass on, and the heat into nodes
  /// after them.
  struct Answer {
    Change without;               ///< with the nodes as they are
    Change by_shell, by_journal;  ///< per kelvin of a node
    std::vector<Change> by_outside;
    Eigen::VectorXd heat = {};  ///< into each angle of a shell in a body, before any change [W]; else empty
    double journal_heat = 0;    ///< into a journal in a body, before any change [W]; else 0
    WallHeatFlow heat_flow;     ///< without temperatures
  };

  MeanHeat(const Grid& grid, int layers, const Walls& walls);

  /// Adds the equations of a step of length dt.
  void add_equations(double dt, const Equations& equations);
  /// Adds the heat that walls absorbed in the step at fixed temperatures, of system and journal [W]; the heat into
  /// nodes, in the order of WallHeatFlow [W]; and the film's temperatures [K].
  void add_heat(double dt, const Eigen::VectorXd& into, const Eigen::VectorXd& into_nodes, const Eigen::VectorXd& start,
                const Eigen::VectorXd& end);
  /// Discards the steps since then.
  void clear();
  /// True if steps were added since the last call of answer().
  [[nodiscard]] bool has_steps() const { return time_ > 0; }
  /// Solves for the changes by the means since the last call; at least one step is required. @param shell, journal
  /// temperatures of a shell, shape (n_phi), and of a journal in a body, which were constant over these steps [K]
  [[nodiscard]] Answer answer(const Eigen::VectorXd& shell, double journal);

  void persist(Archive& archive);

 private:
  [[nodiscard]] Change change_of(const Eigen::VectorXd& x) const;
  [[nodiscard]] Eigen::VectorXd heat_of(const Eigen::VectorXd& x) const;
  [[nodiscard]] double into_journal(const Eigen::VectorXd& x) const;
  [[nodiscard]] double journal_scale() const;
  [[nodiscard]] Eigen::VectorXd missing(const Eigen::VectorXd& shell, double journal) const;
  [[nodiscard]] HeatSystem::Row answer_entries(int i) const;
  [[nodiscard]] Eigen::SparseMatrix<double> matrix() const;

  Grid grid_;
  int layers_;
  Walls walls_;
  double time_ = 0;
  HeatSystem system_;
  Eigen::VectorXd by_shell_, by_journal_, into_, capacity_;
  Eigen::MatrixX2d to_shell_, to_journal_;  ///< heat by the two layers beside these walls, node by node [J/K]
  Eigen::VectorXd into_nodes_;
  OutsideOfMean outside_;
  Eigen::VectorXd begin_, end_;  // temperatures of the film
};

}  // namespace hersey::film
