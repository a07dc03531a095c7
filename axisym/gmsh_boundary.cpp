// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/gmsh_boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <unordered_map>

#include "axisym/mesh_check.hpp"
#include "core/coupled/gmsh_parts.hpp"
#include "core/error.hpp"

namespace tunica::axisym {

namespace {

constexpr double near_side = 1e-6;  // of its length

class Marker {
 public:
  Marker(const GmshFile& file, GmshCells& cells)
      : file_(file), tags_(cells.tags), point_of_(cells.point_of), mesh_(cells.mesh) {
    blood_ = mesh_.has(Part::blood);
    wall_ = mesh_.has(Part::wall);
  }

  void mark() {
    collect_sides();
    refuse_hanging();
    coupled::check_boundaries_named(file_, 1, blood_, wall_);
    for (const GmshFile::Element& element : file_.elements)
      if (element.dimension == 1) name_side(element);
    const int sides = mesh_.sides();
    for (int k = 0; k < static_cast<int>(mesh_.cells.size()) * sides; ++k) classify(k / sides, k % sides);
  }

 private:
  struct Side {
    int first = -1, second = -1;  ///< cell * sides() + side
    std::optional<Boundary> boundary;
  };

  [[noreturn]] void refuse(const std::string& why) const {
    throw InvalidInput(fmt::format("{}: {}", file_.label, why));
  }
  std::string cell_at(int cell, int side) const {
    return fmt::format("{} at {}", cell_name(mesh_, cell, tags_),
                       where(mesh_.points[mesh_.side_nodes(cell, side)[2]]));
  }
  Side& side_of(int cell, int side) {
    const auto nodes = mesh_.side_nodes(cell, side);
    return sides_[side_key(nodes[0], nodes[1])];
  }

  void collect_sides() {
    for (int k = 0; k < static_cast<int>(mesh_.cells.size()); ++k) {
      for (int i = 0; i < mesh_.sides(); ++i) {
        Side& side = side_of(k, i);
        if (side.first < 0) {
          side.first = k * mesh_.sides() + i;
          continue;
        }
        const int other = side.first / mesh_.sides();
        // Cells side by side traverse what they share in opposite directions.
        const bool same_way =
            mesh_.side_nodes(k, i)[0] == mesh_.side_nodes(other, side.first % mesh_.sides())[0];
        if (side.second >= 0 || same_way)
          refuse(fmt::format("{} and {} overlap; mesh each surface once", cell_name(mesh_, other, tags_),
                             cell_at(k, i)));
        side.second = k * mesh_.sides() + i;
      }
    }
  }

  void name_side(const GmshFile::Element& line) {
    const std::optional<Boundary> boundary = coupled::boundary_of(file_, line);
    if (!boundary) return;
    const int first = point_of_[line.nodes[0]], second = point_of_[line.nodes[1]];
    const auto found = first < 0 || second < 0 ? sides_.end() : sides_.find(side_key(first, second));
    if (found == sides_.end()) {
      const auto& position = file_.nodes[line.nodes[0]].position;
      refuse(fmt::format("line {} of \"{}\" at {} is no side of a cell; mesh curves and surfaces together",
                         line.tag, name(*boundary), where({position[0], position[1]})));
    }
    Side& side = found->second;
    if (side.boundary && side.boundary != boundary)
      refuse(fmt::format("line {} at {} is both \"{}\" and \"{}\"; give each curve one of these names",
                         line.tag, where(mesh_.points[first]), name(*side.boundary), name(*boundary)));
    side.boundary = boundary;
  }

  void classify(int cell, int i) {
    const Side& side = side_of(cell, i);
    const Part part = mesh_.cells[cell].part;
    const std::optional<Boundary> given = side.boundary;
    if (side.second >= 0) {
      const int other = (side.first / mesh_.sides() == cell ? side.second : side.first) / mesh_.sides();
      const bool interface = mesh_.cells[other].part != part;
      if (given && (!interface || given != Boundary::interface))
        refuse(fmt::format("the curve \"{}\" runs {}, at {}; give this name to a curve on that boundary",
                           name(*given),
                           interface ? "between blood and wall" : fmt::format("inside the {}", name(part)),
                           cell_at(cell, i)));
      if (interface) mesh_.edges.push_back({cell, i, Boundary::interface});
      return;
    }
    mesh_.edges.push_back(
        {cell, i, part == Part::blood ? around_blood(cell, i, given) : around_wall(cell, i, given)});
  }

  bool on_axis(int cell, int i) const {
    const auto nodes = mesh_.side_nodes(cell, i);
    return std::all_of(nodes.begin(), nodes.end(), [this](int node) { return mesh_.points[node][0] == 0; });
  }

  Boundary around_blood(int cell, int i, std::optional<Boundary> given) const {
    if (on_axis(cell, i)) {
      if (given && given != Boundary::axis)
        refuse(fmt::format("the curve \"{}\" runs along the axis, at {}; the axis needs no name, or \"axis\"",
                           name(*given), cell_at(cell, i)));
      return Boundary::axis;
    }
    if (given == Boundary::axis)
      refuse(fmt::format("the curve \"axis\" leaves r = 0, at {}; draw the axis of the vessel at x = 0",
                         cell_at(cell, i)));
    if (given == Boundary::outer)
      refuse(fmt::format(
          "the blood reaches the outer surface, at {}; {}", cell_at(cell, i),
          wall_ ? "let the wall lie between" : "in a mesh of blood alone this curve is \"interface\""));
    if (given == Boundary::wall_inlet || given == Boundary::wall_outlet)
      refuse(fmt::format("the curve \"{}\" covers blood, at {}; name the blood's end \"{}\"", name(*given),
                         cell_at(cell, i), given == Boundary::wall_inlet ? "inlet" : "outlet"));
    if (given == Boundary::inlet || given == Boundary::outlet) return *given;
    if (!wall_) return Boundary::interface;
    refuse_open(
        cell, i,
        "is neither on the axis, nor named \"inlet\" or \"outlet\", nor shared with the wall: the interface "
        "is open there; mesh blood and wall together (Coherence) so that they share their nodes");
  }

  Boundary around_wall(int cell, int i, std::optional<Boundary> given) const {
    if (on_axis(cell, i))
      refuse(fmt::format("the wall reaches the axis, at {}; leave a lumen", cell_at(cell, i)));
    if (given == Boundary::inlet || given == Boundary::outlet || given == Boundary::axis)
      refuse(
          fmt::format("the curve \"{}\" covers the wall, at {}; name the wall's ends \"wall_inlet\" and "
                      "\"wall_outlet\"",
                      name(*given), cell_at(cell, i)));
    if (given && given != Boundary::interface) return *given;
    if (!blood_) return Boundary::interface;
    refuse_open(cell, i,
                "is neither named \"outer\", \"wall_inlet\" or \"wall_outlet\" nor shared with the blood; "
                "name it, or mesh blood and wall together (Coherence) so that they share their nodes");
  }

  [[noreturn]] void refuse_open(int cell, int i, const char* why) const {
    refuse(fmt::format("a side of {} {} {}", name(mesh_.cells[cell].part), cell_at(cell, i), why));
  }

  /// No end of an open side may lie on another open side.
  void refuse_hanging() {
    std::vector<int> open, ends;
    for (int k = 0; k < static_cast<int>(mesh_.cells.size()) * mesh_.sides(); ++k) {
      const int cell = k / mesh_.sides(), i = k % mesh_.sides();
      if (side_of(cell, i).second >= 0) continue;
      open.push_back(k);
      ends.push_back(mesh_.side_nodes(cell, i)[0]);
    }
    const auto height = [this](int node) { return mesh_.points[node][1]; };
    std::stable_sort(ends.begin(), ends.end(), [&](int a, int b) { return height(a) < height(b); });
    for (const int k : open) {
      const int cell = k / mesh_.sides(), i = k % mesh_.sides();
      const auto nodes = mesh_.side_nodes(cell, i);
      const auto [low, high] = std::minmax({height(nodes[0]), height(nodes[1])});
      const double slack =
          near_side * std::hypot(mesh_.points[nodes[0]][0] - mesh_.points[nodes[1]][0], high - low);
      auto next = std::lower_bound(ends.begin(), ends.end(), low - slack,
                                   [&](int node, double z) { return height(node) < z; });
      for (; next != ends.end() && height(*next) <= high + slack; ++next)
        if (lies_on(*next, nodes))
          refuse(fmt::format(
              "a node at {} hangs on a side of {}: the cells do not fit together; mesh surfaces that "
              "touch together (Coherence)",
              where(mesh_.points[*next]), cell_at(cell, i)));
    }
  }

  /// Between the ends of a side, not at one of them.
  bool lies_on(int node, const std::array<int, 3>& ends) const {
    if (node == ends[0] || node == ends[1]) return false;
    const auto &p = mesh_.points[node], &a = mesh_.points[ends[0]], &b = mesh_.points[ends[1]];
    const double side[2] = {b[0] - a[0], b[1] - a[1]}, to[2] = {p[0] - a[0], p[1] - a[1]};
    const double square = side[0] * side[0] + side[1] * side[1];
    const double along = (to[0] * side[0] + to[1] * side[1]) / square;
    const double off = std::abs(to[0] * side[1] - to[1] * side[0]) / square;
    return along > near_side && along < 1 - near_side && off < near_side;
  }

  const GmshFile& file_;
  const std::vector<long>& tags_;
  const std::vector<int>& point_of_;
  Mesh& mesh_;
  bool blood_, wall_;
  std::unordered_map<std::uint64_t, Side> sides_;
};

}  // namespace

void mark_boundaries(const GmshFile& file, GmshCells& cells) {
  Marker(file, cells).mark();
}

}  // namespace tunica::axisym
