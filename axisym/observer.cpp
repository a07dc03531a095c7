// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/observer.hpp"

#include <cmath>
#include <numbers>

#include "axisym/meeting.hpp"

namespace tunica::axisym {

namespace {

constexpr double degrees = 180 / std::numbers::pi;
/// Points of a profile through the wall, both surfaces included.
constexpr int profile_points = 61;
/// Gauss-Legendre points per cell of the lumen's section: the mean pressure is exact on cells in rows.
constexpr int lumen_points = 4;

std::vector<double> divided(double inner, double outer, int points) {
  std::vector<double> radii;
  for (int k = 0; k < points; ++k) radii.push_back(std::lerp(inner, outer, k / (points - 1.0)));
  return radii;
}

/// Outward normal of the outer surface at a place on it, the mean of the sides that meet there.
std::optional<Vector<double>> normal_at(const Problem& problem, const std::vector<Place>& places) {
  const Mesh& mesh = problem.mesh;
  const bool quadratic = problem.discretisation.element == Element::quadratic;
  Vector<double> sum{};
  for (const Place& place : places)
    for (const Edge& edge : mesh.edges) {
      if (edge.boundary != Boundary::outer || edge.cell != place.cell) continue;
      if (!on_side(mesh.shape, edge.side, place.local)) continue;
      const auto local = element::side_nodes(mesh.shape, edge.side);
      const auto from = element::node_position(mesh.shape, local[0]);
      const auto to = element::node_position(mesh.shape, local[1]);
      const auto nodes = mesh.side_nodes(edge.cell, edge.side);
      const Image at = image(mesh, edge.cell, place.local);
      std::array<double, 2> along;
      for (int i = 0; i < 2; ++i)
        along[i] = quadratic ? at.slope[i][0] * (to[0] - from[0]) + at.slope[i][1] * (to[1] - from[1])
                             : mesh.points[nodes[1]][i] - mesh.points[nodes[0]][i];
      const double length = std::hypot(along[0], along[1]);
      // Cells are counter-clockwise: the outside lies to the right.
      sum[0] += along[1] / length;
      sum[2] -= along[0] / length;
    }
  const double length = std::sqrt(dot(sum, sum));
  if (!(length > 0)) return {};
  return Vector<double>{sum[0] / length, 0, sum[2] / length};
}

}  // namespace

Observer::Observer(const Assembler& assembler)
    : assembler_(assembler), reader_(assembler), interface_(reader_) {
  const Problem& problem = assembler.problem();
  const Mesh& mesh = problem.mesh;
  const Extent ends = extent(mesh);
  const double middle = 0.5 * (ends.inlet + ends.outlet);
  const Section section = section_at(mesh, middle);
  if (mesh.has(Part::blood)) lumen_ = section_rule(mesh, section, Part::blood, lumen_points);
  if (!mesh.has(Part::wall)) return;
  points_.emplace(reader_, middle, divided(section.inner, section.outer, observables::wall_points));
  profile_.emplace(reader_, middle, divided(section.inner, section.outer, profile_points));
  outer_normal_ = normal_at(problem, points_->places(observables::wall_points - 1));
  for (int p = 0; p < observables::wall_points; ++p)
    for (const int family : distinct_families(problem.laws[points_->layer(p)]))
      events_.push_back({p + 1, family + 1});
}

const wall::Law<double>& Observer::law(const WallState& state) const {
  return assembler_.problem().laws[state.layer];
}

/// int p r dr / int r dr over the image of the section, r and dr along it being current.
double Observer::section_pressure(std::span<const double> y) const {
  const Problem& problem = assembler_.problem();
  const Layout& layout = assembler_.layout();
  double force = 0, area = 0;
  for (const SectionPoint& q : lumen_) {
    const auto [cell, local] = q.place;
    const auto shapes = lifted_at(problem.mesh, problem.discretisation.element, cell, local);
    const auto nodal = nodal_displacement(assembler_, cell, y);
    const double radius = q.radius + kernel::field_value(shapes, nodal)[0];
    const double weight = q.weight * radius * (1 + kernel::field_gradient(shapes, nodal)(0, 0));
    const auto linear = element::shapes_at(problem.mesh.shape, element::Basis::linear, local);
    double pressure = 0;
    for (int k = 0; k < linear.count; ++k)
      pressure += linear.value[k] * y[layout.pressure(problem.mesh.cells[cell].nodes[k])];
    force += weight * pressure;
    area += weight;
  }
  return force / area;
}

observables::Sample Observer::sample(double time, std::span<const double> y) const {
  const Problem& problem = assembler_.problem();
  observables::Sample sample;
  sample.time = time;
  if (lumen_.empty()) {
    sample.pressure = problem.lumen_pressure(time);
  } else {
    const Stage stage{time, 0, {}};
    sample.inflow = 0.0 - assembler_.flow(stage, y, Boundary::inlet).net;  // at rest 0, not -0
    sample.outflow = assembler_.flow(stage, y, Boundary::outlet).net;
    sample.pressure = section_pressure(y);
    if (const auto entry = assembler_.layout().outlet_pressure) sample.outlet_pressure = y[*entry];
  }
  if (!points_) return sample;
  const auto states = points_->states(y);
  if (outer_normal_)
    sample.transmural_pressure =
        sample.pressure - physics::external_pressure(problem.tether, states.back().strain.displacement,
                                                     states.back().strain.gradient, *outer_normal_);
  for (std::size_t p = 0; p < states.size(); ++p) {
    const WallState& state = states[p];
    observables::WallPoint& point = sample.wall[p];
    point.radial_displacement = state.strain.displacement[0];
    point.von_mises = von_mises_stress(reader_.cauchy(state.layer, state.strain, state.axes));
    const auto& families = wall::families(law(state));
    if (families.empty()) continue;
    const auto fiber = wall::fiber_state(families.front(), state.strain.gradient, state.axes);
    point.fiber_angle = fiber.angle * degrees;
    point.fiber_stretch = fiber.stretch;
    point.recruitment = fiber.recruitment;
  }
  return sample;
}

void Observer::append_profile(double time, std::span<const double> y, observables::Table& profiles) const {
  if (!profile_) return;
  for (const WallState& state : profile_->states(y)) {
    const Tensor<double>& gradient = state.strain.gradient;
    observables::ProfilePoint point;
    point.time = time;
    point.reference_radius = state.radius;
    point.radial_displacement = state.strain.displacement[0];
    point.radial_stretch = std::hypot(1 + gradient(0, 0), gradient(2, 0));
    point.circumferential_stretch = 1 + gradient(1, 1);
    point.volume_change = volume_change(gradient);
    const auto& families = wall::families(law(state));
    if (!families.empty()) {
      const auto fiber = wall::fiber_state(families.front(), gradient, state.axes);
      point.fiber_stretch = fiber.stretch;
      point.fiber_angle = fiber.angle * degrees;
      point.recruitment = fiber.recruitment;
    }
    const Tensor<double> cauchy = reader_.cauchy(state.layer, state.strain, state.axes);
    point.radial_stress = cauchy(0, 0);
    point.circumferential_stress = cauchy(1, 1);
    point.axial_stress = cauchy(2, 2);
    point.von_mises = von_mises_stress(cauchy);
    observables::append(profiles, point);
  }
}

void Observer::append_along(double time, std::span<const double> y, observables::Table& along) const {
  for (const InterfaceState& state : interface_.states(time, y)) {
    std::size_t column = 0;
    for (const double value : {time, state.z, state.radius, state.pressure, state.wall_shear_stress,
                               state.radial_displacement, state.von_mises})
      along[column++].values.push_back(value);
  }
}

void Observer::event_values(std::span<const double> y, double* values) const {
  if (events_.empty()) return;
  const auto states = points_->states(y);
  for (const observables::EventPlace& event : events_) {
    const WallState& state = states[event.point - 1];
    const Kinematics<double> k(state.strain.gradient);
    *values++ = wall::families(law(state))[event.family - 1].excess(k, state.axes);
  }
}

}  // namespace tunica::axisym
