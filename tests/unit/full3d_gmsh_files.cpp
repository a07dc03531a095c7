// SPDX-License-Identifier: GPL-3.0-or-later
// Files that Gmsh 4.8.4 wrote from the scripts in tests/meshes, as text and in bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <utility>

#include "core/element/gmsh_file.hpp"
#include "core/error.hpp"
#include "full3d/gmsh.hpp"
#include "full3d/measures.hpp"

namespace {

using namespace tunica;
using namespace tunica::full3d;
using element::GmshFile;

const std::filesystem::path meshes = std::filesystem::path(TUNICA_SOURCE_DIR) / "tests" / "meshes";

std::string content(const std::string& name) {
  return element::load_gmsh(meshes / (name + ".msh"));
}

class FileInBytes : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(, FileInBytes, testing::Values("square_tube_2_2", "square_tube_4_1"),
                         [](const auto& instance) { return std::string(instance.param); });

TEST_P(FileInBytes, SaysWhatItsTextSays) {
  const std::string name = GetParam();
  const GmshFile text = element::parse_gmsh_file(content(name), "text", 3),
                 bytes = element::parse_gmsh_file(content(name + "_binary"), "bytes", 3);
  ASSERT_GT(text.nodes.size(), 80U);
  ASSERT_EQ(bytes.nodes.size(), text.nodes.size());
  ASSERT_EQ(bytes.elements.size(), text.elements.size());
  EXPECT_EQ(bytes.is_old, text.is_old);
  // Format 2.2 orders elements by type in bytes, and by entity as text.
  const auto by_tag = [](const GmshFile& file) {
    std::map<long, const GmshFile::Element*> elements;
    for (const auto& element : file.elements) elements[element.tag] = &element;
    return elements;
  };
  const auto expected = by_tag(text), found = by_tag(bytes);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < text.nodes.size(); ++k) {
    EXPECT_EQ(bytes.nodes[k].tag, text.nodes[k].tag);
    // Text has 16 digits.
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(bytes.nodes[k].position[i], text.nodes[k].position[i], 1e-15);
  }
  for (const auto& [tag, element] : expected) {
    ASSERT_TRUE(found.contains(tag)) << tag;
    const auto& other = *found.at(tag);
    EXPECT_EQ(other.dimension, element->dimension);
    EXPECT_EQ(other.count, element->count);
    EXPECT_EQ(other.nodes, element->nodes) << tag;
    EXPECT_EQ(bytes.groups[other.group].names, text.groups[element->group].names) << tag;
    EXPECT_EQ(bytes.groups[other.group].tags, text.groups[element->group].tags) << tag;
  }
}

TEST_P(FileInBytes, IsTheVesselThatTheScriptDraws) {
  const std::filesystem::path file = meshes / (std::string(GetParam()) + "_binary.msh");
  EXPECT_EQ(element::gmsh_dimensions(file), 3);
  const Mesh mesh = read_gmsh(file);
  EXPECT_NEAR(volume(mesh, Part::blood), 2, 1e-12);
  EXPECT_NEAR(volume(mesh, Part::wall), 6, 1e-12);
  EXPECT_NEAR(surface(mesh, Boundary::inlet).area, 1, 1e-12);
  EXPECT_NEAR(surface(mesh, Boundary::wall_outlet).area, 3, 1e-12);
  EXPECT_NEAR(surface(mesh, Boundary::interface).area, 8, 1e-12);
  EXPECT_NEAR(surface(mesh, Boundary::outer).area, 16, 1e-12);
}

/// Parses what may be damaged: nothing but a one-line refusal may come of it.
bool accepts(const std::string& text) {
  try {
    parse_gmsh(text, "mesh file bad.msh");
    return true;
  } catch (const InvalidInput& error) {
    const std::string message = error.what();
    EXPECT_TRUE(message.starts_with("mesh file bad.msh")) << message;
    EXPECT_EQ(message.find_first_of("\r\n"), std::string::npos) << message;
    return false;
  }
}

TEST_P(FileInBytes, IsRefusedWhereItIsCutOff) {
  const std::string whole = content(std::string(GetParam()) + "_binary");
  ASSERT_TRUE(accepts(whole));
  const std::size_t end = whole.rfind("$EndElements") + std::string("$EndElements").size();
  for (std::size_t length = 0; length < end; length += 61)
    EXPECT_FALSE(accepts(whole.substr(0, length))) << length;
  EXPECT_FALSE(accepts(whole.substr(0, end - 1)));
}

// Counts, tags and coordinates alike: nothing is allocated or looked up on the word of a number.
TEST_P(FileInBytes, IsNotTrustedWhereItIsDamaged) {
  const std::string whole = content(std::string(GetParam()) + "_binary");
  const std::int64_t values[] = {-1, INT64_MAX, INT64_MIN, 0x7fffffff7fffffff, 1LL << 40, 0};
  int refused = 0, tried = 0;
  for (std::size_t at = 0; at + sizeof values[0] < whole.size(); at += 11) {
    std::string text = whole;
    std::memcpy(text.data() + at, &values[tried % std::size(values)], sizeof values[0]);
    refused += accepts(text) ? 0 : 1;
    ++tried;
  }
  // Coordinates may be set to 0, and tags that nobody looks at to anything.
  EXPECT_GT(refused, tried / 2);
}

TEST(FileWithoutNames, IsToldFromAHalfPlaneInBytesToo) {
  for (const char* name : {"square_tube_2_2_binary", "square_tube_4_1_binary"}) {
    std::string text = content(name);
    const std::size_t begin = text.find("$PhysicalNames"), end = text.find("$EndPhysicalNames\n") + 18;
    const auto file = std::filesystem::path(testing::TempDir()) / (std::string(name) + "_without.msh");
    std::ofstream(file, std::ios::binary) << text.erase(begin, end - begin);
    EXPECT_EQ(element::gmsh_dimensions(file), 3) << name;
    std::filesystem::remove(file);
    EXPECT_FALSE(accepts(text));
  }
}

}  // namespace
