#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "hersey/core/archive.h"
#include "hersey/model/model.h"

namespace hersey::run {

/// Schedules checkpoints: after simulated time or computing time, whichever comes first.
class CheckpointSchedule {
 public:
  explicit CheckpointSchedule(const model::Simulation& plan);

  /// True if a checkpoint is due; to be called after every step. One is due after a long step, too, so that a user who
  /// stops the run during the next step does not wait for its end.
  /// @param t  time of a state from which a run can continue [s]
  [[nodiscard]] bool is_due(double t);
  /// @param cost  time that it took [s]
  void written(double t, double cost);

 private:
  using Clock = std::chrono::steady_clock;
  model::Simulation::Checkpoints plan_;
  double start_, slack_, next_;
  Clock::time_point last_ = Clock::now(), step_ = last_;
  double cost_ = 0;
};

/// Stores the identity of a run: program, model file with its overrides, contents of the files it names.
void save_identity(Archive& archive, const model::Model& model);

/// True if a name in an archive is one of `save_identity`.
[[nodiscard]] bool is_identity(const std::string& name);

/// @throws InputError unless `before` is the text of the model, overrides noted
void require_same_text(const std::string& before, const model::Model& model);

/// Compares the model with the stored identity, read from `file`.
/// @param warning  receives a sentence if another version of the program wrote it
/// @throws InputError that names the difference of the model
void require_identity(const Archive::Content& stored, const model::Model& model, const std::filesystem::path& file,
                      std::string& warning);

/// True if the run of these results is complete.
/// @throws InputError if they belong to another model; results::ReadError
[[nodiscard]] bool is_complete(const model::Model& model, const std::filesystem::path& results);

/// True if there are results, including those of a killed run. A program killed while it creates the file leaves zeros.
[[nodiscard]] bool has_results(const std::filesystem::path& results);

/// Removes the checkpoint of these results, if there is one.
void discard_checkpoint(const std::filesystem::path& results);

/// The first line in which two texts differ, as "line 12 was 'a' and is 'b'"; empty where they do not.
[[nodiscard]] std::string difference_of(const std::string& before, const std::string& now);

}  // namespace hersey::run
