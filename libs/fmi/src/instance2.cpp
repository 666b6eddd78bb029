#include <fmt/format.h>

#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "hersey/core/untrusted_file.h"
#include "hersey/fmi/fmi2_types.h"
#include "loaded_library.h"
#include "versions.h"

namespace hersey::fmi {
namespace {

extern "C" void log_of_fmi2(fmi2ComponentEnvironment environment, fmi2String /*instance*/, fmi2Status status,
                            fmi2String /*category*/, fmi2String format, ...) {
  if (format == nullptr) return;
  std::array<char, 1000> text{};
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text.data(), text.size(), format, arguments);
  va_end(arguments);
  static_cast<CallLog*>(environment)->add(text.data(), status == fmi2Warning);
}

const char* word_for(fmi2Status status) {
  switch (status) {
    case fmi2OK:
      return "ok";
    case fmi2Warning:
      return "warning";
    case fmi2Discard:
      return "discard";
    case fmi2Error:
      return "error";
    case fmi2Fatal:
      return "fatal";
    case fmi2Pending:
      return "pending";
  }
  return "unknown";
}

/// Path as a URI: signs that have a meaning there, and bytes beyond ASCII, by their number (RFC 3986).
std::string uri_of(const std::filesystem::path& path) {
  std::string uri = "file://";
  for (const char c : path.string()) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = (byte >= '0' && byte <= '9') || (byte >= 'A' && byte <= 'Z') ||
                          (byte >= 'a' && byte <= 'z') || std::string_view("/-_.~").find(c) != std::string_view::npos;
    uri += is_plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return uri;
}

using References2 = const fmi2ValueReference*;

/// The functions of FMI 2.0 that are called.
struct Functions2 {
  fmi2Component (*instantiate)(fmi2String name, fmi2Type, fmi2String guid, fmi2String resources,
                               const fmi2CallbackFunctions*, fmi2Boolean visible, fmi2Boolean logging) = nullptr;
  void (*free_instance)(fmi2Component) = nullptr;
  fmi2Status (*set_up)(fmi2Component, fmi2Boolean, fmi2Real tolerance, fmi2Real start, fmi2Boolean,
                       fmi2Real stop) = nullptr;
  fmi2Status (*enter)(fmi2Component) = nullptr;
  fmi2Status (*exit)(fmi2Component) = nullptr;
  fmi2Status (*terminate)(fmi2Component) = nullptr;
  fmi2Status (*get_real)(fmi2Component, References2, std::size_t, fmi2Real*) = nullptr;
  fmi2Status (*set_real)(fmi2Component, References2, std::size_t, const fmi2Real*) = nullptr;
  fmi2Status (*set_integer)(fmi2Component, References2, std::size_t, const fmi2Integer*) = nullptr;
  fmi2Status (*set_boolean)(fmi2Component, References2, std::size_t, const fmi2Boolean*) = nullptr;
  fmi2Status (*set_string)(fmi2Component, References2, std::size_t, const fmi2String*) = nullptr;
  fmi2Status (*step)(fmi2Component, fmi2Real time, fmi2Real length, fmi2Boolean) = nullptr;
  // Of FMUs that save their state
  fmi2Status (*get_state)(fmi2Component, fmi2FMUstate*) = nullptr;
  fmi2Status (*set_state)(fmi2Component, fmi2FMUstate) = nullptr;
  fmi2Status (*free_state)(fmi2Component, fmi2FMUstate*) = nullptr;
  fmi2Status (*state_size)(fmi2Component, fmi2FMUstate, std::size_t*) = nullptr;
  fmi2Status (*serialise)(fmi2Component, fmi2FMUstate, fmi2Byte*, std::size_t) = nullptr;
  fmi2Status (*deserialise)(fmi2Component, const fmi2Byte*, std::size_t, fmi2FMUstate*) = nullptr;

  Functions2(const LoadedLibrary& library, bool saves_state) {
    library.find(instantiate, "fmi2Instantiate");
    library.find(free_instance, "fmi2FreeInstance");
    library.find(set_up, "fmi2SetupExperiment");
    library.find(enter, "fmi2EnterInitializationMode");
    library.find(exit, "fmi2ExitInitializationMode");
    library.find(terminate, "fmi2Terminate");
    library.find(get_real, "fmi2GetReal");
    library.find(set_real, "fmi2SetReal");
    library.find(set_integer, "fmi2SetInteger");
    library.find(set_boolean, "fmi2SetBoolean");
    library.find(set_string, "fmi2SetString");
    library.find(step, "fmi2DoStep");
    if (!saves_state) return;
    library.find(get_state, "fmi2GetFMUstate");
    library.find(set_state, "fmi2SetFMUstate");
    library.find(free_state, "fmi2FreeFMUstate");
    library.find(state_size, "fmi2SerializedFMUstateSize");
    library.find(serialise, "fmi2SerializeFMUstate");
    library.find(deserialise, "fmi2DeSerializeFMUstate");
  }
};

class Instance2 final : public Instance {
 public:
  Instance2(const FmuFile& file, const Description& description, const std::string& name)
      : saves_state_(description.saves_state),
        library_(file, description),
        call_(library_, saves_state_),
        callbacks_{log_of_fmi2, std::calloc, std::free, nullptr, &log_} {
    component_ = call_.instantiate(name.c_str(), fmi2CoSimulation, description.token.c_str(),
                                   uri_of(library_.resources()).c_str(), &callbacks_, 0, 0);
    if (component_ == nullptr) throw FmuError("fmi2Instantiate makes no instance" + log_.text());
  }

  ~Instance2() override {
    if (component_ == nullptr) return;  // after a fatal error no function may be called
    if (is_stepping_) (void)call_.terminate(component_);
    call_.free_instance(component_);
  }

  void set_start(const Variable& variable, double value) override {
    const auto whole = static_cast<int>(value);
    if (variable.type == VariableType::real)
      must("fmi2SetReal", call_.set_real, &variable.reference, 1, &value);
    else if (variable.type == VariableType::boolean)
      must("fmi2SetBoolean", call_.set_boolean, &variable.reference, 1, &whole);
    else
      must("fmi2SetInteger", call_.set_integer, &variable.reference, 1, &whole);
  }
  void set_start(const Variable& variable, const std::string& text) override {
    const char* signs = text.c_str();
    must("fmi2SetString", call_.set_string, &variable.reference, 1, &signs);
  }

  void enter_initialisation(double start, double stop) override {
    must("fmi2SetupExperiment", call_.set_up, 0, 0.0, start, 1, stop);
    must("fmi2EnterInitializationMode", call_.enter);
  }
  void exit_initialisation() override {
    must("fmi2ExitInitializationMode", call_.exit);
    is_stepping_ = true;
  }

  void set(std::span<const unsigned> references, std::span<const double> values) override {
    if (!references.empty()) must("fmi2SetReal", call_.set_real, references.data(), references.size(), values.data());
  }
  void get(std::span<const unsigned> references, std::span<double> values) override {
    if (!references.empty()) must("fmi2GetReal", call_.get_real, references.data(), references.size(), values.data());
  }

  void step(double time, double length) override { must("fmi2DoStep", call_.step, time, length, saves_state_ ? 0 : 1); }

  std::vector<unsigned char> save() override {
    fmi2FMUstate state = nullptr;
    must("fmi2GetFMUstate", call_.get_state, &state);
    std::size_t size = 0;
    must("fmi2SerializedFMUstateSize", call_.state_size, state, &size);
    std::vector<unsigned char> bytes(size);
    must("fmi2SerializeFMUstate", call_.serialise, state, reinterpret_cast<fmi2Byte*>(bytes.data()), size);
    must("fmi2FreeFMUstate", call_.free_state, &state);
    return bytes;
  }
  void restore(std::span<const unsigned char> bytes) override {
    fmi2FMUstate state = nullptr;
    must("fmi2DeSerializeFMUstate", call_.deserialise, reinterpret_cast<const fmi2Byte*>(bytes.data()), bytes.size(),
         &state);
    must("fmi2SetFMUstate", call_.set_state, state);
    must("fmi2FreeFMUstate", call_.free_state, &state);
    is_stepping_ = true;
  }

 private:
  template <class Function, class... Arguments>
  void must(const char* name, Function function, Arguments... arguments) {
    log_.clear();
    const ForeignCode in_library(library_.file());
    const fmi2Status status = function(component_, arguments...);
    if (status == fmi2Warning || (status == fmi2OK && log_.warns()))
      warn(fmt::format("{}{}{}", name, status == fmi2Warning ? " ends with status warning" : "", log_.text()));
    if (status == fmi2OK || status == fmi2Warning) return;
    if (status == fmi2Error) is_stepping_ = false;
    if (status == fmi2Fatal) component_ = nullptr;
    throw FmuError(fmt::format("{} ends with status {}{}", name, word_for(status), log_.text()));
  }

  bool saves_state_;  ///< the importer may return to a saved state, so that it does not promise the contrary
  LoadedLibrary library_;
  Functions2 call_;
  CallLog log_;
  fmi2CallbackFunctions callbacks_;
  fmi2Component component_ = nullptr;
  bool is_stepping_ = false;
};

}  // namespace

std::unique_ptr<Instance> instantiate_2(const FmuFile& file, const Description& description, const std::string& name) {
  return std::make_unique<Instance2>(file, description, name);
}

}  // namespace hersey::fmi
