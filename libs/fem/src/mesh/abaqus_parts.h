#pragma once

#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mesh/raw_mesh.h"

namespace hersey::fem {

/// Selects the keywords of a file with parts and an assembly that belong to the one part that is read.
class AbaqusParts {
 public:
  /// @param chosen the part's name; empty: the file has one part at most
  explicit AbaqusParts(std::string chosen) : chosen_(std::move(chosen)) {}

  /// Follows *PART, *INSTANCE and their ends. @returns true if a keyword with its data belongs to another part
  /// @param value  returns a parameter by its name in upper case; empty: not given
  bool passes_over(const RawMesh& raw, const std::string& keyword, FileLocation location,
                   const std::function<std::string(const char*)>& value);
  /// True if an ignored keyword belongs to the assembly, which may concern the part that is read.
  [[nodiscard]] bool is_reported(const std::string& keyword) const;
  /// True if a set's name is that of a set of another instance.
  [[nodiscard]] bool is_of_another(const std::string& set) const;
  [[nodiscard]] bool is_chosen() const { return !chosen_.empty(); }
  void require_found(const RawMesh& raw) const;

 private:
  [[nodiscard]] bool is_chosen(const std::string& part) const;

  std::string chosen_;
  std::vector<std::string> names_;   ///< names of the parts, in the order of the file
  std::set<std::string> instances_;  ///< instances of the chosen part, in upper case
  std::set<std::string> sets_;       ///< sets of other instances, in upper case
  bool is_in_another_ = false;
};

}  // namespace hersey::fem
