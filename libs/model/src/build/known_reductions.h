#pragma once

#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <string>

#include "hersey/fem/reduction.h"

namespace hersey::model {

/// The last reduced bodies of this process, by all that went into them: runs of a study, and a run and the check before
/// it, mostly leave bodies as they are. Threads may share it.
class KnownReductions {
 public:
  /// @param most  bytes that are kept at most
  explicit KnownReductions(std::size_t most) : most_(most) {}

  /// Null where it is not known.
  [[nodiscard]] std::shared_ptr<const fem::ReducedBody> find(const std::string& fingerprint);
  /// Keeps it, unless it is too large by itself, and forgets those asked for longest ago as far as room lacks for all.
  void keep(std::string fingerprint, std::shared_ptr<const fem::ReducedBody> body);

 private:
  struct Known {
    std::string fingerprint;
    std::shared_ptr<const fem::ReducedBody> body;
  };
  /// Memory of its matrices and its mesh.
  [[nodiscard]] static std::size_t bytes_of(const Known& known);

  std::size_t most_;
  std::mutex mutex_;
  std::list<Known> known_;  ///< asked for last first
};

}  // namespace hersey::model
