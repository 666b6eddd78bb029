#include "hersey/solver/symmetric_factor.h"

#include <dlfcn.h>
#include <dmumps_c.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <mutex>

#include "hersey/core/contract.h"

namespace hersey::solver {
namespace {

// MUMPS without METIS, as Debian builds it, orders large patterns by SCOTCH, whose threads find another ordering each
// time. Set while the program is loaded: later threads may read it.
[[maybe_unused]] const int orders_in_one_thread = setenv("SCOTCH_PTHREAD_NUMBER", "1", 0);

// The ordering of a pattern must not depend on previous orderings, so that results are identical to the last bit.
void forget_earlier_orderings() {
  using Reset = void (*)();
  // Not by its header: MUMPS may have been built without SCOTCH.
  if (auto* const reset = reinterpret_cast<Reset>(dlsym(RTLD_DEFAULT, "SCOTCH_randomReset"))) reset();
}

// Jobs of MUMPS.
constexpr int job_start = -1, job_end = -2, job_analyse = 1, job_factorise = 2, job_solve = 3;
// INFOG(1) of MUMPS.
constexpr int error_singular = -10, error_workspace = -9, error_small_workspace = -8;
constexpr int use_communicator_world = -987654;
constexpr int most_retries = 3;
constexpr double mebibyte = 1 << 20;
constexpr double usable_share = 0.9;
// A pivot below this share of the scaled matrix's norm counts as zero. The smallest pivots of a supported body are four
// orders of magnitude larger.
constexpr double null_pivot = 1e-13;

std::mutex& mumps_mutex() {
  static std::mutex mutex;
  return mutex;
}

double free_memory() {
  std::ifstream info("/proc/meminfo");
  std::string key, unit;
  double kibibytes = 0;
  while (info >> key >> kibibytes && std::getline(info, unit))
    if (key == "MemAvailable:") return kibibytes * 1024;
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

struct SymmetricFactor::Impl {
  DMUMPS_STRUC_C mumps{};
  std::vector<int> row, column;
  std::vector<double> values;
  Eigen::Index stored = 0;  // entries of the analysed matrix, both triangles
  double memory_limit = 0;
  bool analysed = false, factorised = false;

  Impl() {
    mumps.sym = 2;  // general symmetric: as fast as definite (measured), and it counts negative and null pivots
    mumps.par = 1;
    mumps.comm_fortran = use_communicator_world;
    call(job_start);
    for (const int stream : {1, 2, 3}) icntl(stream) = -1;
    icntl(4) = 0;          // silent
    icntl(6) = 0;          // no permutation by values: the ordering serves every matrix of the pattern
    icntl(7) = 5;          // METIS, where MUMPS has it
    icntl(8) = 7;          // scaling of rows and columns: the same decisions in any units
    icntl(12) = 1;         // ordering by pattern alone
    icntl(24) = 1;         // continue past null pivots and list them
    mumps.cntl[0] = 0.01;  // a pivot is at least this share of its column; null pivots are not looked for without
    mumps.cntl[2] = null_pivot;
  }
  ~Impl() { call(job_end); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  // Indices as in the manual of MUMPS, which counts from one.
  int& icntl(int i) { return mumps.icntl[i - 1]; }
  [[nodiscard]] int infog(int i) const { return mumps.infog[i - 1]; }

  void call(int job) {
    const std::scoped_lock lock(mumps_mutex());
    if (job == job_analyse) forget_earlier_orderings();
    mumps.job = job;
    dmumps_c(&mumps);
  }

  void take_values(const Eigen::SparseMatrix<double>& A) {
    values.clear();
    for (Eigen::Index j = 0; j < A.outerSize(); ++j)
      for (Eigen::SparseMatrix<double>::InnerIterator entry(A, j); entry; ++entry)
        if (entry.row() >= j) values.push_back(entry.value());
    mumps.a = values.data();
  }

  // Pivoting may need more room than the analysis foresaw.
  void factorise_with_room() {
    for (int attempt = 0; attempt <= most_retries; ++attempt) {
      call(job_factorise);
      if (infog(1) != error_workspace && infog(1) != error_small_workspace) return;
      icntl(14) *= 2;
    }
  }

  [[nodiscard]] double memory() const { return infog(16) * mebibyte; }
};

SymmetricFactor::SymmetricFactor() : impl_(std::make_unique<Impl>()) {}
SymmetricFactor::~SymmetricFactor() = default;
SymmetricFactor::SymmetricFactor(SymmetricFactor&&) noexcept = default;
SymmetricFactor& SymmetricFactor::operator=(SymmetricFactor&&) noexcept = default;

void SymmetricFactor::analyse(const Eigen::SparseMatrix<double>& A) {
  HERSEY_REQUIRE(A.rows() == A.cols() && A.rows() > 0 && A.isCompressed(), "a compressed square matrix is expected");
  Impl& m = *impl_;
  m.row.clear();
  m.column.clear();
  for (Eigen::Index j = 0; j < A.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(A, j); entry; ++entry)
      if (entry.row() >= j) {
        m.row.push_back(static_cast<int>(entry.row()) + 1);
        m.column.push_back(static_cast<int>(j) + 1);
      }
  m.mumps.n = static_cast<int>(A.rows());
  m.mumps.nnz = static_cast<MUMPS_INT8>(m.row.size());
  m.mumps.irn = m.row.data();
  m.mumps.jcn = m.column.data();
  m.values.reserve(m.row.size());
  m.stored = A.nonZeros();
  m.call(job_analyse);
  HERSEY_REQUIRE(m.infog(1) >= 0, fmt::format("the pattern could be ordered (MUMPS {}, {})", m.infog(1), m.infog(2)));
  m.analysed = true;
  m.factorised = false;
  if (m.memory_limit <= 0) m.memory_limit = usable_share * free_memory();
}

double SymmetricFactor::memory_estimate() const { return impl_->analysed ? impl_->memory() : 0; }

void SymmetricFactor::set_memory_limit(double bytes) { impl_->memory_limit = bytes; }

FactorSummary SymmetricFactor::factorise(const Eigen::SparseMatrix<double>& A) {
  Impl& m = *impl_;
  HERSEY_REQUIRE(m.analysed, "analyse() comes first");
  HERSEY_REQUIRE(A.cols() == m.mumps.n && A.nonZeros() == m.stored, "the pattern is the one analysed");
  m.factorised = false;
  if (m.memory() > m.memory_limit)
    return {{FactorStatus::too_large,
             fmt::format("a factor of {} unknowns needs about {:.1f} GiB, and {:.1f} GiB are free", m.mumps.n,
                         m.memory() / (1024 * mebibyte), m.memory_limit / (1024 * mebibyte))}};
  m.take_values(A);
  for (const double value : m.values)
    if (!std::isfinite(value)) return no_answer<FactorSummary>("the matrix has entries that are not numbers");
  m.factorise_with_room();
  if (m.infog(1) < 0 && m.infog(1) != error_singular)
    return no_answer<FactorSummary>(
        fmt::format("the factorisation ended with MUMPS error {} ({})", m.infog(1), m.infog(2)));
  FactorSummary summary{{FactorStatus::factorised}, m.infog(12)};
  const int null_pivots = m.infog(28);
  for (int i = 0; i < null_pivots; ++i) summary.null_unknowns.push_back(m.mumps.pivnul_list[i] - 1);
  std::sort(summary.null_unknowns.begin(), summary.null_unknowns.end());
  if (null_pivots > 0 || m.infog(1) == error_singular) {
    summary.status = FactorStatus::singular;
    summary.message = fmt::format("the matrix is singular: {} of its {} pivots vanish", null_pivots, m.mumps.n);
  }
  m.factorised = summary.solved();
  return summary;
}

void SymmetricFactor::solve(Eigen::Ref<Eigen::MatrixXd> b) const {
  Impl& m = *impl_;
  HERSEY_REQUIRE(m.factorised, "no factorisation to solve with");
  HERSEY_REQUIRE(b.rows() == m.mumps.n, "one row per unknown");
  if (b.cols() == 0) return;
  m.mumps.rhs = b.data();
  m.mumps.nrhs = static_cast<int>(b.cols());
  m.mumps.lrhs = static_cast<int>(b.outerStride());
  m.icntl(27) = m.mumps.nrhs;  // all columns in one sweep over the factor
  m.call(job_solve);
  HERSEY_REQUIRE(m.infog(1) >= 0, fmt::format("the factor is sound (MUMPS {}, {})", m.infog(1), m.infog(2)));
}

int SymmetricFactor::size() const { return impl_->analysed ? impl_->mumps.n : 0; }
bool SymmetricFactor::factorised() const { return impl_->factorised; }

}  // namespace hersey::solver
