#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <utility>

#include "hersey/core/error_text.h"
#include "instance.h"

#define HERSEY_EXPORT __attribute__((visibility("default")))

/// What the faces of both versions of the standard share: each function of theirs is a call of the core's, and no
/// exception leaves the library.
namespace hersey::fmu {

/// Returns what `action`, a member or any function of the instance behind `handle`, returns for `arguments`; an error
/// without an instance.
template <class Status, class Action, class... Arguments>
Status ask(void* handle, const Action& action, Arguments... arguments) {
  if (handle == nullptr) return static_cast<Status>(CallStatus::error);
  Instance& instance = *static_cast<Instance*>(handle);
  try {
    return static_cast<Status>(std::invoke(action, instance, arguments...));
  } catch (const std::exception& failure) {
    return static_cast<Status>(instance.error(error_text(failure)));
  }
}

/// Returns the instance that `make` makes; null where it throws, and `log` learns why.
template <class Make>
void* instantiate(const Instance::Log& log, const Make& make) {
  try {
    std::unique_ptr<Instance> made = make();
    return made.release();
  } catch (const std::exception& failure) {
    log(CallStatus::error, "logStatusError", error_text(failure));
    return nullptr;
  }
}

}  // namespace hersey::fmu
