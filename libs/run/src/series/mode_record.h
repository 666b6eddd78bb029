#pragma once

#include <string>
#include <vector>

#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "hersey/solver/linearise.h"
#include "table/quantity.h"

namespace hersey::run {

/// A small motion about a state.
struct ModeRow {
  const solver::Mode& mode;
  Eigen::VectorXcd bodies;                         ///< small rotation and displacement of each body, shape (6 bodies)
  std::vector<Eigen::VectorXcd> flexibles, beams;  ///< in the amplitudes of each
};

/// Small motions of a machine in the results file.
class ModeRecord {
 public:
  /// @param model, machine  outlive this
  ModeRecord(const model::Model& model, const model::Machine& machine, results::Writer& writer);
  /// Motions about `state`.
  void append(const solver::State& state, const solver::Modes& found);
  [[nodiscard]] static QuantityGroup describe();

 private:
  const model::Model& model_;
  const model::Machine& machine_;
  results::Writer& writer_;
  QuantityRows<ModeRow, model::Machine> rows_;
};

}  // namespace hersey::run
