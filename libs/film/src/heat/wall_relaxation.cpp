#include "heat/wall_relaxation.h"

#include <algorithm>

namespace hersey::film {

void WallPace::learn(const Eigen::VectorXd& missing, const Eigen::VectorXd& per_kelvin) {
  constexpr double least = 0.5, most = 1, like = 0.8;  // cosine: what goes elsewhere tells nothing of the pace
  share_ = 1;
  if (foretold_.size() == missing.size()) {
    const Eigen::VectorXd foretold = foretold_.cwiseQuotient(per_kelvin);
    const Eigen::VectorXd followed = (missing_ - missing).cwiseQuotient(per_kelvin);
    const double along = followed.dot(foretold);
    if (along > like * followed.norm() * foretold.norm())
      share_ = std::clamp(along / foretold.squaredNorm(), least, most);
  }
  missing_ = missing;
}

void WallPace::persist(Archive& archive) {
  const Archive::Group group(archive, "pace");
  archive.io("share", share_), archive.io("missing", missing_), archive.io("foretold", foretold_);
}

}  // namespace hersey::film
