#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hersey/run/simulation.h"
#include "hersey/session/session.h"
#include "variables.h"

namespace hersey::fmu {

/// Phase of an instance of an FMU, which decides the allowed calls.
enum class Phase { instantiated, initialisation, stepping, terminated, failed };

/// Outcome of a call of the interface, in the order of both versions of the standard. `discard`: a step that ended
/// early, without an error.
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

/// A state that an importer keeps by a pointer, whose content is not its business.
struct KeptState {
  InstanceState state;
  std::vector<unsigned char> bytes = {};  ///< serialised when its size was asked for
};

/// One instance of an FMU: the core, of which fmi2.cpp and fmi3.cpp are the faces. Instances share nothing. Errors are
/// reported through `log`.
class Instance {
 public:
  using Log = std::function<void(CallStatus, const char* category, const std::string& message)>;

  /// Reads all resources of the FMU: its folder is needed later only if parameters change a model that names files.
  /// @param name   for the importer's own use; not empty
  /// @param token  null: there is none
  /// @param token_word  what this version of the standard calls it
  /// @throws std::exception if something is missing, its resources are damaged, or the token belongs to another FMU
  Instance(const char* name, const char* token, const char* token_word, const std::filesystem::path& resources,
           bool logging, Log log);

  /// Times of the experiment [s].
  [[nodiscard]] CallStatus set_up(double start_time, std::optional<double> stop_time);
  [[nodiscard]] CallStatus enter_initialisation();
  [[nodiscard]] CallStatus exit_initialisation();
  [[nodiscard]] CallStatus get(const unsigned* references, std::size_t count, double* values);
  [[nodiscard]] CallStatus set(const unsigned* references, std::size_t count, const double* values);
  /// Advances from `time` by `length`.
  [[nodiscard]] CallStatus step(double time, double length);
  /// Time at the end of the last step [s]; 0 before the first.
  [[nodiscard]] double last_successful_time() const { return last_successful_time_; }
  /// True if the last step met the end of the simulation.
  [[nodiscard]] bool has_ended() const { return has_ended_; }
  [[nodiscard]] CallStatus terminate();
  [[nodiscard]] CallStatus reset();

  /// Saves to `*kept`, a KeptState that is made if it is null.
  [[nodiscard]] CallStatus save(void** kept);
  [[nodiscard]] CallStatus restore(void* kept);
  /// Bytes of the serialised state. It is kept until the state is saved anew.
  [[nodiscard]] CallStatus serialised_size(void* kept, std::size_t* size);
  [[nodiscard]] CallStatus serialise(void* kept, unsigned char* bytes, std::size_t size);
  /// @throws std::runtime_error where the bytes are no state
  [[nodiscard]] CallStatus deserialise(const unsigned char* bytes, std::size_t size, void** kept);
  [[nodiscard]] CallStatus free_state(void** kept);

  /// An error unless `count` is 0: all variables are real numbers. @param type  of the requested ones
  [[nodiscard]] CallStatus require_none(std::size_t count, const char* type);
  /// Reports an error and returns its status.
  CallStatus error(const std::string& message);
  CallStatus set_logging(bool is_on);

 private:
  [[nodiscard]] InstanceState state_now();
  void take(const InstanceState& state);
  [[nodiscard]] CallStatus guarded(const std::function<CallStatus()>& action);
  void build();
  void set_one(unsigned reference, double value);
  [[nodiscard]] double get_one(unsigned reference) const;
  [[nodiscard]] const Variable& variable(unsigned reference) const;
  void say(CallStatus outcome, const char* category, const std::string& message) const;

  Log log_;
  bool is_logging_ = false;
  Variables variables_;
  std::optional<session::Session> session_;  // the model as it was exported
  Phase phase_ = Phase::instantiated;
  std::vector<double> values_;
  std::vector<bool> is_set_;
  double start_time_ = 0, time_ = 0, last_successful_time_ = 0;
  bool has_ended_ = false;
  bool is_set_up_ = false;
  std::optional<double> stop_time_;
  std::unique_ptr<run::Simulation> simulation_;
  std::vector<std::size_t> outputs_;  // indices in the simulation's list, by value reference
};

}  // namespace hersey::fmu
