// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/gmsh_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

#include "axisym/mesh_check.hpp"
#include "core/coupled/gmsh_parts.hpp"
#include "core/error.hpp"

namespace tunica::axisym {

namespace {

/// Of the mesh's size: what CAD kernels and 16 digits leave of a zero, and of a distance that is none.
constexpr double on_axis = 1e-9;
constexpr double coincident = 1e-8;

class CellBuilder {
 public:
  explicit CellBuilder(const GmshFile& file) : file_(file) {}

  GmshCells build() {
    choose_shape();
    coupled::check_named(file_, 2);
    for (const GmshFile::Element& element : file_.elements)
      if (element.dimension == 2) add_cell(element);
    coupled::check_parts(file_, 2, members_);
    for (std::size_t k = 0; k < cells().size(); ++k) {
      cells()[k].part = members_[k].part;
      cells()[k].layer = members_[k].layer;
    }
    place_nodes();
    for (std::size_t k = 0; k < cells().size(); ++k) turn_counter_clockwise(static_cast<int>(k));
    give_roles();
    add_middles();
    add_centres();
    drop_unused();
    refuse_coincident();
    return std::move(result_);
  }

 private:
  std::vector<Cell>& cells() { return result_.mesh.cells; }
  std::vector<std::array<double, 2>>& points() { return result_.mesh.points; }
  int corners() const { return result_.mesh.corners(); }
  std::string cell_name(int cell) const { return axisym::cell_name(result_.mesh, cell, result_.tags); }
  std::string at(int point) const { return where(result_.mesh.points[point]); }

  [[noreturn]] void refuse(const std::string& why) const {
    throw InvalidInput(fmt::format("{}: {}", file_.label, why));
  }

  void choose_shape() {
    const auto count = [this](int corners) {
      return std::count_if(file_.elements.begin(), file_.elements.end(), [=](const GmshFile::Element& e) {
        return e.dimension == 2 && e.corners == corners;
      });
    };
    const auto triangles = count(3), quadrilaterals = count(4);
    if (triangles == 0 && quadrilaterals == 0)
      refuse("there is no triangle and no quadrilateral; mesh the surfaces (gmsh -2) before saving");
    if (triangles > 0 && quadrilaterals > 0)
      refuse(
          fmt::format("{} triangles and {} quadrilaterals are mixed; take one shape (Recombine Surface for "
                      "all or for none)",
                      triangles, quadrilaterals));
    result_.mesh.shape = triangles > 0 ? CellShape::triangle : CellShape::quadrilateral;
  }

  void add_cell(const GmshFile::Element& element) {
    Cell cell{{}, Part::blood, 0};
    cell.nodes.fill(-1);
    std::copy_n(element.nodes.begin(), element.count, cell.nodes.begin());
    cells().push_back(cell);
    result_.tags.push_back(element.tag);
    const std::string name = cell_name(static_cast<int>(cells().size()) - 1);
    for (int i = 0; i < element.count; ++i)
      for (int j = 0; j < i; ++j)
        if (element.nodes[i] == element.nodes[j])
          refuse(fmt::format("{} is degenerate: it has the node {} twice; remesh, or remove degenerate cells",
                             name, file_.nodes[element.nodes[i]].tag));
    std::array<int, 4> same{-1, -1, -1, -1};
    std::copy_n(element.nodes.begin(), element.corners, same.begin());
    std::sort(same.begin(), same.end());
    if (const auto [found, added] = corners_.try_emplace(same, element.tag); !added)
      refuse(fmt::format(
          "cell {} has the corners of {} at {}; remove duplicate cells, and put each surface into one "
          "physical surface only",
          found->second, name,
          where({file_.nodes[element.nodes[0]].position[0], file_.nodes[element.nodes[0]].position[1]})));
    members_.push_back(coupled::membership_of(file_, element, name));
  }

  void place_nodes() {
    double widest = 0, low = INFINITY, high = -INFINITY;
    for (const Cell& cell : cells()) {
      for (const int node : cell.nodes) {
        if (node < 0) continue;
        const auto& position = file_.nodes[node].position;
        widest = std::max(widest, std::abs(position[0]));
        low = std::min(low, position[1]);
        high = std::max(high, position[1]);
      }
    }
    size_ = std::max(widest, high - low);
    for (const GmshFile::Node& node : file_.nodes) points().push_back({node.position[0], node.position[1]});
    for (const Cell& cell : cells()) {
      for (const int node : cell.nodes) {
        if (node < 0) continue;
        double& r = points()[node][0];
        if (std::abs(file_.nodes[node].position[2]) > on_axis * size_)
          refuse(fmt::format(
              "node {} at {} has z = {:g} in Gmsh; draw the vessel in the plane of x = r and y = z",
              file_.nodes[node].tag, at(node), file_.nodes[node].position[2]));
        if (r < -on_axis * size_)
          refuse(
              fmt::format("node {} at {} has a negative radius; draw the half plane x >= 0, the axis of the "
                          "vessel at x = 0",
                          file_.nodes[node].tag, at(node)));
        if (r < on_axis * size_) r = 0;
      }
    }
  }

  void turn_counter_clockwise(int k) {
    auto& nodes = cells()[k].nodes;
    double area = 0, perimeter = 0;
    for (int i = 0; i < corners(); ++i) {
      const auto &a = points()[nodes[i]], &b = points()[nodes[(i + 1) % corners()]];
      area += 0.5 * (a[0] * b[1] - b[0] * a[1]);
      perimeter += std::hypot(b[0] - a[0], b[1] - a[1]);
    }
    constexpr double least = 1e-8;  // of the square of the perimeter
    if (!(std::abs(area) > least * perimeter * perimeter))
      refuse(fmt::format("{} at {} is degenerate: its area is {:.3g} cm2; remesh there", cell_name(k),
                         at(nodes[0]), std::abs(area)));
    if (area > 0) return;
    std::reverse(nodes.begin() + 1, nodes.begin() + corners());
    std::reverse(nodes.begin() + corners(), nodes.begin() + 2 * corners());
  }

  /// A node is a corner, or the middle of one side, or the centre of one cell, for all cells alike.
  void give_roles() {
    enum class Role { none, corner, middle, centre };
    std::vector<Role> roles(points().size(), Role::none);
    std::vector<std::uint64_t> side_of(points().size());
    const auto take = [&](int node, Role role, std::uint64_t side) {
      const bool same =
          roles[node] == role && (role == Role::corner || (role == Role::middle && side_of[node] == side));
      if (roles[node] != Role::none && !same)
        refuse(
            fmt::format("node {} at {} is inside a side or a cell and belongs to another one too, a hanging "
                        "node; mesh surfaces that touch together (Coherence)",
                        file_.nodes[node].tag, at(node)));
      roles[node] = role;
      side_of[node] = side;
    };
    for (int k = 0; k < static_cast<int>(cells().size()); ++k) {
      const auto& nodes = cells()[k].nodes;
      for (int i = 0; i < corners(); ++i) {
        take(nodes[i], Role::corner, 0);
        const auto [first, second, middle] = result_.mesh.side_nodes(k, i);
        const std::uint64_t side = side_key(first, second);
        if (middle < 0) continue;
        take(middle, Role::middle, side);
        if (const auto known = middles_.try_emplace(side, middle).first->second; known != middle)
          refuse(
              fmt::format("the side between nodes {} and {} at {} has two middles, nodes {} and {}; mesh "
                          "surfaces that touch together (Coherence)",
                          file_.nodes[first].tag, file_.nodes[second].tag, at(middle), file_.nodes[known].tag,
                          file_.nodes[middle].tag));
      }
      if (nodes[2 * corners()] >= 0) take(nodes[2 * corners()], Role::centre, 0);
    }
  }

  int add_point(const std::array<double, 2>& point) {
    points().push_back(point);
    return static_cast<int>(points().size()) - 1;
  }

  void add_middles() {
    for (int k = 0; k < static_cast<int>(cells().size()); ++k) {
      for (int i = 0; i < corners(); ++i) {
        const auto [first, second, given] = result_.mesh.side_nodes(k, i);
        int& middle = middles_.try_emplace(side_key(first, second), -1).first->second;
        const auto a = points()[first], b = points()[second];
        if (middle < 0) middle = add_point({0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])});
        cells()[k].nodes[corners() + i] = middle;
      }
    }
  }

  /// Where the map of corners and middles takes the centre: that of the quadratic triangle, or of the
  /// quadrilateral of eight nodes.
  void add_centres() {
    const double of_corner = corners() == 3 ? -1.0 / 9 : -1.0 / 4,
                 of_middle = corners() == 3 ? 4.0 / 9 : 1.0 / 2;
    for (Cell& cell : cells()) {
      if (cell.nodes[2 * corners()] >= 0) continue;
      std::array<double, 2> centre{};
      for (int n = 0; n < 2 * corners(); ++n)
        for (int i = 0; i < 2; ++i)
          centre[i] += (n < corners() ? of_corner : of_middle) * points()[cell.nodes[n]][i];
      cell.nodes[2 * corners()] = add_point(centre);
    }
  }

  void drop_unused() {
    std::vector<int> place(points().size(), -1);
    std::vector<std::array<double, 2>> kept;
    for (Cell& cell : cells()) {
      for (int& node : cell.nodes) {
        if (node < 0) continue;
        if (place[node] < 0) {
          place[node] = static_cast<int>(kept.size());
          kept.push_back(points()[node]);
        }
        node = place[node];
      }
    }
    points() = std::move(kept);
    place.resize(file_.nodes.size());
    result_.point_of = std::move(place);
  }

  /// Nodes of the file in squares of a grid: those that coincide are in the same one or in neighbours.
  void refuse_coincident() {
    const double apart = coincident * size_;
    const auto square = [&](const std::array<double, 2>& point, int i, int j) {
      // Unlike squares of the same key do no harm: distances decide.
      constexpr std::uint64_t stride = 0x9e3779b97f4a7c15;
      const auto count = [&](double x, int shift) {
        return static_cast<std::uint64_t>(std::llround(x / (2 * apart)) + shift);
      };
      return count(point[0], i) * stride + count(point[1], j);
    };
    std::unordered_map<std::uint64_t, std::vector<int>> grid;
    for (const int p : result_.point_of) {
      if (p < 0) continue;
      const std::array<double, 2>& point = points()[p];
      for (const int i : {-1, 0, 1})
        for (const int j : {-1, 0, 1})
          if (const auto found = grid.find(square(point, i, j)); found != grid.end())
            for (const int other : found->second)
              if (std::hypot(points()[other][0] - point[0], points()[other][1] - point[1]) <= apart)
                refuse(
                    fmt::format("two nodes at {} are not the same: cells that touch there do not share their "
                                "nodes; mesh the surfaces together (Coherence), or remove duplicate nodes",
                                at(p)));
      grid[square(point, 0, 0)].push_back(p);
    }
  }

  const GmshFile& file_;
  GmshCells result_;
  std::vector<coupled::Membership> members_;        ///< by cell
  double size_ = 0;                                 ///< the largest coordinate
  std::map<std::array<int, 4>, long> corners_;      ///< of the cells, sorted, with their tags
  std::unordered_map<std::uint64_t, int> middles_;  ///< by side
};

}  // namespace

GmshCells gmsh_cells(const GmshFile& file) {
  return CellBuilder(file).build();
}

}  // namespace tunica::axisym
