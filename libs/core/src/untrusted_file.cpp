#include "hersey/core/untrusted_file.h"

namespace hersey {
namespace {

thread_local const char* current = nullptr;

}  // namespace

const char* untrusted_file() { return current; }

UntrustedFile::UntrustedFile(const char* path) : before_(current) {
  if (path != nullptr) current = path;
}

UntrustedFile::~UntrustedFile() { current = before_; }

}  // namespace hersey
