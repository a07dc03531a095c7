// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/course.hpp"

#include <algorithm>
#include <cmath>

#include "full3d/given_course.hpp"
#include "full3d/probes.hpp"

namespace tunica::full3d {

namespace {

class ShapeCourse final : public Course {
 public:
  explicit ShapeCourse(const Setup& setup) : setup_(setup), shape_(setup.shape), mesh_(setup.problem.mesh) {}

  Across across(double angle) const override {
    const double c = std::cos(angle), s = std::sin(angle), middle = 0.5 * shape_.length;
    const auto axes = shape_.axes(angle, middle);
    return {shape_.place({shape_.radius * c, shape_.radius * s, middle}),
            cross(axes.circumferential, axes.axial), shape_.radius, shape_.thickness};
  }

  std::vector<double> cell_lines(const Across&) const override {
    std::vector<double> depths;
    for (const Cell& cell : mesh_.cells) {
      if (cell.part != Part::wall) continue;
      for (int k = 0; k < element::solid::shape_count(mesh_.shape, Basis::linear); ++k) {
        const auto at = shape_.local(mesh_.points[cell.nodes[node_place(mesh_.shape, Basis::linear, k)]]);
        depths.push_back(std::hypot(at.x, at.y) - shape_.radius);
      }
    }
    std::sort(depths.begin(), depths.end());
    const double same = 1e-6 * shape_.thickness;
    depths.erase(std::unique(depths.begin(), depths.end(), [&](double a, double b) { return b - a < same; }),
                 depths.end());
    return depths;
  }

  std::vector<AlongPoint> along() const override {
    const double same = 1e-9 * shape_.radius;
    std::vector<AlongPoint> points;
    for (const Point& point : mesh_.points) {
      const auto at = shape_.local(point);
      if (std::abs(at.y) <= same && std::abs(at.x - shape_.radius) <= same)
        points.push_back({point, at.s, shape_.radius});
    }
    std::sort(points.begin(), points.end(),
              [](const AlongPoint& a, const AlongPoint& b) { return a.s < b.s; });
    return points;
  }

  std::vector<int> further_angles() const override {
    return shape_.bend_angle == 0 ? std::vector<int>{} : std::vector<int>{90, 180, 270};
  }

  std::function<double(std::span<const double>)> section_pressure(const Layout& layout) const override {
    if (!mesh_.has(Part::blood)) return {};
    return [&problem = setup_.problem, &layout, faces = section_faces()](std::span<const double> y) {
      return mean_pressure(problem, layout, faces, y);
    };
  }

 private:
  /// Faces of the blood's cells in the section at mid-length, seen from upstream.
  std::vector<Face> section_faces() const {
    const double middle = 0.5 * shape_.length, same = 1e-9 * shape_.length;
    const auto s_of = [&](int cell, int k) {
      return shape_.local(mesh_.points[mesh_.node(cell, Basis::linear, k)]).s;
    };
    std::vector<Face> faces;
    for (int cell = 0; cell < static_cast<int>(mesh_.cells.size()); ++cell) {
      if (mesh_.cells[cell].part != Part::blood) continue;
      double least = middle;
      for (int k = 0; k < element::solid::shape_count(mesh_.shape, Basis::linear); ++k)
        least = std::min(least, s_of(cell, k));
      if (least > middle - same) continue;
      for (int face = 0; face < element::solid::faces(mesh_.shape); ++face) {
        const auto corners = element::solid::face_nodes(mesh_.shape, Basis::linear, face);
        if (std::all_of(corners.begin(), corners.end(),
                        [&](int k) { return std::abs(s_of(cell, k) - middle) < same; }))
          faces.push_back({cell, face, Boundary::outlet});
      }
    }
    return faces;
  }

  const Setup& setup_;
  const VesselShape& shape_;
  const Mesh& mesh_;
};

}  // namespace

std::unique_ptr<const Course> course_of(const Setup& setup, const Locator& locator) {
  if (setup.axes) return std::make_unique<GivenCourse>(setup, locator);
  return std::make_unique<ShapeCourse>(setup);
}

}  // namespace tunica::full3d
