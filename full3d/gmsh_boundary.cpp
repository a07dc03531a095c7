// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/gmsh_boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "core/coupled/gmsh_parts.hpp"
#include "core/error.hpp"

namespace tunica::full3d {

namespace {

using element::GmshFile;
using element::solid::Basis;
using element::solid::face_nodes;

/// Corners of a face, ascending; -1 before those of a triangle.
using Corners = std::array<int, 4>;

class Marker {
 public:
  Marker(const GmshFile& file, GmshCells& cells) : file_(file), cells_(cells), mesh_(cells.mesh) {
    blood_ = mesh_.has(Part::blood);
    if (!mesh_.has(Part::wall))
      refuse(
          "there is no wall, and this tier computes none without; put volumes into a physical volume "
          "\"wall\"");
    layers_ = mesh_.layers();
  }

  void mark() {
    collect_sides();
    coupled::check_boundaries_named(file_, 2, blood_, true);
    for (const GmshFile::Element& element : file_.elements)
      if (element.dimension == 2) name_side(element);
    for (int cell = 0; cell < static_cast<int>(mesh_.cells.size()); ++cell)
      for (int face = 0; face < element::solid::faces(mesh_.shape); ++face) classify(cell, face);
    if (blood_)
      for (const Boundary boundary : {Boundary::inlet, Boundary::outlet}) require_one_piece(boundary);
    for (const Boundary boundary :
         {Boundary::interface, Boundary::outer, Boundary::wall_inlet, Boundary::wall_outlet})
      require_one_piece(boundary);
  }

 private:
  struct Side {
    int cells[2] = {-1, -1};
    int faces[2] = {-1, -1};
    std::optional<Boundary> boundary;
  };

  [[noreturn]] void refuse(const std::string& why) const {
    throw InvalidInput(fmt::format("{}: {}", cells_.label, why));
  }

  static Corners corners_of(std::vector<int> nodes) {
    Corners corners{-1, -1, -1, -1};
    std::copy(nodes.begin(), nodes.end(), corners.begin());
    std::sort(corners.begin(), corners.end());
    return corners;
  }
  std::vector<int> nodes_of(int cell, int face) const {
    std::vector<int> nodes;
    for (const int k : face_nodes(mesh_.shape, Basis::linear, face))
      nodes.push_back(mesh_.node(cell, Basis::linear, k));
    return nodes;
  }

  static Point mean(const std::vector<Point>& points) {
    Point sum{};
    for (const Point& point : points)
      for (int i = 0; i < 3; ++i) sum[i] += point[i] / static_cast<double>(points.size());
    return sum;
  }
  std::string at(int cell, int face) const {
    std::vector<Point> points;
    for (const int node : nodes_of(cell, face)) points.push_back(mesh_.points[node]);
    return where(mean(points));
  }
  /// Which side of a face the cell's middle is on, seen along the normal that `first` gives.
  double height(int cell, const Point& normal, const Point& foot) const {
    std::vector<Point> points;
    for (int k = 0; k < element::solid::shape_count(mesh_.shape, Basis::linear); ++k)
      points.push_back(mesh_.points[mesh_.node(cell, Basis::linear, k)]);
    const Point middle = mean(points);
    double height = 0;
    for (int i = 0; i < 3; ++i) height += normal[i] * (middle[i] - foot[i]);
    return height;
  }

  void collect_sides() {
    for (int cell = 0; cell < static_cast<int>(mesh_.cells.size()); ++cell)
      for (int face = 0; face < element::solid::faces(mesh_.shape); ++face) {
        Side& side = sides_[corners_of(nodes_of(cell, face))];
        const int k = side.cells[0] < 0 ? 0 : 1;
        const bool third = side.cells[k] >= 0;
        if (third || (k == 1 && same_side(side.cells[0], cell, face)))
          refuse(fmt::format("{} and {} overlap; mesh each volume once, and put it into one physical volume",
                             cells_.cell_name(side.cells[0]), cells_.cell_name(cell)));
        side.cells[k] = cell;
        side.faces[k] = face;
      }
  }

  bool same_side(int first, int second, int face) const {
    const auto nodes = nodes_of(second, face);
    const Point &a = mesh_.points[nodes[0]], &b = mesh_.points[nodes[1]], &c = mesh_.points[nodes[2]];
    const Point u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const Point normal{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    std::vector<Point> points;
    for (const int node : nodes) points.push_back(mesh_.points[node]);
    const Point foot = mean(points);
    return height(first, normal, foot) * height(second, normal, foot) > 0;
  }

  void name_side(const GmshFile::Element& element) {
    const auto boundary = coupled::boundary_of(file_, element);
    if (!boundary) return;
    if (*boundary == Boundary::axis)
      refuse("a vessel in space has no physical surface \"axis\"; leave the name out");
    std::vector<int> nodes;
    for (int k = 0; k < element.corners; ++k) nodes.push_back(cells_.point_of[element.nodes[k]]);
    const bool known = std::find(nodes.begin(), nodes.end(), -1) == nodes.end();
    const auto found = known ? sides_.find(corners_of(nodes)) : sides_.end();
    if (found == sides_.end())
      refuse(fmt::format("face {} of \"{}\" at {} is no face of a cell; mesh surfaces and volumes together",
                         element.tag, name(*boundary), where(file_.nodes[element.nodes[0]].position)));
    Side& side = found->second;
    if (side.boundary && side.boundary != boundary)
      refuse(fmt::format("the face at {} is both \"{}\" and \"{}\"; give each surface one of these names",
                         at(side.cells[0], side.faces[0]), name(*side.boundary), name(*boundary)));
    side.boundary = boundary;
  }

  void classify(int cell, int face) {
    const Side& side = sides_.at(corners_of(nodes_of(cell, face)));
    const Cell& own = mesh_.cells[cell];
    const std::optional<Boundary> given = side.boundary;
    if (side.cells[1] >= 0) {
      const Cell& other = mesh_.cells[side.cells[side.cells[0] == cell ? 1 : 0]];
      const bool interface = other.part != own.part;
      if (given && (!interface || given != Boundary::interface))
        refuse(fmt::format(
            "the surface \"{}\" lies {}, at {}; give this name to a surface on that boundary", name(*given),
            interface ? "between blood and wall" : fmt::format("inside the {}", name(own.part)),
            at(cell, face)));
      if (interface) {
        if (own.part == Part::wall) require_layer(own, 0, "touches the blood", cell, face);
        mesh_.faces.push_back({cell, face, Boundary::interface});
      } else if (own.part == Part::wall && std::abs(own.layer - other.layer) > 1) {
        refuse(fmt::format("wall:{} touches wall:{}, at {}; {}", own.layer + 1, other.layer + 1,
                           at(cell, face), coupled::layers_remedy));
      }
      return;
    }
    if (!given)
      refuse(fmt::format(
          "a face of {} at {} is neither named ({}) nor shared with another cell; name it, or mesh "
          "the volumes together (Coherence) so that they share their nodes",
          name(own.part), at(cell, face),
          own.part == Part::blood ? "\"inlet\", \"outlet\""
          : blood_                ? "\"outer\", \"wall_inlet\", \"wall_outlet\""
                                  : "\"interface\", \"outer\", \"wall_inlet\", \"wall_outlet\""));
    const bool of_blood = given == Boundary::inlet || given == Boundary::outlet;
    const bool fits =
        own.part == Part::blood ? of_blood : !of_blood && (given != Boundary::interface || !blood_);
    if (!fits)
      refuse(
          fmt::format("the surface \"{}\" bounds {} cells, at {}; the blood's ends are \"inlet\" and "
                      "\"outlet\", the wall's outer surface and ends \"outer\", \"wall_inlet\" and "
                      "\"wall_outlet\"",
                      name(*given), name(own.part), at(cell, face)));
    if (given == Boundary::outer) require_layer(own, layers_ - 1, "lies outside", cell, face);
    if (given == Boundary::interface) require_layer(own, 0, "lies inside", cell, face);
    mesh_.faces.push_back({cell, face, *given});
  }

  void require_layer(const Cell& cell, int layer, const char* what, int index, int face) const {
    if (cell.layer == layer) return;
    refuse(
        fmt::format("wall:{} {}, at {}; {}", cell.layer + 1, what, at(index, face), coupled::layers_remedy));
  }

  void require_one_piece(Boundary boundary) const {
    std::map<int, int> parent;
    const auto root = [&](int node) {
      while (parent.try_emplace(node, node).first->second != node) node = parent[node];
      return node;
    };
    const Face* apart = nullptr;
    for (const Face& face : mesh_.faces) {
      if (face.boundary != boundary) continue;
      const auto nodes = nodes_of(face.cell, face.face);
      for (const int node : nodes) parent[root(node)] = root(nodes[0]);
    }
    int first = -1;
    for (const Face& face : mesh_.faces) {
      if (face.boundary != boundary) continue;
      const int own = root(nodes_of(face.cell, face.face)[0]);
      if (first < 0) first = own;
      if (own != first) apart = &face;
    }
    if (apart)
      refuse(fmt::format(
          "the surface \"{}\" is in several pieces, one of them at {}; a vessel has one inlet and "
          "one outlet: cut branches off",
          name(boundary), at(apart->cell, apart->face)));
    if (first < 0)
      refuse(fmt::format("there is no face \"{}\"; blood and wall have to touch, sharing their nodes",
                         name(boundary)));
  }

  const GmshFile& file_;
  GmshCells& cells_;
  Mesh& mesh_;
  bool blood_ = false;
  int layers_ = 0;
  std::map<Corners, Side> sides_;
};

}  // namespace

void mark_boundaries(const GmshFile& file, GmshCells& cells) {
  Marker(file, cells).mark();
}

}  // namespace tunica::full3d
