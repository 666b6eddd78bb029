#pragma once

#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mesh/raw_mesh.h"

namespace hersey::fem {

/// Which keywords of a file with parts and an assembly are of the one part that is read.
class AbaqusParts {
 public:
  /// @param chosen the part's name; empty: the file has one part at most
  explicit AbaqusParts(std::string chosen) : chosen_(std::move(chosen)) {}

  /// Follows *PART, *INSTANCE and their ends. @returns whether a keyword with its data is of another part
  /// @param value  of a parameter by its name in upper case; empty: not given
  bool passes_over(const RawMesh& raw, const std::string& keyword, FileLocation location,
                   const std::function<std::string(const char*)>& value);
  /// Whether a keyword that is passed over is one of the assembly, which may concern the part that is read.
  [[nodiscard]] bool is_told(const std::string& keyword) const;
  /// Whether a set's name is that of a set of another instance.
  [[nodiscard]] bool is_of_another(const std::string& set) const;
  [[nodiscard]] bool is_chosen() const { return !chosen_.empty(); }
  void require_found(const RawMesh& raw) const;

 private:
  [[nodiscard]] bool is_chosen(const std::string& part) const;

  std::string chosen_;
  std::vector<std::string> names_;   ///< of parts, in turn
  std::set<std::string> instances_;  ///< of the chosen part, in upper case
  std::set<std::string> sets_;       ///< of other instances, in upper case
  bool is_in_another_ = false;
};

}  // namespace hersey::fem
