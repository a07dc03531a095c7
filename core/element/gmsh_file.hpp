// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tunica::element {

/// What a Gmsh file says, before any of it is given a meaning.
struct GmshFile {
  struct Node {
    long tag;
    std::array<double, 3> position;
  };
  /// A line, triangle, quadrilateral, tetrahedron, hexahedron, prism or pyramid of order 1 or 2, its nodes in
  /// Gmsh's order.
  struct Element {
    long tag;
    int dimension;              ///< 1 to 3
    int corners;                ///< 2 to 8
    int count;                  ///< of nodes
    std::array<int, 27> nodes;  ///< places in GmshFile::nodes
    int group;                  ///< place in GmshFile::groups
  };

  std::string label;  ///< names the file in messages
  std::vector<Node> nodes;
  std::vector<Element> elements;
  /// The physical groups that an element is in, each set of them once.
  struct Group {
    int dimension;
    std::vector<long> tags;
    std::vector<std::string> names;  ///< of those that have one
  };
  std::vector<Group> groups;
  bool is_old = false;  ///< format 2.2, in which elements have one physical group at most

  /// All names of physical groups of a dimension, whether or not they hold elements.
  std::vector<std::string> names(int dimension) const;
  struct Name {
    int dimension;
    long tag;
    std::string text;
  };
  std::vector<Name> physical_names;
};

/// Reads the formats 2.2 and 4.1, as text or in bytes, of a mesh whose cells have so many dimensions, 2 or 3:
/// they and what bounds them are kept. Nothing is allocated on the word of a count. Throws InvalidInput with
/// file, line (byte) and remedy for other formats, bytes of another machine, partitioned files, files that
/// end early, what is no number, coordinates that are not finite or beyond 10 km, elements other than those
/// above, nodes that are missing or defined twice.
GmshFile parse_gmsh_file(std::string_view text, const std::string& label, int dimensions);

/// The content of a file, refused when there is none; `label` names it in messages.
std::string load_gmsh(const std::filesystem::path& file);
std::string gmsh_label(const std::filesystem::path& file);

/// The largest dimension that the file names a physical group of, or has an entity (format 4.1) or an element
/// (2.2) of; 0 if it cannot be read.
int gmsh_dimensions(const std::filesystem::path& file);

}  // namespace tunica::element
