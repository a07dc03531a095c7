// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <stdexcept>

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
<Attribute Name="layer" AttributeType="Scalar" Center="Cell"><Information Name="unit" Value="1"/><DataItem Format="XML" NumberType="Int" Precision="4" Dimensions="2">
0 1 </DataItem>
</Attribute>
<Attribute Name="displacement" AttributeType="Vector" Center="Node"><Information Name="unit" Value="cm"/><DataItem Format="XML" NumberType="Float" Precision="4" Dimensions="4 3">
0 0 0
0 0 0
0 0 0
0 0 0
</DataItem>
</Attribute>
<Attribute Name="stretch" AttributeType="Scalar" Center="Node"><Information Name="unit" Value="1"/><DataItem Format="XML" NumberType="Float" Precision="4" Dimensions="4">
1 1 1 1 </DataItem>
</Attribute>
</Grid>
<Grid Name="square" GridType="Uniform">
<Time Value="0.05"/>
<xi:include xpointer="xpointer(/Xdmf/Domain/Grid/Grid[1]/*[self::Topology or self::Geometry or @Center='Cell'])"/>
<Attribute Name="displacement" AttributeType="Vector" Center="Node"><Information Name="unit" Value="cm"/><DataItem Format="XML" NumberType="Float" Precision="4" Dimensions="4 3">
0 0 0
0.1 0 0
0.1 -0.1 0
0 1e-09 0
</DataItem>
</Attribute>
<Attribute Name="stretch" AttributeType="Scalar" Center="Node"><Information Name="unit" Value="1"/><DataItem Format="XML" NumberType="Float" Precision="4" Dimensions="4">
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
