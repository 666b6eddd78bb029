#pragma once

#include <Eigen/Dense>
#include <string>
#include <utility>
#include <vector>

#include "hersey/core/spatial.h"
#include "hersey/fem/vtkhdf_file.h"
#include "hersey/results/reader.h"

namespace hersey::run {

/// Where a film lies in space.
enum class FilmPlacement {
  machine,    ///< on its bearing, in ground's axes, moving with the body that carries the bearing
  bearing,    ///< on its bearing, in the bearing's own axes, at rest
  unwrapped,  ///< rolled out: x along the motion, y across it; one bearing above the other
};

/// Films of a finished run as surfaces over time, for programs that draw fields.
///
/// Nodes of the film's grid are points, quadrilaterals between them cells; a film that goes all around is closed.
/// Surfaces lie at the bearing's nominal radius, or in its plane: the film itself is a thousandth of it thick.
/// @verified_by films_test.py
class FilmSurfaces {
 public:
  /// @param results   outlive this
  /// @param bearings  names; empty: all that have stored films
  /// @throws InputError where there is no such bearing; ReadError where no film is stored
  FilmSurfaces(const results::Reader& results, const std::vector<std::string>& bearings, FilmPlacement placement);

  [[nodiscard]] const fem::VtkCells& cells() const { return cells_; }  ///< points as at the first instant
  /// Names of the bearings, in the order of their points and cells.
  [[nodiscard]] std::vector<std::string> bearings() const;
  /// Returns the number of the bearing of each cell, from 0.
  [[nodiscard]] Eigen::RowVectorXd bearing_of_cells() const;
  /// Name and unit of all fields that some film has.
  [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& fields() const { return fields_; }

  [[nodiscard]] const std::vector<double>& times() const { return times_; }  ///< [s], of the stored instants
  /// Crank angles of the same [rad]; empty: the model has no crank.
  [[nodiscard]] const std::vector<double>& crank_angles() const { return crank_angles_; }

  /// Returns the points at a stored instant [m].
  [[nodiscard]] Eigen::Matrix3Xd points(std::size_t instant) const;
  /// Returns a field at all points at a stored instant, in SI and degC; NaN on films that have none of that name.
  [[nodiscard]] Eigen::RowVectorXd field(std::size_t instant, const std::string& name) const;

 private:
  struct Film {
    std::string name, group, body;  ///< the body that carries the bearing
    Pose X_BF;                      ///< frame of the bearing on that body
    Eigen::Matrix3Xd points;        ///< in the bearing's axes, or rolled out
    std::vector<int> node;          ///< of the grid, at each point
    Eigen::Index first = 0;         ///< its first point among all
    Eigen::Index cells = 0;
  };

  void add(const std::string& name);
  void add_cells(const Film& film, int around, int across, const std::vector<bool>& joined);

  const results::Reader& results_;
  FilmPlacement placement_;
  std::vector<Film> films_;
  fem::VtkCells cells_;
  std::vector<std::pair<std::string, std::string>> fields_;
  std::vector<double> times_, crank_angles_;
  std::vector<std::size_t> rows_;  ///< of the instants among those of the series
  double height_ = 0;              ///< of the films rolled out so far [m]
};

}  // namespace hersey::run
