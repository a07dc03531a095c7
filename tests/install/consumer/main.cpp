// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "core/wall/catalog.hpp"

int main() {
  for (const auto& law : tunica::wall::laws()) std::cout << law.name << '\n';
}
