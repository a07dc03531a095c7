// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/bad_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include "tests/support/gmsh_model.hpp"

namespace tunica::test_support {

namespace {

/// A straight tube, R = 1, wall 0.5, length 4: two columns of blood and one of wall in four rows.
Stenosis straight(int type) {
  Stenosis shape;
  shape.radius = 1;
  shape.thickness = 0.5;
  shape.length = 4;
  shape.severity = 0;
  shape.blood_cells = 2;
  shape.wall_cells = 1;
  shape.axial_cells = 4;
  shape.type = type;
  return shape;
}

GmshModel::Node& node_at(GmshModel& model, double r, double z) {
  for (auto& node : model.nodes)
    if (std::hypot(node.x - r, node.y - z) < 1e-12) return node;
  throw std::logic_error("no node there");
}

/// The k-th element of this name.
GmshModel::Element& element_of(GmshModel& model, const std::string& name, int k = 0) {
  for (auto& element : model.elements)
    if (element.name == name && k-- == 0) return element;
  throw std::logic_error("no element " + name);
}

void rename(GmshModel& model, const std::string& from, const std::string& to) {
  for (auto& element : model.elements)
    if (element.name == from) element.name = to;
}

void remove(GmshModel& model, const std::string& name) {
  std::erase_if(model.elements, [&](const auto& element) { return element.name == name; });
}

using Spoil = std::function<void(GmshModel&)>;

std::string spoilt(const Stenosis& shape, const Spoil& spoil, const std::string& version = "4.1") {
  GmshModel model = stenosis_mesh(shape);
  spoil(model);
  return model.text(version);
}
std::string spoilt(int type, const Spoil& spoil, const std::string& version = "4.1") {
  return spoilt(straight(type), spoil, version);
}

/// The file with the first `from` replaced.
std::string replaced(const std::string& version, const std::string& from, const std::string& to) {
  std::string text = stenosis_mesh(straight(quadrilateral4)).text(version);
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("no " + from);
  return text.replace(at, from.size(), to);
}

std::vector<BadMesh> files() {
  const std::string format = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  const std::string old_format = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  return {
      {"empty", "", {"line 1", "$MeshFormat", "no Gmsh mesh"}},
      {"another_format", "solid cube\n facet normal 0 0 1\n", {"line 1", "no Gmsh mesh", "*.msh"}},
      {"old_version", "$MeshFormat\n1 0 8\n", {"line 2", "\"1\"", "2.2 and 4.1", "Mesh.MshFileVersion"}},
      {"version_4_0", "$MeshFormat\n4 0 8\n", {"\"4\"", "2.2 and 4.1"}},
      {"binary_flag",
       "$MeshFormat\n4.1 1 8\n",
       {"byte 20", "ends inside the section $MeshFormat", "cut off"}},
      {"binary_bytes",
       "$MeshFormat\n4.1 1 8\n\x01" + std::string(3, '\0'),
       {"byte 24", "the file ends before $EndMeshFormat", "cut off"}},
      {"binary_of_another_machine",
       "$MeshFormat\n4.1 1 8\n" + std::string(3, '\0') + "\x01\n$EndMeshFormat\n",
       {"byte 24", "order of another machine", "Mesh.Binary = 0"}},
      {"binary_without_one",
       "$MeshFormat\n2.2 1 8\n\x07" + std::string(3, '\0') + "\n$EndMeshFormat\n",
       {"7 where a binary file has the number 1", "damaged"}},
      {"binary_of_32_bits", "$MeshFormat\n4.1 1 4\n", {"line 2", "numbers of 4 bytes", "Mesh.Binary = 0"}},
      {"binary_4_0", "$MeshFormat\n4 1 8\n\x01" + std::string(3, '\0'), {"\"4\"", "2.2 and 4.1"}},
      {"unknown_file_type", "$MeshFormat\n4.1 2 8\n", {"line 2", "file type = 2", "0 to 1"}},
      {"text_with_bytes",
       format + "$Nodes\n0 0 0 0\n$EndNodes\n" + std::string(1, '\0'),
       {"said to be text", "save the mesh again"}},
      {"only_a_format", format, {"no section $Nodes", "mesh the geometry"}},
      {"no_elements", format + "$Nodes\n0 0 0 0\n$EndNodes\n", {"no section $Elements", "mesh the geometry"}},
      {"huge_count",
       format + "$Nodes\n1 999999999999 1 2\n",
       {"line 5", "999999999999", "cut off or damaged"}},
      {"count_beyond_integers",
       old_format + "$Nodes\n99999999999999999999999\n",
       {"line 5", "is not a count"}},
      {"negative_count", old_format + "$Elements\n-4\n", {"line 5", "-4", "is not a count"}},
      {"huge_block", format + "$Elements\n1 3 1 3\n2 1 3 4000000000\n", {"line 6", "4000000000", "cut off"}},
      {"unknown_section_unended", format + "$Comments\nno end", {"inside the section $Comments", "cut off"}},
      {"text_between_sections", format + "17 18\n", {"line 4", "\"17\"", "between two sections"}},
      {"second_section",
       format + "$Nodes\n0 0 0 0\n$EndNodes\n$Nodes\n",
       {"line 7", "second section $Nodes"}},
      {"partitioned", format + "$PartitionedEntities\n", {"line 4", "partitioned", "one piece"}},
      {"parametric", old_format + "$ParametricNodes\n", {"line 4", "parametric", "Mesh.SaveParametric = 0"}},
      {"name_without_quotes", replaced("4.1", "\"blood\"", "blood"), {"line 11", "double quotes"}},
      {"name_over_two_lines", replaced("4.1", "\"blood\"", "\"blo\nod\""), {"line 11", "double quotes"}},
      {"coordinate_nan", replaced("4.1", "\n0.5 0 0\n", "\nnan 0 0\n"), {"x (the radius) = nan", "finite"}},
      {"coordinate_infinite",
       replaced("2.2", " 0.5 1 0\n", " 0.5 -inf 0\n"),
       {"y (the height) = -inf", "finite"}},
      {"coordinate_huge", replaced("2.2", " 0.5 1 0\n", " 1e300 1 0\n"), {"1e300", "finite number up to"}},
      {"coordinate_a_word", replaced("2.2", " 0.5 1 0\n", " o.5 1 0\n"), {"\"o.5\" is not a number"}},
      {"tag_not_whole", replaced("2.2", "\n2 0.5", "\n2.5 0.5"), {"\"2.5\" is not a whole number"}},
      {"tag_negative", replaced("2.2", "\n2 0.5", "\n-2 0.5"), {"= -2 is out of range"}},
      {"node_twice", replaced("2.2", "\n2 0.5", "\n1 0.5"), {"node 1 is defined twice"}},
      {"node_missing", replaced("2.2", "\n2 0.5", "\n99 0.5"), {"has the node 2", "does not define"}},
      {"node_line_missing",
       replaced("2.2", "\n2 0.5 0 0\n", "\n"),
       {"\"$EndNodes\" where the tag of a node is expected", "less than it announces"}},
      {"node_line_twice",
       replaced("2.2", "\n2 0.5 0 0\n", "\n2 0.5 0 0\n200 0.5 0.1 0\n"),
       {"where $EndNodes is expected", "counts"}},
      {"nodes_do_not_add_up",
       replaced("4.1", "$Nodes\n1 20 ", "$Nodes\n1 19 "),
       {"19 nodes", "blocks hold 20"}},
      {"elements_do_not_add_up",
       replaced("4.1", "$Elements\n7 22 ", "$Elements\n7 23 "),
       {"23 elements", "blocks hold 22"}},
      {"tetrahedron",
       spoilt(
           quadrilateral4,
           [](auto& m) {
             m.elements[5].type = 4;
             m.elements[5].name.clear();
           },
           "2.2"),
       {"a vessel in space", "use --tier full3d, or mesh"}},
      {"order_three",
       spoilt(triangle6, [](auto& m) { m.elements[5].type = 21; }),
       {"element 6 has the type 21 of order 3", "order 1 or 2", "Mesh.ElementOrder = 2"}},
      {"type_in_wrong_dimension", replaced("4.1", "\n2 6 3 8\n", "\n2 6 1 8\n"), {"type 1", "dimension 2"}},
      {"in_two_parts",
       replaced("4.1", "\n6 0 0 0 1 1 0 1 6 0\n", "\n6 0 0 0 1 1 0 2 6 7 0\n"),
       {"quadrilateral 1 is in 2 parts", "\"blood\" and \"wall\"", "one physical surface"}},
  };
}

std::vector<BadMesh> parts() {
  Stenosis layered = straight(triangle6);
  layered.layered = true;
  layered.wall_cells = 3;
  return {
      {"no_cells",
       spoilt(triangle3, [](auto& m) { remove(m, "blood"), remove(m, "wall"); }),
       {"no triangle and no quadrilateral", "gmsh -2"}},
      {"mixed_shapes",
       spoilt(quadrilateral4,
              [](auto& m) {
                auto& cell = element_of(m, "wall");
                cell.type = triangle3;
                cell.nodes.pop_back();
              }),
       {"1 triangles and 11 quadrilaterals are mixed", "Recombine"}},
      {"cell_without_part",
       spoilt(
           triangle6, [](auto& m) { element_of(m, "wall", 2).name = ""; }, "2.2"),
       {"in no named part", "physical surface", "\"blood\""}},
      {"part_misspelt",
       spoilt(triangle6, [](auto& m) { rename(m, "blood", "bloood"); }),
       {"\"bloood\" is unknown", "did you mean blood?"}},
      {"layer_zero",
       spoilt(triangle6, [](auto& m) { rename(m, "wall", "wall:0"); }),
       {"\"wall:0\" is unknown"}},
      {"layer_no_number", spoilt(triangle6, [](auto& m) { rename(m, "wall", "wall:in"); }), {"\"wall:in\""}},
      {"layers_and_a_wall",
       spoilt(layered, [](auto& m) { rename(m, "wall:2", "wall"); }),
       {"partly \"wall\"", "all of its layers, or none"}},
      {"layer_missing",
       spoilt(layered, [](auto& m) { rename(m, "wall:2", "wall:4"); }),
       {"4 layers but no cell in \"wall:2\"", "from 1"}},
      {"layers_outside_in",
       spoilt(layered,
              [](auto& m) {
                rename(m, "wall:1", "x");
                rename(m, "wall:3", "wall:1");
                rename(m, "x", "wall:3");
              }),
       {"in layer 1 of 3 is at the outer surface", "from the lumen outwards", "(r, z)"}},
      {"layers_shuffled",
       spoilt(
           [] {
             Stenosis four = straight(triangle6);
             four.layered = true;
             four.wall_cells = 5;
             return four;
           }(),
           [](auto& m) {
             rename(m, "wall:2", "x");
             rename(m, "wall:4", "wall:2");
             rename(m, "x", "wall:4");
           }),
       {"touches layer", "from the lumen outwards"}},
      {"part_declared_but_empty",
       [] {
         Stenosis pipe = straight(quadrilateral4);
         pipe.wall_cells = 0;
         std::string text = stenosis_mesh(pipe).text("4.1");
         return text.replace(text.find("$PhysicalNames\n3\n"), 17, "$PhysicalNames\n4\n2 30 \"wall\"\n");
       }(),
       {"\"wall\" has no cells", "mesh its surface"}},
  };
}

std::vector<BadMesh> cells() {
  return {
      {"out_of_plane",
       spoilt(triangle6, [](auto& m) { node_at(m, 1, 2).z = 0.1; }),
       {"z = 0.1", "(r, z) = (1, 2) cm", "plane of x = r and y = z"}},
      {"negative_radius",
       spoilt(triangle6, [](auto& m) { node_at(m, 0, 1).x = -0.01; }),
       {"(r, z) = (-0.01, 1) cm has a negative radius", "half plane"}},
      {"node_repeated",
       spoilt(triangle6, [](auto& m) { element_of(m, "wall").nodes[4] = element_of(m, "wall").nodes[0]; }),
       {"degenerate", "twice", "remesh"}},
      {"no_area",
       spoilt(quadrilateral4,
              [](auto& m) {
                node_at(m, 0.5, 1).y = 0;
                node_at(m, 0, 1).y = 0;
              }),
       {"degenerate", "area is 0 cm2", "(r, z)"}},
      {"crossed_corners",
       spoilt(quadrilateral9,
              [](auto& m) {
                std::swap(element_of(m, "blood", 1).nodes[1], element_of(m, "blood", 1).nodes[2]);
              }),
       {"degenerate"}},
      {"side_beyond_its_cell",
       spoilt(triangle6, [](auto& m) { node_at(m, 1, 0.5).x = 1.45; }),
       {"triangle", "is inverted", "determinant", "(r, z)", "Mesh.HighOrderOptimize"}},
      {"middle_at_its_end",
       spoilt(quadrilateral8, [](auto& m) { node_at(m, 1, 0.5).y = 0.1; }),
       {"quadrilateral", "is inverted", "(r, z) = (1, 0) cm"}},
      {"reentrant_corner",
       spoilt(quadrilateral4,
              [](auto& m) {
                node_at(m, 0.5, 1) = {node_at(m, 0.5, 1).tag, 0.15, 0.25, 0};
              }),
       {"is inverted", "smaller cells"}},
      {"cell_twice",
       spoilt(triangle6,
              [](auto& m) { m.elements.push_back(element_of(m, "wall")), m.elements.back().tag = 777; }),
       {"has the corners of triangle 777 at (r, z)", "duplicate cells", "one physical surface"}},
      {"three_cells_on_a_side",
       spoilt(quadrilateral4,
              [](auto& m) {
                m.nodes.push_back({900, 0.6, 3.8, 0});
                m.nodes.push_back({901, 0.6, 3.3, 0});
                const long a = node_at(m, 0.5, 3).tag, b = node_at(m, 0.5, 4).tag;
                m.elements.push_back({777, quadrilateral4, "blood", {a, 901, 900, b}});
              }),
       {"777", "overlap"}},
      {"folded_over",
       spoilt(quadrilateral4,
              [](auto& m) {
                m.nodes.push_back({900, 0.6, 3.5, 0});
                m.nodes.push_back({901, 0.9, 3.5, 0});
                m.elements.push_back(
                    {777, quadrilateral4, "blood", {900, 901, node_at(m, 1, 4).tag, node_at(m, 0.5, 4).tag}});
              }),
       {"777", "(0.75, 4) cm overlap", "each surface once"}},
      {"nodes_not_shared",
       spoilt(triangle6,
              [](auto& m) {
                // The wall gets nodes of its own on the interface, as of two surfaces that were never
                // united.
                const std::vector<GmshModel::Node> before = m.nodes;
                for (const auto& node : before) {
                  if (node.x != 1) continue;
                  m.nodes.push_back({node.tag + 1000, node.x, node.y, 0});
                  for (auto& element : m.elements)
                    if (element.name.starts_with("wall"))
                      std::replace(element.nodes.begin(), element.nodes.end(), node.tag, node.tag + 1000);
                }
              }),
       {"(r, z) = (1,", "do not share their nodes", "Coherence"}},
      {"hanging_node_of_linear_cells",
       spoilt(triangle3,
              [](auto& m) {
                // One of two triangles beside the side from (0.5, 1) to (0.5, 2) is halved, the other is
                // not.
                const long a = node_at(m, 0.5, 1).tag, b = node_at(m, 0.5, 2).tag;
                m.nodes.push_back({900, 0.5, 1.5, 0});
                for (std::size_t k = 0; k < m.elements.size(); ++k) {
                  auto& nodes = m.elements[k].nodes;
                  const auto has = [&](long tag) { return std::count(nodes.begin(), nodes.end(), tag) > 0; };
                  if (nodes.size() != 3 || !has(a) || !has(b)) continue;
                  auto half = m.elements[k];
                  half.tag = 777;
                  std::replace(nodes.begin(), nodes.end(), a, 900L);
                  std::replace(half.nodes.begin(), half.nodes.end(), b, 900L);
                  m.elements.push_back(half);
                  return;
                }
              }),
       {"(r, z) = (0.5, 1.5) cm hangs on a side", "Coherence"}},
      {"hanging_node_of_quadratic_cells",
       spoilt(quadrilateral8,
              [](auto& m) {
                // The middle of a side of blood becomes a corner of the wall.
                auto& nodes = element_of(m, "wall", 3).nodes;
                std::replace(nodes.begin(), nodes.end(), node_at(m, 1, 3).tag, node_at(m, 1, 2.5).tag);
              }),
       {"hanging node", "Coherence"}},
      {"two_middles",
       spoilt(triangle6,
              [](auto& m) {
                m.nodes.push_back({900, 1.01, 2.5, 0});
                for (auto& element : m.elements)
                  if (element.name == "wall")
                    std::replace(element.nodes.begin(), element.nodes.end(), node_at(m, 1, 2.5).tag, 900L);
              }),
       {"two middles", "900", "Coherence"}},
  };
}

std::vector<BadMesh> boundaries() {
  Stenosis pipe = straight(triangle6), wall = straight(triangle6);
  pipe.wall_cells = 0;
  wall.blood_cells = 0;
  Stenosis fine_pipe = pipe;
  fine_pipe.blood_cells = 4;
  return {
      {"no_outer",
       spoilt(triangle6, [](auto& m) { remove(m, "outer"); }),
       {"no physical curve \"outer\"", "outer surface of the wall"}},
      {"outer_misspelt",
       spoilt(triangle6, [](auto& m) { rename(m, "outer", "outter"); }),
       {"no physical curve \"outer\"", "now \"outter\"?"}},
      {"no_inlet",
       spoilt(
           pipe, [](auto& m) { remove(m, "inlet"); }, "2.2"),
       {"no physical curve \"inlet\"", "lower end of the blood"}},
      {"no_wall_outlet",
       spoilt(wall, [](auto& m) { remove(m, "wall_outlet"); }),
       {"no physical curve \"wall_outlet\"", "upper end of the wall"}},
      {"open_interface",
       spoilt(triangle6,
              [](auto& m) {
                // A gap of a thousandth between blood and wall.
                const std::vector<GmshModel::Node> before = m.nodes;
                for (const auto& node : before) {
                  if (node.x != 1) continue;
                  m.nodes.push_back({node.tag + 1000, 1.001, node.y, 0});
                  for (auto& element : m.elements)
                    if (element.name.starts_with("wall"))
                      std::replace(element.nodes.begin(), element.nodes.end(), node.tag, node.tag + 1000);
                }
              }),
       {"a side of blood", "the interface is open", "(r, z) = (1,", "share their nodes"}},
      {"outer_has_a_gap",
       spoilt(triangle6, [](auto& m) { element_of(m, "outer", 2).name = ""; }),
       {"a side of wall", "(1.5, 2.5) cm", "neither named \"outer\"", "name it"}},
      {"inlet_covers_the_wall",
       spoilt(triangle6,
              [](auto& m) {
                element_of(m, "wall_inlet").name = "inlet";
                m.elements.push_back({777, 1, "wall_inlet", {}});
                m.elements.back().nodes = {node_at(m, 1.5, 0).tag, node_at(m, 1.5, 1).tag};
                element_of(m, "outer").name = "";
              }),
       {"\"inlet\" covers the wall", "\"wall_inlet\""}},
      {"wall_inlet_covers_blood",
       spoilt(triangle6, [](auto& m) { element_of(m, "inlet").name = "wall_inlet"; }),
       {"\"wall_inlet\" covers blood", "name the blood's end \"inlet\""}},
      {"blood_reaches_the_outer_surface",
       spoilt(
           triangle6,
           [](auto& m) { element_of(m, "wall", 2).name = "blood", element_of(m, "wall", 3).name = "blood"; }),
       {"the blood reaches the outer surface", "(1.5, 2.5) cm", "let the wall lie between"}},
      {"pipe_named_outer",
       spoilt(
           pipe,
           [](auto& m) {
             for (int j = 0; j < 4; ++j)
               m.elements.push_back({700 + j, 1, "outer", {node_at(m, 1, j).tag, node_at(m, 1, j + 1).tag}});
           }),
       {"the blood reaches the outer surface", "blood alone", "\"interface\""}},
      {"wall_reaches_the_axis",
       spoilt(quadrilateral4,
              [](auto& m) {
                rename(m, "blood", "wall"), rename(m, "inlet", "wall_inlet"),
                    rename(m, "outlet", "wall_outlet");
              }),
       {"the wall reaches the axis", "(r, z) = (0, 0.5) cm", "leave a lumen"}},
      {"blood_is_an_annulus",
       spoilt(triangle6,
              [](auto& m) {
                for (auto& node : m.nodes) node.x += 0.1;
              }),
       {"the interface is open", "(0.1, 0.5) cm"}},
      {"pipe_is_an_annulus",
       spoilt(pipe,
              [](auto& m) {
                for (auto& node : m.nodes) node.x += 0.1;
              }),
       {"the blood has no axis", "inlet, interface, outlet, axis"}},
      {"axis_named_elsewhere",
       spoilt(triangle6,
              [](auto& m) {
                m.elements.push_back({777, 1, "axis", {node_at(m, 0.5, 0).tag, node_at(m, 0, 0).tag}});
                remove(m, "inlet");
                m.elements.push_back({778, 1, "inlet", {node_at(m, 0.5, 0).tag, node_at(m, 1, 0).tag}});
              }),
       {"\"axis\" leaves r = 0", "x = 0"}},
      {"inlet_on_the_axis",
       spoilt(triangle6,
              [](auto& m) {
                m.elements.push_back({777, 1, "inlet", {node_at(m, 0, 0).tag, node_at(m, 0, 1).tag}});
              }),
       {"\"inlet\" runs along the axis", "(0, 0.5) cm"}},
      {"outlet_inside",
       spoilt(triangle6,
              [](auto& m) {
                m.elements.push_back({777, 1, "outlet", {node_at(m, 0, 2).tag, node_at(m, 0.5, 2).tag}});
              }),
       {"\"outlet\" runs inside the blood", "(0.25, 2) cm"}},
      {"outer_on_the_interface",
       spoilt(triangle6,
              [](auto& m) {
                m.elements.push_back({777, 1, "outer", {node_at(m, 1, 2).tag, node_at(m, 1, 3).tag}});
              }),
       {"\"outer\" runs between blood and wall", "(1, 2.5) cm"}},
      {"line_is_no_side",
       spoilt(triangle6,
              [](auto& m) {
                m.elements.push_back({777, 1, "inlet", {node_at(m, 0, 0).tag, node_at(m, 1, 0).tag}});
              }),
       {"line 777 of \"inlet\"", "no side of a cell", "together"}},
      {"two_names",
       spoilt(triangle6,
              [](auto& m) {
                m.elements.push_back(element_of(m, "outlet")), m.elements.back().name = "wall_outlet";
              }),
       {"both \"outlet\" and \"wall_outlet\"", "one of these names"}},
      {"two_names_of_an_entity",
       replaced("4.1", "\n1 0 0 0 1 1 0 1 1 0\n", "\n1 0 0 0 1 1 0 2 1 2 0\n"),
       {"both \"inlet\" and \"outer\""}},
      {"ends_swapped",
       spoilt(triangle6,
              [](auto& m) {
                rename(m, "inlet", "x");
                rename(m, "outlet", "inlet");
                rename(m, "x", "outlet");
              }),
       {"the inlet lies above the outlet", "swap"}},
      {"wall_ends_swapped",
       spoilt(wall,
              [](auto& m) {
                rename(m, "wall_inlet", "x");
                rename(m, "wall_outlet", "wall_inlet");
                rename(m, "x", "wall_outlet");
              }),
       {"the wall_inlet lies above the wall_outlet", "swap"}},
      {"hole_in_the_blood",
       spoilt(fine_pipe,
              [](auto& m) {
                // The triangles about a corner inside.
                const long middle = node_at(m, 0.5, 2).tag;
                std::erase_if(m.elements, [&](const auto& element) {
                  return element.name == "blood" &&
                         std::count(element.nodes.begin(), element.nodes.end(), middle) > 0;
                });
              }),
       {"the blood is not one piece without holes", "(r, z)"}},
      {"outer_in_two_stretches",
       spoilt(wall, [](auto& m) { element_of(m, "outer", 1).name = ""; }),
       {"outline of the wall passes wall_inlet, outer, interface, outer, wall_outlet, interface",
        "each once"}},
      {"touches_itself",
       spoilt(pipe,
              [](auto& m) {
                // Of the four squares about (0.5, 2) two that are opposite to each other go.
                std::erase_if(m.elements, [&](const auto& e) {
                  if (e.name != "blood") return false;
                  double r = 0, z = 0;
                  for (int i = 0; i < 3; ++i)
                    for (const auto& node : m.nodes)
                      if (node.tag == e.nodes[i]) r += node.x / 3, z += node.y / 3;
                  return (r > 0.5 && z > 1 && z < 2) || (r < 0.5 && z > 2 && z < 3);
                });
              }),
       {"touches itself with a corner at (r, z) = (0.5, 2) cm"}},
      {"two_pieces",
       spoilt(wall,
              [](auto& m) {
                std::erase_if(m.elements, [&](const auto& e) {
                  return std::any_of(m.nodes.begin(), m.nodes.end(), [&](const auto& node) {
                    return node.x > 1 && node.y == 1.5 &&
                           std::count(e.nodes.begin(), e.nodes.end(), node.tag) > 0;
                  });
                });
              }),
       {"the wall is not one piece", "a second outline passes (r, z)"}},
  };
}

}  // namespace

const std::vector<BadMesh>& bad_meshes() {
  static const std::vector<BadMesh> all = [] {
    std::vector<BadMesh> list;
    for (const auto& some : {files(), parts(), cells(), boundaries()})
      list.insert(list.end(), some.begin(), some.end());
    return list;
  }();
  return all;
}

}  // namespace tunica::test_support
