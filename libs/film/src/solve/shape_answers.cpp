#include "solve/shape_answers.h"

#include <algorithm>
#include <functional>

#include "hersey/core/packed.h"
#include "hersey/core/task_pool.h"
#include "hersey/solver/subtract_product.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

namespace hersey::film {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// What the gap and its rate at the nodes do to outputs, and what the coefficients of functions and their rates do.
struct Sums {
  const double *by_gap, *by_rate;
  double *by_coefficient, *by_coefficient_rate;
};

HERSEY_KERNEL void sum_up(const SurfaceShapes::Functions& functions, const Sums& of) {
  for (Index i = 0; i < functions.outerSize(); ++i) {
    const Packed by_gap = Packed::load(of.by_gap + i * Packed::width);
    const Packed by_rate = Packed::load(of.by_rate + i * Packed::width);
    for (SurfaceShapes::Functions::InnerIterator entry(functions, i); entry; ++entry) {
      double* const sum = of.by_coefficient + entry.col() * Packed::width;
      double* const rate_sum = of.by_coefficient_rate + entry.col() * Packed::width;
      (Packed::load(sum) + entry.value() * by_gap).store(sum);
      (Packed::load(rate_sum) + entry.value() * by_rate).store(rate_sum);
    }
  }
}

HERSEY_FUSED void sum_up_fused(const SurfaceShapes::Functions& functions, const Sums& of) { sum_up(functions, of); }

/// Adds functions^T of both fields to both sums.
void add_of_functions(const SurfaceShapes::Functions& functions, const Sums& of) {
  has_fused_instructions() ? sum_up_fused(functions, of) : sum_up(functions, of);
}

}  // namespace

// Calls act(from, to, work) for parts of 0 to count - 1, which depend on count alone, so that the number of threads
// changes no bit.
template <class Act>
void ShapeAnswers::in_tasks(Index count, const Act& act) {
  constexpr Index of_task = 8 * Packed::width;
  const Index tasks = (count + of_task - 1) / of_task;
  if (static_cast<Index>(works_.size()) < tasks) works_.resize(static_cast<std::size_t>(tasks));
  const auto task = [&](std::size_t k) {
    const Index from = static_cast<Index>(k) * of_task;
    act(from, std::min(from + of_task, count), works_[k]);
  };
  TaskPool::shared().run(static_cast<std::size_t>(tasks), std::cref(task));
}

void ShapeAnswers::add(const SurfaceShapes& shapes, const Eigen::Ref<const MatrixXd>& adjoint, const FilmWrench& wrench,
                       CondensedFilm& film, Index first) {
  if (shapes.amplitudes() == 0) return;
  balance_.find_gap_operator(operator_);
  wrench.find_by_gap(wrench_by_gap_);
  push_by_gap_ = wrench.normal().by_g;
  const Index packs = (adjoint.cols() + Packed::width - 1) / Packed::width;
  of_surfaces_.resize(shapes.surfaces.size());
  for (std::size_t k = 0; k < of_surfaces_.size(); ++k)
    for (Rows* rows : {&of_surfaces_[k].coefficients, &of_surfaces_[k].rates})
      rows->resize(shapes.surfaces[k].opening.cols(), packs * Packed::width);
  in_tasks(width(), [&](Index from, Index to, Work& work) {
    for (Index output = from; output < to; output += Packed::width) {
      find_by_nodes(shapes, adjoint, output, work);
      for (std::size_t k = 0; k < of_surfaces_.size(); ++k)
        find_by_functions(shapes.surfaces[k], wrench, output, work, of_surfaces_[k]);
    }
  });
  Index column = first;
  for (std::size_t k = 0; k < of_surfaces_.size(); ++k) {
    const MatrixXd& functions = shapes.surfaces[k].functions;
    in_tasks(functions.cols(), [&](Index from, Index to, Work& work) {
      const auto part = functions.middleCols(from, to - from);
      add_columns(of_surfaces_[k].coefficients, part, column + from, work, film);
      add_columns(of_surfaces_[k].rates, part, column + shapes.amplitudes() + from, work, film);
    });
    column += functions.cols();
  }
}

// Of as many outputs as are packed. To what the film's answer does there is added what the gap does by itself, at fixed
// u; asperities push on shapes at the few nodes where they touch.
void ShapeAnswers::find_by_nodes(const SurfaceShapes& shapes, const Eigen::Ref<const MatrixXd>& adjoint, Index output,
                                 Work& work) const {
  const Index outputs = std::min<Index>(Packed::width, adjoint.cols() - output);
  work.adjoint.setZero(adjoint.rows(), Packed::width);
  work.adjoint.leftCols(outputs) = adjoint.middleCols(output, outputs);
  operator_.apply_transposed(work.adjoint, work.by_gap, work.by_rate, work.scratch);
  for (Index k = 0; k < outputs; ++k) {
    if (output + k < 6) {
      work.by_gap.col(k) -= wrench_by_gap_.row(output + k).transpose();
      continue;
    }
    for (Index i = 0; i < push_by_gap_.size(); ++i)
      if (push_by_gap_[i] != 0) work.by_gap(i, k) -= push_by_gap_[i] * shapes.openings(i, output + k - 6);
  }
}

void ShapeAnswers::find_by_functions(const SurfaceShapes::Surface& surface, const FilmWrench& wrench, Index output,
                                     Work& work, OfFunctions& of) const {
  const Index of_wrench = surface.is_shell ? std::clamp<Index>(6 - output, 0, Packed::width) : 0;
  const auto open_shell = [&](double sign) {
    for (Index k = 0; k < of_wrench; ++k)
      work.by_gap.col(k) -= sign * wrench.by_shell_opening().row(output + k).transpose();
  };
  PackedColumns &by_coefficient = work.of_coefficients, &by_rate = work.of_rates;
  for (PackedColumns* sums : {&by_coefficient, &by_rate}) sums->setZero(surface.opening.cols(), Packed::width);
  open_shell(1);
  add_of_functions(surface.opening, {work.by_gap.data(), work.by_rate.data(), by_coefficient.data(), by_rate.data()});
  open_shell(-1);
  of.rates.middleCols<Packed::width>(output) = by_rate;
  if (surface.rate.size() != 0)
    add_of_functions(surface.rate, {work.by_rate.data(), work.by_rate.data(), by_coefficient.data(), by_rate.data()});
  of.coefficients.middleCols<Packed::width>(output) = by_coefficient;
}

void ShapeAnswers::add_columns(const Rows& of_functions, const Eigen::Ref<const MatrixXd>& functions, Index column,
                               Work& work, CondensedFilm& film) const {
  const Index outputs = of_functions.cols(), count = functions.cols();
  work.outputs.setZero(outputs, count);
  solver::subtract_product(static_cast<int>(count), static_cast<int>(outputs), static_cast<int>(functions.rows()),
                           {functions.data(), functions.outerStride(), 1}, of_functions.data(), outputs,
                           work.outputs.data(), outputs);
  film.wrench_by_s.middleCols(column, count) += work.outputs.topRows<6>();
  film.Q_by_s.middleCols(column, count) += work.outputs.middleRows(6, film.Q_by_s.rows());
}

void ShapeAnswers::subtract_residual(const SurfaceShapes& shapes, const Eigen::Ref<const VectorXd>& amplitudes,
                                     const Eigen::Ref<const VectorXd>& rates, VectorXd& rhs) {
  if (shapes.amplitudes() == 0) return;
  gap_.setZero(rhs.size()), gap_rate_.setZero(rhs.size());
  Index first = 0;
  for (const SurfaceShapes::Surface& surface : shapes.surfaces) {
    const Index count = surface.functions.cols();
    coefficients_.noalias() = surface.functions * amplitudes.segment(first, count);
    gap_.noalias() += surface.opening * coefficients_;
    if (surface.rate.size() != 0) gap_rate_.noalias() += surface.rate * coefficients_;
    coefficients_.noalias() = surface.functions * rates.segment(first, count);
    gap_rate_.noalias() += surface.opening * coefficients_;
    first += count;
  }
  operator_.apply(gap_, gap_rate_, change_);
  rhs -= change_;
}

}  // namespace hersey::film

#pragma GCC diagnostic pop
