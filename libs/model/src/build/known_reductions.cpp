#include "build/known_reductions.h"

#include <algorithm>
#include <utility>

namespace hersey::model {

std::shared_ptr<const fem::ReducedBody> KnownReductions::find(const std::string& fingerprint) {
  const std::lock_guard lock(mutex_);
  const auto found =
      std::find_if(known_.begin(), known_.end(), [&](const Known& known) { return known.fingerprint == fingerprint; });
  if (found == known_.end()) return nullptr;
  known_.splice(known_.begin(), known_, found);
  return known_.front().body;
}

void KnownReductions::keep(std::string fingerprint, std::shared_ptr<const fem::ReducedBody> body) {
  const std::lock_guard lock(mutex_);
  known_.push_front({std::move(fingerprint), std::move(body)});
  std::size_t used = 0;
  const auto too_much = std::find_if(known_.begin(), known_.end(), [&](const Known& known) {
    used += known.fingerprint.size() + bytes_of(*known.body);
    return used > most_;
  });
  known_.erase(too_much, known_.end());
}

std::size_t bytes_of(const fem::ReducedBody& body) {
  const auto numbers = static_cast<std::size_t>(body.Phi.size() + body.K.size() + body.M.size() + body.m.nonZeros() +
                                                3 * static_cast<Eigen::Index>(body.nodes.size()));
  return sizeof(double) * numbers +
         sizeof(int) * (static_cast<std::size_t>(body.m.nonZeros()) + body.mesh.connectivity.size());
}

}  // namespace hersey::model
