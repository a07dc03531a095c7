// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <stdexcept>

#include "core/error.hpp"
#include "core/observables/field_series.hpp"
#include "core/observables/result.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace tunica;
using namespace tunica::observables;
using tunica::test_support::read_text;
using tunica::test_support::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

/// Two triangles that make a square, with a vector and a scalar at two times.
FieldSeries square() {
  FieldSeries series;
  series.name = "square";
  series.mesh = {
      CellShape::triangle, {{0, 0, 0.5}, {1, 0, 0.5}, {1, 1, 0.5}, {0, 1, 0.5}}, {0, 1, 2, 0, 2, 3}};
  series.cell_fields = {{"layer", "1", {0, 1}}};
  series.point_fields = {{"displacement", "cm", 3}, {"stretch", "1", 1}};
  series.frames = {{0, {std::vector<float>(12, 0.0F), {1, 1, 1, 1}}},
                   {0.05, {{0, 0, 0, 0.1F, 0, 0, 0.1F, -0.1F, 0, 0, 1e-9F, 0}, {1.5F, 1.5F, NAN, 1234567}}}};
  return series;
}

// Written by hand after the description of the format (xdmf.org, "XDMF Model and Format").
constexpr const char* square_text = R"XML(<?xml version="1.0" encoding="UTF-8"?>
<Xdmf Version="3.0" xmlns:xi="http://www.w3.org/2001/XInclude">
<Domain>
<Information Name="unit of layer" Value="1"/>
<Information Name="unit of displacement" Value="cm"/>
<Information Name="unit of stretch" Value="1"/>
<Grid Name="square" GridType="Collection" CollectionType="Temporal">
<Grid Name="square" GridType="Uniform">
<Time Value="0"/>
<Topology TopologyType="Triangle" NumberOfElements="2"><DataItem Format="XML" NumberType="Int" Precision="4" Dimensions="2 3">
0 1 2
0 2 3
</DataItem>
</Topology>
<Geometry GeometryType="XYZ"><DataItem Format="XML" NumberType="Float" Precision="4" Dimensions="4 3">
0 0 0.5
1 0 0.5
1 1 0.5
0 1 0.5
</DataItem>
</Geometry>
<Attribute Name="layer" AttributeType="Scalar" Center="Cell"><DataItem Format="XML" NumberType="Int" Precision="4" Dimensions="2">
0 1 </DataItem>
</Attribute>
<Attribute Name="displacement" AttributeType="Vector" Center="Node"><DataItem Format="XML" NumberType="Float" Precision="4" Dimensions="4 3">
0 0 0
0 0 0
0 0 0
0 0 0
</DataItem>
</Attribute>
<Attribute Name="stretch" AttributeType="Scalar" Center="Node"><DataItem Format="XML" NumberType="Float" Precision="4" Dimensions="4">
1 1 1 1 </DataItem>
</Attribute>
</Grid>
<Grid Name="square" GridType="Uniform">
<Time Value="0.05"/>
<xi:include xpointer="xpointer(/Xdmf/Domain/Grid/Grid[1]/*[self::Topology or self::Geometry or @Center='Cell'])"/>
<Attribute Name="displacement" AttributeType="Vector" Center="Node"><DataItem Format="XML" NumberType="Float" Precision="4" Dimensions="4 3">
0 0 0
0.1 0 0
0.1 -0.1 0
0 1e-09 0
</DataItem>
</Attribute>
<Attribute Name="stretch" AttributeType="Scalar" Center="Node"><DataItem Format="XML" NumberType="Float" Precision="4" Dimensions="4">
1.5 1.5 nan 1234567 </DataItem>
</Attribute>
</Grid>
</Grid>
</Domain>
</Xdmf>
)XML";

Scene small_scene() {
  return parse_scene("[wall]\nlaw = \"EXP1\"\n", "small", ".");
}

Result with_fields(std::vector<FieldSeries> fields) {
  Result result;
  result.observables.add("time", "s");
  result.fields = std::move(fields);
  return result;
}

}  // namespace

TEST(Xdmf, HasTheMeshOnceAndTheFieldsAtEachTime) {
  EXPECT_EQ(to_xdmf(square()), square_text);
}

TEST(Xdmf, WhatDoesNotFitTheMeshIsRefused) {
  const std::function<void(FieldSeries&)> mistakes[] = {
      [](FieldSeries& s) { s.mesh.cells.pop_back(); },
      [](FieldSeries& s) { s.mesh.cells[3] = 4; },
      [](FieldSeries& s) { s.mesh.cells[3] = -1; },
      [](FieldSeries& s) { s.cell_fields[0].values.push_back(2); },
      [](FieldSeries& s) { s.point_fields[0].components = 2; },
      [](FieldSeries& s) { s.point_fields[1].components = 3; },
      [](FieldSeries& s) { s.point_fields[1].name = "a<b"; },
      [](FieldSeries& s) { s.point_fields[1].unit = "\""; },
      [](FieldSeries& s) { s.frames[1].values.pop_back(); },
      [](FieldSeries& s) { s.frames[1].values[1].pop_back(); }};
  for (const auto& mistake : mistakes) {
    FieldSeries series = square();
    mistake(series);
    EXPECT_THROW(to_xdmf(series), std::logic_error) << "mistake " << &mistake - mistakes;
  }
}

TEST(Xdmf, IsReadBack) {
  FieldSeries series = square();
  series.mesh.mirrored = {true, false};
  const FieldSeries read = from_xdmf(to_xdmf(series));
  // Equal text is equal numbers: they are written with as many digits as they have.
  EXPECT_EQ(to_xdmf(read), to_xdmf(series));
  EXPECT_EQ(read.name, "square");
  EXPECT_EQ(read.mesh.mirrored, (std::array<bool, 2>{true, false}));
  EXPECT_EQ(read.point_fields[0].components, 3U);
  EXPECT_TRUE(std::isnan(read.frames[1].values[1][2]));
  EXPECT_EQ(from_xdmf(square_text).mesh.mirrored, (std::array<bool, 2>{false, false}));
}

TEST(Xdmf, HalfAFileOrAnotherFormIsNotRead) {
  const std::string text = square_text;
  for (std::size_t length = 0; length + 1 < text.size(); length += 7)
    EXPECT_THROW(from_xdmf(text.substr(0, length)), std::invalid_argument) << length;
  const std::pair<const char*, const char*> mistakes[] = {
      {"0 1 2\n", "0 1 4\n"},
      {"0 1 2\n", "0 1 -1\n"},
      {"0 1 2\n", "0 1\n"},
      {"0 1 2\n", "0 1 x\n"},
      {"\"Triangle\"", "\"Wedge\""},
      {"\"XML\"", "\"HDF\""},
      {"<Time Value=\"0\"/>", ""},
      {"Dimensions=\"2 3\"", "Dimensions=\"99999999999 3\""},
      {"\"stretch\"", "\"other\""},
      {"<Time Value=\"0\"/>", "<Time Value=\"now\"/>"},
      {"unit of stretch", "unit of strain"}};
  for (const auto& [right, wrong] : mistakes) {
    std::string broken = text;
    broken.replace(broken.find(right), std::string(right).size(), wrong);
    EXPECT_THROW(from_xdmf(broken), std::invalid_argument) << right << " as " << wrong;
  }
}

TEST(StoreFields, OnlyThoseInSpaceAreReadBack) {
  const TemporaryFolder folder;
  FieldSeries body;
  body.name = "body";
  body.mesh = {CellShape::tetrahedron, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 1, 2, 3}};
  body.frames = {{0, {}}};
  write_result(folder.path(), small_scene(), with_fields({square(), body}));
  const auto read = read_space_fields(folder.path());
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(to_xdmf(read[0]), to_xdmf(body));
  EXPECT_TRUE(read_space_fields(folder.path() / "nothing").empty());

  const std::string text = to_xdmf(body);
  write_whole(folder.path() / "fields/body.xdmf", text.substr(0, text.size() / 2));
  EXPECT_THROW(read_space_fields(folder.path()), InvalidInput);
}

TEST(StoreFields, EachSeriesHasItsFile) {
  const TemporaryFolder folder;
  FieldSeries other = square();
  other.name = "other";
  FieldSeries empty = square();
  empty.name = "empty";
  empty.frames.clear();
  write_result(folder.path(), small_scene(), with_fields({square(), other, empty}));
  EXPECT_EQ(read_text(folder.path() / "fields/square.xdmf"), square_text);
  EXPECT_EQ(read_text(folder.path() / "fields/other.xdmf"), to_xdmf(other));
  EXPECT_EQ(test_support::count_entries(folder.path() / "fields"), 2U);
}

TEST(StoreFields, ThoseOfAnEarlierRunGoAndTheUsersOwnStays) {
  const TemporaryFolder folder;
  const fs::path fields = folder.path() / "fields";
  FieldSeries other = square();
  other.name = "other";
  write_result(folder.path(), small_scene(), with_fields({square(), other}));
  write_whole(fields / ".square.xdmf.1.part", "half");
  write_result(folder.path(), small_scene(), with_fields({other}));
  EXPECT_EQ(test_support::count_entries(fields), 1U);
  EXPECT_TRUE(fs::exists(fields / "other.xdmf"));

  write_whole(fields / "view.pvsm", "the user's own");
  write_result(folder.path(), small_scene(), with_fields({}));
  EXPECT_EQ(test_support::count_entries(fields), 1U);
  EXPECT_EQ(read_text(fields / "view.pvsm"), "the user's own");
  fs::remove(fields / "view.pvsm");
  write_result(folder.path(), small_scene(), with_fields({}));
  EXPECT_FALSE(fs::exists(fields));
}
