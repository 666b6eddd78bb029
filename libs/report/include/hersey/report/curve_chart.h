#pragma once

#include <string>
#include <vector>

namespace hersey::report {

/// One line of a chart.
struct CurveLine {
  std::string label;
  std::vector<double> x, y;
};

/// Values over one variable.
struct CurveChart {
  std::string title, note;
  std::string x_name, x_unit, y_name, y_unit;
  bool x_is_logarithmic = false, y_is_logarithmic = true;
  std::vector<CurveLine> lines;
};

}  // namespace hersey::report
