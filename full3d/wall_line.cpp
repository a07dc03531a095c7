// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/wall_line.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace tunica::full3d {

WallLine::WallLine(const Setup& setup, const Layout& layout, const Course& course, const Locator& locator,
                   double angle, int points)
    : setup_(setup), angle_(std::remainder(angle, 2 * std::numbers::pi)) {
  constexpr double quarter_turn = 0.5 * std::numbers::pi, rounding = 1e-9;
  const bool cut_y = setup.sector != Sector::full, cut_x = setup.sector == Sector::quarter;
  turned_y_ = cut_y && angle_ < -rounding;
  if (turned_y_) angle_ = -angle_;
  turned_x_ = cut_x && angle_ > quarter_turn + rounding;
  if (turned_x_) angle_ = 2 * quarter_turn - angle_;
  on_y_plane_ = cut_y && (std::abs(angle_) < rounding || std::abs(angle_ - 2 * quarter_turn) < rounding);
  on_x_plane_ = cut_x && std::abs(angle_ - quarter_turn) < rounding;

  line_ = course.across(angle_);
  const Across unfolded = turned_x_ || turned_y_ ? course.across(angle) : line_;

  std::vector<Place> places;
  // Along faces of tetrahedra, which cross the line at any place, no points are better than others.
  const auto lines =
      setup.problem.mesh.shape == Shape::hexahedron ? course.cell_lines(line_) : std::vector<double>{};
  const bool quadratic = setup.problem.discretisation.element == Element::quadratic;
  for (std::size_t k = 0; k + 1 < lines.size(); ++k)
    for (const double side : {-1, 1}) {
      if (!quadratic && side < 0) continue;
      const double share = quadratic ? 0.5 * (1 + side / std::numbers::sqrt3) : 0.5;
      samples_.push_back(read(std::lerp(lines[k], lines[k + 1], share), locator, places));
    }
  for (int k = 0; k < points; ++k) {
    const double depth = line_.thickness * k / (points - 1.0);
    Spot spot{read(depth, locator, places), 0, {}, {}};
    spot.directions = mean_directions(setup.problem, std::span(places).last(spot.count), unfolded.at(depth));
    choose_samples(spot);
    spots_.push_back(std::move(spot));
  }
  probe_ = wall_probe(setup.problem, layout, std::move(places), true);
}

WallLine::Reading WallLine::read(double depth, const Locator& locator, std::vector<Place>& places) const {
  // Cells of an eighth of the circle leave out 0.2 % of the radius between their nodes, flat ones 8 %: lines
  // that pass there begin and end a little within the wall.
  for (const double inwards : {0.0, 1e-6, 1e-4, 1e-3, 1e-2, 0.1}) {
    const auto place = locator.find(line_.at(std::lerp(depth, 0.5 * line_.thickness, inwards)), Part::wall);
    if (!place) continue;
    auto meeting = locator.meeting(*place);
    const Mesh& mesh = setup_.problem.mesh;
    int layer = mesh.cells[meeting.front().cell].layer;
    for (const Place& each : meeting) layer = std::min(layer, mesh.cells[each.cell].layer);
    std::erase_if(meeting, [&](const Place& each) { return mesh.cells[each.cell].layer != layer; });
    const Reading reading{depth, layer, places.size(), meeting.size()};
    places.insert(places.end(), meeting.begin(), meeting.end());
    return reading;
  }
  throw std::logic_error("WallLine: a depth outside the wall");
}

void WallLine::choose_samples(Spot& spot) const {
  std::size_t begin = 0, end = samples_.size();
  while (begin < end && samples_[begin].layer != spot.layer) ++begin;
  while (end > begin && samples_[end - 1].layer != spot.layer) --end;
  const std::size_t count = std::min<std::size_t>(3, end - begin);
  if (count == 0) return;
  // Samples are sorted by depth: the nearest ones follow each other.
  spot.first_sample = begin;
  while (spot.first_sample + count < end && samples_[spot.first_sample + count].depth - spot.depth <
                                                spot.depth - samples_[spot.first_sample].depth)
    ++spot.first_sample;
  for (std::size_t i = spot.first_sample; i < spot.first_sample + count; ++i) {
    double weight = 1;
    for (std::size_t j = spot.first_sample; j < spot.first_sample + count; ++j)
      if (j != i) weight *= (spot.depth - samples_[j].depth) / (samples_[i].depth - samples_[j].depth);
    spot.weights.push_back(weight);
  }
}

WallStrain WallLine::mirrored(WallStrain strain, int component) const {
  strain.displacement[component] = -strain.displacement[component];
  for (int i = 0; i < 3; ++i)
    if (i != component) {
      strain.gradient(i, component) = -strain.gradient(i, component);
      strain.gradient(component, i) = -strain.gradient(component, i);
    }
  return strain;
}

WallStrain WallLine::mean(const Reading& reading, const std::vector<WallStrain>& strains) const {
  WallStrain sum;
  for (std::size_t k = reading.first; k < reading.first + reading.count; ++k)
    sum.add(1.0 / static_cast<double>(reading.count), strains[k]);
  const auto both_sides = [&](int component) {
    WallStrain mean;
    mean.add(0.5, sum);
    mean.add(0.5, mirrored(sum, component));
    sum = mean;
  };
  if (on_x_plane_) both_sides(0);
  if (on_y_plane_) both_sides(1);
  return sum;
}

std::vector<WallState> WallLine::states(std::span<const double> y) const {
  const auto strains = probe_->strains(y);
  std::vector<WallStrain> sampled;
  sampled.reserve(samples_.size());
  for (const Reading& sample : samples_) sampled.push_back(mean(sample, strains));
  std::vector<WallState> states;
  states.reserve(spots_.size());
  for (const Spot& spot : spots_) {
    WallStrain strain = mean(spot, strains);
    if (!spot.weights.empty()) {
      WallStrain recovered;
      for (std::size_t k = 0; k < spot.weights.size(); ++k)
        recovered.add(spot.weights[k], sampled[spot.first_sample + k]);
      recovered.displacement = strain.displacement;
      strain = recovered;
    }
    if (turned_x_) strain = mirrored(strain, 0);
    if (turned_y_) strain = mirrored(strain, 1);
    states.push_back({spot.depth, spot.layer, strain, spot.directions});
  }
  return states;
}

}  // namespace tunica::full3d
