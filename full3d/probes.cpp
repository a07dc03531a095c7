// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/probes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/coupled/gather.hpp"
#include "core/threads.hpp"
#include "full3d/tables.hpp"

namespace tunica::full3d {

namespace {

using element::solid::shape_count;
using element::solid::shapes_at;

std::vector<int> cell_nodes(const Mesh& mesh, int cell, Basis basis) {
  std::vector<int> nodes;
  for (int k = 0; k < shape_count(mesh.shape, basis); ++k) nodes.push_back(mesh.node(cell, basis, k));
  return nodes;
}

template <int Width, int SideWidth>
class WallProbeOf final : public WallProbe {
 public:
  WallProbeOf(const Problem& problem, const Layout& layout, const std::vector<Place>& places, bool keep,
              int threads)
      : problem_(problem), layout_(layout), tables_(problem), threads_(threads), count_(places.size()) {
    std::map<int, std::size_t> index;
    const Basis basis = displacement_basis(problem.discretisation.element);
    for (std::size_t k = 0; k < places.size(); ++k) {
      const auto [entry, is_new] = index.try_emplace(places[k].cell, cells_.size());
      if (is_new) {
        cells_.push_back({places[k].cell, cell_nodes(problem.mesh, places[k].cell, basis), {}, {}});
        if (keep) tables_.wall(places[k].cell, cells_.back().points);
      }
      cells_[entry->second].places.push_back(
          {k, places[k].local,
           keep ? tables_.displacement_at(places[k].cell, places[k].local) : kernel::Lifted<Frame, Width>{}});
    }
    keep_ = keep;
  }

  std::vector<WallStrain> strains(std::span<const double> y) const override {
    std::vector<WallStrain> strains(count_);
    for_each_index(threads_, static_cast<int>(cells_.size()), [&](int index) {
      const CellPlaces& cell = cells_[index];
      static thread_local std::vector<typename Tables<Width, SideWidth>::WallPoint> made;
      if (!keep_) tables_.wall(cell.cell, made);
      const auto& points = keep_ ? cell.points : made;
      const auto& law = problem_.laws[problem_.mesh.cells[cell.cell].layer];
      kernel::WallNodes<Frame, Width> nodes;
      nodes.displacement = coupled::nodal_displacement<Frame, Width>(layout_, cell.nodes, y);
      const int terms = tables_.pressure_terms(cell.cell);
      std::optional<kernel::WallPressure<Frame>> pressure;
      if (terms > 0)
        pressure.emplace(kernel::WallParameters{&law, 0, 0, terms}, points, kernel::gradients(points, nodes));
      for (const Spot& spot : cell.places) {
        const auto shapes = keep_ ? spot.shapes : tables_.displacement_at(cell.cell, spot.local);
        WallStrain& strain = strains[spot.index];
        strain.displacement = kernel::field_value(shapes, nodes.displacement);
        strain.gradient = kernel::field_gradient(shapes, nodes.displacement);
        if (pressure) {
          const double basis[kernel::max_pressure_terms<Frame>] = {1, spot.local[0], spot.local[1],
                                                                   spot.local[2]};
          strain.pressure = pressure->at(basis);
        } else {
          strain.take_own_pressure(law);
        }
      }
    });
    return strains;
  }

 private:
  struct Spot {
    std::size_t index;
    element::solid::Local local;
    kernel::Lifted<Frame, Width> shapes;
  };
  struct CellPlaces {
    int cell;
    std::vector<int> nodes;
    std::vector<typename Tables<Width, SideWidth>::WallPoint> points;
    std::vector<Spot> places;
  };
  const Problem& problem_;
  const Layout& layout_;
  Tables<Width, SideWidth> tables_;
  int threads_;
  std::size_t count_;
  bool keep_ = false;
  std::vector<CellPlaces> cells_;
};

/// Lifts of a basis at a place of a cell.
template <int Width>
kernel::Lifted<Frame, Width> lifts_at(const Problem& problem, const Place& place, Basis basis) {
  const Mesh& mesh = problem.mesh;
  const Basis geometry = displacement_basis(problem.discretisation.element);
  const PlacedShapes at = placed(mesh, place.cell, shapes_at(mesh.shape, geometry, place.local));
  const auto shapes = shapes_at(mesh.shape, basis, place.local);
  kernel::Lifted<Frame, Width> lifted;
  for (int k = 0; k < shapes.count; ++k) {
    const auto all = Frame::lift(shapes.value[k], at.slope(shapes.slope[k]), at.place);
    for (int a = 0; a < Frame::lifts; ++a) lifted.lift[a][k] = all[a];
  }
  return lifted;
}

class BloodProbeOf final : public BloodProbe {
 public:
  BloodProbeOf(const Problem& problem, const Layout& layout, std::vector<Place> places)
      : problem_(problem), layout_(layout), places_(std::move(places)) {}

  std::vector<BloodSample> samples(std::span<const double> y) const override {
    constexpr int width = 28;
    const Mesh& mesh = problem_.mesh;
    const Basis moving = displacement_basis(problem_.discretisation.element),
                flowing = velocity_basis(problem_.discretisation.element);
    std::vector<BloodSample> samples;
    samples.reserve(places_.size());
    for (const Place& place : places_) {
      const auto displacement = lifts_at<width>(problem_, place, moving);
      const auto velocity = lifts_at<width>(problem_, place, flowing);
      const auto d =
          coupled::nodal_displacement<Frame, width>(layout_, cell_nodes(mesh, place.cell, moving), y);
      const auto v = coupled::nodal_velocity<Frame, width>(layout_, cell_nodes(mesh, place.cell, flowing), y);
      BloodSample& sample = samples.emplace_back();
      sample.displacement = kernel::field_value(displacement, d);
      sample.displacement_gradient = kernel::field_gradient(displacement, d);
      sample.velocity = kernel::field_value(velocity, v);
      sample.velocity_gradient = kernel::field_gradient(velocity, v);
      const auto linear = shapes_at(mesh.shape, Basis::linear, place.local);
      for (int k = 0; k < linear.count; ++k)
        sample.pressure += linear.value[k] * y[layout_.pressure(mesh.node(place.cell, Basis::linear, k))];
    }
    return samples;
  }

 private:
  const Problem& problem_;
  const Layout& layout_;
  std::vector<Place> places_;
};

}  // namespace

std::unique_ptr<WallProbe> wall_probe(const Problem& problem, const Layout& layout, std::vector<Place> places,
                                      bool keep, int threads) {
  const bool quadratic = problem.discretisation.element == Element::quadratic;
  if (problem.mesh.shape == Shape::hexahedron && quadratic)
    return std::make_unique<WallProbeOf<28, 12>>(problem, layout, places, keep, threads);
  if (quadratic) return std::make_unique<WallProbeOf<12, 8>>(problem, layout, places, keep, threads);
  return std::make_unique<WallProbeOf<8, 4>>(problem, layout, places, keep, threads);
}

std::unique_ptr<BloodProbe> blood_probe(const Problem& problem, const Layout& layout,
                                        std::vector<Place> places) {
  return std::make_unique<BloodProbeOf>(problem, layout, std::move(places));
}

double mean_pressure(const Problem& problem, const Layout& layout, std::span<const Face> faces,
                     std::span<const double> y) {
  const Mesh& mesh = problem.mesh;
  const Basis basis = displacement_basis(problem.discretisation.element);
  double force = 0, area = 0;
  for (const Face& face : faces) {
    const auto rule = element::solid::face_rule(mesh.shape, basis, face.face);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const auto shapes = shapes_at(mesh.shape, basis, rule.points[q]);
      Vector<double> along[2] = {};
      for (int k = 0; k < shapes.count; ++k) {
        const int node = mesh.node(face.cell, basis, k);
        for (int s = 0; s < 2; ++s) {
          double slope = 0;
          for (int c = 0; c < 3; ++c) slope += shapes.slope[k][c] * rule.directions[s][c];
          for (int i = 0; i < 3; ++i)
            along[s][i] += slope * (mesh.points[node][i] + y[layout.displacement(node, i)]);
        }
      }
      const Vector<double> oriented = cross(along[0], along[1]);
      const double weight = rule.weights[q] * std::sqrt(dot(oriented, oriented));
      const auto linear = shapes_at(mesh.shape, Basis::linear, rule.points[q]);
      double pressure = 0;
      for (int k = 0; k < linear.count; ++k)
        pressure += linear.value[k] * y[layout.pressure(mesh.node(face.cell, Basis::linear, k))];
      force += weight * pressure;
      area += weight;
    }
  }
  return force / area;
}

}  // namespace tunica::full3d
