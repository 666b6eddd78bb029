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
  const Known latest{std::move(fingerprint), std::move(body)};
  if (bytes_of(latest) > most_) return;  // and would drive out all others
  const std::lock_guard lock(mutex_);
  known_.remove_if([&](const Known& known) { return known.fingerprint == latest.fingerprint; });
  known_.push_front(latest);
  std::size_t used = 0;
  const auto too_much = std::find_if(known_.begin(), known_.end(), [&](const Known& known) {
    used += bytes_of(known);
    return used > most_;
  });
  known_.erase(too_much, known_.end());
}

std::size_t KnownReductions::bytes_of(const Known& known) {
  const fem::ReducedBody& body = *known.body;
  Eigen::Index numbers = body.Phi.size() + body.K.size() + body.M.size() + 2 * body.m.nonZeros();
  for (const fem::FilmModes& modes : body.film_modes)
    numbers += modes.shapes.size() + modes.loads.size() + modes.pressures.size();
  // The mesh takes what its fingerprint takes, which holds the same numbers.
  return 2 * known.fingerprint.size() + sizeof(double) * static_cast<std::size_t>(numbers);
}

}  // namespace hersey::model
