#include <string>

#include "face.h"
#include "hersey/fmi/fmi2_types.h"
#include "resource_path.h"

using hersey::fmu::CallStatus;
using hersey::fmu::Instance;

namespace {

static_assert(static_cast<int>(CallStatus::ok) == fmi2OK && static_cast<int>(CallStatus::warning) == fmi2Warning &&
              static_cast<int>(CallStatus::discard) == fmi2Discard && static_cast<int>(CallStatus::error) == fmi2Error);

template <class Action, class... Arguments>
fmi2Status ask(fmi2Component component, const Action& action, Arguments... arguments) {
  return hersey::fmu::ask<fmi2Status>(component, action, arguments...);
}

fmi2Status unsupported(fmi2Component component, const char* what) {
  return ask(component, &Instance::error, std::string(what) + " are not provided");
}

// Importers print messages as printf does, and take #...# for value references.
std::string escaped(const std::string& message) {
  std::string text;
  for (const char c : message) {
    if (c == '%' || c == '#') text += c;
    text += c;
  }
  return text;
}

}  // namespace

extern "C" {

HERSEY_EXPORT const char* fmi2GetTypesPlatform() { return "default"; }
HERSEY_EXPORT const char* fmi2GetVersion() { return "2.0"; }

HERSEY_EXPORT fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                                            const fmi2CallbackFunctions* callbacks, fmi2Boolean /*visible*/,
                                            fmi2Boolean logging) {
  // Without a logger no messages are sent.
  const fmi2CallbackFunctions given = callbacks != nullptr ? *callbacks : fmi2CallbackFunctions{};
  const std::string own_name = name != nullptr ? name : "";
  const auto log = [given, own_name](CallStatus outcome, const char* category, const std::string& message) {
    if (given.logger == nullptr) return;
    given.logger(given.componentEnvironment, own_name.c_str(), static_cast<fmi2Status>(outcome), category,
                 escaped(message).c_str());
  };
  return hersey::fmu::instantiate(log, [&] {
    if (type != fmi2CoSimulation) throw std::runtime_error("this FMU is for co-simulation only");
    return std::make_unique<Instance>(
        name, guid, "a GUID", hersey::fmu::path_of_uri(resources != nullptr ? resources : ""), logging != 0, log);
  });
}

HERSEY_EXPORT void fmi2FreeInstance(fmi2Component component) { delete static_cast<Instance*>(component); }

HERSEY_EXPORT fmi2Status fmi2SetDebugLogging(fmi2Component component, fmi2Boolean on, std::size_t /*count*/,
                                             const fmi2String* /*categories*/) {
  return ask(component, &Instance::set_logging, on != 0);
}

HERSEY_EXPORT fmi2Status fmi2SetupExperiment(fmi2Component component, fmi2Boolean /*has_tolerance*/,
                                             fmi2Real /*tolerance*/, fmi2Real start, fmi2Boolean has_stop,
                                             fmi2Real stop) {
  return ask(component, &Instance::set_up, start, has_stop != 0 ? std::optional(stop) : std::nullopt);
}

HERSEY_EXPORT fmi2Status fmi2EnterInitializationMode(fmi2Component component) {
  return ask(component, &Instance::enter_initialisation);
}
HERSEY_EXPORT fmi2Status fmi2ExitInitializationMode(fmi2Component component) {
  return ask(component, &Instance::exit_initialisation);
}
HERSEY_EXPORT fmi2Status fmi2Terminate(fmi2Component component) { return ask(component, &Instance::terminate); }
HERSEY_EXPORT fmi2Status fmi2Reset(fmi2Component component) { return ask(component, &Instance::reset); }

HERSEY_EXPORT fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference* references, std::size_t count,
                                     fmi2Real* values) {
  return ask(component, &Instance::get, references, count, values, count);
}
HERSEY_EXPORT fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference* references, std::size_t count,
                                     const fmi2Real* values) {
  return ask(component, &Instance::set, references, count, values);
}

// All variables are real.
#define HERSEY_NO_VARIABLES(TYPE)                                                                               \
  HERSEY_EXPORT fmi2Status fmi2Get##TYPE(fmi2Component component, const fmi2ValueReference*, std::size_t count, \
                                         fmi2##TYPE*) {                                                         \
    return ask(component, &Instance::require_none, count, #TYPE);                                               \
  }                                                                                                             \
  HERSEY_EXPORT fmi2Status fmi2Set##TYPE(fmi2Component component, const fmi2ValueReference*, std::size_t count, \
                                         const fmi2##TYPE*) {                                                   \
    return ask(component, &Instance::require_none, count, #TYPE);                                               \
  }
HERSEY_NO_VARIABLES(Integer)
HERSEY_NO_VARIABLES(Boolean)
HERSEY_NO_VARIABLES(String)

HERSEY_EXPORT fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate* state) {
  return ask(component, &Instance::save, state);
}
HERSEY_EXPORT fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate state) {
  return ask(component, &Instance::restore, state);
}
HERSEY_EXPORT fmi2Status fmi2FreeFMUstate(fmi2Component component, fmi2FMUstate* state) {
  return ask(component, &Instance::free_state, state);
}
HERSEY_EXPORT fmi2Status fmi2SerializedFMUstateSize(fmi2Component component, fmi2FMUstate state, std::size_t* size) {
  return ask(component, &Instance::serialised_size, state, size);
}
HERSEY_EXPORT fmi2Status fmi2SerializeFMUstate(fmi2Component component, fmi2FMUstate state, fmi2Byte* bytes,
                                               std::size_t size) {
  return ask(component, &Instance::serialise, state, reinterpret_cast<unsigned char*>(bytes), size);
}
HERSEY_EXPORT fmi2Status fmi2DeSerializeFMUstate(fmi2Component component, const fmi2Byte* bytes, std::size_t size,
                                                 fmi2FMUstate* state) {
  return ask(component, &Instance::deserialise, reinterpret_cast<const unsigned char*>(bytes), size, state);
}

HERSEY_EXPORT fmi2Status fmi2GetDirectionalDerivative(fmi2Component component, const fmi2ValueReference* unknowns,
                                                      std::size_t unknown_count, const fmi2ValueReference* knowns,
                                                      std::size_t known_count, const fmi2Real* seed,
                                                      fmi2Real* derivative) {
  return ask(component, &Instance::directional_derivative, unknowns, unknown_count, knowns, known_count, seed,
             known_count, derivative, unknown_count);
}
HERSEY_EXPORT fmi2Status fmi2SetRealInputDerivatives(fmi2Component component, const fmi2ValueReference*,
                                                     std::size_t count, const fmi2Integer*, const fmi2Real*) {
  return count == 0 && component != nullptr ? fmi2OK : unsupported(component, "derivatives of inputs");
}
HERSEY_EXPORT fmi2Status fmi2GetRealOutputDerivatives(fmi2Component component, const fmi2ValueReference*,
                                                      std::size_t count, const fmi2Integer*, fmi2Real*) {
  return count == 0 && component != nullptr ? fmi2OK : unsupported(component, "derivatives of outputs");
}

HERSEY_EXPORT fmi2Status fmi2DoStep(fmi2Component component, fmi2Real time, fmi2Real length,
                                    fmi2Boolean /*keeps_no_state*/) {
  return ask(component, &Instance::step, time, length);
}
HERSEY_EXPORT fmi2Status fmi2CancelStep(fmi2Component component) {
  return unsupported(component, "asynchronous steps");
}
HERSEY_EXPORT fmi2Status fmi2GetStatus(fmi2Component component, const fmi2StatusKind, fmi2Status*) {
  return component == nullptr ? fmi2Error : fmi2Discard;
}
HERSEY_EXPORT fmi2Status fmi2GetRealStatus(fmi2Component component, const fmi2StatusKind kind, fmi2Real* value) {
  if (component == nullptr || value == nullptr) return fmi2Error;
  if (kind != fmi2LastSuccessfulTime) return fmi2Discard;
  *value = static_cast<Instance*>(component)->last_successful_time();
  return fmi2OK;
}
HERSEY_EXPORT fmi2Status fmi2GetIntegerStatus(fmi2Component component, const fmi2StatusKind, fmi2Integer*) {
  return component == nullptr ? fmi2Error : fmi2Discard;
}
HERSEY_EXPORT fmi2Status fmi2GetBooleanStatus(fmi2Component component, const fmi2StatusKind kind, fmi2Boolean* value) {
  if (component == nullptr || value == nullptr) return fmi2Error;
  if (kind != fmi2Terminated) return fmi2Discard;
  *value = static_cast<Instance*>(component)->has_ended() ? 1 : 0;
  return fmi2OK;
}
HERSEY_EXPORT fmi2Status fmi2GetStringStatus(fmi2Component component, const fmi2StatusKind, fmi2String*) {
  return component == nullptr ? fmi2Error : fmi2Discard;
}
}
