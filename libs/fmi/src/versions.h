#pragma once

#include <memory>
#include <string>

#include "hersey/fmi/instance.h"

namespace hersey::fmi {

// One instance for each version of the standard; see instantiate().
[[nodiscard]] std::unique_ptr<Instance> instantiate_2(const FmuFile& file, const Description& description,
                                                      const std::string& name);
[[nodiscard]] std::unique_ptr<Instance> instantiate_3(const FmuFile& file, const Description& description,
                                                      const std::string& name);

}  // namespace hersey::fmi
