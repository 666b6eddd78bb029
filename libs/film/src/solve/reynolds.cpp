#include "hersey/film/reynolds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "balance/flow_balance.h"
#include "hersey/core/contract.h"
#include "hersey/core/stopwatch.h"
#include "hersey/solver/subtract_product.h"
#include "observe/film_wrench.h"
#include "observe/observe_evaluated.h"
#include "solve/grid_lu.h"
#include "solve/multigrid_solver.h"
#include "solve/port_border.h"
#include "solve/shape_answers.h"

namespace hersey::film {
namespace {

// What responses leave of their right-hand sides.
constexpr double tight = 1e-10;

// What one solution leaves of a step's defect of oil, what refinement leaves, and what each of its turns leaves of the
// last at most: ten turns cost what a factor does.
constexpr double settling = 1e-6, refined_to = 1e-12, least_gain = 0.1;

// Right-hand sides that multigrid has not solved after so many iterations are left to the direct solver.
constexpr int most_iterations = 80;

std::span<double> numbers_of(Eigen::Ref<Eigen::MatrixXd>& columns) {
  return {columns.data(), static_cast<std::size_t>(columns.size())};
}

}  // namespace

struct Reynolds::Impl {
  Impl(const FilmModel& model, LinearSolver chosen)
      : balance(model), wrench(model), lu(balance.model().grid), shape_answers(balance) {
    state.kind = chosen;
  }

  [[nodiscard]] FilmDomain evaluate(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u);
  void assemble_jacobian();
  void factorise();
  void take_speeds(const SurfaceMotion& motion);
  [[nodiscard]] bool is_finite() const;
  void find_row_sizes();
  [[nodiscard]] bool factorise_shifted(double shift);
  [[nodiscard]] bool solve_regularised(Eigen::VectorXd& du);
  [[nodiscard]] bool solve_by_multigrid(Eigen::Ref<Eigen::MatrixXd> columns, double rtol);
  void solve(const Eigen::VectorXd& rhs, double rtol, Eigen::VectorXd& x);
  void solve_columns(const Eigen::Ref<Eigen::MatrixXd>& columns, double rtol);
  void solve_in_pattern(Eigen::Ref<Eigen::MatrixXd> columns, double rtol);
  void solve_by_factor(std::span<double> columns, SystemMatrix matrix = SystemMatrix::jacobian);
  void solve_directly(const Eigen::Ref<Eigen::MatrixXd>& columns);
  void solve_transposed(const Eigen::Ref<Eigen::MatrixXd>& columns);
  void condense_by_adjoint(const SurfaceShapes& shapes, CondensedFilm& film);
  void multiply_by_adjoint();
  void condense_by_columns(const Eigen::MatrixXd& openings, CondensedFilm& film);
  void find_port_flows(PortFlows flows, CondensedFilm& film);
  void find_partials(std::span<const MotionDirection> directions, const SurfaceShapes& shapes, PortFlows flows,
                     CondensedFilm& film);
  void find_partials_along(const MotionDirection& direction, Eigen::Index column, const Eigen::MatrixXd& openings,
                           PortFlows flows, CondensedFilm& film);
  void set_up_multigrid();
  void solve_for_settling();
  void subtract_product(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::VectorXd& y) const;
  const FilmWrench& summed_wrench();

  FlowBalance balance;
  FilmWrench wrench;
  LinearSolverState state;  // but for has_factor
  FilmWork work;            // but for factorisations
  GridLu lu;                // of the matrix in the pattern, which the border completes
  PortBorder border;
  std::optional<MultigridSolver> multigrid;
  std::vector<double> shifted;
  Eigen::VectorXd rhs, answer, row_size, rest, correction, port_change;
  // Of the last condensation, n rows each: residual's derivative along the directions; then either the answer of each
  // output (six of the wrench, forces on shapes, flows of ports) to the residual, or the increment and the answers to
  // the directions.
  Eigen::MatrixXd unsolved, residual_by_s, adjoint, products, answers, port_flow_by_u;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> adjoint_rows;
  Eigen::VectorXd condensed_residual, increment;
  ShapeAnswers shape_answers;
  MotionDirection along_amplitude, along_rate;  // of a shape that is a column of its own
  Eigen::Index before_shapes = 0;               // directions whose columns stand before those of the shapes
  bool shapes_by_operator = false;              // residual_by_s has columns of the directions alone
  SurfaceMotion speeds;                         // without gap and rate
  bool evaluated = false;  // `balance` has the state of the last evaluation, which was inside the domain
  bool linearised = false, summed = false, factorised = false, set_up = false, multigrid_is_sound = false;
  bool condensed = false;
};

FilmDomain Reynolds::Impl::evaluate(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u) {
  const Stopwatch watch(work.balance);
  ++work.evaluations;
  return balance.evaluate(motion, history, u);
}

void Reynolds::Impl::assemble_jacobian() {
  const Stopwatch watch(work.jacobian);
  balance.assemble_jacobian();
  border.take(balance);
}

bool Reynolds::Impl::is_finite() const {
  const auto values = balance.values();
  return balance.residual().allFinite() &&
         std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

void Reynolds::Impl::take_speeds(const SurfaceMotion& motion) {
  speeds.u_shell = motion.u_shell, speeds.u_journal = motion.u_journal;
  speeds.w_shell = motion.w_shell, speeds.w_journal = motion.w_journal;
  speeds.shell_opening = motion.shell_opening;
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
  ++state.factorisations;
  return lu.factorise(shifted);
}

// A film nobody supplies leaves its fill level open, one at rest its fill fraction: the Jacobian is singular. A shift
// of the diagonal far below any conductance then picks a solution near the present state; the residual stays exact.
// Trials far from any answer may have conductances far above or below the model's: there the shift grows with the rows,
// up to a diagonal that outweighs them, which can always be factorised. It is a short step then.
void Reynolds::Impl::factorise() {
  HERSEY_REQUIRE(linearised, "linearise() comes first");
  if (factorised) return;
  const Stopwatch watch(work.factors);
  if (!lu.is_analysed()) lu.analyse(balance.column_start(), balance.row_index());
  if (state.kind == LinearSolver::direct) border.forget_answers();
  ++state.factorisations;
  factorised = lu.factorise(balance.values());
  if (factorised) return;
  row_size.setConstant(balance.size(), balance.conductance_scale());
  for (double shift = 1e-9; !factorised && shift < 1; shift *= 100) factorised = factorise_shifted(shift);
  if (!factorised) find_row_sizes();
  for (double shift = 1e-9; !factorised && shift < 1e4; shift *= 100) factorised = factorise_shifted(shift);
  HERSEY_REQUIRE(factorised, "a matrix of finite numbers with a heavy diagonal has a factor");
}

// @returns whether the matrix had a factor
bool Reynolds::Impl::solve_regularised(Eigen::VectorXd& du) {
  HERSEY_REQUIRE(linearised, "linearise() comes first");
  {
    const Stopwatch watch(work.factors);
    if (!lu.is_analysed()) lu.analyse(balance.column_start(), balance.row_index());
    find_row_sizes();
    factorised = false;  // as far as the Jacobian itself is asked for
    if (!factorise_shifted(1e-3)) return false;
  }
  du = -balance.residual();
  border.forget_answers();
  solve_directly(du);
  border.forget_answers();
  return true;
}

void Reynolds::Impl::set_up_multigrid() {
  HERSEY_REQUIRE(linearised, "linearise() comes first");
  if (set_up) return;
  const Grid& grid = balance.model().grid;
  if (!multigrid) multigrid.emplace(grid.n_phi, grid.n_z, balance.column_start(), balance.row_index());
  ++state.setups;
  multigrid_is_sound = multigrid->setup(balance.values(), balance.speed_phi() >= 0);
  set_up = true;
}

// Sums over the surface are not needed on the way to a solution.
const FilmWrench& Reynolds::Impl::summed_wrench() {
  HERSEY_REQUIRE(linearised, "linearise() comes first");
  if (!summed) {
    const Stopwatch watch(work.forces);
    wrench.evaluate(balance, speeds, true);
  }
  summed = true;
  return wrench;
}

bool Reynolds::Impl::solve_by_multigrid(Eigen::Ref<Eigen::MatrixXd> columns, double rtol) {
  const Stopwatch watch(work.solutions);
  set_up_multigrid();
  if (!multigrid_is_sound) return false;
  if (unsolved.cols() < columns.cols()) unsolved.resize(columns.rows(), columns.cols());
  unsolved.leftCols(columns.cols()) = columns;
  const MultigridSummary summary = multigrid->solve(columns, {.rtol = rtol, .max_iterations = most_iterations});
  state.iterations += summary.iterations;
  if (!summary.solved()) columns = unsolved.leftCols(columns.cols());
  return summary.solved();
}

// Of the matrix in the pattern, without the border.
void Reynolds::Impl::solve_by_factor(std::span<double> columns, SystemMatrix matrix) {
  const Stopwatch watch(work.solutions);
  const int count = static_cast<int>(columns.size()) / balance.size();
  matrix == SystemMatrix::transposed ? lu.solve_transposed(columns, count) : lu.solve(columns, count);
}

void Reynolds::Impl::solve_directly(const Eigen::Ref<Eigen::MatrixXd>& columns) {
  border.solve(columns, [&](Eigen::Ref<Eigen::MatrixXd> of) { solve_by_factor(numbers_of(of)); });
}

void Reynolds::Impl::solve_transposed(const Eigen::Ref<Eigen::MatrixXd>& columns) {
  border.solve_transposed(
      columns, [&](Eigen::Ref<Eigen::MatrixXd> of) { solve_by_factor(numbers_of(of)); },
      [&](Eigen::Ref<Eigen::MatrixXd> of) { solve_by_factor(numbers_of(of), SystemMatrix::transposed); });
}

void Reynolds::Impl::solve(const Eigen::VectorXd& b, double rtol, Eigen::VectorXd& x) {
  x = b;
  solve_columns(x, rtol);
}

void Reynolds::Impl::solve_columns(const Eigen::Ref<Eigen::MatrixXd>& columns, double rtol) {
  if (border.is_empty()) return solve_in_pattern(columns, rtol);
  border.solve(columns, [&](const Eigen::Ref<Eigen::MatrixXd>& of) { solve_in_pattern(of, std::min(rtol, tight)); });
}

void Reynolds::Impl::solve_in_pattern(Eigen::Ref<Eigen::MatrixXd> columns, double rtol) {
  if (state.kind == LinearSolver::multigrid) {
    if (solve_by_multigrid(columns, rtol)) return;
    state.fallback_solves += static_cast<int>(columns.cols());
  }
  factorise();
  solve_by_factor(numbers_of(columns));
}

// With J^T Lambda = F_u^T for forces and flows F:  F_u du0 = -Lambda^T r  and  F_u U = -Lambda^T r_s.
void Reynolds::Impl::condense_by_adjoint(const SurfaceShapes& shapes, CondensedFilm& film) {
  factorise();
  const Eigen::Index count = shapes.amplitudes(), ports = film.port_flow.size();
  adjoint.resize(wrench.gradient_u().cols(), 6 + count + ports);
  adjoint.leftCols<6>() = wrench.gradient_u().transpose();
  adjoint.middleCols(6, count) = wrench.normal().by_u.asDiagonal() * shapes.openings;
  adjoint.rightCols(ports) = port_flow_by_u;
  solve_transposed(adjoint);
  for (Eigen::Index i = 0; i < 6; ++i) film.wrench[i] -= adjoint.col(i).dot(balance.residual());
  film.Q.noalias() -= adjoint.middleCols(6, count).transpose() * balance.residual();
  film.port_flow.noalias() -= adjoint.rightCols(ports).transpose() * balance.residual();
  const Stopwatch watch(work.derivatives);
  multiply_by_adjoint();
  const auto add = [&](Eigen::Index column, Eigen::Index from, Eigen::Index columns) {
    film.wrench_by_s.middleCols(column, columns) += products.block(0, from, 6, columns);
    film.Q_by_s.middleCols(column, columns) += products.block(6, from, count, columns);
    film.port_flow_by_s.middleCols(column, columns) += products.block(6 + count, from, ports, columns);
  };
  if (!shapes_by_operator) return add(0, 0, products.cols());
  const Eigen::Index behind = residual_by_s.cols() - before_shapes;
  add(0, 0, before_shapes);
  add(before_shapes + 2 * count, before_shapes, behind);
  shape_answers.add(shapes, adjoint.leftCols(6 + count), wrench, film, before_shapes);
}

// Computes -Lambda^T r_s, with rows of zeros up to whole registers. Rows of the transposed product are columns of this
// one.
void Reynolds::Impl::multiply_by_adjoint() {
  const Eigen::Index n = adjoint.rows(), padded = (adjoint.cols() + 3) / 4 * 4;
  adjoint_rows.setZero(n, padded);
  adjoint_rows.leftCols(adjoint.cols()) = adjoint;
  products.setZero(padded, residual_by_s.cols());
  solver::subtract_product(static_cast<int>(residual_by_s.cols()), static_cast<int>(padded), static_cast<int>(n),
                           {residual_by_s.data(), n, 1}, adjoint_rows.data(), padded, products.data(), padded);
}

void Reynolds::Impl::condense_by_columns(const Eigen::MatrixXd& openings, CondensedFilm& film) {
  const Eigen::Index count = residual_by_s.cols();
  answers.resize(residual_by_s.rows(), count + 1);
  answers.leftCols(count) = -residual_by_s;
  answers.col(count) = -balance.residual();
  solve_columns(answers, tight);
  increment = answers.col(count);
  film.wrench += wrench.change_by_u(increment);
  film.port_flow.noalias() += port_flow_by_u.transpose() * increment;
  rhs = wrench.normal().by_u.cwiseProduct(increment);
  film.Q.noalias() += openings.transpose() * rhs;
  for (Eigen::Index k = 0; k < count; ++k) {
    answer = answers.col(k);
    film.wrench_by_s.col(k) += wrench.change_by_u(answer);
    film.port_flow_by_s.col(k).noalias() += port_flow_by_u.transpose() * answer;
    rhs = wrench.normal().by_u.cwiseProduct(answer);
    film.Q_by_s.col(k).noalias() += openings.transpose() * rhs;
  }
}

// Derivatives at fixed u along each direction, and along each shape that is a column of its own.
void Reynolds::Impl::find_partials(std::span<const MotionDirection> directions, const SurfaceShapes& shapes,
                                   PortFlows flows, CondensedFilm& film) {
  const Stopwatch watch(work.derivatives);
  const Eigen::Index count = shapes.amplitudes();
  const Eigen::Index inserted = shapes_by_operator ? 0 : 2 * count;
  residual_by_s.resize(balance.size(), static_cast<Eigen::Index>(directions.size()) + inserted);
  film.wrench_by_s.setZero(6, static_cast<Eigen::Index>(directions.size()) + 2 * count);
  film.Q_by_s.setZero(count, film.wrench_by_s.cols());
  for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(directions.size()); ++k) {
    const Eigen::Index column = k < before_shapes ? k : k + inserted;
    find_partials_along(directions[static_cast<std::size_t>(k)], column, shapes.openings, flows, film);
  }
  for (Eigen::Index a = 0; a < inserted / 2; ++a) {
    shapes.find_along_amplitude(a, along_amplitude);
    shapes.find_along_rate(a, along_rate);
    find_partials_along(along_amplitude, before_shapes + a, shapes.openings, flows, film);
    find_partials_along(along_rate, before_shapes + count + a, shapes.openings, flows, film);
  }
}

// `column` of residual_by_s; of the outputs those of the shapes stand in between in any case.
void Reynolds::Impl::find_partials_along(const MotionDirection& direction, Eigen::Index column,
                                         const Eigen::MatrixXd& openings, PortFlows flows, CondensedFilm& film) {
  balance.derivative(direction, rhs, flows == PortFlows::included ? &port_change : nullptr);
  residual_by_s.col(column) = rhs;
  const Eigen::Index missing = film.wrench_by_s.cols() - residual_by_s.cols();
  const Eigen::Index of_outputs = column < before_shapes ? column : column + missing;
  if (flows == PortFlows::included) film.port_flow_by_s.col(of_outputs) = port_change;
  film.wrench_by_s.col(of_outputs) = wrench.along(direction);
  if (openings.cols() == 0 || direction.g.size() == 0 || wrench.normal().by_g.isZero(0)) return;
  rhs = wrench.normal().by_g.cwiseProduct(direction.g);
  film.Q_by_s.col(of_outputs).noalias() = openings.transpose() * rhs;
}

// Flows through the ports, or none; their derivatives along directions are condense()'s.
void Reynolds::Impl::find_port_flows(PortFlows flows, CondensedFilm& film) {
  if (flows == PortFlows::left_out) {
    port_flow_by_u.resize(balance.size(), 0);
    film.port_flow.resize(0);
    return;
  }
  balance.find_port_flows(film.port_flow);
  balance.find_port_flows_by_u(port_flow_by_u);
}

Reynolds::Reynolds(const FilmModel& model, LinearSolver linear) : impl_(std::make_unique<Impl>(model, linear)) {}
Reynolds::~Reynolds() = default;
Reynolds::Reynolds(Reynolds&&) noexcept = default;
Reynolds& Reynolds::operator=(Reynolds&&) noexcept = default;

const FilmModel& Reynolds::model() const { return impl_->balance.model(); }

LinearSolverState Reynolds::linear_solver() const {
  LinearSolverState state = impl_->state;
  state.has_factor = impl_->linearised && impl_->factorised;
  return state;
}

FilmDomain Reynolds::linearise(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u) {
  impl_->linearised = impl_->summed = impl_->evaluated = false;
  if (const FilmDomain domain = impl_->evaluate(motion, history, u); !domain.is_inside()) return domain;
  impl_->assemble_jacobian();
  if (!impl_->is_finite()) return {FilmDomain::Violation::not_finite, -1};
  impl_->factorised = impl_->set_up = impl_->condensed = false;
  impl_->take_speeds(motion);
  impl_->linearised = impl_->evaluated = true;
  return {};
}

FilmResidual Reynolds::residual() const {
  const FlowBalance& balance = impl_->balance;
  return {balance.residual(), balance.relative_residual(), balance.worst_node()};
}

FilmForces Reynolds::forces() const {
  const FilmWrench& wrench = impl_->summed_wrench();
  return {wrench.total(), wrench.gradient_u(), wrench.normal()};
}

FilmObservables Reynolds::observe(const SurfaceMotion& motion, const Eigen::Vector2d& e, const Eigen::VectorXd& u,
                                  const Eigen::Vector2d& tilt) const {
  HERSEY_REQUIRE(impl_->evaluated, "linearise() or settle() comes first");
  if (impl_->balance.model().shear_force != ShearForce::none) {
    if (!impl_->linearised) impl_->wrench.evaluate(impl_->balance, motion, false);
    const FilmWrench& now = impl_->linearised ? impl_->summed_wrench() : impl_->wrench;
    return observe_evaluated(impl_->balance, now, motion, e, u, tilt);
  }
  FilmWrench wrench(with_torque(impl_->balance.model()));
  wrench.evaluate(impl_->balance, motion, false);
  return observe_evaluated(impl_->balance, wrench, motion, e, u, tilt);
}

FilmFields Reynolds::fields() const {
  HERSEY_REQUIRE(impl_->evaluated, "linearise() or settle() comes first");
  return fields_of(impl_->balance);
}

void Reynolds::newton_increment(Eigen::VectorXd& du, const IncrementOptions& options) {
  Impl& m = *impl_;
  if (options.is_regularised && m.solve_regularised(du)) return;
  m.rhs = -m.balance.residual();
  m.solve(m.rhs, options.rtol, du);
}

FilmDomain Reynolds::chord_increment(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u,
                                     Eigen::VectorXd& du) {
  Impl& m = *impl_;
  HERSEY_REQUIRE(m.linearised && m.factorised, "a linearisation with a factor");
  (void)m.summed_wrench();
  m.evaluated = false;
  const FilmDomain domain = m.evaluate(motion, history, u);
  if (!domain.is_inside()) {
    m.linearised = m.summed = m.factorised = m.set_up = false;
    return domain;
  }
  m.evaluated = true;
  m.take_speeds(motion);
  {
    const Stopwatch watch(m.work.forces);
    m.wrench.evaluate(m.balance, m.speeds, false);
  }
  du = -m.balance.residual();
  m.solve_directly(du);
  return {};
}

ActiveSet Reynolds::active_set() const { return ActiveSet(impl_->balance); }

FilmWork Reynolds::work() const {
  FilmWork work = impl_->work;
  work.factorisations = impl_->state.factorisations;
  return work;
}

void Reynolds::condense(std::span<const MotionDirection> directions, const SurfaceShapes& shapes, CondensedFilm& film,
                        PortFlows flows) {
  Impl& m = *impl_;
  HERSEY_REQUIRE(shapes.openings.rows() == m.balance.size(), "openings of shape (grid.size(), amplitudes)");
  const FilmWrench& now = m.summed_wrench();
  const auto feeds = [](const MotionDirection& direction) { return direction.port_pressure.size() != 0; };
  const auto ports = std::find_if(directions.begin(), directions.end(), feeds);
  HERSEY_REQUIRE(shapes.amplitudes() == 0 || std::all_of(ports, directions.end(), feeds), "ports behind all motions");
  m.condensed_residual = m.balance.residual();
  m.condensed = true;
  m.before_shapes = ports - directions.begin();
  m.shapes_by_operator =
      m.state.kind == LinearSolver::direct && flows == PortFlows::left_out && m.balance.restricted_ports().empty();
  m.find_port_flows(flows, film);
  film.port_flow_by_s.resize(film.port_flow.size(),
                             static_cast<Eigen::Index>(directions.size()) + 2 * shapes.amplitudes());
  m.find_partials(directions, shapes, flows, film);
  film.wrench = now.total();
  film.Q.noalias() = shapes.openings.transpose() * now.normal().value;
  if (m.state.kind == LinearSolver::direct) {
    m.condense_by_adjoint(shapes, film);
  } else {
    m.condense_by_columns(shapes.openings, film);
  }
}

void Reynolds::follow(const Eigen::Ref<const Eigen::VectorXd>& ds, const SurfaceShapes& shapes, Eigen::VectorXd& du) {
  Impl& m = *impl_;
  const Eigen::Index count = shapes.amplitudes(), inserted = m.shapes_by_operator ? 2 * count : 0;
  HERSEY_REQUIRE(m.condensed && ds.size() == m.residual_by_s.cols() + inserted, "condense() comes first");
  if (m.state.kind != LinearSolver::direct) {
    du = m.increment;
    du.noalias() += m.answers.leftCols(ds.size()) * ds;
    return;
  }
  du = -m.condensed_residual;
  if (inserted == 0) {
    du.noalias() -= m.residual_by_s * ds;
  } else {
    const Eigen::Index before = m.before_shapes, behind = m.residual_by_s.cols() - before;
    du.noalias() -= m.residual_by_s.leftCols(before) * ds.head(before);
    du.noalias() -= m.residual_by_s.rightCols(behind) * ds.tail(behind);
    m.shape_answers.subtract_residual(shapes, ds.segment(before, count), ds.segment(before + count, count), du);
  }
  m.solve_directly(du);
}

void Reynolds::partials(std::span<const MotionDirection> directions, Eigen::MatrixXd& residual,
                        Eigen::Matrix<double, 6, Eigen::Dynamic>& wrench) {
  const FilmWrench& now = impl_->summed_wrench();
  Eigen::VectorXd& column = impl_->rhs;
  residual.resize(impl_->balance.size(), static_cast<Eigen::Index>(directions.size()));
  wrench.resize(6, residual.cols());
  for (Eigen::Index k = 0; k < residual.cols(); ++k) {
    const MotionDirection& direction = directions[static_cast<std::size_t>(k)];
    impl_->balance.derivative(direction, column);
    residual.col(k) = column;
    wrench.col(k) = now.along(direction);
  }
}

Eigen::VectorXd Reynolds::jacobian_product(const Eigen::Ref<const Eigen::VectorXd>& v) const {
  HERSEY_REQUIRE(impl_->linearised && v.size() == impl_->balance.size(), "linearise() comes first; shape (n)");
  Eigen::VectorXd product = Eigen::VectorXd::Zero(v.size());
  impl_->subtract_product(v, product);
  return -product;
}

void Reynolds::solve(Eigen::MatrixXd& columns, SystemMatrix matrix, double rtol) {
  Impl& m = *impl_;
  HERSEY_REQUIRE(columns.rows() == m.balance.size(), "shape (n, any)");
  const bool is_transposed = matrix == SystemMatrix::transposed;
  if (m.state.kind == LinearSolver::multigrid) {
    HERSEY_REQUIRE(!is_transposed, "a direct solver for the transposed system");
    return m.solve_columns(columns, rtol);
  }
  m.factorise();
  if (is_transposed)
    m.solve_transposed(columns);
  else
    m.solve_directly(columns);
}

Eigen::MatrixXd Reynolds::inertia(const Eigen::MatrixXd& du_by_rate, double momentum_factor) {
  Eigen::MatrixXd answer(du_by_rate.rows(), du_by_rate.cols());
  for (Eigen::Index k = 0; k < answer.cols(); ++k) {
    impl_->balance.inertia_residual(du_by_rate.col(k), momentum_factor, impl_->rhs);
    answer.col(k) = -impl_->rhs;
  }
  solve(answer);
  return answer;
}

void Reynolds::persist(Archive& archive) {
  impl_->lu.persist(archive);
  if (archive.restores())
    impl_->linearised = impl_->evaluated = impl_->factorised = impl_->set_up = impl_->condensed = false;
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
  const Eigen::VectorXd before = border.at_ports(y);
  for (Eigen::Index column = 0; column < x.size(); ++column)
    for (auto k = balance.column_start()[column]; k < balance.column_start()[column + 1]; ++k)
      y[balance.row_index()[k]] -= balance.values()[k] * x[column];
  border.subtract_product(x, before, y);
}

void Reynolds::settle(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u,
                      StepOilBalance& oil) {
  const FilmDomain domain = impl_->evaluate(motion, history, u);
  HERSEY_REQUIRE(domain.is_inside(), text(impl_->balance.model(), domain));
  impl_->evaluated = true;
  settle(oil);
}

void Reynolds::settle(StepOilBalance& oil) {
  Impl& m = *impl_;
  HERSEY_REQUIRE(m.evaluated, "linearise() or chord_increment() comes first");
  m.rhs = -m.balance.residual();
  m.balance.subtract_squeeze_defect(m.rhs);
  m.assemble_jacobian();
  m.solve_for_settling();
  m.balance.settle(m.answer, oil);
  m.linearised = m.summed = m.factorised = m.set_up = false;
}

void respond(Reynolds& film, std::span<const MotionDirection> directions, Eigen::MatrixXd& du,
             Eigen::Matrix<double, 6, Eigen::Dynamic>& wrench_partial, double rtol) {
  film.partials(directions, du, wrench_partial);
  du = -du;
  film.solve(du, SystemMatrix::jacobian, rtol);
}

}  // namespace hersey::film
