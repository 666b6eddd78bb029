#include "heat/wall_relaxation.h"

#include <algorithm>

namespace hersey::film {

void WallRelaxation::learn(const Eigen::VectorXd& missing, const Eigen::VectorXd& per_kelvin) {
  constexpr double least = 0.5, most = 1, like = 0.8;  // like: smallest cosine between observed and predicted change
  factor_ = 1;
  if (predicted_.size() == missing.size()) {
    const Eigen::VectorXd predicted = predicted_.cwiseQuotient(per_kelvin);
    const Eigen::VectorXd followed = (missing_ - missing).cwiseQuotient(per_kelvin);
    const double along = followed.dot(predicted);
    if (along > like * followed.norm() * predicted.norm())
      factor_ = std::clamp(along / predicted.squaredNorm(), least, most);
  }
  missing_ = missing;
}

void WallRelaxation::persist(Archive& archive) {
  const Archive::Group group(archive, "pace");
  archive.io("share", factor_), archive.io("missing", missing_), archive.io("foretold", predicted_);
}

}  // namespace hersey::film
