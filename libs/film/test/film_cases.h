#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "hersey/film/film_solver.h"
#include "hersey/film/observables.h"
#include "hersey/film/reynolds.h"

namespace hersey::film {

inline constexpr double pi = std::numbers::pi;

/// A round journal in a round bore, in the frame of the grid.
struct Journal {
  Eigen::Vector2d e = Eigen::Vector2d::Zero();       ///< centre at z = 0 [m]
  Eigen::Vector2d e_rate = Eigen::Vector2d::Zero();  ///< [m/s]
  Eigen::Vector2d tilt = Eigen::Vector2d::Zero();    ///< slope of the axis [-]
  double omega_shell = 0;                            ///< relative to the grid [rad/s]
  double omega_journal = 0;                          ///< relative to the grid [rad/s]
};

/// Gap c - (e + tilt z) . e_r of that journal, and its other motion. The supply line stays at phi_supply.
inline SurfaceMotion surfaces(const FilmModel& model, const Journal& journal, double phi_supply = 0) {
  SurfaceMotion motion;
  const Grid& grid = model.grid;
  motion.g.resize(grid.size());
  motion.g_rate.resize(grid.size());
  for (int i = 0; i < grid.n_phi; ++i) {
    const double phi = grid.phi(i);
    const Eigen::Vector2d e_r(std::cos(phi), std::sin(phi));
    for (int j = 0; j < grid.n_z; ++j) {
      const double z = model.L * grid.z_over_L(j);
      motion.g[grid.index(i, j)] = model.c - (journal.e + journal.tilt * z).dot(e_r);
      motion.g_rate[grid.index(i, j)] = -journal.e_rate.dot(e_r);
    }
  }
  motion.u_shell = journal.omega_shell * model.R;
  motion.u_journal = journal.omega_journal * model.R;
  motion.phi_supply = phi_supply;
  return motion;
}

/// Widest gap at phi = 0: the journal's centre lies at -epsilon c along x.
inline Journal turning(const FilmModel& model, double epsilon, double omega) {
  return {.e = {-epsilon * model.c, 0}, .omega_journal = omega};
}

struct SolvedFilm {
  FilmSolveSummary summary;
  Eigen::VectorXd u;
  Vector6 wrench;
  FilmFields fields;
  FilmObservables observed;
};

inline SolvedFilm solve_cold(const FilmModel& model, const SurfaceMotion& motion, const Eigen::Vector2d& e,
                             const FilmSolveOptions& options = {},
                             const Eigen::Vector2d& tilt = Eigen::Vector2d::Zero()) {
  Reynolds reynolds(model);
  SolvedFilm film;
  film.u = Eigen::VectorXd::Zero(model.grid.size());
  film.summary = solve_film(reynolds, motion, {}, options, film.u);
  film.wrench = reynolds.forces().wrench_on_shell;
  film.fields = film_fields(model, motion, film.u);
  film.observed = observe_film(model, motion, {}, e, film.u, tilt);
  return film;
}

inline SolvedFilm solve_cold(const FilmModel& model, const Journal& journal, const FilmSolveOptions& options = {}) {
  return solve_cold(model, surfaces(model, journal), journal.e, options, journal.tilt);
}

/// Calls respond() for one change of the surfaces.
inline void respond(Reynolds& reynolds, const MotionDirection& direction, Eigen::VectorXd& du,
                    Vector6& wrench_partial) {
  Eigen::MatrixXd column;
  Eigen::Matrix<double, 6, Eigen::Dynamic> partial;
  respond(reynolds, {&direction, 1}, column, partial);
  du = column;
  wrench_partial = partial;
}

/// A table with one header line; lines starting with # are comments. Cells are text.
using CsvRow = std::map<std::string, std::string>;

inline std::vector<CsvRow> read_csv(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot open " + path);
  const auto split = [](const std::string& line) {
    std::vector<std::string> cells;
    std::stringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    return cells;
  };
  std::vector<std::string> header;
  std::vector<CsvRow> rows;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line[0] == '#') continue;
    const auto cells = split(line);
    if (header.empty()) {
      header = cells;
      continue;
    }
    CsvRow row;
    for (std::size_t k = 0; k < cells.size(); ++k) row[header[k]] = cells[k];
    rows.push_back(row);
  }
  return rows;
}

inline double number(const CsvRow& row, const std::string& column) { return std::stod(row.at(column)); }

}  // namespace hersey::film
