// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include "core/observables/field_series.hpp"
#include "core/observables/xdmf_units.hpp"

namespace tunica::observables {

namespace {

constexpr std::string_view shape_name(CellShape shape) {
  switch (shape) {
    case CellShape::triangle:
      return "Triangle";
    case CellShape::quadrilateral:
      return "Quadrilateral";
    case CellShape::tetrahedron:
      return "Tetrahedron";
    case CellShape::hexahedron:
      return "Hexahedron";
  }
  throw std::logic_error("to_xdmf: a cell shape without a name");
}

void expect(bool holds, const std::string& series, std::string_view what) {
  if (!holds) throw std::logic_error(fmt::format("to_xdmf: {}: {}", series, what));
}

/// Names and units are put between quotes as they are.
void expect_plain(const std::string& series, std::string_view text) {
  expect(text.find_first_of("<>&\"'") == std::string_view::npos, series,
         fmt::format("{} has characters of XML", text));
}

void check(const FieldSeries& s) {
  const std::size_t corner_count = corners(s.mesh.shape);
  expect_plain(s.name, s.name);
  expect(s.mesh.cells.size() % corner_count == 0, s.name, "a cell lacks corners");
  for (const int index : s.mesh.cells)
    expect(index >= 0 && static_cast<std::size_t>(index) < s.mesh.points.size(), s.name,
           "a cell has a corner that is no point");
  for (const CellField& field : s.cell_fields) {
    expect_plain(s.name, field.name);
    expect_plain(s.name, field.unit);
    expect(field.values.size() * corner_count == s.mesh.cells.size(), s.name,
           fmt::format("{} has not one value per cell", field.name));
  }
  for (const PointField& field : s.point_fields) {
    expect_plain(s.name, field.name);
    expect_plain(s.name, field.unit);
    expect(field.components == 1 || field.components == 3, s.name,
           fmt::format("{} is neither scalar nor vector", field.name));
  }
  for (const FieldSeries::Frame& frame : s.frames) {
    expect(frame.values.size() == s.point_fields.size(), s.name, "a time lacks fields");
    for (std::size_t f = 0; f < frame.values.size(); ++f)
      expect(frame.values[f].size() == s.point_fields[f].components * s.mesh.points.size(), s.name,
             fmt::format("{} has not one value per point at t = {} s", s.point_fields[f].name, frame.time));
  }
}

template <class Number>
void append_number(std::string& text, Number value) {
  // to_chars writes the sign of a NaN.
  if (std::isnan(static_cast<double>(value))) {
    text += "nan";
    return;
  }
  char buffer[32];
  text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

/// Numbers separated by spaces, `columns` of them in a line.
template <class Number>
void append_numbers(std::string& text, const std::vector<Number>& values, std::size_t columns) {
  // Symmetric bodies have the same number many times in succession: its text is copied.
  std::size_t last_begin = 0, last_length = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::size_t begin = text.size();
    if (k > 0 && values[k] == values[k - 1])
      text.append(text, last_begin, last_length);
    else
      append_number(text, values[k]);
    last_begin = begin;
    last_length = text.size() - begin;
    text += (k + 1) % columns == 0 ? '\n' : ' ';
  }
}

template <class Number>
void append_item(std::string& text, const std::vector<Number>& values, std::size_t columns) {
  constexpr bool is_integer = std::is_integral_v<Number>;
  constexpr std::size_t scalars_per_line = 16;
  const std::string dimensions = columns == 1 ? fmt::format("{}", values.size())
                                              : fmt::format("{} {}", values.size() / columns, columns);
  fmt::format_to(std::back_inserter(text),
                 "<DataItem Format=\"XML\" NumberType=\"{}\" Precision=\"{}\" Dimensions=\"{}\">\n",
                 is_integer ? "Int" : "Float", sizeof(Number), dimensions);
  append_numbers(text, values, columns == 1 ? scalars_per_line : columns);
  text += "</DataItem>\n";
}

template <class Number>
void append_attribute(std::string& text, std::string_view name, std::string_view center,
                      const std::vector<Number>& values, std::size_t components) {
  fmt::format_to(std::back_inserter(text), "<Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">", name,
                 components == 3 ? "Vector" : "Scalar", center);
  append_item(text, values, components);
  text += "</Attribute>\n";
}

void append_mesh(std::string& text, const FieldSeries& s) {
  const std::size_t corner_count = corners(s.mesh.shape);
  fmt::format_to(std::back_inserter(text), "<Topology TopologyType=\"{}\" NumberOfElements=\"{}\">",
                 shape_name(s.mesh.shape), s.mesh.cells.size() / corner_count);
  append_item(text, s.mesh.cells, corner_count);
  text += "</Topology>\n<Geometry GeometryType=\"XYZ\">";
  std::vector<float> coordinates;
  coordinates.reserve(3 * s.mesh.points.size());
  for (const auto& point : s.mesh.points)
    for (const double coordinate : point) coordinates.push_back(static_cast<float>(coordinate));
  append_item(text, coordinates, 3);
  text += "</Geometry>\n";
  for (const CellField& field : s.cell_fields) append_attribute(text, field.name, "Cell", field.values, 1);
}

void append_information(std::string& text, std::string_view name, std::string_view value) {
  fmt::format_to(std::back_inserter(text), "<Information Name=\"{}\" Value=\"{}\"/>\n", name, value);
}

}  // namespace

std::size_t corners(CellShape shape) {
  switch (shape) {
    case CellShape::triangle:
      return 3;
    case CellShape::quadrilateral:
    case CellShape::tetrahedron:
      return 4;
    case CellShape::hexahedron:
      return 8;
  }
  throw std::logic_error("corners: a cell shape without corners");
}

std::size_t numbers_of_a_time(const std::vector<FieldSeries>& series) {
  std::size_t numbers = 0;
  for (const FieldSeries& one : series)
    for (const PointField& field : one.point_fields) numbers += field.components * one.mesh.points.size();
  return numbers;
}

void write_xdmf(const FieldSeries& series, const std::function<void(std::string_view)>& sink) {
  check(series);
  std::string text;
  const auto hand_over = [&] {
    sink(text);
    text.clear();
  };
  fmt::format_to(std::back_inserter(text),
                 "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                 "<Xdmf Version=\"3.0\" xmlns:xi=\"http://www.w3.org/2001/XInclude\">\n<Domain>\n");
  if (series.mesh.mirrored[0] || series.mesh.mirrored[1])
    append_information(
        text, "mirrored",
        fmt::format("{}{}", series.mesh.mirrored[0] ? "x" : "", series.mesh.mirrored[1] ? "y" : ""));
  for (const CellField& field : series.cell_fields)
    append_information(text, fmt::format("{}{}", xdmf_unit_of, field.name), field.unit);
  for (const PointField& field : series.point_fields)
    append_information(text, fmt::format("{}{}", xdmf_unit_of, field.name), field.unit);
  fmt::format_to(std::back_inserter(text),
                 "<Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n", series.name);
  for (const FieldSeries::Frame& frame : series.frames) {
    fmt::format_to(std::back_inserter(text), "<Grid Name=\"{}\" GridType=\"Uniform\">\n<Time Value=\"",
                   series.name);
    append_number(text, frame.time);
    text += "\"/>\n";
    if (&frame == &series.frames.front())
      append_mesh(text, series);
    else
      text +=
          "<xi:include xpointer=\"xpointer(/Xdmf/Domain/Grid/Grid[1]/"
          "*[self::Topology or self::Geometry or @Center='Cell'])\"/>\n";
    for (std::size_t f = 0; f < series.point_fields.size(); ++f) {
      const PointField& field = series.point_fields[f];
      append_attribute(text, field.name, "Node", frame.values[f], field.components);
    }
    text += "</Grid>\n";
    hand_over();
  }
  text += "</Grid>\n</Domain>\n</Xdmf>\n";
  hand_over();
}

std::string to_xdmf(const FieldSeries& series) {
  std::string whole;
  write_xdmf(series, [&](std::string_view text) { whole += text; });
  return whole;
}

}  // namespace tunica::observables
