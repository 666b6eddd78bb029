#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hersey/model/read.h"
#include "hersey/run/simulation.h"
#include "variables.h"

namespace hersey::fmu {

/// State of an instance of an FMU, which decides the allowed calls.
enum class Phase { instantiated, initialisation, stepping, terminated, failed };

/// Outcome of a call of the interface. `discard`: a step that ended early, without an error.
enum class CallStatus { ok, warning, discard, error };

/// Everything an instance is in: parameters, inputs and, once there is one, the state of the simulation.
struct InstanceState {
  Phase phase = Phase::instantiated;
  std::vector<double> values;  ///< of parameters and inputs, by value reference
  std::vector<bool> is_set;    ///< which of them the importer gave
  double start_time = 0;       ///< [s]
  bool is_set_up = false;
  std::optional<double> stop_time;  ///< [s]
  std::optional<Archive::Content> simulation;
  double time = 0;  ///< of the last communication point
};

/// The state as bytes, and back. @throws std::runtime_error where the bytes are no state.
[[nodiscard]] std::vector<unsigned char> to_bytes(const InstanceState& state);
[[nodiscard]] InstanceState from_bytes(const unsigned char* bytes, std::size_t size);

/// One instance of an FMU, for either version of the standard. Instances share nothing. No function throws: errors are
/// reported through `log`.
class Instance {
 public:
  using Log = std::function<void(CallStatus, const char* category, const std::string& message)>;

  /// Reads all resources of the FMU: its folder is needed later only if parameters change a model that names files.
  /// @throws std::exception if its resources are damaged, or the token belongs to another FMU
  Instance(std::string name, const std::string& token, std::filesystem::path resources, Log log);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] Phase phase() const { return phase_; }

  /// Times of the experiment [s].
  [[nodiscard]] CallStatus set_up(double start_time, std::optional<double> stop_time);
  [[nodiscard]] CallStatus enter_initialisation();
  [[nodiscard]] CallStatus exit_initialisation();
  [[nodiscard]] CallStatus get(const unsigned* references, std::size_t count, double* values);
  [[nodiscard]] CallStatus set(const unsigned* references, std::size_t count, const double* values);
  /// Advances from `time` by `length`.
  /// @param reached  time at the end of the step
  [[nodiscard]] CallStatus step(double time, double length, double& reached, bool& ends);
  [[nodiscard]] CallStatus terminate();
  [[nodiscard]] CallStatus reset();

  [[nodiscard]] CallStatus save(std::unique_ptr<InstanceState>& state);
  [[nodiscard]] CallStatus restore(const InstanceState& state);

  /// Reports an error and returns its status.
  CallStatus error(const std::string& message);
  void set_logging(bool is_on) { is_logging_ = is_on; }

 private:
  [[nodiscard]] CallStatus guarded(const std::function<CallStatus()>& action);
  void build();
  void set_one(unsigned reference, double value);
  [[nodiscard]] double get_one(unsigned reference) const;
  [[nodiscard]] const Variable& variable(unsigned reference) const;
  void say(CallStatus outcome, const char* category, const std::string& message) const;

  std::string name_;
  std::filesystem::path resources_;
  Log log_;
  bool is_logging_ = false;
  Variables variables_;
  std::optional<model::ModelFile> file_;  // as the FMU holds it
  model::Model as_exported_;              // of it, with the overrides it was exported with
  Phase phase_ = Phase::instantiated;
  std::vector<double> values_;
  std::vector<bool> is_set_;
  double start_time_ = 0, time_ = 0;
  bool is_set_up_ = false;
  std::optional<double> stop_time_;
  std::unique_ptr<run::Simulation> simulation_;
  std::vector<std::size_t> outputs_;  // indices in the simulation's list, by value reference
};

}  // namespace hersey::fmu
