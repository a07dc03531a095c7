// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/waveform_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "core/scene/message.hpp"
#include "core/scene/parameter.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/text.hpp"

namespace tunica::scene {

namespace {

/// A beat at a microsecond's resolution takes half of it.
constexpr std::size_t largest_waveform = 32'000'000;
constexpr std::size_t fewest_points = 4;
constexpr double widest_interval = 10;  // times the median
constexpr double closing_error = 1e-3;  // of the range
constexpr const char* columns_remedy =
    "write two columns, for example time[s],flow[cm3/s] or time[s],pressure[mmHg]";

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r";
  const std::size_t first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

/// The cells of a line, as spreadsheets write them: between double quotes where they like.
std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  bool quoted = false;
  std::size_t start = 0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') quoted = !quoted;
    if (i < line.size() && (quoted || line[i] != ',')) continue;
    std::string_view cell = trimmed(line.substr(start, i - start));
    if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"')
      cell = trimmed(cell.substr(1, cell.size() - 2));
    cells.push_back(cell);
    start = i + 1;
  }
  return cells;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& letter : result) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return result;
}

/// What to do about a line that has not two cells: programs of many countries write "0,5;1,25".
std::string separators_remedy(std::string_view line, std::size_t cells) {
  if (line.find(';') != std::string_view::npos || line.find('\t') != std::string_view::npos)
    return "; columns are told apart by commas, not by semicolons or tabs, and numbers have decimal points";
  return cells == 4 ? "; write numbers with decimal points, a comma tells columns apart" : "";
}

class WaveformReader {
 public:
  explicit WaveformReader(const std::filesystem::path& file)
      : label_("waveform file " + one_line(file.string(), 400)),
        text_(load_text(file, "waveform", ".csv", largest_waveform)) {}

  WaveformFile read() {
    if (text_.starts_with("\xff\xfe") || text_.starts_with("\xfe\xff"))
      refuse("is UTF-16 text; save it as UTF-8, a spreadsheet's plain CSV");
    if (text_.find('\0') != std::string::npos) refuse("is a binary file; write CSV text");
    std::string_view rest = text_;
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (rest.starts_with(byte_order_mark)) rest.remove_prefix(byte_order_mark.size());
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
      const std::string_view line = trimmed(rest.substr(0, end));
      const bool two_letters = rest.substr(end).starts_with("\r\n");
      rest.remove_prefix(std::min(end + (two_letters ? 2 : 1), rest.size()));
      ++line_;
      if (line.empty() || line.front() == '#') continue;
      if (time_.scale == 0)
        header(line, cells_of(line));
      else
        row(line, cells_of(line));
    }
    if (time_.scale == 0) refuse(fmt::format("has no header; {}", columns_remedy));
    check_points();
    result_.period = result_.time.back();
    return std::move(result_);
  }

 private:
  struct Column {
    std::size_t index = 0;
    double scale = 0;  ///< to CGS; 0 until the header is read
    std::string name;
    const Parameter* bounds = nullptr;
  };

  void header(std::string_view line, const std::vector<std::string_view>& cells) {
    if (cells.size() != 2)
      refuse_line(fmt::format("the header has {} of two columns; {}{}", cells.size(), columns_remedy,
                              separators_remedy(line, 0)));
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::size_t open = cells[i].find('[');
      const std::string name = lower(trimmed(cells[i].substr(0, open)));
      if (open == std::string_view::npos || cells[i].back() != ']')
        refuse_line(
            fmt::format("the column {} has no unit in brackets; {}", in_quotes(cells[i]), columns_remedy));
      const std::string unit(trimmed(cells[i].substr(open + 1, cells[i].size() - open - 2)));
      if (name == "time")
        time_ = {i, scale(unit, "s", name), name, find_parameter("inlet.period")};
      else if (name == "flow")
        value_ = {i, scale(unit, "cm3/s", name), name, find_parameter("inlet.flow")};
      else if (name == "pressure")
        value_ = {i, scale(unit, "dyn/cm2", name), name, find_parameter("inlet.pressure")};
      else
        refuse_line(fmt::format("unknown column {}; {}", in_quotes(cells[i]), columns_remedy));
    }
    if (time_.scale == 0 || value_.scale == 0)
      refuse_line(fmt::format("a column is twice there; {}", columns_remedy));
    result_.is_pressure = value_.name == "pressure";
  }

  double scale(const std::string& unit, const std::string& target, const std::string& name) const {
    try {
      return unit_factor(unit, target, fmt::format("{}[{}]", name, one_line(unit)),
                         fmt::format("write {}[{}] or a unit of that dimension", name, target));
    } catch (const InvalidInput& error) {
      refuse_line(error.what());
    }
  }

  void row(std::string_view line, const std::vector<std::string_view>& cells) {
    if (cells.size() != 2)
      refuse_line(fmt::format("the row has {} of two cells; write time and value, apart by a comma{}",
                              cells.size(), separators_remedy(line, cells.size())));
    result_.time.push_back(number(cells[time_.index], time_));
    result_.value.push_back(number(cells[value_.index], value_));
    if (!value_.bounds->bounds.contains(result_.value.back()))
      refuse_line(fmt::format("{} = {} is out of range; allowed is {} {}", value_.name,
                              one_line(cells[value_.index]), value_.bounds->bounds.text(),
                              value_.bounds->unit));
    if (result_.time.size() == 1 && result_.time.front() != 0)
      refuse_line(
          fmt::format("time = {} at the first point; time must start at 0", one_line(cells[time_.index])));
    if (result_.time.size() > 1 && !(result_.time.back() > result_.time[result_.time.size() - 2]))
      refuse_line(fmt::format("time = {} does not increase; sort the rows and leave out repeated times",
                              one_line(cells[time_.index])));
    lines_.push_back(line_);
  }

  double number(std::string_view cell, const Column& column) const {
    if (cell.empty())
      refuse_line(fmt::format("{} is empty, a gap; give the value or leave the row out", column.name));
    if (cell.front() == '+') cell.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc{} || end != cell.data() + cell.size())
      refuse_line(fmt::format("{} = {} is not a number; write it with a decimal point and without a unit",
                              column.name, in_quotes(cell)));
    value *= column.scale;
    if (!std::isfinite(value))
      refuse_line(fmt::format("{} = {} is not a finite number, a gap; give the value or leave the row out",
                              column.name, one_line(cell)));
    return value;
  }

  void check_points() {
    const std::vector<double>& time = result_.time;
    if (time.size() < fewest_points)
      refuse(fmt::format("has {} points; a waveform needs at least {}", time.size(), fewest_points));
    std::vector<double> intervals;
    for (std::size_t i = 1; i < time.size(); ++i) intervals.push_back(time[i] - time[i - 1]);
    std::vector<double> sorted = intervals;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const auto [low, high] = std::minmax_element(result_.value.begin(), result_.value.end());
    const double even = closing_error * (*high - *low);
    for (std::size_t i = 0; i < intervals.size(); ++i) {
      if (intervals[i] <= widest_interval * *middle) continue;
      // Published inflows give a diastole without flow by its two ends.
      if (std::abs(result_.value[i + 1] - result_.value[i]) <= even) continue;
      line_ = lines_[i + 1];
      refuse_line(
          fmt::format("a gap in time from {:g} s to {:g} s, {:.0f} times the usual interval; give the "
                      "missing points",
                      time[i], time[i + 1], intervals[i] / *middle));
    }
    if (!time_.bounds->bounds.contains(time.back()))
      refuse(
          fmt::format("has a period of {:g} s; allowed is {} s", time.back(), time_.bounds->bounds.text()));
    const double first = result_.value.front();
    double& last = result_.value.back();
    if (std::abs(last - first) > even)
      refuse(
          fmt::format("is not periodic: {} is {:g} {} at first and {:g} at last; repeat the first value at "
                      "the end of the period",
                      value_.name, first, value_.bounds->unit, last));
    last = first;
  }

  [[noreturn]] void refuse(const std::string& why) const { throw InvalidInput(label_ + " " + why); }
  [[noreturn]] void refuse_line(const std::string& why) const {
    throw InvalidInput(fmt::format("{}, line {}: {}", label_, line_, why));
  }

  std::string label_;
  std::string text_;
  std::size_t line_ = 0;
  std::vector<std::size_t> lines_;
  Column time_, value_;
  WaveformFile result_;
};

}  // namespace

WaveformFile read_waveform(const std::filesystem::path& file) {
  return WaveformReader(file).read();
}

}  // namespace tunica::scene
