#include "hersey/fmi/instance.h"
#include "versions.h"

namespace hersey::fmi {

std::unique_ptr<Instance> instantiate(const FmuFile& file, const Description& description, const std::string& name) {
  return description.version == 2 ? instantiate_2(file, description, name) : instantiate_3(file, description, name);
}

}  // namespace hersey::fmi
