#include "hersey/film/reynolds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "balance/active_set_changes.h"
#include "balance/flow_balance.h"
#include "balance/rupture_front.h"
#include "hersey/core/contract.h"
#include "hersey/solver/sparse_lu.h"
#include "observe/film_wrench.h"
#include "observe/observe_evaluated.h"
#include "solve/multigrid_solver.h"

namespace hersey::film {
namespace {

// What responses leave of their right-hand sides.
constexpr double tight = 1e-10;

// What one solution leaves of a step's defect of oil, what refinement leaves, and what each of its turns leaves of the
// last at most: ten turns cost what a factor does.
constexpr double settling = 1e-6, refined_to = 1e-10, least_gain = 0.1;

// Right-hand sides that multigrid has not solved after so many iterations are left to the direct solver.
constexpr int most_iterations = 80;

}  // namespace

struct Reynolds::Impl {
  Impl(const FilmModel& model, LinearSolver chosen) : balance(model), wrench(model), linear(chosen) {}

  void factorise();
  [[nodiscard]] bool is_finite() const;
  void find_row_sizes();
  [[nodiscard]] bool factorise_shifted(double shift);
  [[nodiscard]] bool solve_by_multigrid(const Eigen::VectorXd& rhs, double rtol, Eigen::VectorXd& x);
  void solve(const Eigen::VectorXd& rhs, double rtol, Eigen::VectorXd& x);
  void condense_by_adjoint(const Eigen::MatrixXd& openings, CondensedFilm& film);
  void condense_by_columns(const Eigen::MatrixXd& openings, CondensedFilm& film);
  void set_up_multigrid();
  void solve_for_settling();
  void subtract_product(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::VectorXd& y) const;
  const FilmWrench& summed_wrench();

  FlowBalance balance;
  FilmWrench wrench;
  LinearSolver linear;
  LinearSolverCounts counts;
  solver::SparseLu lu;
  std::optional<MultigridSolver> multigrid;
  std::vector<double> shifted;
  Eigen::VectorXd rhs, answer, row_size, rest, correction;
  // Of the last condensation, n rows each: residual's derivative along the directions; then either the answer of each
  // force (six of the wrench, then on shapes) to the residual, or the increment and the answers to the directions.
  Eigen::MatrixXd residual_by_s, adjoint, answers;
  Eigen::VectorXd condensed_residual, increment;
  SurfaceMotion speeds;  // without gap and rate
  bool linearised = false, summed = false, factorised = false, set_up = false, multigrid_is_sound = false;
  bool condensed = false;
};

bool Reynolds::Impl::is_finite() const {
  const auto values = balance.values();
  return balance.residual().allFinite() &&
         std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

void Reynolds::Impl::find_row_sizes() {
  row_size.setConstant(balance.size(), std::numeric_limits<double>::min());
  for (std::size_t k = 0; k < balance.row_index().size(); ++k) {
    double& size = row_size[balance.row_index()[k]];
    size = std::max(size, std::abs(balance.values()[k]));
  }
}

bool Reynolds::Impl::factorise_shifted(double shift) {
  shifted.assign(balance.values().begin(), balance.values().end());
  for (int i = 0; i < balance.size(); ++i) shifted[balance.diagonal_slot(i)] += shift * row_size[i];
  ++counts.factorisations;
  return lu.factorise(shifted);
}

// A film nobody supplies leaves its fill level open, one at rest its fill fraction: the Jacobian is singular. A shift
// of the diagonal far below any conductance then picks a solution near the present state; the residual stays exact.
// Trials far from any answer may have conductances far above or below the model's: there the shift grows with the rows,
// up to a diagonal that outweighs them, which can always be factorised. It is a short step then.
void Reynolds::Impl::factorise() {
  HERSEY_REQUIRE(linearised, "linearise() comes first");
  if (factorised) return;
  if (lu.size() == 0) lu.analyse(balance.size(), balance.column_start(), balance.row_index());
  ++counts.factorisations;
  factorised = lu.factorise(balance.values());
  if (factorised) return;
  row_size.setConstant(balance.size(), balance.conductance_scale());
  for (double shift = 1e-9; !factorised && shift < 1; shift *= 100) factorised = factorise_shifted(shift);
  if (!factorised) find_row_sizes();
  for (double shift = 1e-9; !factorised && shift < 1e4; shift *= 100) factorised = factorise_shifted(shift);
  HERSEY_REQUIRE(factorised, "a matrix of finite numbers with a heavy diagonal has a factor");
}

void Reynolds::Impl::set_up_multigrid() {
  HERSEY_REQUIRE(linearised, "linearise() comes first");
  if (set_up) return;
  const Grid& grid = balance.model().grid;
  if (!multigrid) multigrid.emplace(grid.n_phi, grid.n_z, balance.column_start(), balance.row_index());
  ++counts.setups;
  multigrid_is_sound = multigrid->setup(balance.values(), balance.speed_phi() >= 0);
  set_up = true;
}

// Sums over the surface are not needed on the way to a solution.
const FilmWrench& Reynolds::Impl::summed_wrench() {
  HERSEY_REQUIRE(linearised, "linearise() comes first");
  if (!summed) wrench.evaluate(balance, speeds, true);
  summed = true;
  return wrench;
}

bool Reynolds::Impl::solve_by_multigrid(const Eigen::VectorXd& b, double rtol, Eigen::VectorXd& x) {
  set_up_multigrid();
  if (!multigrid_is_sound) return false;
  const solver::GmresSummary summary = multigrid->solve(b, {.rtol = rtol, .max_iterations = most_iterations}, x);
  counts.iterations += summary.iterations;
  return summary.solved();
}

void Reynolds::Impl::solve(const Eigen::VectorXd& b, double rtol, Eigen::VectorXd& x) {
  if (linear == LinearSolver::multigrid) {
    if (solve_by_multigrid(b, rtol, x)) return;
    ++counts.fallback_solves;
  }
  factorise();
  x = b;
  lu.solve({x.data(), static_cast<std::size_t>(x.size())});
}

// With J^T Lambda = F_u^T for forces F:  F_u du0 = -Lambda^T r  and  F_u U = -Lambda^T r_s.
void Reynolds::Impl::condense_by_adjoint(const Eigen::MatrixXd& openings, CondensedFilm& film) {
  factorise();
  adjoint.resize(wrench.gradient_u().cols(), 6 + openings.cols());
  adjoint.leftCols<6>() = wrench.gradient_u().transpose();
  adjoint.rightCols(openings.cols()) = wrench.normal().by_u.asDiagonal() * openings;
  lu.solve_transposed({adjoint.data(), static_cast<std::size_t>(adjoint.size())}, static_cast<int>(adjoint.cols()));
  for (Eigen::Index i = 0; i < 6; ++i) film.wrench[i] -= adjoint.col(i).dot(balance.residual());
  film.wrench_by_s.noalias() -= adjoint.leftCols<6>().transpose() * residual_by_s;
  if (openings.cols() == 0) return;
  film.Q.noalias() -= adjoint.rightCols(openings.cols()).transpose() * balance.residual();
  film.Q_by_s.noalias() -= adjoint.rightCols(openings.cols()).transpose() * residual_by_s;
}

void Reynolds::Impl::condense_by_columns(const Eigen::MatrixXd& openings, CondensedFilm& film) {
  rhs = -balance.residual();
  solve(rhs, tight, increment);
  film.wrench += wrench.change_by_u(increment);
  rhs = wrench.normal().by_u.cwiseProduct(increment);
  film.Q.noalias() += openings.transpose() * rhs;
  answers.resize(residual_by_s.rows(), residual_by_s.cols());
  for (Eigen::Index k = 0; k < answers.cols(); ++k) {
    rhs = -residual_by_s.col(k);
    solve(rhs, tight, answer);
    answers.col(k) = answer;
    film.wrench_by_s.col(k) += wrench.change_by_u(answer);
    rhs = wrench.normal().by_u.cwiseProduct(answer);
    film.Q_by_s.col(k).noalias() += openings.transpose() * rhs;
  }
}

Reynolds::Reynolds(const FilmModel& model, LinearSolver linear) : impl_(std::make_unique<Impl>(model, linear)) {}
Reynolds::~Reynolds() = default;
Reynolds::Reynolds(Reynolds&&) noexcept = default;
Reynolds& Reynolds::operator=(Reynolds&&) noexcept = default;

const FilmModel& Reynolds::model() const { return impl_->balance.model(); }
int Reynolds::size() const { return impl_->balance.size(); }
LinearSolver Reynolds::linear_solver() const { return impl_->linear; }
const LinearSolverCounts& Reynolds::counts() const { return impl_->counts; }

FilmDomain Reynolds::linearise(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u) {
  impl_->linearised = impl_->summed = false;
  if (const FilmDomain domain = impl_->balance.evaluate(motion, history, u); !domain.is_inside()) return domain;
  impl_->balance.assemble_jacobian();
  if (!impl_->is_finite()) return {FilmDomain::Violation::not_finite, -1};
  impl_->factorised = impl_->set_up = impl_->condensed = false;
  SurfaceMotion& speeds = impl_->speeds;
  speeds.u_shell = motion.u_shell, speeds.u_journal = motion.u_journal;
  speeds.w_shell = motion.w_shell, speeds.w_journal = motion.w_journal;
  speeds.shell_opening = motion.shell_opening;
  impl_->linearised = true;
  return {};
}

const Eigen::VectorXd& Reynolds::residual() const { return impl_->balance.residual(); }
double Reynolds::relative_residual() const { return impl_->balance.relative_residual(); }
int Reynolds::worst_node() const { return impl_->balance.worst_node(); }
const Vector6& Reynolds::wrench_on_shell() const { return impl_->summed_wrench().total(); }

FilmObservables Reynolds::observe(const SurfaceMotion& motion, const Eigen::Vector2d& e, const Eigen::VectorXd& u,
                                  const Eigen::Vector2d& tilt) const {
  return observe_evaluated(impl_->balance, impl_->summed_wrench(), motion, e, u, tilt);
}

void Reynolds::newton_increment(Eigen::VectorXd& du, double rtol) {
  impl_->rhs = -impl_->balance.residual();
  impl_->solve(impl_->rhs, rtol, du);
}

void Reynolds::regularised_increment(Eigen::VectorXd& du) {
  Impl& m = *impl_;
  HERSEY_REQUIRE(m.linearised, "linearise() comes first");
  if (m.lu.size() == 0) m.lu.analyse(m.balance.size(), m.balance.column_start(), m.balance.row_index());
  m.find_row_sizes();
  m.factorised = false;  // as far as the Jacobian itself is asked for
  if (!m.factorise_shifted(1e-3)) return newton_increment(du);
  du = -m.balance.residual();
  m.lu.solve({du.data(), static_cast<std::size_t>(du.size())});
}

bool Reynolds::has_factor() const { return impl_->linearised && impl_->factorised; }

FilmDomain Reynolds::chord_increment(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u,
                                     Eigen::VectorXd& du) {
  Impl& m = *impl_;
  HERSEY_REQUIRE(has_factor(), "a linearisation with a factor");
  (void)m.summed_wrench();
  const FilmDomain domain = m.balance.evaluate(motion, history, u);
  if (!domain.is_inside()) {
    m.linearised = m.summed = m.factorised = m.set_up = false;
    return domain;
  }
  m.wrench.evaluate(m.balance, m.speeds, false);
  du = -m.balance.residual();
  m.lu.solve({du.data(), static_cast<std::size_t>(du.size())});
  return {};
}

void Reynolds::advance_rupture_front(Eigen::VectorXd& u) const { film::advance_rupture_front(impl_->balance, u); }

void Reynolds::press_filled_nodes(const Eigen::VectorXd& u, Eigen::VectorXd& du) const {
  film::press_filled_nodes(impl_->balance, u, du);
}

void Reynolds::response(const MotionDirection& direction, Eigen::VectorXd& du, Vector6& wrench_partial) {
  impl_->balance.derivative(direction, impl_->rhs);
  impl_->rhs = -impl_->rhs;
  impl_->solve(impl_->rhs, tight, du);
  wrench_partial = impl_->summed_wrench().along(direction);
}

void Reynolds::responses(std::span<const MotionDirection> directions, Eigen::MatrixXd& du,
                         Eigen::Matrix<double, 6, Eigen::Dynamic>& wrench_partial) {
  const auto columns = static_cast<Eigen::Index>(directions.size());
  du.resize(size(), columns);
  wrench_partial.resize(6, columns);
  Eigen::VectorXd &rhs = impl_->rhs, &answer = impl_->answer;
  for (Eigen::Index k = 0; k < columns; ++k) {
    impl_->balance.derivative(directions[k], rhs);
    du.col(k) = -rhs;
    wrench_partial.col(k) = impl_->summed_wrench().along(directions[k]);
    if (impl_->linear == LinearSolver::direct) continue;
    rhs = du.col(k);
    impl_->solve(rhs, tight, answer);
    du.col(k) = answer;
  }
  if (impl_->linear == LinearSolver::multigrid) return;
  impl_->factorise();
  impl_->lu.solve({du.data(), static_cast<std::size_t>(du.size())}, static_cast<int>(columns));
}

void Reynolds::condense(std::span<const MotionDirection> directions, const Eigen::MatrixXd& openings,
                        CondensedFilm& film) {
  Impl& m = *impl_;
  HERSEY_REQUIRE(openings.rows() == size(), "openings of shape (grid.size(), shapes)");
  const FilmWrench& now = m.summed_wrench();
  m.condensed_residual = m.balance.residual();
  m.condensed = true;
  m.residual_by_s.resize(size(), static_cast<Eigen::Index>(directions.size()));
  film.wrench_by_s.resize(6, m.residual_by_s.cols());
  film.Q_by_s.setZero(openings.cols(), m.residual_by_s.cols());
  const bool contact_pushes = openings.cols() > 0 && !now.normal().by_g.isZero(0);
  for (Eigen::Index k = 0; k < m.residual_by_s.cols(); ++k) {
    const MotionDirection& direction = directions[static_cast<std::size_t>(k)];
    m.balance.derivative(direction, m.rhs);
    m.residual_by_s.col(k) = m.rhs;
    film.wrench_by_s.col(k) = now.along(direction);
    if (!contact_pushes || direction.g.size() == 0) continue;
    m.rhs = now.normal().by_g.cwiseProduct(direction.g);
    film.Q_by_s.col(k).noalias() = openings.transpose() * m.rhs;
  }
  film.wrench = now.total();
  film.Q.noalias() = openings.transpose() * now.normal().value;
  if (m.linear == LinearSolver::direct) {
    m.condense_by_adjoint(openings, film);
  } else {
    m.condense_by_columns(openings, film);
  }
}

const NormalForces& Reynolds::normal_forces() const { return impl_->summed_wrench().normal(); }

void Reynolds::follow(const Eigen::Ref<const Eigen::VectorXd>& ds, Eigen::VectorXd& du) {
  Impl& m = *impl_;
  HERSEY_REQUIRE(m.condensed && ds.size() == m.residual_by_s.cols(), "condense() comes first");
  if (m.linear == LinearSolver::direct) {
    du = -m.condensed_residual;
    du.noalias() -= m.residual_by_s * ds;
    m.lu.solve({du.data(), static_cast<std::size_t>(du.size())});
  } else {
    du = m.increment;
    du.noalias() += m.answers * ds;
  }
}

Vector6 Reynolds::wrench_gradient(const Eigen::Ref<const Eigen::VectorXd>& du) const {
  return impl_->summed_wrench().change_by_u(du);
}

const Eigen::Matrix<double, 6, Eigen::Dynamic>& Reynolds::wrench_by_u() const {
  return impl_->summed_wrench().gradient_u();
}

void Reynolds::partial(const MotionDirection& direction, Eigen::VectorXd& residual, Vector6& wrench) {
  HERSEY_REQUIRE(impl_->linearised, "linearise() comes first");
  impl_->balance.derivative(direction, residual);
  wrench = impl_->summed_wrench().along(direction);
}

Eigen::VectorXd Reynolds::jacobian_product(const Eigen::Ref<const Eigen::VectorXd>& v) const {
  HERSEY_REQUIRE(impl_->linearised && v.size() == size(), "linearise() comes first; shape (n)");
  Eigen::VectorXd product = Eigen::VectorXd::Zero(size());
  impl_->subtract_product(v, product);
  return -product;
}

void Reynolds::solve(Eigen::MatrixXd& columns) {
  HERSEY_REQUIRE(impl_->linear == LinearSolver::direct && columns.rows() == size(), "a direct solver; shape (n, any)");
  impl_->factorise();
  impl_->lu.solve({columns.data(), static_cast<std::size_t>(columns.size())}, static_cast<int>(columns.cols()));
}

void Reynolds::solve_transposed(Eigen::MatrixXd& columns) {
  HERSEY_REQUIRE(impl_->linear == LinearSolver::direct && columns.rows() == size(), "a direct solver; shape (n, any)");
  impl_->factorise();
  impl_->lu.solve_transposed({columns.data(), static_cast<std::size_t>(columns.size())},
                             static_cast<int>(columns.cols()));
}

void Reynolds::persist(Archive& archive) {
  impl_->lu.persist(archive);
  if (archive.restores()) impl_->linearised = impl_->factorised = impl_->set_up = impl_->condensed = false;
}

void Reynolds::initialise_oil_balance(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u,
                                      StepOilBalance& oil) {
  Impl& m = *impl_;
  const FilmDomain domain = m.balance.evaluate(motion, history, u);
  HERSEY_REQUIRE(domain.is_inside(), text(m.balance.model(), domain));
  m.balance.initialise_oil_balance(oil);
  m.linearised = m.summed = m.factorised = m.set_up = false;
}

// The factor of the last linearisation leads the defect nearly where it belongs, refinement the rest of the way.
void Reynolds::Impl::solve_for_settling() {
  linearised = true, set_up = false;
  const double enough = refined_to * rhs.cwiseAbs().maxCoeff();
  solve(rhs, settling, answer);
  double last = std::numeric_limits<double>::infinity();
  for (;;) {
    rest = rhs;
    subtract_product(answer, rest);
    const double size = rest.cwiseAbs().maxCoeff();
    if (size <= enough) return;
    if (!(size < least_gain * last)) {  // too old a factor
      factorised = false;
      factorise();
      return solve(rhs, settling, answer);
    }
    last = size;
    solve(rest, settling, correction);
    answer += correction;
  }
}

void Reynolds::Impl::subtract_product(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::VectorXd& y) const {
  for (Eigen::Index column = 0; column < x.size(); ++column)
    for (auto k = balance.column_start()[column]; k < balance.column_start()[column + 1]; ++k)
      y[balance.row_index()[k]] -= balance.values()[k] * x[column];
}

void Reynolds::settle(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u,
                      StepOilBalance& oil) {
  Impl& m = *impl_;
  const FilmDomain domain = m.balance.evaluate(motion, history, u);
  HERSEY_REQUIRE(domain.is_inside(), text(m.balance.model(), domain));
  m.rhs = -m.balance.residual();
  m.balance.subtract_squeeze_defect(m.rhs);
  m.balance.assemble_jacobian();
  m.solve_for_settling();
  m.balance.settle(m.answer, oil);
  m.linearised = m.summed = m.factorised = m.set_up = false;
}

}  // namespace hersey::film
