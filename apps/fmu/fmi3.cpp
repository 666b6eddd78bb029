#include "fmi3.h"

#include <cstring>
#include <exception>
#include <memory>
#include <string>

#include "hersey/core/error_text.h"
#include "instance.h"
#include "resource_path.h"

#define HERSEY_EXPORT __attribute__((visibility("default")))

using hersey::fmu::CallStatus;
using hersey::fmu::Instance;
using hersey::fmu::InstanceState;

namespace {

struct State {
  std::unique_ptr<InstanceState> state;
  std::vector<unsigned char> bytes;  ///< serialised when its size was asked for
};

fmi3Status status_of(CallStatus outcome) {
  switch (outcome) {
    case CallStatus::ok:
      return fmi3OK;
    case CallStatus::warning:
      return fmi3Warning;
    case CallStatus::discard:
      return fmi3Discard;
    case CallStatus::error:
      return fmi3Error;
  }
  return fmi3Fatal;
}

// No instance, no answer; no exception leaves the library.
template <class Action>
fmi3Status with(fmi3Instance instance, const Action& action) {
  if (instance == nullptr) return fmi3Error;
  Instance& one = *static_cast<Instance*>(instance);
  try {
    return status_of(action(one));
  } catch (const std::exception& failure) {
    return status_of(one.error(hersey::error_text(failure)));
  }
}

fmi3Status without_variables(fmi3Instance instance, std::size_t count, const char* type) {
  return with(instance, [&](Instance& one) {
    return count == 0 ? CallStatus::ok : one.error(std::string("this FMU has no variables of type ") + type);
  });
}

fmi3Status unsupported(fmi3Instance instance, const char* what) {
  return with(instance, [&](Instance& one) { return one.error(std::string(what) + " not provided by this FMU"); });
}

void log_refusal(fmi3LogMessageCallback log, fmi3InstanceEnvironment environment, const std::string& message) {
  if (log != nullptr) log(environment, fmi3Error, "logStatusError", message.c_str());
}

}  // namespace

extern "C" {

HERSEY_EXPORT const char* fmi3GetVersion() { return "3.0"; }

HERSEY_EXPORT fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean on, std::size_t /*count*/,
                                             const fmi3String* /*categories*/) {
  return with(instance, [&](Instance& one) {
    one.set_logging(on);
    return CallStatus::ok;
  });
}

HERSEY_EXPORT fmi3Instance fmi3InstantiateModelExchange(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean,
                                                        fmi3InstanceEnvironment environment,
                                                        fmi3LogMessageCallback log) {
  log_refusal(log, environment, "this FMU is for co-simulation only");
  return nullptr;
}

HERSEY_EXPORT fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean /*visible*/, fmi3Boolean logging,
    fmi3Boolean /*event_mode_used*/, fmi3Boolean /*early_return_allowed*/,
    const fmi3ValueReference* /*intermediate_variables*/, std::size_t /*count*/, fmi3InstanceEnvironment environment,
    fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback /*intermediate_update*/) {
  try {
    if (name == nullptr || *name == '\0') throw std::runtime_error("an instance without a name");
    if (token == nullptr) throw std::runtime_error("an instance without an instantiation token");
    const auto report = [environment, log](CallStatus outcome, const char* category, const std::string& message) {
      if (log != nullptr) log(environment, status_of(outcome), category, message.c_str());
    };
    // A path; FMI 2, and importers that have grown up with it, name a URI.
    const std::string folder = resources != nullptr ? resources : "";
    auto instance = std::make_unique<Instance>(
        name, token, folder.starts_with("file:") ? hersey::fmu::path_of_uri(folder) : std::filesystem::path(folder),
        report);
    instance->set_logging(logging);
    return instance.release();
  } catch (const std::exception& failure) {
    log_refusal(log, environment, hersey::error_text(failure));
    return nullptr;
  }
}

HERSEY_EXPORT fmi3Instance fmi3InstantiateScheduledExecution(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                                             fmi3Boolean, fmi3InstanceEnvironment environment,
                                                             fmi3LogMessageCallback log, fmi3ClockUpdateCallback,
                                                             fmi3LockPreemptionCallback, fmi3UnlockPreemptionCallback) {
  log_refusal(log, environment, "this FMU is for co-simulation only");
  return nullptr;
}

HERSEY_EXPORT void fmi3FreeInstance(fmi3Instance instance) { delete static_cast<Instance*>(instance); }

HERSEY_EXPORT fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean /*has_tolerance*/,
                                                     fmi3Float64 /*tolerance*/, fmi3Float64 start, fmi3Boolean has_stop,
                                                     fmi3Float64 stop) {
  return with(instance, [&](Instance& one) {
    const CallStatus outcome = one.set_up(start, has_stop ? std::optional(stop) : std::nullopt);
    return outcome == CallStatus::ok ? one.enter_initialisation() : outcome;
  });
}
HERSEY_EXPORT fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
  return with(instance, [](Instance& one) { return one.exit_initialisation(); });
}
HERSEY_EXPORT fmi3Status fmi3Terminate(fmi3Instance instance) {
  return with(instance, [](Instance& one) { return one.terminate(); });
}
HERSEY_EXPORT fmi3Status fmi3Reset(fmi3Instance instance) {
  return with(instance, [](Instance& one) { return one.reset(); });
}

HERSEY_EXPORT fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference* references, std::size_t count,
                                        fmi3Float64* values, std::size_t value_count) {
  return with(instance, [&](Instance& one) {
    if (count != value_count) return one.error("every variable has one value: as many of both are due");
    return one.get(references, count, values);
  });
}
HERSEY_EXPORT fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference* references, std::size_t count,
                                        const fmi3Float64* values, std::size_t value_count) {
  return with(instance, [&](Instance& one) {
    if (count != value_count) return one.error("every variable has one value: as many of both are due");
    return one.set(references, count, values);
  });
}

HERSEY_EXPORT fmi3Status fmi3GetFloat32(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                        fmi3Float32*, std::size_t) {
  return without_variables(instance, count, "Float32");
}
HERSEY_EXPORT fmi3Status fmi3SetFloat32(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                        const fmi3Float32*, std::size_t) {
  return without_variables(instance, count, "Float32");
}
HERSEY_EXPORT fmi3Status fmi3GetInt8(fmi3Instance instance, const fmi3ValueReference*, std::size_t count, std::int8_t*,
                                     std::size_t) {
  return without_variables(instance, count, "Int8");
}
HERSEY_EXPORT fmi3Status fmi3SetInt8(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                     const std::int8_t*, std::size_t) {
  return without_variables(instance, count, "Int8");
}
HERSEY_EXPORT fmi3Status fmi3GetUInt8(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                      std::uint8_t*, std::size_t) {
  return without_variables(instance, count, "UInt8");
}
HERSEY_EXPORT fmi3Status fmi3SetUInt8(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                      const std::uint8_t*, std::size_t) {
  return without_variables(instance, count, "UInt8");
}
HERSEY_EXPORT fmi3Status fmi3GetInt16(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                      std::int16_t*, std::size_t) {
  return without_variables(instance, count, "Int16");
}
HERSEY_EXPORT fmi3Status fmi3SetInt16(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                      const std::int16_t*, std::size_t) {
  return without_variables(instance, count, "Int16");
}
HERSEY_EXPORT fmi3Status fmi3GetUInt16(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                       std::uint16_t*, std::size_t) {
  return without_variables(instance, count, "UInt16");
}
HERSEY_EXPORT fmi3Status fmi3SetUInt16(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                       const std::uint16_t*, std::size_t) {
  return without_variables(instance, count, "UInt16");
}
HERSEY_EXPORT fmi3Status fmi3GetInt32(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                      std::int32_t*, std::size_t) {
  return without_variables(instance, count, "Int32");
}
HERSEY_EXPORT fmi3Status fmi3SetInt32(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                      const std::int32_t*, std::size_t) {
  return without_variables(instance, count, "Int32");
}
HERSEY_EXPORT fmi3Status fmi3GetUInt32(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                       std::uint32_t*, std::size_t) {
  return without_variables(instance, count, "UInt32");
}
HERSEY_EXPORT fmi3Status fmi3SetUInt32(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                       const std::uint32_t*, std::size_t) {
  return without_variables(instance, count, "UInt32");
}
HERSEY_EXPORT fmi3Status fmi3GetInt64(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                      std::int64_t*, std::size_t) {
  return without_variables(instance, count, "Int64");
}
HERSEY_EXPORT fmi3Status fmi3SetInt64(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                      const std::int64_t*, std::size_t) {
  return without_variables(instance, count, "Int64");
}
HERSEY_EXPORT fmi3Status fmi3GetUInt64(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                       std::uint64_t*, std::size_t) {
  return without_variables(instance, count, "UInt64");
}
HERSEY_EXPORT fmi3Status fmi3SetUInt64(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                       const std::uint64_t*, std::size_t) {
  return without_variables(instance, count, "UInt64");
}
HERSEY_EXPORT fmi3Status fmi3GetBoolean(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                        fmi3Boolean*, std::size_t) {
  return without_variables(instance, count, "Boolean");
}
HERSEY_EXPORT fmi3Status fmi3SetBoolean(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                        const fmi3Boolean*, std::size_t) {
  return without_variables(instance, count, "Boolean");
}
HERSEY_EXPORT fmi3Status fmi3GetString(fmi3Instance instance, const fmi3ValueReference*, std::size_t count, fmi3String*,
                                       std::size_t) {
  return without_variables(instance, count, "String");
}
HERSEY_EXPORT fmi3Status fmi3SetString(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                       const fmi3String*, std::size_t) {
  return without_variables(instance, count, "String");
}
HERSEY_EXPORT fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                       std::size_t*, fmi3Binary*, std::size_t) {
  return without_variables(instance, count, "Binary");
}
HERSEY_EXPORT fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                       const std::size_t*, const fmi3Binary*, std::size_t) {
  return without_variables(instance, count, "Binary");
}
HERSEY_EXPORT fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference*, std::size_t count, fmi3Clock*) {
  return without_variables(instance, count, "Clock");
}
HERSEY_EXPORT fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                      const fmi3Clock*) {
  return without_variables(instance, count, "Clock");
}

HERSEY_EXPORT fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState* state) {
  return with(instance, [&](Instance& one) {
    if (state == nullptr) return one.error("no room for a state");
    std::unique_ptr<InstanceState> saved;
    const CallStatus outcome = one.save(saved);
    if (outcome != CallStatus::ok) return outcome;
    if (*state == nullptr) *state = new State;
    auto& kept = *static_cast<State*>(*state);
    kept.state = std::move(saved);
    kept.bytes.clear();
    return CallStatus::ok;
  });
}
HERSEY_EXPORT fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state) {
  return with(instance, [&](Instance& one) {
    if (state == nullptr) return one.error("no state to restore");
    return one.restore(*static_cast<State*>(state)->state);
  });
}
HERSEY_EXPORT fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState* state) {
  if (instance == nullptr) return fmi3Error;
  if (state == nullptr) return fmi3OK;
  delete static_cast<State*>(*state);
  *state = nullptr;
  return fmi3OK;
}
HERSEY_EXPORT fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state, std::size_t* size) {
  return with(instance, [&](Instance& one) {
    if (state == nullptr || size == nullptr) return one.error("no state to serialise");
    auto& kept = *static_cast<State*>(state);
    if (kept.bytes.empty()) kept.bytes = hersey::fmu::to_bytes(*kept.state);
    *size = kept.bytes.size();
    return CallStatus::ok;
  });
}
HERSEY_EXPORT fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state, fmi3Byte* bytes,
                                               std::size_t size) {
  std::size_t needed = 0;
  if (const fmi3Status status = fmi3SerializedFMUStateSize(instance, state, &needed); status != fmi3OK) return status;
  return with(instance, [&](Instance& one) {
    if (bytes == nullptr || size < needed) return one.error("too little room for the serialised state");
    std::memcpy(bytes, static_cast<State*>(state)->bytes.data(), needed);
    return CallStatus::ok;
  });
}
HERSEY_EXPORT fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte* bytes, std::size_t size,
                                                 fmi3FMUState* state) {
  return with(instance, [&](Instance& one) {
    if (bytes == nullptr || state == nullptr) return one.error("no bytes of a serialised state");
    auto restored = std::make_unique<InstanceState>(hersey::fmu::from_bytes(bytes, size));
    if (*state == nullptr) *state = new State;
    auto& kept = *static_cast<State*>(*state);
    kept.state = std::move(restored);
    kept.bytes.clear();
    return CallStatus::ok;
  });
}

HERSEY_EXPORT fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 time, fmi3Float64 length,
                                    fmi3Boolean /*keeps_no_state*/, fmi3Boolean* needs_events, fmi3Boolean* ends,
                                    fmi3Boolean* is_early, fmi3Float64* last_successful_time) {
  return with(instance, [&](Instance& one) {
    double reached = time;
    bool has_ended = false;
    const CallStatus outcome = one.step(time, length, reached, has_ended);
    if (needs_events != nullptr) *needs_events = false;
    if (ends != nullptr) *ends = has_ended;
    if (is_early != nullptr) *is_early = false;
    if (last_successful_time != nullptr) *last_successful_time = reached;
    // A normal end is not a failure: the importer is asked to terminate.
    return has_ended ? CallStatus::ok : outcome;
  });
}

HERSEY_EXPORT fmi3Status fmi3EnterStepMode(fmi3Instance instance) { return unsupported(instance, "event mode is"); }
HERSEY_EXPORT fmi3Status fmi3EnterEventMode(fmi3Instance instance) { return unsupported(instance, "event mode is"); }
HERSEY_EXPORT fmi3Status fmi3EnterConfigurationMode(fmi3Instance instance) {
  return unsupported(instance, "structural parameters are");
}
HERSEY_EXPORT fmi3Status fmi3ExitConfigurationMode(fmi3Instance instance) {
  return unsupported(instance, "structural parameters are");
}
HERSEY_EXPORT fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance, fmi3ValueReference, std::size_t*) {
  return unsupported(instance, "dependencies of variables are");
}
HERSEY_EXPORT fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference, std::size_t*,
                                                     fmi3ValueReference*, std::size_t*, fmi3DependencyKind*,
                                                     std::size_t) {
  return unsupported(instance, "dependencies of variables are");
}
HERSEY_EXPORT fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference*, std::size_t,
                                                      const fmi3ValueReference*, std::size_t, const fmi3Float64*,
                                                      std::size_t, fmi3Float64*, std::size_t) {
  return unsupported(instance, "directional derivatives are");
}
HERSEY_EXPORT fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference*, std::size_t,
                                                  const fmi3ValueReference*, std::size_t, const fmi3Float64*,
                                                  std::size_t, fmi3Float64*, std::size_t) {
  return unsupported(instance, "adjoint derivatives are");
}
HERSEY_EXPORT fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference*, std::size_t,
                                                  const std::int32_t*, fmi3Float64*, std::size_t) {
  return unsupported(instance, "derivatives of outputs are");
}
HERSEY_EXPORT fmi3Status fmi3GetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference*, std::size_t,
                                                fmi3Float64*, fmi3IntervalQualifier*) {
  return unsupported(instance, "clocks are");
}
HERSEY_EXPORT fmi3Status fmi3GetIntervalFraction(fmi3Instance instance, const fmi3ValueReference*, std::size_t,
                                                 std::uint64_t*, std::uint64_t*, fmi3IntervalQualifier*) {
  return unsupported(instance, "clocks are");
}
HERSEY_EXPORT fmi3Status fmi3GetShiftDecimal(fmi3Instance instance, const fmi3ValueReference*, std::size_t,
                                             fmi3Float64*) {
  return unsupported(instance, "clocks are");
}
HERSEY_EXPORT fmi3Status fmi3GetShiftFraction(fmi3Instance instance, const fmi3ValueReference*, std::size_t,
                                              std::uint64_t*, std::uint64_t*) {
  return unsupported(instance, "clocks are");
}
HERSEY_EXPORT fmi3Status fmi3SetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference*, std::size_t,
                                                const fmi3Float64*) {
  return unsupported(instance, "clocks are");
}
HERSEY_EXPORT fmi3Status fmi3SetIntervalFraction(fmi3Instance instance, const fmi3ValueReference*, std::size_t,
                                                 const std::uint64_t*, const std::uint64_t*) {
  return unsupported(instance, "clocks are");
}
HERSEY_EXPORT fmi3Status fmi3SetShiftDecimal(fmi3Instance instance, const fmi3ValueReference*, std::size_t,
                                             const fmi3Float64*) {
  return unsupported(instance, "clocks are");
}
HERSEY_EXPORT fmi3Status fmi3SetShiftFraction(fmi3Instance instance, const fmi3ValueReference*, std::size_t,
                                              const std::uint64_t*, const std::uint64_t*) {
  return unsupported(instance, "clocks are");
}
HERSEY_EXPORT fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance) {
  return unsupported(instance, "discrete states are");
}
HERSEY_EXPORT fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean*, fmi3Boolean*, fmi3Boolean*,
                                                  fmi3Boolean*, fmi3Boolean*, fmi3Float64*) {
  return unsupported(instance, "discrete states are");
}
HERSEY_EXPORT fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance) {
  return unsupported(instance, "model exchange is");
}
HERSEY_EXPORT fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean, fmi3Boolean*, fmi3Boolean*) {
  return unsupported(instance, "model exchange is");
}
HERSEY_EXPORT fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64) {
  return unsupported(instance, "model exchange is");
}
HERSEY_EXPORT fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64*, std::size_t) {
  return unsupported(instance, "model exchange is");
}
HERSEY_EXPORT fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64*, std::size_t) {
  return unsupported(instance, "model exchange is");
}
HERSEY_EXPORT fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64*, std::size_t) {
  return unsupported(instance, "model exchange is");
}
HERSEY_EXPORT fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64*, std::size_t) {
  return unsupported(instance, "model exchange is");
}
HERSEY_EXPORT fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance instance, fmi3Float64*, std::size_t) {
  return unsupported(instance, "model exchange is");
}
HERSEY_EXPORT fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, std::size_t*) {
  return unsupported(instance, "model exchange is");
}
HERSEY_EXPORT fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, std::size_t*) {
  return unsupported(instance, "model exchange is");
}
HERSEY_EXPORT fmi3Status fmi3ActivateModelPartition(fmi3Instance instance, fmi3ValueReference, fmi3Float64) {
  return unsupported(instance, "scheduled execution is");
}
}
