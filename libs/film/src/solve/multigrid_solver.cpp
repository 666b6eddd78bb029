#include "solve/multigrid_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hersey/core/contract.h"

// Functions of this file alone, which are inlined, return four numbers in double precision: no other file depends on
// the registers in which they do.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

namespace hersey::film {
namespace {

constexpr int centre = 0, west = 1, east = 2, south = 3, north = 4;

// Vectors kept between two restarts: six to eight of them take a residual as far as single precision carries it.
constexpr int kRestart = 6;

// What the vectors of one restart, in single precision, can take a residual to, as a fraction of what it was.
constexpr double kSingle = 3e-6;

template <class Value>
constexpr int kLanes = sizeof(Value) / sizeof(Real);

Real narrow(double value) { return static_cast<Real>(value); }
Pack narrow(const WidePack& values) { return __builtin_convertvector(values, Pack); }
double widen(Real value) { return value; }
WidePack widen(const Pack& values) { return __builtin_convertvector(values, WidePack); }
double lane(const double& value, int /*k*/) { return value; }
double lane(const WidePack& values, int k) { return values[k]; }
void set_lane(double& value, int /*k*/, double to) { value = to; }
void set_lane(WidePack& values, int k, double to) { values[k] = to; }

/// One number for each right-hand side.
template <class Value>
using Lanes = std::array<double, kLanes<Value>>;

template <class Value>
Lanes<Value> lanes_of(const WideOf<Value>& sums) {
  Lanes<Value> lanes;
  for (int k = 0; k < kLanes<Value>; ++k) lanes[k] = lane(sums, k);
  return lanes;
}

template <class Value>
Value value_of(const Lanes<Value>& lanes) {
  Value value{};
  for (int k = 0; k < kLanes<Value>; ++k) film::set_lane(value, k, static_cast<Real>(lanes[k]));
  return value;
}

template <class Value>
WideOf<Value> wide_of(const Lanes<Value>& lanes) {
  WideOf<Value> values{};
  for (int k = 0; k < kLanes<Value>; ++k) set_lane(values, k, lanes[k]);
  return values;
}

template <class Value>
Lanes<Value> norms(const std::vector<WideOf<Value>>& x) {
  WideOf<Value> sum{};
  for (const WideOf<Value>& value : x) sum += value * value;
  Lanes<Value> lanes = lanes_of<Value>(sum);
  for (double& value : lanes) value = std::sqrt(value);
  return lanes;
}

/// The small least-squares problem of GMRES, for one right-hand side.
class Projection {
 public:
  void begin(double norm) {
    g_[0] = norm;
    count_ = 0;
  }

  /// Takes the next column of the Hessenberg matrix, h, and the norm below it. @return the residual's norm
  double add(const std::array<double, kRestart>& h, double norm) {
    const int k = count_++;
    std::array<double, kRestart>& column = r_[k];
    column = h;
    for (int i = 0; i < k; ++i) {
      const double upper = column[i], lower = column[i + 1];
      column[i] = cosine_[i] * upper + sine_[i] * lower;
      column[i + 1] = cosine_[i] * lower - sine_[i] * upper;
    }
    const double size = std::hypot(column[k], norm);
    cosine_[k] = size > 0 ? column[k] / size : 1;
    sine_[k] = size > 0 ? norm / size : 0;
    column[k] = size;
    g_[k + 1] = -sine_[k] * g_[k];
    g_[k] *= cosine_[k];
    return std::abs(g_[k + 1]);
  }

  /// Returns the factors of the vectors.
  [[nodiscard]] std::array<double, kRestart> factors() const {
    std::array<double, kRestart> y{};
    for (int i = count_ - 1; i >= 0; --i) {
      double sum = g_[i];
      for (int j = i + 1; j < count_; ++j) sum -= r_[j][i] * y[j];
      y[i] = r_[i][i] != 0 ? sum / r_[i][i] : 0;
    }
    return y;
  }

 private:
  std::array<std::array<double, kRestart>, kRestart> r_{};  // by columns
  std::array<double, kRestart> cosine_{}, sine_{};
  std::array<double, kRestart + 1> g_{};
  int count_ = 0;
};

/// Takes the part along the first vectors of a basis from the next one (classical Gram-Schmidt: each vector is read
/// twice in all), and normalises what is left. @return products with the basis, and the norm of what is left, by lane
template <class Value>
std::array<Lanes<Value>, kRestart + 1> orthogonalise(std::vector<LineVectorOf<Value>>& basis, int count, int lines,
                                                     int n) {
  using Wide = WideOf<Value>;
  std::array<Lanes<Value>, kRestart + 1> h{};
  Value* w = basis[count].data();
  std::array<Wide, kRestart> sums{};
  for (int line = 0; line < lines; ++line) {
    const Value* here = w + line * n;
    for (int i = 0; i < count; ++i) {
      const Value* v = basis[i].data() + line * n;
      Value even{}, odd{};  // sums of a line alone: single precision suffices
      int j = 0;
      for (; j + 1 < n; j += 2) even += v[j] * here[j], odd += v[j + 1] * here[j + 1];
      if (j < n) even += v[j] * here[j];
      sums[i] += widen(even + odd);
    }
  }
  std::array<Value, kRestart> factor{};
  for (int i = 0; i < count; ++i) h[i] = lanes_of<Value>(sums[i]), factor[i] = value_of<Value>(h[i]);
  Wide square{};
  for (int line = 0; line < lines; ++line) {
    Value* here = w + line * n;
    for (int i = 0; i < count; ++i) {
      const Value *v = basis[i].data() + line * n, f = factor[i];
      for (int j = 0; j < n; ++j) here[j] -= f * v[j];
    }
    Value even{}, odd{};
    int j = 0;
    for (; j + 1 < n; j += 2) even += here[j] * here[j], odd += here[j + 1] * here[j + 1];
    if (j < n) even += here[j] * here[j];
    square += widen(even + odd);
  }
  Lanes<Value> norm = lanes_of<Value>(square), inverse{};
  for (int k = 0; k < kLanes<Value>; ++k) {
    norm[k] = std::sqrt(norm[k]);
    inverse[k] = norm[k] > std::numeric_limits<Real>::min() ? 1 / norm[k] : 0;
  }
  const auto scale = value_of<Value>(inverse);
  for (int j = 0; j < lines * n; ++j) w[j] *= scale;
  h[count] = norm;
  return h;
}

}  // namespace

MultigridSolver::MultigridSolver(int n_phi, int n_z, std::span<const int> column_start, std::span<const int> row_index)
    : n_phi_(n_phi), n_z_(n_z), multigrid_(n_phi, n_z) {
  const int n = n_phi * n_z;
  slot_.reserve(row_index.size());
  for (int column = 0; column < n; ++column) {
    for (int k = column_start[column]; k < column_start[column + 1]; ++k) {
      const int row = row_index[k], lines = (column / n_z - row / n_z + n_phi) % n_phi;
      const int entry = column == row       ? centre
                        : column == row - 1 ? south
                        : column == row + 1 ? north
                        : lines == 1        ? east
                                            : west;
      HERSEY_REQUIRE(entry != west || lines == n_phi - 1, "a five-point pattern");
      slot_.push_back(5 * row + entry);
    }
  }
  rows_.assign(static_cast<std::size_t>(n), {});
  active_.resize(static_cast<std::size_t>(n));
}

// Rows that contain only their own unknown are solved by the first relaxation: coarser grids leave them out.
bool MultigridSolver::setup(std::span<const double> values, bool ascending) {
  for (std::size_t k = 0; k < slot_.size(); ++k) rows_[slot_[k] / 5][slot_[k] % 5] = values[k];
  // In its own unit the matrix fits the single precision of multigrid; a factor of the preconditioner has no effect.
  double largest = 0;
  for (const Row& row : rows_) largest = std::max(largest, std::abs(row[centre]));
  unit_ = largest;
  const auto entry = [largest](double value) { return static_cast<Real>(value / largest); };
  LineOperator& A = multigrid_.finest();
  for (int node = 0; node < A.size(); ++node) {
    const Row& row = rows_[node];
    const Real none = 0;
    A.row(node) = {none, entry(row[west]), none, entry(row[south]), entry(row[centre]), entry(row[north]),
                   none, entry(row[east]), none};
    active_[node] = row[west] != 0 || row[east] != 0 || row[south] != 0 || row[north] != 0;
  }
  return multigrid_.setup(active_, ascending);
}

template <class Value>
MultigridSolver::Krylov<Value>& MultigridSolver::krylov_of() {
  if constexpr (std::is_same_v<Value, Real>)
    return single_;
  else
    return abreast_;
}

// residual = b - A x / unit
template <class Value>
void MultigridSolver::find_residual(const Eigen::Ref<const Eigen::MatrixXd>& b, Krylov<Value>& krylov) const {
  const double inverse = 1 / unit_;
  const WideOf<Value>* x = krylov.x.data();
  for (int i = 0; i < n_phi_; ++i) {
    const int at = i * n_z_, last = at + n_z_ - 1;
    const int before = (i == 0 ? n_phi_ - 1 : i - 1) * n_z_ - at, after = (i + 1 == n_phi_ ? 0 : i + 1) * n_z_ - at;
    for (int k = at; k <= last; ++k) {
      const Row& row = rows_[k];
      WideOf<Value> sum = row[centre] * x[k] + row[west] * x[k + before] + row[east] * x[k + after];
      if (k > at) sum += row[south] * x[k - 1];
      if (k < last) sum += row[north] * x[k + 1];
      WideOf<Value> left{};
      for (int c = 0; c < static_cast<int>(b.cols()); ++c) set_lane(left, c, b(k, c));
      krylov.residual[k] = left - inverse * sum;
    }
  }
}

// y = A x / unit
template <class Value>
void MultigridSolver::multiply(const LineVectorOf<Value>& of, LineVectorOf<Value>& y) const {
  const double inverse = 1 / unit_;
  const Value* x = of.data();
  for (int i = 0; i < n_phi_; ++i) {
    const int at = i * n_z_;
    const int before = (i == 0 ? n_phi_ - 1 : i - 1) * n_z_ - at, after = (i + 1 == n_phi_ ? 0 : i + 1) * n_z_ - at;
    // Beyond the ends of a line its rows are zero, and so are the vector's nodes beyond its own.
    for (int k = at; k < at + n_z_; ++k) {
      const Row& row = rows_[k];
      const WideOf<Value> sum = row[centre] * widen(x[k]) + row[west] * widen(x[k + before]) +
                                row[east] * widen(x[k + after]) + row[south] * widen(x[k - 1]) +
                                row[north] * widen(x[k + 1]);
      y[k] = narrow(WideOf<Value>(inverse * sum));
    }
  }
}

// x += the first `count` preconditioned vectors times their factors, line by line, so that x stays in the cache.
template <class Value, class Projections>
void MultigridSolver::add_combination(const Projections& projections, int count, Krylov<Value>& krylov) const {
  std::array<WideOf<Value>, kRestart> factor{};
  for (int c = 0; c < kLanes<Value>; ++c) {
    const std::array<double, kRestart> of_lane = projections[static_cast<std::size_t>(c)].factors();
    for (int i = 0; i < count; ++i) set_lane(factor[i], c, of_lane[i]);
  }
  for (int line = 0; line < n_phi_; ++line) {
    WideOf<Value>* x = krylov.x.data() + line * n_z_;
    for (int i = 0; i < count; ++i) {
      const Value* z = krylov.preconditioned[i].data() + line * n_z_;
      for (int j = 0; j < n_z_; ++j) x[j] += factor[i] * widen(z[j]);
    }
  }
}

template <class Value>
MultigridSummary MultigridSolver::solve_abreast(Eigen::Ref<Eigen::MatrixXd> columns, const MultigridOptions& options) {
  const int n = n_phi_ * n_z_, count = static_cast<int>(columns.cols());
  Krylov<Value>& krylov = krylov_of<Value>();
  if (krylov.x.empty()) {
    krylov.x.resize(static_cast<std::size_t>(n)), krylov.residual.resize(static_cast<std::size_t>(n));
    krylov.basis.assign(kRestart + 1, LineVectorOf<Value>(n));
    krylov.preconditioned.assign(kRestart, LineVectorOf<Value>(n));
  }
  std::vector<WideOf<Value>>&x = krylov.x, &residual = krylov.residual;
  std::fill(x.begin(), x.end(), WideOf<Value>{});
  find_residual<Value>(columns, krylov);
  std::array<Projection, kLanes<Value>> projections;
  Lanes<Value> norm = norms<Value>(residual), target{};
  for (int c = 0; c < kLanes<Value>; ++c) target[c] = options.rtol * norm[c];
  MultigridSummary summary;
  int cycles = 0;
  const auto finish = [&](bool solved) {
    for (int c = 0; c < count; ++c)
      for (int k = 0; k < n; ++k) columns(k, c) = lane(x[k], c) / unit_;
    summary.iterations = cycles * count;
    summary.set_solved(solved);
    return summary;
  };
  for (;;) {
    bool done = true, finite = true;
    Lanes<Value> inverse{};
    for (int c = 0; c < kLanes<Value>; ++c) {
      finite = finite && std::isfinite(norm[c]);
      const bool is_open = norm[c] > target[c];
      done = done && !is_open;
      inverse[c] = is_open ? 1 / norm[c] : 0;
      projections[c].begin(is_open ? norm[c] : 0);
    }
    if (done || !finite || cycles >= options.max_iterations) return finish(done && finite);
    const auto scale = wide_of<Value>(inverse);
    for (int k = 0; k < n; ++k) krylov.basis[0][k] = narrow(WideOf<Value>(scale * residual[k]));
    bool ends = false;
    int k = 0;
    while (k < kRestart && cycles < options.max_iterations && !ends) {
      multigrid_.cycle(krylov.basis[k], krylov.preconditioned[k]);
      multiply<Value>(krylov.preconditioned[k], krylov.basis[k + 1]);
      const auto h = orthogonalise<Value>(krylov.basis, k + 1, n_phi_, n_z_);
      ++cycles;
      ends = true;
      for (int c = 0; c < kLanes<Value>; ++c) {
        std::array<double, kRestart> column{};
        for (int i = 0; i <= k; ++i) column[i] = h[i][c];
        const double left = projections[c].add(column, h[k + 1][c]);
        ends = ends && left <= std::max(target[c], kSingle * norm[c]);
      }
      ++k;
    }
    add_combination<Value>(projections, k, krylov);
    find_residual<Value>(columns, krylov);
    const Lanes<Value> before = norm;
    norm = norms<Value>(residual);
    for (int c = 0; c < kLanes<Value>; ++c)
      if (before[c] > target[c] && !(norm[c] < before[c])) return finish(false);  // stagnation, or not a number
  }
}

MultigridSummary MultigridSolver::solve(const Eigen::VectorXd& b, const MultigridOptions& options, Eigen::VectorXd& x) {
  x = b;
  return solve_abreast<Real>(x, options);
}

MultigridSummary MultigridSolver::solve(Eigen::Ref<Eigen::MatrixXd> columns, const MultigridOptions& options) {
  MultigridSummary all;
  all.set_solved(true);
  for (Eigen::Index from = 0; from < columns.cols(); from += kAbreast) {
    const Eigen::Index count = std::min<Eigen::Index>(kAbreast, columns.cols() - from);
    const MultigridSummary summary = count == 1 ? solve_abreast<Real>(columns.middleCols(from, 1), options)
                                                : solve_abreast<Pack>(columns.middleCols(from, count), options);
    all.iterations += summary.iterations;
    all.set_solved(all.solved() && summary.solved());
  }
  return all;
}

}  // namespace hersey::film

#pragma GCC diagnostic pop
