#include "hersey/model/bare_numbers.h"

#include <optional>

#include "check/bare_numbers_in.h"
#include "interpret/read/reader.h"
#include "schema/format.h"

namespace hersey::model {

std::vector<BareNumber> bare_numbers(const std::string& text, const std::string& file,
                                     const std::vector<std::string>& overrides) {
  std::vector<Fault> ignored;
  const std::vector<Override> changes = parse_overrides(overrides, ignored);
  std::optional<Node> root = parse_yaml(text, file, ignored);
  if (!root) return {};
  (void)complete_tree(*root, changes, ignored);
  return bare_numbers_in(*root, model_format());
}

}  // namespace hersey::model
