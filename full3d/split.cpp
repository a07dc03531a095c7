// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/split.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace tunica::full3d {

namespace {

using Triple = std::array<int, 3>;

Triple coordinates(int node) {
  return {node % 3, node / 3 % 3, node / 9};
}

int volume_sign(const LatticeTetrahedron& t) {
  std::array<Triple, 3> e{};
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) e[k][i] = coordinates(t[k + 1])[i] - coordinates(t[0])[i];
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
         e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

}  // namespace

int middle(int a, int b) {
  const Triple x = coordinates(a), y = coordinates(b);
  return (x[0] + y[0]) / 2 + 3 * ((x[1] + y[1]) / 2 + 3 * ((x[2] + y[2]) / 2));
}

std::array<LatticeTetrahedron, 6> split_hexahedron(const std::array<int, 4>& ranks, bool inwards) {
  const auto lowest = std::min_element(ranks.begin(), ranks.end()) - ranks.begin();
  const bool rising = lowest == 0 || lowest == 3;
  const std::array<Triple, 2> triangles =
      rising ? std::array<Triple, 2>{{{0, 1, 3}, {0, 2, 3}}} : std::array<Triple, 2>{{{0, 1, 2}, {1, 2, 3}}};
  // Where the diagonals arrive, and where they start.
  const int end = inwards ? 18 : 0, start = 18 - end;
  std::array<LatticeTetrahedron, 6> all{};
  std::size_t count = 0;
  for (Triple edges : triangles) {
    std::sort(edges.begin(), edges.end(), [&](int p, int q) { return ranks[p] < ranks[q]; });
    const auto at = [&](int k, int height) { return 2 * (edges[k] % 2) + 6 * (edges[k] / 2) + height; };
    all[count++] = {at(0, end), at(0, start), at(1, start), at(2, start)};
    all[count++] = {at(0, end), at(1, end), at(1, start), at(2, start)};
    all[count++] = {at(0, end), at(1, end), at(2, end), at(2, start)};
  }
  for (LatticeTetrahedron& each : all)
    if (volume_sign(each) < 0) std::swap(each[2], each[3]);
  return all;
}

}  // namespace tunica::full3d
