// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/section.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <utility>

#include "core/element/grading.hpp"

namespace tunica::full3d {

namespace {

constexpr double core_size = 0.55, core_bulge = 0.4;

/// Lattice of nodes, two steps to a cell. The core has nodes (i, j) from -n to n. Ring k has nodes at angles
/// a of 45/n degrees each, 0 <= a < 8 n; ring 0 is the core's boundary.
class Builder {
 public:
  explicit Builder(const SectionSpec& spec)
      : spec_(spec),
        n_(spec.around_cells / 4),
        // Without blood nothing lies on ring 0, as the interface is another one.
        interface_ring_(2 * std::max(spec.ring_cells, 1)),
        core_ids_((2 * n_ + 1) * (2 * n_ + 1), -1) {
    const double half = std::numbers::sqrt2 / 2, corner = core_size * spec.radius * half;
    for (int a = 0; a <= n_; ++a) {
      const double angle = std::numbers::pi / 4 * a / n_;
      unit_.push_back(a < n_ ? Pair{std::cos(angle), std::sin(angle)} : Pair{half, half});
      const double circle = core_bulge * core_size * spec.radius, square = (1 - core_bulge) * corner;
      side_.push_back(
          a < n_ ? Pair{square + circle * unit_[a][0], square * std::tan(angle) + circle * unit_[a][1]}
                 : Pair{corner, corner});
    }
    blood_rings_ =
        element::with_midpoints(element::shrinking_lines(interface_ring_ / 2, spec.interface_grading));
    if (!spec.wall_lines.empty()) wall_rings_ = element::with_midpoints(spec.wall_lines);
    ring_ids_.assign((interface_ring_ + std::max<std::size_t>(wall_rings_.size(), 1)) * 8 * n_, -1);
  }

  Section build() {
    if (spec_.ring_cells > 0) {
      add_core();
      for (int k = 0; k < spec_.ring_cells; ++k) add_ring(2 * k, Part::blood, 0);
    }
    for (std::size_t k = 0; k < spec_.wall_layers.size(); ++k)
      add_ring(interface_ring_ + 2 * static_cast<int>(k), Part::wall, spec_.wall_layers[k]);
    return std::move(section_);
  }

 private:
  using Pair = std::array<double, 2>;
  static Pair swapped(const Pair& p) { return {p[1], p[0]}; }
  static double reflected(int index, double value) { return index < 0 ? -value : index == 0 ? 0 : value; }

  void add_core() {
    for (int j = spec_.sector == Sector::full ? -n_ : 0; j < n_; j += 2)
      for (int i = spec_.sector == Sector::quarter ? 0 : -n_; i < n_; i += 2) {
        if (spec_.sector != Sector::full && j == 0) mark(2, Boundary::symmetry_y);
        if (spec_.sector == Sector::quarter && i == 0) mark(0, Boundary::symmetry_x);
        add_quad(Part::blood, 0, [&](int di, int dj) { return core_node(i + di, j + dj); });
      }
  }

  /// The ring of cells from ring k of the lattice to ring k + 2.
  void add_ring(int k, Part part, int layer) {
    const int end = 8 * n_ / (spec_.sector == Sector::full ? 1 : spec_.sector == Sector::half ? 2 : 4);
    const bool outermost = k + 3 == interface_ring_ + static_cast<int>(wall_rings_.size());
    for (int a = 0; a < end; a += 2) {
      if (k == interface_ring_) mark(0, Boundary::interface);
      if (k + 2 == interface_ring_) mark(1, Boundary::interface);
      if (part == Part::wall && outermost) mark(1, Boundary::outer);
      if (spec_.sector != Sector::full && a == 0) mark(2, Boundary::symmetry_y);
      if (spec_.sector != Sector::full && a + 2 == end)
        mark(3, spec_.sector == Sector::half ? Boundary::symmetry_y : Boundary::symmetry_x);
      add_quad(part, layer, [&](int dk, int da) { return ring_node(k + dk, (a + da) % (8 * n_)); });
    }
  }

  /// Marks a side of the next cell.
  void mark(int side, Boundary boundary) {
    section_.sides.push_back({static_cast<int>(section_.quads.size()), side, boundary});
  }

  template <class NodeAt>
  void add_quad(Part part, int layer, const NodeAt& node_at) {
    Section::Quad quad{{}, part, layer};
    for (int k = 0; k < 9; ++k) {
      const int i = k % 3, j = k / 3;
      quad.nodes[k] = spec_.quadratic || (i != 1 && j != 1) ? node_at(i, j) : -1;
    }
    section_.quads.push_back(quad);
  }

  int core_node(int i, int j) {
    int& id = core_ids_[(j + n_) * (2 * n_ + 1) + i + n_];
    if (id < 0) {
      const int u = std::abs(i), v = std::abs(j);
      id = add({reflected(i, coons(u, v)), reflected(j, coons(v, u))}, std::max(u, v), std::min(u, v));
    }
    return id;
  }

  /// The coordinate along u in the core's first quadrant.
  double coons(int u, int v) const {
    const double share = static_cast<double>(u) / n_;
    return share * side_[v][0] + (side_[u][1] - share * side_[n_][1]);
  }

  int ring_node(int k, int a) {
    const int quadrant = a / (2 * n_), within = a % (2 * n_);
    if (k == 0) {
      const int past = std::min(within, n_), back = std::min(2 * n_ - within, n_);
      const std::array<int, 4> cosine{back, -past, -back, past};
      return core_node(cosine[quadrant], cosine[(quadrant + 3) % 4]);
    }
    int& id = ring_ids_[static_cast<std::size_t>(k) * 8 * n_ + a];
    if (id < 0) {
      const int octant = std::min(within, 2 * n_ - within);
      Pair p = ring_point(k, octant);
      if (within > n_) p = swapped(p);
      const std::array<Pair, 4> turned{p, Pair{-p[1], p[0]}, Pair{-p[0], -p[1]}, Pair{p[1], -p[0]}};
      // Adding 0 makes 0 of -0.
      id = add({turned[quadrant][0] + 0.0, turned[quadrant][1] + 0.0}, n_ + k, octant);
    }
    return id;
  }

  /// At angle a of the first octant.
  Pair ring_point(int k, int a) const {
    const Pair& e = unit_[a];
    if (k >= interface_ring_) {
      const double radius = k == interface_ring_ ? spec_.radius : wall_rings_[k - interface_ring_];
      return {radius * e[0], radius * e[1]};
    }
    const double g = blood_rings_[k];
    return {(1 - g) * side_[a][0] + g * spec_.radius * e[0], (1 - g) * side_[a][1] + g * spec_.radius * e[1]};
  }

  int add(const Pair& point, int ring, int octant) {
    section_.points.push_back(point);
    section_.ranks.push_back(ring * (n_ + 1) + octant);
    return static_cast<int>(section_.points.size()) - 1;
  }

  const SectionSpec& spec_;
  int n_;                          ///< cells to a side of the core, and half-cells to an octant
  int interface_ring_;             ///< the lattice's
  std::vector<Pair> unit_, side_;  ///< of the circle and of the core at the angles of the first octant
  std::vector<double> blood_rings_, wall_rings_;
  std::vector<int> core_ids_, ring_ids_;
  Section section_;
};

}  // namespace

Section o_grid_section(const SectionSpec& spec) {
  return Builder(spec).build();
}

}  // namespace tunica::full3d
