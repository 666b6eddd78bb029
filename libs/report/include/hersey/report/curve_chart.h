#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hersey::report {

/// One line of a chart.
struct CurveLine {
  std::string label;  ///< empty: none is written beside it
  std::vector<double> x, y;
  bool is_dashed = false;
  std::optional<std::size_t> like = {};  ///< the line of the chart whose colour it has
};

/// A point of a chart that has a name.
struct CurveMark {
  std::string label;
  double x = 0, y = 0;
};

/// Values over one variable.
struct CurveChart {
  std::string title, note;
  std::string x_name, x_unit, y_name, y_unit;
  bool x_is_logarithmic = false, y_is_logarithmic = true;
  std::vector<CurveLine> lines;
  std::vector<CurveMark> marks;
};

}  // namespace hersey::report
