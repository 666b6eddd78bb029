#include "hersey/core/memory.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace hersey {
namespace {

double measured() {
  double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  for (const char* const limit : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    double allowed = 0;
    if (std::ifstream(limit) >> allowed && allowed > 0) bytes = std::min(bytes, allowed);  // "max" is no number
  }
  return bytes;
}

}  // namespace

double usable_memory() {
  static const double bytes = measured();
  return bytes;
}

}  // namespace hersey
