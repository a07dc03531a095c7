// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <limits>
#include <string>

#include "core/element/gmsh_file.hpp"
#include "core/element/gmsh_format.hpp"
#include "core/error.hpp"

namespace tunica::element {

namespace {

using Width = GmshReader::Width;

constexpr long least = std::numeric_limits<long>::min(), most = std::numeric_limits<long>::max();

int of_names(GmshReader& reader) {
  int dimensions = 0;
  const long count = reader.count("the number of physical names");
  for (long k = 0; k < count; ++k) {
    dimensions = std::max(dimensions, static_cast<int>(reader.integer("the dimension of a name", 0, 3)));
    reader.integer("the tag of a name", least, most);
    reader.quoted("a name");
  }
  return dimensions;
}

int of_entities(GmshReader& reader, const GmshFormat& format) {
  if (format.is_binary) reader.bytes_follow();
  int dimensions = 0;
  for (int dimension = 0; dimension < 4; ++dimension)
    if (reader.count("the number of entities", Width::eight) > 0) dimensions = dimension;
  return dimensions;
}

/// Of elements in format 2.2, up to the first of an unknown type.
int of_elements(GmshReader& reader, const GmshFormat& format) {
  int dimensions = 0;
  const long count = reader.count("the number of elements");
  if (format.is_binary) reader.bytes_follow();
  for (long k = 0; k < count;) {
    if (!format.is_binary) reader.integer("the tag of an element", least, most);
    const GmshType* const type = gmsh_type(reader.integer("the type of an element", least, most));
    if (!type) break;
    dimensions = std::max(dimensions, type->dimension);
    if (dimensions == 3) break;
    // In bytes elements of a type follow each other, with their tags.
    const long same = format.is_binary ? reader.count("the number of elements in a block", Width::four) : 1;
    const long tags = reader.count("the number of tags of an element", Width::four);
    const long each = (format.is_binary ? 1 : 0) + tags + type->nodes;
    for (long i = 0; i < same * each; ++i) reader.integer("a number of an element", least, most);
    k += std::max(same, 1L);
  }
  return dimensions;
}

}  // namespace

int gmsh_dimensions(const std::filesystem::path& file) {
  int dimensions = 0;
  try {
    const std::string text = load_gmsh(file);
    GmshReader reader(text, gmsh_label(file));
    const GmshFormat format = read_gmsh_format(reader);
    while (!reader.at_end() && dimensions < 3) {
      std::string section(reader.word());
      if (!section.starts_with('$')) break;
      section.erase(0, 1);
      reader.enter(section);
      int found = 0;
      if (section == "PhysicalNames")
        found = of_names(reader);
      else if (section == "Entities" && !format.is_old)
        found = of_entities(reader, format);
      else if (section == "Elements" && format.is_old)
        found = of_elements(reader, format);
      dimensions = std::max(dimensions, found);
      if (dimensions < 3) reader.skip_section(section);
    }
  } catch (const InvalidInput&) {
    // Who reads the mesh says what is wrong with it; what was found up to there says who may.
  }
  return dimensions;
}

}  // namespace tunica::element
