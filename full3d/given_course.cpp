// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/given_course.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/error.hpp"
#include "full3d/harmonic.hpp"
#include "full3d/measures.hpp"
#include "full3d/probes.hpp"

namespace tunica::full3d {

namespace {

/// Sections along the vessel.
constexpr int sections = 128;

double length_of(const Vector<double>& v) {
  return std::sqrt(dot(v, v));
}
Vector<double> difference(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector<double> moved(const Vector<double>& a, double share, const Vector<double>& b) {
  return {a[0] + share * b[0], a[1] + share * b[1], a[2] + share * b[2]};
}
Vector<double> unit(const Vector<double>& v) {
  const double size = length_of(v);
  return {v[0] / size, v[1] / size, v[2] / size};
}
/// What is normal to a unit vector, of length 1.
Vector<double> normal_part(const Vector<double>& v, const Vector<double>& to) {
  return unit(moved(v, -dot(v, to), to));
}

/// The distance up to which a condition holds that holds at `inside` and not at `outside`.
template <class Condition>
double last(double inside, double outside, const Condition& holds) {
  // To what a Locator takes for a point of a cell's face.
  const double exact = 1e-10 * std::abs(outside - inside);
  while (std::abs(outside - inside) > exact) {
    const double middle = 0.5 * (inside + outside);
    (holds(middle) ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace

GivenCourse::GivenCourse(const Setup& setup, const Locator& locator)
    : setup_(setup),
      mesh_(setup.problem.mesh),
      locator_(locator),
      part_(mesh_.has(Part::blood) ? Part::blood : Part::wall),
      thickness_(setup.shape.thickness) {
  std::vector<int> all(mesh_.cells.size());
  std::iota(all.begin(), all.end(), 0);
  const HeldBoundary ends[] = {
      {Boundary::inlet, 0}, {Boundary::wall_inlet, 0}, {Boundary::outlet, 1}, {Boundary::wall_outlet, 1}};
  phi_ = harmonic(mesh_, Basis::linear, all, ends);
  for (int k = 0; k <= sections; ++k) {
    Station station = section(std::clamp(k / static_cast<double>(sections), 1e-6, 1 - 1e-6));
    if (k == 0 || k == sections) {
      const Surface end = surface(mesh_, end_of_vessel(k == 0));
      // A little within, so that lines across the wall do not run along its end.
      station.centre = moved(end.centre, -1e-6 * thickness_, end.normal);
      station.tangent = moved({}, k == 0 ? -1 : 1, end.normal);
    }
    if (k > 0) station.s = stations_.back().s + arc(stations_.back(), station);
    stations_.push_back(station);
  }
  carry_x_axis();
  middle_ = middle();
}

Boundary GivenCourse::end_of_vessel(bool first) const {
  if (part_ == Part::blood) return first ? Boundary::inlet : Boundary::outlet;
  return first ? Boundary::wall_inlet : Boundary::wall_outlet;
}

GivenCourse::Station GivenCourse::section(double level) const {
  // A triangle with the middles of its sides where the cell's map has them is the face of a quadratic
  // tetrahedron that is opposite to its last corner, seen from within.
  constexpr Shape tetrahedron = Shape::tetrahedron;
  constexpr int places[] = {0, 1, 2, 4, 7, 5};
  static const auto rule = element::solid::face_rule(tetrahedron, Basis::quadratic, 3);
  static const auto shapes = [] {
    std::vector<element::solid::Shapes> all;
    for (const auto& point : rule.points)
      all.push_back(element::solid::shapes_at(tetrahedron, Basis::quadratic, point));
    return all;
  }();
  Station station{level, {}, 0};
  std::vector<Point> corners;
  double area = 0;
  for (const Triangle& triangle : level_set(mesh_, part_, phi_, level)) {
    std::array<Point, 6> nodes;
    for (int k = 0; k < 3; ++k) {
      const auto &a = triangle.corners[k], &b = triangle.corners[(k + 1) % 3];
      nodes[k] = image(mesh_, triangle.cell, a).point;
      nodes[3 + k] =
          image(mesh_, triangle.cell, {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])}).point;
    }
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      Point point{};
      Vector<double> along[2] = {};
      for (int k = 0; k < 6; ++k) {
        const auto& slope = shapes[q].slope[places[k]];
        point = moved(point, shapes[q].value[places[k]], nodes[k]);
        for (int s = 0; s < 2; ++s) along[s] = moved(along[s], dot(slope, rule.directions[s]), nodes[k]);
      }
      const Vector<double> oriented = cross(along[1], along[0]);
      const double own = rule.weights[q] * length_of(oriented);
      area += own;
      station.centre = moved(station.centre, own, point);
      station.tangent = moved(station.tangent, rule.weights[q], oriented);
    }
    corners.insert(corners.end(), nodes.begin(), nodes.begin() + 3);
  }
  station.centre = moved({}, 1 / area, station.centre);
  station.tangent = unit(station.tangent);
  for (const Point& corner : corners)
    station.reach = std::max(station.reach, length_of(difference(corner, station.centre)));
  return station;
}

double GivenCourse::arc(const Station& from, const Station& to) {
  // Along the mean tangent, as sections' centres are not exact; a circle's arc is longer than its chord.
  const Vector<double> mean = unit(moved(from.tangent, 1, to.tangent));
  const double half_turn = 0.5 * std::acos(std::clamp(dot(from.tangent, to.tangent), -1.0, 1.0));
  const double longer = half_turn > 1e-6 ? half_turn / std::sin(half_turn) : 1;
  return longer * dot(difference(to.centre, from.centre), mean);
}

void GivenCourse::carry_x_axis() {
  const Vector<double>& first = stations_.front().tangent;
  Vector<double> axis =
      std::abs(first[0]) < std::numbers::sqrt2 / 2 ? Vector<double>{1, 0, 0} : Vector<double>{0, 1, 0};
  for (Station& station : stations_) station.x_axis = axis = normal_part(axis, station.tangent);
}

GivenCourse::Station GivenCourse::middle() const {
  const double half = 0.5 * length();
  const auto after =
      std::find_if(stations_.begin(), stations_.end(), [&](const Station& s) { return s.s > half; });
  const Station &a = *(after - 1), &b = *after;
  const double share = (half - a.s) / (b.s - a.s);
  Station middle = section(std::lerp(a.level, b.level, share));
  middle.s = half;
  middle.x_axis = normal_part(a.x_axis, middle.tangent);
  return middle;
}

std::optional<double> GivenCourse::distance_to_wall(const Station& station,
                                                    const Vector<double>& direction) const {
  const auto in_wall = [&](double r) {
    return locator_.find(moved(station.centre, r, direction), Part::wall).has_value();
  };
  const double step = 0.25 * thickness_;
  for (double r = step; r < station.reach + 4 * thickness_; r += step)
    if (in_wall(r)) return last(r, r - step, in_wall);
  return {};
}

Vector<double> GivenCourse::radial_at(const Place& place, const Point& point,
                                      const Vector<double>& otherwise) const {
  const auto own = directions_of(setup_.axes->at(place.cell, place.local)).radial;
  if (!std::isnan(own[0])) return own;
  const auto meeting = locator_.meeting(place);
  const auto mean = mean_directions(setup_.problem, meeting, point).radial;
  return std::isnan(mean[0]) ? otherwise : mean;
}

Across GivenCourse::across(double angle) const {
  const Vector<double> y_axis = cross(middle_.tangent, middle_.x_axis);
  Vector<double> direction{};
  for (int i = 0; i < 3; ++i)
    direction[i] = std::cos(angle) * middle_.x_axis[i] + std::sin(angle) * y_axis[i];
  const auto radius = distance_to_wall(middle_, direction);
  if (!radius)
    throw InvalidInput(
        fmt::format("mesh: at mid-length, about x = {:.6g}, y = {:.6g}, z = {:.6g} cm, there is no wall at "
                    "{:.3g} degrees from "
                    "the section's x axis; observables are for vessels whose wall surrounds their centreline",
                    middle_.centre[0], middle_.centre[1], middle_.centre[2], angle * 180 / std::numbers::pi));
  Across line{moved(middle_.centre, *radius, direction), {}, *radius, 0};
  const auto place = locator_.find(line.begin, Part::wall);
  line.out = radial_at(*place, line.begin, direction);
  const auto in_wall = [&](double depth) { return locator_.find(line.at(depth), Part::wall).has_value(); };
  const double step = 0.05 * thickness_;
  double depth = 0;
  while (in_wall(depth + step)) depth += step;
  line.thickness = last(depth, depth + step, in_wall);
  return line;
}

std::optional<double> GivenCourse::end_of_cell(const Across& across, double depth) const {
  const double a_little = 1e-5 * across.thickness;
  const auto begin = locator_.find(across.at(depth + a_little), Part::wall);
  if (!begin) return {};
  const auto local_at = [&](double at) -> std::optional<element::solid::Local> {
    const auto place = locator_.find(across.at(at), Part::wall);
    if (place)
      for (const Place& each : locator_.meeting(*place))
        if (each.cell == begin->cell) return each.local;
    return {};
  };
  const auto in_cell = [&](double at) { return local_at(at).has_value(); };
  const double end =
      in_cell(across.thickness) ? across.thickness : last(depth + a_little, across.thickness, in_cell);
  const auto first = local_at(depth + a_little), final = local_at(end);
  // From a face to the one opposite.
  constexpr double near = 1e-3;
  for (int c = 0; first && final && c < 3; ++c)
    if (std::abs(std::abs((*final)[c] - (*first)[c]) - 2) < near) return end;
  return {};
}

std::vector<double> GivenCourse::cell_lines(const Across& across) const {
  std::vector<double> lines{0};
  constexpr double rounding = 1e-6;
  while (lines.back() < (1 - rounding) * across.thickness) {
    const auto end = end_of_cell(across, lines.back());
    if (!end) return {};
    lines.push_back(*end);
  }
  return lines;
}

std::vector<AlongPoint> GivenCourse::along() const {
  std::vector<AlongPoint> points;
  for (std::size_t k = 0; k < stations_.size(); k += 2) {
    const Station& station = stations_[k];
    if (const auto radius = distance_to_wall(station, station.x_axis))
      points.push_back({moved(station.centre, *radius, station.x_axis), station.s, *radius});
  }
  return points;
}

std::function<double(std::span<const double>)> GivenCourse::section_pressure(const Layout& layout) const {
  if (!mesh_.has(Part::blood)) return {};
  std::vector<Place> places;
  std::vector<Point> points;
  for (const Triangle& triangle : level_set(mesh_, Part::blood, phi_, middle_.level))
    for (const auto& corner : triangle.corners) {
      places.push_back({triangle.cell, corner});
      points.push_back(image(mesh_, triangle.cell, corner).point);
    }
  const std::shared_ptr<const BloodProbe> probe = blood_probe(setup_.problem, layout, std::move(places));
  return [probe, points](std::span<const double> y) {
    const auto samples = probe->samples(y);
    double force = 0, area = 0;
    for (std::size_t k = 0; k < samples.size(); k += 3) {
      std::array<Point, 3> at;
      double pressure = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        at[c] = moved(points[k + c], 1, samples[k + c].displacement);
        pressure += samples[k + c].pressure / 3;
      }
      const double own = length_of(cross(difference(at[1], at[0]), difference(at[2], at[0])));
      force += own * pressure;
      area += own;
    }
    return force / area;
  };
}

}  // namespace tunica::full3d
