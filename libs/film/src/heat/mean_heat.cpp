#include "heat/mean_heat.h"

#include <vector>

#include "hersey/core/contract.h"
#include "hersey/solver/sparse_lu.h"

namespace hersey::film {
MeanHeat::MeanHeat(const Grid& grid, int layers, bool has_ring, bool has_free_journal, int supplies)
    : grid_(grid),
      layers_(layers),
      has_ring_(has_ring),
      has_free_journal_(has_free_journal),
      supplies_(supplies),
      system_(grid, layers, has_ring) {
  clear();
}

void MeanHeat::clear() {
  time_ = 0;
  system_.set_zero();
  by_journal_.setZero(system_.size());
  to_journal_.setZero(grid_.size());
  into_.setZero(system_.size() + 1);
  capacity_.setZero(grid_.size() * layers_);
  by_supplies_.setZero(system_.size(), supplies_);
  capacity_of_supplies_ = by_supplies_;
  of_supplies_.setZero(system_.size() + 1 + supplies_, supplies_);
  journal_self_ = 0;
}

void MeanHeat::add_equations(double dt, const Equations& equations) {
  system_.add(dt, equations.system);
  for (Eigen::Index row = 0; row < equations.added.size(); ++row)
    system_.diagonal(static_cast<int>(row)) += dt * equations.added[row];
  capacity_ += dt * equations.capacity;
  capacity_of_supplies_ += dt * equations.capacity_of_supplies;
  by_supplies_ += dt * equations.by_supplies;
  of_supplies_ += dt * equations.of_supplies;
  if (!has_free_journal_) return;
  by_journal_ += dt * equations.by_journal;
  for (int node = 0; node < grid_.size(); ++node) {
    to_journal_[node] += dt * equations.to_journal[node];
    journal_self_ += dt * equations.to_journal[node];
  }
}

void MeanHeat::add_heat(double dt, const Eigen::VectorXd& into, const Eigen::VectorXd& start,
                        const Eigen::VectorXd& end) {
  if (time_ == 0) begin_ = start;
  end_ = end;
  time_ += dt;
  into_ += dt * into;
}

// What the film has stored since the beginning, it has taken from walls and supplies.
Eigen::VectorXd MeanHeat::missing() const {
  const Eigen::Index film = capacity_.size();
  const Eigen::VectorXd rise = (end_ - begin_) / time_;
  Eigen::VectorXd missing(into_.size() + supplies_);
  missing << into_, capacity_of_supplies_.topRows(film).transpose() * rise;
  missing.head(film) += capacity_.cwiseProduct(rise);
  return missing;
}

// Temperatures at which nothing is stored and walls take up no heat (thermal.51).
MeanHeat::Change MeanHeat::settle() {
  HERSEY_REQUIRE(has_steps(), "a mean over some time");
  const Eigen::SparseMatrix<double> A = matrix();
  Eigen::VectorXd x = missing();
  solver::SparseLu lu;
  lu.analyse(A);
  HERSEY_REQUIRE(lu.factorise({A.valuePtr(), static_cast<std::size_t>(A.nonZeros())}), "layers that balance heat");
  lu.solve({x.data(), static_cast<std::size_t>(x.size())});
  const int ring = has_ring_ ? grid_.n_phi : 0;
  Change change{x.segment(system_.size() - ring, ring), x[system_.size()]};
  clear();
  return change;
}

Eigen::SparseMatrix<double> MeanHeat::matrix() const {
  const int rows = system_.size(), film = grid_.size() * layers_;
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&entries](int row, int column, double entry) {
    if (entry != 0) entries.emplace_back(row, column, entry);
  };
  for (int row = 0; row < rows; ++row) {
    const HeatSystem::Row of =
        row < film ? system_.entries(row / layers_, row % layers_) : system_.ring_entries(row - film);
    for (const auto& [column, entry] : of) add(row, column, entry);
    add(row, rows, -by_journal_[row]);
    for (int s = 0; s < supplies_; ++s) add(row, rows + 1 + s, -by_supplies_(row, s));
  }
  add(rows, rows, journal_self_ != 0 ? journal_self_ : 1);
  for (int node = 0; node < grid_.size(); ++node) add(rows, system_.row(node, layers_ - 1), -to_journal_[node]);
  for (int s = 0; s < supplies_; ++s)
    for (int column = 0; column < rows + 1 + supplies_; ++column) add(rows + 1 + s, column, of_supplies_(column, s));
  Eigen::SparseMatrix<double> A(rows + 1 + supplies_, rows + 1 + supplies_);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

void MeanHeat::persist(Archive& archive) {
  const Archive::Group group(archive, "mean");
  archive.io("time", time_);
  system_.persist(archive);
  archive.io("by_journal", by_journal_), archive.io("to_journal", to_journal_);
  archive.io("by_supplies", by_supplies_), archive.io("of_supplies", of_supplies_);
  archive.io("into", into_), archive.io("begin_T", begin_), archive.io("end_T", end_);
  archive.io("capacity", capacity_), archive.io("capacity_of_supplies", capacity_of_supplies_);
  archive.io("journal_self", journal_self_);
}

}  // namespace hersey::film
