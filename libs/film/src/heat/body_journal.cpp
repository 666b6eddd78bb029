#include "hersey/film/body_journal.h"

#include "hersey/film/grid_transfer.h"

namespace hersey::film {
JournalConduction on_grid(const JournalConduction& journal, const Grid& from, const Grid& to) {
  JournalConduction result = journal;
  if (!journal.deforms()) return result;
  const GridTransfer transfer = GridTransfer::by_position(from, to);
  result.shape0 = transfer.along(journal.shape0);
  result.shape_by_heat = transfer.along(journal.shape_by_heat);
  result.shape_by_rise = transfer.along(journal.shape_by_rise);
  return result;
}

Eigen::VectorXd around(const Grid& grid, const Eigen::VectorXd& along) {
  return along.size() == 0 ? Eigen::VectorXd() : Eigen::VectorXd(along.replicate(grid.n_phi, 1));
}

}  // namespace hersey::film
