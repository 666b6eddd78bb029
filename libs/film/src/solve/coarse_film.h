#pragma once

#include <Eigen/Dense>

#include "hersey/film/film_model.h"

namespace hersey::film {

/// Fields on one grid from those on another of the same pattern of spacing, linearly between the nodes. Both are taken
/// as functions of the share of the way around the bearing and across it, counted in nodes: on the places of
/// resampled().
class GridTransfer {
 public:
  GridTransfer(const Grid& from, const Grid& to);
  [[nodiscard]] Eigen::VectorXd operator()(const Eigen::VectorXd& field) const;

 private:
  struct Between {
    int first = 0, second = 0;
    double share = 0;  ///< of the second
  };
  int n_z_;
  std::vector<Between> around_, along_;
};

/// A film on a grid of half as many nodes in each direction (theory manual, film.34).
struct CoarseFilm {
  FilmModel model;
  SurfaceMotion motion;
  FilmHistory history;
  Eigen::VectorXd u;
};

/// Whether a film is left with a shape on half the nodes.
[[nodiscard]] bool can_be_coarsened(const Grid& grid);

[[nodiscard]] CoarseFilm coarsened(const FilmModel& model, const SurfaceMotion& motion, const FilmHistory& history,
                                   const Eigen::VectorXd& u);

/// The unknowns of `model` from those of the coarse film: pressures and fill fractions are kept.
[[nodiscard]] Eigen::VectorXd refined(const CoarseFilm& coarse, const FilmModel& model);

}  // namespace hersey::film
