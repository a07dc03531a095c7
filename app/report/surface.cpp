// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/report/surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <span>
#include <stdexcept>
#include <utility>

namespace tunica::report {

namespace {

using observables::CellShape;
using observables::FieldMesh;
using Point = std::array<double, 3>;
using Face = std::array<int, 4>;

constexpr Face hexahedron_faces[] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                     {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
constexpr Face tetrahedron_faces[] = {{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {2, 0, 3, -1}};
/// Six tetrahedra around the diagonal from corner 0 to corner 6.
constexpr std::array<int, 4> hexahedron_parts[] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6},
                                                   {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
constexpr std::array<int, 4> whole_tetrahedron[] = {{0, 1, 2, 3}};

constexpr double smooth_cosine = 0.64;  ///< of 50 degrees: faces that meet at less share a normal

Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Corners of a face, without the -1.
std::span<const int> corners_of(const Face& face) {
  return {face.data(), face[3] < 0 ? 3U : 4U};
}

Point mean(const std::vector<Point>& points, std::span<const int> indices) {
  Point sum{};
  for (const int index : indices)
    for (std::size_t k = 0; k < 3; ++k) sum[k] += points[index][k] / static_cast<double>(indices.size());
  return sum;
}

/// Twice the area's vector: the product of the diagonals for a quadrilateral.
Point area(const std::vector<Point>& points, const Face& face) {
  const auto [a, b, c, d] = face;
  return d < 0 ? cross(minus(points[b], points[a]), minus(points[c], points[a]))
               : cross(minus(points[c], points[a]), minus(points[d], points[b]));
}

/// Lengths below this are none: coordinates that were stored have some 7 digits.
double smallest_length(const FieldMesh& mesh) {
  double largest = 0;
  for (const Point& point : mesh.points)
    for (const double coordinate : point) largest = std::max(largest, std::abs(coordinate));
  return 1e-6 * largest;
}

/// For each point the first of those that coincide with it.
std::vector<int> merged(const std::vector<Point>& points) {
  std::vector<int> order(points.size()), first(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return points[a] < points[b]; });
  for (std::size_t k = 0; k < order.size(); ++k)
    first[order[k]] = k > 0 && points[order[k]] == points[order[k - 1]] ? first[order[k - 1]] : order[k];
  return first;
}

bool in_symmetry_plane(const FieldMesh& mesh, const Face& face, double tolerance) {
  for (std::size_t axis = 0; axis < mesh.mirrored.size(); ++axis) {
    if (!mesh.mirrored[axis]) continue;
    const auto corners = corners_of(face);
    if (std::all_of(corners.begin(), corners.end(),
                    [&](int corner) { return std::abs(mesh.points[corner][axis]) < tolerance; }))
      return true;
  }
  return false;
}

/// Makes vertices of the corners of faces; corners at a point are one vertex where the surface is smooth.
class Vertices {
 public:
  Vertices(std::size_t points, Surface& surface) : surface_(surface), place_(points, -1), known_(points) {}

  int at(int point, const Point& normal) {
    for (const auto& [vertex, direction] : known_[point])
      if (dot(direction, normal) > smooth_cosine * std::sqrt(dot(direction, direction) * dot(normal, normal)))
        return vertex;
    if (place_[point] < 0) {
      place_[point] = static_cast<int>(surface_.places.size());
      surface_.places.push_back({point, point, 0});
    }
    known_[point].emplace_back(static_cast<int>(surface_.vertices.size()), normal);
    surface_.vertices.push_back(place_[point]);
    return known_[point].back().first;
  }

 private:
  Surface& surface_;
  std::vector<int> place_;
  std::vector<std::vector<std::pair<int, Point>>> known_;
};

/// Cuts cells, taken as tetrahedra, at height y = cut.
class Section {
 public:
  Section(const FieldMesh& mesh, double cut, Surface& surface) : mesh_(mesh), surface_(surface) {
    const double tolerance = smallest_length(mesh);
    double highest = 0;
    for (const Point& point : mesh.points) {
      const double height = point[1] - cut;
      height_.push_back(std::abs(height) < tolerance ? 0 : height);
      highest = std::max(highest, height_.back());
    }
    // Points in the plane belong to the side without cells to be cut.
    if (highest <= 0)
      for (double& height : height_) height = -height;
  }

  void add(std::span<const int> tetrahedron) {
    std::vector<int> above, below;
    for (const int point : tetrahedron) (height_[point] > 0 ? above : below).push_back(point);
    if (above.empty() || below.empty()) return;
    if (above.size() == 2) {
      const int corners[] = {vertex(above[0], below[0]), vertex(above[0], below[1]),
                             vertex(above[1], below[1]), vertex(above[1], below[0])};
      add_triangle({corners[0], corners[1], corners[2]});
      add_triangle({corners[0], corners[2], corners[3]});
      return;
    }
    const bool one_above = above.size() == 1;
    const auto& three = one_above ? below : above;
    Surface::Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k)
      triangle[k] = one_above ? vertex(above[0], three[k]) : vertex(three[k], below[0]);
    add_triangle(triangle);
  }

 private:
  int vertex(int above, int below) {
    const double weight = height_[above] / (height_[above] - height_[below]);
    // The cut may pass through the lower point itself.
    const Surface::Place place = height_[below] == 0 ? Surface::Place{below, below, 0}
                                 : above < below     ? Surface::Place{above, below, weight}
                                                     : Surface::Place{below, above, 1 - weight};
    const int next = static_cast<int>(surface_.vertices.size());
    const auto [entry, is_new] = known_.try_emplace({place.first, place.second}, next);
    if (is_new) {
      surface_.vertices.push_back(static_cast<int>(surface_.places.size()));
      surface_.places.push_back(place);
    }
    return entry->second;
  }

  Point position(int vertex) const {
    const auto& [first, second, weight] = surface_.places[surface_.vertices[vertex]];
    Point point;
    for (std::size_t k = 0; k < 3; ++k)
      point[k] = (1 - weight) * mesh_.points[first][k] + weight * mesh_.points[second][k];
    return point;
  }

  void add_triangle(Surface::Triangle triangle) {
    const auto [a, b, c] = triangle;
    if (a == b || b == c || c == a) return;
    const Point normal = cross(minus(position(b), position(a)), minus(position(c), position(a)));
    if (normal[1] < 0) std::swap(triangle[1], triangle[2]);
    surface_.section.push_back(triangle);
  }

  const FieldMesh& mesh_;
  Surface& surface_;
  std::vector<double> height_;
  std::map<std::pair<int, int>, int> known_;
};

}  // namespace

std::vector<Face> boundary_faces(const FieldMesh& mesh) {
  const bool hexahedra = mesh.shape == CellShape::hexahedron;
  if (!hexahedra && mesh.shape != CellShape::tetrahedron)
    throw std::logic_error("boundary_faces: cells that are not in space");
  const std::span<const Face> faces =
      hexahedra ? std::span<const Face>(hexahedron_faces) : std::span<const Face>(tetrahedron_faces);
  const std::vector<int> first = merged(mesh.points);
  const std::size_t count = observables::corners(mesh.shape);
  struct Keyed {
    Face key, face;
  };
  std::vector<Keyed> all;
  all.reserve(mesh.cells.size() / count * faces.size());
  for (std::size_t begin = 0; begin < mesh.cells.size(); begin += count) {
    const std::span<const int> cell(mesh.cells.data() + begin, count);
    const Point centre = mean(mesh.points, cell);
    for (const Face& local : faces) {
      Keyed made{{-1, -1, -1, -1}, {-1, -1, -1, -1}};
      for (std::size_t k = 0; k < corners_of(local).size(); ++k) {
        made.face[k] = cell[local[k]];
        made.key[k] = first[made.face[k]];
      }
      std::sort(made.key.begin(), made.key.end());
      const Point outwards = minus(mean(mesh.points, corners_of(made.face)), centre);
      if (dot(area(mesh.points, made.face), outwards) < 0) std::swap(made.face[0], made.face[2]);
      all.push_back(made);
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Keyed& a, const Keyed& b) { return a.key < b.key; });
  const double tolerance = smallest_length(mesh);
  std::vector<Face> found;
  for (std::size_t k = 0; k < all.size();) {
    std::size_t end = k + 1;
    while (end < all.size() && all[end].key == all[k].key) ++end;
    if (end == k + 1 && !in_symmetry_plane(mesh, all[k].face, tolerance)) found.push_back(all[k].face);
    k = end;
  }
  return found;
}

Surface visible_surface(const FieldMesh& mesh, double cut) {
  Surface surface;
  Vertices vertices(mesh.points.size(), surface);
  for (const Face& face : boundary_faces(mesh)) {
    const Point normal = area(mesh.points, face);
    std::vector<int> corners;
    for (const int point : corners_of(face)) corners.push_back(vertices.at(point, normal));
    surface.outer.push_back({corners[0], corners[1], corners[2]});
    if (corners.size() == 4) surface.outer.push_back({corners[0], corners[2], corners[3]});
  }
  Section section(mesh, cut, surface);
  const bool hexahedra = mesh.shape == CellShape::hexahedron;
  const std::span<const std::array<int, 4>> parts =
      hexahedra ? std::span<const std::array<int, 4>>(hexahedron_parts)
                : std::span<const std::array<int, 4>>(whole_tetrahedron);
  for (std::size_t begin = 0; begin < mesh.cells.size(); begin += observables::corners(mesh.shape))
    for (const auto& part : parts) {
      std::array<int, 4> points;
      for (std::size_t k = 0; k < 4; ++k) points[k] = mesh.cells[begin + part[k]];
      section.add(points);
    }
  return surface;
}

std::vector<float> at_places(const Surface& surface, const std::vector<float>& values,
                             std::size_t components) {
  std::vector<float> found;
  found.reserve(surface.places.size() * components);
  for (const auto& [first, second, weight] : surface.places)
    for (std::size_t k = 0; k < components; ++k) {
      const float a = values[components * first + k], b = values[components * second + k];
      found.push_back(first == second ? a : static_cast<float>((1 - weight) * a + weight * b));
    }
  return found;
}

}  // namespace tunica::report
