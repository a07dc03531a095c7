// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace tunica::test_support {

/// A Gmsh file that must be refused with one line that helps its author.
struct BadMesh {
  std::string name;  ///< letters, digits and underscores
  std::string text;
  std::vector<std::string> words;  ///< what the message must contain: what, where, the remedy
};

/// Files that cannot be read, and meshes that can be read but not computed with.
const std::vector<BadMesh>& bad_meshes();

/// GoogleTest would print the bytes otherwise.
inline std::ostream& operator<<(std::ostream& stream, const BadMesh& mesh) {
  return stream << mesh.name;
}

}  // namespace tunica::test_support
