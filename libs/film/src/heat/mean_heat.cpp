#include "heat/mean_heat.h"

#include <algorithm>
#include <vector>

#include "hersey/core/contract.h"
#include "hersey/solver/sparse_lu.h"

namespace hersey::film {
namespace {

void add(double dt, const std::vector<WallFlux>& flux, Eigen::MatrixX2d& sum) {
  for (std::size_t node = 0; node < flux.size(); ++node)
    sum.row(static_cast<Eigen::Index>(node)) += dt * Eigen::RowVector2d(flux[node].beside, -flux[node].next);
}

}  // namespace

MeanHeat::MeanHeat(const Grid& grid, int layers, const Walls& walls)
    : grid_(grid), layers_(layers), walls_(walls), system_(grid, layers, walls.ring) {
  clear();
}

void MeanHeat::clear() {
  time_ = 0;
  system_.set_zero();
  by_journal_.setZero(system_.size());
  by_shell_.setZero(system_.size());
  to_shell_.setZero(grid_.size(), 2), to_journal_.setZero(grid_.size(), 2);
  const Eigen::Index n = walls_.outside;
  into_nodes_.setZero(2 + n);
  outside_.by.setZero(system_.size(), n), outside_.from.setZero(n, system_.size()), outside_.self.setZero(n);
  into_.setZero(system_.size() + 1);
  capacity_.setZero(grid_.size() * layers_);
}

void MeanHeat::add_equations(double dt, const Equations& equations) {
  system_.add(dt, equations.system);
  for (Eigen::Index row = 0; row < equations.added.size(); ++row)
    system_.diagonal(static_cast<int>(row)) += dt * equations.added[row];
  capacity_ += dt * equations.capacity;
  if (walls_.outside > 0) {
    outside_.by += dt * equations.outside.by, outside_.from += dt * equations.outside.from;
    outside_.self += dt * equations.outside.self;
  }
  if (walls_.own_journal || walls_.journal_node) {
    by_journal_ += dt * equations.by_journal;
    add(dt, equations.to_journal, to_journal_);
  }
  if (!walls_.shell_node) return;
  by_shell_ += dt * equations.by_shell;
  add(dt, equations.to_shell, to_shell_);
}

void MeanHeat::add_heat(double dt, const Eigen::VectorXd& into, const Eigen::VectorXd& into_nodes,
                        const Eigen::VectorXd& start, const Eigen::VectorXd& end) {
  if (time_ == 0) begin_ = start;
  end_ = end;
  time_ += dt;
  into_ += dt * into;
  into_nodes_ += dt * into_nodes;
}

// Heat that the film has stored since the beginning has come from walls. A body lacks the difference of its
// temperatures from those that the mean heat would give it (thermal.57).
Eigen::VectorXd MeanHeat::missing(const Eigen::VectorXd& shell, double journal) const {
  Eigen::VectorXd missing = into_;
  missing.head(capacity_.size()) += capacity_.cwiseProduct(end_ - begin_) / time_;
  if (const JournalConduction* body = walls_.journal_body; body != nullptr)  // (thermal.63)
    missing[system_.size()] = journal_scale() * (time_ * (body->T0 - journal) + body->rise * into_[system_.size()]);
  if (walls_.body == nullptr) return missing;
  const Eigen::Index first = capacity_.size(), n = grid_.n_phi;
  missing.segment(first, n) = time_ * (walls_.body->T0 - shell) + walls_.body->rise * into_.segment(first, n);
  return missing;
}

// Factor of the row of a journal in a body, of the size of the heat into it per kelvin [W/K].
double MeanHeat::journal_scale() const {
  const double by_film = to_journal_.sum() / time_;
  return by_film > 0 ? by_film : 1;
}

// Derivatives by a body: by its own temperature, and by the heat into all of its angles.
HeatSystem::Row MeanHeat::answer_entries(int i) const {
  HeatSystem::Row entries{{system_.ring_row(i), time_}};
  for (int j = 0; j < grid_.n_phi; ++j)
    for (const auto& [column, entry] : system_.ring_entries(j))
      entries.emplace_back(column, walls_.body->rise(i, j) * entry);
  return entries;
}

MeanHeat::Change MeanHeat::change_of(const Eigen::VectorXd& x) const {
  const int ring = walls_.ring ? grid_.n_phi : 0;
  Change change{x.segment(system_.size() - ring, ring), walls_.own_journal ? x[system_.size()] : 0};
  if (walls_.journal_body != nullptr)
    change.journal_heat = (into_journal(x) - to_journal_.sum() * x[system_.size()]) / time_;
  if (walls_.body == nullptr) return change;
  change.heat.setZero(ring);
  for (int i = 0; i < ring; ++i)
    for (const auto& [column, entry] : system_.ring_entries(i)) change.heat[i] -= entry * x[column] / time_;
  return change;
}

// Heat into the journal by a change of the film beside it [W s].
double MeanHeat::into_journal(const Eigen::VectorXd& x) const {
  double heat = 0;
  for (int node = 0; node < grid_.size(); ++node)
    for (int beside = 0; beside < std::min(layers_, 2); ++beside)
      heat += to_journal_(node, beside) * x[system_.row(node, layers_ - 1 - beside)];
  return heat;
}

// Heat into nodes by a change of the film between them [W s].
Eigen::VectorXd MeanHeat::heat_of(const Eigen::VectorXd& x) const {
  Eigen::VectorXd heat = Eigen::VectorXd::Zero(into_nodes_.size());
  heat.tail(walls_.outside) = outside_.from * x.head(system_.size());
  if (walls_.journal_node) heat[1] += into_journal(x);
  for (int node = 0; walls_.shell_node && node < grid_.size(); ++node)
    for (int beside = 0; beside < std::min(layers_, 2); ++beside)
      heat[0] += to_shell_(node, beside) * x[system_.row(node, beside)];
  return heat;
}

// Solves for temperatures at which nothing is stored and walls absorb no heat (thermal.19); the network does so for
// nodes.
MeanHeat::Answer MeanHeat::answer(const Eigen::VectorXd& shell, double journal) {
  HERSEY_REQUIRE(has_steps(), "a mean over some time");
  const Eigen::SparseMatrix<double> A = matrix();
  solver::SparseLu lu;
  lu.analyse(A);
  HERSEY_REQUIRE(lu.factorise({A.valuePtr(), static_cast<std::size_t>(A.nonZeros())}), "layers that balance heat");
  const auto solve = [&lu](Eigen::VectorXd x) {
    lu.solve({x.data(), static_cast<std::size_t>(x.size())});
    return x;
  };
  Answer answer;
  const Eigen::VectorXd x = solve(missing(shell, journal));
  if (walls_.body != nullptr) answer.heat = into_.segment(capacity_.size(), grid_.n_phi) / time_;
  if (walls_.journal_body != nullptr) answer.journal_heat = into_[system_.size()] / time_;
  answer.without = change_of(x);
  answer.heat_flow.heat = (into_nodes_ + heat_of(x)) / time_;
  answer.heat_flow.by_T.setZero(into_nodes_.size(), into_nodes_.size());
  const auto column = [this](const Eigen::VectorXd& by, Eigen::Index node, double self) -> Eigen::VectorXd {
    return (heat_of(by) + self * Eigen::VectorXd::Unit(into_nodes_.size(), node)) / time_;
  };
  for (Eigen::Index terminal = 0; terminal < walls_.outside; ++terminal) {
    Eigen::VectorXd by(system_.size() + 1);
    by << outside_.by.col(terminal), 0;
    by = solve(by);
    answer.by_outside.push_back(change_of(by));
    answer.heat_flow.by_T.col(2 + terminal) = column(by, 2 + terminal, outside_.self[terminal]);
  }
  if (walls_.shell_node) {
    Eigen::VectorXd by_shell(system_.size() + 1);
    by_shell << by_shell_, 0;
    by_shell = solve(by_shell);
    answer.by_shell = change_of(by_shell);
    answer.heat_flow.by_T.col(0) = column(by_shell, 0, -to_shell_.sum());
  }
  if (walls_.journal_node) {
    const Eigen::VectorXd by_journal = solve(Eigen::VectorXd::Unit(A.rows(), system_.size()));
    answer.by_journal = change_of(by_journal);
    answer.heat_flow.by_T.col(1) = column(by_journal, 1, -to_journal_.sum());
  }
  clear();
  return answer;
}

Eigen::SparseMatrix<double> MeanHeat::matrix() const {
  const int rows = system_.size(), film = grid_.size() * layers_;
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&entries](int row, int column, double entry) {
    if (entry != 0) entries.emplace_back(row, column, entry);
  };
  for (int row = 0; row < rows; ++row) {
    const HeatSystem::Row of = row < film               ? system_.entries(row / layers_, row % layers_)
                               : walls_.body != nullptr ? answer_entries(row - film)
                                                        : system_.ring_entries(row - film);
    for (const auto& [column, entry] : of) add(row, column, entry);
    add(row, rows, -by_journal_[row]);
  }
  const JournalConduction* body = walls_.journal_body;
  const double by_heat = body != nullptr ? journal_scale() * body->rise : 1;  // (thermal.63), or a balance by itself
  double journal_self = walls_.own_journal ? by_heat * to_journal_.sum() : 0;
  if (body != nullptr) journal_self += journal_scale() * time_;
  add(rows, rows, journal_self != 0 ? journal_self : 1);
  for (int node = 0; walls_.own_journal && node < grid_.size(); ++node)
    for (int beside = 0; beside < std::min(layers_, 2); ++beside)
      add(rows, system_.row(node, layers_ - 1 - beside), -by_heat * to_journal_(node, beside));
  Eigen::SparseMatrix<double> A(rows + 1, rows + 1);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

void MeanHeat::persist(Archive& archive) {
  const Archive::Group group(archive, "mean");
  archive.io("time", time_);
  system_.persist(archive);
  archive.io("by_shell", by_shell_), archive.io("to_shell", to_shell_);
  archive.io("by_journal", by_journal_), archive.io("to_journal", to_journal_);
  archive.io("into_nodes", into_nodes_);
  archive.io("into", into_), archive.io("begin_T", begin_), archive.io("end_T", end_);
  archive.io("capacity", capacity_);
  if (walls_.outside == 0) return;
  archive.io("by_outside", outside_.by), archive.io("to_outside", outside_.from);
  archive.io("outside_self", outside_.self);
}

}  // namespace hersey::film
