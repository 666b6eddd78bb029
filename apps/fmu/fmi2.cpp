#include "fmi2.h"

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

struct Component {
  std::unique_ptr<Instance> instance;
  double last_successful_time = 0;
  bool is_terminated = false;
};

struct State {
  std::unique_ptr<InstanceState> state;
  std::vector<unsigned char> bytes;  ///< serialised when its size was asked for
};

fmi2Status status_of(CallStatus outcome) {
  switch (outcome) {
    case CallStatus::ok:
      return fmi2OK;
    case CallStatus::warning:
      return fmi2Warning;
    case CallStatus::discard:
      return fmi2Discard;
    case CallStatus::error:
      return fmi2Error;
  }
  return fmi2Fatal;
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

Component* component_of(fmi2Component component) { return static_cast<Component*>(component); }

// No instance, no answer; no exception leaves the library.
template <class Action>
fmi2Status with(fmi2Component component, const Action& action) {
  if (component == nullptr) return fmi2Error;
  Component& one = *component_of(component);
  try {
    return status_of(action(one));
  } catch (const std::exception& failure) {
    return status_of(one.instance->error(hersey::error_text(failure)));
  }
}

fmi2Status without_variables(fmi2Component component, std::size_t count, const char* type) {
  return with(component, [&](Component& one) {
    return count == 0 ? CallStatus::ok : one.instance->error(std::string("this FMU has no variables of type ") + type);
  });
}

fmi2Status unsupported(fmi2Component component, const char* what) {
  return with(component, [&](Component& one) { return one.instance->error(std::string(what) + " are not provided"); });
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
    given.logger(given.componentEnvironment, own_name.c_str(), status_of(outcome), category, escaped(message).c_str());
  };
  try {
    if (own_name.empty()) throw std::runtime_error("an instance without a name");
    if (type != fmi2CoSimulation) throw std::runtime_error("this FMU is for co-simulation only");
    if (guid == nullptr) throw std::runtime_error("an instance without a GUID");
    auto component = std::make_unique<Component>();
    component->instance = std::make_unique<Instance>(
        own_name, guid, hersey::fmu::path_of_uri(resources != nullptr ? resources : ""), log);
    component->instance->set_logging(logging != 0);
    return component.release();
  } catch (const std::exception& failure) {
    log(CallStatus::error, "logStatusError", hersey::error_text(failure));
    return nullptr;
  }
}

HERSEY_EXPORT void fmi2FreeInstance(fmi2Component component) { delete component_of(component); }

HERSEY_EXPORT fmi2Status fmi2SetDebugLogging(fmi2Component component, fmi2Boolean on, std::size_t /*count*/,
                                             const fmi2String* /*categories*/) {
  return with(component, [&](Component& one) {
    one.instance->set_logging(on != 0);
    return CallStatus::ok;
  });
}

HERSEY_EXPORT fmi2Status fmi2SetupExperiment(fmi2Component component, fmi2Boolean /*has_tolerance*/,
                                             fmi2Real /*tolerance*/, fmi2Real start, fmi2Boolean has_stop,
                                             fmi2Real stop) {
  return with(component, [&](Component& one) {
    return one.instance->set_up(start, has_stop != 0 ? std::optional(stop) : std::nullopt);
  });
}

HERSEY_EXPORT fmi2Status fmi2EnterInitializationMode(fmi2Component component) {
  return with(component, [](Component& one) { return one.instance->enter_initialisation(); });
}
HERSEY_EXPORT fmi2Status fmi2ExitInitializationMode(fmi2Component component) {
  return with(component, [](Component& one) { return one.instance->exit_initialisation(); });
}
HERSEY_EXPORT fmi2Status fmi2Terminate(fmi2Component component) {
  return with(component, [](Component& one) { return one.instance->terminate(); });
}
HERSEY_EXPORT fmi2Status fmi2Reset(fmi2Component component) {
  return with(component, [](Component& one) {
    one.last_successful_time = 0;
    one.is_terminated = false;
    return one.instance->reset();
  });
}

HERSEY_EXPORT fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference* references, std::size_t count,
                                     fmi2Real* values) {
  return with(component, [&](Component& one) { return one.instance->get(references, count, values); });
}
HERSEY_EXPORT fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference* references, std::size_t count,
                                     const fmi2Real* values) {
  return with(component, [&](Component& one) { return one.instance->set(references, count, values); });
}
HERSEY_EXPORT fmi2Status fmi2GetInteger(fmi2Component component, const fmi2ValueReference*, std::size_t count,
                                        fmi2Integer*) {
  return without_variables(component, count, "Integer");
}
HERSEY_EXPORT fmi2Status fmi2SetInteger(fmi2Component component, const fmi2ValueReference*, std::size_t count,
                                        const fmi2Integer*) {
  return without_variables(component, count, "Integer");
}
HERSEY_EXPORT fmi2Status fmi2GetBoolean(fmi2Component component, const fmi2ValueReference*, std::size_t count,
                                        fmi2Boolean*) {
  return without_variables(component, count, "Boolean");
}
HERSEY_EXPORT fmi2Status fmi2SetBoolean(fmi2Component component, const fmi2ValueReference*, std::size_t count,
                                        const fmi2Boolean*) {
  return without_variables(component, count, "Boolean");
}
HERSEY_EXPORT fmi2Status fmi2GetString(fmi2Component component, const fmi2ValueReference*, std::size_t count,
                                       fmi2String*) {
  return without_variables(component, count, "String");
}
HERSEY_EXPORT fmi2Status fmi2SetString(fmi2Component component, const fmi2ValueReference*, std::size_t count,
                                       const fmi2String*) {
  return without_variables(component, count, "String");
}

HERSEY_EXPORT fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate* state) {
  return with(component, [&](Component& one) {
    if (state == nullptr) return one.instance->error("no room for a state");
    std::unique_ptr<InstanceState> saved;
    const CallStatus outcome = one.instance->save(saved);
    if (outcome != CallStatus::ok) return outcome;
    if (*state == nullptr) *state = new State;
    auto& kept = *static_cast<State*>(*state);
    kept.state = std::move(saved);
    kept.bytes.clear();
    return CallStatus::ok;
  });
}
HERSEY_EXPORT fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate state) {
  return with(component, [&](Component& one) {
    if (state == nullptr) return one.instance->error("no state to restore");
    return one.instance->restore(*static_cast<State*>(state)->state);
  });
}
HERSEY_EXPORT fmi2Status fmi2FreeFMUstate(fmi2Component component, fmi2FMUstate* state) {
  if (component == nullptr) return fmi2Error;
  if (state == nullptr) return fmi2OK;
  delete static_cast<State*>(*state);
  *state = nullptr;
  return fmi2OK;
}
HERSEY_EXPORT fmi2Status fmi2SerializedFMUstateSize(fmi2Component component, fmi2FMUstate state, std::size_t* size) {
  return with(component, [&](Component& one) {
    if (state == nullptr || size == nullptr) return one.instance->error("no state to serialise");
    auto& kept = *static_cast<State*>(state);
    if (kept.bytes.empty()) kept.bytes = hersey::fmu::to_bytes(*kept.state);
    *size = kept.bytes.size();
    return CallStatus::ok;
  });
}
HERSEY_EXPORT fmi2Status fmi2SerializeFMUstate(fmi2Component component, fmi2FMUstate state, fmi2Byte* bytes,
                                               std::size_t size) {
  std::size_t needed = 0;
  if (const fmi2Status status = fmi2SerializedFMUstateSize(component, state, &needed); status != fmi2OK) return status;
  return with(component, [&](Component& one) {
    if (bytes == nullptr || size < needed) return one.instance->error("too little room for the serialised state");
    std::memcpy(bytes, static_cast<State*>(state)->bytes.data(), needed);
    return CallStatus::ok;
  });
}
HERSEY_EXPORT fmi2Status fmi2DeSerializeFMUstate(fmi2Component component, const fmi2Byte* bytes, std::size_t size,
                                                 fmi2FMUstate* state) {
  return with(component, [&](Component& one) {
    if (bytes == nullptr || state == nullptr) return one.instance->error("no bytes of a serialised state");
    auto restored =
        std::make_unique<InstanceState>(hersey::fmu::from_bytes(reinterpret_cast<const unsigned char*>(bytes), size));
    if (*state == nullptr) *state = new State;
    auto& kept = *static_cast<State*>(*state);
    kept.state = std::move(restored);
    kept.bytes.clear();
    return CallStatus::ok;
  });
}

HERSEY_EXPORT fmi2Status fmi2GetDirectionalDerivative(fmi2Component component, const fmi2ValueReference*, std::size_t,
                                                      const fmi2ValueReference*, std::size_t, const fmi2Real*,
                                                      fmi2Real*) {
  return unsupported(component, "directional derivatives");
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
  return with(component, [&](Component& one) {
    return one.instance->step(time, length, one.last_successful_time, one.is_terminated);
  });
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
  *value = component_of(component)->last_successful_time;
  return fmi2OK;
}
HERSEY_EXPORT fmi2Status fmi2GetIntegerStatus(fmi2Component component, const fmi2StatusKind, fmi2Integer*) {
  return component == nullptr ? fmi2Error : fmi2Discard;
}
HERSEY_EXPORT fmi2Status fmi2GetBooleanStatus(fmi2Component component, const fmi2StatusKind kind, fmi2Boolean* value) {
  if (component == nullptr || value == nullptr) return fmi2Error;
  if (kind != fmi2Terminated) return fmi2Discard;
  *value = component_of(component)->is_terminated ? 1 : 0;
  return fmi2OK;
}
HERSEY_EXPORT fmi2Status fmi2GetStringStatus(fmi2Component component, const fmi2StatusKind, fmi2String*) {
  return component == nullptr ? fmi2Error : fmi2Discard;
}
}
