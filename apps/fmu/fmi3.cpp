#include <string>

#include "face.h"
#include "hersey/fmi/fmi3_types.h"
#include "resource_path.h"

using hersey::fmu::CallStatus;
using hersey::fmu::Instance;

namespace {

static_assert(static_cast<int>(CallStatus::ok) == fmi3OK && static_cast<int>(CallStatus::warning) == fmi3Warning &&
              static_cast<int>(CallStatus::discard) == fmi3Discard && static_cast<int>(CallStatus::error) == fmi3Error);

template <class Action, class... Arguments>
fmi3Status ask(fmi3Instance instance, const Action& action, Arguments... arguments) {
  return hersey::fmu::ask<fmi3Status>(instance, action, arguments...);
}

fmi3Status unsupported(fmi3Instance instance, const char* what) {
  return ask(instance, &Instance::error, std::string(what) + " not provided by this FMU");
}

Instance::Log log_of(fmi3InstanceEnvironment environment, fmi3LogMessageCallback log) {
  return [environment, log](CallStatus outcome, const char* category, const std::string& message) {
    if (log != nullptr) log(environment, static_cast<fmi3Status>(outcome), category, message.c_str());
  };
}

fmi3Instance refuse(fmi3InstanceEnvironment environment, fmi3LogMessageCallback log) {
  log_of(environment, log)(CallStatus::error, "logStatusError", "this FMU is for co-simulation only");
  return nullptr;
}

// Inputs are set between communication steps only. Outputs can be read behind every step of the solver.
Instance::IntermediateUpdate intermediate_update_of(fmi3InstanceEnvironment environment,
                                                    fmi3IntermediateUpdateCallback update, bool can_return_early) {
  return [environment, update, can_return_early](double time) -> std::optional<double> {
    fmi3Boolean is_requested = false;
    fmi3Float64 early_time = time;
    update(environment, time, false, true, true, can_return_early, &is_requested, &early_time);
    return can_return_early && is_requested ? std::optional(early_time) : std::nullopt;
  };
}

CallStatus require_one_value_each(Instance& instance, std::size_t count, std::size_t value_count) {
  return count == value_count ? CallStatus::ok
                              : instance.error("every variable that is set has one value: as many of both are due");
}

}  // namespace

extern "C" {

HERSEY_EXPORT const char* fmi3GetVersion() { return "3.0"; }

HERSEY_EXPORT fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean on, std::size_t /*count*/,
                                             const fmi3String* /*categories*/) {
  return ask(instance, &Instance::set_logging, on);
}

HERSEY_EXPORT fmi3Instance fmi3InstantiateModelExchange(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean,
                                                        fmi3InstanceEnvironment environment,
                                                        fmi3LogMessageCallback log) {
  return refuse(environment, log);
}

HERSEY_EXPORT fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean /*visible*/, fmi3Boolean logging,
    fmi3Boolean /*event_mode_used*/, fmi3Boolean early_return_allowed, const fmi3ValueReference* intermediate_variables,
    std::size_t count, fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
    fmi3IntermediateUpdateCallback intermediate_update) {
  const Instance::Log report = log_of(environment, log);
  return hersey::fmu::instantiate(report, [&] {
    // A path; FMI 2, and importers that have grown up with it, name a URI.
    const std::string folder = resources != nullptr ? resources : "";
    auto made = std::make_unique<Instance>(
        name, token, "an instantiation token",
        folder.starts_with("file:") ? hersey::fmu::path_of_uri(folder) : std::filesystem::path(folder), logging,
        report);
    if (intermediate_update != nullptr)
      made->update_intermediately(intermediate_update_of(environment, intermediate_update, early_return_allowed),
                                  intermediate_variables, intermediate_variables == nullptr ? 0 : count);
    return made;
  });
}

HERSEY_EXPORT fmi3Instance fmi3InstantiateScheduledExecution(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                                             fmi3Boolean, fmi3InstanceEnvironment environment,
                                                             fmi3LogMessageCallback log, fmi3ClockUpdateCallback,
                                                             fmi3LockPreemptionCallback, fmi3UnlockPreemptionCallback) {
  return refuse(environment, log);
}

HERSEY_EXPORT void fmi3FreeInstance(fmi3Instance instance) { delete static_cast<Instance*>(instance); }

HERSEY_EXPORT fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean /*has_tolerance*/,
                                                     fmi3Float64 /*tolerance*/, fmi3Float64 start, fmi3Boolean has_stop,
                                                     fmi3Float64 stop) {
  return ask(instance, [&](Instance& one) {
    const CallStatus outcome = one.set_up(start, has_stop ? std::optional(stop) : std::nullopt);
    return outcome == CallStatus::ok ? one.enter_initialisation() : outcome;
  });
}
HERSEY_EXPORT fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
  return ask(instance, &Instance::exit_initialisation);
}
HERSEY_EXPORT fmi3Status fmi3Terminate(fmi3Instance instance) { return ask(instance, &Instance::terminate); }
HERSEY_EXPORT fmi3Status fmi3Reset(fmi3Instance instance) { return ask(instance, &Instance::reset); }

HERSEY_EXPORT fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference* references, std::size_t count,
                                        fmi3Float64* values, std::size_t value_count) {
  return ask(instance, &Instance::get, references, count, values, value_count);
}
HERSEY_EXPORT fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference* references, std::size_t count,
                                        const fmi3Float64* values, std::size_t value_count) {
  return ask(instance, [&](Instance& one) {
    const CallStatus counted = require_one_value_each(one, count, value_count);
    return counted == CallStatus::ok ? one.set(references, count, values) : counted;
  });
}

// All variables are of type Float64.
#define HERSEY_NO_VARIABLES(TYPE)                                                                             \
  HERSEY_EXPORT fmi3Status fmi3Get##TYPE(fmi3Instance instance, const fmi3ValueReference*, std::size_t count, \
                                         fmi3##TYPE*, std::size_t) {                                          \
    return ask(instance, &Instance::require_none, count, #TYPE);                                              \
  }                                                                                                           \
  HERSEY_EXPORT fmi3Status fmi3Set##TYPE(fmi3Instance instance, const fmi3ValueReference*, std::size_t count, \
                                         const fmi3##TYPE*, std::size_t) {                                    \
    return ask(instance, &Instance::require_none, count, #TYPE);                                              \
  }
HERSEY_NO_VARIABLES(Float32)
HERSEY_NO_VARIABLES(Int8)
HERSEY_NO_VARIABLES(UInt8)
HERSEY_NO_VARIABLES(Int16)
HERSEY_NO_VARIABLES(UInt16)
HERSEY_NO_VARIABLES(Int32)
HERSEY_NO_VARIABLES(UInt32)
HERSEY_NO_VARIABLES(Int64)
HERSEY_NO_VARIABLES(UInt64)
HERSEY_NO_VARIABLES(Boolean)
HERSEY_NO_VARIABLES(String)
HERSEY_EXPORT fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                       std::size_t*, fmi3Binary*, std::size_t) {
  return ask(instance, &Instance::require_none, count, "Binary");
}
HERSEY_EXPORT fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                       const std::size_t*, const fmi3Binary*, std::size_t) {
  return ask(instance, &Instance::require_none, count, "Binary");
}
HERSEY_EXPORT fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference*, std::size_t count, fmi3Clock*) {
  return ask(instance, &Instance::require_none, count, "Clock");
}
HERSEY_EXPORT fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference*, std::size_t count,
                                      const fmi3Clock*) {
  return ask(instance, &Instance::require_none, count, "Clock");
}

HERSEY_EXPORT fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState* state) {
  return ask(instance, &Instance::save, state);
}
HERSEY_EXPORT fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state) {
  return ask(instance, &Instance::restore, state);
}
HERSEY_EXPORT fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState* state) {
  return ask(instance, &Instance::free_state, state);
}
HERSEY_EXPORT fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state, std::size_t* size) {
  return ask(instance, &Instance::serialised_size, state, size);
}
HERSEY_EXPORT fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state, fmi3Byte* bytes,
                                               std::size_t size) {
  return ask(instance, &Instance::serialise, state, bytes, size);
}
HERSEY_EXPORT fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte* bytes, std::size_t size,
                                                 fmi3FMUState* state) {
  return ask(instance, &Instance::deserialise, bytes, size, state);
}

HERSEY_EXPORT fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 time, fmi3Float64 length,
                                    fmi3Boolean /*keeps_no_state*/, fmi3Boolean* needs_events, fmi3Boolean* ends,
                                    fmi3Boolean* is_early, fmi3Float64* last_successful_time) {
  return ask(instance, [&](Instance& one) {
    const CallStatus outcome = one.step(time, length);
    if (needs_events != nullptr) *needs_events = false;
    if (ends != nullptr) *ends = one.has_ended();
    if (is_early != nullptr) *is_early = one.has_returned_early();
    if (last_successful_time != nullptr) *last_successful_time = one.last_successful_time();
    // A normal end is not a failure: the importer is asked to terminate.
    return one.has_ended() ? CallStatus::ok : outcome;
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
HERSEY_EXPORT fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference* unknowns,
                                                      std::size_t unknown_count, const fmi3ValueReference* knowns,
                                                      std::size_t known_count, const fmi3Float64* seed,
                                                      std::size_t seed_count, fmi3Float64* derivative,
                                                      std::size_t derivative_count) {
  return ask(instance, &Instance::directional_derivative, unknowns, unknown_count, knowns, known_count, seed,
             seed_count, derivative, derivative_count);
}
HERSEY_EXPORT fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference* unknowns,
                                                  std::size_t unknown_count, const fmi3ValueReference* knowns,
                                                  std::size_t known_count, const fmi3Float64* seed,
                                                  std::size_t seed_count, fmi3Float64* derivative,
                                                  std::size_t derivative_count) {
  return ask(instance, &Instance::adjoint_derivative, unknowns, unknown_count, knowns, known_count, seed, seed_count,
             derivative, derivative_count);
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
