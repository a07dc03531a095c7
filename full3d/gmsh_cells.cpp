// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/gmsh_cells.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "core/coupled/gmsh_parts.hpp"
#include "core/error.hpp"

namespace tunica::full3d {

namespace {

using element::GmshFile;
using element::solid::Basis;
using element::solid::shape_count;

constexpr double coincident = 1e-8;  ///< of the mesh's size: what is left of a distance that is none

/// A node that is no corner, with its value in terms of corners and middles of edges where it is not given:
/// the mean of an edge's ends, or what the serendipity basis of edges has at a face's or a cell's centre.
struct Middle {
  int node;
  std::vector<std::pair<int, double>> sources;
  std::vector<int> corners;  ///< that it lies between
};

/// Nodes of the corners that a node lies between, ascending, -1 where there are fewer.
using Corners = std::array<int, 8>;

/// Middles of edges first, then of faces, then of the cell.
std::vector<Middle> middles_of(Shape shape) {
  std::vector<Middle> middles;
  if (shape == Shape::tetrahedron) {
    constexpr int edges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
    for (int e = 0; e < 6; ++e)
      middles.push_back({4 + e, {{edges[e][0], 0.5}, {edges[e][1], 0.5}}, {edges[e][0], edges[e][1]}});
    return middles;
  }
  for (int kind = 1; kind <= 3; ++kind)
    for (int node = 0; node < 27; ++node) {
      std::vector<int> strides;  // of the coordinates in which the node is in the middle
      for (int stride : {1, 3, 9})
        if (node / stride % 3 == 1) strides.push_back(stride);
      if (static_cast<int>(strides.size()) != kind) continue;
      // Neighbours on the lattice of which `off` coordinates are in the middle no more.
      const auto around = [&](int off) {
        std::vector<int> nodes;
        const int all = kind == 1 ? 3 : kind == 2 ? 9 : 27;
        for (int k = 0; k < all; ++k) {
          const int steps[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
          int moved = 0, neighbour = node;
          for (int i = 0; i < kind; ++i) {
            moved += std::abs(steps[i]);
            neighbour += steps[i] * strides[i];
          }
          if (moved == off) nodes.push_back(neighbour);
        }
        return nodes;
      };
      Middle middle{node, {}, around(kind)};
      for (const int corner : middle.corners) middle.sources.emplace_back(corner, kind == 1 ? 0.5 : -0.25);
      if (kind > 1)
        for (const int edge : around(kind - 1)) middle.sources.emplace_back(edge, kind == 2 ? 0.5 : 0.25);
      middles.push_back(std::move(middle));
    }
  return middles;
}

class CellBuilder {
 public:
  explicit CellBuilder(const GmshFile& file) : file_(file) { result_.label = file.label; }

  GmshCells build() {
    choose_shape();
    coupled::check_named(file_, 3);
    for (const GmshFile::Element& element : file_.elements)
      if (element.dimension == 3) add_cell(element);
    coupled::check_parts(file_, 3, members_);
    for (std::size_t k = 0; k < cells().size(); ++k) {
      cells()[k].part = members_[k].part;
      cells()[k].layer = members_[k].layer;
    }
    for (std::size_t k = 0; k < cells().size(); ++k) turn_right_handed(static_cast<int>(k));
    add_middles();
    number_from_inlet();
    refuse_coincident();
    return std::move(result_);
  }

 private:
  std::vector<Cell>& cells() { return result_.mesh.cells; }
  std::vector<Point>& points() { return result_.mesh.points; }
  Shape shape() const { return result_.mesh.shape; }
  int corners() const { return shape_count(shape(), Basis::linear); }
  int corner(int k) const { return node_place(shape(), Basis::linear, k); }

  [[noreturn]] void refuse(const std::string& why) const {
    throw InvalidInput(fmt::format("{}: {}", file_.label, why));
  }

  void choose_shape() {
    struct Kind {
      int corners;
      const char* name;
      long count = 0;
      std::set<std::string> parts{};
    };
    Kind kinds[] = {{4, "tetrahedra"}, {8, "hexahedra"}, {6, "prisms"}, {5, "pyramids"}};
    for (const GmshFile::Element& element : file_.elements) {
      if (element.dimension != 3) continue;
      auto& kind = *std::find_if(std::begin(kinds), std::end(kinds),
                                 [&](const Kind& each) { return each.corners == element.corners; });
      ++kind.count;
      const auto& names = file_.groups[element.group].names;
      kind.parts.insert(names.begin(), names.end());
    }
    std::vector<std::string> found;
    for (const Kind& kind : kinds)
      if (kind.count > 0)
        found.push_back(
            fmt::format("{} {}{}", kind.count, kind.name,
                        kind.parts.empty() ? "" : fmt::format(" ({})", fmt::join(kind.parts, ", "))));
    if (found.empty())
      refuse("there is no tetrahedron and no hexahedron; mesh the volumes (gmsh -3) before saving");
    const long tetrahedra = kinds[0].count, hexahedra = kinds[1].count;
    if (found.size() > 1 || tetrahedra + hexahedra == 0)
      refuse(
          fmt::format("the mesh has {}; all cells have to be tetrahedra, or all hexahedra: leave out every "
                      "Recombine (of surfaces, in Extrude {{...}}, Mesh.RecombineAll) to have tetrahedra",
                      fmt::join(found, ", ")));
    result_.mesh.shape = tetrahedra > 0 ? Shape::tetrahedron : Shape::hexahedron;
    for (const GmshFile::Node& node : file_.nodes) points().push_back(node.position);
  }

  void add_cell(const GmshFile::Element& element) {
    Cell cell{{}, Part::blood, 0};
    cell.nodes.fill(-1);
    const auto places = places_of_gmsh_nodes(shape(), element.count);
    for (int k = 0; k < element.count; ++k) cell.nodes[places[k]] = element.nodes[k];
    cells().push_back(cell);
    result_.tags.push_back(element.tag);
    const std::string name = result_.cell_name(static_cast<int>(cells().size()) - 1);
    std::vector<int> nodes(element.nodes.begin(), element.nodes.begin() + element.count);
    std::sort(nodes.begin(), nodes.end());
    if (const auto twice = std::adjacent_find(nodes.begin(), nodes.end()); twice != nodes.end())
      refuse(fmt::format("{} is degenerate: it has the node {} twice; remesh, or remove degenerate cells",
                         name, file_.nodes[*twice].tag));
    members_.push_back(coupled::membership_of(file_, element, name));
  }

  /// The determinant of the map of the corners, at the cell's centre.
  double volume(const Cell& cell) const {
    const element::solid::Local centre =
        shape() == Shape::hexahedron ? element::solid::Local{} : element::solid::Local{0.25, 0.25, 0.25};
    const auto shapes = element::solid::shapes_at(shape(), Basis::linear, centre);
    Image at;
    for (int k = 0; k < corners(); ++k)
      for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 3; ++c)
          at.slope[i][c] += shapes.slope[k][c] * result_.mesh.points[cell.nodes[corner(k)]][i];
    return at.determinant();
  }

  void turn_right_handed(int k) {
    Cell& cell = cells()[k];
    double size = 0;
    for (int i = 0; i < 3; ++i) {
      const auto [low, high] =
          std::minmax({points()[cell.nodes[corner(0)]][i], points()[cell.nodes[corner(1)]][i],
                       points()[cell.nodes[corner(2)]][i], points()[cell.nodes[corner(corners() - 1)]][i]});
      size = std::max(size, high - low);
    }
    const double determinant = volume(cell);
    constexpr double least = 1e-9;  // of the cube of the size
    if (!(std::abs(determinant) > least * size * size * size))
      refuse(fmt::format("{} is degenerate: it has no volume; remesh there", result_.cell_name(k)));
    if (determinant > 0) return;
    if (shape() == Shape::tetrahedron) {
      for (const auto& [a, b] : {std::pair{1, 2}, {4, 5}, {8, 9}}) std::swap(cell.nodes[a], cell.nodes[b]);
      return;
    }
    const auto given = cell.nodes;
    for (int node = 0; node < 27; ++node)
      cell.nodes[node] = given[3 * (node % 3) + node / 3 % 3 + 9 * (node / 9)];
  }

  /// Nodes between the same corners are one in all cells; a node is a corner or lies between the same corners
  /// for all cells alike.
  void add_middles() {
    const auto middles = middles_of(shape());
    constexpr Corners none{-1, -1, -1, -1, -1, -1, -1, -1};
    std::vector<Corners> between(points().size(), none);  // a corner lies between itself
    std::map<Corners, int> middle_of;
    const auto take = [&](int node, const Corners& corners) {
      Corners& known = between[node];
      if (known == none) known = corners;
      if (known == corners) return;
      refuse(fmt::format(
          "node {} at {} is a corner or middle of one cell and something else of another, a hanging node; "
          "mesh volumes that touch together (Coherence), all of one order",
          file_.nodes[node].tag, where(points()[node])));
    };
    const auto key_of = [&](const Cell& cell, const Middle& middle) {
      Corners key = none;
      for (std::size_t k = 0; k < middle.corners.size(); ++k) key[k] = cell.nodes[middle.corners[k]];
      std::sort(key.begin(), key.end());
      return key;
    };
    for (const Cell& cell : cells()) {
      for (int k = 0; k < corners(); ++k) {
        Corners itself = none;
        itself.back() = cell.nodes[corner(k)];
        take(cell.nodes[corner(k)], itself);
      }
      for (const Middle& middle : middles) {
        const int node = cell.nodes[middle.node];
        if (node < 0) continue;
        const auto key = key_of(cell, middle);
        take(node, key);
        if (const int known = middle_of.try_emplace(key, node).first->second; known != node)
          refuse(fmt::format(
              "nodes {} and {} at {} both are the middle of the same edge or face; mesh volumes that touch "
              "together (Coherence)",
              file_.nodes[known].tag, file_.nodes[node].tag, where(points()[node])));
      }
    }
    for (const Middle& middle : middles)
      for (Cell& cell : cells()) {
        int& node = middle_of.try_emplace(key_of(cell, middle), -1).first->second;
        if (node < 0) {
          Point point{};
          for (const auto& [source, weight] : middle.sources)
            for (int i = 0; i < 3; ++i) point[i] += weight * points()[cell.nodes[source]][i];
          node = static_cast<int>(points().size());
          points().push_back(point);
        }
        cell.nodes[middle.node] = node;
      }
  }

  /// Cells by how many cells lie between them and the inlet, nodes as cells need them: neighbours get numbers
  /// that are near each other.
  void number_from_inlet() {
    const int count = static_cast<int>(cells().size());
    std::vector<std::vector<int>> around(points().size());
    for (int k = 0; k < count; ++k)
      for (int c = 0; c < corners(); ++c) around[cells()[k].nodes[corner(c)]].push_back(k);
    std::vector<int> order;
    std::vector<bool> seen(count, false);
    const auto visit = [&](int node) {
      for (const int cell : around[node])
        if (!seen[cell]) {
          seen[cell] = true;
          order.push_back(cell);
        }
    };
    for (const GmshFile::Element& element : file_.elements) {
      const auto boundary = element.dimension == 2 ? coupled::boundary_of(file_, element) : std::nullopt;
      if (boundary == Boundary::inlet || boundary == Boundary::wall_inlet)
        for (int k = 0; k < element.corners; ++k) visit(element.nodes[k]);
    }
    for (std::size_t next = 0, rest = 0; order.size() < cells().size() || next < order.size();) {
      if (next == order.size()) {
        while (seen[rest]) ++rest;
        seen[rest] = true;
        order.push_back(static_cast<int>(rest));
      }
      const Cell& cell = cells()[order[next++]];
      for (int c = 0; c < corners(); ++c) visit(cell.nodes[corner(c)]);
    }
    std::vector<Cell> sorted;
    std::vector<long> tags;
    for (const int cell : order) {
      sorted.push_back(cells()[cell]);
      tags.push_back(result_.tags[cell]);
    }
    cells() = std::move(sorted);
    result_.tags = std::move(tags);
    std::vector<int> place(points().size(), -1);
    std::vector<Point> kept;
    for (Cell& cell : cells())
      for (int& node : cell.nodes) {
        if (node < 0) continue;
        if (place[node] < 0) {
          place[node] = static_cast<int>(kept.size());
          kept.push_back(points()[node]);
        }
        node = place[node];
      }
    points() = std::move(kept);
    place.resize(file_.nodes.size());
    result_.point_of = std::move(place);
  }

  void refuse_coincident() {
    // Few points are as far along a direction in which nobody meshes.
    constexpr Point direction{0.6180339887, 0.5436890127, 0.5678713424};
    const auto along = [&](int p) {
      return direction[0] * points()[p][0] + direction[1] * points()[p][1] + direction[2] * points()[p][2];
    };
    Point low = points().front(), high = low;
    std::vector<std::pair<double, int>> sorted;
    for (const int p : result_.point_of) {
      if (p < 0) continue;
      sorted.emplace_back(along(p), p);
      for (int i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], points()[p][i]);
        high[i] = std::max(high[i], points()[p][i]);
      }
    }
    const double apart = coincident * std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t k = 0; k < sorted.size(); ++k)
      for (std::size_t j = k + 1; j < sorted.size() && sorted[j].first - sorted[k].first <= apart; ++j) {
        const Point &a = points()[sorted[k].second], &b = points()[sorted[j].second];
        if (std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) <= apart)
          refuse(fmt::format(
              "two nodes at {} are not the same: cells that touch there do not share their nodes; "
              "mesh the volumes together (Coherence), or remove duplicate nodes",
              where(a)));
      }
  }

  const GmshFile& file_;
  GmshCells result_;
  std::vector<coupled::Membership> members_;  ///< by cell
};

}  // namespace

std::string where(const Point& point) {
  return fmt::format("(x, y, z) = ({:.6g}, {:.6g}, {:.6g}) cm", point[0], point[1], point[2]);
}

std::string GmshCells::cell_name(int cell) const {
  return fmt::format("{} {} at {}", mesh.shape == Shape::tetrahedron ? "tetrahedron" : "hexahedron",
                     tags[cell], where(mesh.points[mesh.cells[cell].nodes[0]]));
}

std::vector<int> places_of_gmsh_nodes(Shape shape, int count) {
  if (shape == Shape::tetrahedron) {
    std::vector<int> places{0, 1, 2, 3, 4, 7, 5, 6, 9, 8};
    places.resize(count);
    return places;
  }
  // Corners, middles of edges and of faces and the centre, by their lattice coordinates.
  constexpr int lattice[27][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2},
                                  {0, 2, 2}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 1, 0}, {2, 0, 1}, {1, 2, 0},
                                  {2, 2, 1}, {0, 2, 1}, {1, 0, 2}, {0, 1, 2}, {2, 1, 2}, {1, 2, 2}, {1, 1, 0},
                                  {1, 0, 1}, {0, 1, 1}, {2, 1, 1}, {1, 2, 1}, {1, 1, 2}, {1, 1, 1}};
  std::vector<int> places;
  for (int k = 0; k < count; ++k) places.push_back(lattice[k][0] + 3 * lattice[k][1] + 9 * lattice[k][2]);
  return places;
}

GmshCells gmsh_cells(const GmshFile& file) {
  return CellBuilder(file).build();
}

}  // namespace tunica::full3d
