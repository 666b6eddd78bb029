#pragma once

#include <filesystem>
#include <string>

#include "hersey/fmi/description.h"
#include "hersey/fmi/fmu_file.h"
#include "temporary_folder.h"

namespace hersey::fmi {

/// The library of an unpacked FMU.
class LoadedLibrary {
 public:
  /// @throws FmuError with the loader's words
  LoadedLibrary(const FmuFile& file, const Description& description);
  ~LoadedLibrary();
  LoadedLibrary(const LoadedLibrary&) = delete;
  LoadedLibrary& operator=(const LoadedLibrary&) = delete;

  /// The function called `name`, as one of this type. @throws FmuError if the library has none
  template <class Function>
  void find(Function*& function, const char* name) const {
    function = reinterpret_cast<Function*>(symbol(name));
  }
  /// Path of the FMU, for whoever marks its calls (ForeignCode).
  [[nodiscard]] const char* file() const { return file_.c_str(); }
  /// Path of the folder `resources`, whether the FMU has one or not.
  [[nodiscard]] std::filesystem::path resources() const { return folder_.path() / "resources"; }

 private:
  [[nodiscard]] void* symbol(const char* name) const;

  std::string file_;
  TemporaryFolder folder_;
  void* handle_ = nullptr;
};

/// What an FMU logs in the course of a call.
class CallLog {
 public:
  void clear() { text_.clear(), warns_ = false; }
  void add(const std::string& message, bool is_warning);
  /// True if one of the messages is a warning.
  [[nodiscard]] bool warns() const { return warns_; }
  /// ": " and the messages; empty if there are none.
  [[nodiscard]] std::string text() const { return text_.empty() ? std::string() : ": " + text_; }

 private:
  std::string text_;
  bool warns_ = false;
};

}  // namespace hersey::fmi
