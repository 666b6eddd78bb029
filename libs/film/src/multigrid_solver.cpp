#include "multigrid_solver.h"

#include "hersey/core/contract.h"

namespace hersey::film {

MultigridSolver::MultigridSolver(int n_phi, int n_z, std::span<const int> column_start, std::span<const int> row_index)
    : n_phi_(n_phi), n_z_(n_z), multigrid_(n_phi, n_z), rhs_(n_phi * n_z), pressure_(n_phi * n_z) {
  const int n = n_phi * n_z;
  around_.resize(n);
  for (int i = 0; i < n_phi; ++i) {
    for (int j = 0; j < n_z; ++j) {
      const int node = i * n_z + j;
      around_[node] = {node, (i + n_phi - 1) % n_phi * n_z + j, (i + 1) % n_phi * n_z + j, j > 0 ? node - 1 : node,
                       j + 1 < n_z ? node + 1 : node};
    }
  }
  slot_row_.reserve(row_index.size());
  slot_place_.reserve(row_index.size());
  for (int column = 0; column < n; ++column) {
    for (int k = column_start[column]; k < column_start[column + 1]; ++k) {
      const int row = row_index[k];
      int place = 0;
      while (place < 5 && around_[row][place] != column) ++place;
      HERSEY_REQUIRE(place < 5, "a five-point pattern");
      slot_row_.push_back(row);
      slot_place_.push_back(place);
    }
  }
  rows_.resize(n);
  roles_.resize(n);
  active_.resize(n);
  matrix_ = [this](const Eigen::VectorXd& x, Eigen::VectorXd& y) { multiply(x, y); };
  preconditioner_ = [this](const Eigen::VectorXd& b, Eigen::VectorXd& x) { precondition(b, x); };
}

void MultigridSolver::find_roles(std::span<const char> has_pressure) {
  for (std::size_t node = 0; node < rows_.size(); ++node) {
    const Row& row = rows_[node];
    const bool alone = row[west] == 0 && row[east] == 0 && row[south] == 0 && row[north] == 0;
    roles_[node] = alone ? NodeRole::given : has_pressure[node] ? NodeRole::pressure : NodeRole::transport;
    active_[node] = roles_[node] == NodeRole::pressure;
  }
}

// A transport node at `place` of a full one, which receives its oil: what that node in turn has from full nodes. Those
// outside the nine nearest are left out.
void MultigridSolver::eliminate(int node, int place) {
  constexpr int C = LineOperator::centre + 1;
  const int from = neighbour(node, place);
  const Row& row = rows_[from];
  const double factor = rows_[node][place] / row[centre];
  LineOperator::Row& into = multigrid_.finest().row(node);
  const auto take = [&](int its_place, int slot) {
    if (roles_[neighbour(from, its_place)] == NodeRole::pressure) into[slot] -= factor * row[its_place];
  };
  switch (place) {
    case west:
      take(east, C), take(south, LineOperator::west), take(north, LineOperator::west + 2);
      break;
    case east:
      take(west, C), take(south, LineOperator::east), take(north, LineOperator::east + 2);
      break;
    case south:
      take(north, C), take(west, LineOperator::west), take(east, LineOperator::east);
      break;
    default:
      take(south, C), take(west, LineOperator::west + 2), take(east, LineOperator::east + 2);
  }
}

void MultigridSolver::eliminate_transport() {
  constexpr std::array<int, 5> slot{LineOperator::centre + 1, LineOperator::west + 1, LineOperator::east + 1,
                                    LineOperator::centre, LineOperator::centre + 2};
  LineOperator& S = multigrid_.finest();
  S.set_zero();
  for (int node = 0; node < S.size(); ++node) {
    if (roles_[node] != NodeRole::pressure) {
      S.row(node)[slot[centre]] = 1;
      continue;
    }
    for (int place = 0; place < 5; ++place) {
      const double entry = rows_[node][place];
      if (entry == 0) continue;
      const int other = neighbour(node, place);
      if (roles_[other] == NodeRole::pressure) {
        S.row(node)[slot[place]] += entry;
      } else if (roles_[other] == NodeRole::transport && rows_[other][centre] != 0) {
        eliminate(node, place);
      }
    }
  }
}

// With the flow, from the line where it is cut by most full nodes.
void MultigridSolver::order_transport(FlowDirection flow) {
  int start = 0, most = -1;
  for (int i = 0; i < n_phi_; ++i) {
    int full = 0;
    for (int j = 0; j < n_z_; ++j) full += roles_[i * n_z_ + j] != NodeRole::transport;
    if (full > most) most = full, start = i;
  }
  rings_ = most < n_z_;
  transport_.clear();
  given_.clear();
  for (int k = 0; k < n_phi_; ++k) {
    const int i = (start + (flow.ascending_phi ? k : n_phi_ - k)) % n_phi_;
    for (int l = 0; l < n_z_; ++l) {
      const int node = i * n_z_ + (flow.ascending_z ? l : n_z_ - 1 - l);
      if (roles_[node] == NodeRole::transport) transport_.push_back(node);
      if (roles_[node] == NodeRole::given) given_.push_back(node);
    }
  }
}

bool MultigridSolver::setup(std::span<const double> values, std::span<const char> has_pressure, FlowDirection flow) {
  for (Row& row : rows_) row.fill(0);
  for (std::size_t k = 0; k < slot_row_.size(); ++k) rows_[slot_row_[k]][slot_place_[k]] = values[k];
  find_roles(has_pressure);
  order_transport(flow);
  for (const auto* nodes : {&transport_, &given_}) {
    for (int node : *nodes) {
      if (rows_[node][centre] == 0) return false;
    }
  }
  eliminate_transport();
  return multigrid_.setup(active_, flow.ascending_phi);
}

double MultigridSolver::coupled(int node, const Eigen::VectorXd& x) const {
  const Row& row = rows_[node];
  const std::array<int, 5>& at = around_[node];
  return row[west] * x[at[west]] + row[east] * x[at[east]] + row[south] * x[at[south]] + row[north] * x[at[north]];
}

void MultigridSolver::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  y.resize(x.size());
  for (int node = 0; node < static_cast<int>(x.size()); ++node)
    y[node] = rows_[node][centre] * x[node] + coupled(node, x);
}

void MultigridSolver::sweep_transport(const Eigen::VectorXd& b, Eigen::VectorXd& x) const {
  for (int pass = 0; pass < (rings_ ? 2 : 1); ++pass) {
    for (int node : transport_) x[node] = (b[node] - coupled(node, x)) / rows_[node][centre];
  }
}

void MultigridSolver::precondition(const Eigen::VectorXd& b, Eigen::VectorXd& x) {
  x.setZero(b.size());
  for (int node : given_) x[node] = b[node] / rows_[node][centre];
  sweep_transport(b, x);
  for (int node = 0; node < static_cast<int>(b.size()); ++node) {
    rhs_[node] = active_[node] ? b[node] - coupled(node, x) : 0;
  }
  multigrid_.cycle(rhs_, pressure_);
  for (int node = 0; node < static_cast<int>(b.size()); ++node) {
    if (active_[node]) x[node] = pressure_[node];
  }
  sweep_transport(b, x);
}

solver::GmresSummary MultigridSolver::solve(const Eigen::VectorXd& b, const solver::GmresOptions& options,
                                            Eigen::VectorXd& x) {
  return gmres_.solve(matrix_, preconditioner_, b, options, x);
}

}  // namespace hersey::film
