#include "solve/shape_answers.h"

#include <algorithm>

#include "hersey/core/packed.h"
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

void ShapeAnswers::add(const SurfaceShapes& shapes, const Eigen::Ref<const MatrixXd>& adjoint, const FilmWrench& wrench,
                       CondensedFilm& film, Index first) {
  if (shapes.amplitudes() == 0) return;
  balance_.find_gap_operator(operator_);
  wrench.find_by_gap(wrench_by_gap_);
  push_by_gap_ = wrench.normal().by_g;
  const Index width = (adjoint.cols() + Packed::width - 1) / Packed::width * Packed::width;
  of_surfaces_.resize(shapes.surfaces.size());
  for (std::size_t k = 0; k < of_surfaces_.size(); ++k)
    for (Rows* rows : {&of_surfaces_[k].coefficients, &of_surfaces_[k].rates})
      rows->resize(shapes.surfaces[k].opening.cols(), width);
  for (Index output = 0; output < width; output += Packed::width) {
    find_by_nodes(shapes, adjoint, output);
    for (std::size_t k = 0; k < of_surfaces_.size(); ++k)
      find_by_functions(shapes.surfaces[k], wrench, output, of_surfaces_[k]);
  }
  Index column = first;
  for (std::size_t k = 0; k < of_surfaces_.size(); ++k) {
    const SurfaceShapes::Surface& surface = shapes.surfaces[k];
    const Index count = surface.functions.cols();
    add_columns(of_surfaces_[k].coefficients, surface.functions, film, column);
    add_columns(of_surfaces_[k].rates, surface.functions, film, column + shapes.amplitudes());
    column += count;
  }
}

// Of as many outputs as are packed. To what the film's answer does there is added what the gap does by itself, at fixed
// u; asperities push on shapes at the few nodes where they touch.
void ShapeAnswers::find_by_nodes(const SurfaceShapes& shapes, const Eigen::Ref<const MatrixXd>& adjoint, Index output) {
  const Index outputs = std::min<Index>(Packed::width, adjoint.cols() - output);
  adjoint_.setZero(adjoint.rows(), Packed::width);
  adjoint_.leftCols(outputs) = adjoint.middleCols(output, outputs);
  operator_.apply_transposed(adjoint_, by_gap_, by_rate_);
  for (Index k = 0; k < outputs; ++k) {
    if (output + k < 6) {
      by_gap_.col(k) -= wrench_by_gap_.row(output + k).transpose();
      continue;
    }
    for (Index i = 0; i < push_by_gap_.size(); ++i)
      if (push_by_gap_[i] != 0) by_gap_(i, k) -= push_by_gap_[i] * shapes.openings(i, output + k - 6);
  }
}

void ShapeAnswers::find_by_functions(const SurfaceShapes::Surface& surface, const FilmWrench& wrench, Index output,
                                     OfFunctions& of) {
  const Index of_wrench = surface.is_shell ? std::clamp<Index>(6 - output, 0, Packed::width) : 0;
  const auto open_shell = [&](double sign) {
    for (Index k = 0; k < of_wrench; ++k)
      by_gap_.col(k) -= sign * wrench.by_shell_opening().row(output + k).transpose();
  };
  for (PackedColumns* sums : {&of_coefficients_, &of_rates_}) sums->setZero(surface.opening.cols(), Packed::width);
  open_shell(1);
  add_of_functions(surface.opening, {by_gap_.data(), by_rate_.data(), of_coefficients_.data(), of_rates_.data()});
  open_shell(-1);
  of.rates.middleCols<Packed::width>(output) = of_rates_;
  if (surface.rate.size() != 0)
    add_of_functions(surface.rate, {by_rate_.data(), by_rate_.data(), of_coefficients_.data(), of_rates_.data()});
  of.coefficients.middleCols<Packed::width>(output) = of_coefficients_;
}

void ShapeAnswers::add_columns(const Rows& of_functions, const MatrixXd& functions, CondensedFilm& film, Index column) {
  const Index width = of_functions.cols(), count = functions.cols();
  outputs_.setZero(width, count);
  solver::subtract_product(static_cast<int>(count), static_cast<int>(width), static_cast<int>(functions.rows()),
                           {functions.data(), functions.rows(), 1}, of_functions.data(), width, outputs_.data(), width);
  film.wrench_by_s.middleCols(column, count) += outputs_.topRows<6>();
  film.Q_by_s.middleCols(column, count) += outputs_.middleRows(6, film.Q_by_s.rows());
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
