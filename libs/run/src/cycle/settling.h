#pragma once

#include <optional>
#include <vector>

#include "hersey/core/archive.h"
#include "hersey/model/model.h"
#include "observation/step_record.h"

namespace hersey::run {

/// Detects that every journal is at the position where it was some time ago (model::Settle).
class SettlingTest {
 public:
  explicit SettlingTest(const model::Model& model) : model_(model) {}

  /// Takes an accepted step; true once the run may end with it.
  [[nodiscard]] bool settled(const StepRecord& step);

  void persist(Archive& archive);

 private:
  [[nodiscard]] double change(const StepRecord& step) const;

  const model::Model& model_;
  std::vector<bearing::BearingObservation> last_;
  std::optional<double> next_;
};

}  // namespace hersey::run
