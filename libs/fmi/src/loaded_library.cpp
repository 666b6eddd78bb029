#include "loaded_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

namespace hersey::fmi {
namespace {

constexpr std::size_t kLongestLog = 2000;  // characters of one call; FMUs can log a line for each of their variables

}  // namespace

LoadedLibrary::LoadedLibrary(const FmuFile& file, const Description& description) : file_(file.path().string()) {
  if (const std::string why = missing_library(file, description); !why.empty()) throw FmuError(why);
  const std::string name = library_name(description);
  file.extract(name.substr(0, name.rfind('/') + 1), folder_.path());
  file.extract("resources/", folder_.path());
  std::filesystem::create_directories(resources());
  handle_ = ::dlopen((folder_.path() / name).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle_ != nullptr) return;
  const char* why = ::dlerror();
  throw FmuError(fmt::format("its library {} cannot be loaded: {}", name, why == nullptr ? "no reason given" : why));
}

LoadedLibrary::~LoadedLibrary() {
  if (handle_ != nullptr) ::dlclose(handle_);
}

void* LoadedLibrary::symbol(const char* name) const {
  void* found = ::dlsym(handle_, name);
  if (found == nullptr) throw FmuError(fmt::format("its library has no function {}", name));
  return found;
}

void CallLog::add(const std::string& message, bool is_warning) {
  warns_ = warns_ || is_warning;
  if (text_.size() > kLongestLog || message.empty()) return;
  if (!text_.empty()) text_ += "; ";
  text_ += message.substr(0, kLongestLog);
}

}  // namespace hersey::fmi
