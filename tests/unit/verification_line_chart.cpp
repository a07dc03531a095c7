// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

#include "verification/line_chart.hpp"

namespace tunica::verification {
namespace {

struct Place {
  double x, y;
};

std::vector<Place> places(const std::string& text, const std::regex& pattern) {
  std::vector<Place> found;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it)
    found.push_back({std::stod((*it)[1]), std::stod((*it)[2])});
  return found;
}

std::vector<Place> circles(const std::string& text) {
  return places(text, std::regex("<circle cx=\"([-.\\d]+)\" cy=\"([-.\\d]+)\""));
}

/// Every element is closed by its own end, and text has no bare < or &.
void expect_well_formed(const std::string& text) {
  std::vector<std::string> open;
  std::size_t at = 0;
  while ((at = text.find('<', at)) != std::string::npos) {
    const std::size_t end = text.find('>', at);
    ASSERT_NE(end, std::string::npos);
    const std::string tag = text.substr(at + 1, end - at - 1);
    const std::string name = tag.substr(0, tag.find_first_of(" \n/"));
    if (tag.front() == '/') {
      ASSERT_FALSE(open.empty());
      EXPECT_EQ(open.back(), tag.substr(1));
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
    at = end;
  }
  EXPECT_TRUE(open.empty());
  EXPECT_TRUE(std::regex_search(text, std::regex("^<svg [^>]*xmlns=")));
  EXPECT_FALSE(std::regex_search(text, std::regex("&(?!amp;|lt;)")));
}

TEST(LineChart, IsWellFormedWithNamesOfAnyKind) {
  const LineChart chart{"a < b & c", "x", "y", {{"1 < 2", {0, 1}, {0, 1}}, {"R&D", {0, 1}, {1, 0}}}};
  const std::string text = svg({chart, chart, chart}, 2);
  expect_well_formed(text);
  EXPECT_NE(text.find("a &lt; b &amp; c"), std::string::npos);
  EXPECT_NE(text.find("R&amp;D"), std::string::npos);
}

TEST(LineChart, EquidistantValuesAreEquidistantAndUpIsUp) {
  const LineChart chart{"", "", "", {{"", {0, 1, 2}, {-1, 0, 1}, false, true}}};
  const auto found = circles(svg({chart}, 1));
  ASSERT_EQ(found.size(), 3U);
  // Places are printed to a tenth of a pixel.
  EXPECT_NEAR(found[1].x - found[0].x, found[2].x - found[1].x, 0.11);
  EXPECT_NEAR(found[1].y - found[0].y, found[2].y - found[1].y, 0.11);
  EXPECT_GT(found[1].x, found[0].x);
  EXPECT_LT(found[1].y, found[0].y);
}

TEST(LineChart, DecadesAreEquidistantOnALogarithmicAxis) {
  LineChart chart{"", "", "", {{"", {1e-5, 1e-4, 1e-3}, {0, 1, 2}, false, true}}, true};
  const auto found = circles(svg({chart}, 1));
  ASSERT_EQ(found.size(), 3U);
  EXPECT_NEAR(found[1].x - found[0].x, found[2].x - found[1].x, 0.11);
  chart.series[0].x[0] = 0;
  EXPECT_THROW(svg({chart}, 1), std::logic_error);
}

TEST(LineChart, PointsLieBetweenTheTicksAroundThem) {
  // 0.25 and 0.75 of the way between the grid's lines at 2 and 4, and at 10 and 20.
  const LineChart chart{"", "", "", {{"", {0, 2.5, 10}, {0, 17.5, 50}, false, true}}};
  const std::string text = svg({chart}, 1);
  const auto tick = [&](const std::string& axis, const std::string& label) {
    std::smatch match;
    const std::regex pattern(axis == "x" ? "<path d=\"M([-.\\d]+),[^>]*><text[^>]*>" + label + "</text>"
                                         : "<path d=\"M64,([-.\\d]+)H[^>]*><text[^>]*>" + label + "</text>");
    EXPECT_TRUE(std::regex_search(text, match, pattern)) << axis << " = " << label;
    return match.empty() ? NAN : std::stod(match[1]);
  };
  const Place middle = circles(text).at(1);
  EXPECT_NEAR(middle.x, std::lerp(tick("x", "2"), tick("x", "4"), 0.25), 0.11);
  EXPECT_NEAR(middle.y, std::lerp(tick("y", "10"), tick("y", "20"), 0.75), 0.11);
}

TEST(LineChart, TakesAGivenRange) {
  LineChart chart{"", "", "", {{"", {0, 1}, {0.4, 0.6}, false, true}}};
  chart.y_range = {0, 1};
  const auto found = circles(svg({chart}, 1));
  LineChart whole{"", "", "", {{"", {0, 1}, {0, 1}, false, true}}};
  whole.y_range = {0, 1};
  const auto ends = circles(svg({whole}, 1));
  EXPECT_NEAR(found[0].y, std::lerp(ends[0].y, ends[1].y, 0.4), 0.11);
  EXPECT_NEAR(found[1].y, std::lerp(ends[0].y, ends[1].y, 0.6), 0.11);
}

TEST(LineChart, LegendLeavesThePointsAlone) {
  // The lines fill the upper right corner, where the legend is otherwise.
  const std::vector<double> x{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  const std::vector<double> y{0, 0, 0, 0, 0, 9, 9, 9, 9, 9, 10};
  const LineChart chart{"", "", "", {{"first", x, y}, {"second", x, y}}};
  const std::string text = svg({chart}, 1);
  const auto legend = places(text, std::regex("<text x=\"([-.\\d]+)\" y=\"([-.\\d]+)\">first"));
  ASSERT_EQ(legend.size(), 1U);
  EXPECT_FALSE(legend[0].x > 300 && legend[0].y < 200) << legend[0].x << ", " << legend[0].y;
}

TEST(LineChart, RefusesNothing) {
  EXPECT_THROW(svg({LineChart{}}, 1), std::logic_error);
}

}  // namespace
}  // namespace tunica::verification
