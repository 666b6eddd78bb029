#pragma once

#include <Eigen/Dense>
#include <string>

#include "hersey/film/film_model.h"

namespace hersey::bearing {

/// One of the two coordinates of a film's nodes, as results and tables name it.
struct FilmCoordinate {
  std::string name;        ///< "phi", "y", "z" or "r"
  std::string unit, text;  ///< SI; what it is
  Eigen::VectorXd values;  ///< of the lines or rows of the grid [unit]
};

/// Returns the coordinate of the lines: an angle around a bore or an annulus, on a plane the place along the sliding
/// direction.
[[nodiscard]] FilmCoordinate coordinate_along(const film::FilmModel& model);
/// Returns the coordinate of the rows: z along the axis or across the sliding direction, on an annulus the radius.
[[nodiscard]] FilmCoordinate coordinate_across(const film::FilmModel& model);

/// True of the film of a thrust bearing.
[[nodiscard]] inline bool is_on_annulus(const film::FilmModel& model) {
  return std::holds_alternative<film::Annulus>(model.surface);
}

}  // namespace hersey::bearing
