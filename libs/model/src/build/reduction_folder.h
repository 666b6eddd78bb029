#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "hersey/fem/reduction.h"

namespace hersey::model {

/// Reduced bodies in files, for later processes: what is computed of them, but not what the model gives, which are
/// mesh, nodes, materials and frames.
class ReductionFolder {
 public:
  /// @param most  bytes of all files
  ReductionFolder(std::filesystem::path folder, std::uintmax_t most);

  /// What was computed of the body of this fingerprint, none if this program has kept none or its file is damaged.
  [[nodiscard]] std::optional<fem::ReducedBody> find(const std::string& fingerprint) const;
  /// Keeps it, where that is possible, and removes files used longest ago beyond what is allowed.
  void keep(const fem::ReducedBody& reduced, const std::string& fingerprint) const;

 private:
  void write(const fem::ReducedBody& reduced, const std::string& fingerprint) const;
  [[nodiscard]] std::filesystem::path file_of(const std::string& fingerprint) const;
  void remove_beyond(std::uintmax_t most) const;

  std::filesystem::path folder_;
  std::uintmax_t most_;
  std::string program_;  ///< empty: not known, nothing is kept or found
};

/// The folder of keep_reductions_in(), null without one.
[[nodiscard]] std::shared_ptr<const ReductionFolder> reduction_folder();

}  // namespace hersey::model
