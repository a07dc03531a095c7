// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "full3d/gmsh.hpp"
#include "full3d/inlet_profile.hpp"
#include "full3d/measures.hpp"
#include "tests/support/solid_cases.hpp"
#include "tests/support/solid_gmsh.hpp"

namespace {

using namespace tunica;
using namespace tunica::full3d;
using test_support::GmshModel;

struct Spoilt {
  const char* name;
  std::function<void(GmshModel&)> spoil;
  std::vector<std::string> words;
};

/// Elements of a group, by pointer.
std::vector<GmshModel::Element*> group(GmshModel& model, const std::string& name) {
  std::vector<GmshModel::Element*> found;
  for (auto& element : model.elements)
    if (element.name == name) found.push_back(&element);
  return found;
}
void rename(GmshModel& model, const std::string& from, const std::string& to) {
  for (auto* element : group(model, from)) element->name = to;
}
void drop(GmshModel& model, const std::string& name) {
  std::erase_if(model.elements, [&](const auto& element) { return element.name == name; });
}
/// Gives an element nodes of its own in place of some.
void separate(GmshModel& model, GmshModel::Element& element) {
  for (long& tag : element.nodes) {
    auto node =
        *std::find_if(model.nodes.begin(), model.nodes.end(), [&](const auto& n) { return n.tag == tag; });
    node.tag = tag = model.nodes.back().tag + 1;
    model.nodes.push_back(node);
  }
}

const std::vector<Spoilt>& spoilt() {
  static const std::vector<Spoilt> all{
      {"no_volumes",
       [](GmshModel& m) {
         drop(m, "blood");
         drop(m, "wall");
       },
       {"no tetrahedron and no hexahedron", "gmsh -3"}},
      {"mixed_shapes",
       [](GmshModel& m) {
         auto& e = *group(m, "wall").front();
         e.type = 4;
         e.nodes = {e.nodes[0], e.nodes[1], e.nodes[3], e.nodes[4]};
       },
       {"the mesh has 1 tetrahedra (wall), 55 hexahedra (blood, wall)", "leave out every Recombine"}},
      // What boundary layers, and walls that are extruded with Recombine about a blood without, are.
      {"hexahedra_around_tetrahedra",
       [](GmshModel& m) {
         for (auto* e : group(m, "blood")) {
           e->type = 4;
           e->nodes = {e->nodes[0], e->nodes[1], e->nodes[3], e->nodes[4]};
         }
       },
       {"the mesh has 24 tetrahedra (blood), 32 hexahedra (wall);", "leave out every Recombine"}},
      {"prisms",
       [](GmshModel& m) {
         for (const char* name : {"blood", "wall"})
           for (auto* e : group(m, name)) {
             e->type = 18;
             e->nodes.resize(15);
           }
       },
       {"the mesh has 56 prisms (blood, wall);", "tetrahedra, or all hexahedra", "Extrude {...}"}},
      {"pyramids",
       [](GmshModel& m) {
         auto& e = *group(m, "wall").front();
         e.type = 7;
         e.nodes.resize(5);
       },
       {"the mesh has 55 hexahedra (blood, wall), 1 pyramids (wall);", "leave out every Recombine"}},
      {"order_three",
       [](GmshModel& m) {
         auto& e = *group(m, "wall").front();
         e.type = 29;
         e.nodes.resize(20);
       },
       {"line", "has the type 29 of order 3", "Mesh.ElementOrder = 2 or 1"}},
      {"capitals",
       [](GmshModel& m) { rename(m, "wall", "Wall"); },
       {"the physical volume \"Wall\" is unknown", "did you mean wall?"}},
      {"capital_surface",
       [](GmshModel& m) { rename(m, "inlet", "INLET"); },
       {"no physical surface \"inlet\"", "(now \"INLET\"?)"}},
      {"no_names_of_volumes",
       [](GmshModel& m) {
         rename(m, "wall", "");
         rename(m, "blood", "");
       },
       {"no physical volume that has cells has a name", "the names \"inlet\", \"outer\"",
        "name the volumes \"blood\" and \"wall\""}},
      // A plaque: a part of the inner layer is of the outer one's tissue.
      {"part_of_a_layer",
       [](GmshModel& m) {
         const auto wall = group(m, "wall");
         for (std::size_t k = 0; k < wall.size(); ++k) wall[k]->name = k == 0 ? "wall:1" : "wall:2";
       },
       {"wall:", "a plaque, is not computed", "give it the layer's name"}},
      {"unnamed_cells",
       [](GmshModel& m) { rename(m, "wall", ""); },
       {"hexahedron", "in no named part", "physical volume"}},
      {"misspelt_part",
       [](GmshModel& m) { rename(m, "wall", "wal"); },
       {"the physical volume \"wal\" is unknown", "did you mean wall?"}},
      {"blood_alone",
       [](GmshModel& m) {
         drop(m, "wall");
         drop(m, "outer");
         drop(m, "wall_inlet");
         drop(m, "wall_outlet");
       },
       {"there is no wall", "physical volume \"wall\""}},
      {"no_inlet",
       [](GmshModel& m) { rename(m, "inlet", "inflow"); },
       {"no physical surface \"inlet\"", "where blood comes in"}},
      {"misspelt_outlet",
       [](GmshModel& m) { rename(m, "outlet", "oulet"); },
       {"no physical surface \"outlet\"", "(now \"oulet\"?)"}},
      {"open_outer",
       [](GmshModel& m) { group(m, "outer").front()->name = ""; },
       {"a face of wall at (x, y, z) = (", "neither named (\"outer\", \"wall_inlet\", \"wall_outlet\")"}},
      {"inlet_on_the_wall",
       [](GmshModel& m) { group(m, "wall_inlet").front()->name = "inlet"; },
       {"the surface \"inlet\" bounds wall cells", "\"wall_inlet\""}},
      {"cells_apart",
       [](GmshModel& m) { separate(m, *group(m, "wall").front()); },
       {"two nodes at (x, y, z) = (", "Coherence"}},
      {"cell_twice",
       [](GmshModel& m) {
         m.elements.push_back(*group(m, "wall").front());
         m.elements.back().tag = 100000;
       },
       {"hexahedron", "overlap"}},
      {"node_twice",
       [](GmshModel& m) {
         auto& nodes = group(m, "wall").front()->nodes;
         nodes[1] = nodes[0];
       },
       {"degenerate", "twice"}},
      {"flat_cell",
       [](GmshModel& m) {
         for (const long tag : group(m, "wall").front()->nodes)
           for (auto& node : m.nodes)
             if (node.tag == tag) node.z = 0;
       },
       {"degenerate", "no volume"}},
      {"folded_cell",
       [](GmshModel& m) {
         // The middle of an edge far beyond its end.
         const auto nodes = group(m, "wall").front()->nodes;
         for (auto& node : m.nodes)
           if (node.tag == nodes[8]) {
             node.x *= 1.37;
             node.y *= 1.37;
           }
       },
       {"turned inside out or folded", "Mesh.ElementOrder = 1"}},
      {"middle_elsewhere",
       [](GmshModel& m) {
         auto& nodes = group(m, "blood").front()->nodes;
         std::swap(nodes[8], nodes[9]);
       },
       {"a hanging node", "Coherence"}},
      {"two_names",
       [](GmshModel& m) {
         auto face = *group(m, "outer").front();
         face.tag = 100000;
         face.name = "wall_inlet";
         m.elements.push_back(face);
       },
       {"is both \"outer\" and \"wall_inlet\""}},
      {"face_of_no_cell",
       [](GmshModel& m) {
         std::swap(group(m, "outer").front()->nodes[0], group(m, "inlet").front()->nodes[0]);
       },
       {"is no face of a cell", "surfaces and volumes together"}},
      {"outlet_in_pieces",
       [](GmshModel& m) {
         // What is named twice is one boundary, in two places.
         rename(m, "outlet", "inlet");
         auto* const back = group(m, "inlet").back();
         back->name = "outlet";
       },
       {"the surface \"inlet\" is in several pieces", "cut branches off"}},
      {"layers_the_wrong_way",
       [](GmshModel& m) {
         const auto wall = group(m, "wall");
         for (std::size_t k = 0; k < wall.size(); ++k) wall[k]->name = k % 2 == 0 ? "wall:2" : "wall:1";
       },
       {"wall:", "from the lumen outwards"}},
      {"axis_in_space",
       [](GmshModel& m) { group(m, "outer").front()->name = "axis"; },
       {"no physical surface \"axis\""}},
  };
  return all;
}

class RefusedMeshInSpace : public testing::TestWithParam<Spoilt> {};
INSTANTIATE_TEST_SUITE_P(, RefusedMeshInSpace, testing::ValuesIn(spoilt()),
                         [](const auto& instance) { return instance.param.name; });

GmshModel vessel() {
  VesselSpec spec = test_support::coarse_vessel(test_support::solid_cases[0], Sector::full, 0.8);
  spec.wall_cells = 2;
  return test_support::gmsh_model(o_grid_vessel(spec));
}

TEST_P(RefusedMeshInSpace, WithOneLineThatHelps) {
  for (const char* version : {"2.2", "4.1"}) {
    GmshModel model = vessel();
    GetParam().spoil(model);
    try {
      parse_gmsh(model.text(version), "mesh file bad.msh");
      ADD_FAILURE() << "not refused";
    } catch (const InvalidInput& error) {
      const std::string message = error.what();
      EXPECT_TRUE(message.starts_with("mesh file bad.msh")) << message;
      EXPECT_EQ(message.find_first_of("\r\n"), std::string::npos) << message;
      for (const std::string& word : GetParam().words)
        EXPECT_NE(message.find(word), std::string::npos) << message << "\nhas not: " << word;
    }
  }
}

std::string refusal(const std::string& text) {
  try {
    parse_gmsh(text, "mesh file bad.msh");
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "not refused";
}

/// A section with a line in place of what it has.
std::string without(std::string text, const std::string& section) {
  const std::size_t begin = text.find("$" + section), end = text.find("$End" + section);
  return text.erase(begin, end + section.size() + 5 - begin);
}

TEST(MeshInSpaceWithoutNames, SaysWhatItHasAndWhatIsNeeded) {
  for (const char* version : {"2.2", "4.1"}) {
    const std::string message = refusal(without(vessel().text(version), "PhysicalNames"));
    for (const char* words :
         {"the file has physical volumes 6, 7 and physical surfaces 1, 2, 3, 4, 5, and no names",
          "name the volumes \"blood\" and \"wall\"", "Physical Volume(\"wall\") = {2};",
          "\"inlet\" and \"outlet\" of the blood, \"outer\", \"wall_inlet\" and \"wall_outlet\" of the wall"})
      EXPECT_NE(message.find(words), std::string::npos) << version << ": " << message;
  }
}

// Format 2.2 with Mesh.SaveAll = 1: the names are there, and all tags are 0.
TEST(MeshInSpaceThatIsSavedWhole, SaysHowToSaveItsGroups) {
  const GmshModel named = vessel();
  GmshModel bare = named;
  for (auto& element : bare.elements) element.name.clear();
  const std::string text = named.text("2.2");
  const std::size_t nodes = text.find("$Nodes");
  const std::string whole = text.substr(0, nodes) + bare.text("2.2").substr(bare.text("2.2").find("$Nodes"));
  const std::string message = refusal(whole);
  EXPECT_NE(message.find("but no element is in a group"), std::string::npos) << message;
  EXPECT_NE(message.find("\"blood\""), std::string::npos) << message;
  EXPECT_NE(message.find("Mesh.SaveAll = 0, or with Mesh.MshFileVersion = 4.1"), std::string::npos)
      << message;
}

TEST(MeshInSpaceThatIsCutOff, IsRefused) {
  const std::string text = vessel().text("4.1");
  const std::size_t end = text.rfind("$EndElements") + std::string("$EndElements").size();
  for (std::size_t length = 0; length < end; length += 97)
    EXPECT_THROW(parse_gmsh(text.substr(0, length), "mesh file bad.msh"), InvalidInput) << length;
}

TEST(InletThatIsNoPlane, IsRefusedBeyondTheTolerance) {
  Mesh mesh = o_grid_vessel(test_support::coarse_vessel(test_support::solid_cases[0], Sector::full));
  for (Point& x : mesh.points) x[2] += 0.05 * x[0] * x[0];
  // The slope is 0.1 x, of which the mean square over the circle is 0.01/4.
  EXPECT_NEAR(inclination(surface(mesh, Boundary::inlet)), 0.05, 0.002);
  EXPECT_THROW(InletProfile(mesh, 1e-3), InvalidInput);
  EXPECT_NO_THROW(InletProfile(mesh, 2e-3));
}

TEST(InletInAPlane, HasACoordinateOrNone) {
  Mesh mesh = o_grid_vessel(test_support::coarse_vessel(test_support::solid_cases[0], Sector::full));
  EXPECT_EQ(normal_axis(mesh, Boundary::inlet, 1e-3), 2);
  EXPECT_EQ(inclination(surface(mesh, Boundary::inlet)), 0);
  for (Point& x : mesh.points) x = {x[2], x[0], x[1]};
  EXPECT_EQ(normal_axis(mesh, Boundary::inlet, 1e-3), 0);
  for (Point& x : mesh.points) x = {0.8 * x[0] - 0.6 * x[1], 0.6 * x[0] + 0.8 * x[1], x[2]};
  EXPECT_EQ(normal_axis(mesh, Boundary::inlet, 1e-3), -1);
}

TEST(OuterSurface, IsLargerThanTheInnerOne) {
  VesselSpec spec = test_support::coarse_vessel(test_support::solid_cases[0], Sector::full);
  spec.blood = false;
  Mesh mesh = o_grid_vessel(spec);
  for (Face& face : mesh.faces)
    if (face.boundary == Boundary::outer)
      face.boundary = Boundary::interface;
    else if (face.boundary == Boundary::interface)
      face.boundary = Boundary::outer;
  EXPECT_THROW(mean_tube(mesh), InvalidInput);
}

}  // namespace
