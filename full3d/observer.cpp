// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/observer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tunica::full3d {

namespace {

constexpr double degrees = 180 / std::numbers::pi;
/// Points of a profile through the wall, both surfaces included.
constexpr int profile_points = 61;

struct Column {
  const char* name;
  const char* unit;
  double observables::WallPoint::*value;
};
constexpr Column wall_columns[] = {
    {"radial_displacement", "cm", &observables::WallPoint::radial_displacement},
    {"fiber_angle", "deg", &observables::WallPoint::fiber_angle},
    {"fiber_stretch", "1", &observables::WallPoint::fiber_stretch},
    {"recruitment", "1", &observables::WallPoint::recruitment},
    {"von_mises", "dyn/cm2", &observables::WallPoint::von_mises}};

}  // namespace

Observer::Observer(const Setup& setup, const Assembler& assembler) : setup_(setup), assembler_(assembler) {
  const Problem& problem = setup.problem;
  const Locator locator(problem.mesh);
  const auto course = course_of(setup, locator);
  section_pressure_ = course->section_pressure(assembler.layout());
  const auto line_at = [&](double angle, int points) {
    return std::make_unique<const WallLine>(setup, assembler.layout(), *course, locator, angle, points);
  };
  further_angles_ = course->further_angles();
  points_.push_back(line_at(0, observables::wall_points));
  for (const int angle : further_angles_)
    points_.push_back(line_at(angle / degrees, observables::wall_points));
  profile_ = line_at(0, profile_points);
  for (int p = 0; p < observables::wall_points; ++p) {
    const auto& tissue = law(points_[0]->layer(p));
    std::vector<int> families = coupled::distinct_families(tissue);
    if (!coupled::is_balanced(tissue)) {
      families.resize(wall::families(tissue).size());
      for (std::size_t f = 0; f < families.size(); ++f) families[f] = static_cast<int>(f);
    }
    for (const int family : families) events_.push_back({p + 1, family + 1});
  }
  find_line(*course, locator);
}

void Observer::find_line(const Course& course, const Locator& locator) {
  const Problem& problem = setup_.problem;
  const Mesh& mesh = problem.mesh;
  std::vector<Place> blood, wall;
  for (const AlongPoint& at : course.along()) {
    const auto in_wall = locator.find(at.point, Part::wall);
    if (!in_wall) continue;
    LineNode entry{at.s, at.radius, blood.size(), 0, wall.size(), 0, 0, {}};
    if (const auto place = locator.find(at.point, Part::blood))
      for (const Place& each : locator.meeting(*place)) blood.push_back(each);
    auto meeting = locator.meeting(*in_wall);
    entry.layer = mesh.cells[meeting.front().cell].layer;
    for (const Place& each : meeting) entry.layer = std::min(entry.layer, mesh.cells[each.cell].layer);
    std::erase_if(meeting, [&](const Place& each) { return mesh.cells[each.cell].layer != entry.layer; });
    wall.insert(wall.end(), meeting.begin(), meeting.end());
    entry.directions = mean_directions(problem, meeting, at.point);
    entry.blood_count = blood.size() - entry.blood;
    entry.wall_count = wall.size() - entry.wall;
    line_.push_back(entry);
  }
  line_blood_ = blood_probe(problem, assembler_.layout(), std::move(blood));
  line_wall_ = wall_probe(problem, assembler_.layout(), std::move(wall), false);
}

void Observer::fill(const WallLine& line, std::span<const double> y, std::span<observables::WallPoint> points,
                    std::vector<WallState>* states) const {
  auto found = line.states(y);
  for (std::size_t p = 0; p < found.size(); ++p) {
    const WallState& state = found[p];
    observables::WallPoint& point = points[p];
    point.radial_displacement = dot(state.strain.displacement, state.directions.radial);
    point.von_mises = von_mises_stress(coupled::cauchy(law(state.layer), state.strain, state.axes()));
    const auto& families = wall::families(law(state.layer));
    if (families.empty()) continue;
    const auto fiber = wall::fiber_state(families.front(), state.strain.gradient, state.axes());
    point.fiber_angle = fiber.angle * degrees;
    point.fiber_stretch = fiber.stretch;
    point.recruitment = fiber.recruitment;
  }
  if (states) *states = std::move(found);
}

observables::Sample Observer::sample(double time, std::span<const double> y) const {
  const Problem& problem = setup_.problem;
  observables::Sample sample;
  sample.time = time;
  if (!section_pressure_) {
    sample.pressure = problem.lumen_pressure(time);
  } else {
    const coupled::Stage stage{time, 0, {}};
    sample.inflow = 0.0 - assembler_.flow(stage, y, Boundary::inlet).net;  // at rest 0, not -0
    sample.outflow = assembler_.flow(stage, y, Boundary::outlet).net;
    sample.pressure = section_pressure_(y);
    if (const auto entry = assembler_.layout().outlet_pressure) sample.outlet_pressure = y[*entry];
  }
  std::vector<WallState> states;
  fill(*points_[0], y, sample.wall, &states);
  sample.transmural_pressure =
      sample.pressure - physics::external_pressure(problem.tether, states.back().strain.displacement,
                                                   states.back().strain.gradient,
                                                   states.back().directions.radial);
  return sample;
}

observables::Table Observer::observables_table() const {
  observables::Table table = observables::standard_table();
  for (std::size_t a = 1; a < points_.size(); ++a)
    for (const Column& column : wall_columns)
      for (int p = 1; p <= observables::wall_points; ++p)
        table.add(fmt::format("{}.P{}.{}deg", column.name, p, further_angles_[a - 1]), column.unit);
  return table;
}

void Observer::append_observables(double time, std::span<const double> y, observables::Table& table) const {
  observables::append(table, sample(time, y));
  std::size_t next = observables::standard_table().columns().size();
  for (std::size_t a = 1; a < points_.size(); ++a) {
    observables::WallPoint points[observables::wall_points];
    fill(*points_[a], y, points);
    for (const Column& column : wall_columns)
      for (const auto& point : points) table[next++].values.push_back(point.*column.value);
  }
}

void Observer::append_profile(double time, std::span<const double> y, observables::Table& profiles) const {
  for (const WallState& state : profile_->states(y)) {
    const auto& [radial, circumferential, axial] = state.directions;
    const Tensor<double> f = Tensor<double>::identity() + state.strain.gradient;
    const auto stretch = [&](const Vector<double>& direction) {
      const Vector<double> image = f * direction;
      return std::sqrt(dot(image, image));
    };
    observables::ProfilePoint point;
    point.time = time;
    point.reference_radius = profile_->radius() + state.depth;
    point.radial_displacement = dot(state.strain.displacement, radial);
    point.radial_stretch = stretch(radial);
    point.circumferential_stretch = stretch(circumferential);
    point.volume_change = volume_change(state.strain.gradient);
    const auto& families = wall::families(law(state.layer));
    if (!families.empty()) {
      const auto fiber = wall::fiber_state(families.front(), state.strain.gradient, state.axes());
      point.fiber_stretch = fiber.stretch;
      point.fiber_angle = fiber.angle * degrees;
      point.recruitment = fiber.recruitment;
    }
    const Tensor<double> cauchy = coupled::cauchy(law(state.layer), state.strain, state.axes());
    const auto normal = [&](const Vector<double>& n) { return dot(n, cauchy * n); };
    point.radial_stress = normal(radial);
    point.circumferential_stress = normal(circumferential);
    point.axial_stress = normal(axial);
    point.von_mises = von_mises_stress(cauchy);
    observables::append(profiles, point);
  }
}

double Observer::shear_stress(const Directions& directions, const BloodSample& blood) const {
  const auto f = Tensor<double>::identity() + blood.displacement_gradient;
  const auto minors = cofactor(f);
  const auto unit = [](Vector<double> v) {
    const double length = std::sqrt(dot(v, v));
    for (double& component : v) component /= length;
    return v;
  };
  const Vector<double> along = unit(f * directions.axial), outward = unit(minors * directions.radial);
  // grad v = dv/dX F^-1
  const auto gradient = (1 / determinant(f)) * (blood.velocity_gradient * transpose(minors));
  return -setup_.problem.blood.viscosity * dot(along, (gradient + transpose(gradient)) * outward);
}

void Observer::append_along(double time, std::span<const double> y, observables::Table& along) const {
  const Problem& problem = setup_.problem;
  const auto blood = line_blood_->samples(y);
  const auto strains = line_wall_->strains(y);
  for (const LineNode& node : line_) {
    const Directions& directions = node.directions;
    double pressure = node.blood_count > 0 ? 0 : problem.lumen_pressure(time);
    double shear = node.blood_count > 0 ? 0 : observables::none;
    for (std::size_t k = node.blood; k < node.blood + node.blood_count; ++k) {
      pressure += blood[k].pressure / static_cast<double>(node.blood_count);
      shear += shear_stress(directions, blood[k]) / static_cast<double>(node.blood_count);
    }
    WallStrain strain;
    for (std::size_t k = node.wall; k < node.wall + node.wall_count; ++k)
      strain.add(1.0 / static_cast<double>(node.wall_count), strains[k]);
    const double von_mises = von_mises_stress(
        coupled::cauchy(law(node.layer), strain, {directions.circumferential, directions.axial}));
    const double outward = dot(strain.displacement, directions.radial);
    std::size_t column = 0;
    for (const double value : {time, node.s + dot(strain.displacement, directions.axial),
                               node.radius + outward, pressure, shear, outward, von_mises})
      along[column++].values.push_back(value);
  }
}

void Observer::event_values(std::span<const double> y, double* values) const {
  if (events_.empty()) return;
  const auto states = points_[0]->states(y);
  for (const observables::EventPlace& event : events_) {
    const WallState& state = states[event.point - 1];
    const Kinematics<double> k(state.strain.gradient);
    *values++ = wall::families(law(state.layer))[event.family - 1].excess(k, state.axes());
  }
}

}  // namespace tunica::full3d
