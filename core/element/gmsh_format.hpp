// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/element/gmsh_reader.hpp"

namespace tunica::element {

/// A type of elements by Gmsh's number.
struct GmshType {
  int number, dimension;
  int corners;
  int nodes;
  int order;
};

/// Null for a type that is not among them: orders above 3, and elements that are no cells.
const GmshType* gmsh_type(long number);

struct GmshFormat {
  bool is_old = false;     ///< 2.2 and not 4.1
  bool is_binary = false;  ///< numbers are bytes
};

/// Reads the section that a file begins with. Throws InvalidInput for another one, and for bytes that are not
/// in this machine's order.
GmshFormat read_gmsh_format(GmshReader& reader);

}  // namespace tunica::element
