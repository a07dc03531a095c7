// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "axisym/gmsh.hpp"
#include "axisym/mesh_check.hpp"
#include "axisym/setup.hpp"
#include "core/error.hpp"
#include "tests/support/bad_meshes.hpp"
#include "tests/support/gmsh_model.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace tunica;
using namespace tunica::axisym;
using namespace tunica::test_support;

/// The message with which a file is refused, empty if it is not.
std::string refusal(const std::string& text) {
  try {
    parse_gmsh(text, "mesh file bad.msh");
    return {};
  } catch (const InvalidInput& error) {
    return error.what();
  }
}

class Refused : public testing::TestWithParam<BadMesh> {};

INSTANTIATE_TEST_SUITE_P(Gmsh, Refused, testing::ValuesIn(bad_meshes()),
                         [](const auto& test) { return test.param.name; });

TEST_P(Refused, WithOneLineThatHelps) {
  const std::string message = refusal(GetParam().text);
  EXPECT_TRUE(message.starts_with("mesh file bad.msh")) << message;
  EXPECT_EQ(message.find_first_of("\r\n"), std::string::npos) << message;
  for (const std::string& word : GetParam().words)
    EXPECT_NE(message.find(word), std::string::npos) << message << "\nhas not: " << word;
}

TEST(GmshRefusals, CoverFilesThatAreNone) {
  const TemporaryFolder folder;
  const auto expect = [](const std::filesystem::path& file, const char* word) {
    try {
      read_gmsh(file);
      ADD_FAILURE() << file;
    } catch (const InvalidInput& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  expect(folder.path() / "none.msh", "does not exist");
  expect(folder.path(), "is a folder");
  std::ofstream(folder.path() / "artery.msh")
      << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 zero 0\n";
  expect(folder.path() / "artery.msh", "artery.msh, line 6: y (the height) = \"zero\" is not a number");
  expect(folder.path() / "artrey.msh", "artery.msh?");
}

TEST(GmshRefusals, CoverEveryTruncation) {
  Stenosis shape;
  shape.width = shape.length;
  shape.blood_cells = shape.wall_cells = 1;
  shape.axial_cells = 2;
  for (const char* version : {"2.2", "4.1"}) {
    const std::string text = stenosis_mesh(shape).text(version);
    ASSERT_EQ(refusal(text), "");
    const std::size_t end = text.rfind("$EndElements") + std::string("$EndElements").size();
    for (std::size_t length = 0; length < end; ++length)
      ASSERT_NE(refusal(text.substr(0, length)), "") << version << ", " << length << " bytes";
  }
}

/// Any text makes a mesh that can be computed with, or a message of one line.
TEST(GmshRefusals, CoverRandomDamage) {
  const char* given = std::getenv("TUNICA_SEED");
  const unsigned long seed = given ? std::strtoul(given, nullptr, 10) : 20220607;
  SCOPED_TRACE("damage of TUNICA_SEED=" + std::to_string(seed));
  RecordProperty("seed", std::to_string(seed));
  std::mt19937_64 engine(seed);
  const auto below = [&](std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(engine);
  };
  const std::vector<std::string> words = {"0",
                                          "-1",
                                          "1",
                                          "2",
                                          "3",
                                          "7",
                                          "99999999999",
                                          "nan",
                                          "1e308",
                                          "-0.0001",
                                          "0.0165",
                                          "$Nodes",
                                          "$End",
                                          "\"wall\"",
                                          "9223372036854775807",
                                          "-9223372036854775808",
                                          "",
                                          "\n",
                                          "x"};
  int accepted = 0, refused = 0;
  for (int trial = 0; trial < 6000; ++trial) {
    Stenosis shape;
    shape.blood_cells = 1 + static_cast<int>(below(2));
    shape.wall_cells = 1;
    shape.axial_cells = 2;
    shape.width = shape.length;
    constexpr int types[] = {triangle3, triangle6, quadrilateral4, quadrilateral8, quadrilateral9};
    shape.type = types[below(5)];
    std::string text = stenosis_mesh(shape).text(below(2) == 0 ? "2.2" : "4.1");
    for (std::size_t damages = 1 + below(3); damages > 0; --damages) {
      const std::size_t at = text.find_first_not_of(" \n", below(text.size()));
      if (at == std::string::npos) continue;
      const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
      if (below(4) == 0)
        text[at] = static_cast<char>(below(256));
      else if (below(6) == 0)
        text.erase(at, below(200));
      else
        text.replace(at, end - at, words[below(words.size())]);
    }
    try {
      const Mesh mesh = parse_gmsh(text, "damaged");
      check_cells(mesh, "damaged");
      check_outline(mesh, "damaged");
      for (const Cell& cell : mesh.cells)
        for (int n = 0; n < mesh.nodes_per_cell(); ++n) {
          ASSERT_GE(cell.nodes[n], 0);
          ASSERT_LT(cell.nodes[n], static_cast<int>(mesh.points.size()));
        }
      ++accepted;
    } catch (const InvalidInput& error) {
      const std::string message = error.what();
      ASSERT_EQ(message.find_first_of("\r\n"), std::string::npos) << message;
      ASSERT_TRUE(message.starts_with("damaged")) << message;
      ++refused;
    }
  }
  // Both ends of the matter have been seen: damage that does no harm (a tag, a bounding box), and the rest.
  EXPECT_GT(accepted, 100);
  EXPECT_GT(refused, 3000);
}

/// Why a scene is refused before anything is computed; empty when it is not.
std::string refusal(const Scene& scene) {
  try {
    setup_of(scene);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

// Flatness of the ends is asked for where a velocity is prescribed and where they slide.
TEST(UnevenEnds, AreRefusedWhereFlatnessIsUsed) {
  const test_support::TemporaryFolder folder;
  test_support::GmshModel model = test_support::stenosis_mesh({});
  for (auto& node : model.nodes) {
    if (node.y == 0) node.y = 3e-4 * std::cos(200 * node.x);
    if (node.y == test_support::Stenosis{}.length) node.y += 3e-4 * std::cos(200 * node.x);
  }
  std::ofstream(folder.path() / "a.msh") << model.text("4.1");
  std::ofstream(folder.path() / "a.toml") << "[geometry]\nkind = \"mesh\"\nfile = \"a.msh\"\n";
  const auto scene = [&](const std::vector<std::string>& settings) {
    return read_scene(folder.path() / "a.toml", settings);
  };
  EXPECT_EQ(refusal(scene({"inlet.waveform=pressure"})), "");
  EXPECT_EQ(refusal(scene({"inlet.waveform=pressure", "time.mode=static"})), "");
  EXPECT_EQ(refusal(scene({"inlet.profile=natural"})), "");
  EXPECT_NE(refusal(scene({})).find("the inlet is no plane z = const"), std::string::npos)
      << refusal(scene({}));
  const std::string sliding = refusal(scene({"inlet.waveform=pressure", "geometry.ends=sliding"}));
  EXPECT_NE(sliding.find("accuracy.tolerance allows 0.01; draw it flat"), std::string::npos) << sliding;
}

}  // namespace
