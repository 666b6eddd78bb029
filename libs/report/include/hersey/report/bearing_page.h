#pragma once

#include <Eigen/Dense>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "hersey/core/outcome.h"

namespace hersey::report {

/// One number of a solution in the unit people use.
struct PageFigure {
  std::string key, group, name, unit;
  double value = 0;
  double grid_error = -1;  ///< negative: none estimated
  std::string words = {};  ///< text in place of a value that is not a number; else empty
};

/// A hole or groove where it lies over the film.
struct PageFeature {
  std::string name;
  bool is_round = false;                       ///< an ellipse, else a rectangle
  double phi = 0, z = 0, arc = 0, length = 0;  ///< middle and whole extent [rad, m]
};

/// A field of the film at the nodes.
struct PageField {
  std::string name, unit;  ///< as in a results file: "pressure", SI
  std::string text;        ///< description
  Eigen::VectorXd values;  ///< at the nodes, index i z.size() + j
};

/// One film with its nodes.
struct PageFilm {
  std::string name;                         ///< "inner"; empty: the only film of its bearing
  std::string along = "phi", across = "z";  ///< names of the nodes' coordinates: "y" of a slider, "r" of a thrust
  Eigen::VectorXd phi, z;                   ///< positions of the nodes along and across [rad, m]; "y": [m, m]
  std::vector<double> arcs;                 ///< number of the arc on which each node of phi lies; empty: a whole bore
  std::vector<PageField> fields;
  std::vector<PageFeature> features;
  double clearance = 0;                         ///< radial [m]
  Eigen::Vector2d e = Eigen::Vector2d::Zero();  ///< position of the surface inside over that around it [m]
};

/// One operating point of a single bearing. Unsolved, it has a label, values and the reason why there is no solution.
struct [[nodiscard]] PageSolution : Outcome {
  std::string label;  ///< label that distinguishes it from the others; empty if it is the only one
  std::vector<std::pair<std::string, std::string>> values;  ///< of the swept parameters, as written
  std::string remark;                                       ///< about its stability and the like
  std::vector<PageFigure> figures;
  Eigen::Vector2d load = Eigen::Vector2d::Zero();  ///< on the journal [N]
  bool has_axis = true;                            ///< a journal: with clearance, position and load as vectors
  std::vector<PageFilm> films;                     ///< one, or those of a floating ring: the inner first
};

/// Contents of the report of a single bearing.
struct BearingPage {
  std::string title, description, file, bearing, created, version;
  std::vector<std::pair<std::string, std::string>> conditions;  ///< name and text, such as the cavitation condition
  std::vector<PageSolution> solutions;                          ///< one, or those of a sweep in its order
};

/// One solution as JSON, as the page reads it (SolutionText of web/src/data.ts).
/// @param bearing  its name, of which the paths of its fields are made
[[nodiscard]] std::string solution_json(const PageSolution& solution, const std::string& bearing);

/// Writes one HTML file that shows the page: no network, no other file, any browser.
/// @throws results::WriteError if `out` cannot be written.
/// @pre there is at least one solution.
/// @verified_by bearing_page_test.cpp, tests/report_browser
void write_html(const BearingPage& page, const std::filesystem::path& out);

}  // namespace hersey::report
