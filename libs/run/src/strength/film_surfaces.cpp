#include "hersey/run/film_surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hersey/core/input_error.h"
#include "hersey/core/spelling.h"
#include "strength/stored_motion.h"

namespace hersey::run {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;

constexpr std::uint8_t vtk_quadrilateral = 9;
constexpr double gap_of_rows = 0.25;  // between films that are rolled out, as a part of the lower one's width

/// Names of bearings whose films are stored.
std::vector<std::string> bearings_with_fields(const results::Reader& results) {
  std::vector<std::string> names;
  for (const std::string& name : results.children("/bearings"))
    if (results.has("/bearings/" + name + "/fields/pressure")) names.push_back(name);
  return names;
}

/// Coordinates of a film's nodes and what they mean.
struct FilmNodes {
  std::vector<double> along, across;
  bool is_plane = false, is_annulus = false;
  bool is_closed = false;  ///< goes all around
  double radius = 0;       ///< of the bore, or mean radius of an annulus [m]

  /// Position in the bearing's axes: x, y, z of a bore; a plane's film lies in y and z, an annulus' in x and y.
  [[nodiscard]] Vector3 at(double s, double t) const {
    if (is_plane) return {0, s, t};
    const double r = is_annulus ? t : radius;
    return {r * std::cos(s), r * std::sin(s), is_annulus ? 0 : t};
  }
  [[nodiscard]] Vector3 rolled_out(double s, double t) const { return {is_plane ? s : radius * s, t, 0}; }
};

FilmNodes nodes_of(const results::Reader& results, const std::string& group) {
  FilmNodes nodes;
  nodes.is_plane = results.has(group + "fields/y");
  nodes.is_annulus = results.has(group + "fields/r");
  nodes.along = results.read(group + (nodes.is_plane ? "fields/y" : "fields/phi")).values;
  nodes.across = results.read(group + (nodes.is_annulus ? "fields/r" : "fields/z")).values;
  nodes.is_closed = !nodes.is_plane && !results.has(group + "fields/arc");
  nodes.radius = results.number_attribute(group, nodes.is_annulus ? "mean_radius" : "radius").value_or(0);
  return nodes;
}

/// True for each line of nodes that cells join to the next one; arcs and pads are apart.
std::vector<bool> joined_lines(const results::Reader& results, const std::string& group, const FilmNodes& nodes) {
  std::vector<bool> joined(nodes.along.size(), true);
  joined.back() = nodes.is_closed;
  if (!results.has(group + "fields/arc")) return joined;
  const std::vector<double> arc = results.read(group + "fields/arc").values;
  for (std::size_t i = 0; i + 1 < arc.size(); ++i) joined[i] = arc[i] == arc[i + 1];
  return joined;
}

Pose frame_of(const results::Reader& results, const std::string& group) {
  if (!results.has(group + "x_axis") || !results.has(group + "axis") || !results.has(group + "inboard_origin"))
    throw results::ReadError(results.path(), "it does not say where " + group + " lies; an earlier version wrote it");
  const auto read = [&](const char* name) -> Vector3 {
    const std::vector<double> values = results.read(group + name).values;
    return {values.at(0), values.at(1), values.at(2)};
  };
  Pose X;
  X.r = read("inboard_origin");
  X.R.col(0) = read("x_axis");
  X.R.col(2) = read("axis");
  X.R.col(1) = X.R.col(2).cross(X.R.col(0));
  return X;
}

}  // namespace

FilmSurfaces::FilmSurfaces(const results::Reader& results, const std::vector<std::string>& bearings,
                           FilmPlacement placement)
    : results_(results), placement_(placement) {
  const std::vector<std::string> known = bearings_with_fields(results);
  if (known.empty())
    throw results::ReadError(results.path(),
                             "it has no stored film: a run with bearings and `output.fields_every` has");
  for (const std::string& name : bearings)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(Fault{{"", 0, 0},
                             "--bearing",
                             fmt::format("no film of a bearing '{}' is stored", name),
                             one_of(known),
                             did_you_mean(name, known)});
  for (const std::string& name : bearings.empty() ? known : bearings) add(name);
  const std::vector<double> instants = results.read("/time").values;
  if (times_.empty() || instants.empty()) throw results::ReadError(results.path(), "it has no stored film yet");
  for (const double time : times_) rows_.push_back(row_at(instants, time));
  if (results.has("/crank_angle")) {
    const std::vector<double> angles = results.read("/crank_angle").values;
    for (const std::size_t row : rows_) crank_angles_.push_back(angles.at(row));
  }
  cells_.points = points(0);
}

void FilmSurfaces::add(const std::string& name) {
  const std::string group = "/bearings/" + name + "/";
  const FilmNodes nodes = nodes_of(results_, group);
  const bool is_rolled_out = placement_ == FilmPlacement::unwrapped;
  const auto across = static_cast<int>(nodes.across.size());
  auto around = static_cast<int>(nodes.along.size());
  std::vector<bool> joined = joined_lines(results_, group, nodes);
  Film film{.name = name,
            .group = group,
            .body = results_.text_attribute(group, "inboard").value_or(""),
            .X_BF = {},
            .points = {},
            .node = {},
            .first = films_.empty() ? 0 : films_.back().first + films_.back().points.cols()};
  if (placement_ == FilmPlacement::machine) film.X_BF = frame_of(results_, group);
  std::vector<double> along = nodes.along;
  if (is_rolled_out && nodes.is_closed) {  // the end of what is rolled out repeats its beginning
    along.push_back(along.front() + 2 * std::numbers::pi);
    joined.push_back(false);
    ++around;
  }
  film.points.resize(3, Index{around} * across);
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < across; ++k) {
      const double s = along[static_cast<std::size_t>(i)], t = nodes.across[static_cast<std::size_t>(k)];
      film.points.col(Index{i} * across + k) = is_rolled_out ? nodes.rolled_out(s, t) : nodes.at(s, t);
      film.node.push_back(i % static_cast<int>(nodes.along.size()) * across + k);
    }
  if (is_rolled_out) {
    const double width = nodes.across.back() - nodes.across.front();
    film.points.row(1).array() += height_ - nodes.across.front();
    height_ += (1 + gap_of_rows) * width;
  }
  const std::size_t cells_before = cells_.types.size();
  add_cells(film, around, across, joined);
  film.cells = static_cast<Index>(cells_.types.size() - cells_before);
  const std::vector<double> times = results_.read(group + "fields/time").values;
  if (films_.empty() || times.size() < times_.size()) times_ = times;  // a killed run may have stored one film more
  for (const std::string& field : results_.children(group + "fields")) {
    const results::DatasetInfo info = results_.info(group + "fields/" + field);
    const std::pair entry(field, info.unit);
    if (info.shape.size() == 3 && std::find(fields_.begin(), fields_.end(), entry) == fields_.end())
      fields_.push_back(entry);
  }
  films_.push_back(std::move(film));
}

void FilmSurfaces::add_cells(const Film& film, int around, int across, const std::vector<bool>& joined) {
  for (int i = 0; i < around; ++i) {
    if (!joined[static_cast<std::size_t>(i)]) continue;
    const Index here = film.first + Index{i} * across, next = film.first + Index{(i + 1) % around} * across;
    for (Index k = 0; k + 1 < across; ++k) {
      for (const Index point : {here + k, next + k, next + k + 1, here + k + 1})
        cells_.connectivity.push_back(static_cast<long long>(point));
      cells_.offsets.push_back(static_cast<long long>(cells_.connectivity.size()));
      cells_.types.push_back(vtk_quadrilateral);
    }
  }
}

std::vector<std::string> FilmSurfaces::bearings() const {
  std::vector<std::string> names;
  for (const Film& film : films_) names.push_back(film.name);
  return names;
}

Eigen::RowVectorXd FilmSurfaces::bearing_of_cells() const {
  Eigen::RowVectorXd numbers(static_cast<Index>(cells_.types.size()));
  Index first = 0;
  for (std::size_t b = 0; b < films_.size(); first += films_[b++].cells)
    numbers.segment(first, films_[b].cells).setConstant(static_cast<double>(b));
  return numbers;
}

Matrix3Xd FilmSurfaces::points(std::size_t instant) const {
  const Film& last = films_.back();
  Matrix3Xd all(3, last.first + last.points.cols());
  for (const Film& film : films_) {
    auto own = all.middleCols(film.first, film.points.cols());
    own = film.points;
    if (placement_ != FilmPlacement::machine) continue;
    const std::size_t row = rows_.at(instant);
    const Matrix3 R = orientation_at(results_, film.body, row);
    const Vector3 r = origin_at(results_, film.body, row) + R * film.X_BF.r;
    own = ((R * film.X_BF.R * film.points).colwise() + r).eval();
  }
  return all;
}

Eigen::RowVectorXd FilmSurfaces::field(std::size_t instant, const std::string& name) const {
  const Film& last = films_.back();
  Eigen::RowVectorXd values =
      Eigen::RowVectorXd::Constant(last.first + last.points.cols(), std::numeric_limits<double>::quiet_NaN());
  for (const Film& film : films_) {
    const std::string path = film.group + "fields/" + name;
    if (!results_.has(path)) continue;
    const std::vector<double> stored = results_.read_rows(path, instant, 1).values;
    for (std::size_t p = 0; p < film.node.size(); ++p)
      values[film.first + static_cast<Index>(p)] = stored.at(static_cast<std::size_t>(film.node[p]));
  }
  return values;
}

}  // namespace hersey::run
