#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hersey/model/model.h"
#include "hersey/model/text_map.h"

namespace hersey::model {

/// Reads and checks the model file at `path`.
///
/// @param path       a YAML file in the format of docs/model-file.md; tables it names are sought beside it.
/// @param overrides  each "name=value" (a parameter) or "key.path=value", applied before checking.
/// @returns the model in SI units, names and references checked.
/// @throws InputError with every fault of the file, the overrides and the tables.
[[nodiscard]] Model read(const std::string& path, const std::vector<std::string>& overrides = {});

/// As `read`, from text; `file` names it in faults and is where relative paths of tables start.
[[nodiscard]] Model read_text(const std::string& text, const std::string& file,
                              const std::vector<std::string>& overrides = {});

/// A model file that is read several times, with other overrides each time: it is opened and parsed once, and later
/// changes of the file have no effect. May be used by several threads; copies share the parsed content.
class ModelFile {
 public:
  /// @throws InputError if it cannot be read or is larger than any model; other faults are reported by read()
  explicit ModelFile(const std::string& path);
  /// Of text; `file` names it in faults and is where relative paths of tables start.
  ModelFile(std::string text, std::string file);

  /// As model::read. @throws InputError
  [[nodiscard]] Model read(const std::vector<std::string>& overrides = {}) const;
  /// Where everything stands in its text; nothing where that is not YAML.
  [[nodiscard]] std::optional<TextMap> map() const;
  /// Its text, as it was when it was opened.
  [[nodiscard]] const std::string& text() const;
  /// What names it in faults.
  [[nodiscard]] const std::string& file() const;

 private:
  struct Content;
  std::shared_ptr<const Content> content_;
};

/// The text of a model file. @throws InputError where it cannot be read or is larger than any model
[[nodiscard]] std::string file_text(const std::string& path);

/// Returns the model file as YAML with templates, aliases, overrides and parameters applied; without `parameters` and
/// `study`.
/// @throws InputError if these have faults; nothing else is checked
[[nodiscard]] std::string expanded_text(const std::string& path, const std::vector<std::string>& overrides = {});

}  // namespace hersey::model
