#include "hersey/film/reynolds.h"

#include "film_wrench.h"
#include "flow_balance.h"
#include "hersey/core/contract.h"
#include "hersey/solver/sparse_lu.h"

namespace hersey::film {

struct Reynolds::Impl {
  explicit Impl(const FilmModel& model) : balance(model), wrench(model) {
    lu.analyse(balance.size(), balance.column_start(), balance.row_index());
  }

  void factorise();
  void solve_negative(Eigen::VectorXd& rhs);

  FlowBalance balance;
  FilmWrench wrench;
  solver::SparseLu lu;
  std::vector<double> shifted;
  Eigen::VectorXd column;
  bool linearised = false, factorised = false;
};

// A film nobody supplies leaves its fill level open, one at rest its fill fraction: the Jacobian is singular. A shift
// of the diagonal far below any conductance then picks a solution near the present state; the residual stays exact.
void Reynolds::Impl::factorise() {
  HERSEY_REQUIRE(linearised, "linearise() comes first");
  if (factorised) return;
  factorised = lu.factorise(balance.values());
  for (double shift = 1e-9 * balance.conductance_scale(); !factorised; shift *= 100) {
    shifted.assign(balance.values().begin(), balance.values().end());
    for (int i = 0; i < balance.size(); ++i) shifted[balance.diagonal_slot(i)] += shift;
    factorised = lu.factorise(shifted);
    HERSEY_REQUIRE(factorised || shift < balance.conductance_scale(), "the film's Jacobian is not finite");
  }
}

void Reynolds::Impl::solve_negative(Eigen::VectorXd& rhs) {
  factorise();
  rhs = -rhs;
  lu.solve({rhs.data(), static_cast<std::size_t>(rhs.size())});
}

Reynolds::Reynolds(const FilmModel& model) : impl_(std::make_unique<Impl>(model)) {}
Reynolds::~Reynolds() = default;
Reynolds::Reynolds(Reynolds&&) noexcept = default;
Reynolds& Reynolds::operator=(Reynolds&&) noexcept = default;

const FilmModel& Reynolds::model() const { return impl_->balance.model(); }
int Reynolds::size() const { return impl_->balance.size(); }

void Reynolds::linearise(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u) {
  impl_->linearised = impl_->factorised = false;
  impl_->balance.evaluate(motion, history, u);
  impl_->balance.assemble_jacobian();
  impl_->wrench.evaluate(impl_->balance.nodes(), impl_->balance.rough_gaps(), motion, true);
  impl_->linearised = true;
}

const Eigen::VectorXd& Reynolds::residual() const { return impl_->balance.residual(); }
double Reynolds::relative_residual() const { return impl_->balance.relative_residual(); }
int Reynolds::worst_node() const { return impl_->balance.worst_node(); }
const Vector6& Reynolds::wrench_on_shell() const { return impl_->wrench.total(); }

void Reynolds::newton_increment(Eigen::VectorXd& du) {
  du = impl_->balance.residual();
  impl_->solve_negative(du);
}

void Reynolds::response(const MotionDirection& direction, Eigen::VectorXd& du, Vector6& wrench_partial) {
  impl_->balance.derivative(direction, du);
  impl_->solve_negative(du);
  wrench_partial = impl_->wrench.along(direction);
}

void Reynolds::responses(std::span<const MotionDirection> directions, Eigen::MatrixXd& du,
                         Eigen::Matrix<double, 6, Eigen::Dynamic>& wrench_partial) {
  const auto columns = static_cast<Eigen::Index>(directions.size());
  du.resize(size(), columns);
  wrench_partial.resize(6, columns);
  impl_->factorise();
  for (Eigen::Index k = 0; k < columns; ++k) {
    impl_->balance.derivative(directions[k], impl_->column);
    du.col(k) = -impl_->column;
    wrench_partial.col(k) = impl_->wrench.along(directions[k]);
  }
  impl_->lu.solve({du.data(), static_cast<std::size_t>(du.size())}, static_cast<int>(columns));
}

Vector6 Reynolds::wrench_gradient(const Eigen::VectorXd& du) const { return impl_->wrench.along_u(du); }

void Reynolds::residual_derivative(const MotionDirection& direction, Eigen::VectorXd& dr) const {
  impl_->balance.derivative(direction, dr);
}

}  // namespace hersey::film
