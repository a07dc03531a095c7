// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/radial/fronts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "core/frame.hpp"
#include "core/root.hpp"

namespace tunica::radial {

namespace {

/// Elements narrower than this are not made: round-off would spoil their slopes, and a kink so close
/// to a boundary costs no more than the square of the distance.
constexpr double least_width = 1e-6;

/// Leaving a smoothed kink (exponent 2) of width 1/epsilon inside an element costs of the order of
/// 1/epsilon^2 of the fibre stress; above this sharpness that is below 1e-10.
constexpr double sharpness_of_a_kink = 1e5;

bool must_be_resolved(const wall::CollagenFamily<double>& family) {
  return !family.recruitment.sharp &&
         (family.exponent == 1 || family.recruitment.sharpness < sharpness_of_a_kink);
}

/// Levels of I4bar - a^2 at which elements end.
std::vector<double> levels(const wall::CollagenFamily<double>& family, double largest) {
  std::vector<double> result{0.0};
  if (!must_be_resolved(family)) return result;
  // Equal ratios resolve the arctangent alike at every distance from its centre.
  constexpr double ratio = 4;
  for (double level = 1.0 / family.recruitment.sharpness; level < largest; level *= ratio) {
    result.push_back(level);
    result.push_back(-level);
  }
  return result;
}

bool same_front(const wall::CollagenFamily<double>& a, const wall::CollagenFamily<double>& b) {
  return std::abs(a.angle) == std::abs(b.angle) && a.activation_squared == b.activation_squared &&
         a.exponent == b.exponent && a.recruitment.sharpness == b.recruitment.sharpness;
}

}  // namespace

template <class P>
std::vector<P> layer_boundaries(const Ring<P>& ring) {
  P total(0.0);
  for (const auto& layer : ring.layers) total += layer.share;
  std::vector<P> boundaries{P(0.0)};
  P sum(0.0);
  for (const auto& layer : ring.layers) {
    sum += layer.share;
    boundaries.push_back(sum / total);
  }
  boundaries.back() = P(1.0);
  return boundaries;
}

template std::vector<double> layer_boundaries(const Ring<double>&);
template std::vector<Dual<double, 1>> layer_boundaries(const Ring<Dual<double, 1>>&);

template <class P>
MovingInterval<P> moved_with_layers(const Ring<P>& ring, const std::vector<double>& boundaries,
                                    const Interval& cell) {
  if constexpr (std::same_as<P, double>) {
    return {cell.lower, cell.upper};
  } else {
    const std::vector<P> ends = layer_boundaries(ring);
    const double lower = boundaries[cell.layer], width = boundaries[cell.layer + 1] - lower;
    const P start = ends[cell.layer], extent = ends[cell.layer + 1] - start;
    // The values are those of the interval to the last bit, only the derivatives are new.
    const auto moved = [&](double xi) {
      return P(xi, P(start + extent * ((xi - lower) / width)).derivative);
    };
    return {moved(cell.lower), moved(cell.upper)};
  }
}

template MovingInterval<double> moved_with_layers(const Ring<double>&, const std::vector<double>&,
                                                  const Interval&);
template MovingInterval<Dual<double, 1>> moved_with_layers(const Ring<Dual<double, 1>>&,
                                                           const std::vector<double>&, const Interval&);

std::size_t layer_at(const std::vector<double>& boundaries, double xi) {
  std::size_t layer = 0;
  while (layer + 2 < boundaries.size() && boundaries[layer + 1] < xi) ++layer;
  return layer;
}

double fiber_excess(const wall::CollagenFamily<double>& family, const Ring<double>& ring, double xi,
                    double displacement, double slope) {
  return family.excess(frame::Radial::kinematics(displacement, slope, ring.radius(xi)),
                       frame::Radial::axes());
}

std::vector<Front> find_fronts(const Ring<double>& ring, const std::vector<double>& boundaries,
                               const Field& field, double kink) {
  // Excess varies smoothly through a layer; this many samples find every change of sign that a
  // monotone or once-bent profile can have.
  constexpr int samples = 8;
  std::vector<Front> fronts;
  for (std::size_t layer = 0; layer < ring.layers.size(); ++layer) {
    const auto& families = wall::families(ring.layers[layer].law);
    // Interior ends, so that the field is read in this layer and not across its boundary.
    const double inset = 1e-12;
    const double lower = boundaries[layer] + inset, upper = boundaries[layer + 1] - inset;
    for (std::size_t f = 0; f < families.size(); ++f) {
      const auto& family = families[f];
      if (std::any_of(families.begin(), families.begin() + f,
                      [&](const auto& earlier) { return same_front(earlier, family); }))
        continue;
      const auto excess = [&](double xi) {
        const auto [displacement, slope] = field(xi);
        return fiber_excess(family, ring, xi, displacement, slope);
      };
      std::array<double, samples + 1> xi, value;
      double largest = 0;
      for (int k = 0; k <= samples; ++k) {
        xi[k] = lower + (upper - lower) * k / samples;
        value[k] = excess(xi[k]);
        largest = std::max(largest, std::abs(value[k]));
      }
      // Undeformed tissue with a^2 = 1 has no front although round-off changes the sign.
      if (largest < 1e-13) continue;
      std::vector<double> found;
      for (const double level : levels(family, largest)) {
        for (int k = 0; k < samples; ++k) {
          if ((value[k + 1] > level) == (value[k] > level)) continue;
          found.push_back(
              find_root([&](double x) { return excess(x) - level; }, xi[k], xi[k + 1], 1e-2 * kink));
        }
      }
      std::sort(found.begin(), found.end());
      for (std::size_t k = 0; k < found.size(); ++k) {
        double tolerance = kink;
        if (must_be_resolved(family)) {
          const double before = k > 0 ? found[k] - found[k - 1] : found[k] - lower;
          const double after = k + 1 < found.size() ? found[k + 1] - found[k] : upper - found[k];
          tolerance = std::max(tolerance, 0.1 * std::max(before, after));
        }
        fronts.push_back({found[k], tolerance});
      }
    }
  }
  std::sort(fronts.begin(), fronts.end(), [](const Front& a, const Front& b) { return a.xi < b.xi; });
  return fronts;
}

std::vector<Interval> radial_mesh(const std::vector<double>& boundaries, const std::vector<Front>& fronts) {
  std::vector<double> points = boundaries;
  for (const Front& front : fronts) points.push_back(front.xi);
  std::erase_if(points, [](double point) { return point <= 0 || point > 1; });
  std::sort(points.begin(), points.end());

  std::vector<Interval> mesh;
  std::size_t layer = 0;
  double lower = 0;
  for (const double point : points) {
    while (point > boundaries[layer + 1]) ++layer;
    const bool is_boundary = point == boundaries[layer + 1];
    const double end = boundaries[layer + 1];
    if (point <= lower || (!is_boundary && (point - lower < least_width || end - point < least_width)))
      continue;
    mesh.push_back({lower, point, layer});
    lower = point;
    if (is_boundary && layer + 2 < boundaries.size()) ++layer;
  }
  return mesh;
}

std::vector<Interval> refined_for(const Ring<double>& ring, const std::vector<Interval>& mesh) {
  constexpr double greatest_ratio = 1.35;
  std::vector<Interval> result;
  for (const Interval& cell : mesh) {
    const double inner = ring.radius(cell.lower), ratio = ring.radius(cell.upper) / inner;
    const int parts = std::max(1, static_cast<int>(std::ceil(std::log(ratio) / std::log(greatest_ratio))));
    double lower = cell.lower;
    for (int k = 1; k <= parts; ++k) {
      const double radius = inner * std::pow(ratio, static_cast<double>(k) / parts);
      const double upper = k == parts ? cell.upper : (radius - ring.inner_radius) / ring.thickness;
      result.push_back({lower, upper, cell.layer});
      lower = upper;
    }
  }
  return result;
}

std::vector<Front> FrontSearch::next(const std::vector<Front>& put, const std::vector<Front>& found) {
  std::vector<Front> result = found;
  if (put.size() != found.size()) {
    brackets_.clear();
    is_closed_ = false;
    return result;
  }
  brackets_.resize(found.size(), {-1.0, 2.0});
  is_closed_ = true;
  for (std::size_t k = 0; k < found.size(); ++k) {
    auto& [lower, upper] = brackets_[k];
    (found[k].xi > put[k].xi ? lower : upper) = put[k].xi;
    // What lies between can have changed with the other fronts.
    if (!(lower < upper)) std::tie(lower, upper) = std::pair(-1.0, 2.0);
    if (!(found[k].xi > lower && found[k].xi < upper)) result[k].xi = 0.5 * (lower + upper);
    is_closed_ &= upper - lower < found[k].tolerance;
  }
  return result;
}

bool has_end_near(const std::vector<Interval>& mesh, const Front& front) {
  const double reach = std::max(front.tolerance, 2 * least_width);
  const auto next = std::lower_bound(mesh.begin(), mesh.end(), front.xi,
                                     [](const Interval& cell, double xi) { return cell.upper < xi; });
  if (next == mesh.end()) return true;
  // Only next to an end that an element of least width would reach may the front be farther away.
  const double distance = std::min(front.xi - next->lower, next->upper - front.xi);
  const bool at_boundary = next == mesh.begin() || next + 1 == mesh.end();
  return distance < (at_boundary ? reach : front.tolerance);
}

}  // namespace tunica::radial
