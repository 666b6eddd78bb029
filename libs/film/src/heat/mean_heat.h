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

/// Of nodes of a network that are no walls, n of them: what they do to a film of so many rows, and it to them.
struct OutsideOfMean {
  Eigen::MatrixXd by = {};    ///< rows, by their temperatures, shape (rows, n) [W/K]
  Eigen::MatrixXd from = {};  ///< heat into them by the rows' temperatures, shape (n, rows) [W/K]
  Eigen::VectorXd self = {};  ///< and by their own, shape (n) [W/K]
};

/// What a film gives to walls that keep their temperature, and how that follows them: means over time of the heat that
/// they take up, and of the film's equations of heat without storage (theory manual, thermal.18, thermal.19).
class MeanHeat {
 public:
  /// Walls that take up heat. A ring and a journal of its own temperature settle with the film; nodes of a network with
  /// all of its films.
  struct Walls {
    bool ring = false, shell_node = false, own_journal = false, journal_node = false;
    Eigen::Index outside = 0;  ///< nodes that are no walls
    /// What the ring's rows stand for where it is a body that conducts; null: a ring. Outlives this.
    const WallConduction* body = nullptr;
    /// Of a journal in a body; null: it is free, or has no temperature of its own. Outlives this.
    const JournalConduction* journal_body = nullptr;
  };

  /// The equations of a step, walls' rows included.
  struct Equations {
    const HeatSystem& system;
    const Eigen::VectorXd& added;             ///< to the diagonals of the film's rows: they store nothing [W/K]
    const Eigen::VectorXd& by_journal;        ///< of the rows, by the journal's temperature [W/K]
    const Eigen::VectorXd& by_shell;          ///< of the rows, by the temperature of a shell that is a node [W/K]
    const std::vector<WallFlux>& to_shell;    ///< into such a shell, by node
    const std::vector<WallFlux>& to_journal;  ///< and into the journal
    const Eigen::VectorXd& capacity;          ///< heat capacity of the film's rows [J/K]
    const OutsideOfMean& outside;             ///< empty where there are no such nodes
  };

  /// Of a ring, or a shell in a body, and a journal of its own temperature [K].
  struct Change {
    Eigen::VectorXd ring;  ///< shape (n_phi), or empty
    double journal = 0;
    Eigen::VectorXd heat = {};  ///< into each angle of a shell in a body [W], or empty
    double journal_heat = 0;    ///< into a journal in a body [W]; else 0
  };

  /// Changes after which ring and journal would take up no heat, or bodies what they pass on, and what nodes would
  /// then.
  struct Answer {
    Change without;               ///< with the nodes as they are
    Change by_shell, by_journal;  ///< per kelvin of a node
    std::vector<Change> by_outside;
    Eigen::VectorXd heat = {};  ///< into each angle of a shell in a body, before any change [W]; else empty
    double journal_heat = 0;    ///< likewise into a journal in a body; else 0
    WallExchange exchange;      ///< without temperatures
  };

  MeanHeat(const Grid& grid, int layers, const Walls& walls);

  /// Takes those of a step of length dt.
  void add_equations(double dt, const Equations& equations);
  /// And what walls lacked in it to keep their temperatures, of system and journal [W]; what went into nodes, in the
  /// order of WallExchange [W]; the film's temperatures [K].
  void add_heat(double dt, const Eigen::VectorXd& into, const Eigen::VectorXd& into_nodes, const Eigen::VectorXd& start,
                const Eigen::VectorXd& end);
  /// Since the last call of answer().
  [[nodiscard]] bool has_steps() const { return time_ > 0; }
  /// By the means since the last call; there is a step since then. @param shell, journal  temperatures of a shell,
  /// shape (n_phi), and of a journal in a body, which they had all the time [K]
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
  void clear();

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
