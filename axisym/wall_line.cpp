// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/wall_line.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "axisym/meeting.hpp"

namespace tunica::axisym {

namespace {

/// True for the Gauss-Legendre points of lines through a quadrilateral from side to side, to 1/20 of its
/// width as cells may be bent, and for points on sides of triangles.
bool is_best_place(CellShape shape, bool quadratic, const element::Local& local) {
  if (shape == CellShape::triangle)
    return on_side(shape, 0, local) || on_side(shape, 1, local) || on_side(shape, 2, local);
  const double best = quadratic ? 1 / std::numbers::sqrt3 : 0;
  return std::abs(std::abs(local[0]) - best) < 0.1 || std::abs(std::abs(local[1]) - best) < 0.1;
}

}  // namespace

WallLine::WallLine(const WallReader& reader, double height, const std::vector<double>& radii)
    : reader_(reader) {
  const Problem& problem = reader.assembler().problem();
  const Mesh& mesh = problem.mesh;
  const bool quadratic = problem.discretisation.element == Element::quadratic;
  for (const SectionPoint& q : section_rule(mesh, section_at(mesh, height), Part::wall, quadratic ? 2 : 1)) {
    auto places = in_innermost_layer(mesh, meeting_places(mesh, q.place));
    samples_.push_back({q.radius, mesh.cells[places.front().cell].layer,
                        is_best_place(mesh.shape, quadratic, q.place.local), std::move(places)});
  }
  for (const double radius : radii) {
    const auto place = locate(mesh, {radius, height}, Part::wall);
    if (!place) throw std::logic_error("WallLine: a radius outside the wall");
    Spot spot{radius, 0, in_innermost_layer(mesh, meeting_places(mesh, *place)), 0, {}, {}};
    spot.axes = reader.axes(spot.places);
    spot.layer = mesh.cells[spot.places.front().cell].layer;
    choose_samples(spot);
    spots_.push_back(std::move(spot));
  }
  for (const Sample& sample : samples_) note_cells(sample.places);
  for (const Spot& spot : spots_) note_cells(spot.places);
}

void WallLine::note_cells(const std::vector<Place>& places) {
  for (const Place& place : places) {
    const auto at = std::lower_bound(cells_.begin(), cells_.end(), place.cell);
    if (at == cells_.end() || *at != place.cell) cells_.insert(at, place.cell);
  }
}

WallStrain WallLine::mean(const std::vector<Place>& places, const std::vector<WallCell>& cells) const {
  WallStrain sum;
  for (const Place& place : places) {
    const auto at = std::lower_bound(cells_.begin(), cells_.end(), place.cell);
    sum.add(1.0 / static_cast<double>(places.size()), cells[at - cells_.begin()].at(place.local));
  }
  return sum;
}

void WallLine::choose_samples(Spot& spot) const {
  std::size_t begin = 0, end = samples_.size();
  while (begin < end && samples_[begin].layer != spot.layer) ++begin;
  while (end > begin && samples_[end - 1].layer != spot.layer) --end;
  const std::size_t count = std::min<std::size_t>(3, end - begin);
  if (count == 0) return;
  // Samples are sorted by radius: the nearest ones follow each other.
  spot.first = begin;
  while (spot.first + count < end &&
         samples_[spot.first + count].radius - spot.radius < spot.radius - samples_[spot.first].radius)
    ++spot.first;
  for (std::size_t i = spot.first; i < spot.first + count; ++i) {
    if (!samples_[i].is_best) {
      spot.weights.clear();
      return;
    }
    double weight = 1;
    for (std::size_t j = spot.first; j < spot.first + count; ++j)
      if (j != i) weight *= (spot.radius - samples_[j].radius) / (samples_[i].radius - samples_[j].radius);
    spot.weights.push_back(weight);
  }
}

std::vector<WallState> WallLine::states(std::span<const double> y) const {
  std::vector<WallCell> cells;
  cells.reserve(cells_.size());
  for (const int cell : cells_) cells.push_back(reader_.cell(cell, y));
  std::vector<WallStrain> sampled;
  sampled.reserve(samples_.size());
  for (const Sample& sample : samples_) sampled.push_back(mean(sample.places, cells));
  std::vector<WallState> states;
  states.reserve(spots_.size());
  for (const Spot& spot : spots_) {
    WallStrain strain = mean(spot.places, cells);
    if (!spot.weights.empty()) {
      WallStrain recovered;
      for (std::size_t k = 0; k < spot.weights.size(); ++k)
        recovered.add(spot.weights[k], sampled[spot.first + k]);
      recovered.displacement = strain.displacement;
      recovered.gradient(1, 1) = strain.gradient(1, 1);
      strain = recovered;
    }
    states.push_back({spot.radius, spot.layer, strain, spot.axes});
  }
  return states;
}

}  // namespace tunica::axisym
