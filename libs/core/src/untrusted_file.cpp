#include "hersey/core/untrusted_file.h"

namespace hersey {
namespace {

thread_local const char* current = nullptr;

}  // namespace

const char* untrusted_file() { return current; }

DoubtfulFile::DoubtfulFile(const char* path) : before_(current) {
  if (path != nullptr) current = path;
}

DoubtfulFile::~DoubtfulFile() { current = before_; }

}  // namespace hersey
