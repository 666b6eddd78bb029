#include "hersey/film/body_journal.h"

namespace hersey::film {
namespace {

using Eigen::VectorXd;

VectorXd along(const Grid& from, const Grid& to, const VectorXd& values) {
  VectorXd result(to.n_z);
  for (int j = 0, k = 0; j < to.n_z; ++j) {
    const double z = to.z_over_L(j);
    while (k + 2 < from.n_z && from.z_over_L(k + 1) <= z) ++k;
    const double share = (z - from.z_over_L(k)) / (from.z_over_L(k + 1) - from.z_over_L(k));
    result[j] = (1 - share) * values[k] + share * values[k + 1];
  }
  return result;
}

}  // namespace

JournalConduction on_grid(const JournalConduction& journal, const Grid& from, const Grid& to) {
  JournalConduction result = journal;
  if (!journal.deforms()) return result;
  result.shape0 = along(from, to, journal.shape0);
  result.shape_by_heat = along(from, to, journal.shape_by_heat);
  result.shape_by_rise = along(from, to, journal.shape_by_rise);
  return result;
}

VectorXd around(const Grid& grid, const VectorXd& along) {
  return along.size() == 0 ? VectorXd() : VectorXd(along.replicate(grid.n_phi, 1));
}

}  // namespace hersey::film
