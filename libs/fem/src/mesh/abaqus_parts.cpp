#include "mesh/abaqus_parts.h"

#include <fmt/format.h>

#include <algorithm>

#include "hersey/core/spelling.h"
#include "mesh/abaqus_block.h"
#include "mesh/mesh_text.h"

namespace hersey::fem {

bool AbaqusParts::is_chosen(const std::string& part) const { return equal_ignoring_case(part, chosen_); }

bool AbaqusParts::passes_over(const RawMesh& raw, const std::string& keyword, FileLocation location,
                              const std::function<std::string(const char*)>& value) {
  if (keyword == "PART") {
    names_.push_back(value("NAME"));
    if (!is_chosen() && names_.size() > 1)
      raw.fail(location, fmt::format("a second *PART, '{}' behind '{}'", names_[1], names_[0]), "one body in one file",
               "say which is the body: `part: NAME` in the model file, --part NAME on the command line");
    is_in_another_ = is_chosen() && !is_chosen(names_.back());
    return is_in_another_;
  }
  if (keyword == "ENDPART" || keyword == "ENDINSTANCE") return std::exchange(is_in_another_, false);
  if (!is_chosen()) return false;
  if (keyword == "INSTANCE") {
    is_in_another_ = !is_chosen(value("PART"));
    if (!is_in_another_) instances_.insert(upper(value("NAME")));
    return is_in_another_;
  }
  if (is_in_another_) return true;
  if (names_.size() > 1 && ties_nodes(keyword)) return true;
  const std::string instance = value("INSTANCE");
  if (instance.empty() || instances_.contains(upper(instance))) return false;
  for (const char* parameter : {"NSET", "ELSET"}) sets_.insert(upper(value(parameter)));
  return true;
}

bool AbaqusParts::is_reported(const std::string& keyword) const { return !is_in_another_ && ties_nodes(keyword); }

bool AbaqusParts::is_of_another(const std::string& set) const { return !set.empty() && sets_.contains(upper(set)); }

void AbaqusParts::require_found(const RawMesh& raw) const {
  if (!is_chosen() || std::any_of(names_.begin(), names_.end(), [this](const auto& name) { return is_chosen(name); }))
    return;
  raw.fail({0, 0}, fmt::format("no part '{}'", chosen_),
           names_.empty() ? "a file with parts; this one has none" : "a part of the file: " + one_of(names_),
           did_you_mean(chosen_, names_));
}

}  // namespace hersey::fem
