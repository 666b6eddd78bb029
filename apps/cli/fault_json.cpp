#include "fault_json.h"

namespace hersey::cli {

nlohmann::json fault_json(const Fault& fault) {
  return {{"file", fault.position.file},
          {"line", fault.position.line},
          {"column", fault.position.column},
          {"path", fault.path},
          {"found", fault.found},
          {"expected", fault.expected},
          {"suggestion", fault.suggestion}};
}

}  // namespace hersey::cli
