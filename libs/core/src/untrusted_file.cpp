#include "hersey/core/untrusted_file.h"

namespace hersey {
namespace {

thread_local const char* current = nullptr;
thread_local const char* foreign = nullptr;

}  // namespace

const char* untrusted_file() { return current; }

UntrustedFile::UntrustedFile(const char* path) : before_(current) {
  if (path != nullptr) current = path;
}

UntrustedFile::~UntrustedFile() { current = before_; }

const char* foreign_code() { return foreign; }

ForeignCode::ForeignCode(const char* path) { foreign = path; }

ForeignCode::~ForeignCode() { foreign = nullptr; }

}  // namespace hersey
