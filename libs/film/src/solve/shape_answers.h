#pragma once

#include <Eigen/Dense>
#include <vector>

#include "balance/flow_balance.h"
#include "balance/gap_operator.h"
#include "hersey/film/film_response.h"
#include "hersey/film/surface_shapes.h"
#include "observe/film_wrench.h"

namespace hersey::film {

/// Outputs of a film, its wrench and the forces on the shapes, by the amplitudes of these and by their rates. With the
/// adjoint Lambda of the outputs they are -(dr/dg^T Lambda)^T O and the like (bearing.11): the openings O of a hundred
/// amplitudes are those of fewer functions, each of them near some nodes only, and the residual's derivative by each
/// amplitude is not needed.
class ShapeAnswers {
 public:
  explicit ShapeAnswers(const FlowBalance& balance) : balance_(balance), operator_(balance.gap_operator()) {}

  /// Adds them to the columns of the shapes, from `first` on, of the outputs of the film last evaluated.
  /// @param adjoint  columns of the wrench and of the forces on the shapes, shape (n, 6 + amplitudes)
  void add(const SurfaceShapes& shapes, const Eigen::Ref<const Eigen::MatrixXd>& adjoint, const FilmWrench& wrench,
           CondensedFilm& film, Eigen::Index first);

  /// Subtracts the change of the residual with changes of amplitudes and rates from `rhs`, at the state of add().
  void subtract_residual(const SurfaceShapes& shapes, const Eigen::Ref<const Eigen::VectorXd>& amplitudes,
                         const Eigen::Ref<const Eigen::VectorXd>& rates, Eigen::VectorXd& rhs);

 private:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// Negative outputs by the coefficients of a surface's functions and by their rates, a row each, whole packs.
  struct OfFunctions {
    Rows coefficients, rates;
  };
  /// What a task works in.
  struct Work {
    GapOperator::Scratch scratch;
    PackedColumns adjoint, by_gap, by_rate;  ///< negative outputs by gap and rate at each node
    PackedColumns of_coefficients, of_rates;
    Eigen::MatrixXd outputs;  ///< by each amplitude
  };
  /// Outputs that packs hold.
  [[nodiscard]] Eigen::Index width() const { return of_surfaces_.front().rates.cols(); }
  void find_by_nodes(const SurfaceShapes& shapes, const Eigen::Ref<const Eigen::MatrixXd>& adjoint, Eigen::Index output,
                     Work& work) const;
  void find_by_functions(const SurfaceShapes::Surface& surface, const FilmWrench& wrench, Eigen::Index output,
                         Work& work, OfFunctions& of) const;
  void add_columns(const Rows& of_functions, const Eigen::Ref<const Eigen::MatrixXd>& functions, Eigen::Index column,
                   Work& work, CondensedFilm& film) const;
  template <class Act>
  void in_tasks(Eigen::Index count, const Act& act);

  const FlowBalance& balance_;
  GapOperator operator_;
  Eigen::Matrix<double, 6, Eigen::Dynamic> wrench_by_gap_;
  Eigen::VectorXd push_by_gap_;  ///< of asperities, at each node [N/m]
  std::vector<OfFunctions> of_surfaces_;
  std::vector<Work> works_;  ///< of the tasks
  Eigen::VectorXd coefficients_, gap_, gap_rate_, change_;
};

}  // namespace hersey::film
