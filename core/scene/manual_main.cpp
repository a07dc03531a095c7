// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <iostream>

#include "core/scene/manual.hpp"

/// tunica_manual FILE: writes docs/parameters.md.
int main(int count, char** arguments) {
  if (count != 2) {
    std::cerr << "usage: tunica_manual docs/parameters.md\n";
    return 2;
  }
  std::ofstream file(arguments[1]);
  file << tunica::scene::manual() << std::flush;
  if (!file) std::cerr << arguments[1] << " cannot be written\n";
  return file ? 0 : 1;
}
