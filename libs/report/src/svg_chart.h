#pragma once

#include <string>

#include "hersey/report/curve_chart.h"

namespace hersey::report {

/// Text in HTML.
[[nodiscard]] std::string escaped(const std::string& text);

/// A chart as an SVG element; colours are those of the page's style.
[[nodiscard]] std::string svg_of(const CurveChart& chart);

}  // namespace hersey::report
