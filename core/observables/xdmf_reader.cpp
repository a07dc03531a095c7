// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <map>
#include <stdexcept>
#include <string_view>

#include "core/observables/field_series.hpp"
#include "core/observables/xdmf_units.hpp"

namespace tunica::observables {

namespace {

[[noreturn]] void refuse(std::string_view what) {
  throw std::invalid_argument(std::string(what));
}

/// An opening or closing tag, without its brackets: "Time Value=\"0\"/".
using Tag = std::string_view;

bool is(Tag tag, std::string_view name) {
  return tag.starts_with(name) && (tag.size() == name.size() || tag[name.size()] == ' ');
}

std::string_view attribute(Tag tag, std::string_view name) {
  const std::string opening = fmt::format(" {}=\"", name);
  const std::size_t at = tag.find(opening);
  if (at == Tag::npos) refuse(fmt::format("<{}> without {}", tag, name));
  const std::size_t begin = at + opening.size();
  return tag.substr(begin, tag.find('"', begin) - begin);
}

template <class Number>
Number number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    refuse(fmt::format("\"{}\" is no number", text));
  return value;
}

/// Goes through tags and the numbers between them from the beginning to the end.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : rest_(text) {}

  /// The next tag; empty at the end.
  Tag next() {
    const std::size_t open = rest_.find('<');
    if (open == Tag::npos) return {};
    const std::size_t close = rest_.find('>', open);
    if (close == Tag::npos) refuse("the text ends in a tag");
    const Tag tag = rest_.substr(open + 1, close - open - 1);
    rest_.remove_prefix(close + 1);
    return tag;
  }

  /// The numbers of the data item that comes next.
  template <class Number>
  std::vector<Number> item() {
    const Tag tag = next();
    if (!is(tag, "DataItem") || attribute(tag, "Format") != "XML") refuse("no numbers where some belong");
    std::size_t expected = 1;
    std::string_view dimensions = attribute(tag, "Dimensions");
    while (!dimensions.empty()) {
      const std::string_view dimension = dimensions.substr(0, dimensions.find(' '));
      expected *= number<std::size_t>(dimension);
      dimensions.remove_prefix(std::min(dimensions.size(), dimension.size() + 1));
    }
    const char* at = rest_.data();
    const char* const end = at + rest_.size();
    // Every number takes a digit and a space: what is announced cannot ask for more memory than that.
    if (expected > rest_.size() / 2) refuse("fewer numbers than announced");
    std::vector<Number> values;
    values.reserve(expected);
    for (;;) {
      while (at != end && (*at == ' ' || *at == '\n')) ++at;
      if (at == end || *at == '<') break;
      Number value{};
      const auto read = std::from_chars(at, end, value);
      if (read.ec != std::errc()) refuse("something among the numbers is none");
      values.push_back(value);
      at = read.ptr;
    }
    if (values.size() != expected) refuse(fmt::format("{} numbers of {}", values.size(), expected));
    rest_.remove_prefix(static_cast<std::size_t>(at - rest_.data()));
    return values;
  }

 private:
  std::string_view rest_;
};

CellShape shape_of(std::string_view name) {
  if (name == "Triangle") return CellShape::triangle;
  if (name == "Quadrilateral") return CellShape::quadrilateral;
  if (name == "Tetrahedron") return CellShape::tetrahedron;
  if (name == "Hexahedron") return CellShape::hexahedron;
  refuse(fmt::format("cells of shape {}", name));
}

void read_points(Scanner& scanner, FieldMesh& mesh) {
  const std::vector<float> coordinates = scanner.item<float>();
  if (coordinates.size() % 3 != 0) refuse("a point lacks coordinates");
  for (std::size_t k = 0; k < coordinates.size(); k += 3)
    mesh.points.push_back({coordinates[k], coordinates[k + 1], coordinates[k + 2]});
}

/// Units by the fields' names.
using Units = std::map<std::string, std::string, std::less<>>;

std::string unit_of(const Units& units, std::string_view field) {
  const auto unit = units.find(field);
  if (unit == units.end()) refuse(fmt::format("{} without unit", field));
  return unit->second;
}

void read_cell_field(Scanner& scanner, Tag tag, const Units& units, FieldSeries& series) {
  const std::string name(attribute(tag, "Name"));
  CellField field{name, unit_of(units, name), scanner.item<int>()};
  if (field.values.size() * corners(series.mesh.shape) != series.mesh.cells.size())
    refuse(fmt::format("{} has not one value per cell", field.name));
  series.cell_fields.push_back(std::move(field));
}

void read_point_field(Scanner& scanner, Tag tag, const Units& units, FieldSeries& series) {
  if (series.frames.empty()) refuse("a field without time");
  const std::string name(attribute(tag, "Name"));
  const PointField field{name, unit_of(units, name), attribute(tag, "AttributeType") == "Vector" ? 3U : 1U};
  auto& frame = series.frames.back();
  const std::size_t index = frame.values.size();
  if (series.frames.size() == 1) series.point_fields.push_back(field);
  if (index >= series.point_fields.size() || series.point_fields[index].name != field.name)
    refuse(fmt::format("{} is not at all times", field.name));
  frame.values.push_back(scanner.item<float>());
  if (frame.values.back().size() != series.point_fields[index].components * series.mesh.points.size())
    refuse(fmt::format("{} has not one value per point", field.name));
}

void expect_whole(const FieldSeries& series) {
  const std::size_t corner_count = corners(series.mesh.shape);
  if (series.frames.empty() || series.mesh.cells.empty()) refuse("no cells or no times");
  if (series.mesh.cells.size() % corner_count != 0) refuse("a cell lacks corners");
  for (const int corner : series.mesh.cells)
    if (corner < 0 || static_cast<std::size_t>(corner) >= series.mesh.points.size())
      refuse("a cell has a corner that is no point");
  for (const auto& frame : series.frames)
    if (frame.values.size() != series.point_fields.size()) refuse("a time lacks fields");
}

}  // namespace

FieldSeries from_xdmf(std::string_view text) {
  FieldSeries series;
  Scanner scanner(text);
  Units units;
  Tag last;
  for (Tag tag = scanner.next(); !tag.empty(); last = tag, tag = scanner.next()) {
    if (is(tag, "Grid") && attribute(tag, "GridType") == "Collection") {
      series.name = attribute(tag, "Name");
    } else if (is(tag, "Information") && attribute(tag, "Name") == "mirrored") {
      const std::string_view planes = attribute(tag, "Value");
      series.mesh.mirrored = {planes.find('x') != Tag::npos, planes.find('y') != Tag::npos};
    } else if (is(tag, "Information") && attribute(tag, "Name").starts_with(xdmf_unit_of)) {
      units.emplace(attribute(tag, "Name").substr(xdmf_unit_of.size()), attribute(tag, "Value"));
    } else if (is(tag, "Time")) {
      series.frames.push_back({number<double>(attribute(tag, "Value")), {}});
    } else if (is(tag, "Topology")) {
      series.mesh.shape = shape_of(attribute(tag, "TopologyType"));
      series.mesh.cells = scanner.item<int>();
    } else if (is(tag, "Geometry")) {
      read_points(scanner, series.mesh);
    } else if (is(tag, "Attribute") && attribute(tag, "Center") == "Cell") {
      read_cell_field(scanner, tag, units, series);
    } else if (is(tag, "Attribute")) {
      read_point_field(scanner, tag, units, series);
    }
  }
  if (last != "/Xdmf") refuse("the end is missing");
  expect_whole(series);
  return series;
}

}  // namespace tunica::observables
