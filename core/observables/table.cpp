// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/observables/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "core/error.hpp"

namespace tunica::observables {

namespace {

void append_number(std::string& text, double value) {
  if (is_none(value)) return;
  char buffer[32];  // the shortest form of a double has at most 24 characters
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  text.append(buffer, end);
}

void append_label(std::string& text, std::string_view label) {
  if (label.find_first_of(",\"\r\n") == std::string_view::npos) {
    text += label;
    return;
  }
  text += '"';
  for (const char character : label) {
    if (character == '"') text += '"';
    text += character;
  }
  text += '"';
}

std::string header_of(const Column& column) {
  return column.is_text() ? column.name : fmt::format("{}[{}]", column.name, column.unit);
}

/// Walks over the cells of a CSV text, keeping line and column for messages.
class Cells {
 public:
  Cells(std::string_view text, std::string_view name) : text_(text), name_(name) {}

  bool at_end() const { return position_ == text_.size(); }
  /// True when the cell read last ended its line.
  bool line_ended() const { return line_ended_; }

  std::string next() {
    if (line_ended_) {
      ++line_;
      cell_ = 0;
    }
    ++cell_;
    std::string cell = position_ < text_.size() && text_[position_] == '"' ? quoted() : plain();
    line_ended_ = true;
    if (position_ < text_.size() && text_[position_] == ',') {
      line_ended_ = false;
      ++position_;
      return cell;
    }
    if (position_ < text_.size() && text_[position_] == '\r') ++position_;
    if (position_ < text_.size()) {
      if (text_[position_] != '\n') fail("text after a closing quote");
      ++position_;
    }
    return cell;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InvalidInput(fmt::format("{}: line {}, column {}: {}", name_, line_, cell_, what));
  }

 private:
  std::string plain() {
    const std::size_t end = std::min(text_.find_first_of(",\r\n", position_), text_.size());
    std::string cell(text_.substr(position_, end - position_));
    position_ = end;
    return cell;
  }

  std::string quoted() {
    std::string cell;
    for (++position_;; ++position_) {
      const std::size_t quote = text_.find('"', position_);
      if (quote == std::string_view::npos) fail("a quote is not closed");
      cell += text_.substr(position_, quote - position_);
      position_ = quote + 1;
      if (position_ == text_.size() || text_[position_] != '"') return cell;
      cell += '"';
    }
  }

  std::string_view text_;
  std::string_view name_;
  std::size_t position_ = 0;
  std::size_t line_ = 0;
  std::size_t cell_ = 0;
  bool line_ended_ = true;
};

double to_number(const Cells& cells, const std::string& cell) {
  if (cell.empty()) return none;
  double value = 0;
  const char* const end = cell.data() + cell.size();
  const auto [stop, error] = std::from_chars(cell.data(), end, value);
  if (error != std::errc{} || stop != end) cells.fail(fmt::format("\"{}\" is not a number", cell));
  return value;
}

void add_header(Table& table, const Cells& cells, const std::string& cell) {
  if (cell.empty()) cells.fail("a column has no name");
  const std::size_t open = cell.rfind('[');
  const bool has_unit = cell.back() == ']' && open != std::string::npos && open > 0;
  if (has_unit && open + 2 == cell.size()) cells.fail(fmt::format("\"{}\" has an empty unit", cell));
  std::string name = has_unit ? cell.substr(0, open) : cell;
  if (table.find(name)) cells.fail(fmt::format("there are two columns \"{}\"", name));
  table.add(std::move(name), has_unit ? cell.substr(open + 1, cell.size() - open - 2) : "");
}

}  // namespace

std::size_t Table::add(std::string name, std::string unit) {
  columns_.push_back({std::move(name), std::move(unit), {}, {}});
  return columns_.size() - 1;
}

const Column* Table::find(std::string_view name) const {
  for (const Column& column : columns_)
    if (column.name == name) return &column;
  return nullptr;
}

std::string to_csv(const Table& table) {
  const auto& columns = table.columns();
  if (columns.empty()) return {};
  std::string text;
  text.reserve((table.rows() + 2) * columns.size() * 20);
  for (const Column& column : columns) {
    if (column.size() != table.rows())
      throw std::logic_error(
          fmt::format("column {} has {} rows, the first has {}", column.name, column.size(), table.rows()));
    append_label(text, header_of(column));
    text += ',';
  }
  text.back() = '\n';
  for (std::size_t row = 0; row < table.rows(); ++row) {
    for (const Column& column : columns) {
      if (column.is_text())
        append_label(text, column.labels[row]);
      else
        append_number(text, column.values[row]);
      text += ',';
    }
    text.back() = '\n';
  }
  return text;
}

Table parse_csv(std::string_view text, std::string_view name) {
  Table table;
  if (text.empty()) throw InvalidInput(fmt::format("{}: the file is empty", name));
  Cells cells(text, name);
  do add_header(table, cells, cells.next());
  while (!cells.line_ended());
  const std::size_t width = table.columns().size();
  while (!cells.at_end()) {
    for (std::size_t index = 0; index < width; ++index) {
      Column& column = table[index];
      std::string cell = cells.next();
      if (column.is_text())
        column.labels.push_back(std::move(cell));
      else
        column.values.push_back(to_number(cells, cell));
      if (cells.line_ended() != (index + 1 == width))
        cells.fail(fmt::format("the header has {} columns, this line has {}", width,
                               cells.line_ended() ? "fewer" : "more"));
    }
  }
  return table;
}

Table read_csv(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  // A folder opens like a file and fails only when read.
  if (!file || std::filesystem::is_directory(path))
    throw InvalidInput(fmt::format("{}: the file cannot be read", path));
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return parse_csv(text, path);
}

}  // namespace tunica::observables
