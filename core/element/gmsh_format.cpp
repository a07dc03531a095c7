// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/element/gmsh_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <string>

#include "core/scene/message.hpp"

namespace tunica::element {

namespace {

constexpr GmshType types[] = {{15, 0, 1, 1, 1},  {1, 1, 2, 2, 1},   {8, 1, 2, 3, 2},   {26, 1, 2, 4, 3},
                              {2, 2, 3, 3, 1},   {9, 2, 3, 6, 2},   {20, 2, 3, 9, 3},  {21, 2, 3, 10, 3},
                              {3, 2, 4, 4, 1},   {16, 2, 4, 8, 2},  {10, 2, 4, 9, 2},  {36, 2, 4, 16, 3},
                              {39, 2, 4, 12, 3}, {4, 3, 4, 4, 1},   {11, 3, 4, 10, 2}, {29, 3, 4, 20, 3},
                              {5, 3, 8, 8, 1},   {17, 3, 8, 20, 2}, {12, 3, 8, 27, 2}, {92, 3, 8, 64, 3},
                              {6, 3, 6, 6, 1},   {18, 3, 6, 15, 2}, {13, 3, 6, 18, 2}, {90, 3, 6, 40, 3},
                              {7, 3, 5, 5, 1},   {19, 3, 5, 13, 2}, {14, 3, 5, 14, 2}, {118, 3, 5, 30, 3}};

}  // namespace

const GmshType* gmsh_type(long number) {
  const auto* const found =
      std::find_if(std::begin(types), std::end(types), [=](const GmshType& t) { return t.number == number; });
  return found == std::end(types) ? nullptr : found;
}

GmshFormat read_gmsh_format(GmshReader& reader) {
  constexpr long most = std::numeric_limits<int>::max();
  if (reader.word() != "$MeshFormat")
    reader.refuse("does not begin with $MeshFormat; it is no Gmsh mesh: save one as *.msh");
  reader.enter("MeshFormat");
  const std::string version(reader.word());
  if (version != "2.2" && version != "4.1")
    reader.refuse(fmt::format("format {}; allowed are 2.2 and 4.1: save with Mesh.MshFileVersion = 4.1",
                              scene::in_quotes(version)));
  const GmshFormat format{version == "2.2", reader.integer("the file type", 0, 1) == 1};
  const long size = reader.integer("the size of a number", 1, most);
  if (format.is_binary) {
    if (size != 8)
      reader.refuse(fmt::format(
          "numbers of {} bytes; allowed is 8: save the mesh on a machine of 64 bits, or as text (Mesh.Binary "
          "= 0)",
          size));
    reader.bytes_follow();
    constexpr long swapped = 0x01000000;
    const long one = reader.integer("the one", std::numeric_limits<int>::min(), most);
    if (one == swapped)
      reader.refuse(
          "bytes are in the order of another machine; save the mesh on one like this, or as text "
          "(Mesh.Binary = 0)");
    if (one != 1)
      reader.refuse(
          fmt::format("{} where a binary file has the number 1; the file is damaged: save it again", one));
  }
  reader.leave();
  return format;
}

}  // namespace tunica::element
