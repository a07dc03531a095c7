// SPDX-License-Identifier: GPL-3.0-or-later
#include "lumped/wall_fields.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/radial/fronts.hpp"
#include "lumped/wall_profile.hpp"

namespace tunica::lumped {

namespace {

constexpr int sectors = 32;
/// Cells through the thickness, shared out among layers. A multiple of three, so that P1..P4 are points.
constexpr int cells_through = 9;

struct Direction {
  double x, y;
};

/// Unit vectors towards the points of a circle, the same for every circle.
std::vector<Direction> directions() {
  std::vector<Direction> all;
  for (int j = 0; j < sectors; ++j) {
    const double angle = 2 * std::numbers::pi * j / sectors;
    all.push_back({std::cos(angle), std::sin(angle)});
  }
  return all;
}

struct Stress {
  const char* name;
  double observables::ProfilePoint::*value;
};
constexpr Stress stresses[] = {{"von_mises", &observables::ProfilePoint::von_mises},
                               {"circumferential_stress", &observables::ProfilePoint::circumferential_stress},
                               {"radial_stress", &observables::ProfilePoint::radial_stress},
                               {"axial_stress", &observables::ProfilePoint::axial_stress}};

}  // namespace

WallFields::WallFields(const radial::RingModel& model, double length) : model_(model), length_(length) {
  const auto boundaries = radial::layer_boundaries(model.ring());
  for (std::size_t layer = 0; layer + 1 < boundaries.size(); ++layer) {
    const double inner = boundaries[layer], width = boundaries[layer + 1] - inner;
    const int cells = std::max(1, static_cast<int>(std::lround(cells_through * width)));
    for (int k = 0; k <= cells; ++k) {
      const double xi = k == cells ? boundaries[layer + 1] : inner + width * k / cells;
      // A boundary belongs to the inner of its layers.
      places_.push_back(k == 0 && layer > 0 ? std::nextafter(xi, 1.0) : xi);
      place_layers_.push_back(static_cast<int>(layer));
    }
    has_fibers_ |= !wall::families(model.ring().layers[layer].law).empty();
  }
}

observables::FieldSeries WallFields::empty_series() const {
  observables::FieldSeries series;
  series.name = "wall";
  series.mesh.shape = observables::CellShape::quadrilateral;
  for (const double xi : places_) {
    const double radius = model_.ring().radius(xi);
    for (const auto& [x, y] : directions())
      series.mesh.points.push_back({radius * x, radius * y, 0.5 * length_});
  }
  observables::CellField layers{"layer", "1", {}};
  for (std::size_t i = 0; i + 1 < places_.size(); ++i) {
    if (place_layers_[i] != place_layers_[i + 1]) continue;
    const int inner = static_cast<int>(i) * sectors, outer = inner + sectors;
    for (int j = 0; j < sectors; ++j) {
      const int next = (j + 1) % sectors;
      for (const int corner : {inner + j, outer + j, outer + next, inner + next})
        series.mesh.cells.push_back(corner);
      layers.values.push_back(place_layers_[i]);
    }
  }
  series.cell_fields.push_back(std::move(layers));

  series.point_fields.push_back({"displacement", "cm", 3});
  for (const Stress& stress : stresses) series.point_fields.push_back({stress.name, "dyn/cm2", 1});
  if (has_fibers_)
    for (const char* name : {"recruitment", "fiber_stretch"}) series.point_fields.push_back({name, "1", 1});
  return series;
}

void WallFields::append(double time, radial::LumenStretch lumen_stretch,
                        observables::FieldSeries& series) const {
  const auto points = wall_profile(model_, lumen_stretch, places_);
  const auto around = [](std::vector<float>& values, double value) {
    values.insert(values.end(), sectors, static_cast<float>(value));
  };
  const auto circle = directions();
  std::vector<std::vector<float>> values(series.point_fields.size());
  for (std::size_t f = 0; f < values.size(); ++f)
    values[f].reserve(series.point_fields[f].components * series.mesh.points.size());
  for (const auto& point : points) {
    std::size_t field = 0;
    for (const auto& [x, y] : circle)
      for (const double direction : {x, y, 0.0})
        values[field].push_back(static_cast<float>(point.radial_displacement * direction));
    for (const Stress& stress : stresses) around(values[++field], point.*stress.value);
    if (!has_fibers_) continue;
    around(values[++field], point.recruitment);
    around(values[++field], point.fiber_stretch);
  }
  series.frames.push_back({time, std::move(values)});
}

}  // namespace tunica::lumped
