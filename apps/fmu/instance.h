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
  /// Called in the course of a communication step behind each step of the solver, with its time [s]. Returns the
  /// instant at which the step is to end early; none: it goes on to its end.
  using IntermediateUpdate = std::function<std::optional<double>(double time)>;
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
  /// @param value_count  arrays have more values than one
  [[nodiscard]] CallStatus get(const unsigned* references, std::size_t count, double* values, std::size_t value_count);
  [[nodiscard]] CallStatus set(const unsigned* references, std::size_t count, const double* values);
  /// Derivatives of outputs at the end of the last communication step with respect to inputs that act over it, times a
  /// direction of the inputs. In the initialisation and before the first step they are 0: no input has acted yet.
  [[nodiscard]] CallStatus directional_derivative(const unsigned* unknowns, std::size_t unknown_count,
                                                  const unsigned* knowns, std::size_t known_count, const double* seed,
                                                  std::size_t seed_count, double* derivative,
                                                  std::size_t derivative_count);
  /// The same derivatives, transposed, times weights of the outputs.
  [[nodiscard]] CallStatus adjoint_derivative(const unsigned* unknowns, std::size_t unknown_count,
                                              const unsigned* knowns, std::size_t known_count, const double* seed,
                                              std::size_t seed_count, double* derivative, std::size_t derivative_count);
  /// @throws std::runtime_error if a variable of `references` is no output
  void update_intermediately(IntermediateUpdate update, const unsigned* references, std::size_t count);
  /// Advances from `time` by `length`.
  [[nodiscard]] CallStatus step(double time, double length);
  /// Time at the end of the last step [s]; 0 before the first.
  [[nodiscard]] double last_successful_time() const { return last_successful_time_; }
  /// True if the last step ended before its length, by the importer's wish or at the end of the simulation.
  [[nodiscard]] bool has_returned_early() const { return has_returned_early_; }
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
  [[nodiscard]] double after_solver_step(double end);
  [[nodiscard]] const std::vector<std::vector<double>>* derivatives_by(unsigned known);
  [[nodiscard]] CallStatus derivative(bool is_adjoint, const std::vector<unsigned>& unknowns,
                                      const std::vector<unsigned>& knowns, const double* seed, std::size_t seed_count,
                                      double* found, std::size_t found_count);
  [[nodiscard]] CallStatus refuse_in_update();
  void set_one(unsigned reference, double value);
  void get_one(unsigned reference, double* values) const;
  [[nodiscard]] std::size_t count_values(const unsigned* references, std::size_t count) const;
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
  bool has_ended_ = false, has_returned_early_ = false;
  bool has_stepped_ = false;  // since the initialisation
  IntermediateUpdate update_;
  bool is_in_update_ = false;
  bool is_set_up_ = false;
  std::optional<double> stop_time_;
  std::unique_ptr<run::Simulation> simulation_;
  std::vector<std::size_t> outputs_;  // indices in the simulation's list, by value reference
};

}  // namespace hersey::fmu
