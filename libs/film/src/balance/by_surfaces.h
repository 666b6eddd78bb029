#pragma once

#include <Eigen/Dense>
#include <vector>

/// How storage and flows of a film change with its surfaces, at one state.
namespace hersey::film {

/// Speeds across a face: mean of both surfaces, half their difference, the journal's [m/s]; or derivatives by them.
struct Speeds {
  double mean = 0, half_slip = 0, journal = 0;

  [[nodiscard]] Speeds operator*(double factor) const { return {factor * mean, factor * half_slip, factor * journal}; }
  [[nodiscard]] Speeds operator+(const Speeds& other) const {
    return {mean + other.mean, half_slip + other.half_slip, journal + other.journal};
  }
  [[nodiscard]] double dot(const Speeds& other) const {
    return mean * other.mean + half_slip * other.half_slip + journal * other.journal;
  }
};

/// Derivatives of the flows over faces of one kind, around the bearing or along its axis, shape (n) each: at a node
/// stands the face between it and the next one. Where there is no next one they are zero.
struct FlowsBySurfaces {
  Eigen::VectorXd gap, gap_next;        ///< by the gap at the node and at the next one [m^2/s]
  Eigen::VectorXd excess, excess_next;  ///< by the excess of the mean gap of their control volumes [m^2/s]
  Eigen::VectorXd bend;                 ///< by the bend of the gap between them [m^2/s]
  Eigen::VectorXd journal;              ///< by phi_journal [m^3/(s rad)]
  Eigen::VectorXd mean_speed, half_slip, journal_speed;  ///< by Speeds, along phi without the face's stretch [m^2]
  Eigen::VectorXd leaves, enters;  ///< 1 where the flow counts in the row of the node, and of the next one; else 0 [-]

  void resize(Eigen::Index n) {
    for (auto* field : {&gap, &gap_next, &excess, &excess_next, &bend, &journal, &mean_speed, &half_slip,
                        &journal_speed, &leaves, &enters})
      field->setZero(n);
  }
};

/// A change of the gap beside a supply line: at a node, at the one on the line's other side, of the bend of the gap
/// between them, of the excess upstream, and of the gap's rate at the node.
struct GapChangeBesideLine {
  double g = 0, g_other = 0, bend = 0, excess = 0, g_rate = 0;
};

/// How the row of a node with a supply changes with the gap: with its own balance, by a weight, and by itself.
struct RowByGap {
  int node = 0;
  double weight = 0;  ///< of the balance [-]
  int other = -1, face = 0, upstream = 0;
  double by_node = 0, by_other = 0, by_bend = 0, by_excess = 0;  ///< [m^2/s]
  double by_rate = 0;                                            ///< [m^2]
};

/// How the row of a node with a seal changes with the gap there, besides its balance.
struct LeakByGap {
  int node = 0;
  double by_gap = 0;  ///< [m^2/s]
};

/// Derivatives at the state last evaluated.
struct BySurfaces {
  bool is_found = false;
  Eigen::VectorXd storage_gap, storage_excess, storage_rate, storage_excess_rate;  ///< of the storage, shape (n)
  FlowsBySurfaces around, axial;
  std::vector<RowByGap> prescribed;  ///< this and the next of the last gap operator
  std::vector<LeakByGap> leaks;
};

}  // namespace hersey::film
