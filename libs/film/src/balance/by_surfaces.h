#pragma once

#include <Eigen/Dense>

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

/// Derivatives at the state last evaluated.
struct BySurfaces {
  bool is_found = false;
  Eigen::VectorXd storage_gap, storage_excess, storage_rate, storage_excess_rate;  ///< of the storage, shape (n)
  FlowsBySurfaces around, axial;
};

}  // namespace hersey::film
