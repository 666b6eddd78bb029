#include "hersey/solver/sparse_lu.h"

#include <klu.h>

#include <vector>

#include "hersey/core/contract.h"

namespace hersey::solver {
namespace {

// A reused pivot order is kept while elements grow by less than this; beyond, half the digits may be gone.
constexpr double smallest_pivot_growth = 1e-6;
constexpr double smallest_reciprocal_condition = 1e-15;

}  // namespace

struct SparseLu::Impl {
  int n = 0;
  std::vector<int> column_start, row_index;
  std::vector<double> pivoted;  // the matrix that chose the pivot order
  klu_common common{};
  klu_symbolic* symbolic = nullptr;
  klu_numeric* numeric = nullptr;
  double rcond = 0;
  int pivotings = 0;
  bool factorised = false;
  bool is_empty = false;                  // analysed, without an unknown: a machine that cannot move
  bool is_structurally_singular = false;  // whatever the values

  Impl() { klu_defaults(&common); }
  ~Impl() { clear(); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void clear() {
    if (numeric) klu_free_numeric(&numeric, &common);
    if (symbolic) klu_free_symbolic(&symbolic, &common);
    factorised = false;
  }

  // KLU takes the values by non-const pointer but does not write them.
  static double* unconst(std::span<const double> values) { return const_cast<double*>(values.data()); }

  bool pivot(std::span<const double> values) {
    if (numeric) klu_free_numeric(&numeric, &common);
    ++pivotings;
    pivoted.assign(values.begin(), values.end());
    numeric = klu_factor(column_start.data(), row_index.data(), unconst(values), symbolic, &common);
    return numeric && condition_is_sound();
  }

  bool reuse_pivots(std::span<const double> values) {
    int* Ap = column_start.data();
    int* Ai = row_index.data();
    if (!klu_refactor(Ap, Ai, unconst(values), symbolic, numeric, &common)) return false;
    klu_rgrowth(Ap, Ai, unconst(values), symbolic, numeric, &common);
    return common.rgrowth > smallest_pivot_growth && condition_is_sound();
  }

  bool condition_is_sound() {
    klu_rcond(symbolic, numeric, &common);
    rcond = common.rcond;
    return rcond > smallest_reciprocal_condition;
  }
};

SparseLu::SparseLu() : impl_(std::make_unique<Impl>()) {}
SparseLu::~SparseLu() = default;
SparseLu::SparseLu(SparseLu&&) noexcept = default;
SparseLu& SparseLu::operator=(SparseLu&&) noexcept = default;

void SparseLu::analyse(int n, std::span<const int> column_start, std::span<const int> row_index) {
  Impl& m = *impl_;
  HERSEY_REQUIRE(n >= 0 && column_start.size() == static_cast<std::size_t>(n) + 1, "one start per column and an end");
  HERSEY_REQUIRE(row_index.size() == static_cast<std::size_t>(column_start[n]), "one row per entry");
  m.clear();
  m.n = n;
  m.pivotings = 0;
  m.column_start.assign(column_start.begin(), column_start.end());
  m.row_index.assign(row_index.begin(), row_index.end());
  m.is_empty = n == 0;
  if (m.is_empty) return;
  m.symbolic = klu_analyze(n, m.column_start.data(), m.row_index.data(), &m.common);
  HERSEY_REQUIRE(m.symbolic, "KLU cannot order the pattern");
  m.is_structurally_singular = m.common.structural_rank < n;
}

void SparseLu::analyse(const Eigen::SparseMatrix<double>& A) {
  HERSEY_REQUIRE(A.isCompressed() && A.rows() == A.cols(), "a compressed square matrix is expected");
  const int n = static_cast<int>(A.cols());
  const auto nonzeros = static_cast<std::size_t>(A.nonZeros());
  analyse(n, {A.outerIndexPtr(), static_cast<std::size_t>(n) + 1}, {A.innerIndexPtr(), nonzeros});
}

bool SparseLu::factorise(std::span<const double> values) {
  Impl& m = *impl_;
  HERSEY_REQUIRE(m.symbolic || m.is_empty, "analyse() comes first");
  HERSEY_REQUIRE(values.size() == m.row_index.size(), "one value per entry of the pattern");
  if (m.is_empty) {
    m.rcond = 1;
    return m.factorised = true;
  }
  m.factorised = !m.is_structurally_singular && ((m.numeric && m.reuse_pivots(values)) || m.pivot(values));
  // A factor with a zero pivot is no pattern to reuse.
  if (!m.factorised && m.numeric) klu_free_numeric(&m.numeric, &m.common);
  return m.factorised;
}

void SparseLu::solve(std::span<double> b, int columns) const {
  Impl& m = *impl_;
  HERSEY_REQUIRE(m.factorised, "no factorisation to solve with");
  HERSEY_REQUIRE(b.size() == static_cast<std::size_t>(m.n) * static_cast<std::size_t>(columns), "shape (n, columns)");
  if (m.is_empty) return;
  klu_solve(m.symbolic, m.numeric, m.n, columns, b.data(), &m.common);
}

void SparseLu::solve_transposed(std::span<double> b, int columns) const {
  Impl& m = *impl_;
  HERSEY_REQUIRE(m.factorised, "no factorisation to solve with");
  HERSEY_REQUIRE(b.size() == static_cast<std::size_t>(m.n) * static_cast<std::size_t>(columns), "shape (n, columns)");
  if (m.is_empty) return;
  klu_tsolve(m.symbolic, m.numeric, m.n, columns, b.data(), &m.common);
}

int SparseLu::size() const { return impl_->n; }
bool SparseLu::factorised() const { return impl_->factorised; }
double SparseLu::reciprocal_condition() const { return impl_->rcond; }
int SparseLu::pivotings() const { return impl_->pivotings; }

void SparseLu::persist(Archive& archive) {
  Impl& m = *impl_;
  std::vector<int> column_start = m.column_start, row_index = m.row_index;
  std::vector<double> values = m.numeric ? m.pivoted : std::vector<double>{};
  archive.io("column_start", column_start);
  archive.io("row_index", row_index);
  archive.io("pivoted_matrix", values);
  if (!archive.restores()) return;
  m.clear();
  if (column_start.empty()) return;
  analyse(static_cast<int>(column_start.size()) - 1, column_start, row_index);
  if (!values.empty() && (values.size() != row_index.size() || !m.pivot(values)))
    throw ArchiveError("the stored matrix cannot be factorised");
}

}  // namespace hersey::solver
