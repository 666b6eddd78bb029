#include <fmt/format.h>

#include "hersey/core/untrusted_file.h"
#include "hersey/fmi/fmi3_types.h"
#include "loaded_library.h"
#include "versions.h"

namespace hersey::fmi {
namespace {

extern "C" void log_of_fmi3(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String /*category*/,
                            fmi3String message) {
  if (message != nullptr) static_cast<CallLog*>(environment)->add(message, status == fmi3Warning);
}

const char* word_for(fmi3Status status) {
  switch (status) {
    case fmi3OK:
      return "ok";
    case fmi3Warning:
      return "warning";
    case fmi3Discard:
      return "discard";
    case fmi3Error:
      return "error";
    case fmi3Fatal:
      return "fatal";
  }
  return "unknown";
}

using References3 = const fmi3ValueReference*;

/// The functions of FMI 3.0 that are called.
struct Functions3 {
  fmi3Instance (*instantiate)(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                              fmi3Boolean logging, fmi3Boolean event_mode, fmi3Boolean early_return,
                              References3 intermediate, std::size_t, fmi3InstanceEnvironment, fmi3LogMessageCallback,
                              fmi3IntermediateUpdateCallback) = nullptr;
  void (*free_instance)(fmi3Instance) = nullptr;
  fmi3Status (*enter)(fmi3Instance, fmi3Boolean, fmi3Float64 tolerance, fmi3Float64 start, fmi3Boolean,
                      fmi3Float64 stop) = nullptr;
  fmi3Status (*exit)(fmi3Instance) = nullptr;
  fmi3Status (*terminate)(fmi3Instance) = nullptr;
  fmi3Status (*get_float64)(fmi3Instance, References3, std::size_t, fmi3Float64*, std::size_t) = nullptr;
  fmi3Status (*set_float64)(fmi3Instance, References3, std::size_t, const fmi3Float64*, std::size_t) = nullptr;
  fmi3Status (*set_int32)(fmi3Instance, References3, std::size_t, const fmi3Int32*, std::size_t) = nullptr;
  fmi3Status (*set_int64)(fmi3Instance, References3, std::size_t, const fmi3Int64*, std::size_t) = nullptr;
  fmi3Status (*set_boolean)(fmi3Instance, References3, std::size_t, const fmi3Boolean*, std::size_t) = nullptr;
  fmi3Status (*set_string)(fmi3Instance, References3, std::size_t, const fmi3String*, std::size_t) = nullptr;
  fmi3Status (*step)(fmi3Instance, fmi3Float64 time, fmi3Float64 length, fmi3Boolean, fmi3Boolean* has_events,
                     fmi3Boolean* ends, fmi3Boolean* is_early, fmi3Float64* reached) = nullptr;
  // Of FMUs that save their state
  fmi3Status (*get_state)(fmi3Instance, fmi3FMUState*) = nullptr;
  fmi3Status (*set_state)(fmi3Instance, fmi3FMUState) = nullptr;
  fmi3Status (*free_state)(fmi3Instance, fmi3FMUState*) = nullptr;
  fmi3Status (*state_size)(fmi3Instance, fmi3FMUState, std::size_t*) = nullptr;
  fmi3Status (*serialise)(fmi3Instance, fmi3FMUState, fmi3Byte*, std::size_t) = nullptr;
  fmi3Status (*deserialise)(fmi3Instance, const fmi3Byte*, std::size_t, fmi3FMUState*) = nullptr;

  Functions3(const LoadedLibrary& library, bool saves_state) {
    library.find(instantiate, "fmi3InstantiateCoSimulation");
    library.find(free_instance, "fmi3FreeInstance");
    library.find(enter, "fmi3EnterInitializationMode");
    library.find(exit, "fmi3ExitInitializationMode");
    library.find(terminate, "fmi3Terminate");
    library.find(get_float64, "fmi3GetFloat64");
    library.find(set_float64, "fmi3SetFloat64");
    library.find(set_int32, "fmi3SetInt32");
    library.find(set_int64, "fmi3SetInt64");
    library.find(set_boolean, "fmi3SetBoolean");
    library.find(set_string, "fmi3SetString");
    library.find(step, "fmi3DoStep");
    if (!saves_state) return;
    library.find(get_state, "fmi3GetFMUState");
    library.find(set_state, "fmi3SetFMUState");
    library.find(free_state, "fmi3FreeFMUState");
    library.find(state_size, "fmi3SerializedFMUStateSize");
    library.find(serialise, "fmi3SerializeFMUState");
    library.find(deserialise, "fmi3DeserializeFMUState");
  }
};

class Instance3 final : public Instance {
 public:
  Instance3(const FmuFile& file, const Description& description, const std::string& name)
      : saves_state_(description.saves_state), library_(file, description), call_(library_, saves_state_) {
    const std::string resources = library_.resources().string() + "/";
    instance_ = call_.instantiate(name.c_str(), description.token.c_str(), resources.c_str(), false, false, false,
                                  false, nullptr, 0, &log_, log_of_fmi3, nullptr);
    if (instance_ == nullptr) throw FmuError("fmi3InstantiateCoSimulation makes no instance" + log_.text());
  }

  ~Instance3() override {
    if (instance_ == nullptr) return;  // after a fatal error no function may be called
    if (is_stepping_) (void)call_.terminate(instance_);
    call_.free_instance(instance_);
  }

  void set_start(const Variable& variable, double value) override {
    if (variable.type == VariableType::real) {
      must("fmi3SetFloat64", call_.set_float64, &variable.reference, 1, &value, 1);
    } else if (variable.type == VariableType::boolean) {
      const bool flag = value != 0;
      must("fmi3SetBoolean", call_.set_boolean, &variable.reference, 1, &flag, 1);
    } else if (variable.type_name == "Int32") {
      const auto whole = static_cast<fmi3Int32>(value);
      must("fmi3SetInt32", call_.set_int32, &variable.reference, 1, &whole, 1);
    } else {
      const auto whole = static_cast<fmi3Int64>(value);
      must("fmi3SetInt64", call_.set_int64, &variable.reference, 1, &whole, 1);
    }
  }
  void set_start(const Variable& variable, const std::string& text) override {
    const char* signs = text.c_str();
    must("fmi3SetString", call_.set_string, &variable.reference, 1, &signs, 1);
  }

  void enter_initialisation(double start, double stop) override {
    must("fmi3EnterInitializationMode", call_.enter, false, 0.0, start, true, stop);
  }
  void exit_initialisation() override {
    must("fmi3ExitInitializationMode", call_.exit);
    is_stepping_ = true;
  }

  void set(std::span<const unsigned> references, std::span<const double> values) override {
    if (references.empty()) return;
    must("fmi3SetFloat64", call_.set_float64, references.data(), references.size(), values.data(), values.size());
  }
  void get(std::span<const unsigned> references, std::span<double> values) override {
    if (references.empty()) return;
    must("fmi3GetFloat64", call_.get_float64, references.data(), references.size(), values.data(), values.size());
  }

  void step(double time, double length) override {
    bool has_events = false, ends = false, is_early = false;
    double reached = time + length;
    must("fmi3DoStep", call_.step, time, length, !saves_state_, &has_events, &ends, &is_early, &reached);
    if (ends || is_early)
      throw FmuError(fmt::format("fmi3DoStep {} t = {:.9g} s{}",
                                 ends ? "asks for the end of the simulation at" : "ends early, at", reached,
                                 log_.text()));
  }

  std::vector<unsigned char> save() override {
    fmi3FMUState state = nullptr;
    must("fmi3GetFMUState", call_.get_state, &state);
    std::size_t size = 0;
    must("fmi3SerializedFMUStateSize", call_.state_size, state, &size);
    std::vector<unsigned char> bytes(size);
    must("fmi3SerializeFMUState", call_.serialise, state, bytes.data(), size);
    must("fmi3FreeFMUState", call_.free_state, &state);
    return bytes;
  }
  void restore(std::span<const unsigned char> bytes) override {
    fmi3FMUState state = nullptr;
    must("fmi3DeserializeFMUState", call_.deserialise, bytes.data(), bytes.size(), &state);
    must("fmi3SetFMUState", call_.set_state, state);
    must("fmi3FreeFMUState", call_.free_state, &state);
    is_stepping_ = true;
  }

 private:
  template <class Function, class... Arguments>
  void must(const char* name, Function function, Arguments... arguments) {
    log_.clear();
    const ForeignCode in_library(library_.file());
    const fmi3Status status = function(instance_, arguments...);
    if (status == fmi3Warning || (status == fmi3OK && log_.warns()))
      warn(fmt::format("{}{}{}", name, status == fmi3Warning ? " ends with status warning" : "", log_.text()));
    if (status == fmi3OK || status == fmi3Warning) return;
    if (status == fmi3Error) is_stepping_ = false;
    if (status == fmi3Fatal) instance_ = nullptr;
    throw FmuError(fmt::format("{} ends with status {}{}", name, word_for(status), log_.text()));
  }

  bool saves_state_;  ///< the importer may return to a saved state, so that it does not promise the contrary
  LoadedLibrary library_;
  Functions3 call_;
  CallLog log_;
  fmi3Instance instance_ = nullptr;
  bool is_stepping_ = false;
};

}  // namespace

std::unique_ptr<Instance> instantiate_3(const FmuFile& file, const Description& description, const std::string& name) {
  return std::make_unique<Instance3>(file, description, name);
}

}  // namespace hersey::fmi
