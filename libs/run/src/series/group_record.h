#pragma once

#include <cstddef>
#include <vector>

#include "hersey/mbd/mechanism_spec.h"
#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "observation/step_record.h"
#include "table/quantity.h"

namespace hersey::run {

/// Films that are one bearing, and where they act.
struct GroupPlan {
  const model::Model& model;
  const model::Composite& composite;
  const mbd::MechanismSpec& mechanism;
  std::vector<std::size_t> films;                 ///< indices of its films among the bearings of the model
  std::vector<mbd::MechanismSpec::Force> forces;  ///< of each of them
  std::vector<std::size_t> wrenches;              ///< index of each among the mechanism's forces
};

/// Such a bearing at an instant.
struct GroupRow {
  const GroupPlan& plan;
  const StepRecord& step;
};

/// One bearing of several films in the results file: what they do together, beside the figures of each.
class GroupRecord {
 public:
  GroupRecord(const model::Model& model, const model::Machine& machine, const model::Composite& composite,
              results::Writer& writer);
  void append(const StepRecord& step) const { rows_.append({plan_, step}); }
  /// True if the films of a bearing are in the machine.
  [[nodiscard]] static bool is_in(const model::Model& model, const model::Composite& composite);
  [[nodiscard]] static QuantityGroup describe();

 private:
  GroupPlan plan_;
  QuantityRows<GroupRow, GroupPlan> rows_;
};

}  // namespace hersey::run
