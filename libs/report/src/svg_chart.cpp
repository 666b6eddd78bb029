#include "svg_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hersey::report {
namespace {

// Of the whole drawing and of what lies around its axes, in its own units.
constexpr double width = 640, height = 380, left = 64, right = 118, top = 14, bottom = 46;
constexpr double line_height = 15;
constexpr int colours = 6;

/// An axis maps values to positions.
class Axis {
 public:
  Axis(bool is_logarithmic, double from, double to) : is_logarithmic_(is_logarithmic), from_(from), to_(to) {}

  void reach(double low, double high) {
    if (is_logarithmic_) low = std::log10(low), high = std::log10(high);
    if (high - low < 1e-12 * std::abs(high) + 1e-300) low -= 0.5, high += 0.5;  // one value alone: a unit of room
    low_ = low, high_ = high;
  }
  [[nodiscard]] double at(double value) const {
    const double v = is_logarithmic_ ? std::log10(value) : value;
    return from_ + (to_ - from_) * (v - low_) / (high_ - low_);
  }

  /// Values to write: of a logarithmic axis 1, and where there is room 2 and 5, of each decade.
  [[nodiscard]] std::vector<double> ticks() const {
    std::vector<double> ticks;
    if (!is_logarithmic_) {
      const double raw = (high_ - low_) / 6, decade = std::pow(10, std::floor(std::log10(raw)));
      const double share = raw / decade, step = decade * (share < 1.5 ? 1 : share < 3.5 ? 2 : share < 7.5 ? 5 : 10);
      for (double k = std::ceil(low_ / step - 1e-9); k * step <= high_ + 1e-9 * step; ++k) ticks.push_back(k * step);
      return ticks;
    }
    const bool is_wide = high_ - low_ > 3.5;
    for (double decade = std::floor(low_); decade <= high_; ++decade)
      for (const double digit : {1.0, 2.0, 5.0}) {
        const double value = digit * std::pow(10, decade), log = std::log10(value);
        if (log >= low_ - 1e-9 && log <= high_ + 1e-9 && (digit == 1 || !is_wide)) ticks.push_back(value);
      }
    return ticks;
  }

 private:
  bool is_logarithmic_;
  double from_, to_, low_ = 0, high_ = 1;
};

struct Reach {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void take(double value) { low = std::min(low, value), high = std::max(high, value); }
};

/// A tick as one writes it: 0.02, 5, 12000, 1.2 10^6.
std::string tick_text(double value) {
  if (std::abs(value) < 1e-300) return "0";  // of either sign
  const double decade = std::log10(std::abs(value));
  if (decade >= 5 || decade < -3) {
    const double power = std::floor(decade + 1e-9), digit = value / std::pow(10, power);
    const std::string ten = fmt::format("10<tspan dy=\"-5\" font-size=\"9\">{:.0f}</tspan>", power);
    return std::abs(digit - 1) < 1e-6 ? ten : fmt::format("{:.3g}·{}", digit, ten);  // round-off of the division
  }
  return fmt::format("{:.5g}", value);
}

/// Positions of labels beside the ends of lines, moved apart where they would overlap.
std::vector<double> label_positions(std::vector<double> wanted) {
  std::vector<std::size_t> order(wanted.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return wanted[a] < wanted[b]; });
  double next = top + 4;
  for (const std::size_t k : order) next = (wanted[k] = std::max(wanted[k], next)) + line_height;
  double room = height - bottom;
  std::reverse(order.begin(), order.end());
  for (const std::size_t k : order) room = (wanted[k] = std::min(wanted[k], room)) - line_height;
  return wanted;
}

std::string axes_of(const CurveChart& chart, const Axis& x, const Axis& y) {
  std::string svg;
  for (const double tick : y.ticks())
    svg += fmt::format(
        "<line class=\"grid\" x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\"/><text class=\"tick\" x=\"{3}\" "
        "y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>",
        left, width - right, y.at(tick), left - 8, y.at(tick) + 4, tick_text(tick));
  for (const double tick : x.ticks())
    svg += fmt::format(
        "<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/><text class=\"tick\" x=\"{0:.1f}\" "
        "y=\"{3}\" text-anchor=\"middle\">{4}</text>",
        x.at(tick), top, height - bottom, height - bottom + 17, tick_text(tick));
  svg += fmt::format("<rect class=\"frame\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>", left, top,
                     width - left - right, height - top - bottom);
  svg += fmt::format("<text class=\"axis\" x=\"{:.0f}\" y=\"{}\" text-anchor=\"middle\">{} [{}]</text>",
                     0.5 * (left + width - right), height - 8, escaped(chart.x_name), escaped(chart.x_unit));
  svg += fmt::format(
      "<text class=\"axis\" transform=\"translate(14 {:.0f}) rotate(-90)\" text-anchor=\"middle\">{} [{}]</text>",
      0.5 * (top + height - bottom), escaped(chart.y_name), escaped(chart.y_unit));
  return svg;
}

std::string line_of(const CurveChart& chart, const CurveLine& line, std::size_t colour, const Axis& x, const Axis& y) {
  const std::string& label = line.like ? chart.lines.at(*line.like).label : line.label;
  std::string path;
  for (std::size_t k = 0; k < line.x.size(); ++k)
    path += fmt::format("{}{:.1f} {:.1f}", k == 0 ? "M" : "L", x.at(line.x[k]), y.at(line.y[k]));
  std::string svg =
      fmt::format("<path class=\"line c{}{}\" d=\"{}\"/>", colour % colours, line.is_dashed ? " dashed" : "", path);
  // Tooltips show about ten points of a line.
  const std::size_t every = std::max<std::size_t>(1, line.x.size() / 10);
  for (std::size_t k = 0; k < line.x.size(); k += every)
    svg += fmt::format(
        "<circle class=\"dot c{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"7\"><title>{}\n{} {:.4g} {}\n{} {:.4g} "
        "{}</title></circle>",
        colour % colours, x.at(line.x[k]), y.at(line.y[k]), escaped(label), escaped(chart.x_name), line.x[k],
        escaped(chart.x_unit), escaped(chart.y_name), line.y[k], escaped(chart.y_unit));
  return svg;
}

std::string mark_of(const CurveMark& mark, const Axis& x, const Axis& y) {
  return fmt::format(
      "<rect class=\"mark\" x=\"-4\" y=\"-4\" width=\"8\" height=\"8\" transform=\"translate({0:.1f} {1:.1f}) "
      "rotate(45)\"><title>{2}</title></rect><text class=\"tick\" x=\"{0:.1f}\" y=\"{3:.1f}\" "
      "text-anchor=\"middle\">{2}</text>",
      x.at(mark.x), y.at(mark.y), escaped(mark.label), y.at(mark.y) - 9);
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '&')
      safe += "&amp;";
    else if (c == '"')
      safe += "&quot;";
    else
      safe += c;
  }
  return safe;
}

std::string svg_of(const CurveChart& chart) {
  Reach of_x, of_y;
  for (const CurveLine& line : chart.lines) {
    for (const double value : line.x) of_x.take(value);
    for (const double value : line.y) of_y.take(value);
  }
  Axis x(chart.x_is_logarithmic, left, width - right), y(chart.y_is_logarithmic, height - bottom, top);
  x.reach(of_x.low, of_x.high);
  const double room = 0.05 * (of_y.high - of_y.low);
  if (chart.y_is_logarithmic)
    y.reach(of_y.low / 1.15, of_y.high * 1.15);
  else
    y.reach(of_y.low - (of_y.low == 0 ? 0 : room), of_y.high + room);
  std::string svg =
      fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">", width, height, escaped(chart.title));
  svg += axes_of(chart, x, y);
  std::vector<double> ends;
  for (const CurveLine& line : chart.lines)
    if (!line.label.empty()) ends.push_back(y.at(line.y.back()) + 4);
  const std::vector<double> positions = label_positions(ends);
  std::size_t labels = 0;
  std::vector<std::size_t> own;  // colours of the lines
  for (std::size_t k = 0, next = 0; k < chart.lines.size(); ++k) {
    const CurveLine& line = chart.lines[k];
    own.push_back(line.like ? own.at(*line.like) : next++);
    const std::size_t colour = own.back();
    svg += line_of(chart, line, colour, x, y);
    if (line.label.empty()) continue;
    svg += fmt::format("<text class=\"label c{}\" x=\"{}\" y=\"{:.1f}\">{}</text>", colour % colours, width - right + 8,
                       positions[labels++], escaped(line.label));
  }
  for (const CurveMark& mark : chart.marks) svg += mark_of(mark, x, y);
  return svg + "</svg>";
}

}  // namespace hersey::report
