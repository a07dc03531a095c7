// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/line_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace tunica::verification {

namespace {

constexpr double width = 560, height = 420;  // of one chart
constexpr double left = 64, right = 16, top = 40, bottom = 52;
/// Told apart by those who do not see all colours (Wong, Nature Methods 8:441, 2011).
constexpr std::array<const char*, 7> colours{"#000000", "#0072b2", "#d55e00", "#009e73",
                                             "#cc79a7", "#e69f00", "#56b4e9"};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else
      out += c;
  }
  return out;
}

/// An interval of values and the places of an axis that it is drawn on.
struct Axis {
  double least, greatest;  ///< of the values, of their logarithm on a logarithmic axis
  double from, to;         ///< pixels
  bool logarithmic = false;

  double at(double value) const {
    const double v = logarithmic ? std::log10(value) : value;
    return from + (v - least) / (greatest - least) * (to - from);
  }

  std::vector<double> ticks() const {
    std::vector<double> values;
    if (logarithmic) {
      for (double decade = std::floor(least); decade <= greatest; ++decade)
        for (const double digit : {1.0, 2.0, 5.0}) {
          const double value = digit * std::pow(10.0, decade);
          if (std::log10(value) >= least && std::log10(value) <= greatest) values.push_back(value);
        }
      return values;
    }
    const double rough = (greatest - least) / 6, decade = std::pow(10.0, std::floor(std::log10(rough)));
    const double digit = rough / decade;
    const double step = decade * (digit <= 1 ? 1 : digit <= 2 ? 2 : digit <= 5 ? 5 : 10);
    for (double k = std::ceil(least / step); k * step <= greatest * (1 + 1e-12); ++k)
      values.push_back(k == 0 ? 0 : k * step);
    return values;
  }
};

Axis axis_of(const std::vector<Series>& series, std::vector<double> Series::*values, bool logarithmic,
             double from, double to) {
  double least = INFINITY, greatest = -INFINITY;
  for (const Series& s : series)
    for (const double value : s.*values) {
      if (logarithmic && !(value > 0)) throw std::logic_error("svg: a value <= 0 on a logarithmic axis");
      const double v = logarithmic ? std::log10(value) : value;
      least = std::min(least, v);
      greatest = std::max(greatest, v);
    }
  if (!(least <= greatest)) throw std::logic_error("svg: a chart without points");
  const double margin = greatest > least ? 0.04 * (greatest - least) : 1;
  return {least - margin, greatest + margin, from, to, logarithmic};
}

constexpr double row_height = 17;

/// Of the longest name; a letter takes 7 pixels in the mean.
double legend_width(const LineChart& chart) {
  std::size_t longest = 0;
  for (const Series& series : chart.series) longest = std::max(longest, series.name.size());
  return 40 + 7.0 * static_cast<double>(longest);
}

/// Upper left corner of the legend where the fewest points of the lines are.
std::array<double, 2> legend_place(const LineChart& chart, const Axis& x, const Axis& y) {
  const double rows = row_height * static_cast<double>(chart.series.size()) + 8;
  const double needed = legend_width(chart);
  const auto points_within = [&](double column, double row) {
    int within = 0;
    for (const Series& s : chart.series)
      for (std::size_t i = 0; i < s.x.size(); ++i) {
        const std::size_t before = i == 0 ? 0 : i - 1;
        constexpr int parts = 8;  // of the line from point to point
        for (int k = 1; k <= parts; ++k) {
          const double share = static_cast<double>(k) / parts;
          const double px = std::lerp(x.at(s.x[before]), x.at(s.x[i]), share);
          const double py = std::lerp(y.at(s.y[before]), y.at(s.y[i]), share);
          if (px > column && px < column + needed && py > row && py < row + rows) ++within;
        }
      }
    return within;
  };
  const double columns[] = {width - right - needed, left + 8}, heights[] = {top, height - bottom - rows};
  std::array<double, 2> best{columns[0], heights[0]};
  int least = points_within(best[0], best[1]);
  for (const double row : heights)
    for (const double column : columns) {
      const int within = points_within(column, row);
      if (within < least) {
        least = within;
        best = {column, row};
      }
    }
  return best;
}

std::string drawn(const LineChart& chart) {
  const Axis x = axis_of(chart.series, &Series::x, chart.log_x, left, width - right);
  Axis y = axis_of(chart.series, &Series::y, chart.log_y, height - bottom, top);
  if (chart.y_range) {
    y.least = chart.log_y ? std::log10(chart.y_range->front()) : chart.y_range->front();
    y.greatest = chart.log_y ? std::log10(chart.y_range->back()) : chart.y_range->back();
  }
  std::string out =
      fmt::format("<text x=\"{}\" y=\"22\" font-size=\"15\">{}</text>\n", left, escaped(chart.title));
  for (const double tick : x.ticks())
    out += fmt::format(
        "<path d=\"M{0:.1f},{1}V{2}\" stroke=\"#ddd\"/><text x=\"{0:.1f}\" y=\"{3}\" "
        "text-anchor=\"middle\">{4:g}</text>\n",
        x.at(tick), top, height - bottom, height - bottom + 17, tick);
  for (const double tick : y.ticks())
    out += fmt::format(
        "<path d=\"M{0},{1:.1f}H{2}\" stroke=\"#ddd\"/><text x=\"{3}\" y=\"{4:.1f}\" "
        "text-anchor=\"end\">{5:g}</text>\n",
        left, y.at(tick), width - right, left - 6, y.at(tick) + 4, tick);
  out += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n",
                     0.5 * (left + width - right), height - 14, escaped(chart.x_label));
  out += fmt::format("<text transform=\"translate(16,{}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                     0.5 * (top + height - bottom), escaped(chart.y_label));
  const auto [column, first_row] = legend_place(chart, x, y);
  for (std::size_t k = 0; k < chart.series.size(); ++k) {
    const Series& series = chart.series[k];
    const char* const colour = colours[k % colours.size()];
    if (series.line) {
      out += fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"1.4\" points=\"", colour);
      for (std::size_t i = 0; i < series.x.size(); ++i)
        out += fmt::format("{:.1f},{:.1f} ", x.at(series.x[i]), y.at(series.y[i]));
      out += "\"/>\n";
    }
    if (series.marks)
      for (std::size_t i = 0; i < series.x.size(); ++i)
        out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.6\" fill=\"{}\"/>\n", x.at(series.x[i]),
                           y.at(series.y[i]), colour);
    if (chart.series.size() == 1) continue;
    const double row = first_row + 16 + row_height * static_cast<double>(k);
    if (series.line)
      out += fmt::format("<path d=\"M{},{}h22\" stroke=\"{}\" stroke-width=\"1.4\"/>\n", column, row - 4,
                         colour);
    if (series.marks)
      out +=
          fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"2.6\" fill=\"{}\"/>\n", column + 11, row - 4, colour);
    out += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", column + 28, row, escaped(series.name));
  }
  return out;
}

}  // namespace

std::string svg(const std::vector<LineChart>& charts, int columns) {
  const int count = static_cast<int>(charts.size()), rows = (count + columns - 1) / columns;
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" font-family=\"sans-serif\" "
      "font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      width * std::min(count, columns), height * rows);
  for (int k = 0; k < count; ++k)
    out += fmt::format("<g transform=\"translate({},{})\">\n{}</g>\n", width * (k % columns),
                       height * (k / columns), drawn(charts[static_cast<std::size_t>(k)]));
  return out + "</svg>\n";
}

}  // namespace tunica::verification
